"""Friction tests: their runs by report and surface, and a friction law fitted to them.

Kinetic coefficients of 0.30, 0.34, 0.39 and 0.40 at 0.01, 0.05, 0.2 and 0.5 m/s are a law that
rises from 0.287 to 0.400 with a rate of 12.6 s/m.

Owns no limits of any rule set. Read `solver.model.Friction` first.
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from enum import StrEnum
from functools import cache
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from solver.model import Friction

# Largest friction coefficient that an array may have.
MOST_MU = 1.5

# Largest rate for which the error bounds in two axes were tested (see
# `solver.verification.random_pairs`).
MOST_RATE_S_PER_M = 1000.0

# Distinct velocities to which a law with three parameters is fitted: one more than parameters.
LEAST_VELOCITIES = 4

# Largest difference between the velocities of repeats, as a share of the smallest of them.
SAME_VELOCITY = 0.05

# At the lowest rate searched, the exponent changes by a tenth over the tested velocities: the law
# is then a straight line within 0.1 % of its change, and no lower rate can be told from it.
_LEAST_EXPONENT = 0.1
# Less than the last digit of a reported coefficient: the runs then show one coefficient.
_LEAST_DROP = 1e-4
# Rates at which the sum of squares is evaluated first. Golden section finds a local minimum, which
# need not be the smallest one, so it searches only the two cells around the best grid point.
_GRID = 400
_GOLDEN = (math.sqrt(5.0) - 1.0) / 2.0
# 0.618^70 is 2e-15: to rounding error.
_NARROWINGS = 70


class Surface(StrEnum):
    """Condition of the roof surface in a test."""

    DRY = "dry"
    WET = "wet"


@dataclass(frozen=True, slots=True, kw_only=True)
class FrictionRun:
    """One run of a friction test; values that are not reported are NaN."""

    report: str  # that contains the run
    surface: Surface
    velocity_mps: float  # of sliding
    mu: float  # kinetic
    mu_static: float  # at breakaway


@dataclass(frozen=True, slots=True, kw_only=True)
class Series:
    """The runs of one report in one condition, at least one."""

    report: str
    surface: Surface
    runs: tuple[FrictionRun, ...]

    @property
    def mean(self) -> float:
        """Mean of the kinetic coefficients."""
        return math.fsum(run.mu for run in self.runs) / len(self.runs)

    @property
    def static_mean(self) -> float:
        """Mean of the breakaway coefficients that are reported; NaN for none."""
        coefficients = [run.mu_static for run in self.runs if not math.isnan(run.mu_static)]
        return math.fsum(coefficients) / len(coefficients) if coefficients else math.nan

    @property
    def velocity_mps(self) -> float:
        """Largest velocity that a run reports [m/s]; NaN for none."""
        # NaN is removed first: the result of `max` with a NaN depends on its position.
        reported = (run.velocity_mps for run in self.runs if not math.isnan(run.velocity_mps))
        return max(reported, default=math.nan)

    @property
    def repeats(self) -> tuple[Series, ...]:
        """The runs at each velocity, from the lowest; last those that report no velocity."""
        groups: list[list[FrictionRun]] = []
        for run in sorted(self.runs, key=_nan_is_last):
            # Compared with the first run of the group, not the last; otherwise velocities that each
            # increase by less than 5% would all be one group. Runs without a velocity form one
            # group: inf <= inf.
            if groups and _nan_is_last(run) <= (1.0 + SAME_VELOCITY) * _nan_is_last(groups[-1][0]):
                groups[-1].append(run)
            else:
                groups.append([run])
        return tuple(replace(self, runs=tuple(group)) for group in groups)

    @property
    def minimum_mu(self) -> float:
        """Smallest mean of the kinetic coefficients at one velocity."""
        return min(repeat.mean for repeat in self.repeats)

    def mean_of(self, law: Friction) -> float:
        """Return the mean of a friction law over the tested velocities.

        Where a run reports no velocity, the larger of the law's two coefficients is used.
        """
        larger = max(law.mu_slow, law.mu_fast)
        values = (
            larger if math.isnan(run.velocity_mps) else law.at(run.velocity_mps)
            for run in self.runs
        )
        return math.fsum(values) / len(self.runs)


def _nan_is_last(run: FrictionRun) -> float:
    return math.inf if math.isnan(run.velocity_mps) else run.velocity_mps


def series(runs: Iterable[FrictionRun]) -> tuple[Series, ...]:
    """Return the runs by report and condition, in the order in which these first appear."""
    grouped: dict[tuple[str, Surface], list[FrictionRun]] = {}
    for run in runs:
        grouped.setdefault((run.report, run.surface), []).append(run)
    return tuple(
        Series(report=report, surface=surface, runs=tuple(those))
        for (report, surface), those in grouped.items()
    )


def governing(choices: Sequence[Series], text: str) -> Series:
    """Return the series with the smallest kinetic mean, of one or more.

    If the text, the test report of an array as entered, names reports, only these are considered.
    """
    named = []
    for choice in choices:
        report = re.escape(choice.report)
        # As a whole word: "report 123" does not name report 12.
        if report and re.search(rf"(?<!\w){report}(?!\w)", text, re.IGNORECASE):
            named.append(choice)
    return min(named or choices, key=lambda choice: choice.mean)


@dataclass(frozen=True, slots=True, kw_only=True)
class FittedLaw:
    """A friction law fitted to runs by least squares.

    The runs determine it if the rate lies within the range that was searched, and both coefficients
    differ and lie between 0 and `MOST_MU`.
    """

    law: Friction  # static friction equal to the low-velocity coefficient
    rms: float  # of the residuals
    is_determined: bool


def fit_law(velocities_mps: Sequence[float], mus: Sequence[float]) -> FittedLaw | None:
    """Fit mu_fast - (mu_fast - mu_slow) exp(-rate v) to runs by least squares.

    For a given rate the other two parameters follow from linear regression (variable projection,
    Golub and Pereyra, SIAM J. Numer. Anal. 10 (1973) 413-432). The rate is the least of a grid in
    log(rate) up to `MOST_RATE_S_PER_M`, refined by golden section.

    Velocities are >= 0 [m/s]; runs with NaN are not used. None for fewer than `LEAST_VELOCITIES`
    distinct velocities.
    """
    pairs = zip(velocities_mps, mus, strict=True)
    return _fitted(tuple((v, mu) for v, mu in pairs if not math.isnan(v)))


@cache  # pages ask for the same fit again and again
def _fitted(pairs: tuple[tuple[float, float], ...]) -> FittedLaw | None:
    if len({v for v, _ in pairs}) < LEAST_VELOCITIES:
        return None
    v, mu = np.array(pairs).T
    low, high = math.log(_LEAST_EXPONENT / float(v.max())), math.log(MOST_RATE_S_PER_M)
    # All velocities are below 1e-4 m/s: even at the highest rate the law is nearly a straight line
    # over that range.
    if not low < high:
        return None
    grid = np.linspace(low, high, _GRID)
    best = int(np.argmin([_regressed(math.exp(x), v, mu).squares for x in grid]))
    x = _refined(float(grid[max(best - 1, 0)]), float(grid[min(best + 1, _GRID - 1)]), v, mu)
    fit = _regressed(math.exp(x), v, mu)
    # At zero velocity the exponential is 1.
    slow = fit.fast - fit.drop
    # A rate at an end of the grid is determined by the search range, not by the runs.
    is_inside = 0 < best < _GRID - 1 and abs(fit.drop) > _LEAST_DROP
    return FittedLaw(
        law=Friction(mu_slow=slow, mu_fast=fit.fast, rate_s_per_m=math.exp(x), mu_static=slow),
        rms=math.sqrt(fit.squares / v.size),
        is_determined=is_inside and all(0.0 <= c <= MOST_MU for c in (slow, fit.fast)),
    )


class _Regression(NamedTuple):
    fast: float
    drop: float
    squares: float


def _regressed(rate: float, v: NDArray[np.float64], mu: NDArray[np.float64]) -> _Regression:
    """Return the regression of mu = fast - drop exp(-rate v) for a given rate."""
    decay = np.exp(-rate * v)
    # The sum of `off` is zero, so the mean of mu need not be subtracted below.
    off = decay - decay.mean()
    spread = float(off @ off)
    # Every velocity beyond the decay: one constant fits as well as any law.
    drop = -float(off @ mu) / spread if spread > 0.0 else 0.0
    fast = float(mu.mean()) + drop * float(decay.mean())
    residual = mu - fast + drop * decay
    return _Regression(fast, drop, float(residual @ residual))


def _refined(low: float, high: float, v: NDArray[np.float64], mu: NDArray[np.float64]) -> float:
    """Return the logarithm of the rate with the least sum of squares between two others."""

    def squares(x: float) -> float:
        return _regressed(math.exp(x), v, mu).squares

    a, b = high - _GOLDEN * (high - low), low + _GOLDEN * (high - low)
    at_a, at_b = squares(a), squares(b)
    for _ in range(_NARROWINGS):
        if at_a < at_b:
            high, b, at_b = b, a, at_a
            a = high - _GOLDEN * (high - low)
            at_a = squares(a)
        else:
            low, a, at_a = a, b, at_b
            b = low + _GOLDEN * (high - low)
            at_b = squares(b)
    return (low + high) / 2.0
