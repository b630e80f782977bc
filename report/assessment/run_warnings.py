"""Runs whose displacement is missing or not final, in words: a sentence for each outcome."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from report.assessment.arrays import ArrayAssessment
from report.assessment.runs import OrientedRun
from report.words.units import Quantity, pair
from solver.model import Status

_MOST_NAMED = 4  # motions in a sentence; more are counted, and the results have each


def run_warnings(arrays: Sequence[ArrayAssessment], us_first: bool) -> Mapping[Status, str]:
    """Return the runs without a final displacement, a sentence for each status that occurs."""
    troubled = [
        (array.id, motion.motion.id, run)
        for array in arrays
        for motion in array.motions
        for run in motion.runs
    ]
    return {
        status: f"{_place(same)}: {_outcome(status, [run for _, _, run in same], us_first)}."
        for status in Status
        if status is not Status.OK
        and (same := [each for each in troubled if each[2].result.status is status])
    }


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
