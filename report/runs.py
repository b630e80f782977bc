"""One array under one motion: each component along the slope in each polarity; governing run.

Two horizontal components in two polarities are four runs; seven motions are 28 runs for an array,
and no more for a second array with the same slope and friction.

Integrates nothing itself (`solver.sliding.model_selection` does) and knows no code rule. Read
`Runs`, then `report.assessment.assess`.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Collection, Hashable, Iterable, Mapping, Sequence
from concurrent.futures import Future, ThreadPoolExecutor
from copy import copy
from dataclasses import dataclass
from functools import cached_property
from operator import attrgetter
from typing import TypeVar

from report.project.model.array import Array
from report.project.model.choices import Direction
from report.text.units import nan_is_worst
from solver.errors import DefectError
from solver.model import Motion, Orientation, Scene, SlideHistory, SlideResult, Status
from solver.sliding import model_selection
from solver.sliding.model_selection import DEFAULT, Model, Settings, Solution
from solver.sliding.uplift import Uplift, uplift

# With two runs in two axes at once, a package is 0.3 s sooner than with one.
THREADS = 2

_T = TypeVar("_T")
_R = TypeVar("_R")

Names = Mapping[str, Sequence[str]]
"""Names of orientations by the id of the motion."""

_Key = tuple[Hashable, ...]  # the scene first


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
        """Name of the model used; without the vertical if the motion has none."""
        title = self.solution.model.title
        return title if self.scene.az_mps2.size else title.removesuffix(" with vertical")

    @property
    def prd_m(self) -> float:
        """PRD [m]; NaN if the run has no final displacement."""
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


@dataclass(frozen=True, kw_only=True)
class MotionRun:
    """One array under one motion, with each horizontal component in the requested polarities."""

    motion: Motion
    runs: tuple[OrientedRun, ...]
    governing: OrientedRun  # the run with the largest PRD, or one without a displacement

    @cached_property
    def uplift(self) -> Uplift:
        """Uplift of the run with the smallest normal force."""
        return min((uplift(run.scene) for run in self.runs), key=attrgetter("n_min_g"))

    @property
    def seconds(self) -> float:
        """Time of the last sample [s]."""
        return self.motion.dt_s * (len(self.motion.ax_mps2) - 1)

    def peak_m(self, direction: Direction) -> float:
        """Return the largest excursion of all runs in a direction [m]; NaN if any has none."""
        return max((run.excursion_m(direction) for run in self.runs), key=nan_is_worst)

    def history(self) -> SlideHistory:
        """Rerun the governing run for its values at the samples, for plotting only."""
        return model_selection.history(self.governing.scene, self.governing.solution)


class Runs:
    """The runs of arrays under the motions of one suite; each is started once and cached.

    Arrays with one slope and friction share them. Knows no rule. A larger tolerance is not for
    design.
    """

    def __init__(self, tolerance: float = DEFAULT.tolerance) -> None:
        self._tolerance = tolerance
        self._known: Mapping[str, Names] = {}
        # Runs in two axes and of rows release the GIL: two proceed in parallel.
        self._pool = ThreadPoolExecutor(THREADS)
        self._motions: dict[str, Motion] = {}
        self._begun: dict[_Key, Future[OrientedRun]] = {}
        self._batches: dict[_Key, list[Future[OrientedRun]]] = {}
        # One result for all arrays that share it: what follows from it alone is computed once.
        self._done: dict[_Key, MotionRun] = {}

    def copy(self, scenes: Collection[Hashable] = ()) -> Runs:
        """Return a copy of the existing runs, or of some scenes; it alone stores later runs."""
        copied = copy(self)
        copied._motions = dict(self._motions)
        copied._begun = _of(scenes, self._begun)
        copied._batches = _of(scenes, self._batches)
        copied._done = _of(scenes, self._done)
        return copied

    def knowing(self, known: Mapping[str, Names]) -> Runs:
        """Return the same runs, but only some orientations for some arrays: not for design."""
        # Shallow: what either of them begins is there for both.
        runs = copy(self)
        runs._known = known
        return runs

    def begin(self, arrays: Iterable[Array], motions: Iterable[Motion]) -> None:
        """Start the runs of arrays under motions, without waiting for them."""
        motions = list(motions)
        for array in arrays:
            scene = scene_key(array)
            for motion in motions:
                # By identity: results are kept by the id of a motion, and another motion of that
                # id would get them.
                if self._motions.setdefault(motion.id, motion) is not motion:
                    raise DefectError(f"{motion.id} is not the same motion as in the earlier runs")
                names = self._names(array, motion)
                if (scene, motion.id, names) not in self._batches:
                    known = [
                        orientation
                        for orientation in motion.orientations
                        if orientation.name in names
                    ]
                    self._batches[scene, motion.id, names] = [
                        self._run(scene, array, motion, orientation)
                        # Names that this motion does not have leave none: then all are run.
                        for orientation in known or motion.orientations
                    ]

    def of(self, array: Array, motions: Sequence[Motion]) -> tuple[MotionRun, ...]:
        """Return the runs of an array, once they are done."""
        self.begin([array], motions)
        scene, done = scene_key(array), list[MotionRun]()
        for motion in motions:
            batch = (scene, motion.id, self._names(array, motion))
            if batch not in self._done:
                runs = [run.result() for run in self._batches[batch]]
                self._done[batch] = motion_run(motion, runs)
            done.append(self._done[batch])
        return tuple(done)

    def map(self, do: Callable[[_T], _R], items: Iterable[_T]) -> list[_R]:
        """Return the result for each item, two at a time."""
        return list(self._pool.map(do, items))

    def _names(self, array: Array, motion: Motion) -> tuple[str, ...]:
        """Return the names of the only orientations run; none for all."""
        return tuple(self._known.get(array.id, {}).get(motion.id, ()))

    def _run(
        self, scene: Hashable, array: Array, motion: Motion, orientation: Orientation
    ) -> Future[OrientedRun]:
        key = (scene, motion.id, orientation)
        if key not in self._begun:
            about = array, motion, orientation, self._tolerance
            self._begun[key] = self._pool.submit(run_oriented, *about)
        return self._begun[key]


def _of(scenes: Collection[Hashable], known: Mapping[_Key, _T]) -> dict[_Key, _T]:
    return {key: run for key, run in known.items() if not scenes or key[0] in scenes}


def scene_key(array: Array) -> Hashable:
    """Return the key of the runs of an array under a motion; equal keys have equal runs."""
    return array.slope_rad, array.friction


def run_motion(array: Array, motion: Motion) -> MotionRun:
    """Run one array under one motion in all orientations, without caching."""
    return motion_run(
        motion, [run_oriented(array, motion, orientation) for orientation in motion.orientations]
    )


def motion_run(motion: Motion, runs: Sequence[OrientedRun]) -> MotionRun:
    """Return the runs of a motion with the governing one."""
    worst = max(runs, key=lambda run: nan_is_worst(run.prd_m))
    return MotionRun(motion=motion, runs=tuple(runs), governing=worst)


def run_oriented(
    array: Array, motion: Motion, orientation: Orientation, tolerance: float = DEFAULT.tolerance
) -> OrientedRun:
    """Run one array under one motion at one orientation, to a tolerance relative to the PRD."""
    scene = motion.scene(orientation, slope_rad=array.slope_rad, friction=array.friction)
    solution = model_selection.solve(scene, Settings(tolerance=tolerance))
    return OrientedRun(orientation=orientation, scene=scene, solution=solution)
