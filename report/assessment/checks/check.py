"""Whatever is required of a project, as one record, and the one sentence that says it.

A limit of the code, a document on file, a clearance, a property of the motions, an outcome of a
run: each is a `Check`, satisfied or not. Terminal, package, tables and page print `sentence`, or
the parts of it in columns. Read `Check`, then `sentence`.
"""

from __future__ import annotations

import math
from collections.abc import Hashable, Iterable, Sequence
from dataclasses import dataclass, replace
from enum import StrEnum
from functools import partial
from typing import NamedTuple

from report.assessment.verdict import (
    BY_CONSEQUENCE,
    NO_DESIGN,
    NOT_GIVEN,
    OVERRIDDEN,
    Verdict,
    severity,
    worst,
)
from report.project.model.place import Place
from report.text.amounts import Amount, amount_text, amount_texts
from report.text.counts import capitalized, grouped_by, lowered, ranged
from report.text.units import Quantity, Rounding, nan_is_worst, ratio
from solver.rules.limit import PROGRAM, Consequence
from solver.rules.provisions import Provision

THIS_PROGRAM = PROGRAM.clause
# Kinds whose subjects are pairs, which do not count on as A1 to A3 do.
PAIRS = ("clearance", "neighbors", "fire_pathway")
# By so much may a ratio be above 1 by rounding.
_NOISE = 1e-6


class Actor(StrEnum):
    """Who must act where a check is not satisfied."""

    ENGINEER = "engineer"
    LABORATORY = "laboratory"
    REVIEWER = "reviewer"
    JURISDICTION = "jurisdiction"
    FIRE = "fire dept."
    SUPPLIER = "racking"
    ROOF = "roof eng."
    WIND = "wind eng."


class Sense(StrEnum):
    """How what is found is compared with what is required."""

    AT_LEAST = "≥"
    AT_MOST = "≤"
    EQUAL = "="
    STATED = ""  # words with words

    @property
    def words(self) -> str:
        """The same in a sentence."""
        return _SENSES[self]


_SENSES = {
    Sense.AT_LEAST: "at least",
    Sense.AT_MOST: "at most",
    Sense.EQUAL: "equal to",
    Sense.STATED: "",
}


