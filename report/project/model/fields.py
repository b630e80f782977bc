"""Drafts of an input, places in them, what is found there, and the base of the models."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from enum import StrEnum
from typing import Any, NamedTuple

from pydantic import BaseModel, ConfigDict

from solver.model import Problem


class Place(NamedTuple):
    """A cell by meaning: section, row of its table, field; without the last two, a whole table."""

    section: str
    row: int = 0
    field: str = ""


class Level(StrEnum):
    """Weight of a finding: an error stops the work."""

    ERROR = "error"
    WARNING = "warning"
    NOTE = "note"


@dataclass(frozen=True, slots=True, kw_only=True)
class Finding:
    """Something in a workbook that is refused, or permitted and perhaps not meant."""

    level: Level
    place: Place  # the cell to look at
    others: tuple[Place, ...] = ()  # further ones of its section
    text: str  # what was found; of a warning also what would do
    remedy: str = ""  # what would do, of an error
    id: str = ""  # by which the sheet Acknowledged answers a warning; a limit has none
    reason: str = ""  # from the sheet Acknowledged
    cell: str = ""  # address of a cell that is no input; empty for that of the place

    @classmethod
    def error(cls, place: Place, found: str, remedy: str = "") -> Finding:
        """Return an input error: what was found, and what would be accepted."""
        return cls(level=Level.ERROR, place=place, text=found, remedy=remedy)

    def problem(self, where: str) -> Problem:
        """Return the error with its address."""
        return Problem(self.text, self.remedy, where)


DraftRow = Mapping[str, Any]
"""Fields of a row of a draft; a field that could not be read is absent."""

Draft = Mapping[str, Sequence[DraftRow]]
"""Rows by section, as far as they could be read."""

Where = Callable[[Place], str]
"""Returns the address of a place."""


class YesNo(StrEnum):
    """Yes or no, as shown in a cell."""

    YES = "Yes"
    NO = "No"


class Frozen(BaseModel):
    """Base of all models: frozen, complete, finite."""

    model_config = ConfigDict(
        frozen=True, extra="forbid", allow_inf_nan=False, str_strip_whitespace=True
    )
