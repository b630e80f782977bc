"""The sheet Requirements of results.xlsx: every requirement and limit with its verdict.

Computes nothing. Read `report.results.xlsx`.
"""

from __future__ import annotations

from collections.abc import Iterator

from report.assessment.overrides import OVERRIDDEN
from report.assessment.project import Assessment
from report.assessment.verdict import BY_CONSEQUENCE, Row, Verdict
from report.results.sheets import Pages, write_headings
from solver.records.acceptance_row import AcceptanceRow
from solver.rules.provisions import Check

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
        yield _limit("Building", check)
    for item in assessment.arrays:
        for check in item.limits:
            yield _limit(item.id, check)
    yield from map(_on_motions, assessment.acceptance.rows)


def _requirement(row: Row) -> tuple[str, ...]:
    subject = row.subject or "Project"
    return (subject, row.title, row.found, row.limit, row.basis, row.verdict.word, row.remedy)


def _limit(item: str, check: Check) -> tuple[str, ...]:
    unit = {"deg": " deg", "m": " m", "count": "", "": ""}[check.measure]
    sign = "≤" if check.at_most else "≥"
    result = Verdict.OK if check.ok else Verdict.NG
    by_exception = f"over the limit, permitted: {check.provision.note}"
    return (
        item,
        check.title,
        f"{check.value:.6g}{unit}",
        f"{sign} {check.limit:.6g}{unit}{OVERRIDDEN if check.provision.reason else ''}",
        check.provision.clause,
        result.word,
        by_exception if check.passes_by_exception else "",
    )


def _on_motions(row: AcceptanceRow) -> tuple[str, ...]:
    unit = " s" if row.unit == "s" else ""
    worst = f" ({row.worst})" if row.worst else ""
    return (
        "Motions",
        row.title,
        f"{row.found:.6g}{unit}{worst}",
        f"{'≥' if row.is_at_least else '≤'} {row.limit:.6g}{unit}",
        "limit of this program" if row.is_program_limit else "limit on motions for analysis",
        (Verdict.OK if row.satisfied else BY_CONSEQUENCE[row.consequence]).word,
        "",
    )
