"""Requirements, limits and warnings as they are written and shown.

Computes nothing. Read `LimitResult`; a requirement is written as it is
(`report.assessment.verdict`) and shown as a `RequirementRow`.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from typing import Annotated, Any

from pydantic import BeforeValidator, model_validator

from report.assessment.verdict import Requirement, Verdict
from report.entities.cells import Column
from report.entities.shown import LEFT_OUT, Beside, Entity, OfUnit, at, centered, words
from report.sheet.checking.findings import located
from report.sheet.schema.fields import Finding, Level, Place
from solver.rules.limit import Consequence, Limit


class FindingResult(Entity):
    """A warning or note on the input."""

    level: Level
    id: str
    cell: str
    text: str
    reason: str


class RequirementRow(Entity):
    """A requirement or a limit in a table of both."""

    subject: Annotated[str, words("Item", 0.9), Column()]
    title: Annotated[str, words("Requirement", 2.3), Column()]
    found: Annotated[str, words("Found", 2.6), Column()]
    limit: Annotated[str, words("Required", 1.9), Column()]
    basis: Annotated[str, words("Basis", 1.5), Column()]
    verdict: Annotated[Verdict, centered("Verdict", 1.8), Column()]
    remedy: Annotated[str, Column("What must be done")]


class _FoundAndLimit(Entity):
    """A value found and its limit, each under the key of its unit."""

    title: str
    found: OfUnit
    found_deg: OfUnit
    found_m: OfUnit
    found_s: OfUnit
    limit: OfUnit
    limit_deg: OfUnit
    limit_m: OfUnit
    limit_s: OfUnit

    @model_validator(mode="before")
    @classmethod
    def _with_units(cls, row: Any) -> Any:
        if not isinstance(row, Limit):
            return row
        unit = f"_{row.measure.unit}".rstrip("_")
        plain = {"found": LEFT_OUT, "limit": LEFT_OUT}
        return Beside(row, plain | {f"found{unit}": row.found, f"limit{unit}": row.limit})


class LimitResult(_FoundAndLimit):
    """A limit of the rule set, with the value found."""

    clause: Annotated[str, at("provision.clause")]
    is_overridden: Annotated[bool, at("provision.reason"), BeforeValidator(bool)]
    ok: bool
    by_exception: Annotated[bool, at("passes_by_exception")]


class AcceptanceResult(_FoundAndLimit):
    """A limit on the motions, with the value found."""

    is_at_least: bool
    worst: str
    is_in_no_code: Annotated[bool, at("is_program_limit")]
    ok: bool
    consequence: Consequence


def finding_results(
    findings: Iterable[Finding], addresses: Mapping[Place, str]
) -> Iterator[FindingResult]:
    """Yield warnings and notes on the input, each with its cell."""
    found = tuple(findings)
    for finding, cell in zip(found, located(found, addresses), strict=True):
        yield FindingResult.of(finding, cell=cell)


def requirement_rows(requirements: Iterable[Requirement]) -> Iterator[RequirementRow]:
    """Yield requirements as rows of a table."""
    for row in requirements:
        yield RequirementRow.of(row, subject=row.subject or "Project")
