"""The runs of arrays under motions, begun side by side and waited for where they are needed.

Runs nothing itself (`report.assessment.runs` does). Read `begin_runs`.
"""

from __future__ import annotations

from collections.abc import Callable, Hashable, Sequence
from concurrent.futures import Executor, Future
from functools import cache, partial

from report.assessment.arrays import ArrayAssessment
from report.assessment.runs import MotionRun, run_motion, scene_key
from report.sheet.schema import ProjectInput
from report.sheet.schema.choices import ModelChoice
from report.sheet.schema.scene import Array
from solver.model import Motion

RunMotion = Callable[[Array, Motion], MotionRun]

Runs = tuple[tuple[MotionRun, ...], tuple[MotionRun, ...]]
"""Runs of an array, and those with the adequate models; one object twice if they are the same."""

PendingRuns = Sequence[Callable[[], Runs]]
"""Wait for the runs of each array."""


def begin_runs(
    pool: Executor,
    run: RunMotion,
    data: ProjectInput,
    motions: Sequence[Motion],
    *,
    check_models: bool,
    key: Callable[[Array], Hashable] = scene_key,
    former: Sequence[ArrayAssessment] = (),
) -> PendingRuns:
    """Begin the runs of an input.

    Parameters
    ----------
    check_models : bool
        Whether requested models are compared with adequate ones.
    key : callable
        Arrays with one key share their runs.
    former : sequence of ArrayAssessment
        Those with the key of an array have its runs already.
    """
    known = {key(item.array): (item.motions, item.needed) for item in former}

    def begun(array: Array) -> Callable[[], Runs]:
        if (runs_of := known.get(key(array))) is not None:
            return lambda: runs_of
        # Runs in two axes and of rows release the GIL: two proceed in parallel.
        runs = [pool.submit(run, array, motion) for motion in motions]
        if array.model is ModelChoice.CHOOSE or not check_models:
            return partial(_done, runs, runs)
        chosen = partial(run_motion, array, model=ModelChoice.CHOOSE)
        return partial(_done, runs, [pool.submit(chosen, motion) for motion in motions])

    by_key = {key(array): array for array in data.arrays}
    # One result for all arrays of a key: what follows from the runs alone is computed once.
    runs = {each: cache(begun(array)) for each, array in by_key.items()}
    return [runs[key(array)] for array in data.arrays]


def _done(runs: Sequence[Future[MotionRun]], needed: Sequence[Future[MotionRun]]) -> Runs:
    done = tuple(run.result() for run in runs)
    return done, done if needed is runs else tuple(run.result() for run in needed)
