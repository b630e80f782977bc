"""One limit, with the value found and what follows from a miss.

Owns no limit: `solver.rules.provisions` and `solver.records.acceptance` do. Read `Limit`.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from enum import StrEnum

from solver.rules.rulesets import Confidence, Provision

_EQUAL = 1e-9
"""Relative difference of a value from its limit that is rounding: 1 in 20 is typed as 5 percent."""


MOTIONS = Provision(value=math.nan, clause="motions for analysis", confidence=Confidence.KNOWN)
"""Of the limits on motions that AC156 and practice give, which no rule set states."""

PROGRAM = Provision(value=math.nan, clause="limit of this program", confidence=Confidence.CONFIRMED)
"""Of the limits that stand in no code: there is nothing to verify there."""


class Consequence(StrEnum):
    """What follows from a limit or a requirement that is not satisfied."""

    NG = "NG"
    CONDITION = "condition"
    NOTE = "note"


class Measure(StrEnum):
    """Quantity of a limit, which determines its units and format."""

    ANGLE_DEG = "deg"
    LENGTH_M = "m"
    TIME_S = "s"
    COUNT = "count"
    PLAIN = ""

    @property
    def unit(self) -> str:
        """Its unit in SI; empty for a count and a ratio."""
        return "" if self is Measure.COUNT else self.value


@dataclass(frozen=True, slots=True, kw_only=True)
class Limit:
    """A value compared with what is required; NaN is never satisfied.

    Attributes
    ----------
    title : str
    found, limit : float
        In the unit of `measure`.
    is_at_least : bool
        Whether the limit is the smallest value accepted; otherwise it is the largest.
    consequence : Consequence
        If it is not satisfied.
    provision : Provision
        Of the rule set that states it; `MOTIONS` or `PROGRAM` where none does.
    key : str
        Of the provision in the rule set.
    may_exceed : bool
        Whether the rule set permits this project to exceed the limit.
    worst : str
        Motion, component and frequency of the value found; empty if it is that of all.
    is_ratio_to_target : bool
        Whether the value found is a spectrum over its target.
    """

    title: str
    found: float
    limit: float
    is_at_least: bool
    measure: Measure = Measure.PLAIN
    consequence: Consequence = Consequence.NG
    provision: Provision = MOTIONS
    key: str = ""
    may_exceed: bool = False
    worst: str = ""
    is_ratio_to_target: bool = False

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
        """Whether the limit is that of this program: it stands in no code."""
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
