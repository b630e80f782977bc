"""The errors of a workbook with their rows, and its tables: fields to fill in on the page.

Read `problems`, then `tables`; `typed_cells` is what was typed into both.
"""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from contextlib import suppress
from pathlib import Path
from typing import Any

from openpyxl.utils import coordinate_to_tuple
from openpyxl.worksheet.worksheet import Worksheet

from report.project.check.finding_lines import grouped, line_of, listed
from report.project.model.shapes import SIDES
from report.project.read.archive import OpenBook, open_book
from report.project.read.locate import find_table
from report.project.read.positions import CellPosition, found_at
from report.project.workbook import SECTIONS
from report.project.workbook.entries import SheetSection
from report.text.typed_letters import cut
from solver.errors import InputError, Problem

_MOST_COLUMNS, _BESIDE = 40, 2  # of a sheet that are read, and of those the ones around a cell


def problems(path: Path, error: InputError) -> list[Mapping[str, Any]]:
    """Return the problems of a workbook, each with the row of its first cell."""
    try:
        book = open_book(path)
    except InputError:
        book = None
    return [_shown(path, book, equal) for equal in grouped(error.parts)]


def _shown(path: Path, book: OpenBook | None, equal: Sequence[Problem]) -> Mapping[str, Any]:
    first = equal[0]
    sheet, _, address = first.where.rpartition("!")
    cell = address if sheet else ""
    cells = listed(part.where.removeprefix(f"{sheet}!") for part in equal)
    return {
        "file": path.name,
        "text": line_of(equal),
        "found": first.found if sheet or not address else f"{address}: {first.found}",
        "remedy": first.remedy,
        "sheet": sheet,
        "cell": cell,
        "where": first.where,
        "place": f"{sheet}!{cells}" if sheet else "",
        "row": _row(book, sheet, cell) if book and cell else None,
    }


def _row(book: OpenBook, title: str, cell: str) -> Mapping[str, Any] | None:
    """Return the row of a cell as texts with the headings above them; none of headings alone."""
    if title not in book.book.sheetnames:
        return None
    row, column = coordinate_to_tuple(cell)
    header, columns = _headed(book, book.book[title], row, column)
    if row == header:
        return None
    filled = (
        n for n in columns if header or not found_at(book, CellPosition(title, row, n)).is_blank
    )
    numbers = sorted({column, *filled})
    place = numbers.index(column)
    # The first column names the row.
    numbers = [number for k, number in enumerate(numbers) if k == 0 or abs(k - place) <= _BESIDE]
    return {
        "number": row,
        "heads": [_text(book, title, header, number) if header else "" for number in numbers],
        "cells": [_text(book, title, row, number) for number in numbers],
        "at": numbers.index(column),
    }


def _headed(book: OpenBook, sheet: Worksheet, row: int, column: int) -> tuple[int, Sequence[int]]:
    """Return the row of the headings above a cell or in it, 0 for none, and the columns to show."""
    for section in (s for s in SECTIONS if s.is_table and s.sheet == sheet.title):
        try:
            table = find_table(book, section)
        except InputError:
            continue
        numbers = sorted(c.number for c in table.columns.values())
        if row in {table.heading.row, *table.rows} and numbers:
            return table.heading.row, numbers[:_MOST_COLUMNS]
    last = min(sheet.max_column, _MOST_COLUMNS)
    return 0, range(1, max(last, column if column <= _MOST_COLUMNS else 1) + 1)


def _text(book: OpenBook, title: str, row: int, column: int) -> str:
    return cut(found_at(book, CellPosition(title, row, column)).shown)


_TABLES = ("arrays", "objects", "clearances")
_BLANK_ROWS = 2  # that a table has below those that are filled in
_NUMBER = re.compile(r"[-+]?(\d++\.?\d*|\.\d+)(e[-+]?\d+)?", re.IGNORECASE)


def tables(path: Path) -> list[Mapping[str, Any]]:
    """Return the tables of the roof, with the rows that they have and two blank ones."""
    with suppress(InputError):
        book = open_book(path)
        return [_table(book, section) for section in SECTIONS if section.key in _TABLES]
    return []  # what cannot be read has its own error


def _table(book: OpenBook, section: SheetSection) -> Mapping[str, Any]:
    table = find_table(book, section)
    title, heading = table.heading.sheet, table.heading.row
    entries = {
        table.columns[entry.name].number: entry
        for entry in section.entries
        if entry.name in table.columns and (entry.is_expected or entry.name in SIDES)
    }
    texts = {
        row: {number: _text(book, title, row, number) for number in entries}
        for row in (heading, *table.rows)
    }
    filled = [row for row in table.rows if any(texts[row].values())]
    after = max([heading, *filled]) + 1

    def field(row: int, number: int) -> Mapping[str, Any]:
        where = CellPosition(title, row, number).address
        label, choices = f"{texts[heading][number]}, {where}", list(entries[number].choices)
        text = texts.get(row, {}).get(number, "")
        return {"where": where, "text": text, "label": label, "choices": choices}

    return {
        "sheet": title,
        "is_open": section.key == "arrays" and not filled,
        "heads": [
            {"text": texts[heading][number], "need": entry.needed, "help": entry.note}
            for number, entry in entries.items()
        ],
        "rows": [
            [field(row, number) for number in entries]
            for row in (*filled, *range(after, after + _BLANK_ROWS))
        ],
    }


def typed_cells(typed: Mapping[str, str]) -> Mapping[CellPosition, float | str | None]:
    """Return the typed values by cell, such as `Site!B26`, as in Excel."""
    cells: dict[CellPosition, float | str | None] = {}
    for address, given in typed.items():
        title, _, cell = address.rpartition("!")
        text = given.strip()
        value = float(text) if _NUMBER.fullmatch(text) else text or None
        cells[CellPosition(title, *coordinate_to_tuple(cell))] = value
    return cells
