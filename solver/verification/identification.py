"""Period, damping and stiffness ratio of a building from motions of its ground and its floors.

A search used for verification only: it shows how accurate `solver.building.roof` can be.
Read `identify`.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import lru_cache
from itertools import product
from typing import NamedTuple

import numpy as np

from solver.building.beam import MOST_ALPHA0, Modes, beam_modes
from solver.building.roof import absolute_accelerations
from solver.building.structure import MOST_DAMPING, Building, building_of_periods
from solver.model import Floats
from solver.verification.study import best_of, unexplained

MODES = 12
"""Modes of the beam; further modes do not change the floor motions noticeably."""

DAMPINGS, ALPHAS = (0.02, 0.05, 0.12), (0.0, 2.0, 6.0, 15.0, 40.0)
"""The coarse grid; periods are 4 % apart, less than the width of a resonance peak."""

_PERIOD_STEP, _LAST_STEP = 0.04, 1e-4

_Point = tuple[float, float, float]


class Identified(NamedTuple):
    """The uniform beam whose floor motions fit the recorded ones best.

    `unexplained` is the sum of squares of the difference over that of the recorded motions.
    """

    period_s: float
    damping: float
    alpha0: float
    unexplained: float

    def building(self) -> Building:
        """Return the beam."""
        return building_of_periods([self.period_s], damping=[self.damping], alpha0=self.alpha0)


def identify(
    ground_mps2: Floats,
    dt_s: float,
    heights: tuple[float, ...],
    floors_mps2: Floats,
    periods_s: tuple[float, float],
) -> Identified:
    """Return the beam with the least sum of squares: grid search, then shrinking steps.

    Parameters
    ----------
    ground_mps2, floors_mps2 : array, shape (n,) and (n, m)
        Recorded in the same direction, over the same time.
    heights : tuple of float, m of them
        Of the floors, relative to the height of the building.
    periods_s : pair of float
        Least and greatest first period of the grid [s].
    """

    def misfit(point: _Point) -> float:
        period_s, damping, alpha0 = (float(v) for v in _plain(point))
        modes = _beam(alpha0, heights)
        zeta = np.full(MODES, damping)
        responses = absolute_accelerations(ground_mps2, dt_s, period_s * modes.period_ratios, zeta)
        rigid = 1.0 - modes.factors.sum(axis=0)
        return unexplained(responses @ modes.factors + ground_mps2[:, None] * rigid, floors_mps2)

    steps = int(np.log(periods_s[1] / periods_s[0]) / _PERIOD_STEP) + 2
    grid = product(np.log(np.geomspace(*periods_s, steps)), np.log(DAMPINGS), np.log1p(ALPHAS))
    least, best = _descend(misfit, *best_of(misfit, grid))
    return Identified(*_plain(best), least)


def _plain(point: _Point) -> _Point:
    """Return period, damping and ratio of a point of the search (logarithms), within bounds."""
    period, damping, alpha0 = np.exp(point)
    return (
        float(period),
        float(min(damping, MOST_DAMPING)),
        float(min(max(alpha0 - 1.0, 0.0), MOST_ALPHA0)),
    )


def _descend(
    misfit: Callable[[_Point], float], minimum: float, best: _Point
) -> tuple[float, _Point]:
    """Step to the best of the neighbors on each axis; halve the steps where none is better."""
    reach = np.array([_PERIOD_STEP / 2.0, 0.4, 0.4])
    while reach[0] > _LAST_STEP:
        around: list[_Point] = [
            tuple(best + sign * move) for move in np.diag(reach) for sign in (1.0, -1.0)
        ]
        nearby, point = best_of(misfit, around)
        if nearby < minimum:
            minimum, best = nearby, point
        else:
            reach /= 2.0
    return minimum, best


@lru_cache(maxsize=256)
def _beam(alpha0: float, heights: tuple[float, ...]) -> Modes:
    return beam_modes(alpha0, MODES, heights)
