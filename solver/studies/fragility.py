"""Lognormal fragilities of the capacities of motions, with their confidence.

Capacities of 0.2, 0.4 and 0.8 g have a median of 0.4 g and a beta of ln 2 = 0.69.

Runs nothing and reads no files. The intervals of uncensored capacities are exact: Student's t of
the logarithm of the median, chi-square of beta. Normals of censored values are fitted by maximum
likelihood (`fit_normals`). Read `fragility` first.

Letters, each row of an array a sample:
    y      values, or the bounds up to which the censored ones are not reached
    a, b   mean / deviation and 1 / deviation, in which the log-likelihood is concave (Olsen 1978,
           Econometrica 46, 1211-1215)
    haa, hab, hbb   negative second derivatives of the log-likelihood
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray
from scipy.special import erfcx, gammaincinv, log_ndtr, ndtr, stdtrit

from solver.model import Floats
from solver.studies.capacity import Capacities

Flags = NDArray[np.bool_]

CONFIDENCE = 0.90
LILLIEFORS_REPEATS = 20_000
"""Samples of the p-value of the goodness of fit."""

LEVEL = 0.05
"""Probability that the band of the goodness of fit leaves out a sample that is lognormal."""

REPEATS = 1000
"""Samples drawn where a capacity is censored."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Lognormal:
    """Probability of exceedance Phi(ln(x / theta) / beta); NaN if the capacities determine none."""

    theta: float
    beta: float

    @property
    def is_known(self) -> bool:
        """Whether the capacities determine it."""
        return math.isfinite(self.theta)

    def at(self, intensity: Floats) -> Floats:
        """Return the probability of exceedance at intensities above 0, of any shape."""
        return np.asarray(ndtr(np.log(np.asarray(intensity) / self.theta) / self.beta))


UNKNOWN = Lognormal(theta=math.nan, beta=math.nan)


@dataclass(frozen=True, slots=True, kw_only=True)
class Fragility:
    """A fragility fitted to capacities, with data points at levels and its confidence.

    Attributes
    ----------
    levels : array, shape (m,)
        Intensities.
    exceeded, counted : array of int, shape (m,)
        Exceedances, and number of motions counted: for plots, not fitted.
    censored : int
        Runs excluded from the counts because they have no value and are declared censored.
    capacities : Capacities
        The capacities that are fitted.
    fitted : Lognormal
    theta_range, beta_range : tuple of float
        Confidence interval of `CONFIDENCE`; NaN if not determined.
    p_value : float
        Of the goodness of fit (`lilliefors_p`); NaN with a censored capacity or fewer than four.
    critical : float
        Distance from the ranks of the capacities at which it is `LEVEL`; NaN where it is.
    """

    levels: Floats
    exceeded: NDArray[np.int64]
    counted: NDArray[np.int64]
    censored: int
    capacities: Capacities
    fitted: Lognormal
    theta_range: tuple[float, float]
    beta_range: tuple[float, float]
    p_value: float
    critical: float

    def __repr__(self) -> str:
        fit = f"median {self.fitted.theta:.4g}, dispersion {self.fitted.beta:.3g}"
        motions = f"{self.capacities.intensity.size} motions"
        return f"Fragility: {fit}, {motions}, {self.capacities.is_censored.sum()} censored"


Range = tuple[float, float]
UNKNOWN_RANGE = (math.nan, math.nan)


def fit_lognormal(capacities: Capacities) -> Lognormal:
    """Return the lognormal of known and censored capacities.

    Unknown with fewer than two different known capacities, or one of 0.
    """
    if not (capacities.intensity > 0.0).all():
        return UNKNOWN
    normal = fit_normals(np.log(capacities.intensity)[None], capacities.is_censored[None])
    mean, deviation = float(normal.mean[0]), float(normal.deviation[0])
    # Where none is censored, beta has the divisor n - 1, as method A of Porter, Kennedy and Bachman
    # 2007 (Earthquake Spectra 23, 471-489), which FEMA P-58 takes, and as the toolkit of OpenQuake
    # for incremental dynamic analyses (gemsciencetools.github.io/oq-vmtk): that of maximum
    # likelihood, with n, is 7 % less for seven motions. With a censored one it is that of maximum
    # likelihood (Baker 2015, Earthquake Spectra 31, 579-599), for which there is no such divisor.
    if not capacities.is_censored.any() and math.isfinite(deviation):
        deviation *= math.sqrt(capacities.intensity.size / (capacities.intensity.size - 1))
    return Lognormal(theta=math.exp(mean), beta=deviation)


