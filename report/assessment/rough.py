"""Runs to a tolerance that is enough to tell OK from NG, and where it is not.

Read `run_roughly`, then `decided_at_coarse_tolerance`.
"""

from __future__ import annotations

from collections.abc import Sequence

from report.assessment.arrays import ArrayAssessment, Route
from report.assessment.clearances import ClearanceCheck, facing
from report.assessment.runs import MotionRun, OrientedRun, run_motion, scene_key
from report.sheet.schema import Array, Direction, ProjectInput
from solver.model import Motion
from solver.rules import provisions
from solver.rules.provisions import RuleSet
from solver.sliding.least_model import DEFAULT

ROUGH = 1e-3
"""Tolerance of a rough run, relative to the PRD."""


def run_roughly(array: Array, motion: Motion) -> MotionRun:
    """Run an array to a tolerance of `ROUGH`, if its error has a bound."""
    tolerance = ROUGH if array.friction.is_monotone else DEFAULT.tolerance
    return run_motion(array, motion, tolerance=tolerance)


def decided_at_coarse_tolerance(
    data: ProjectInput,
    rules: RuleSet,
    arrays: Sequence[ArrayAssessment],
    clearances: Sequence[ClearanceCheck],
) -> Sequence[ArrayAssessment]:
    """Return the arrays for which exact runs would find the verdicts that rough runs found.

    The others are beside a clearance near its limit, or without a value.
    """
    undecided = {
        scene_key(item.array)
        for check in clearances
        for item, direction in facing(data, arrays, check.clearance)
        if not _is_decided(rules, check, item, direction)
    }
    return [item for item in arrays if scene_key(item.array) not in undecided]


def _is_decided(
    rules: RuleSet, check: ClearanceCheck, item: ArrayAssessment, direction: Direction
) -> bool:
    """Whether exact runs of an array leave the verdict on a clearance; not without a value."""
    if not check.is_permitted:  # whatever the runs are
        return True
    off_m = check.factor * design_off_m(rules, item, direction)
    return abs(check.required_m - check.clearance.provided_m) > off_m


def design_off_m(rules: RuleSet, item: ArrayAssessment, direction: Direction) -> float:
    """Return a bound on the change of a design displacement by exact runs [m].

    A mean of values, or the largest, times a factor, changes by no more than that of their changes,
    and no more where it is the larger of that and a floor.
    """
    offs = [max(_off_m(run, direction) for run in motion.runs) for motion in item.motions]
    if item.route is Route.PRESCRIPTIVE:
        return max(offs)  # the prescriptive value, not less than the largest PRD
    return provisions.analysis_value(rules, offs, item.analysis.basis).value_m


def _off_m(run: OrientedRun, direction: Direction) -> float:
    """Return a bound on the change of an excursion by an exact run [m]."""
    solution = run.solution
    exact_m = DEFAULT.tolerance * run.prd_m
    off_m = solution.result.error_m + exact_m
    if solution.margin_m > 2.0 * exact_m:
        return off_m
    # The exact run may choose a simpler model, whose bound follows from a PRD of its own: one that
    # is larger by twice that bound at most. In one axis the PRD stands for what goes across.
    off_m += 2.0 * DEFAULT.bound_m(1.02 * run.prd_m)
    return off_m + (run.prd_m if direction is Direction.ACROSS else 0.0)
