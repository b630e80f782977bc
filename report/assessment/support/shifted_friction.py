"""The design with the friction coefficients decreased by 5%, as given, and increased.

A coefficient of 0.50 is run as 0.475 and as 0.525.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

from report.assessment.assess import reassess
from report.assessment.assessment import Assessment
from report.assessment.checks.check import Check
from report.assessment.checks.rule_limits import of_limit
from report.assessment.design.clearances import ClearanceCheck
from report.assessment.design.friction import SHIFT, with_friction


@dataclass(frozen=True, slots=True, kw_only=True)
class Accuracy:
    """The design with the friction coefficients decreased by 5%, as given, and increased."""

    at_reduced_friction: Assessment
    entered: Assessment
    at_increased_friction: Assessment

    @property
    def newly_short(self) -> tuple[ClearanceCheck, ...]:
        """Clearances that are satisfied as given but not with less friction."""
        pairs = zip(self.entered.clearances, self.at_reduced_friction.clearances, strict=True)
        return tuple(after for before, after in pairs if before.ok and not after.ok)

    @property
    def newly_limited(self) -> tuple[Check, ...]:
        """Limits of the routes taken that are satisfied as given but not with less friction."""
        checks: list[Check] = []
        for before, after in zip(self.entered.arrays, self.at_reduced_friction.arrays, strict=True):
            if all(limit.ok for limit in before.limits.required):
                # With less friction another route may be taken, whose limits are other ones.
                limits = replace(after.limits, route=before.route).required
                checks += [of_limit(limit, after.id) for limit in limits if not limit.ok]
        return tuple(checks)


def accuracy(assessment: Assessment) -> Accuracy:
    """Run all arrays with changed friction."""
    return Accuracy(
        at_reduced_friction=assessment.at_reduced_friction
        or reassess(assessment, with_friction(assessment.project, 1.0 - SHIFT)),
        entered=assessment,
        at_increased_friction=reassess(assessment, with_friction(assessment.project, 1.0 + SHIFT)),
    )
