"""A closed formula of the PRD from the peaks of the roof's motion, fitted to many runs.

    k   = tan(atan(mu) - theta)        r = k g / A
    PRD = c V^2 / A (1 - r)^p exp(s sqrt(theta / r))

A and V are the peak acceleration and velocity of the roof along the slope, k g the acceleration at
which a block begins to slip downslope, all in SI units. V^2 / A is the length that a pulse gives;
(1 - r)^p falls to nothing where nothing slips, as in Ambraseys and Menu (1988), and the last factor
describes the ratcheting downslope. Beside it stand published regressions for slopes of earth, in
the same variables. Runs nothing. Read `fit_equation`.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np

from solver.errors import InputError
from solver.model import STANDARD_GRAVITY_MPS2, Floats

LEAST_PRD_M = 0.010
"""PRD from which runs are fitted."""

LARGEST_R = 0.95
"""Largest r fitted: near 1 the logarithm of a small difference would govern the fit."""

TERMS = 3


@dataclass(frozen=True, slots=True, kw_only=True)
class RoofRuns:
    """Runs with what the formula needs of them, each an array of shape (n,).

    Attributes
    ----------
    ppa_mps2, ppv_mps : array
        Peak acceleration and velocity of the roof [m/s2, m/s].
    slope_rad, mu : array
    prd_m : array
        PRD of the run [m]; NaN for none.
    """

    ppa_mps2: Floats
    ppv_mps: Floats
    slope_rad: Floats
    mu: Floats
    prd_m: Floats

    @property
    def r(self) -> Floats:
        """Acceleration at the first slip downslope / peak acceleration."""
        slips_g = np.tan(np.arctan(self.mu) - self.slope_rad)
        return np.asarray(slips_g * STANDARD_GRAVITY_MPS2 / self.ppa_mps2)

    @property
    def holds(self) -> np.ndarray:
        """Whether the formula is fitted to a run: what slides far enough, and has a PRD."""
        r = self.r
        return (self.prd_m >= LEAST_PRD_M) & (r > 0.0) & (r <= LARGEST_R)

    def only(self, chosen: np.ndarray) -> RoofRuns:
        """Return some of the runs."""
        return RoofRuns(
            ppa_mps2=self.ppa_mps2[chosen],
            ppv_mps=self.ppv_mps[chosen],
            slope_rad=self.slope_rad[chosen],
            mu=self.mu[chosen],
            prd_m=self.prd_m[chosen],
        )


@dataclass(frozen=True, slots=True, kw_only=True)
class Equation:
    """The fitted constants, to three digits.

    Attributes
    ----------
    c, p, s : float
        As in the formula of this module.
    """

    c: float
    p: float
    s: float

    def prd_m(self, runs: RoofRuns) -> Floats:
        """Return the PRD by the formula [m]: the median of the runs that it describes."""
        r = runs.r
        length_m = runs.ppv_mps**2 / runs.ppa_mps2
        ratchets = np.exp(self.s * np.sqrt(runs.slope_rad / r))
        return np.asarray(self.c * length_m * (1.0 - r) ** self.p * ratchets)


@dataclass(frozen=True, slots=True)
class Scatter:
    """Of ln(computed / formula): mean, standard deviation and number of runs."""

    mean: float
    deviation: float
    runs: int


def fit_equation(parts: Iterable[RoofRuns]) -> Equation:
    """Fit the formula to runs by least squares of ln PRD, each run with the same weight.

    Parameters
    ----------
    parts : iterable of RoofRuns
        In any parts: only their sums are kept.

    Raises
    ------
    InputError
        If the runs do not determine the constants.
    """
    squares, products = np.zeros((TERMS, TERMS)), np.zeros(TERMS)
    for part in parts:
        runs = part.only(part.holds)
        terms = _terms(runs)
        wanted = np.log(runs.prd_m * runs.ppa_mps2 / runs.ppv_mps**2)
        squares += terms.T @ terms
        products += terms.T @ wanted
    if np.linalg.matrix_rank(squares) < TERMS:
        raise InputError("the runs do not determine a formula; give more slopes, friction or peaks")
    constant, p, s = np.linalg.solve(squares, products).tolist()
    return Equation(c=_digits(math.exp(constant)), p=_digits(p), s=_digits(s))


def _terms(runs: RoofRuns) -> Floats:
    r = runs.r
    return np.stack([np.ones_like(r), np.log1p(-r), np.sqrt(runs.slope_rad / r)], axis=-1)


def _digits(value: float) -> float:
    return float(f"{value:.3g}")


def scatter(computed_m: Floats, by_formula_m: Floats) -> Scatter:
    """Return how computed values lie about those of a formula, both above 0."""
    off = np.log(computed_m / by_formula_m)
    return Scatter(float(off.mean()), float(off.std()), off.size)


def pooled(parts: Sequence[Scatter]) -> Scatter:
    """Return the scatter of all runs from those of their parts."""
    # By `fsum`, which has the same bits on every machine; a dot product has not.
    runs = sum(part.runs for part in parts)
    mean = math.fsum(part.runs * part.mean for part in parts) / runs
    square = math.fsum(part.runs * (part.deviation**2 + part.mean**2) for part in parts) / runs
    return Scatter(mean, math.sqrt(square - mean**2), runs)


def ambraseys_menu_m(runs: RoofRuns) -> Floats:
    """Return the displacement [m] of Ambraseys and Menu (1988), doi 10.1002/eqe.4290160704, Eq. 2.

    Of ground motions as recorded, slipping to one side.
    """
    r = runs.r
    return np.asarray(0.01 * 10.0**0.90 * (1.0 - r) ** 2.53 * r**-1.09)


def jibson_m(runs: RoofRuns) -> Floats:
    """Return the displacement [m] of Jibson (2007), doi 10.1016/j.enggeo.2007.01.013, ratio model.

    Of ground motions as recorded, slipping to one side.
    """
    r = runs.r
    return np.asarray(0.01 * 10.0**0.215 * (1.0 - r) ** 2.341 * r**-1.438)


def saygili_rathje_m(runs: RoofRuns) -> Floats:
    """Return the displacement [m] of Saygili and Rathje (2008), the model of PGA and PGV.

    doi 10.1061/(ASCE)1090-0241(2008)134:6(790). Of ground motions, slipping to one side.
    """
    r = runs.r
    shape = -1.56 - 4.58 * r - 20.84 * r**2 + 44.75 * r**3 - 30.50 * r**4
    size = -0.64 * np.log(runs.ppa_mps2 / STANDARD_GRAVITY_MPS2) + 1.55 * np.log(
        100.0 * runs.ppv_mps
    )
    return np.asarray(0.01 * np.exp(shape + size))
