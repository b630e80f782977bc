"""One limit on the motions of an analysis, with the value found and what follows from a miss.

Owns no limit: `solver.records.acceptance` and `solver.records.spectrum_acceptance` do. Read
`AcceptanceRow`.
"""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum


class Consequence(StrEnum):
    """What follows from a row that is not satisfied."""

    NG = "NG"
    CONDITION = "condition"


@dataclass(frozen=True, slots=True, kw_only=True)
class AcceptanceRow:
    """One limit on the motions, with the value found.

    Attributes
    ----------
    title : str
    found, limit : float
        In `unit`; the found value is that of the worst motion or component.
    is_at_least : bool
        Whether the limit is the smallest value accepted; otherwise it is the largest.
    worst : str
        Motion, component and frequency of the value found; empty if it is that of all.
    unit : str
        ``s``, ``count``, or empty for a ratio.
    is_program_limit : bool
        Whether the limit is that of this program: it stands in no code.
    consequence : Consequence
        If the row is not satisfied.
    """

    title: str
    found: float
    limit: float
    is_at_least: bool
    worst: str
    unit: str = ""
    is_program_limit: bool = False
    consequence: Consequence = Consequence.NG

    @property
    def satisfied(self) -> bool:
        """Whether the value found is within the limit, compared unrounded; NaN is not."""
        return self.found >= self.limit if self.is_at_least else self.found <= self.limit
