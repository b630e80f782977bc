"""Mean PRD over a grid of friction and slope, which `report.web.views` draws.

Of arrays with 0.35 and 0.50 they are 0.27, 0.33 … 0.69, the nearest replaced by that of the array.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import partial
from itertools import chain, product

import numpy as np

from report.assessment.assessment import Assessment
from report.assessment.design.arrays import ArrayAssessment
from report.assessment.design.friction import with_mu
from report.project.model.array import Array
from solver.model import Floats, Scene, SlideResult, Status
from solver.sliding import one_axis, two_axes

# Points of the grid over friction and slope.
N_MUS, N_SLOPES = 8, 6

# Tolerance of the runs on the grid, relative to the PRD: it is drawn, not printed.
TOLERANCE = 1e-3


@dataclass(frozen=True, slots=True, kw_only=True)
class ResponseSurface:
    """Mean PRD of the motions over friction and slope, each in its governing orientation."""

    # the array whose orientations are run, its friction law scaled as a whole
    array: ArrayAssessment
    mus: Floats  # shape (q,): low-velocity friction coefficients, that of the array among them
    slopes_rad: Floats  # shape (p,): slopes [rad], that of the array among them
    mean_m: Floats  # shape (p, q): mean PRD [m]; NaN where a run gives no displacement
    n_unfinished: int  # runs that are still sliding at the end of their record
    n_runs: int  # all runs
    others: tuple[str, ...]  # ids of arrays whose friction law is not that of this array, scaled


def surface(assessment: Assessment, item: ArrayAssessment) -> ResponseSurface:
    """Return the mean PRD of an array over a grid of friction and slope around all arrays."""
    arrays = [array.array for array in assessment.arrays]
    mus = _axis([array.mu for array in arrays], item.array.mu, N_MUS, unit=0.01, room=0.05)
    degrees = _axis(
        [math.degrees(array.slope_rad) for array in arrays],
        math.degrees(item.array.slope_rad),
        N_SLOPES,
        unit=0.5,
        room=1.0,
    )
    slopes = np.radians(degrees)
    cells = list(product(slopes.tolist(), mus.tolist()))
    # In the governing orientation of the design alone, a quarter of the runs; at other friction
    # another one may govern and slide farther.
    results = assessment.runs.map(partial(_cell, item), cells)
    means = [sum(run.prd_m for run in cell) / len(cell) for cell in results]
    statuses = [run.status for run in chain.from_iterable(results)]
    return ResponseSurface(
        array=item,
        mus=mus,
        slopes_rad=slopes,
        mean_m=np.reshape(means, (slopes.size, mus.size)),
        n_unfinished=statuses.count(Status.SLIDING_AT_END),
        n_runs=len(statuses),
        others=tuple(array.id for array in arrays if not _is_like(array, item.array)),
    )


def _axis(values: Sequence[float], value: float, count: int, *, unit: float, room: float) -> Floats:
    """Return evenly spaced values around those of the arrays, the nearest replaced by one."""
    # Beyond the arrays on both sides: a point at the rim says nothing of what follows.
    low = unit * math.floor(0.8 * min(values) / unit)
    high = 1.25 * max(values) + room
    step = unit * math.ceil((high - low) / (count - 1) / unit)
    axis = np.array([low + k * step for k in range(count)])
    axis[np.argmin(np.abs(axis - value))] = value
    return axis


def _cell(array: ArrayAssessment, cell: tuple[float, float]) -> list[SlideResult]:
    slope, mu = cell
    friction = with_mu(array.array, mu).friction
    scenes = (run.governing.scene for run in array.motions)
    return [_slid(replace(scene, slope_rad=slope, friction=friction)) for scene in scenes]


def _slid(scene: Scene) -> SlideResult:
    """Slide with every component of the scene, to the tolerance of the grid."""
    # In one axis the solution is exact, and faster than any tolerance.
    if scene.friction.is_constant and not scene.ay_mps2.any():
        return one_axis.run(scene)
    return two_axes.run(scene, TOLERANCE)


def _is_like(first: Array, second: Array) -> bool:
    """Whether the friction of two arrays differs by a factor only."""

    def law(array: Array) -> tuple[float, ...]:
        f = array.friction
        if f.is_constant or f.mu_slow == 0.0:
            return (1.0, 1.0, 0.0)
        return (f.mu_fast / f.mu_slow, f.mu_static / f.mu_slow, f.rate_s_per_m)

    return all(
        math.isclose(a, b, rel_tol=1e-9) for a, b in zip(law(first), law(second), strict=True)
    )
