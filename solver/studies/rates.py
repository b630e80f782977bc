"""Annual rates of displacement from a hazard curve and runs at many intensities.

If every motion exceeds a limit above 0.3 g, its rate is the exceedance rate of 0.3 g.

Runs nothing. Read `HazardCurve`, then `contributions`.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from solver.model import Floats

# Annual rate beyond which no intensity is run: they count as exceedances.
LEAST_RATE = 1e-6

# One standard deviation of a normal to either side.
BAND = (0.16, 0.84)
REPEATS = 1000
"""Realizations from which the band follows."""

_GRID = 4000
_NODES, _FURTHEST = 257, 9.0
"""Nodes of the factor, and how many deviations they reach."""

_FAR = 4.0
"""Deviations of the intensity beyond the end of a curve that are looked at."""


@dataclass(frozen=True, kw_only=True)
class HazardCurve:
    """Annual rate at which intensities are exceeded: a power law between its points.

    Below its first point no event is known. Beyond its last point the rate does not decrease: it is
    the rate of events of unknown intensity, which are never omitted.
    """

    intensity: Floats  # increasing, above 0, shape (m,)
    rate: Floats  # decreasing, above 0 [1/year]
    beta: float = 0.0  # dispersion of a factor of median 1 on the intensity of each event

    @cached_property
    def factors(self) -> tuple[Floats, Floats]:
        """The factor at nodes, with their probabilities."""
        if not self.beta:
            return np.ones(1), np.ones(1)
        # The logarithm of the factor is normal. Nodes at equal steps: Gauss-Hermite nodes are too
        # far apart for a curve that bends or ends.
        z = np.linspace(-_FURTHEST, _FURTHEST, _NODES)
        weights = np.exp(-0.5 * z**2)
        return np.exp(self.beta * z), weights / weights.sum()

    def at(self, intensity: Floats) -> Floats:
        """Return the rate at which the intensity times its factor is exceeded."""
        factors, weights = self.factors
        # A factor f lifts x to f x: what is exceeded at the site is x / f. A power law between
        # points is straight in logarithms.
        at_site = np.log(np.divide.outer(intensity, factors))
        plain = np.exp(np.interp(at_site, np.log(self.intensity), np.log(self.rate)))
        return np.asarray(plain @ weights)

    def beyond(self, intensity: float) -> HazardCurve:
        """Return the curve of the events whose intensity, without its factor, is larger."""
        log_intensity = math.log(intensity)
        rate = math.exp(np.interp(log_intensity, np.log(self.intensity), np.log(self.rate)))
        is_larger = self.intensity > intensity
        return HazardCurve(
            intensity=np.append(intensity, self.intensity[is_larger]),
            rate=np.append(rate, self.rate[is_larger]),
            beta=self.beta,
        )

    @cached_property
    def _grid(self) -> tuple[Floats, Floats]:
        # The factor spreads the curve beyond both of its ends.
        ends = self.intensity[[0, -1]] * np.exp(_FAR * self.beta * np.array([-1.0, 1.0]))
        intensity = np.geomspace(ends[0], ends[1], _GRID)
        return intensity, self.at(intensity)

    @property
    def is_ended(self) -> bool:
        """Whether the curve ends above `LEAST_RATE`."""
        return bool(self.rate[-1] > LEAST_RATE)

    @property
    def top(self) -> float:
        """The greatest intensity to run: where the rate is `LEAST_RATE`, or the curve ends."""
        if self.is_ended:
            return float(self.intensity[-1])
        return float(self.intensity_of(np.array([LEAST_RATE]))[0])

    def intensity_of(self, rate: Floats) -> Floats:
        """Return the intensities that are exceeded at rates [1/year], within the curve."""
        intensity, rates = self._grid
        return np.asarray(np.exp(np.interp(-np.log(rate), -np.log(rates), np.log(intensity))))


def contributions(
    curve: HazardCurve, levels: Floats, rate: Floats, prd_m: Floats, limit_m: float
) -> Floats:
    """Return the annual rate at which runs exceed a limit, by the interval of intensities.

    The PRD is linear between the levels; one that is NaN exceeds every limit, from the level below
    on. Levels, of which the last one of a run may repeat, and `rate`, that of the curve at them,
    have the shape (m,) or (runs, m); PRDs and results (..., m). The last result is of intensities
    beyond the levels, which exceed every limit.
    """
    levels, rate = np.broadcast_to(levels, prd_m.shape), np.broadcast_to(rate, prd_m.shape)
    # A run without a value exceeds every limit.
    prd = np.where(np.isnan(prd_m), np.inf, prd_m)
    low, high, below, above = prd[..., :-1], prd[..., 1:], rate[..., :-1], rate[..., 1:]
    # An interval exceeds the limit as a whole, from its crossing on, or up to it.
    rises, falls = (low <= limit_m) & (high > limit_m), (low > limit_m) & (high <= limit_m)
    crosses = rises | falls
    share = np.ones(low.shape)
    known = crosses & np.isfinite(low)
    share[known] = (limit_m - low[known]) / (high[known] - low[known])
    crossing = below.copy()
    crossing[crosses] = curve.at((levels[..., :-1] + share * np.diff(levels))[crosses])
    rates = np.where(low > limit_m, below - crossing * falls - above * ~falls, 0.0)
    rates = np.where(rises, crossing - above, rates)
    return np.concatenate([rates, rate[..., -1:]], axis=-1)


def exceedance_rates(curve: HazardCurve, levels: Floats, prd_m: Floats, limits_m: Floats) -> Floats:
    """Return the annual rate at which each run exceeds each limit, shape (limits, ...)."""
    rate = curve.at(levels)
    return np.array([contributions(curve, levels, rate, prd_m, d).sum(axis=-1) for d in limits_m])


def deaggregated(
    curve: HazardCurve, levels: Floats, prd_m: Floats, limit_m: float, edges: Floats
) -> Floats:
    """Return the shares of a rate of exceedance by the intensity before its factor, shape (n,).

    `edges`, shape (n + 1,), are the bounds of the intensities; the first bin has those below, the
    last those beyond. The sum is 1; zeros where the limit is never exceeded.
    """
    total, *above = (
        exceedance_rates(part, levels, prd_m, np.array([limit_m])).sum()
        for part in (curve, *map(curve.beyond, edges[1:-1]))
    )
    # A bin without events may differ from 0 by the last digit.
    shares = np.maximum(-np.diff([total, *above, 0.0]), 0.0)
    return shares / (shares.sum() or 1.0)


def displacements_at(limits_m: Floats, rates: Floats, years: Floats) -> Floats:
    """Return the displacements of mean recurrence intervals, shape (years, ...) [m].

    Limits increase from 0, shape (m,), and are exceeded at rates of shape (m, ...). 0 where the
    block slips less often, and inf where every limit is exceeded more often.
    """
    # The limit of 0 has no logarithm: half the next one stands for it.
    x = np.log(np.maximum(limits_m, 0.5 * limits_m[1]))

    def exceeded(of_limits: Floats) -> Floats:
        # Rates decrease with the limit, so -log(rate) increases, as `interp` requires.
        interpolated = np.interp(np.log(years), -np.log(of_limits), x, right=np.inf)
        return np.asarray(np.exp(interpolated))

    with np.errstate(divide="ignore"):
        displacements = np.apply_along_axis(exceeded, 0, rates)
    return np.where(np.multiply.outer(years, rates[0]) < 1.0, 0.0, displacements)


def realizations(rates: Floats, *, seed: int) -> Floats:
    """Return rates for resampled friction coefficients and sets of motions.

    Each has one of the coefficients, equally likely, and as many motions, drawn with replacement:
    from the shape (limits, frictions, motions) to (limits, `REPEATS`).
    """
    _, frictions, motions = rates.shape
    rng = np.random.default_rng(seed)
    friction = rng.integers(frictions, size=REPEATS)
    drawn: NDArray[np.int64] = rng.integers(motions, size=(REPEATS, motions))
    # How often a motion is drawn, over their number, is its weight in the sample of a bootstrap.
    counts = np.array([np.bincount(row, minlength=motions) for row in drawn]) / motions
    return np.asarray(np.einsum("lrm,rm->lr", rates[:, friction], counts))


def band(values: Floats) -> Floats:
    """Return the quantiles of `BAND` over the last axis, first."""
    # One of the values, never between two: a mean with a value that is inf would be none.
    return np.quantile(values, BAND, axis=-1, method="inverted_cdf")


def probability(rate: float, years: float) -> float:
    """Return the probability of one or more Poisson events in a number of years."""
    # 1 - exp(-x) would lose the digits of a small probability.
    return -math.expm1(-rate * years)
