"""What gives an array its verdict, in a few words for its row in a table, and what gives an NG.

Draws no verdict: `Assessment.array_verdict` does. Read `unshown_cause`, then `reasons`.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

from report.assessment.precheck import limit_words
from report.assessment.routes import lacking_motions, statistic_basis
from report.assessment.verdict import Requirement, Verdict, nan_is_worst
from report.text.amounts import capacity, compared_pairs, demand
from report.text.counts import ids_by, lowered, ranged
from report.text.units import Quantity, ratio
from solver.model import Status
from solver.rules.provisions import review_lifts_slope

if TYPE_CHECKING:
    from report.assessment.arrays import ArrayAssessment
    from report.assessment.clearances import ClearanceCheck
    from report.assessment.neighbors import ComparedGap
    from report.assessment.project import Assessment
    from solver.rules.limit import Limit


def unshown_cause(assessment: Assessment, item: ArrayAssessment) -> str:
    """Return the first cause of a verdict and the count of others; none if the D/C shows it."""
    verdict, reasons = assessment.array_verdict(item), causes(assessment, item)
    is_shown = any(gap.demand_capacity > 1.0 for gap in assessment.gaps_of(item.id))
    if not reasons or (verdict is Verdict.NG and is_shown):
        return ""
    return reasons[0] + (f" and {len(reasons) - 1} more" if len(reasons) > 1 else "")


@dataclass(frozen=True, slots=True, kw_only=True)
class ProjectOutcome:
    """What an input comes to: verdict, governing clearance, and what else makes it NG."""

    verdict: Verdict
    gap: ComparedGap | None  # none without a required separation
    others: tuple[str, ...]

    def words(self, us_first: bool) -> str:
        """Return it in a few words, such as `NG, A3 to RTU-2 60.4 > 60.0 in`."""
        mark = "; " if self.gap is None else ", "
        return mark.join(filter(None, (self.verdict.value, self.causes(us_first))))

    def causes(self, us_first: bool) -> str:
        """Return the same without the verdict; what is NG before a clearance that is satisfied."""
        if self.gap is None:
            return "; ".join(self.others)
        gap, is_short = self.gap.words(us_first), self.gap.demand_capacity > 1.0
        return "; ".join((gap, *self.others) if is_short else (*self.others, gap))


def outcome(done: Assessment) -> ProjectOutcome:
    """Return what an assessment comes to."""
    gaps = [gap for gap in (*done.clearances, *done.missing_gaps) if gap.demand_capacity >= 0.0]
    failed = (item for item in done.arrays if done.array_verdict(item) is Verdict.NG)
    groups = ids_by(failed, lambda item: unshown_cause(done, item))
    return ProjectOutcome(
        verdict=done.verdict,
        gap=max(gaps, key=lambda gap: gap.demand_capacity, default=None),
        others=(
            *(_limit(check) for check in done.building_checks if not check.ok),
            *(f"{ranged(ids)}: {cause}" for cause, ids in groups.items() if cause),
        ),
    )


def causes(assessment: Assessment, item: ArrayAssessment) -> Sequence[str]:
    """Return what gives an array its verdict, in a few words each; nothing for OK."""
    verdict = assessment.array_verdict(item)
    rows = [row for row in assessment.rows_of(item.id) if row.verdict is verdict]
    of_rows = [row.cause or lowered(row.title) for row in rows if not row.is_satisfied]
    if verdict is not Verdict.NG:
        return of_rows
    statuses = {run.result.status for run in item.runs}
    on_motions = item.governs is not item.governs.PRESCRIPTIVE
    return [
        # Up to its colon a sentence says what happened, and after it what follows.
        *(s.sentence.split(":")[0] for s in Status if s in statuses and s is not Status.OK),
        *(_limit(check) for check in item.limits if not check.ok),
        *(["limits on the motions"] if on_motions and not assessment.acceptance.qualifies else []),
        *([] if item.tipping.is_ok else ["tipping"]),
        *([] if assessment.is_rigid_enough(item) else ["one rigid block"]),
        *(
            f"clearance to {gap.across_from(item.id)}{'' if gap.is_permitted else ', no verdict'}"
            for gap in assessment.gaps_of(item.id)
            if not gap.ok
        ),
        *of_rows,
    ]


def _limit(check: Limit) -> str:
    return f"{lowered(check.title)}, {'below' if check.is_at_least else 'over'} its limit"


def reasons(assessment: Assessment) -> Iterator[str]:
    """Yield what makes a project NG, each with array, value, limit and what would do, in order."""
    # What the clearances rest on is before them.
    us_first = assessment.project.us_first
    for check in (check for check in assessment.building_checks if not check.ok):
        yield f"building, {limit_words(check, us_first)}"
    for item in assessment.arrays:
        for check in (check for check in item.limits if not check.ok):
            otherwise = _way_out(assessment, item, check)
            yield f"array {item.id}, {limit_words(check, us_first)}{otherwise}"
    few = [each.id for each in assessment.arrays if each.lacks_motions]
    if few:
        basis, count = statistic_basis(assessment.project), len(assessment.shaking.motions)
        yield f"{ranged(few)}, {lacking_motions(assessment.rules, basis, count)}"
    for run in assessment.warnings:
        yield f"{lowered(run.text.rstrip('.'))}; {run.would_do}"
    yield from _models(assessment)
    for gap in short_clearances(assessment):
        yield short_words(gap, us_first)
    for row, ids in assessment.alike_conditions:
        if not row.verdict.is_permitted:
            yield row_words(row, ids)


def short_clearances(assessment: Assessment) -> Sequence[ClearanceCheck]:
    """Return the clearances that are not satisfied, that with the largest D/C first."""
    short = (gap for gap in assessment.clearances if not gap.verdict.is_permitted)
    return sorted(short, key=lambda gap: -nan_is_worst(gap.demand_capacity))


def _way_out(assessment: Assessment, item: ArrayAssessment, check: Limit) -> str:
    """Return that motions would do, where the prescriptive route alone is not permitted."""
    if assessment.has_motions or check not in item.prescriptive_checks:
        return ""
    is_lifted = review_lifts_slope(assessment.rules, assessment.project.site.sdc)
    if not (item.may_be_analyzed or is_lifted):
        return ""
    review = "" if item.may_be_analyzed else " with peer review"
    return f"; or give motions on the sheet Motions, for an analysis{review}"


def row_words(row: Requirement, subjects: Sequence[str]) -> str:
    """Return a requirement that is not satisfied, with all that it is said of."""
    where = f"{ranged(subjects)}, " if row.subject else ""
    words = f"{where}{lowered(row.title)}: {row.found}; required: {row.limit}. {row.remedy}"
    return f"{words} {row.outcome}".rstrip()


def _models(assessment: Assessment) -> Iterator[str]:
    """Yield arrays that tip, and those that one rigid block may not stand for."""
    for item in assessment.arrays:
        if not item.tipping.is_ok:
            tips = "starts to tip" if item.runs else "may start to tip"
            tipping = f"{ratio(item.tipping.ratio)} of the ratio at which it tips; 1.00 or less is"
            yield (
                f"array {item.id} {tips}: {tipping} required, with a lower center of gravity or"
                " wider supports"
            )
    for name in (row.design.id for row in assessment.linked if not row.is_rigid_enough):
        yield f"one rigid block has not been shown to be adequate for array {name}"


def short_words(gap: ClearanceCheck, us_first: bool) -> str:
    """Return a clearance that is too small, with what would do."""
    row = gap.clearance
    provided, required = compared_pairs(
        capacity(row.provided_m), demand(gap.required_m), Quantity.SIZE, us_first
    )
    name = f"clearance {row.array} to {row.object}: {provided} provided"
    if math.isnan(gap.required_m):
        return f"{name}; there is no design displacement of {gap.governing_array} to compare with"
    return f"{name}; {required}{gap.mark} required (D/C {gap.ratio_words})"
