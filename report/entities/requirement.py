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
    """Warning or note."""
    id: str
    """Name by which a warning is acknowledged; empty where none can be."""
    cell: str
    """Cell of the workbook."""
    text: str
    """What was found."""
    reason: str
    """Why a warning is acknowledged; empty if it is not."""


class RequirementRow(Entity):
    """A requirement or a limit in a table of both."""

    subject: Annotated[str, words("Item", 0.95), Column()]
    title: Annotated[str, words("Requirement", 2.7), Column()]
    found: Annotated[str, words("Found", 3.65), Column()]
    limit: Annotated[str, words("Required", 2.35), Column()]
    basis: Annotated[str, words("Basis", 2.3), Column()]
    verdict: Annotated[Verdict, centered("Verdict", 1.3), Column()]
    remedy: Annotated[str, Column("What must be done")]


class _FoundAndLimit(Entity):
    """A value found and its limit, each under the key of its unit."""

    title: str
    """The limit in words."""
    found: OfUnit
    """Value found: a count or a ratio."""
    found_deg: OfUnit
    """Value found: an angle."""
    found_m: OfUnit
    """Value found: a length."""
    found_s: OfUnit
    """Value found: a time."""
    limit: OfUnit
    """Limit: a count or a ratio."""
    limit_deg: OfUnit
    """Limit: an angle."""
    limit_m: OfUnit
    """Limit: a length."""
    limit_s: OfUnit
    """Limit: a time."""

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
    """Clause that states it."""
    is_overridden: Annotated[bool, at("provision.reason"), BeforeValidator(bool)]
    """Whether the workbook overrides its number."""
    ok: bool
    """Whether the value is permitted."""
    by_exception: Annotated[bool, at("passes_by_exception")]
    """Whether it is permitted beyond the limit."""


class AcceptanceResult(_FoundAndLimit):
    """A limit on the motions, with the value found."""

    is_at_least: bool
    """Whether the limit is the least value accepted, not the largest."""
    worst: str
    """Motion, component and frequency of the value found; empty for that of all."""
    is_in_no_code: Annotated[bool, at("is_program_limit")]
    """Whether it is a limit of this program alone."""
    ok: bool
    """Whether the value is within the limit."""
    consequence: Consequence
    """What follows if it is not."""


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