def first_order_beta(median: float, around: tuple[float, float]) -> float:
    """Return the dispersion of a capacity due to one variable, by first-order second moment.

    Half the difference of the logarithms of the medians with the variable at one standard deviation
    below and above (`around`); where one of them is NaN, the difference between the other and the
    median; NaN if neither is known.
    """
    known = [theta for theta in around if math.isfinite(theta)]
    if len(known) == 2:
        return 0.5 * abs(math.log(known[1] / known[0]))
    return abs(math.log(known[0] / median)) if known else math.nan


def fragility(
    levels: Floats, exceeds: Flags, counts: Flags, capacities: Capacities, *, seed: int
) -> Fragility:
    """Fit a fragility to the capacities of a limit state, with its confidence.

    Where a capacity is censored the intervals follow from samples drawn from the fitted lognormal,
    censored at the same intensities: of the median by the likelihood ratio, whose bound is the
    quantile of the samples, of beta by its logarithm over its standard error.

    Parameters
    ----------
    levels : array, shape (m,)
        Intensities above 0.
    exceeds, counts : array of bool, shape (motions, m)
        Whether the limit state is exceeded, and whether the run is counted.
    """
    fitted = fit_lognormal(capacities)
    theta_range = beta_range = UNKNOWN_RANGE
    if fitted.is_known and capacities.is_censored.any():
        theta_range, beta_range = _drawn_ranges(capacities, fitted, seed)
    elif fitted.is_known:
        free = capacities.intensity.size - 1
        # The mean of n normal values over its standard error is Student's t with n - 1 degrees.
        far = float(stdtrit(free, TAILS[1])) * fitted.beta / math.sqrt(free + 1)
        theta_range = fitted.theta * math.exp(-far), fitted.theta * math.exp(far)
        # The sum of squares over the variance is chi-squared with as many: twice a gamma variable
        # of half the degrees of freedom.
        low, high = (
            fitted.beta * math.sqrt(free / (2.0 * gammaincinv(0.5 * free, 1.0 - t))) for t in TAILS
        )
        beta_range = low, high
    p_value, motions = math.nan, capacities.intensity.size
    if fitted.is_known and motions >= 4 and not capacities.is_censored.any():
        p_value = lilliefors_p(float(lilliefors(np.log(capacities.intensity))), motions)
    return Fragility(
        levels=levels,
        exceeded=(exceeds & counts).sum(axis=0).astype(np.int64),
        counted=counts.sum(axis=0).astype(np.int64),
        censored=int(counts.size - counts.sum()),
        capacities=capacities,
        fitted=fitted,
        theta_range=theta_range,
        beta_range=beta_range,
        p_value=p_value,
        critical=math.nan if math.isnan(p_value) else lilliefors_critical(motions),
    )


TAILS = (0.5 * (1.0 - CONFIDENCE), 0.5 * (1.0 + CONFIDENCE))


def _drawn_ranges(capacities: Capacities, fitted: Lognormal, seed: int) -> tuple[Range, Range]:
    """Return the intervals of theta and beta, and the number of samples without a lognormal."""
    from scipy.optimize import brentq  # slow to load, and studies mostly do without

    y, flags = np.log(capacities.intensity)[None], capacities.is_censored[None]
    mean = math.log(fitted.theta)
    drawn = mean + fitted.beta * np.random.default_rng(seed).standard_normal((REPEATS, y.size))
    ends = np.log(capacities.end)
    is_beyond, drawn = drawn > ends, np.minimum(drawn, ends)
    fits, observed = fit_normals(drawn, is_beyond), fit_normals(y, flags)
    deviances = deviance(drawn, is_beyond, mean, fits)
    bound = float(np.nanquantile(deviances, CONFIDENCE))
    pivots = (np.log(fits.deviation) - math.log(fitted.beta)) / fits.of_log
    low, high = np.nanquantile(pivots, TAILS)

    def end(step: float) -> float:
        def over(distance: float) -> float:
            return float(deviance(y, flags, mean + distance, observed)[0]) - bound

        near, far = 0.0, step
        # Doubled until the ends bracket the root, as `brentq` requires.
        while over(far) <= 0.0:
            near, far = far, 2.0 * far
        return math.exp(mean + brentq(over, near, far))

    of_mean, of_log = float(observed.of_mean[0]), float(observed.of_log[0])
    beta_range = fitted.beta * math.exp(-high * of_log), fitted.beta * math.exp(-low * of_log)
    return (end(-of_mean), end(of_mean)), beta_range


