"""Requirements, limits and warnings as they are written and shown.

Computes nothing. Read `RequirementResult`.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from report.assessment.precheck import findings
from report.assessment.project import Assessment
from report.entities.shown import Entity
from report.sheet.fields import Level
from report.sheet.findings import located
from solver.rules.limit import Limit


class FindingResult(Entity):
    """A warning or note on the input."""

    level: Level
    id: str
    cell: str
    text: str
    reason: str


def finding_results(assessment: Assessment) -> Iterator[FindingResult]:
    """Yield the warnings and notes on the input, each with its cell."""
    found = findings(assessment.sheet, assessment.shaking)
    for finding, cell in zip(found, located(found, assessment.sheet.addresses), strict=True):
        yield FindingResult.of(finding, cell=cell)


def limit(row: Limit) -> dict[str, Any]:
    """Return a limit of the rule set."""
    return {
        **_compared(row),
        "clause": row.provision.clause,
        "is_overridden": bool(row.provision.reason),
        "ok": row.ok,
        "by_exception": row.passes_by_exception,
    }


def acceptance(row: Limit) -> dict[str, Any]:
    """Return a limit on the motions."""
    return {
        **_compared(row),
        "is_at_least": row.is_at_least,
        "worst": row.worst,
        "is_in_no_code": row.is_program_limit,
        "ok": row.ok,
        "consequence": row.consequence,
    }


def _compared(row: Limit) -> dict[str, Any]:
    """Return the value found and the limit, with the unit in the keys."""
    unit = f"_{row.measure.unit}".rstrip("_")
    return {"title": row.title, f"found{unit}": row.found, f"limit{unit}": row.limit}
