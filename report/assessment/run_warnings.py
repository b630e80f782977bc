"""Runs whose displacement is missing or not final, in words: a sentence for each outcome."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

from report.assessment.arrays import ArrayAssessment
from report.assessment.runs import OrientedRun
from report.sheet.schema.choices import ModelChoice
from report.words.counts import grouped_by
from report.words.units import Quantity, pair
from solver.model import Status

_MOST_NAMED = 4  # motions in a sentence; more are counted, and the results have each


_ORDER = list(Status)
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
    found = grouped_by(troubled, lambda each: (each[2].result.status, _would_do(each[2])))
    return tuple(
        RunWarning(f"{_place(same)}: {_outcome(status, [each[2] for each in same], us_first)}.", do)
        for (status, do), same in sorted(found.items(), key=lambda item: _ORDER.index(item[0][0]))
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
