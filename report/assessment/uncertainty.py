"""Margins and confidence of the design values: friction, slope, directions that are not run.

Runs the solver and collects numbers; `report.pages.accuracy` prints the margins, and
`report.web.views` draws the grid of `surface`. Read `uncertainty`.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from report.assessment.arrays import ArrayAssessment
from report.assessment.clearances import ClearanceCheck
from report.assessment.project import Assessment
from report.assessment.trials import (
    Trials,
    below,
    check_alone,
    involved,
    is_final,
    search,
    trials_of,
    with_mu,
)
from report.project.model.scene import Array
from report.runs import MotionRun, run_motion, run_oriented
from report.text.units import nan_is_worst
from solver.model import Floats, HorizontalComponent, Orientation, Scene, SlideResult, Status
from solver.records.record import read_only
from solver.sliding import one_axis, two_axes

# Points of the grid over friction and slope.
N_MUS, N_SLOPES = 8, 6

# Tolerance of the runs on the grid, relative to the PRD: it is drawn, not printed.
TOLERANCE = 1e-3

# Fraction of the given friction coefficient down to which the margins are searched.
LOWEST_SHARE = 0.5

# Angles of the horizontal pair that the design runs do not have: those are multiples of 90.
ANGLES_DEG = tuple(k * 22.5 for k in range(16) if k % 4)


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


@dataclass(frozen=True, slots=True, kw_only=True)
class Margin:
    """How far the friction of one array may fall before a clearance is not satisfied."""

    number: int  # of the clearance in the workbook, from 1
    gap: ClearanceCheck
    array: ArrayAssessment
    # smallest coefficient at which all runs satisfy; NaN if the one given does not
    minimum_mu: float
    required_m: float  # required separation at it, for this array alone [m]
    limited_by: str  # what is not satisfied with 0.01 less, or that the search ends there
    lowest_tried: float  # where the search ends

    @property
    def is_beyond(self) -> bool:
        """Whether the search ended before the clearance failed."""
        return self.minimum_mu == self.lowest_tried


@dataclass(frozen=True, slots=True, kw_only=True)
class RotatedRun:
    """The governing motion with its horizontal pair turned in plan, from the record's own axes."""

    angle_deg: float
    result: SlideResult


@dataclass(frozen=True, slots=True, kw_only=True)
class Uncertainty:
    """Margins and confidence of the design values."""

    margins: tuple[Margin, ...]  # for each clearance, one for each array that it involves
    motion: MotionRun  # the governing motion of the governing array, as run for the package
    turned: tuple[RotatedRun, ...]  # empty for a motion with one horizontal component
    # largest PRD with the vertical component reversed, over the orientations of the package [m];
    # NaN without a vertical component or without a displacement
    reversed_m: float

    @property
    def used_m(self) -> float:
        """PRD of the governing motion in the package [m]."""
        return self.motion.governing.result.prd_m

    @property
    def worst(self) -> RotatedRun:
        """The turned run with the largest PRD; there must be one."""
        return max(self.turned, key=lambda run: nan_is_worst(run.result.prd_m))


def uncertainty(assessment: Assessment) -> Uncertainty | None:
    """Return how the governing array and every clearance react to what is not known exactly."""
    if not assessment.has_motions:
        return None
    governing = assessment.governing
    motion = governing.worst
    angles = ANGLES_DEG if motion.motion.has_transverse else ()
    return Uncertainty(
        margins=tuple(_margins(assessment)),
        motion=motion,
        turned=tuple(assessment.runs.map(partial(_turned, governing), angles)),
        reversed_m=_reversed_m(governing),
    )


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
    cells = [(slope, mu) for slope in slopes.tolist() for mu in mus.tolist()]
    results = assessment.runs.map(partial(_cell, item), cells)
    means = [sum(run.prd_m for run in cell) / len(cell) for cell in results]
    statuses = [run.status for cell in results for run in cell]
    return ResponseSurface(
        array=item,
        mus=mus,
        slopes_rad=slopes,
        mean_m=np.reshape(means, (slopes.size, mus.size)),
        n_unfinished=statuses.count(Status.SLIDING_AT_END),
        n_runs=len(statuses),
        others=tuple(array.id for array in arrays if not _is_like(array, item.array)),
    )


