"""Items of an assessment that need attention, NG first: for terminal, JSON and browser page."""

from __future__ import annotations

from collections.abc import Iterator

from report.assessment.assessment import Assessment
from report.assessment.checks.sentence import alike, sentence
from report.assessment.precheck import findings
from report.assessment.remedies.remedy import remedies
from report.pages.saving import without_analysis
from report.project.check.finding_lines import lines
from report.project.model.finding import Level
from solver.rules.limit import Consequence


def attention(assessment: Assessment, *, may_run: bool = True) -> Iterator[tuple[str, str]]:
    """Yield unsatisfied items, NG first, and remedies, with runs or not; each with its level.

    Levels are NG, remedy, condition, note and warning.
    """
    us_first, is_best_due = assessment.project.us_first, assessment.at_reduced_friction is not None
    failed = [check for check in assessment.open if not check.verdict.is_permitted]
    for check in failed:
        yield Consequence.NG.value, sentence(check, us_first)
    # The verdict with a remedy depends on less friction as well.
    if is_best_due and (change := remedies(assessment, may_run=may_run)).together:
        yield "remedy", change.sentence
    for check in assessment.open[len(failed) :]:
        yield check.consequence.value, sentence(check, us_first)
    if lacks := without_analysis(assessment):
        yield Consequence.NOTE.value, lacks
    for check in alike(assessment.notes):
        yield Consequence.NOTE.value, sentence(check, us_first)
    listed = findings(assessment.source, assessment.project, assessment.shaking)
    for line in lines(listed, assessment.source.addresses):
        if line.level is Level.WARNING:
            answer = f" Acknowledged: {line.reason}" if line.reason else ""
            yield "warning", f"{line.cell}: {line.text} [{line.id}]{answer}"
