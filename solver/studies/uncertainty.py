"""Uncertain friction, slope and intensity, and their effect on a displacement.

A friction coefficient with a median of 0.40 and a beta of 0.1 is 0.34 at its 5% quantile and 0.47
at its 95% quantile.

Runs nothing. Read `Spread`, then `latin_hypercube`, `exceedance` and `tornado`.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from statistics import NormalDist

import numpy as np

from solver.errors import InputError
from solver.model import Floats

_NORMAL = NormalDist()

LOW, HIGH = 0.05, 0.95
"""Quantiles between which a variable is changed alone."""

CHANCE_REPEATS = 2000
CHANCE_CONFIDENCE = 0.90


@dataclass(frozen=True, slots=True, kw_only=True)
class Spread:
    """Distribution of one variable: lognormal, or uniform about its center."""

    center: float  # median of the lognormal, middle of the uniform distribution
    beta: float = 0.0  # standard deviation of the logarithm
    half: float = 0.0  # half the width of the uniform distribution

    @property
    def is_fixed(self) -> bool:
        """Whether the variable has only one value."""
        return self.beta == 0.0 and self.half == 0.0

    @property
    def around(self) -> tuple[float, float]:
        """One standard deviation below and above the center: of the logarithm of a lognormal."""
        if self.beta:
            return self.center * math.exp(-self.beta), self.center * math.exp(self.beta)
        return self.center - self.deviation, self.center + self.deviation

    @property
    def deviation(self) -> float:
        """Standard deviation, of the logarithm of a lognormal."""
        # A uniform variable of half width h has the variance h^2 / 3.
        return self.beta or self.half / math.sqrt(3.0)

    def quantile(self, chance: float) -> float:
        """Return the value that is not exceeded with a probability between 0 and 1."""
        if self.beta:
            return self.center * math.exp(self.beta * _NORMAL.inv_cdf(chance))
        return self.center + self.half * (2.0 * chance - 1.0)


def spread_of_tests(values: Sequence[float]) -> Spread:
    """Return the lognormal of the mean and the deviation of the logarithms of tested values.

    Raises `InputError` with fewer than three values, or one that is not above 0.
    """
    if len(values) < 3 or min(values) <= 0.0:
        raise InputError(f"{len(values)} tested values; use three or more, each above 0")
    logs = np.log(values)
    return Spread(center=float(np.exp(logs.mean())), beta=float(logs.std(ddof=1)))


def latin_hypercube(spreads: Sequence[Spread], count: int, *, seed: int) -> Floats:
    """Return samples of independent variables, shape (count, variables)."""
    # Each variable has exactly one sample in each of `count` intervals of equal probability (McKay,
    # Beckman and Conover 1979, Technometrics 21, 239-245).
    rng = np.random.default_rng(seed)
    columns = []
    for spread in spreads:
        chances = (rng.permutation(count) + rng.uniform(size=count)) / count
        # A uniform draw may be 0 exactly, where a lognormal has no quantile.
        columns.append([spread.quantile(max(chance, math.ulp(1.0))) for chance in chances])
    return np.array(columns).T.reshape(count, len(spreads))


@dataclass(frozen=True, slots=True, kw_only=True)
class Exceedance:
    """Probability that a limit is exceeded, with its interval of `CHANCE_CONFIDENCE`.

    The interval is by bootstrap over the motions.
    """

    value: float  # fraction of all samples and motions, equally likely
    low: float
    high: float
    without_value: int  # runs that count as exceedances
    runs: int


def exceedance(prd_m: Floats, limit_m: float, *, seed: int) -> Exceedance:
    """Return the probability that a limit is exceeded.

    `prd_m`: shape (samples, motions); NaN for a run without a value, which counts as an exceedance.
    """
    # Motions are drawn again, not samples: those under one motion are not independent.
    by_motion = (~(prd_m <= limit_m)).mean(axis=0)
    rng = np.random.default_rng(seed)
    drawn = rng.integers(by_motion.size, size=(CHANCE_REPEATS, by_motion.size))
    tails = (0.5 * (1.0 - CHANCE_CONFIDENCE), 0.5 * (1.0 + CHANCE_CONFIDENCE))
    low, high = np.quantile(by_motion[drawn].mean(axis=1), tails)
    return Exceedance(
        value=float(by_motion.mean()),
        low=float(low),
        high=float(high),
        without_value=int(np.isnan(prd_m).sum()),
        runs=prd_m.size,
    )


@dataclass(frozen=True, slots=True, kw_only=True)
class Bar:
    """Effect of one variable alone, the others at their centers."""

    name: str
    at_low: float  # the variable at its quantiles `LOW` and `HIGH`
    at_high: float
    prd_low_m: float  # mean PRD there [m]; NaN for none
    prd_high_m: float

    @property
    def width_m(self) -> float:
        """Length of the bar [m]; infinite if an end has no value."""
        width = abs(self.prd_high_m - self.prd_low_m)
        return math.inf if math.isnan(width) else width


def one_at_a_time(spreads: Mapping[str, Spread]) -> tuple[tuple[float, ...], ...]:
    """Return the cases of a tornado chart: all centers, then low and high of each variable."""
    centers = tuple(spread.center for spread in spreads.values())
    cases = [centers]
    for index, spread in enumerate(spreads.values()):
        for chance in (LOW, HIGH):
            cases.append((*centers[:index], spread.quantile(chance), *centers[index + 1 :]))
    return tuple(cases)


def tornado(spreads: Mapping[str, Spread], means_m: Floats) -> tuple[Bar, ...]:
    """Return the bars of a tornado chart, the longest first; a fixed variable has none.

    `means_m`: shape (1 + 2 variables,), mean PRD of the cases of `one_at_a_time` [m].
    """
    bars = [
        Bar(
            name=name,
            at_low=spread.quantile(LOW),
            at_high=spread.quantile(HIGH),
            prd_low_m=float(means_m[1 + 2 * index]),
            prd_high_m=float(means_m[2 + 2 * index]),
        )
        for index, (name, spread) in enumerate(spreads.items())
        if not spread.is_fixed
    ]
    return tuple(sorted(bars, key=lambda bar: -bar.width_m))
