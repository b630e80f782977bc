"""Changes since a previous revision of a package."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum


class ChangeKind(StrEnum):
    """Type of change, in the order of the page."""

    RULES = "rule set"
    SOFTWARE = "software"
    INPUT = "input"
    RECORD = "record"
    DOCUMENT = "document"
    ANALYSIS = "analysis displacement"
    DESIGN = "design displacement"
    CLEARANCE = "clearance"
    REQUIREMENT = "requirement"
    VERDICT = "verdict"


@dataclass(frozen=True, slots=True, kw_only=True)
class Change:
    """One change."""

    kind: ChangeKind
    title: str  # what changed, with the array, motion or clearance that it belongs to
    # as printed
    before: str
    now: str
    cell: str = ""  # address in the workbook; empty for what has no cell


@dataclass(frozen=True, slots=True, kw_only=True)
class Changes:
    """All changes since a previous revision."""

    # of the former package
    revision: str = ""
    date: str = ""
    items: tuple[Change, ...] = ()
    arrays: frozenset[str] = frozenset()  # ids of arrays with another result
    # array and key of results.json, or array and motion, whose number changed
    values: frozenset[tuple[str, str]] = frozenset()
    clearances: frozenset[int] = frozenset()  # numbers of the clearances that changed, from 1

    @property
    def is_asked_for(self) -> bool:
        """Whether a previous revision was specified."""
        return bool(self.revision)

    @property
    def cells(self) -> frozenset[str]:
        """Addresses of the input cells that changed."""
        return frozenset(item.cell for item in self.items if item.cell)

    def count(self, kind: ChangeKind) -> int:
        """Return the number of changes of a kind."""
        return sum(item.kind is kind for item in self.items)


# Of a package that is compared with none.
NO_FORMER = Changes()
