"""Elastic buildings of a few modes, as a beam or as equal stories.

A building of one story is an oscillator; one of many nears a cantilever in shear and bending.

Contains no motions (`solver.building.roof`). Read `building_of_periods` first.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import ArrayLike

from solver.errors import InputError, raise_any
from solver.model import Floats
from solver.records.record import read_only
from solver.spaces import NO_BREAK, spaced

# Largest finite lateral stiffness ratio; infinity is the shear beam.
MOST_ALPHA0 = 1000.0

MOST_STORIES = 100

# pi / 2^60 is below the rounding error of any root.
_HALVINGS = 60


@dataclass(frozen=True, slots=True, kw_only=True)
class Modes:
    """Dimensionless modes, the longest period first."""

    period_ratios: Floats  # period of each mode / period of the first, shape (n,)
    # Participation factor times mode shape, Gamma phi, at each of m heights, shape (n, m). The sum
    # over all modes is 1 above the base.
    factors: Floats


def beam_modes(alpha0: float, count: int, heights: ArrayLike = (1.0,)) -> Modes:
    """Return the first modes of a uniform cantilever in shear and bending.

    With gamma and beta = sqrt(gamma^2 + alpha0^2), lambda = gamma^2 beta^2, the shape is
    sin(gamma x) - (gamma / beta) sinh(beta x) + eta (cosh(beta x) - cos(gamma x)), and gamma is a
    root of (g = gamma, b = beta)

        2 g^2 b^2 + (2 g^2 b^2 + alpha0^4) cos g cosh b + alpha0^2 g b sin g sinh b = 0,

    one in each of ((n - 1) pi, n pi). alpha0 is the lateral stiffness ratio: 0 for bending only,
    infinity for shear only. Common values: walls 0 to 2, walls with frames 2 to 6, moment frames 5
    to 20 (Miranda and Reyes, J. Struct. Eng. 128 (2002) 238-246). Heights are relative to that of
    the building.
    """
    _check_alpha0(alpha0)
    x = np.asarray(heights, dtype=np.float64)
    # Shear beam: phi = sin(gamma x), gamma = (n - 1/2) pi, Gamma = 2 / gamma.
    if math.isinf(alpha0):
        gamma = (np.arange(count) + 0.5) * math.pi
        sines: Floats = np.sin(gamma[:, None] * x) * (2.0 / gamma)[:, None]
        return Modes(period_ratios=gamma[0] / gamma, factors=sines)
    gamma = _roots(alpha0, count)
    beta = np.hypot(gamma, alpha0)
    eta, low, high = _weights(gamma, beta)
    # Gamma = integral(phi) / integral(phi^2), for uniform mass.
    below = (gamma**2 + beta**2) / (gamma * beta**2)  # integral of phi, from its equation
    gain = below / _squared(gamma, beta, eta, low, high)
    wave = gamma[:, None] * x
    shape = np.sin(wave) - eta[:, None] * np.cos(wave)
    shape += low[:, None] * np.exp(-beta[:, None] * x)
    shape += high[:, None] * np.exp(-beta[:, None] * (1.0 - x))
    return Modes(period_ratios=gamma[0] * beta[0] / (gamma * beta), factors=gain[:, None] * shape)


def story_modes(alpha0: float, stories: int) -> Modes:
    """Return all modes, at the roof, of a building of equal stories with equal floor masses.

    The floors are tied to a flexural and a shear beam, which are massless between floors. One
    story is a single-degree-of-freedom oscillator; with many stories the modes approach those of
    `beam_modes`.
    """
    _check_alpha0(alpha0)
    if not 1 <= stories <= MOST_STORIES:
        raise InputError(
            f"stories: found {stories}; use a whole number from 1 to {MOST_STORIES}, 0 for a beam"
        )
    # Equal floor masses: eigenvectors of K itself, of length 1, so Gamma = sum of phi.
    squares, shapes = np.linalg.eigh(floor_stiffness(alpha0, stories))
    # An eigenvector may have either sign, which cancels in this product.
    factors = shapes.sum(axis=0) * shapes[-1]
    return Modes(period_ratios=np.sqrt(squares[0] / squares), factors=factors[:, None])


def floor_stiffness(alpha0: float, stories: int) -> Floats:
    """Return the lateral stiffness matrix of the floors of equal stories, up to a factor.

    Shape (stories, stories), the lowest floor first; EI = H = 1, or GA = 1 if alpha0 is infinite.
    It is the sum of the stiffness matrices of both beams.
    """
    x = np.arange(1, stories + 1) / stories
    # GA / h of each story, with h = 1 / stories and GA = 1.
    shear = stories * (2.0 * np.eye(stories) - np.eye(stories, k=1) - np.eye(stories, k=-1))
    shear[-1, -1] = stories  # the roof has no story above
    if math.isinf(alpha0):
        return shear
    near, far = np.minimum.outer(x, x), np.maximum.outer(x, x)
    # Inverse of the flexibility: x^2 (3 a - x) / 6 EI at x under a unit load at a >= x.
    bending = np.linalg.inv(near**2 * (3.0 * far - near) / 6.0)
    # alpha0^2 = GA H^2 / EI, which is GA for EI = H = 1.
    return np.asarray(bending + alpha0**2 * shear)


def _check_alpha0(alpha0: float) -> None:
    if not (0.0 <= alpha0 <= MOST_ALPHA0 or alpha0 == math.inf):
        raise InputError(
            f"lateral stiffness ratio: found {alpha0}; use 0 to {MOST_ALPHA0:g}, or infinity"
        )


def _roots(alpha0: float, count: int) -> Floats:
    """Roots gamma by bisection: at n pi, `_frequency_equation` has the sign of (-1)^n."""
    n = np.arange(1, count + 1)
    low, high, sign = (n - 1) * math.pi, n * math.pi, (-1.0) ** n
    for _ in range(_HALVINGS):
        middle = 0.5 * (low + high)
        beyond = _frequency_equation(middle, alpha0) * sign > 0.0
        low, high = np.where(beyond, low, middle), np.where(beyond, middle, high)
    return np.asarray(0.5 * (low + high))


def _frequency_equation(gamma: Floats, alpha0: float) -> Floats:
    """Left side of the frequency equation / cosh(beta)."""
    # Divided by cosh(beta), which overflows for the stiffest ratios.
    beta = np.hypot(gamma, alpha0)
    product = gamma * beta
    squared = 2.0 * product**2
    return np.asarray(
        squared * _sech(beta)
        + (squared + alpha0**4) * np.cos(gamma)
        + alpha0**2 * product * np.sin(gamma) * np.tanh(beta)
    )


def _sech(beta: Floats) -> Floats:
    return np.asarray(2.0 * np.exp(-beta) / (1.0 + np.exp(-2.0 * beta)))


def _weights(gamma: Floats, beta: Floats) -> tuple[Floats, Floats, Floats]:
    """Coefficients eta of -cos(gamma x), and those of exp(-beta x) and exp(-beta (1 - x))."""
    # The hyperbolic part of a shape is written with exponentials that decay from either end: the
    # difference of sinh and cosh would lose all digits for beta above 36.
    sine, cosine, sech = np.sin(gamma), np.cos(gamma), _sech(beta)
    total = beta**2 + gamma**2 * cosine * sech
    eta = (gamma**2 * sine * sech + gamma * beta * np.tanh(beta)) / total
    remainder = gamma**2 * sine - gamma * beta * np.exp(-beta) - gamma**3 * cosine / beta
    high = remainder / (total * (1.0 + np.exp(-2.0 * beta)))
    return eta, 0.5 * (eta + gamma / beta), high


def _squared(gamma: Floats, beta: Floats, eta: Floats, low: Floats, high: Floats) -> Floats:
    """Integral of phi^2 over x."""
    decay = np.exp(-beta)
    # Products of the sine part with itself, of the exponentials, and of one with the other.
    waves = 0.5 * (1.0 + eta**2) - (1.0 - eta**2) * np.sin(2.0 * gamma) / (4.0 * gamma)
    waves -= eta * np.sin(gamma) ** 2 / gamma
    ends = (low**2 + high**2) * (1.0 - decay**2) / (2.0 * beta) + 2.0 * low * high * decay
    turn = np.exp(1j * gamma)
    first = (1.0 - turn * decay) / (beta - 1j * gamma)
    last = (turn - decay) / (beta + 1j * gamma)
    crossed = low * (first.imag - eta * first.real) + high * (last.imag - eta * last.real)
    return np.asarray(waves + ends + 2.0 * crossed)


# Number of modes of a continuous beam; the roof factors of higher modes are below 0.04.
BEAM_MODES = 40

LEAST_DAMPING, MOST_DAMPING = 0.01, 0.5
MOST_PERIOD_S = 10.0


@dataclass(frozen=True, slots=True, kw_only=True)
class Building:
    """An elastic building, as needed for the motion of its roof; arrays are read-only.

    Attributes
    ----------
    periods_s, damping : array, shape (n,)
        Period [s] and fraction of critical damping of each mode, the longest period first.
    roof_factors : array, shape (n,)
        Participation factor times mode shape at the roof, Gamma phi, of each mode.
    words : str
        Description for the reader.
    """

    periods_s: Floats
    damping: Floats
    roof_factors: Floats
    words: str

    def __repr__(self) -> str:
        return spaced(f"Building: {self.words}")


def building_of_periods(
    periods_s: Sequence[float],
    *,
    damping: Sequence[float] = (0.05,),
    alpha0: float = math.inf,
    stories: int = 0,
) -> Building:
    """Return a uniform building whose first modes have the given periods.

    The roof factors, and the ratios of the periods of higher modes to the last one given, are those
    of a beam in shear and bending (Miranda and Taghavi, J. Struct. Eng. 131 (2005) 203-211).
    With few stories the lumped floor masses matter: one story has a roof
    factor of 1, whereas the first mode of a continuous beam has up to 1.57.

    Parameters
    ----------
    periods_s : sequence of float
        Periods of the first mode or modes [s], the longest first.
    damping : sequence of float
        Fraction of critical damping of the first modes; the last value applies to all others.
    alpha0 : float
        Lateral stiffness ratio H sqrt(GA/EI); infinity: shear building.
    stories : int
        Number of equal stories with equal floor masses; 0 for a continuous beam.

    Returns
    -------
    Building

    Raises
    ------
    InputError
        For a value out of range.

    Examples
    --------
    >>> building_of_periods([0.5, 0.16], damping=[0.03, 0.05], stories=4)
    Building: 4 equal stories, in shear; period 0.5, 0.16 s; damping 3, 5% of critical
    """
    _check_periods(periods_s, damping)
    modes = story_modes(alpha0, stories) if stories else beam_modes(alpha0, BEAM_MODES)
    ratios = modes.period_ratios
    lowest = np.array(periods_s[: ratios.size], dtype=np.float64)
    # The periods of higher modes are scaled from the last period given, not from the first.
    periods = np.append(lowest, lowest[-1] * ratios[lowest.size :] / ratios[lowest.size - 1])
    zeta = np.full(periods.size, float(damping[-1]))
    first = np.array(damping[: periods.size], dtype=np.float64)
    zeta[: first.size] = first
    return Building(
        periods_s=read_only(periods),
        damping=read_only(zeta),
        roof_factors=read_only(modes.factors[:, 0]),
        words=_words(lowest, damping, alpha0, stories),
    )


def building_of_modes(
    periods_s: Sequence[float], damping: Sequence[float], roof_factors: Sequence[float]
) -> Building:
    """Return a building from modes given by the user's own analysis, as `Building` has them."""
    _check_periods(periods_s, damping)
    counts = {len(periods_s), len(damping), len(roof_factors)}
    if len(counts) > 1 or not np.isfinite(roof_factors).all():
        raise InputError("modes: use a period, a damping and a roof factor for each")
    total = sum(roof_factors)
    return Building(
        periods_s=read_only(np.array(periods_s)),
        damping=read_only(np.array(damping)),
        roof_factors=read_only(np.array(roof_factors)),
        words=f"{len(periods_s)} modes as given, sum of roof factors {total:.3f}",
    )


