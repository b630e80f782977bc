"""The limits of the rule set on the building and on each array, of both routes."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import replace
from typing import TYPE_CHECKING

from report.assessment.checks.check import Check, Sense, dagger
from report.assessment.routes import Route
from report.text.amounts import limit_amounts
from solver.rules.limit import Consequence, Limit, Measure

if TYPE_CHECKING:
    from report.assessment.arrays import ArrayAssessment
    from report.assessment.project import Assessment


def of_building(done: Assessment) -> Iterator[Check]:
    """Yield the limits on the building."""
    return map(of_limit, done.building_checks)


def of_array(done: Assessment, item: ArrayAssessment) -> Iterator[Check]:
    """Yield the limits on an array; of the route that is not taken each is a note."""
    for limit in item.limits:
        yield of_limit(limit, item.id)
    is_analysis = item.route is Route.ANALYSIS
    for limit in item.prescriptive_checks if is_analysis else item.analysis_checks:
        # Without motions nobody takes the analysis: how many there are says nothing.
        if is_analysis or done.has_motions:
            yield replace(of_limit(limit, item.id), consequence=Consequence.NOTE)


def of_limit(limit: Limit, subject: str = "") -> Check:
    """Return a limit of the solver as a check."""
    found, required = limit_amounts(limit)
    marks = dagger(limit.provision)
    return Check(
        id=limit.key,
        title=limit.title,
        subject=subject,
        arrays=(subject,) if subject else (),
        found="no value" if math.isnan(limit.found) else found,
        limit=replace(required, mark=marks),
        sense=Sense.AT_LEAST if limit.is_at_least else Sense.AT_MOST,
        note=f"permitted: {limit.provision.note}" if limit.passes_by_exception else limit.worst,
        clause=limit.provision.clause + marks,
        is_satisfied=limit.ok,
        consequence=limit.consequence,
        is_capacity=limit.measure is not Measure.COUNT,
        remedy=_REMEDIES.get(limit.key, ""),
    )


_REMEDIES = {
    "low_profile_in": "Lower the center of gravity of the array, or widen its supports.",
    "prescriptive_min_mu": "Provide more friction, shown by tests.",
    "analysis_min_motions": "Complete the motions.",
}
