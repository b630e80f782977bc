"""Lognormal fragilities from incremental dynamic analysis, with their confidence.

Runs nothing and reads no files. Source: Baker, J. W. (2015), "Efficient analytical fragility
function fitting using dynamic structural analysis", Earthquake Spectra 31(1), 579-599. Read
`fragility` first.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from solver.kernels import fragility as kernel
from solver.model import Floats

Flags = NDArray[np.bool_]

CONFIDENCE = 0.90
REPEATS = 1000
"""Bootstrap samples."""

MOST_AT_ONCE = 4_000_000
"""Runs of bootstrap samples held in memory together."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Lognormal:
    """Chance of exceedance Phi(ln(x / theta) / beta); both NaN if the counts determine none."""

    theta: float
    beta: float

    @property
    def is_known(self) -> bool:
        """Whether the counts determine it."""
        return math.isfinite(self.theta)

    def at(self, intensity: Floats) -> Floats:
        """Return the chance of exceedance at intensities above 0, of any shape."""
        z = np.log(np.asarray(intensity) / self.theta) / self.beta
        return np.array([kernel.normal_cdf(v) for v in z.ravel()]).reshape(z.shape)


UNKNOWN = Lognormal(theta=math.nan, beta=math.nan)


@dataclass(frozen=True, slots=True, kw_only=True)
class Fragility:
    """A fitted fragility with its data points and confidence.

    Attributes
    ----------
    levels : array, shape (m,)
        Intensities.
    exceeded, counted : array of int, shape (m,)
        Exceedances, and motions that they are counted in.
    censored : int
        Runs that are in no count, because they have no value and are stated as censored.
    fitted : Lognormal
    theta_range, beta_range : tuple of float
        Confidence interval of `CONFIDENCE`, by bootstrap over the motions; NaN if not determined.
    unfitted : int
        Bootstrap samples that determine no lognormal.
    """

    levels: Floats
    exceeded: NDArray[np.int64]
    counted: NDArray[np.int64]
    censored: int
    fitted: Lognormal
    theta_range: tuple[float, float]
    beta_range: tuple[float, float]
    unfitted: int


def fit_lognormal(levels: Floats, exceeded: Floats, counted: Floats) -> Lognormal:
    """Return the lognormal of maximum likelihood (Baker 2015, Eq. 11).

    Parameters
    ----------
    levels, exceeded, counted : array, shape (m,)
        Intensities, all above 0; exceedances and runs at each.

    Returns
    -------
    Lognormal
        Unknown if no exceedance is at a lower intensity than some non-exceedance: the likelihood
        then grows as beta goes to zero.
    """
    a, b, status = kernel.fit_probit(
        np.log(levels), np.asarray(exceeded, dtype=float), np.asarray(counted, dtype=float)
    )
    return UNKNOWN if status != kernel.FITTED else _lognormal(a, b)


def _lognormal(a: float, b: float) -> Lognormal:
    return Lognormal(theta=math.exp(-a / b), beta=1.0 / b)


def fragility(levels: Floats, exceeds: Flags, counts: Flags, *, seed: int) -> Fragility:
    """Fit a fragility to a limit state, with its confidence.

    Bootstrap over the motions, not the runs: those of one motion at several intensities depend on
    each other. Each sample has motions that exceed the limit state from a capacity of their own on,
    drawn from the fitted lognormal. The intervals are those of (ln theta* - ln theta) / beta* and
    of beta* / beta, which do not depend on theta and beta but for the spacing of the levels.

    Parameters
    ----------
    levels : array, shape (m,)
        Intensities above 0.
    exceeds, counts : array of bool, shape (motions, m)
        Whether the limit state is exceeded, and whether the run is counted.
    seed : int
    """
    k, n = (exceeds & counts).astype(float), counts.astype(float)
    fitted = fit_lognormal(levels, k.sum(axis=0), n.sum(axis=0))
    theta_range, beta_range, unfitted = UNKNOWN_RANGE, UNKNOWN_RANGE, 0
    if fitted.is_known:
        theta_range, beta_range, unfitted = _ranges(np.log(levels), n, fitted, seed)
    return Fragility(
        levels=levels,
        exceeded=k.sum(axis=0).astype(np.int64),
        counted=n.sum(axis=0).astype(np.int64),
        censored=int(counts.size - counts.sum()),
        fitted=fitted,
        theta_range=theta_range,
        beta_range=beta_range,
        unfitted=unfitted,
    )


Range = tuple[float, float]
UNKNOWN_RANGE = (math.nan, math.nan)


def _ranges(x: Floats, n: Floats, fitted: Lognormal, seed: int) -> tuple[Range, Range, int]:
    """Return the intervals of theta and beta, and the number of samples without a lognormal."""
    rng = np.random.default_rng(seed)
    share = max(1, REPEATS * n.size // MOST_AT_ONCE)
    counts = [
        _sample(rng, x, n, fitted, len(part)) for part in np.array_split(range(REPEATS), share)
    ]
    exceeded, counted = (np.concatenate(parts) for parts in zip(*counts, strict=True))
    lines = np.empty((REPEATS, 2))
    kernel.fit_many(x, exceeded, counted, lines)
    a, b = lines[~np.isnan(lines[:, 0])].T
    if not a.size:
        return UNKNOWN_RANGE, UNKNOWN_RANGE, REPEATS
    tails = (0.5 * (1.0 - CONFIDENCE), 0.5 * (1.0 + CONFIDENCE))
    t_low, t_high = np.quantile(-a - b * math.log(fitted.theta), tails)
    r_low, r_high = np.quantile(1.0 / (b * fitted.beta), tails)
    theta, beta = fitted.theta, fitted.beta
    return (
        (theta * math.exp(-t_high * beta), theta * math.exp(-t_low * beta)),
        (beta / r_high, beta / r_low),
        REPEATS - a.size,
    )


def _sample(
    rng: np.random.Generator, x: Floats, n: Floats, fitted: Lognormal, size: int
) -> tuple[Floats, Floats]:
    """Return exceedances and runs of bootstrap samples, shape (size, m)."""
    drawn = n[rng.integers(len(n), size=(size, len(n)))]
    capacity = math.log(fitted.theta) + fitted.beta * rng.standard_normal((size, len(n), 1))
    return ((x >= capacity) * drawn).sum(axis=1), drawn.sum(axis=1)
