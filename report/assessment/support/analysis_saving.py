"""Possible savings by an analysis, for a project whose motions do not permit one. With a
prescriptive displacement of 1.00 m the floor of PV1-2012 is 0.50 m: a clearance of 0.60 m to a
fixed object that is NG now would be enough.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from report.assessment.assessment import Assessment
from report.assessment.design.arrays import Displacement
from report.assessment.design.clearances import with_displacements
from report.assessment.design.routes import Route
from solver.rules.provisions import analysis_floor_m, review_lifts_slope


@dataclass(frozen=True, slots=True, kw_only=True)
class Saving:
    """The smallest design displacement possible with an analysis, and what it would satisfy."""

    lacks: Sequence[str]  # limits that the motions miss, in words; none without motions
    ids: Sequence[str]  # arrays that may be analyzed, and are not
    others: Sequence[str]  # arrays on roofs that are too steep for it
    is_lifted_by_review: bool  # whether these may be analyzed with peer review
    prescriptive_m: float
    floor_m: float  # without peer review
    n_short: int  # clearances that are not satisfied now
    n_satisfied: int  # of them, with the arrays that may be analyzed at the floor


def saving(assessment: Assessment) -> Saving:
    """Return the possible savings by an analysis, for a project whose motions do not permit one."""
    first = assessment.arrays[0]  # the prescriptive displacement is the same for every array
    floor_m = analysis_floor_m(assessment.rules, first.prescriptive)
    without = [item for item in assessment.arrays if item.route is Route.PRESCRIPTIVE]
    ids = [item.id for item in without if item.limits.may_be_analyzed]
    at_floor = dict.fromkeys(ids, Displacement(floor_m))
    short = [gap for gap in assessment.clearances if not gap.ok]
    checks = [with_displacements(assessment, at_floor, gap) for gap in short]
    return Saving(
        lacks=assessment.against_analysis(first) if assessment.has_motions else [],
        ids=ids,
        others=[item.id for item in without if not item.limits.may_be_analyzed],
        is_lifted_by_review=review_lifts_slope(assessment.rules, assessment.project.site.sdc),
        prescriptive_m=first.prescriptive.value_m,
        floor_m=floor_m,
        n_short=len(short),
        n_satisfied=sum(check.ok for check in checks),
    )
