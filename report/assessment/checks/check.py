"""A requirement on a project, as one record.

A limit of the code, a document on file, a clearance, a property of the motions, an outcome of a
run: each is a `Check`, satisfied or not.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from enum import StrEnum
from functools import partial
from typing import NamedTuple

from report.assessment.design.rule_set import OVERRIDDEN
from report.assessment.design.verdict import (
    BY_CONSEQUENCE,
    NO_DESIGN,
    NOT_GIVEN,
    Verdict,
    severity,
    worst,
)
from report.project.model.input_rows import Place
from report.text.amounts import Amount
from report.text.units import nan_is_worst
from solver.rules.limit import PROGRAM, Consequence
from solver.rules.rulesets import Provision

# Id of the limits on the motions.
MOTIONS_ID = "motions"
# Id of the requirement on friction beyond the velocities tested.
VELOCITY_ROW = "friction_velocity"
# Id of the requirement that clearances are given as the plan has them.
PLAN_ROW = "neighbors"
# Id of the requirement on the strength between the parts of an array.
STRENGTH_ROW = "interconnection"

OVERRIDE_ID = "override"
# Ids of the rows here.
LOWERING = (OVERRIDE_ID, "statistic")

THIS_PROGRAM = PROGRAM.clause

# By so much may a ratio be above 1 by rounding.
_NOISE = 1e-6


class Actor(StrEnum):
    """Party who must act if a check is not satisfied."""

    ENGINEER = "engineer"
    LABORATORY = "laboratory"
    REVIEWER = "reviewer"
    JURISDICTION = "jurisdiction"
    FIRE = "fire dept."
    SUPPLIER = "racking"
    ROOF = "roof eng."
    WIND = "wind eng."


class Sense(StrEnum):
    """Comparison of the value found with the value required."""

    AT_LEAST = "≥"
    AT_MOST = "≤"
    EQUAL = "="
    STATED = ""  # words with words

    @property
    def words(self) -> str:
        """The comparison as text for a sentence."""
        return _SENSES[self]


_SENSES = {
    Sense.AT_LEAST: "at least",
    Sense.AT_MOST: "at most",
    Sense.EQUAL: "equal to",
    Sense.STATED: "",
}


@dataclass(frozen=True, slots=True, kw_only=True)
class Check:
    """One requirement and the value found. Always present, satisfied or not."""

    id: str
    """Type of requirement, such as `max_stories`, `clearance` or `peer_review`; stable."""
    title: str
    found: Amount | str
    """The value found; text if it is not a number."""
    limit: Amount | str
    """The value required."""
    sense: Sense = Sense.STATED
    clause: str
    """Document and section with its mark, or whose practice it is."""
    is_satisfied: bool
    """Determined by the numbers, never by the texts."""
    consequence: Consequence = Consequence.NG
    """Consequence if it is not satisfied."""
    is_capacity: bool = True
    """Whether its ratio is demand / capacity and may govern; a count of motions is not."""
    subject: str = ""
    """Array, motion or clearance, as printed; empty for the project."""
    arrays: tuple[str, ...] = ()
    """Arrays whose verdict it is part of; a clearance is part of two."""
    note: str = ""
    """Location or derivation of the value found: `RM1 y, 1.41 Hz`, `96.0 in − 40.8 in`."""
    actor: Actor = Actor.ENGINEER
    remedy: str = ""
    """Action that would satisfy it, as a sentence."""
    cell: str = ""
    """Cell that the sentence ends with, in parentheses."""
    otherwise: str = ""
    """Result for the project if it is not met, or with another input, as a sentence."""
    places: tuple[Place, ...] = ()
    """Cells of the workbook."""

    @property
    def verdict(self) -> Verdict:
        """Of this check alone."""
        return Verdict.OK if self.is_satisfied else BY_CONSEQUENCE[self.consequence]

    @property
    def to_close(self) -> str:
        """The remedy if it is not satisfied; empty if no action is required."""
        cell = f" ({self.cell})." if self.cell else ""
        return "" if self.is_satisfied else self.remedy.removesuffix("." if cell else "") + cell

    @property
    def is_note(self) -> bool:
        """Whether it has no consequence, satisfied or not."""
        return self.consequence is Consequence.NOTE

    @property
    def is_open(self) -> bool:
        """Whether it is NG or a condition."""
        return not self.is_satisfied and not self.is_note

    @property
    def lacks_design(self) -> bool:
        """Whether it only lacks a design displacement; a separate check states why."""
        return NO_DESIGN in (self.found, self.limit)

    @property
    def is_excepted(self) -> bool:
        """Whether it is satisfied although its limit is exceeded, as stated in its note."""
        has_numbers = isinstance(self.found, Amount) and isinstance(self.limit, Amount)
        return self.is_satisfied and has_numbers and math.isnan(self.ratio)

    @property
    def ratio(self) -> float:
        """Demand / capacity: more than 1 is not satisfied.

        Infinity if a required number is missing; NaN for text, and for a permitted exceedance.
        """
        if isinstance(self.limit, str):
            return math.nan
        if isinstance(self.found, str):
            return math.nan if self.is_satisfied else math.inf
        pair = [self.found.value, self.limit.value]
        if self.sense is Sense.AT_LEAST:
            pair.reverse()
        elif self.sense is Sense.EQUAL:
            pair.sort(reverse=True)
        demand, capacity = pair
        # Nothing required of nothing is 0: an array that does not slide needs no slack. Of a
        # pathway into which arrays slide farther than it is wide, less than nothing is left.
        is_none = capacity <= 0.0
        value = (math.inf if demand > 0.0 else 0.0) if is_none else demand / capacity
        # A slope that peer review permits beyond its limit would be printed as D/C 1.20 beside OK.
        return math.nan if self.is_satisfied and value > 1.0 + _NOISE else value


# What is a condition where it is not satisfied.
condition = partial(Check, consequence=Consequence.CONDITION)


def dagger(provision: Provision) -> str:
    """Return the marks of a number: † unverified, ‡ overridden."""
    return ("" if provision.verified else "†") + (OVERRIDDEN if provision.reason else "")


def by_ratio(checks: Iterable[Check]) -> Sequence[Check]:
    """Return NG items, then conditions, then capacities, each with the largest ratio first."""
    ranked = [
        check
        for check in checks
        if check.is_open
        or (check.is_capacity and not check.is_note and not math.isnan(check.ratio))
    ]
    return sorted(ranked, key=lambda check: (-severity(check.verdict), -nan_is_worst(check.ratio)))


def verdict_of(checks: Iterable[Check], array: str = "") -> Verdict:
    """Return the verdict on an array, or on the project: the worst of its checks."""
    worst_verdict = worst(check.verdict for check in checks if not array or array in check.arrays)
    is_project = not array and worst_verdict is Verdict.CONDITION
    # Checks that are notes leave an OK: a note comes before OK in the order of severity.
    return Verdict.CONDITIONS if is_project else max(worst_verdict, Verdict.OK, key=severity)


class StatedParts(NamedTuple):
    """The entered parts of a block, and the cells of the missing ones."""

    found: str
    missing: tuple[Place, ...]


def stated(section: str, **parts: tuple[str, object]) -> StatedParts:
    """Return the entered parts of a block, each with a name and a value by its field."""
    values = [str(value) for _, value in parts.values() if value]
    missing = {field: name for field, (name, value) in parts.items() if not value}
    lacks = [f"{', '.join(missing.values())} missing"] if missing else []
    stated_text = "; ".join([*values, *lacks]) if values else NOT_GIVEN
    return StatedParts(stated_text, tuple(Place(section, 0, field) for field in missing))
