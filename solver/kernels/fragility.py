"""Lognormal fragility by maximum likelihood, jitted: a probit line through counts of exceedances.

Never raises; numpy and numba only. Read `fit_probit`; `solver.studies.fragility` explains it.

Letters:
    x     logarithm of the intensity
    k, n  number of exceedances and of runs at x
    a, b  the line: chance of exceedance = Phi(a + b x)
"""

import math

import numpy as np
from numba import njit

FITTED = 0
NOT_FINITE = 1
"""The likelihood has no maximum at a finite, increasing line."""

MOST_STEPS = 100
SETTLED = 1e-12
ROOT_HALF = math.sqrt(0.5)
ROOT_TWO_PI = math.sqrt(2.0 * math.pi)
# Beyond this Phi(-z) < 1e-290: the ratio phi / Phi is replaced by its asymptote.
FAR = 36.0


@njit(cache=True)
def normal_cdf(z):
    """Standard normal distribution function, accurate in both tails."""
    return 0.5 * math.erfc(-z * ROOT_HALF)


@njit(cache=True)
def _inverse_mills(z):
    """Return phi(z) / Phi(z)."""
    if z < -FAR:
        return -z
    return math.exp(-0.5 * z * z) / (ROOT_TWO_PI * normal_cdf(z))


@njit(cache=True)
def is_finite(x, k, n):
    """Whether the maximum is finite: some exceedance lies below some non-exceedance."""
    first, last = np.inf, -np.inf
    for i in range(x.size):
        if k[i] > 0.0:
            first = min(first, x[i])
        if n[i] > k[i]:
            last = max(last, x[i])
    return first < last


@njit(cache=True)
def fit_probit(x, k, n):
    """Return a, b and the status of the most likely line, by Newton's method.

    The log-likelihood is concave, so its maximum is the only stationary point. For a decreasing
    line it may have none: the steps then grow until the second derivatives vanish.
    """
    if not is_finite(x, k, n):
        return np.nan, np.nan, NOT_FINITE
    a, b = 0.0, 0.0
    for _ in range(MOST_STEPS):
        ga = gb = haa = hab = hbb = 0.0
        for i in range(x.size):
            z = a + b * x[i]
            up, down = _inverse_mills(z), _inverse_mills(-z)
            slope = k[i] * up - (n[i] - k[i]) * down
            bend = k[i] * up * (z + up) + (n[i] - k[i]) * down * (down - z)
            ga, gb = ga + slope, gb + slope * x[i]
            haa, hab, hbb = haa + bend, hab + bend * x[i], hbb + bend * x[i] * x[i]
        det = haa * hbb - hab * hab
        if not det > 0.0:  # the levels are equal within rounding error
            return np.nan, np.nan, NOT_FINITE
        da, db = (hbb * ga - hab * gb) / det, (haa * gb - hab * ga) / det
        a, b = a + da, b + db
        if abs(da) <= SETTLED * (1.0 + abs(a)) and abs(db) <= SETTLED * (1.0 + abs(b)):
            break
    return a, b, FITTED if b > 0.0 else NOT_FINITE


@njit(cache=True)
def fit_many(x, k, n, lines):
    """Fit a line to each row of counts.

    Parameters
    ----------
    x : array, shape (m,)
    k, n : array, shape (r, m)
    lines : array, shape (r, 2)
        Filled with a and b; NaN where there is no finite line.
    """
    for row in range(k.shape[0]):
        a, b, status = fit_probit(x, k[row], n[row])
        lines[row, 0], lines[row, 1] = (a, b) if status == FITTED else (np.nan, np.nan)
