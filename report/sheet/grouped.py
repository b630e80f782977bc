"""The lines of an input error, taken apart: equal ones of several cells become one.

Writes no text of its own but the count. Read `grouped`.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass

MOST_LISTED = 3
"""Cells and ids named of equal errors and findings."""

_LINE = re.compile(r"(?P<sheet>[^!:]+)!(?P<cell>[A-Z]{1,3}[0-9]{1,7}): (?P<text>.+)", re.DOTALL)


@dataclass(frozen=True, slots=True)
class Problem:
    """An error of one cell, of several of a sheet, or of none.

    Attributes
    ----------
    sheet : str
        Empty for an error of no cell.
    cells : tuple of str
    text : str
        What was found, and what would do.
    """

    sheet: str
    cells: tuple[str, ...]
    text: str

    @property
    def line(self) -> str:
        """The error with its cells, as it is printed."""
        addresses = listed(f"{self.sheet}!{cell}" for cell in self.cells)
        return f"{addresses}: {self.text}" if addresses else self.text


def grouped(lines: Iterable[str]) -> Iterator[Problem]:
    """Yield the errors of lines in order; equal ones of a sheet once, where the first is."""
    alike: dict[tuple[str, str, int], list[str]] = {}
    for number, line in enumerate(lines):
        if match := _LINE.fullmatch(line):
            alike.setdefault((match["sheet"], match["text"], 0), []).append(match["cell"])
        else:
            alike["", line, number] = []
    for (sheet, text, _), cells in alike.items():
        yield Problem(sheet, tuple(cells), text)


def listed(names: Iterable[str]) -> str:
    """Return the first few of the names, with the count of the others."""
    given = list(dict.fromkeys(names))
    more = len(given) - MOST_LISTED
    return ", ".join(given[:MOST_LISTED]) + (f" and {more:,} more" if more > 0 else "")
