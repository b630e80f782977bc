"""Other inputs that would change a verdict."""

from __future__ import annotations

from collections.abc import Iterator

from report.assessment.assessment import Assessment
from report.assessment.design.clearances import by_id
from report.assessment.low_velocity import InputCase
from report.assessment.support.building_variations import Variations, building_case
from report.text.units import nan_is_worst


def cases(assessment: Assessment, variations: Variations) -> Iterator[InputCase]:
    """Yield what would change the verdict on an array or exceed its prescriptive displacement."""
    slow = assessment.low_velocity
    by_velocity = (slow.case_of(item.id) for item in slow.arrays)
    for case in filter(None, (*by_velocity, building_case(assessment, variations))):
        now = by_id(assessment.arrays, case.array.id)
        most_m = case.array.prescriptive.value_m
        is_short = bool(case.short) and any(gap.ok for gap in assessment.gaps_of(now.id))
        is_short = is_short or (case.array.lacks_slack and not now.lacks_slack)
        if is_short or now.design_m <= most_m < nan_is_worst(case.array.design_m):
            yield case
