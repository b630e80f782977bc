"""The problems of an input: equal ones of several cells become one.

Writes no text of its own but the count. Read `grouped`.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass

from solver.model import Problem

MOST_LISTED = 3
"""Cells and ids named of equal errors and findings."""


@dataclass(frozen=True, slots=True)
class Group:
    """A problem of one cell, of several of a sheet, or of none."""

    first: Problem
    sheet: str  # empty for a problem of no cell
    cells: tuple[str, ...]

    @property
    def found(self) -> str:
        """What was found; with the sheet where there is no cell to name it."""
        at = "" if self.sheet or not self.first.where else f"{self.first.where}: "
        return f"{at}{self.first.found}"

    @property
    def line(self) -> str:
        """The problem with its cells, as it is printed."""
        addresses = listed(f"{self.sheet}!{cell}" for cell in self.cells)
        return f"{addresses}: {self.first.text}" if addresses else str(self.first)


def grouped(problems: Iterable[Problem]) -> Iterator[Group]:
    """Yield problems in order; equal ones of a sheet once, where the first is."""
    alike: dict[tuple[str, str, int], list[Problem]] = {}
    for number, problem in enumerate(problems):
        sheet, has_cell, _ = problem.where.rpartition("!")
        alike.setdefault((sheet, problem.text, 0 if has_cell else number), []).append(problem)
    for (sheet, _, _), those in alike.items():
        cells = [each.where.removeprefix(f"{sheet}!") for each in those] if sheet else []
        yield Group(those[0], sheet, tuple(cells))


def listed(names: Iterable[str], most: int = MOST_LISTED) -> str:
    """Return the first few of the names, with the count of the others."""
    given = list(dict.fromkeys(names))
    more = len(given) - most
    return ", ".join(given[:most]) + (f" and {more:,} more" if more > 0 else "")
