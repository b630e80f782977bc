"""One limit, with the value found and the consequence of exceeding it.

A roof slope of 3.5 degrees exceeds a limit of 3 degrees; the consequence is NG.

Defines no limit: `solver.rules.provisions` and `solver.records.acceptance` do. Read `Limit`.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from enum import StrEnum

from solver.rules.rulesets import Confidence, Provision

# Relative difference of a value from its limit that is rounding: 1 in 20 is typed as 5 percent.
_EQUAL = 1e-9

# Of the limits on motions that AC156 and practice give, which no rule set states.
MOTIONS = Provision(value=math.nan, clause="motions for analysis", confidence=Confidence.KNOWN)

# Of the limits that stand in no code: there is nothing to verify there.
PROGRAM = Provision(
    value=math.nan, clause="limit set by this program", confidence=Confidence.CONFIRMED
)


class Consequence(StrEnum):
    """Consequence of a limit or a requirement that is not satisfied."""

    NG = "NG"
    CONDITION = "condition"
    NOTE = "note"


class Measure(StrEnum):
    """Quantity of a limit, which determines its units and format."""

    ANGLE_DEG = "deg"
    LENGTH_M = "m"
    TIME_S = "s"
    VELOCITY_MPS = "mps"
    COUNT = "count"
    PLAIN = ""

    @property
    def unit(self) -> str:
        """Its unit in SI; empty for a count and a ratio."""
        return "" if self is Measure.COUNT else self.value


@dataclass(frozen=True, slots=True, kw_only=True)
class Limit:
    """A value compared with its limit; NaN is never satisfied."""

    title: str
    found: float  # as the limit, in the unit of `measure`
    limit: float
    is_at_least: bool  # the limit is the smallest value accepted; otherwise the largest
    measure: Measure = Measure.PLAIN
    consequence: Consequence = Consequence.NG
    provision: Provision = MOTIONS  # of the rule set; `MOTIONS` or `PROGRAM` where none states it
    key: str = ""  # of the provision in the rule set
    may_exceed: bool = False  # as the rule set permits this project
    worst: str = ""  # motion, component and frequency of the value found; empty if of all
    is_ratio_to_target: bool = False  # found is a spectrum over its target

    @property
    def ok(self) -> bool:
        """Whether the value is permitted; one equal to the limit within rounding is."""
        return self._is_within or self.passes_by_exception

    @property
    def passes_by_exception(self) -> bool:
        """Whether the value is beyond the limit, which the rule set permits here."""
        return self.may_exceed and not self._is_within and not math.isnan(self.found)

    @property
    def is_program_limit(self) -> bool:
        """Whether the limit is set by this program and is in no code."""
        return self.provision.clause == PROGRAM.clause  # another process has an object of its own

    @property
    def sign(self) -> str:
        """At least or at most, as printed."""
        return "≥" if self.is_at_least else "≤"

    @property
    def _is_within(self) -> bool:
        pair = (self.found, self.limit) if self.is_at_least else (self.limit, self.found)
        return at_least(*pair)


def at_least(value: float, limit: float) -> bool:
    """Return whether a value is a limit or more, but for rounding."""
    return value >= limit - _EQUAL * abs(limit)
