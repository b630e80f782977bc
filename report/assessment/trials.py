"""One array rerun with other friction, through the checks of a project.

Runs nothing by itself: `report.assessment.remedies` and `report.assessment.uncertainty` search with
it. Read `Trials`, then `search`.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Hashable, Mapping, Sequence
from concurrent.futures import Executor
from dataclasses import replace
from functools import partial

from report.assessment.arrays import ArrayAssessment, assess_array
from report.assessment.clearances import ClearanceCheck, check_clearance
from report.assessment.friction import array_with_friction, at_low_velocity
from report.assessment.project import Assessment
from report.assessment.runs import MotionRun, motion_run, run_oriented, scene_key
from report.sheet.schema import ProjectInput
from report.sheet.schema.scene import Array, Clearance
from solver.model import Status

# Hundredths between the values of each pass of a search: coarse first, as each value takes runs.
STRIDES = (5, 1)

Runs = dict[Hashable, tuple[MotionRun, ...]]


def above(value: float) -> int:
    """Return the first hundredth above a value."""
    return math.floor(100.0 * value + 1e-6) + 1


def below(value: float) -> int:
    """Return the first hundredth below a value."""
    return math.ceil(100.0 * value - 1e-6) - 1


def with_mu(array: Array, mu: float) -> Array:
    """Return an array with another low-velocity coefficient, its friction law scaled as a whole."""
    if array.mu > 0.0:
        return array_with_friction(array, mu / array.mu).model_copy(update={"mu": mu})
    # A law that starts from zero has no factor: the coefficient is then one at every velocity.
    return at_low_velocity(array).model_copy(update={"mu": mu})


def search(satisfies: Callable[[int], bool], start: int, end: int) -> tuple[int, ...]:
    """Walk from one value toward another, and return those before the first failure, in order.

    Each pass goes on from the last value of the one before, in smaller steps: no value tried
    between the start and the last one returned fails. Empty if the start fails.
    """
    if not satisfies(start):
        return ()
    way = 1 if end >= start else -1
    held = [start]
    for step in STRIDES:
        while (following := held[-1] + way * step) * way <= end * way and satisfies(following):
            held.append(following)
    return tuple(held)


class Trials:
    """One array under the motions of a project, with other friction, in hundredths."""

    def __init__(
        self, assessment: Assessment, array: ArrayAssessment, pool: Executor, runs: Runs
    ) -> None:
        self.assessment = assessment
        self.array = array
        self._pool = pool
        self._runs = runs  # arrays with one slope and friction share them
        # Several clearances of an array ask for the same ones.
        self._done: dict[tuple[int, bool], ArrayAssessment] = {}

    def satisfies(self, row: Clearance | None, *, mu: int) -> bool:
        """Whether all runs have final values and satisfy a clearance, if any."""
        # The governing orientations alone refute a value at a quarter of the runs.
        return self.may_satisfy(row, mu=mu) and not self.failure(row, mu=mu)

    def may_satisfy(self, row: Clearance | None, *, mu: int) -> bool:
        """Whether the governing orientation of each motion alone satisfies a clearance."""
        return not self.failure(row, mu=mu, every=False)

    def required_m(self, row: Clearance, *, mu: int) -> float:
        """Return the separation that the array requires with all runs [m]."""
        trial = self._tried(mu, every=True)
        return single_array_check(self.assessment, self.assessment.project, trial, row).required_m

    def failure(self, row: Clearance | None, *, mu: int, every: bool = True) -> str:
        """Return what does not satisfy with all runs, or with the governing ones; else nothing."""
        trial = self._tried(mu, every=every)
        if not is_final(trial):
            return "no final value"
        if self.array.satisfies_limits and not trial.satisfies_limits:
            limits = replace(trial, route=self.array.route).limits  # not those of another route
            return next(check.title for check in limits if not check.ok)
        if row and not single_array_check(self.assessment, self.assessment.project, trial, row).ok:
            return "clearance"
        return ""

    def _tried(self, mu: int, *, every: bool) -> ArrayAssessment:
        """Return the array with all runs, or with the governing orientation of each motion only."""
        which = (mu, every)
        if which not in self._done:
            array = with_mu(self.array.array, mu / 100)
            key = (which, scene_key(self.array.array))
            if key not in self._runs:
                self._runs[key] = self._run(array, *which)
            self._done[which] = assess_array(
                self.assessment.project,
                self.assessment.rules,
                array,
                self._runs[key],
                motions_qualify=self.assessment.acceptance.qualifies,
            )
        return self._done[which]

    def _run(self, array: Array, mu: int, every: bool) -> tuple[MotionRun, ...]:
        # Of all runs the governing ones are done already.
        before = self._tried(mu, every=False) if every else self.array
        return tuple(self._pool.map(partial(_runs, array, every), before.motions))


def trials_of(
    assessment: Assessment, pool: Executor, runs: Runs | None = None
) -> Mapping[str, Trials]:
    """Return the trials of each array by its id, with the `runs` that others have done."""
    runs = {} if runs is None else runs
    return {array.id: Trials(assessment, array, pool, runs) for array in assessment.arrays}


def _runs(array: Array, every: bool, before: MotionRun) -> MotionRun:
    motion, done = before.motion, before.governing
    if not every:
        return motion_run(motion, [run_oriented(array, motion, done.orientation)])
    others = (each for each in motion.orientations if each != done.orientation)
    return motion_run(motion, [done, *(run_oriented(array, motion, each) for each in others)])


def is_final(array: ArrayAssessment) -> bool:
    """Whether an array has a design value and every run, if any, ended at rest."""
    is_at_rest = all(run.result.status is Status.OK for run in array.runs)
    return is_at_rest and not math.isnan(array.design_m)


def single_array_check(
    assessment: Assessment, data: ProjectInput, trial: ArrayAssessment, row: Clearance
) -> ClearanceCheck:
    """Return a clearance with one array as tried and all others at rest."""
    arrays = tuple(
        trial if array.id == trial.id else resting(array) for array in involved(assessment, row)
    )
    return check_clearance(data, assessment.rules, arrays, row)


def resting(array: ArrayAssessment, floor_m: float = 0.0) -> ArrayAssessment:
    """Return an array that does not slide in any run, with a floor [m]."""
    analysis = replace(array.analysis, value_m=0.0)
    return replace(array, analysis=analysis, floor_m=floor_m, design_m=floor_m)


def involved(assessment: Assessment, row: Clearance) -> Sequence[ArrayAssessment]:
    """Return the arrays on both sides of a clearance."""
    return [array for array in assessment.arrays if array.id in (row.array, row.object)]
