"""Arrays with another input, and with the low-velocity coefficient of friction alone."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

from report.assessment.checks.array_capacities import slack_check
from report.assessment.checks.clearance_checks import clearance_check
from report.assessment.checks.sentence import words
from report.assessment.design.arrays import ArrayAssessment
from report.assessment.design.clearances import ClearanceCheck, with_displacements
from report.assessment.design.friction_words import coefficient
from report.assessment.design.routes import NOT_PERMITTED
from report.assessment.design.verdict import Verdict
from report.text.units import Quantity, no_less, pair

if TYPE_CHECKING:
    from report.assessment.assessment import Assessment


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
        return f"{self.array.id} with {self.changed}: {', '.join(self._outcome(us_first))}."

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


@dataclass(frozen=True, slots=True, kw_only=True)
class LowVelocityAssessment:
    """The arrays whose friction depends on velocity, with the low-velocity coefficient alone."""

    arrays: tuple[ArrayAssessment, ...]  # empty where no friction depends on velocity
    # the clearances of these arrays, by their number in the workbook, from 1
    clearances: Mapping[int, ClearanceCheck]

    def of(self, array_id: str) -> ArrayAssessment | None:
        """Return an array; None where its friction does not depend on velocity."""
        return next((item for item in self.arrays if item.id == array_id), None)

    def gaps_of(self, array_id: str) -> Sequence[ClearanceCheck]:
        """Return the clearances that involve an array, on either side."""
        return [gap for gap in self.clearances.values() if gap.involves(array_id)]

    def case_of(self, array_id: str) -> InputCase | None:
        """Return an array as a case; None where its friction does not depend on velocity."""
        alone = self.of(array_id)
        if alone is None:
            return None
        changed = f"μ = {coefficient(alone.array.mu)} at every velocity"
        return InputCase(array=alone, changed=changed, gaps=self.gaps_of(array_id))


NOT_BY_VELOCITY = LowVelocityAssessment(arrays=(), clearances={})


def low_velocity(done: Assessment, slow: Assessment) -> LowVelocityAssessment:
    """Return what an assessment of `with_low_velocity` has of the arrays that it changes."""
    ids = {array.id for array in done.project.arrays if array.friction.is_by_velocity}
    return LowVelocityAssessment(
        arrays=tuple(item for item in slow.arrays if item.id in ids),
        # Arrays stay unlike that are so as given.
        clearances={
            count: with_displacements(done, slow.displacements, gap)
            for count, gap in enumerate(done.clearances, start=1)
            if not ids.isdisjoint(gap.between)
        },
    )
