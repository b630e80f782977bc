"""Runs to a tolerance that is enough to tell OK from NG, and where it is not.

Read `run_roughly`, then `told_by_rough_runs`.
"""

from __future__ import annotations

from collections.abc import Sequence

from report.assessment.arrays import ArrayAssessment
from report.assessment.clearances import ClearanceCheck
from report.assessment.runs import MotionRun, run_motion, scene_key
from report.sheet.schema import Array
from solver.model import Motion
from solver.sliding.least_model import DEFAULT

ROUGH = 1e-3
"""Tolerance of a rough run, relative to the PRD."""

# Least difference between required and provided separation at which rough runs tell the verdict:
# twice what a simpler model may neglect (`least_model.Settings`), with the tolerance, and more.
_FAR_SHARE, _FAR_M = 0.02, 0.005


def run_roughly(array: Array, motion: Motion) -> MotionRun:
    """Run an array to a tolerance of `ROUGH`, if its error has a bound."""
    tolerance = ROUGH if array.friction.is_monotone else DEFAULT.tolerance
    return run_motion(array, motion, tolerance=tolerance)


def told_by_rough_runs(
    arrays: Sequence[ArrayAssessment], clearances: Sequence[ClearanceCheck]
) -> Sequence[ArrayAssessment]:
    """Return the arrays for which exact runs would find the verdicts that rough runs found.

    The others are beside a clearance near its limit, or without a value.
    """
    close = [check for check in clearances if not _is_far(check)]
    beside = {name for check in close for name in (check.clearance.array, check.clearance.object)}
    not_told = {scene_key(item.array) for item in arrays if item.array.id in beside}
    return [item for item in arrays if scene_key(item.array) not in not_told]


def _is_far(check: ClearanceCheck) -> bool:
    """Whether a clearance is not near its limit; False without a value."""
    difference = abs(check.required_m - check.clearance.provided_m)
    return difference > max(_FAR_SHARE * check.required_m, _FAR_M)
