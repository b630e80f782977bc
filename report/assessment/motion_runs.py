"""The runs of arrays under motions, begun side by side and waited for where they are needed.

Runs nothing itself (`report.assessment.runs` does). Read `begin_runs`.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Hashable, Sequence
from concurrent.futures import Executor, Future
from dataclasses import dataclass
from functools import cache, partial

from report.assessment.arrays import ArrayAssessment
from report.assessment.runs import MotionRun, OrientedRun, run_motion, scene_key
from report.motions.components import RecordFile
from report.motions.history import PreparedMotion, Targets
from report.motions.prepare import Shaking
from report.sheet.schema import ProjectInput
from report.sheet.schema.choices import ModelChoice, RecordedAt
from report.sheet.schema.scene import Array
from report.text.counts import grouped_by
from report.text.units import Quantity, pair
from solver.model import Motion, Status
from solver.records.acceptance import Acceptance, acceptance

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
    """Begin the runs of an input; `check_models` compares requested models with adequate ones."""
    # Arrays with one key share their runs: those of a former assessment have them already.
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


def shaking_acceptance(shaking: Shaking, targets: Targets) -> Acceptance:
    """Compare the motions as run with the targets at the roof, and with the other limits."""
    if not shaking.motions:
        return Acceptance(rows=(), motions=())
    return acceptance(
        shaking.motions,
        [_hold_s(prepared, shaking.records) for prepared in shaking.prepared],
        lambda freq_hz: targets.roof.ordinates(1.0 / freq_hz),
        lambda freq_hz: targets.vertical.ordinates(1.0 / freq_hz),
    )


def _hold_s(prepared: PreparedMotion, files: Sequence[RecordFile]) -> float:
    """Hold of the envelope that all files of a motion state [s]; NaN if any does not."""
    holds = [file.hold_s for file in files if file.motion_id == prepared.motion_id]
    # The response of a building no longer has the envelope of the ground motion.
    is_stated = prepared.recorded_at is RecordedAt.ROOF and not any(map(math.isnan, holds))
    return min(holds, default=math.nan) if is_stated else math.nan


_MOST_NAMED = 4  # motions in a sentence; more are counted, and the results have each
_WHAT_WOULD_DO = {
    Status.SLIDING_AT_END: "give a longer record, or Zero padding on the sheet Motions",
    Status.UPLIFT: "anchor the array, or replace the motion",
    Status.DIVERGED: f"select the model '{ModelChoice.CHOOSE}' on the sheet Arrays",
    Status.STEP_LIMIT: f"select the model '{ModelChoice.CHOOSE}' on the sheet Arrays",
}


@dataclass(frozen=True, slots=True)
class RunWarning:
    """Runs without a final displacement, as a sentence, and what would do."""

    text: str
    would_do: str


def run_warnings(arrays: Sequence[ArrayAssessment], us_first: bool) -> tuple[RunWarning, ...]:
    """Return the runs without a final displacement, a sentence for each outcome and its remedy."""
    troubled = [
        (array.id, motion.motion.id, run)
        for array in arrays
        for motion in array.motions
        for run in motion.runs
        if run.result.status is not Status.OK
    ]
    by_status = grouped_by(troubled, lambda each: (each[2].result.status, _would_do(each[2])))
    return tuple(
        RunWarning(f"{_place(same)}: {_outcome(status, [each[2] for each in same], us_first)}.", do)
        for (status, do), same in sorted(
            by_status.items(), key=lambda item: list(Status).index(item[0][0])
        )
    )


def _would_do(run: OrientedRun) -> str:
    status, scene = run.result.status, run.scene
    if status is Status.SLIDING_AT_END and scene.friction.mu_slow <= math.tan(scene.slope_rad):
        return (
            "the friction coefficient is not above tan θ of the roof slope, so that no record is "
            "long enough: provide more friction, or positive attachment"
        )
    return _WHAT_WOULD_DO[status]


def _place(runs: Sequence[tuple[str, str, OrientedRun]]) -> str:
    """Return the arrays and motions of runs that are given with the ids of theirs."""
    arrays = tuple(dict.fromkeys(array for array, _, _ in runs))
    motions = tuple(dict.fromkeys(motion for _, motion, _ in runs))
    of = f"{'Array' if len(arrays) == 1 else 'Arrays'} {', '.join(arrays)}"
    if len(motions) > _MOST_NAMED:
        return f"{of}, {len(runs)} runs of {len(motions)} motions"
    of += f", {'motion' if len(motions) == 1 else 'motions'} {', '.join(motions)}"
    if len(arrays) == len(motions) == 1:
        return f"{of}, {', '.join(run.orientation.name for _, _, run in runs)}"
    return f"{of}, {len(runs)} runs"


def _outcome(status: Status, runs: Sequence[OrientedRun], us_first: bool) -> str:
    results = [run.result for run in runs]
    if status is Status.UPLIFT:
        return f"{status.sentence} (at {min(result.t_uplift_s for result in results):.3f} s)"
    if status is not Status.SLIDING_AT_END:
        return status.sentence
    fastest = max(abs(result.end_speed_mps) for result in results)
    return f"{status.sentence} (at {pair(fastest, Quantity.VELOCITY, us_first)})"
