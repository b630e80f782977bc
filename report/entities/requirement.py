"""Checks and warnings as results.json has them, and an assessment with the marks of its numbers.

Computes nothing. Read `CheckResult`, then `Marked`.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass

from report.assessment.arrays import ArrayAssessment, DesignBasis
from report.assessment.checks.check import Actor, dagger, texts
from report.assessment.project import Assessment
from report.assessment.routes import SEAOC
from report.assessment.verdict import ItemVerdict
from report.entities.shown import (
    Entity,
    Number,
    UnitFormat,
)
from report.project.check.findings import located
from report.project.model import ProjectInput
from report.project.model.fields import Finding, Level, Place
from report.text.amounts import Amount
from report.text.units import Quantity, no_less
from solver.rules.limit import Consequence
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


def finding_results(
    findings: Iterable[Finding], addresses: Mapping[Place, str]
) -> Iterator[FindingResult]:
    """Yield warnings and notes on the input, each with its cell."""
    shown = tuple(findings)
    for finding, cell in zip(shown, located(shown, addresses), strict=True):
        yield FindingResult.of(finding, cell=cell)


class CheckResult(Entity):
    """A check as results.json has it: everything that is required, satisfied or not."""

    id: str
    """Kind of check, such as `max_stories`, `clearance` or `peer_review`."""
    title: str
    """As printed."""
    subject: str
    """Array, motion or clearance, as printed; empty for the project."""
    arrays: tuple[str, ...]
    """Ids of the arrays whose verdict it is part of."""
    found: Number
    """Value found, in the unit; null where it is words, or no value."""
    limit: Number
    """Value required, in the unit; null where it is words."""
    unit: str
    """Unit of both; empty for a count or a ratio."""
    found_text: str
    """As printed, in both systems of units."""
    limit_text: str
    """As printed, with its sign."""
    note: str
    """Where or from what it was found."""
    clause: str
    """Section of the code with its mark, or whose practice it is."""
    is_satisfied: bool
    """Whether the project satisfies it."""
    consequence: Consequence
    """Where it is not satisfied."""
    verdict: ItemVerdict
    """Of this check alone."""
    ratio: Number
    """Demand / capacity; null for words, and where a required number is not entered."""
    actor: Actor
    """Who must act where it is not satisfied."""
    remedy: str
    """What they must do, as a sentence; empty where it is satisfied."""
    otherwise: str
    """What the project comes to if it is not met, as a sentence."""
    cells: tuple[str, ...]
    """Cells of the workbook."""


def check_results(assessment: Assessment) -> Iterator[CheckResult]:
    """Yield the checks of a project, in their order."""
    us_first, addresses = assessment.project.us_first, assessment.sheet.addresses
    for check in assessment.checks:
        found_text, limit_text = texts(check, us_first)
        amounts = [x for x in (check.found, check.limit) if isinstance(x, Amount)]
        yield CheckResult.of(
            check,
            found=_value(check.found),
            limit=_value(check.limit),
            unit=amounts[0].quantity.base if amounts else "",
            found_text=found_text,
            limit_text=limit_text,
            remedy=check.to_close,
            cells=[addresses[place] for place in check.places if place in addresses],
        )


def _value(amount: Amount | str) -> float:
    return amount.value if isinstance(amount, Amount) else math.nan


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
            return joined(self.mark(self.prescriptive_key(array)), array.overridden.design)
        # A number is marked by the provision that it comes from, not by all that were compared.
        key = "analysis_floor" if array.governs is DesignBasis.FLOOR else "analysis_factor"
        return joined(self.mark(key), array.overridden.design)

    def prescriptive_mark(self, array: ArrayAssessment) -> str:
        """Return the marks of the prescriptive displacement."""
        mark = array.prescriptive_mark("§") if self.has_daggers else array.prescriptive_mark()
        return joined(self.mark(self.prescriptive_key(array)), mark)

    def floor_mark(self, array: ArrayAssessment) -> str:
        """Return the marks of the floor of an array, if it has one."""
        if self.data.is_peer_reviewed:
            return ""
        return joined(self.mark("analysis_floor"), array.overridden.floor)
