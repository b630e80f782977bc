"""One array under one motion: each component along the slope in each polarity; governing run.

Integrates nothing itself (`solver.sliding.least_model` does) and knows no code rule. Read
`report.assessment.project` next.
"""

from __future__ import annotations

import math
from collections.abc import Hashable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from operator import attrgetter
from typing import Any

from report.sheet.schema.choices import Direction, ModelChoice
from report.sheet.schema.scene import Array
from solver.forces import friction_demand
from solver.model import Motion, Orientation, Scene, SlideHistory, SlideResult, Status
from solver.rivals.methods import NO_RECORD
from solver.sliding import least_model
from solver.sliding.least_model import Model, Settings, Solution
from solver.sliding.uplift import Uplift, uplift

REQUESTED_MODELS: Mapping[ModelChoice, Model] = {
    ModelChoice.ONE_AXIS: Model.ONE_AXIS,
    ModelChoice.ONE_AXIS_VERTICAL: Model.ONE_AXIS_VERTICAL,
    ModelChoice.TWO_AXES: Model.TWO_AXES,
}
"""The models that a workbook can request."""

CONTINUED = "continued from the last full run"
"""Reason of a run in one axis whose excursions are multiplied by those of a full run."""

_ANY = Direction.ANY.value


@dataclass(frozen=True, slots=True, kw_only=True)
class OrientedRun:
    """One motion with one horizontal component along the slope, in one polarity."""

    orientation: Orientation
    scene: Scene
    solution: Solution

    @property
    def result(self) -> SlideResult:
        """Result of the model used."""
        return self.solution.result

    @property
    def model(self) -> str:
        """Name of the model used; without the vertical where the motion has none."""
        title = self.solution.model.title
        return title if self.scene.az_mps2.size else title.removesuffix(" with vertical")

    @property
    def prd_m(self) -> float:
        """PRD [m]; NaN where the run has no final displacement."""
        return self.result.prd_m if self.result.status is Status.OK else math.nan

    @property
    def has_across(self) -> bool:
        """Whether cross-slope motion was modeled, or shown to be zero."""
        return self.solution.model is Model.NO_SLIP or self.solution.model >= Model.TWO_AXES

    def excursion_m(self, direction: Direction) -> float:
        """Return the largest excursion of the array in a direction [m].

        Where cross-slope motion was not modeled, the PRD is used for it. NaN where the run has no
        final displacement: lifted off, still sliding at its end, or without a result.
        """
        result = self.result
        if result.status is not Status.OK:
            return math.nan
        return {
            Direction.DOWN: result.down_m,
            Direction.UP: result.up_m,
            Direction.ACROSS: result.across_m if self.has_across else result.prd_m,
            Direction.ANY: result.prd_m,
        }[direction]


@dataclass(frozen=True, slots=True, kw_only=True)
class MotionRun:
    """One array under one motion, with each horizontal component in the requested polarities."""

    motion: Motion
    runs: tuple[OrientedRun, ...]
    governing: OrientedRun  # the run with the largest PRD, or one without a displacement
    # Arrays share a run: what follows from it alone is computed once, before it is sent anywhere.
    uplift: Uplift = field(init=False)  # of the run with the smallest normal force
    _peaks_m: Mapping[Direction, float] = field(init=False)

    def __post_init__(self) -> None:
        uplifts = (uplift(run.scene) for run in self.runs)
        object.__setattr__(self, "uplift", min(uplifts, key=attrgetter("n_min_g")))
        peaks_m = {
            direction: max((run.excursion_m(direction) for run in self.runs), key=nan_is_worst)
            for direction in Direction
        }
        object.__setattr__(self, "_peaks_m", peaks_m)

    @property
    def seconds(self) -> float:
        """Time of the last sample [s]."""
        return self.motion.dt_s * (len(self.motion.ax_mps2) - 1)

    def peak_m(self, direction: Direction) -> float:
        """Return the largest excursion of all runs in a direction [m]; NaN if any has none."""
        return self._peaks_m[direction]

    def history(self) -> SlideHistory:
        """Rerun the governing run for its values at the samples, for plotting only."""
        return least_model.history(self.governing.scene, self.governing.solution)


def scene_key(array: Array) -> Hashable:
    """Return what the runs of an array under a motion follow from: equal ones have equal runs."""
    return array.slope_rad, array.friction, array.model


