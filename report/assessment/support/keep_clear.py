"""The distance around an array that is to be kept clear."""

from __future__ import annotations

import math

from report.assessment.assessment import Assessment
from report.assessment.design.arrays import ArrayAssessment
from report.assessment.design.rule_set import mark_of
from solver.model import INCH_M
from solver.rules import provisions
from solver.rules.provisions import Neighbor


def keep_clear_m(assessment: Assessment, array: ArrayAssessment) -> float:
    """Return the separation from any fixed object [m]; NaN without a permitted displacement."""
    rules = assessment.rules
    return provisions.required_separation(
        rules,
        Neighbor.FIXED,
        design_m=array.permitted_m,
        # Any object that may come: its I_p is taken as that of the array.
        importance=array.array.i_p if rules.importance_in_separation else 1.0,
    )


def keep_clear_mark(assessment: Assessment, array: ArrayAssessment) -> str:
    """Return the mark of the separation of an array from any fixed object; none without one."""
    if math.isnan(keep_clear_m(assessment, array)):
        return ""
    factor, plain = (
        rules["separation_fixed"]
        for rules in (assessment.rules, provisions.RULE_SETS[assessment.rules.name])
    )
    return array.overridden.design or mark_of(factor, plain)


def keep_clear(separation_m: float, us_first: bool) -> str:
    """Return a distance to keep clear, rounded up to 1 in or 10 mm; `unknown` for NaN."""
    if math.isnan(separation_m):
        return "unknown"  # "none" would read as no distance
    steps = math.ceil(separation_m / (INCH_M if us_first else 0.01) - 1e-9)
    return f"{steps} in" if us_first else f"{10 * steps} mm"
