"""The sheet Requirements of results.xlsx: every requirement and limit with its verdict.

Computes nothing. Read `report.results.xlsx`.
"""

from __future__ import annotations

from collections.abc import Iterator

from report.assessment.overrides import OVERRIDDEN
from report.assessment.project import Assessment
from report.assessment.verdict import Requirement
from report.results.sheets import Pages, write_headings
from solver.rules.limit import Limit

_HEADINGS = ("Item", "Requirement", "Found", "Required", "Basis", "Verdict", "What must be done")


def write_requirements(pages: Pages, assessment: Assessment) -> None:
    """Write each requirement of the project and each limit of the rule set and on the motions."""
    sheet = pages.sheet(
        "Requirements",
        "Requirements and limits",
        "Satisfied or not. The verdict on the project and on each array is on the sheet Design.",
    )
    write_headings(pages, sheet, 3, _HEADINGS)
    for number, cells in enumerate(_rows(assessment), start=4):
        for column, text in enumerate(cells):
            sheet.write_string(number, column, text)


def _rows(assessment: Assessment) -> Iterator[tuple[str, ...]]:
    yield from map(_requirement, assessment.rows)
    for check in assessment.building_checks:
        yield _limit(assessment, "Building", check)
    for item in assessment.arrays:
        for check in item.limits:
            yield _limit(assessment, item.id, check)
    for check in assessment.acceptance.rows:
        yield _limit(assessment, "Motions", check)


def _requirement(row: Requirement) -> tuple[str, ...]:
    subject = row.subject or "Project"
    return (subject, row.title, row.found, row.limit, row.basis, row.verdict.word, row.remedy)


def _limit(assessment: Assessment, item: str, row: Limit) -> tuple[str, ...]:
    found, limit = (f"{v:.6g} {row.measure.unit}".rstrip() for v in (row.found, row.limit))
    return (
        item,
        row.title,
        found + (f" ({row.worst})" if row.worst else ""),
        f"{row.sign} {limit}{OVERRIDDEN if row.provision.reason else ''}",
        row.provision.clause,
        assessment.limit_verdict(row).word,
        f"over the limit, permitted: {row.provision.note}" if row.passes_by_exception else "",
    )
