"""Runs whose displacement is missing or not final, in words: a sentence for each outcome."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from report.assessment.arrays import ArrayAssessment
from report.assessment.runs import OrientedRun
from report.words.units import Quantity, pair
from solver.model import Status

_MOST_NAMED = 4  # motions in a sentence; more are counted, and the results have each


@dataclass(frozen=True, slots=True, kw_only=True)
class _Troubled:
    array: str
    motion: str
    run: OrientedRun


def run_warnings(arrays: Sequence[ArrayAssessment], us_first: bool) -> Mapping[Status, str]:
    """Return the runs without a final displacement, a sentence for each status that occurs."""
    troubled = [
        _Troubled(array=array.id, motion=motion.motion.id, run=run)
        for array in arrays
        for motion in array.motions
        for run in motion.runs
    ]
    return {
        status: f"{_place(same)}: {_outcome(status, same, us_first)}."
        for status in Status
        if status is not Status.OK
        and (same := [one for one in troubled if one.run.result.status is status])
    }


def _place(runs: Sequence[_Troubled]) -> str:
    arrays = tuple(dict.fromkeys(one.array for one in runs))
    motions = tuple(dict.fromkeys(one.motion for one in runs))
    of = f"{'Array' if len(arrays) == 1 else 'Arrays'} {', '.join(arrays)}"
    if len(motions) > _MOST_NAMED:
        return f"{of}, {len(runs)} runs of {len(motions)} motions"
    of += f", {'motion' if len(motions) == 1 else 'motions'} {', '.join(motions)}"
    if len(arrays) == len(motions) == 1:
        return f"{of}, {', '.join(one.run.orientation.name for one in runs)}"
    return f"{of}, {len(runs)} runs"


def _outcome(status: Status, runs: Sequence[_Troubled], us_first: bool) -> str:
    results = [one.run.result for one in runs]
    if status is Status.UPLIFT:
        return f"{status.sentence} (at {min(result.t_uplift_s for result in results):.3f} s)"
    if status is not Status.SLIDING_AT_END:
        return status.sentence
    fastest = max(abs(result.end_speed_mps) for result in results)
    return f"{status.sentence} (at {pair(fastest, Quantity.VELOCITY, us_first)})"
