"""Fills cells of a workbook in place, and gives rows that a table has grown by their formulas."""

from __future__ import annotations

from collections.abc import Mapping

from report.sheet.reading.archive import OpenBook, open_book
from report.sheet.reading.parts import Formula, Value, write_cells
from report.sheet.reading.positions import CellPosition
from report.sheet.writing.live import BROKEN, live_formulas


def fill_cells(book: OpenBook, cells: Mapping[CellPosition, Value]) -> bool:
    """Write cells of a workbook; return whether it has formulas: their cached values stay.

    Raises
    ------
    InputError
        If the workbook cannot be changed.
    """
    before = live_formulas(book)
    write_cells(book.path, cells)
    after = live_formulas(open_book(book.path))
    # Excel gives the rows that a table has grown by their formulas only where they are typed.
    grown = {at: Formula(after[at]) for at in after.keys() - before.keys()}
    # An earlier workbook lacks columns that the formulas of today refer to.
    write_cells(book.path, {at: f for at, f in grown.items() if BROKEN not in after[at]})
    return any(scan.formulas for scan in book.scans.values())
