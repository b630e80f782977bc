"""What an analysis could save, where there are no motions and the displacement is prescriptive.

Runs nothing: the least that an analysis may give is the floor. Read `saving`.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

from report.assessment.arrays import ArrayAssessment
from report.assessment.clearances import check_clearance
from report.assessment.project import Assessment
from report.assessment.trials import displaced
from solver.rules.provisions import analysis_floor_m, review_lifts_slope


@dataclass(frozen=True, slots=True, kw_only=True)
class Saving:
    """The least design displacement that an analysis may give, and what it would satisfy."""

    ids: Sequence[str]  # arrays that may be analyzed
    others: Sequence[str]  # arrays on roofs that are too steep for it
    is_lifted_by_review: bool  # whether these may be analyzed with peer review
    prescriptive_m: float
    floor_m: float  # without peer review
    n_short: int  # clearances that are not satisfied now
    n_satisfied: int  # of them, with the arrays that may be analyzed at the floor


def saving(given: Assessment) -> Saving:
    """Return what an analysis could save in a project without motions."""
    at_floor = [_at_floor(given, item) if item.may_be_analyzed else item for item in given.arrays]
    short = [gap.clearance for gap in given.clearances if not gap.ok]
    checks = [check_clearance(given.project, given.rules, at_floor, row) for row in short]
    first = given.arrays[0]  # the prescriptive displacement is the same for every array
    return Saving(
        ids=[item.id for item in given.arrays if item.may_be_analyzed],
        others=[item.id for item in given.arrays if not item.may_be_analyzed],
        is_lifted_by_review=review_lifts_slope(given.rules, given.project.site.sdc),
        prescriptive_m=first.prescriptive.value_m,
        floor_m=analysis_floor_m(given.rules, first.prescriptive),
        n_short=len(short),
        n_satisfied=sum(check.ok for check in checks),
    )


def _at_floor(given: Assessment, item: ArrayAssessment) -> ArrayAssessment:
    floor_m = analysis_floor_m(given.rules, item.prescriptive)
    return replace(displaced(item, 0.0, floor_m), is_permitted=True)
