"""Requirements, limits and warnings as they are written and shown.

Computes nothing. Read `LimitResult`; a requirement is written as it is
(`report.assessment.verdict`) and shown as a `RequirementRow`. `Marked` marks the numbers.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from typing import Annotated, Any

from pydantic import BeforeValidator, model_validator

from report.assessment.arrays import ArrayAssessment, DesignBasis
from report.assessment.checks.check import Check, dagger, found_and_limit
from report.assessment.project import Assessment
from report.assessment.routes import SEAOC
from report.assessment.verdict import ItemVerdict, Verdict
from report.entities.shown import (
    LEFT_OUT,
    Beside,
    Column,
    Entity,
    OfUnit,
    UnitFormat,
    at,
    centered,
    words,
)
from report.sheet.checking.findings import located
from report.sheet.schema import ProjectInput
from report.sheet.schema.fields import Finding, Level, Place
from report.text.units import Quantity, no_less
from solver.rules.limit import Consequence, Limit
from solver.rules.provisions import PrescriptiveBasis


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
    title: Annotated[str, words("Requirement", 3.1), Column()]
    found: Annotated[str, words("Found", 3.95), Column()]
    limit: Annotated[str, words("Required", 2.45), Column()]
    basis: Annotated[str, words("Basis", 1.85), Column()]
    verdict: Annotated[Verdict, centered("Verdict", 1.1), Column()]
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
    found_mps: OfUnit
    """Value found: a velocity."""
    limit: OfUnit
    """Limit: a count or a ratio."""
    limit_deg: OfUnit
    """Limit: an angle."""
    limit_m: OfUnit
    """Limit: a length."""
    limit_s: OfUnit
    """Limit: a time."""
    limit_mps: OfUnit
    """Limit: a velocity."""

    @model_validator(mode="before")
    @classmethod
    def _with_units(cls, row: Any) -> Any:
        # Read back from results.json it is a mapping with these keys already.
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
    shown = tuple(findings)
    for finding, cell in zip(shown, located(shown, addresses), strict=True):
        yield FindingResult.of(finding, cell=cell)


class Requirement(Entity):
    """A requirement compared with the project, besides the numeric limits."""

    id: str
    """Kind of requirement."""
    title: str
    """As printed."""
    found: str
    """As printed."""
    limit: str
    """As printed."""
    basis: Annotated[str, at("clause")]
    """Document and clause, or whose practice it is."""
    is_satisfied: bool
    """Whether the project satisfies it."""
    consequence: Consequence
    """Where it is not satisfied."""
    subject: str
    """Id of the array or motion that it concerns; empty for the project."""
    remedy: str
    """What the engineer must do where it is not satisfied, as a sentence."""
    outcome: Annotated[str, at("otherwise")]
    """What another input in its place comes to, as a sentence."""
    verdict: ItemVerdict
    """Of this requirement alone."""


def requirements(checks: Iterable[Check], us_first: bool) -> Iterator[Requirement]:
    """Yield checks as results.json has them."""
    for check in checks:
        found, limit = found_and_limit(check, us_first)
        yield Requirement.of(check, found=found, limit=limit)


def requirement_rows(checks: Iterable[Check], us_first: bool) -> Iterator[RequirementRow]:
    """Yield checks as rows of a table."""
    for check in checks:
        found, limit = found_and_limit(check, us_first)
        subject = check.subject or "Project"
        yield RequirementRow.of(
            check, subject=subject, found=found, limit=limit, basis=check.clause
        )


UNVERIFIED = (
    "Numbers marked † have not been compared with the text of the adopted document and shall be "
    "verified against it"
)


def joined(marks: str, more: str) -> str:
    """Return marks, each once."""
    # A displacement and what follows from it may rest on one override.
    return marks if more in marks else marks + more


@dataclass(frozen=True, kw_only=True)
class Marked:
    """An assessment with the marks of its numbers and its system of units."""

    assessment: Assessment
    # Whether numbers that were not compared with the adopted document are marked.
    has_daggers: bool = True

    @property
    def data(self) -> ProjectInput:
        """The input."""
        return self.assessment.project

    @property
    def fmt(self) -> UnitFormat:
        """Format of values."""
        return UnitFormat(us_first=self.data.us_first)

    def both(self, value_si: float, quantity: str = "DISPLACEMENT") -> str:
        """Return a value in both systems of units: `81.6 in (2072 mm)`."""
        return self.fmt.both(value_si, Quantity[quantity])

    def both_up(self, value_si: float, quantity: str = "DISPLACEMENT") -> str:
        """Return what is required, or what a requirement follows from, rounded up."""
        return self.fmt.both(value_si, Quantity[quantity], no_less)

    def mark(self, key: str) -> str:
        """Return the marks of a provision."""
        marks = dagger(self.assessment.rules.values[key])
        return marks if self.has_daggers else marks.removeprefix("†")

    @property
    def mark_of_seaoc(self) -> str:
        """The mark of the displacement by SEAOC PV1."""
        is_known = SEAOC.values["prescriptive_factor_in"].verified or not self.has_daggers
        return "" if is_known else "†"

    def clause(self, key: str) -> str:
        """Return the clause of a provision with its marks."""
        return self.assessment.rules.values[key].clause + self.mark(key)

    def prescriptive_key(self, array: ArrayAssessment) -> str:
        """Return which provision the prescriptive displacement comes from."""
        return {
            PrescriptiveBasis.FORMULA: "prescriptive_factor_in",
            PrescriptiveBasis.MINIMUM: "prescriptive_minimum_in",
            PrescriptiveBasis.LOW_CATEGORY: "prescriptive_low_sdc_in",
        }[array.prescriptive.governs]

    def design_mark(self, array: ArrayAssessment) -> str:
        """Return the marks of a design displacement."""
        if math.isnan(array.design_m):
            return ""
        if array.governs is DesignBasis.PRESCRIPTIVE:
            return joined(self.mark(self.prescriptive_key(array)), array.design_mark)
        # A number is marked by the provision that it comes from, not by all that were compared.
        key = "analysis_floor" if array.governs is DesignBasis.FLOOR else "analysis_factor"
        return joined(self.mark(key), array.design_mark)

    def prescriptive_mark(self, array: ArrayAssessment) -> str:
        """Return the marks of the prescriptive displacement."""
        mark = array.prescriptive_mark("§") if self.has_daggers else array.prescriptive_mark()
        return joined(self.mark(self.prescriptive_key(array)), mark)

    def floor_mark(self, array: ArrayAssessment) -> str:
        """Return the marks of the floor of an array, if it has one."""
        if self.data.is_peer_reviewed:
            return ""
        return joined(self.mark("analysis_floor"), array.mark(lambda item: item.floor_m))