@dataclass(frozen=True, slots=True, kw_only=True)
class Check:
    """One thing that is required, and what was found. Always present, satisfied or not."""

    id: str
    """Kind of requirement, such as `max_stories`, `clearance` or `peer_review`; stable."""
    title: str
    found: Amount | str
    """What the project has; words where it is no number."""
    limit: Amount | str
    """What is required of it."""
    sense: Sense = Sense.STATED
    clause: str
    """Document and clause with its mark, or whose practice it is."""
    is_satisfied: bool
    """By the numbers, never by the texts."""
    consequence: Consequence = Consequence.NG
    """What follows where it is not satisfied."""
    is_capacity: bool = True
    """Whether its ratio is demand over capacity, which may govern; a count of motions is none."""
    subject: str = ""
    """Array, motion or clearance, as printed; empty for the project."""
    arrays: tuple[str, ...] = ()
    """Arrays whose verdict it is part of; a clearance is part of two."""
    note: str = ""
    """Where or from what it was found: `RM1 y, 1.41 Hz`, `96.0 in − 40.8 in`."""
    actor: Actor = Actor.ENGINEER
    remedy: str = ""
    """What they must do to satisfy it, as a sentence."""
    otherwise: str = ""
    """What the project comes to if it is not met, or with another input, as a sentence."""
    places: tuple[Place, ...] = ()
    """Cells of the workbook."""

    @property
    def verdict(self) -> Verdict:
        """Of this check alone."""
        return Verdict.OK if self.is_satisfied else BY_CONSEQUENCE[self.consequence]

    @property
    def to_close(self) -> str:
        """The remedy of what is not satisfied; empty where nothing is to be done."""
        return "" if self.is_satisfied else self.remedy

    @property
    def is_note(self) -> bool:
        """Whether nothing follows from it, satisfied or not."""
        return self.consequence is Consequence.NOTE

    @property
    def is_open(self) -> bool:
        """Whether it is NG or a condition."""
        return not self.is_satisfied and not self.is_note

    @property
    def lacks_design(self) -> bool:
        """Whether it only lacks a design displacement, whose own check says why."""
        return NO_DESIGN in (self.found, self.limit)

    @property
    def is_excepted(self) -> bool:
        """Whether it is satisfied beyond its limit, as its note says."""
        has_numbers = isinstance(self.found, Amount) and isinstance(self.limit, Amount)
        return self.is_satisfied and has_numbers and math.isnan(self.ratio)

    @property
    def ratio(self) -> float:
        """Demand / capacity: more than 1 is not satisfied.

        Infinity where nothing is given that a number is required of; NaN of words, and of what is
        permitted beyond its limit.
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
        value = demand / capacity if capacity else math.inf if demand else 0.0
        return math.nan if self.is_satisfied and value > 1.0 + _NOISE else value


def texts(check: Check, us_first: bool, *, is_both: bool = True) -> tuple[str, str]:
    """Return what is found and what is required with its sign, for two cells of a table.

    Numbers are rounded to the safe side, and so that their order shows. Where it is not both
    systems, they are in the preferred one alone.
    """
    found, limit = _texts(check, us_first, is_both=is_both)
    is_amount = isinstance(check.limit, Amount)
    return found, f"{check.sense} {limit}" if is_amount else limit


def found_and_limit(check: Check, us_first: bool) -> tuple[str, str]:
    """Return the same in both systems, what is found with its note."""
    found, limit = texts(check, us_first)
    return found + (f" ({check.note})" if check.note else ""), limit


def sentence(check: Check, us_first: bool) -> str:
    """Return a check in words: of what, what was found, what is required and by which clause."""
    found, limit = _texts(check, us_first)
    of = f"{check.title}, {check.subject}" if check.subject else check.title
    found += f" ({check.note})" if check.note else ""
    if isinstance(check.limit, Amount):
        limit = f"{check.sense.words} {limit}"
    close = check.to_close  # of a note it says what does not follow
    if check.is_open and close:
        close = f"To close: {lowered(close)}"
    parts = f"{of}: {found}.", f"Required: {limit} ({check.clause}).", close, check.otherwise
    return capitalized(" ".join(filter(None, parts)))


def _texts(check: Check, us_first: bool, *, is_both: bool = True) -> tuple[str, str]:
    found, limit = check.found, check.limit
    if isinstance(found, Amount) and isinstance(limit, Amount):
        is_at_least = check.sense is Sense.AT_LEAST
        if check.sense is Sense.EQUAL:
            is_at_least = (found.value >= limit.value) is check.is_satisfied
        return amount_texts(found, limit, us_first, is_at_least=is_at_least, is_both=is_both)
    first, second = (
        each if isinstance(each, str) else amount_text(each, us_first, is_both=is_both)
        for each in (found, limit)
    )
    return first, second


def words(check: Check, array: str = "") -> str:
    """Return a check in a few words: `roof slope of A1 (D/C 1.29)`; or in the row of an array."""
    name = lowered(check.title)
    if check.subject not in ("", array):
        name += f" {check.subject}" if check.id in PAIRS else f" of {check.subject}"
    if math.isinf(check.ratio) and isinstance(check.found, str):
        return f"{name}: {check.found}"
    if isinstance(check.limit, Amount) and check.limit.quantity is Quantity.COUNT:
        found, limit = _texts(check, us_first=True)
        return f"{name} ({found}, {check.sense.words} {limit})"
    has_ratio = check.is_capacity and not math.isnan(check.ratio)
    return f"{name} (D/C {ratio(check.ratio)})" if has_ratio else name


def alike(checks: Iterable[Check]) -> Sequence[Check]:
    """Return checks that ask the same of several subjects as one each, with what each has."""

    def asked(check: Check) -> Hashable:
        # Of numbers the worst stands for all, whatever each is compared with.
        limit = "" if isinstance(check.limit, Amount) else check.limit
        return check.id, check.title, limit, check.clause, check.verdict, check.actor

    return [_as_one(group) for group in grouped_by(checks, asked).values()]


def _as_one(group: Sequence[Check]) -> Check:
    first = group[0]
    if len(group) == 1:
        return first
    worst_one = max(group, key=_size)
    found, limit, note = worst_one.found, worst_one.limit, worst_one.note
    if isinstance(limit, Amount):
        if any((each.found, each.limit) != (found, limit) for each in group):
            limit = replace(limit, mark=f"{limit.mark} ({worst_one.subject})")
    elif all(isinstance(each.found, Amount) for each in group):
        found = _apart(group)
    else:
        found, note = _found(group), ""
    return replace(
        worst_one,
        subject=subjects(group),
        found=found,
        limit=limit,
        note=note,
        arrays=tuple(dict.fromkeys(id for check in group for id in check.arrays)),
        remedy=" ".join(dict.fromkeys(check.remedy for check in group)),
        otherwise=" ".join(dict.fromkeys(c.otherwise for c in group if c.otherwise)),
        places=tuple(dict.fromkeys(place for check in group for place in check.places)),
    )


def _size(check: Check) -> tuple[float, float]:
    # Where none of them is given the largest that is required is shown.
    limit = check.limit.value if isinstance(check.limit, Amount) else 0.0
    return nan_is_worst(check.ratio), nan_is_worst(limit)


def _apart(group: Sequence[Check]) -> Amount:
    """Return of amounts that nothing is compared with the one on the safe side."""
    amounts = [(each.found, each.subject) for each in group if isinstance(each.found, Amount)]
    least = amounts[0][0].rounding is Rounding.DOWN
    found, subject = (min if least else max)(amounts, key=lambda each: each[0].value)
    is_one = all(each == found for each, _ in amounts)
    return found if is_one else replace(found, mark=f"{found.mark} ({subject})")


def _found(group: Sequence[Check]) -> str:
    """Return in words what is found: what all share is said once."""
    all_parts = [
        [*str(check.found).split("; "), *([check.note] if check.note else [])] for check in group
    ]
    shared = [part for part in all_parts[0] if all(part in parts for parts in all_parts)]
    own = grouped_by(
        zip(group, all_parts, strict=True),
        lambda each: ", ".join(part for part in each[1] if part not in shared),
    )
    others = [f"{subjects([check for check, _ in of])}: {text}" for text, of in own.items() if text]
    return "; ".join([*shared, *others])


def subjects(group: Sequence[Check]) -> str:
    """Return what checks of one kind are of: `A1 to A3`, or the worst pair and how many more."""
    names = list(dict.fromkeys(check.subject for check in group))
    if group[0].id not in PAIRS or len(names) == 1:
        return ranged(names)
    return f"{max(group, key=_size).subject} and {len(names) - 1} more"


def by_ratio(checks: Iterable[Check]) -> Sequence[Check]:
    """Return what is NG, then conditions, then the capacities, each the largest ratio first."""
    shown = [
        check
        for check in checks
        if check.is_open
        or (check.is_capacity and not check.is_note and not math.isnan(check.ratio))
    ]
    return sorted(shown, key=lambda check: (-severity(check.verdict), -nan_is_worst(check.ratio)))


def verdict_of(checks: Iterable[Check], array: str = "") -> Verdict:
    """Return the verdict on an array, or on the project: the worst of its checks."""
    found = worst(check.verdict for check in checks if not array or array in check.arrays)
    is_project = not array and found is Verdict.CONDITION
    return Verdict.CONDITIONS if is_project else max(found, Verdict.OK, key=severity)


def dagger(provision: Provision) -> str:
    """Return the marks of a number: † unverified, ‡ overridden."""
    return ("" if provision.verified else "†") + (OVERRIDDEN if provision.reason else "")


# What is a condition where it is not satisfied.
condition = partial(Check, consequence=Consequence.CONDITION)


class StatedParts(NamedTuple):
    """What a block states of several parts, and the cells of those that it lacks."""

    found: str
    missing: tuple[Place, ...]


def stated(section: str, **parts: tuple[str, object]) -> StatedParts:
    """Return what a block states of its parts, each a name and a value by its field."""
    values = [str(value) for _, value in parts.values() if value]
    missing = {field: name for field, (name, value) in parts.items() if not value}
    lacks = [f"{', '.join(missing.values())} missing"] if missing else []
    found = "; ".join([*values, *lacks]) if values else NOT_GIVEN
    return StatedParts(found, tuple(Place(section, 0, field) for field in missing))
