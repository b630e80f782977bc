"""Limits and requirements: every check except those with their own tables, and remedies."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from report.assessment.assessment import Assessment
from report.assessment.checks.sentence import subjects
from report.assessment.design.verdict import Verdict
from report.assessment.precheck import findings
from report.assessment.remedies.remedy import MOST, Remedies
from report.assessment.support.evidence import Evidence
from report.document.tables import headed
from report.pages.checks import all_checks
from report.pages.parts import PackageData
from report.pages.saving import without_analysis
from report.project.check.finding_lines import lines
from report.project.model.finding import Level
from report.text.grouping import grouped_by
from report.text.letter_case import capitalized


def page(package: PackageData, evidence: Evidence) -> Mapping[str, object]:
    """Return the table of checks, the changes that would satisfy NG items, and the warnings."""
    done = package.assessment
    motions = f" and motions ({package.part('motions')})" if done.has_motions else ""
    # A contradiction of the plan is also among the requirements.
    all_findings = findings(done.source, done.project, done.shaking)
    of_input = [finding for finding in all_findings if finding.level is Level.WARNING]
    warnings = [
        (line.cell, f"{line.text}.", line.reason or "not acknowledged")
        for line in lines(of_input, done.source.addresses)
    ]
    columns = ("Cell", 1.2), ("Warning", 5.6), ("Reason given in the workbook", 3.2)
    return {
        "checks_caption": f"All checks except clearances ({package.part('plan')}){motions}",
        "checks": all_checks(done),
        "remedies": list(remedy_lines(done, evidence.remedies)),
        "warnings": headed(*columns, rows=warnings) if warnings else None,
    }


def remedy_lines(assessment: Assessment, remedies: Remedies) -> Iterator[str]:
    """Yield the sufficient set of changes, then the remedies of each NG check."""
    if len(remedies.together) > 1:
        yield remedies.sentence
    for checks, changes in grouped_by(remedies.own, lambda remedy: remedy.checks).items():
        titles = grouped_by(checks, lambda check: check.title)
        names = (", ".join(filter(None, (title, subjects(same)))) for title, same in titles.items())
        yield f"{'; '.join(names)}: {' '.join(change.sentence for change in changes)}"
    failed = sum(check.verdict is Verdict.NG for check in assessment.checks)
    if remedies.own and failed > MOST:
        yield f"Searched for the {MOST} with the largest ratio of {failed} that are NG."
    if remedies.own and not remedies.together:
        yield "No combination of these changes is sufficient."
    if assessment.has_motions and (lacks := without_analysis(assessment)):
        yield f"{capitalized(lacks)}"
