"""Other inputs that would change the verdict on an array."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

from report.assessment.assessment import Assessment
from report.assessment.checks.capacities import slack_check
from report.assessment.checks.clearance_checks import clearance_check
from report.assessment.checks.sentence import words
from report.assessment.design.arrays import ArrayAssessment
from report.assessment.design.clearances import ClearanceCheck, by_id, with_displacements
from report.assessment.design.friction import coefficient
from report.assessment.design.routes import NOT_PERMITTED, Route
from report.assessment.design.verdict import Verdict
from report.assessment.support.further_runs import Variations
from report.text.units import NO_BREAK, Quantity, nan_is_worst, no_less, number, pair


@dataclass(frozen=True, slots=True, kw_only=True)
class InputCase:
    """An array with another input."""

    array: ArrayAssessment  # with its design displacement then
    changed: str  # the other input, in words
    gaps: Sequence[ClearanceCheck]  # the clearances that involve the array, then

    @property
    def short(self) -> Sequence[ClearanceCheck]:
        """The clearances that would be NG."""
        return [gap for gap in self.gaps if gap.verdict is Verdict.NG]

    def words(self, us_first: bool) -> str:
        """Return it as a sentence."""
        return f"With {self.changed}, {self.array.id}: {', '.join(self._outcome(us_first))}."

    def _outcome(self, us_first: bool) -> Iterator[str]:
        design_m = self.array.design_m
        yield (
            "no design displacement"
            if math.isnan(design_m)
            else f"design displacement {pair(design_m, Quantity.DISPLACEMENT, us_first, no_less)}"
        )
        if self.array.has_unpermitted_value:
            yield NOT_PERMITTED
        failed = [clearance_check(gap) for gap in self.short]
        if self.array.lacks_slack:
            failed.append(slack_check(self.array.array, self.array.design_m, 0))
        if failed:
            yield f"NG: {', '.join(words(check, self.array.id) for check in failed)}"
        elif self.gaps and all(gap.ok for gap in self.gaps):
            yield "all its clearances OK" if len(self.gaps) > 1 else "its clearance OK"


def building_case(assessment: Assessment, variations: Variations) -> InputCase | None:
    """Return the governing array with the period or damping that lets it slide farthest, if any."""
    array = assessment.governing
    # Such a design displacement does not follow from one value of the analysis.
    if not variations or array.route is not Route.ANALYSIS:
        return None
    (used, _), *variants = variations
    building, value = max(variants, key=lambda pair: nan_is_worst(pair[1].value_m))
    design_m = math.nan if math.isnan(value.value_m) else max(value.value_m, array.floor_m)
    if not nan_is_worst(design_m) > array.design_m:
        return None
    is_damping = building.damping_percent != used.damping_percent
    changed = (
        f"{number(building.damping_percent, 1)}% building damping"
        if is_damping
        else f"a building period of {number(building.period_s or math.nan, 2)}{NO_BREAK}s"
    )
    farther = replace(array, analysis=value, design_m=design_m)
    slides = {array.id: farther.displacement}
    entered_gaps = assessment.gaps_of(array.id)
    gaps = [with_displacements(assessment, slides, gap) for gap in entered_gaps]
    return InputCase(array=farther, changed=changed, gaps=gaps)


def cases(assessment: Assessment, variations: Variations) -> Iterator[InputCase]:
    """Yield what would change the verdict on an array or exceed its prescriptive displacement."""
    of_building = building_case(assessment, variations)
    for case in (*_by_velocity(assessment), *([of_building] if of_building else [])):
        entered = by_id(assessment.arrays, case.array.id)
        most_m = case.array.prescriptive.value_m
        is_short = bool(case.short) and any(gap.ok for gap in assessment.gaps_of(entered.id))
        lacks_slack = case.array.lacks_slack and not entered.lacks_slack
        is_farther = entered.design_m <= most_m < nan_is_worst(case.array.design_m)
        if is_short or lacks_slack or is_farther:
            yield case


def _by_velocity(assessment: Assessment) -> Iterator[InputCase]:
    slow = assessment.low_velocity
    for item in slow.arrays:
        gaps = [gap for gap in slow.clearances.values() if gap.involves(item.id)]
        changed = f"μ = {coefficient(item.array.mu)} at all velocities"
        yield InputCase(array=item, changed=changed, gaps=gaps)
