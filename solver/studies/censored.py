"""Normal distributions of censored values, by maximum likelihood. Read `fit`, then `deviance`.

Each row of an array is a sample. `solver.studies.fragility` explains the results.

Letters:
    y      values, or the bounds up to which the censored ones are not reached
    a, b   mean / deviation and 1 / deviation, in which the log-likelihood is concave (Olsen 1978,
           Econometrica 46, 1211-1215)
    haa, hab, hbb   negative second derivatives of the log-likelihood
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.special import erfcx, log_ndtr

from solver.model import Floats

MOST_STEPS = 100
SETTLED = 1e-12


@dataclass(frozen=True, slots=True)
class Normals:
    """The most likely normal of each sample; NaN with fewer than two different known values."""

    mean: Floats
    deviation: Floats
    of_mean: Floats  # its standard error
    of_log: Floats  # standard error of the logarithm of the deviation


def inverse_mills(z: Floats) -> Floats:
    """Return phi(z) / Phi(z)."""
    return np.asarray(math.sqrt(2.0 / math.pi) / erfcx(-z * math.sqrt(0.5)))


@np.errstate(invalid="ignore", divide="ignore")
def fit(y: Floats, is_censored: NDArray[np.bool_]) -> Normals:
    """Fit a normal to each row, by Newton's method on values reduced by their known ones."""
    known = (~is_censored).sum(axis=1)
    shift = np.where(is_censored, 0.0, y).sum(axis=1) / known
    off = y - shift[:, None]
    spread = np.sqrt((np.where(is_censored, 0.0, off) ** 2).sum(axis=1) / known)
    spread = np.where(spread > SETTLED * (1.0 + np.abs(shift)), spread, np.nan)
    v = off / spread[:, None]
    a, b = np.zeros_like(shift), np.ones_like(shift)
    for _ in range(MOST_STEPS):
        z = a[:, None] - b[:, None] * v
        slope = np.where(is_censored, inverse_mills(z), -z)
        bend = np.where(is_censored, slope * (z + slope), 1.0)
        ga, gb = slope.sum(axis=1), known / b - (v * slope).sum(axis=1)
        haa, hab = bend.sum(axis=1), -(bend * v).sum(axis=1)
        hbb = known / b**2 + (bend * v * v).sum(axis=1)
        det = haa * hbb - hab * hab
        da, db = (hbb * ga - hab * gb) / det, (haa * gb - hab * ga) / det
        share = np.where(db > -0.5 * b, 1.0, -0.5 * b / db)  # keeps the deviation positive
        a, b = a + share * da, b + share * db
        moves = (np.abs(da) > SETTLED * (1.0 + np.abs(a))) | (np.abs(db) > SETTLED * (1.0 + b))
        if not moves.any():
            break
    # Of the mean a / b and of -ln b, by the gradients (1 / b, -a / b^2) and (0, -1 / b).
    of_mean = (hbb + 2.0 * (a / b) * hab + (a / b) ** 2 * haa) / (b * b * det)
    return Normals(
        mean=shift + spread * a / b,
        deviation=spread / b,
        of_mean=spread * np.sqrt(of_mean),
        of_log=np.sqrt(haa / (b * b * det)),
    )


def log_likelihood(y: Floats, is_censored: NDArray[np.bool_], mean: Floats, b: Floats) -> Floats:
    """Return the logarithm of the likelihood of each row."""
    z, b = b[:, None] * (y - mean[:, None]), b[:, None]
    density = np.log(b / math.sqrt(2.0 * math.pi)) - 0.5 * z * z
    return np.asarray(np.where(is_censored, log_ndtr(-z), density).sum(axis=1))


def deviance(y: Floats, is_censored: NDArray[np.bool_], mean: float, fitted: Normals) -> Floats:
    """Return twice the log of the likelihood ratio of the fitted normals and those of a mean.

    The latter are the most likely ones: concave in b = 1 / deviation, by Newton's method.
    """
    v, b = y - mean, 1.0 / fitted.deviation
    for _ in range(MOST_STEPS):
        z = b[:, None] * v
        slope = inverse_mills(-z)
        g = np.where(is_censored, -v * slope, 1.0 / b[:, None] - z * v)
        h = np.where(is_censored, v * v * slope * (slope - z), 1.0 / b[:, None] ** 2 + v * v)
        step = np.maximum(g.sum(axis=1) / h.sum(axis=1), -0.5 * b)
        b = b + step
        if not (np.abs(step) > SETTLED * b).any():
            break
    best = log_likelihood(y, is_censored, fitted.mean, 1.0 / fitted.deviation)
    return 2.0 * (best - log_likelihood(y, is_censored, np.full_like(b, mean), b))