def lilliefors(values: Floats) -> Floats:
    """Return the greatest distance of values from the normal of their mean and deviation.

    Of the distribution functions (Lilliefors 1967, J. Am. Stat. Assoc. 62, 399-402).

    `values`: shape (..., n).
    """
    n = values.shape[-1]
    off = np.sort(values, axis=-1) - values.mean(axis=-1, keepdims=True)
    below = ndtr(off / values.std(axis=-1, ddof=1, keepdims=True))
    steps = np.arange(n) / n
    # The empirical distribution increases by 1 / n at each value; the distance is measured on both
    # sides of each step.
    return np.asarray(np.maximum(below - steps, steps + 1.0 / n - below).max(axis=-1))


def lilliefors_p(distance: float, motions: int) -> float:
    """Return the fraction of normal samples whose distance is as great, by simulation."""
    below = int(np.searchsorted(_drawn_distances(motions), distance))
    # The given sample is one more of them: no p-value is 0 (Davison and Hinkley 1997, 4.2).
    return (1 + LILLIEFORS_REPEATS - below) / (1 + LILLIEFORS_REPEATS)


def lilliefors_critical(motions: int) -> float:
    """Return the least distance whose p-value is at most `LEVEL`, by the same simulation."""
    allowed = math.floor(LEVEL * (1 + LILLIEFORS_REPEATS)) - 1
    return float(_drawn_distances(motions)[LILLIEFORS_REPEATS - allowed])


@lru_cache(maxsize=8)
def _drawn_distances(motions: int) -> Floats:
    """Return the distances of normal samples, increasing."""
    # A fixed seed: equal capacities have the same p-value in every study.
    drawn = np.random.default_rng(1967).standard_normal((LILLIEFORS_REPEATS, motions))
    return np.sort(lilliefors(drawn))


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
    # Uses the scaled error function: far below the mean, phi and Phi underflow, but their ratio
    # does not.
    return np.asarray(math.sqrt(2.0 / math.pi) / erfcx(-z * math.sqrt(0.5)))


@np.errstate(invalid="ignore", divide="ignore")
def fit_normals(y: Floats, is_censored: Flags) -> Normals:
    """Fit a normal to each row, by Newton's method on values reduced by their known ones."""
    known = (~is_censored).sum(axis=1)
    shift = np.where(is_censored, 0.0, y).sum(axis=1) / known
    off = y - shift[:, None]
    spread = np.sqrt((np.where(is_censored, 0.0, off) ** 2).sum(axis=1) / known)
    # Known values that are all equal do not determine a deviation.
    spread = np.where(spread > SETTLED * (1.0 + np.abs(shift)), spread, np.nan)
    v = off / spread[:, None]
    # The iteration starts from the normal of the known values alone.
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


def log_likelihood(y: Floats, is_censored: Flags, mean: Floats, b: Floats) -> Floats:
    """Return the logarithm of the likelihood of each row."""
    z, b = b[:, None] * (y - mean[:, None]), b[:, None]
    density = np.log(b / math.sqrt(2.0 * math.pi)) - 0.5 * z * z
    return np.asarray(np.where(is_censored, log_ndtr(-z), density).sum(axis=1))


def deviance(y: Floats, is_censored: Flags, mean: float, fitted: Normals) -> Floats:
    """Return twice the log of the likelihood ratio of the fitted normals and those of a mean."""
    # The latter are the most likely ones: concave in b = 1 / deviation, by Newton's method.
    v, b = y - mean, 1.0 / fitted.deviation
    for _ in range(MOST_STEPS):
        z = b[:, None] * v
        slope = inverse_mills(-z)
        g = np.where(is_censored, -v * slope, 1.0 / b[:, None] - z * v)
        h = np.where(is_censored, v * v * slope * (slope - z), 1.0 / b[:, None] ** 2 + v * v)
        # At most half of b is subtracted, so that it stays positive.
        step = np.maximum(g.sum(axis=1) / h.sum(axis=1), -0.5 * b)
        b = b + step
        if not (np.abs(step) > SETTLED * b).any():
            break
    best = log_likelihood(y, is_censored, fitted.mean, 1.0 / fitted.deviation)
    return 2.0 * (best - log_likelihood(y, is_censored, np.full_like(b, mean), b))
