"""One array under one motion: each component along the slope in each polarity; governing run.

Integrates nothing itself (`solver.sliding.least_model` does) and knows no code rule. Read
`report.assessment.project` next.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Collection, Hashable, Mapping, Sequence
from dataclasses import dataclass, field
from operator import attrgetter

from report.assessment.verdict import nan_is_worst
from report.sheet.schema.choices import Direction
from report.sheet.schema.scene import Array
from solver.model import Motion, Orientation, Scene, SlideHistory, SlideResult, Status
from solver.sliding import least_model
from solver.sliding.least_model import DEFAULT, Model, Settings, Solution
from solver.sliding.uplift import Uplift, uplift


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
        """Return the largest excursion in a direction [m]; NaN without a final displacement."""
        result = self.result
        if result.status is not Status.OK:
            return math.nan
        return {
            Direction.DOWN: result.down_m,
            Direction.UP: result.up_m,
            # What was not modeled is not more than the PRD.
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
    return array.slope_rad, array.friction


def run_motion(
    array: Array,
    motion: Motion,
    names: Collection[str] = (),
    tolerance: float = DEFAULT.tolerance,
) -> MotionRun:
    """Run one array under one motion in all of its runs.

    Of the orientations those in `names` are run alone, if the motion has them, which is not for
    design; nor is a larger tolerance.
    """
    wanted = [each for each in motion.orientations if each.name in names] or motion.orientations
    runs = [run_oriented(array, motion, each, tolerance) for each in wanted]
    return motion_run(motion, runs)


def largest_two(done: MotionRun) -> list[str]:
    """Return the names of the orientations with the two largest PRDs."""
    runs = sorted(done.runs, key=lambda run: nan_is_worst(run.prd_m), reverse=True)
    return [run.orientation.name for run in runs[:2]]


def motion_run(motion: Motion, runs: Sequence[OrientedRun]) -> MotionRun:
    """Return the runs of a motion with the governing one."""
    worst = max(runs, key=lambda run: nan_is_worst(run.prd_m))
    return MotionRun(motion=motion, runs=tuple(runs), governing=worst)


def run_oriented(
    array: Array,
    motion: Motion,
    orientation: Orientation,
    tolerance: float = DEFAULT.tolerance,
) -> OrientedRun:
    """Run one array under one motion at one orientation; the rest as in `run_motion`."""
    scene = motion.scene(orientation, slope_rad=array.slope_rad, friction=array.friction)
    solution = least_model.solve(scene, Settings(tolerance=tolerance))
    return OrientedRun(orientation=orientation, scene=scene, solution=solution)


RunMotion = Callable[[Array, Motion], MotionRun]


# Wait for the runs of each array.
PendingRuns = Sequence[Callable[[], tuple[MotionRun, ...]]]
