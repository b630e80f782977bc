"""Requirements, limits and warnings as they are written and shown.

Computes nothing. Read `RequirementResult`.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from report.assessment.precheck import findings
from report.assessment.project import Assessment
from report.assessment.verdict import Verdict
from report.entities.shown import Entity
from report.sheet.findings import Level, located
from solver.records.acceptance_row import AcceptanceRow, Consequence
from solver.rules.provisions import Check


class FindingResult(Entity):
    """A warning or note on the input."""

    level: Level
    id: str
    cell: str
    text: str
    reason: str


class RequirementResult(Entity):
    """A requirement beside the numeric limits, with its verdict."""

    id: str
    title: str
    found: str
    limit: str
    basis: str
    is_satisfied: bool
    consequence: Consequence
    subject: str
    remedy: str
    verdict: Verdict


def finding_results(assessment: Assessment) -> Iterator[FindingResult]:
    """Yield the warnings and notes on the input, each with its cell."""
    found = findings(assessment.sheet, assessment.shaking)
    for finding, cell in zip(found, located(found, assessment.sheet.addresses), strict=True):
        yield FindingResult.of(finding, cell=cell)


def limit(check: Check) -> dict[str, Any]:
    """Return a limit of the rule set, with the unit in the keys."""
    unit = {"deg": "_deg", "m": "_m", "count": "", "": ""}[check.measure]
    return {
        "title": check.title,
        f"found{unit}": check.value,
        f"limit{unit}": check.limit,
        "clause": check.provision.clause,
        "is_overridden": bool(check.provision.reason),
        "ok": check.ok,
        "by_exception": check.passes_by_exception,
    }


def acceptance(row: AcceptanceRow) -> dict[str, Any]:
    """Return a limit on the motions, with the unit in the keys."""
    unit = "_s" if row.unit == "s" else ""
    return {
        "title": row.title,
        f"found{unit}": row.found,
        f"limit{unit}": row.limit,
        "is_at_least": row.is_at_least,
        "worst": row.worst,
        "is_in_no_code": row.is_program_limit,
        "ok": row.satisfied,
        "consequence": row.consequence,
    }
