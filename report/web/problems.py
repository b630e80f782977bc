"""Input errors as data: cell, what was found, what would do, and the row of the sheet around it.

Read `problems`.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from openpyxl.utils import coordinate_to_tuple
from openpyxl.worksheet.worksheet import Worksheet

from report.sheet.checking.grouped import Group, grouped, listed
from report.sheet.reading.archive import OpenBook, open_book
from report.sheet.reading.locate_tables import find_table
from report.sheet.reading.positions import CellPosition, found_at
from report.sheet.schema import SECTIONS
from report.words.letters import cut
from solver.model import InputError

_MOST_COLUMNS = 40


def problems(path: Path, error: InputError) -> list[Mapping[str, Any]]:
    """Return the problems of a workbook, each with the row of its first cell."""
    try:
        book = open_book(path)
    except InputError:
        book = None
    return [_shown(path, book, problem) for problem in grouped(error.parts)]


def _shown(path: Path, book: OpenBook | None, problem: Group) -> Mapping[str, Any]:
    cell = next(iter(problem.cells), "")
    return {
        "file": path.name,
        "text": problem.line,
        "found": problem.found,
        "remedy": problem.first.remedy,
        "sheet": problem.sheet,
        "cell": cell,
        "cells": listed(problem.cells),
        "row": _row(book, problem.sheet, cell) if book and cell else None,
    }


def _row(book: OpenBook, title: str, cell: str) -> Mapping[str, Any] | None:
    """Return the row of a cell as texts with the headings above them; none without the sheet."""
    if title not in book.book.sheetnames:
        return None
    row, column = coordinate_to_tuple(cell)
    header, columns = _headed(book, book.book[title], row, column)
    shown = [
        number
        for number in columns
        if header or not found_at(book, CellPosition(title, row, number)).is_blank
    ]
    if column not in shown:
        shown = sorted([*shown, column])
    return {
        "number": row,
        "heads": [_text(book, title, header, number) if header else "" for number in shown],
        "cells": [_text(book, title, row, number) for number in shown],
        "at": shown.index(column),
    }


def _headed(book: OpenBook, sheet: Worksheet, row: int, column: int) -> tuple[int, Sequence[int]]:
    """Return the row of the headings above a cell, 0 for none, and the columns to show."""
    for section in (s for s in SECTIONS if s.is_table and s.sheet == sheet.title):
        try:
            table = find_table(book, section)
        except InputError:
            continue
        numbers = sorted(c.number for c in table.columns.values())
        if row in table.rows and numbers:
            return table.heading.row, numbers[:_MOST_COLUMNS]
    last = min(sheet.max_column, _MOST_COLUMNS)
    return 0, range(1, max(last, column if column <= _MOST_COLUMNS else 1) + 1)


def _text(book: OpenBook, title: str, row: int, column: int) -> str:
    return cut(found_at(book, CellPosition(title, row, column)).shown)
