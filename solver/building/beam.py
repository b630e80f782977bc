"""Modes of uniform buildings: a beam in shear and bending, or equal stories with lumped floors.

Contains dimensionless shapes only: no periods in seconds, no damping, no motions.
Read `beam_modes` first; `solver.building.structure` assigns periods to the modes.

A shear beam and a flexural beam of equal height deflect together, like a frame and a wall tied at
every floor (Miranda, J. Struct. Eng. 125 (1999) 417-425; Miranda and Taghavi, J. Struct. Eng. 131
(2005) 203-211, doi:10.1061/(ASCE)0733-9445(2005)131:2(203)). With x = height / H and the lateral
stiffness ratio alpha0 = H sqrt(GA / EI), a mode phi(x) of circular frequency omega satisfies

    phi'''' - alpha0^2 phi'' = lambda phi,   lambda = m H^4 omega^2 / EI
    phi = phi' = 0 at x = 0;   phi'' = phi''' - alpha0^2 phi' = 0 at x = 1
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from solver.model import Floats, InputError

MOST_ALPHA0 = 1000.0
"""Largest finite lateral stiffness ratio; infinity is the shear beam."""

MOST_STORIES = 100

_HALVINGS = 60


@dataclass(frozen=True, slots=True, kw_only=True)
class Modes:
    """Dimensionless modes, the longest period first.

    Attributes
    ----------
    period_ratios : array, shape (n,)
        Period of each mode / period of the first.
    factors : array, shape (n, m)
        Participation factor times mode shape, Gamma phi, of each mode at each of m heights. The sum
        over all modes is 1 above the base.
    """

    period_ratios: Floats
    factors: Floats


def beam_modes(alpha0: float, count: int, heights: ArrayLike = (1.0,)) -> Modes:
    """Return the first modes of a uniform cantilever in shear and bending.

    With gamma and beta = sqrt(gamma^2 + alpha0^2), lambda = gamma^2 beta^2, the shape is
    sin(gamma x) - (gamma / beta) sinh(beta x) + eta (cosh(beta x) - cos(gamma x)), and gamma is a
    root of (g = gamma, b = beta)

        2 g^2 b^2 + (2 g^2 b^2 + alpha0^4) cos g cosh b + alpha0^2 g b sin g sinh b = 0,

    one in each of ((n - 1) pi, n pi).

    Parameters
    ----------
    alpha0 : float
        Lateral stiffness ratio: 0 for bending only, infinity for shear only. Common values: walls
        0 to 2, walls with frames 2 to 6, moment frames 5 to 20 (Miranda and Reyes, J. Struct. Eng.
        128 (2002) 238-246).
    count : int
        Number of modes, >= 1.
    heights : array_like, shape (m,)
        Heights / height of the building, in [0, 1].

    Raises
    ------
    InputError
    """
    _check_alpha0(alpha0)
    x = np.asarray(heights, dtype=np.float64)
    if math.isinf(alpha0):
        gamma = (np.arange(count) + 0.5) * math.pi
        sines: Floats = np.sin(gamma[:, None] * x) * (2.0 / gamma)[:, None]
        return Modes(period_ratios=gamma[0] / gamma, factors=sines)
    gamma = _roots(alpha0, count)
    beta = np.hypot(gamma, alpha0)
    eta, low, high = _weights(gamma, beta)
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

    Parameters
    ----------
    alpha0 : float
        As in `beam_modes`.
    stories : int
        From 1 to 100.

    Raises
    ------
    InputError
    """
    _check_alpha0(alpha0)
    if not 1 <= stories <= MOST_STORIES:
        raise InputError(
            f"stories: found {stories}; give a whole number from 1 to {MOST_STORIES}, 0 for a beam"
        )
    squares, shapes = np.linalg.eigh(floor_stiffness(alpha0, stories))
    factors = shapes.sum(axis=0) * shapes[-1]
    return Modes(period_ratios=np.sqrt(squares[0] / squares), factors=factors[:, None])


def floor_stiffness(alpha0: float, stories: int) -> Floats:
    """Return the lateral stiffness matrix of the floors of equal stories, up to a factor.

    Shape (stories, stories), the lowest floor first; EI = H = 1, or GA = 1 if alpha0 is infinite.
    It is the sum of the stiffness matrices of both beams.
    """
    x = np.arange(1, stories + 1) / stories
    shear = stories * (2.0 * np.eye(stories) - np.eye(stories, k=1) - np.eye(stories, k=-1))
    shear[-1, -1] = stories  # the roof has no story above
    if math.isinf(alpha0):
        return shear
    near, far = np.minimum.outer(x, x), np.maximum.outer(x, x)
    bending = np.linalg.inv(near**2 * (3.0 * far - near) / 6.0)
    return np.asarray(bending + alpha0**2 * shear)


def _check_alpha0(alpha0: float) -> None:
    if not (0.0 <= alpha0 <= MOST_ALPHA0 or alpha0 == math.inf):
        raise InputError(
            f"lateral stiffness ratio: found {alpha0}; give 0 to {MOST_ALPHA0:g}, or infinity"
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
    """Coefficients eta of -cos(gamma x), and those of exp(-beta x) and exp(-beta (1 - x)).

    The hyperbolic part of a shape is written with exponentials that decay from either end: the
    difference of sinh and cosh would lose all digits for beta above 36.
    """
    sine, cosine, sech = np.sin(gamma), np.cos(gamma), _sech(beta)
    whole = beta**2 + gamma**2 * cosine * sech
    eta = (gamma**2 * sine * sech + gamma * beta * np.tanh(beta)) / whole
    rest = gamma**2 * sine - gamma * beta * np.exp(-beta) - gamma**3 * cosine / beta
    high = rest / (whole * (1.0 + np.exp(-2.0 * beta)))
    return eta, 0.5 * (eta + gamma / beta), high


def _squared(gamma: Floats, beta: Floats, eta: Floats, low: Floats, high: Floats) -> Floats:
    """Integral of phi^2 over x."""
    decay = np.exp(-beta)
    waves = 0.5 * (1.0 + eta**2) - (1.0 - eta**2) * np.sin(2.0 * gamma) / (4.0 * gamma)
    waves -= eta * np.sin(gamma) ** 2 / gamma
    ends = (low**2 + high**2) * (1.0 - decay**2) / (2.0 * beta) + 2.0 * low * high * decay
    turn = np.exp(1j * gamma)
    first = (1.0 - turn * decay) / (beta - 1j * gamma)
    last = (turn - decay) / (beta + 1j * gamma)
    crossed = low * (first.imag - eta * first.real) + high * (last.imag - eta * last.real)
    return np.asarray(waves + ends + 2.0 * crossed)
