"""Lognormal fragility by maximum likelihood, jitted: a normal distribution of censored values.

Never raises; numpy and numba only. Read `fit_censored`; `solver.studies.fragility` explains it.

Letters:
    y      logarithm of a capacity, or of the intensity up to which it is not reached
    a, b   mean / deviation and 1 / deviation, in which the log-likelihood is concave (Olsen 1978,
           Econometrica 46, 1211-1215)
    haa, hab, hbb   negative second derivatives of the log-likelihood
"""

import math

import numpy as np
from numba import njit

from solver.kernels.compiler import KEPT

FITTED = 0
NOT_FINITE = 1
"""Fewer than two different capacities are known."""

MOST_STEPS = 100
SETTLED = 1e-12
ROOT_HALF = math.sqrt(0.5)
ROOT_TWO_PI = math.sqrt(2.0 * math.pi)
# Beyond this Phi(-z) < 1e-290: the ratio phi / Phi is replaced by its asymptote.
FAR = 36.0


@njit(cache=KEPT)
def normal_cdf(z):
    """Standard normal distribution function, accurate in both tails."""
    return 0.5 * math.erfc(-z * ROOT_HALF)


@njit(cache=KEPT)
def inverse_mills(z):
    """Return phi(z) / Phi(z)."""
    if z < -FAR:
        return -z
    return math.exp(-0.5 * z * z) / (ROOT_TWO_PI * normal_cdf(z))


@njit(cache=KEPT)
def fit_censored(y, is_censored):
    """Return mean, deviation, standard errors of both, and the status of the most likely normal.

    The error of the deviation is that of its logarithm. By Newton's method on values reduced by
    their known ones.
    """
    known, shift, spread = 0, 0.0, 0.0
    for i in range(y.size):
        if not is_censored[i]:
            known += 1
            shift += y[i]
    if known < 2:
        return np.nan, np.nan, np.nan, np.nan, NOT_FINITE
    shift /= known
    for i in range(y.size):
        if not is_censored[i]:
            spread += (y[i] - shift) ** 2
    spread = math.sqrt(spread / known)
    if not spread > SETTLED * (1.0 + abs(shift)):
        return np.nan, np.nan, np.nan, np.nan, NOT_FINITE
    a, b, haa, hab, hbb = 0.0, 1.0, 0.0, 0.0, 0.0
    for _ in range(MOST_STEPS):
        ga, gb, haa, hab, hbb = 0.0, known / b, 0.0, 0.0, known / (b * b)
        for i in range(y.size):
            v = (y[i] - shift) / spread
            if is_censored[i]:
                z = a - b * v
                slope = inverse_mills(z)
                bend = slope * (z + slope)
                ga, gb = ga + slope, gb - v * slope
            else:
                bend = 1.0
                ga, gb = ga + b * v - a, gb - v * (b * v - a)
            haa, hab, hbb = haa + bend, hab - bend * v, hbb + bend * v * v
        det = haa * hbb - hab * hab
        da, db = (hbb * ga - hab * gb) / det, (haa * gb - hab * ga) / det
        share = 1.0 if db > -0.5 * b else -0.5 * b / db  # keeps the deviation positive
        a, b = a + share * da, b + share * db
        if abs(da) <= SETTLED * (1.0 + abs(a)) and abs(db) <= SETTLED * (1.0 + abs(b)):
            break
    # Of the mean a / b and of -ln b, by the gradients (1 / b, -a / b^2) and (0, -1 / b).
    det = haa * hbb - hab * hab
    of_mean = (hbb + 2.0 * (a / b) * hab + (a / b) ** 2 * haa) / (b * b * det)
    of_log = haa / (b * b * det)
    return (
        shift + spread * a / b,
        spread / b,
        spread * math.sqrt(of_mean),
        math.sqrt(of_log),
        FITTED,
    )


@njit(cache=KEPT)
def _log_likelihood(y, is_censored, mean, b):
    total = 0.0
    for i in range(y.size):
        z = b * (y[i] - mean)
        if is_censored[i]:
            # ln Phi(-z) = ln phi(z) - ln of the inverse Mills ratio, which is finite far out.
            total += -0.5 * z * z - math.log(ROOT_TWO_PI) - math.log(inverse_mills(-z))
        else:
            total += math.log(b) - 0.5 * z * z - math.log(ROOT_TWO_PI)
    return total


@njit(cache=KEPT)
def log_likelihood_at(y, is_censored, mean, deviation):
    """Return the greatest log-likelihood of a mean, over deviations, from a first guess of them.

    Concave in b = 1 / deviation, by Newton's method. At least one value must be known.
    """
    b = 1.0 / deviation
    for _ in range(MOST_STEPS):
        g, h = 0.0, 0.0
        for i in range(y.size):
            v = y[i] - mean
            if is_censored[i]:
                slope = inverse_mills(-b * v)
                g, h = g - v * slope, h + v * v * slope * (slope - b * v)
            else:
                g, h = g + 1.0 / b - b * v * v, h + 1.0 / (b * b) + v * v
        step = max(g / h, -0.5 * b)
        b += step
        if abs(step) <= SETTLED * b:
            break
    return _log_likelihood(y, is_censored, mean, b)


@njit(cache=KEPT)
def fit_many(y, is_censored, mean, found):
    """Fit a normal distribution to each row, and compare its likelihood with that of a mean.

    Parameters
    ----------
    y, is_censored : array, shape (r, m)
    mean : float
    found : array, shape (r, 5)
        Filled with mean, deviation, their errors, and the deviance of `mean`: twice the log of the
        likelihood ratio. NaN where there is none.
    """
    for row in range(y.shape[0]):
        own, deviation, of_mean, of_log, status = fit_censored(y[row], is_censored[row])
        found[row, 0], found[row, 1] = own, deviation
        found[row, 2], found[row, 3], found[row, 4] = of_mean, of_log, np.nan
        if status == FITTED:
            best = _log_likelihood(y[row], is_censored[row], own, 1.0 / deviation)
            least = log_likelihood_at(y[row], is_censored[row], mean, deviation)
            found[row, 4] = 2.0 * (best - least)
