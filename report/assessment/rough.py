"""Runs to a tolerance that is enough to tell OK from NG, and where it is not.

Read `run_roughly`, then `told_by_rough_runs`.
"""

from __future__ import annotations

from collections.abc import Sequence

from report.assessment.arrays import ArrayAssessment
from report.assessment.clearances import ClearanceCheck
from report.assessment.runs import MotionRun, run_motion, scene_key
from report.sheet.schema import Array, Model
from solver.model import Motion
from solver.sliding.least_model import DEFAULT

ROUGH = 1e-3
"""Tolerance of a rough run, relative to the PRD."""

# Difference up to which rough runs do not tell a verdict, as a share of the required separation and
# as a displacement [m]: the tolerance with what the exact run may neglect (`Settings.bound_m`), and
# where the rough run may neglect as much, with that too.
_CLOSE, _CLOSE_M = 0.007, 0.0015
_CLOSE_NEGLECTING, _CLOSE_NEGLECTING_M = 0.013, 0.0025


def run_roughly(array: Array, motion: Motion) -> MotionRun:
    """Run an array to a tolerance of `ROUGH`, if its error has a bound; no models are compared."""
    tolerance = ROUGH if array.friction.is_monotone else DEFAULT.tolerance
    has_choice = array.model is Model.CHOOSE and array.friction.is_constant
    model = Model.TWO_AXES if has_choice and motion.has_transverse else array.model
    return run_motion(array, motion, model, tolerance)


def told_by_rough_runs(
    arrays: Sequence[ArrayAssessment], clearances: Sequence[ClearanceCheck]
) -> Sequence[ArrayAssessment]:
    """Return the arrays for which exact runs would find the verdicts that rough runs found.

    The others are beside a clearance near its limit, or without a value.
    """
    neglecting = {item.id for item in arrays if not _is_whole(item)}
    not_told = {
        scene_key(item.array)
        for check in clearances
        if _is_close(check, is_neglecting=not neglecting.isdisjoint(_sides(check)))
        for item in arrays
        if item.id in _sides(check)
    }
    return [item for item in arrays if scene_key(item.array) not in not_told]


def _sides(check: ClearanceCheck) -> tuple[str, str]:
    return check.clearance.array, check.clearance.object


def _is_whole(item: ArrayAssessment) -> bool:
    """Whether no run of an array neglects anything."""
    solutions = [run.solution for motion in item.motions for run in motion.runs]
    return all(solution.next_rung is solution.rung for solution in solutions)


def _is_close(check: ClearanceCheck, *, is_neglecting: bool) -> bool:
    """Whether a clearance is near its limit; also without a value."""
    share, displacement_m = (
        (_CLOSE_NEGLECTING, _CLOSE_NEGLECTING_M) if is_neglecting else (_CLOSE, _CLOSE_M)
    )
    difference = abs(check.required_m - check.clearance.provided_m)
    return not difference > max(share * check.required_m, check.factor * displacement_m)
