"""Arrays whose friction depends on velocity, with the low-velocity coefficient alone."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING

from report.assessment.design.arrays import ArrayAssessment
from report.assessment.design.clearances import ClearanceCheck, with_displacements

if TYPE_CHECKING:
    from report.assessment.assessment import Assessment


@dataclass(frozen=True, slots=True, kw_only=True)
class LowVelocityAssessment:
    """The arrays whose friction depends on velocity, with the low-velocity coefficient alone."""

    arrays: tuple[ArrayAssessment, ...]  # empty where no friction depends on velocity
    # the clearances of these arrays, by their number in the workbook, from 1
    clearances: Mapping[int, ClearanceCheck]

    def of(self, array_id: str) -> ArrayAssessment | None:
        """Return an array; None where its friction does not depend on velocity."""
        return next((item for item in self.arrays if item.id == array_id), None)


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