def _words(lowest: Floats, damping: Sequence[float], alpha0: float, stories: int) -> str:
    """Describe a uniform building."""
    periods = ", ".join(f"{period:.3g}" for period in lowest)
    ratios = ", ".join(f"{100.0 * value:.3g}" for value in damping)
    if stories == 1:
        kind = "one story"
    else:
        kind = "uniform" if stories == 0 else f"{stories} equal stories"
        kind += ", in shear" if math.isinf(alpha0) else ""
        kind += ", in bending" if alpha0 == 0.0 else ""
        if 0.0 < alpha0 < math.inf:
            kind += f", in shear and bending with a lateral stiffness ratio of {alpha0:.3g}"
    return f"{kind}; period {periods}{NO_BREAK}s; damping {ratios}% of critical"


def _check_periods(periods_s: Sequence[float], damping: Sequence[float]) -> None:
    problems = []
    if not len(periods_s) or not len(damping):
        problems.append("building: use at least one period and one damping")
    for period in periods_s:
        if not 0.0 < period <= MOST_PERIOD_S:
            problems.append(f"period: found {period} s; use above 0 to {MOST_PERIOD_S:g} s")
    if any(after > before for before, after in pairwise(periods_s)):
        problems.append("periods: use the longest first")
    for value in damping:
        if not LEAST_DAMPING <= value <= MOST_DAMPING:
            problems.append(
                f"damping: found {value}; use a fraction of critical from {LEAST_DAMPING:g} to "
                f"{MOST_DAMPING:g}"
            )
    raise_any(problems)
