"""Design curves: statistics of the PRD over motions, and values read off the curves.

Peaks of 0.1, 0.2 and 0.3 m have a mean of 0.2 m, and a design curve of 0.22 m at 1.1 times it.

A PRD that is NaN is a run without a value (uplift, or sliding at the end of the record): it is
treated as larger than any limit and is never omitted. `fit_prd` fits a closed formula to the PRD of
a study, with its error and its domain. Runs nothing. Read `statistics` first.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from solver.errors import InputError
from solver.model import Floats
from solver.spaces import NO_BREAK

# One standard deviation above the median of a lognormal.
PERCENTILE = 84.0


@dataclass(frozen=True, slots=True, kw_only=True)
class Statistics:
    """Statistics of the PRD over motions, each of the shape of the cases.

    NaN where it depends on a motion without a value.
    """

    mean_m: Floats
    p84_m: Floats  # 84th percentile, linear between order statistics [m]
    largest_m: Floats
    without_value: NDArray[np.int64]  # number of motions


def statistics(prd_m: Floats) -> Statistics:
    """Return the statistics over motions.

    `prd_m`: shape (..., motions), PRD of each case under each motion [m]; NaN for none.
    """
    lost = np.isnan(prd_m)
    with np.errstate(invalid="ignore"):
        # As inf, not NaN: the percentile of the others is known while enough of them have a value.
        p84_m = np.percentile(np.where(lost, np.inf, prd_m), PERCENTILE, axis=-1)
    return Statistics(
        mean_m=prd_m.mean(axis=-1),
        p84_m=np.where(np.isfinite(p84_m), p84_m, np.nan),
        largest_m=prd_m.max(axis=-1),
        without_value=lost.sum(axis=-1),
    )


def first_allowed(values: Floats, prd_m: Floats, allowed_m: float) -> float:
    """Return the first value, in the order given, beyond which the PRD does not exceed a limit.

    For increasing friction coefficients it is the smallest sufficient one, as read from the paper's
    Fig. 12; for decreasing slopes, the largest permitted one. Interpolated between the runs; the
    first value if none exceeds the limit, NaN if the last does. `values` are in any unit; they and
    `prd_m` have the shape (q,).
    """
    beyond = np.flatnonzero(~(prd_m <= allowed_m))
    if not beyond.size:
        return float(values[0])
    last = int(beyond[-1])
    if last + 1 == values.size:
        return math.nan
    # No interpolation is possible next to a run without a value.
    if math.isnan(prd_m[last]):
        return float(values[last + 1])
    part = (prd_m[last] - allowed_m) / (prd_m[last] - prd_m[last + 1])
    return float(values[last] + part * (values[last + 1] - values[last]))


# PRD from which cases are fitted: below, a factor on the PRD means nothing.
LEAST_PRD_M = 0.005

# Largest r fitted: near 1 the logarithm of a small difference would govern the fit.
LARGEST_R = 0.9

# Coefficients of the formula: a constant and four variables.
TERMS = 5

# Significant digits of the coefficients: the errors are those of the formula as it is printed.
DIGITS = 4


@dataclass(frozen=True, slots=True, kw_only=True)
class Fit:
    """A fitted formula; it is fitted to the cases in its domain."""

    coefficients: tuple[float, ...]  # b0 to b4, for a PRD in meters, to `DIGITS`
    ppa_g: float  # p, mean peak acceleration of the motions at intensity 1 [g], to `DIGITS`
    sigma_ln: float  # of ln(exact / fitted), with the degrees of freedom that are left
    minimum_ratio: float  # of exact / fitted
    maximum_ratio: float
    cases: int
    domain: Mapping[str, tuple[float, float]]  # of slope [rad], friction, intensity, r, PRD [m]

    def prd_m(self, slope_rad: float, mu: float, intensity: float) -> float:
        """Return the fitted PRD [m] of a case covered by the formula."""
        r = self._r(slope_rad, mu, intensity)
        terms = _terms(*map(np.asarray, (slope_rad, mu, intensity, r)))
        return float(np.exp(terms @ np.array(self.coefficients)))

    def covers(self, slope_rad: float, mu: float, intensity: float) -> bool:
        """Whether a case is in the domain."""
        case = (slope_rad, mu, intensity, self._r(slope_rad, mu, intensity))
        ends = (self.domain[name] for name in ("slope_rad", "mu", "intensity", "r"))
        # A case that was fitted is in the domain whatever the rounding error of its units.
        return all(
            low - 1e-9 * abs(high) <= value <= high + 1e-9 * abs(high)
            for value, (low, high) in zip(case, ends, strict=True)
        )

    def _r(self, slope_rad: float, mu: float, intensity: float) -> float:
        # Yield acceleration for downslope slip, g tan(phi - theta), divided by the peak
        # acceleration.
        return math.tan(math.atan(mu) - slope_rad) / (self.ppa_g * intensity)


def _terms(slope: Floats, mu: Floats, x: Floats, r: Floats) -> Floats:
    # ln PRD = b0 + b1 ln(1 - r) + b2 ln r + b3 ln x + b4 slope / mu
    return np.stack([np.ones_like(r), np.log1p(-r), np.log(r), np.log(x), slope / mu], axis=-1)


def _to_digits(value: float) -> float:
    return float(f"{value:.{DIGITS}g}")


def fit_prd(
    slope_rad: Floats, mu: Floats, intensity: Floats, prd_m: Floats, *, ppa_g: float
) -> Fit:
    """Fit the formula to cases by least squares of the logarithm.

    Cases, all of shape (m,), without a value, with a PRD below `LEAST_PRD_M` or with r outside of
    (0, `LARGEST_R`] are outside of the domain and not fitted; `ppa_g` is the mean peak acceleration
    of the motions per unit of intensity [g]. Raises `InputError` if fewer than ten cases are left,
    or they do not determine the coefficients.
    """
    # Rounded before the fit: r is then that of whoever computes with the printed formula.
    ppa_g = _to_digits(ppa_g)
    with np.errstate(divide="ignore"):
        r = np.tan(np.arctan(mu) - slope_rad) / (ppa_g * intensity)
    # A run without a value is NaN, for which the comparison is false.
    fits = (prd_m >= LEAST_PRD_M) & (r > 0.0) & (r <= LARGEST_R)
    cases = int(fits.sum())
    if cases < 2 * TERMS:
        raise InputError(
            f"{cases} cases have a displacement of {1e3 * LEAST_PRD_M:g}{NO_BREAK}mm or more; a "
            f"formula needs {2 * TERMS} or more"
        )
    slope_rad, mu, intensity, prd_m, r = (
        values[fits] for values in (slope_rad, mu, intensity, prd_m, r)
    )
    terms, log_prd = _terms(slope_rad, mu, intensity, r), np.log(prd_m)
    coefficients, _, rank, _ = np.linalg.lstsq(terms, log_prd, rcond=None)
    if rank < TERMS:
        raise InputError(
            "the cases do not determine a formula; use two or more slopes, friction "
            "coefficients and intensities"
        )
    coefficients = np.array([_to_digits(value) for value in coefficients])
    off = log_prd - terms @ coefficients
    values = {"slope_rad": slope_rad, "mu": mu, "intensity": intensity, "r": r, "prd_m": prd_m}
    return Fit(
        coefficients=tuple(coefficients.tolist()),
        ppa_g=ppa_g,
        sigma_ln=float(np.sqrt(np.sum(off**2) / (cases - TERMS))),
        minimum_ratio=float(np.exp(off.min())),
        maximum_ratio=float(np.exp(off.max())),
        cases=cases,
        domain={name: (float(v.min()), float(v.max())) for name, v in values.items()},
    )