def run_motion(
    array: Array,
    motion: Motion,
    model: ModelChoice | None = None,
) -> MotionRun:
    """Run one array under one motion in all of its runs.

    Parameters
    ----------
    model : Model, optional
        Replaces the model of the array.
    """
    return motion_run(motion, [run_oriented(array, motion, h, model) for h in motion.orientations])


def reference(array: Array, done: MotionRun) -> Mapping[str, Any]:
    """Return a finished motion beside its governing run in one axis, as data for JSON.

    What `run_along` continues: excursions [m] by direction, None where there is none.
    """
    along = _oriented_along(array, done.motion, done.governing.orientation)
    return {
        "orientation": done.governing.orientation.name,
        "model": int(done.governing.solution.model),
        "full_m": {d.value: _finite(done.peak_m(d)) for d in Direction},
        "along_m": {d.value: _finite(along.excursion_m(d)) for d in Direction},
    }


def run_along(array: Array, motion: Motion, known: Mapping[str, Any] | None) -> MotionRun:
    """Run one array under one motion in one axis: quick, and not for design.

    The horizontal component that governs in a reference acts along the slope together with the
    vertical one, and its excursions are multiplied by full / one axis of the reference: at the
    values of the reference they are the full ones. Without such a factor they are those of one
    axis, and the reason of the run is not `CONTINUED`.

    Parameters
    ----------
    known : mapping, optional
        What `reference` gave for the array and the motion.
    """
    names = {each.name: each for each in motion.orientations}
    if known is None or known["orientation"] not in names:
        return motion_run(motion, [_oriented_along(array, motion, h) for h in names.values()])
    run = _oriented_along(array, motion, names[known["orientation"]])
    return motion_run(motion, [_continued(run, known)])


def _continued(run: OrientedRun, known: Mapping[str, Any]) -> OrientedRun:
    full, along, result = known["full_m"], known["along_m"], run.result
    if run.solution.model is Model.NO_SLIP:  # of all components: exact
        return replace(run, solution=replace(run.solution, reason=CONTINUED))
    if not (full[_ANY] and along[_ANY]) or result.status is not Status.OK:
        return run

    def length_m(direction: Direction) -> float:
        start = direction if along[direction.value] else Direction.ANY
        change = run.excursion_m(start) / float(along[start.value])  # 1 exactly, at rest
        return float(full[direction.value]) * change

    result = replace(
        result,
        prd_m=length_m(Direction.ANY),
        down_m=length_m(Direction.DOWN),
        up_m=length_m(Direction.UP),
        across_m=length_m(Direction.ACROSS),
    )
    model = Model(known["model"])
    solution = replace(run.solution, model=model, reason=CONTINUED, result=result)
    return replace(run, solution=solution)


def _oriented_along(array: Array, motion: Motion, orientation: Orientation) -> OrientedRun:
    scene = motion.scene(orientation, slope_rad=array.slope_rad, friction=array.friction)
    if friction_demand(scene) <= scene.friction.mu_static:
        return OrientedRun(orientation=orientation, scene=scene, solution=least_model.solve(scene))
    scene = replace(scene, ay_mps2=NO_RECORD)
    # Nothing else models velocity-dependent friction than the choice of a model.
    forced = Model.ONE_AXIS_VERTICAL if scene.friction.is_constant else None
    solution = least_model.solve(scene, Settings(forced=forced))
    return OrientedRun(orientation=orientation, scene=scene, solution=solution)


def motion_run(motion: Motion, runs: Sequence[OrientedRun]) -> MotionRun:
    """Return the runs of a motion with the governing one."""
    worst = max(runs, key=lambda run: nan_is_worst(run.prd_m))
    return MotionRun(motion=motion, runs=tuple(runs), governing=worst)


def run_oriented(
    array: Array,
    motion: Motion,
    orientation: Orientation,
    model: ModelChoice | None = None,
) -> OrientedRun:
    """Run one array under one motion at one orientation; the rest as in `run_motion`."""
    forced = REQUESTED_MODELS.get(array.model if model is None else model)
    scene = motion.scene(orientation, slope_rad=array.slope_rad, friction=array.friction)
    solution = least_model.solve(scene, Settings(forced=forced))
    return OrientedRun(orientation=orientation, scene=scene, solution=solution)


def _finite(value_m: float) -> float | None:
    return None if math.isnan(value_m) else value_m


def nan_is_worst(value: float) -> float:
    """Return a sort key in which NaN is the largest."""
    return math.inf if math.isnan(value) else value
