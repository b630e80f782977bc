"""What arrays come to with another input in place of one that is not certain.

Collects numbers of runs that were made; runs nothing. Read `InputCase` first.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import replace

from report.assessment.arrays import Route
from report.assessment.clearances import check_clearance
from report.assessment.evidence import Evidence
from report.assessment.friction_velocity import InputCase
from report.assessment.project import Assessment
from report.assessment.runs import nan_is_worst
from report.words.units import number


def building_case(given: Assessment, evidence: Evidence) -> InputCase | None:
    """Return the governing array with the period or damping that lets it slide farthest.

    A variation without a value is the worst. None where no motion goes through the building, where
    that is no farther than as used, and where the design displacement does not follow from one
    value of the analysis.
    """
    array = given.governing
    if not evidence.building or array.route is not Route.ANALYSIS or array.by_direction:
        return None
    (used, _), *others = evidence.building
    building, value = max(others, key=lambda pair: nan_is_worst(pair[1].value_m))
    design_m = math.nan if math.isnan(value.value_m) else max(value.value_m, array.floor_m)
    if not nan_is_worst(design_m) > array.design_m:
        return None
    is_damping = building.damping_percent != used.damping_percent
    changed = (
        f"{number(building.damping_percent, 1)} % damping of the building"
        if is_damping
        else f"{number(building.period_s or math.nan, 2)} s as the period of the building"
    )
    farther = replace(array, analysis=value, design_m=design_m)
    arrays = [farther if item is array else item for item in given.arrays]
    rows = [gap.clearance for gap in given.gaps_of(array.id)]
    gaps = [check_clearance(given.project, given.rules, arrays, row) for row in rows]
    return InputCase(array=farther, changed=changed, gaps=gaps)


def cases(given: Assessment, evidence: Evidence) -> Iterator[InputCase]:
    """Yield what would change the verdict on an array or exceed its prescriptive displacement."""
    slow = given.low_velocity
    found = *(slow.case_of(item.id) for item in slow.arrays), building_case(given, evidence)
    for case in filter(None, found):
        now = next(item for item in given.arrays if item.id == case.array.id)
        most_m = case.array.prescriptive.value_m
        is_short = any(gap.ok for gap in given.gaps_of(now.id)) and case.short
        if is_short or now.design_m <= most_m < nan_is_worst(case.array.design_m):
            yield case
