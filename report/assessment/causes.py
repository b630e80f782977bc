"""What gives an array its verdict, in a few words for its row in a table, and what gives an NG.

Draws no verdict: the checks do (`report.assessment.checks`). Read `unshown_cause`, then `outcome`.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

from report.assessment.checks.check import alike, words
from report.assessment.verdict import Verdict
from report.text.counts import ids_by, numbered, ranged

if TYPE_CHECKING:
    from report.assessment.arrays import ArrayAssessment
    from report.assessment.neighbors import ComparedGap
    from report.assessment.project import Assessment


def unshown_cause(assessment: Assessment, item: ArrayAssessment) -> str:
    """Return the first cause of a verdict and the count of others; none if the D/C shows it."""
    verdict, found = assessment.array_verdict(item), causes(assessment, item)
    is_shown = any(gap.demand_capacity > 1.0 for gap in assessment.gaps_of(item.id))
    if not found or (verdict is Verdict.NG and is_shown):
        return ""
    first, *others = found
    return f"{first} and {numbered(len(others), 'more item')}" if others else first


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
    of_all = [c for c in done.checks if not c.arrays and not c.verdict.is_permitted]
    return ProjectOutcome(
        verdict=done.verdict,
        gap=max(gaps, key=lambda gap: gap.demand_capacity, default=None),
        others=(
            *map(words, of_all),
            *(f"{ranged(ids)}: {cause}" for cause, ids in groups.items() if cause),
        ),
    )


def causes(assessment: Assessment, item: ArrayAssessment) -> Sequence[str]:
    """Return what gives an array its verdict, in a few words each; nothing for OK."""
    verdict = assessment.array_verdict(item)
    of_array = [check for check in assessment.checks if item.id in check.arrays]
    found = alike(check for check in of_array if check.is_open and check.verdict is verdict)
    # That there is no permitted displacement follows from the others.
    return list(map(words, sorted(found, key=lambda check: check.id == "design")))
