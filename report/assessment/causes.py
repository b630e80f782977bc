"""The checks that govern an assessment, and those that give an array its verdict.

Gives no verdict: the checks do (`report.assessment.checks`). Read `failed`, then `governing_words`.
"""

from __future__ import annotations

from collections.abc import Sequence

from report.assessment.assessment import Assessment
from report.assessment.checks.check import MOTIONS_ID, Check, by_ratio
from report.assessment.checks.sentence import alike, size, words
from report.assessment.design.arrays import ArrayAssessment
from report.assessment.design.verdict import Verdict
from report.text.counts import numbered
from report.text.grouping import grouped_by

# Checks that a sentence names.
MOST_NAMED = 4


def failed(done: Assessment) -> Sequence[Check]:
    """Return NG items, the worst first, without consequences of a missing displacement."""
    of_all = [check for check in done.open if check.verdict is Verdict.NG]
    # Only of what lacks nothing but a design displacement another check says why.
    causes = [check for check in of_all if not check.lacks_design] or of_all
    # A limit on the motions may be one on each array as well: the two say the same.
    titles = {check.title for check in causes if check.id != MOTIONS_ID}
    causes = [check for check in causes if check.id != MOTIONS_ID or check.title not in titles]
    # That no displacement is permitted follows from the others, too.
    ordered = sorted(causes, key=size, reverse=True)
    return sorted(ordered, key=lambda check: check.id == "design")


def largest(done: Assessment) -> Sequence[Check]:
    """Return the check with the largest ratio for each type of satisfied capacity."""
    satisfied = (
        check
        for check in done.checks
        if check.is_satisfied and check.is_capacity and check.id != MOTIONS_ID
    )
    kinds = grouped_by(by_ratio(satisfied), lambda check: check.id)
    return [group[0] for group in kinds.values()]


def governing_words(done: Assessment) -> str:
    """Return short names of the NG items, or else the clearance with the largest ratio."""
    clearance = [check for check in largest(done) if check.id == "clearance"]
    return "; ".join(named(failed(done) or clearance))


def came_to(done: Assessment) -> str:
    """Return the verdict on a project with what governs, e.g. `OK, clearance A1 to A2 …`."""
    return ", ".join(filter(None, (done.verdict.value, governing_words(done))))


def named(checks: Sequence[Check]) -> Sequence[str]:
    """Return short names of the first few checks, and the number of others."""
    count = len(checks) - MOST_NAMED
    further = [numbered(count, "more check")] if count > 0 else []
    return [*map(words, checks[:MOST_NAMED]), *further]


def causes(assessment: Assessment, item: ArrayAssessment) -> Sequence[str]:
    """Return the short causes of the verdict on an array; nothing for OK."""
    verdict = assessment.array_verdict(item)
    of_array = [check for check in assessment.checks if item.id in check.arrays]
    checks = alike(check for check in of_array if check.is_open and check.verdict is verdict)
    # That there is no permitted displacement follows from the others.
    ordered = sorted(checks, key=lambda check: check.id == "design")
    return [words(check, item.id) for check in ordered]


def unshown_cause(assessment: Assessment, item: ArrayAssessment) -> str:
    """Return the first cause of a verdict and the count of others; none if the D/C shows it."""
    verdict, reasons = assessment.array_verdict(item), causes(assessment, item)
    is_shown = any(gap.demand_capacity > 1.0 for gap in assessment.gaps_of(item.id))
    if not reasons or (verdict is Verdict.NG and is_shown):
        return ""
    first, *further = reasons
    return f"{first} and {numbered(len(further), 'more item')}" if further else first
