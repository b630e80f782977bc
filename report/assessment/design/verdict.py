"""Verdicts from the mildest to the most severe, and texts common to several checks."""

from __future__ import annotations

from collections.abc import Iterable
from enum import StrEnum
from typing import Annotated

from pydantic import AfterValidator

from solver.rules.limit import Consequence


class Verdict(StrEnum):
    """Verdict on a project, an array or a clearance.

    NONE applies to a clearance of an array without a permitted procedure, whose own verdict is NG.
    NOTE applies to a requirement that affects no design displacement. CONDITIONS applies to a
    project, CONDITION to anything in it.
    """

    # From the mildest to the most severe: `worst` takes them in this order.
    NONE = "none"
    NOTE = "note"
    OK = "OK"
    CONDITION = "Condition"
    CONDITIONS = "OK with conditions"
    NG = "NG"

    @property
    def is_permitted(self) -> bool:
        """Whether it is not NG."""
        return self is not Verdict.NG


# Verdict in a project; results.json of version 0.2 has the project's word for a condition.
ItemVerdict = Annotated[
    Verdict, AfterValidator(lambda read: Verdict.CONDITION if read is Verdict.CONDITIONS else read)
]

BY_CONSEQUENCE = {
    Consequence.NG: Verdict.NG,
    Consequence.CONDITION: Verdict.CONDITION,
    Consequence.NOTE: Verdict.NOTE,
}


def worst(verdicts: Iterable[Verdict]) -> Verdict:
    """Return the most severe verdict; OK for none."""
    return max(verdicts, key=severity, default=Verdict.OK)


def severity(verdict: Verdict) -> int:
    """Return a sort key of verdicts, the largest for NG."""
    return list(Verdict).index(verdict)


NOT_GIVEN = "not entered"
NO_DESIGN = "unknown without a permitted design displacement"

# Of a remedy whose outcome the workbook has no cell for: no input takes the condition away.
STAYS = "This condition remains listed for the plan checker's decision."