def _axis(
    values: Sequence[float], wanted: float, count: int, *, unit: float, room: float
) -> Floats:
    """Return evenly spaced values around those of the arrays, the nearest replaced by one."""
    # Beyond the arrays on both sides: a point at the rim says nothing of what follows.
    low = unit * math.floor(0.8 * min(values) / unit)
    high = 1.25 * max(values) + room
    step = unit * math.ceil((high - low) / (count - 1) / unit)
    axis = np.array([low + k * step for k in range(count)])
    axis[np.argmin(np.abs(axis - wanted))] = wanted
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


def _is_like(first: Array, other: Array) -> bool:
    """Whether the friction of two arrays differs by a factor only."""

    def law(array: Array) -> tuple[float, ...]:
        f = array.friction
        if f.is_constant or f.mu_slow == 0.0:
            return (1.0, 1.0, 0.0)
        return (f.mu_fast / f.mu_slow, f.mu_static / f.mu_slow, f.rate_s_per_m)

    return all(
        math.isclose(a, b, rel_tol=1e-9) for a, b in zip(law(first), law(other), strict=True)
    )


def _margins(assessment: Assessment) -> Iterator[Margin]:
    trials = trials_of(assessment)
    for number, gap in enumerate(assessment.clearances, start=1):
        for array in involved(assessment, gap.clearance):
            yield _margin(trials[array.id], number, gap)


def _margin(trials: Trials, number: int, gap: ClearanceCheck) -> Margin:
    """Walk down in the governing orientations; from the last value that all runs confirm in all."""
    row, array = gap.clearance, trials.array
    as_given = check_alone(trials.assessment, array.id, array.displacement, row)
    least, required, limited_by, mu = math.nan, math.nan, "—", array.array.mu
    lowest = math.ceil(100.0 * LOWEST_SHARE * mu - 1e-6)
    if as_given.ok and is_final(array):
        least, required, limited_by = mu, as_given.required_m, "search"
        start = below(mu)
        held = (
            search(lambda k: trials.may_satisfy(row, mu=k), start, lowest)
            if start >= lowest > 0
            else ()
        )
        # The governing orientations refute at a quarter of the runs; only all of them confirm.
        confirmed = next((k for k in reversed(held) if trials.satisfies(row, mu=k)), 0)
        while confirmed > lowest and trials.satisfies(row, mu=confirmed - 1):
            confirmed -= 1
        if confirmed:
            least, required = confirmed / 100, trials.required_m(row, mu=confirmed)
        if lowest < (following := confirmed or start + 1):
            limited_by = trials.failure(row, mu=following - 1)
    return Margin(
        number=number,
        gap=gap,
        array=array,
        minimum_mu=least,
        required_m=required,
        limited_by=limited_by,
        lowest_tried=lowest / 100,
    )


def _turned(array: ArrayAssessment, angle_deg: float) -> RotatedRun:
    motion, angle = array.worst.motion, math.radians(angle_deg)
    cs, sn = math.cos(angle), math.sin(angle)
    along = cs * motion.ax_mps2 - sn * motion.ay_mps2
    across = sn * motion.ax_mps2 + cs * motion.ay_mps2
    turned = replace(motion, ax_mps2=read_only(along), ay_mps2=read_only(across))
    # One orientation: the other polarity is the angle 180 degrees farther.
    run = run_oriented(
        array.array, turned, Orientation(component=HorizontalComponent.RECORD, polarity=1)
    )
    return RotatedRun(angle_deg=angle_deg, result=run.result)


def _reversed_m(array: ArrayAssessment) -> float:
    motion = array.worst.motion
    if not motion.has_vertical:
        return math.nan
    mirrored = replace(motion, az_mps2=read_only(-motion.az_mps2))
    return run_motion(array.array, mirrored).governing.result.prd_m
