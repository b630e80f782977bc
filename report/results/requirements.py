"""The sheet Requirements of results.xlsx: every requirement and limit with its verdict.

Computes nothing. Read `report.results.xlsx`.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import ClassVar

from report.assessment.overrides import OVERRIDDEN
from report.assessment.project import Assessment
from report.entities.requirement import RequirementRow, requirement_rows
from report.results.sheets import Pages, SheetRow, write_live
from solver.rules.limit import Limit


class RequirementLine(SheetRow, RequirementRow):
    """A requirement or a limit as a row of the sheet."""

    sheet: ClassVar[str] = "Requirements"


def write_requirements(pages: Pages, assessment: Assessment) -> None:
    """Write each requirement of the project and each limit of the rule set and on the motions."""
    write_live(
        pages,
        RequirementLine,
        list(map(RequirementLine.beside, _rows(assessment))),
        "Requirements and limits",
        "Satisfied or not. The verdict on the project and on each array is on the sheet Design.",
    )


def _rows(assessment: Assessment) -> Iterator[RequirementRow]:
    yield from requirement_rows(assessment.rows)
    for check in assessment.building_checks:
        yield _limit(assessment, "Building", check)
    for item in assessment.arrays:
        for check in item.limits:
            yield _limit(assessment, item.id, check)
    for check in assessment.acceptance.rows:
        yield _limit(assessment, "Motions", check)


def _limit(assessment: Assessment, item: str, row: Limit) -> RequirementRow:
    found, limit = (f"{v:.6g} {row.measure.unit}".rstrip() for v in (row.found, row.limit))
    is_excepted = row.passes_by_exception
    return RequirementRow(
        subject=item,
        title=row.title,
        found=found + (f" ({row.worst})" if row.worst else ""),
        limit=f"{row.sign} {limit}{OVERRIDDEN if row.provision.reason else ''}",
        basis=row.provision.clause,
        verdict=assessment.limit_verdict(row),
        remedy=f"over the limit, permitted: {row.provision.note}" if is_excepted else "",
    )
