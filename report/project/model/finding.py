"""Findings on a workbook: an error, or a value that is permitted but perhaps unintended."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum

from report.project.model.input_rows import Place
from solver.errors import Problem


class Level(StrEnum):
    """Weight of a finding: an error stops the work."""

    ERROR = "error"
    WARNING = "warning"
    NOTE = "note"


@dataclass(frozen=True, slots=True, kw_only=True)
class Finding:
    """An item in a workbook that is rejected, or permitted but perhaps unintended."""

    level: Level
    place: Place  # the cell to look at
    others: tuple[Place, ...] = ()  # further ones of its section
    text: str  # what was found; of a warning also what would do
    remedy: str = ""  # what would do, of an error
    id: str = ""  # by which the Acknowledged worksheet answers a warning; a limit has none
    reason: str = ""  # from the Acknowledged worksheet
    cell: str = ""  # address of a cell that is no input; empty for that of the place

    @classmethod
    def error(cls, place: Place, text: str, remedy: str = "") -> Finding:
        """Return an input error: what was found, and what is accepted."""
        return cls(level=Level.ERROR, place=place, text=text, remedy=remedy)

    def problem(self, where: str) -> Problem:
        """Return the error with its address."""
        return Problem(self.text, self.remedy, where)


def warning(name: str, place: Place, text: str) -> Finding:
    """Return a warning that may be acknowledged."""
    return Finding(level=Level.WARNING, id=name, place=place, text=text)


def limit(text: str, place: Place, *further: Place) -> Finding:
    """Return a warning that cannot be acknowledged, with the cells to look at."""
    return Finding(level=Level.WARNING, place=place, others=further, text=text)


def note(place: Place, text: str) -> Finding:
    """Return a note."""
    return Finding(level=Level.NOTE, place=place, text=text)
