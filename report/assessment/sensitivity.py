"""Sensitivity of the design to the friction coefficient.

Runs the solver and collects numbers; `report.pages.accuracy` prints them.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

from report.assessment.arrays import ArrayAssessment
from report.assessment.assess import reassess
from report.assessment.clearances import ClearanceCheck
from report.assessment.friction import SHIFT, with_friction
from report.assessment.project import Assessment
from solver.rules.limit import Limit


@dataclass(frozen=True, slots=True, kw_only=True)
class Accuracy:
    """The design with the friction coefficients decreased by 5 %, as given, and increased."""

    at_reduced_friction: Assessment
    given: Assessment
    at_increased_friction: Assessment

    @property
    def newly_short(self) -> tuple[ClearanceCheck, ...]:
        """Clearances that are satisfied as given but not with less friction."""
        pairs = zip(self.given.clearances, self.at_reduced_friction.clearances, strict=True)
        return tuple(after for before, after in pairs if before.ok and not after.ok)

    @property
    def newly_limited(self) -> tuple[tuple[ArrayAssessment, Limit], ...]:
        """Limits of the routes taken that are satisfied as given but not with less friction."""
        pairs = zip(self.given.arrays, self.at_reduced_friction.arrays, strict=True)
        return tuple(
            (after, check)
            for before, after in pairs
            if all(check.ok for check in before.limits)
            # With less friction another route may be taken, whose limits are other ones.
            for check in replace(after, route=before.route).limits
            if not check.ok
        )


def accuracy(given: Assessment) -> Accuracy:
    """Run all arrays with changed friction."""
    return Accuracy(
        at_reduced_friction=given.at_reduced_friction
        or reassess(given, with_friction(given.project, 1.0 - SHIFT)),
        given=given,
        at_increased_friction=reassess(given, with_friction(given.project, 1.0 + SHIFT)),
    )
