"""A table of a workbook to which rows are added: which row is next, and where its cells are.

Writes nothing: `report.sheet.reading.parts` does. Read `GrowingTable`.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from openpyxl.utils.escape import unescape

from report.sheet.reading.archive import OpenBook
from report.sheet.reading.cells import Found
from report.sheet.reading.locate_tables import MAX_ROWS, TableFound, find_table, table_area
from report.sheet.reading.parts import Value
from report.sheet.reading.positions import FRESH, CellPosition, found_at
from report.sheet.schema import SECTION
from report.sheet.schema.fields import SheetSection
from solver.model import InputError

DIGITS = 6
"""Decimals of a number that is written in the unit of its column."""


@dataclass(slots=True)
class GrowingTable:
    """A table of the workbook while rows are added to it."""

    book: OpenBook
    section: SheetSection
    found: TableFound
    next_row: int = 0
    last: int = 0
    totals: int = 0

    @classmethod
    def of(cls, book: OpenBook, key: str) -> GrowingTable:
        """Return a table as it is."""
        section = SECTION[key]
        table = cls(book, section, find_table(book, section))
        top = table.found.heading.row
        filled = [row for row in table.found.rows if not table.is_blank(row)]
        table.next_row = max(filled, default=top) + 1
        area = table_area(book, section)
        if area and area.totals and table.next_row <= area.totals:
            table.totals, table.last = area.totals, area.last
        else:
            table.last = top + MAX_ROWS
        return table

    def cell(self, row: int, name: str) -> Found:
        """Return a cell of a row."""
        return found_at(self.book, self.position(row, name))

    def position(self, row: int, name: str) -> CellPosition:
        """Return where a field of a row is."""
        columns = self.found.columns
        if name not in columns:
            label = self.section.entry(name).cell.label
            raise InputError(f"{self.found.heading.address}: heading '{label}' is missing; {FRESH}")
        return CellPosition(self.found.heading.sheet, row, columns[name].number)

    def cells(self, row: int, values: Mapping[str, Value]) -> dict[CellPosition, Value]:
        """Return values by field as the cells of a row."""
        return {self.position(row, name): value for name, value in values.items()}

    def is_blank(self, row: int) -> bool:
        """Whether no field of a row is filled."""
        return all(self.cell(row, name).is_blank for name in self.found.columns)

    def rows(self, name: str, value: str) -> list[int]:
        """Return the rows whose field is a text."""
        return [
            row
            for row in self.found.rows
            if unescape(self.cell(row, name).shown).strip().casefold() == value.casefold()
        ]

    def added(self) -> int:
        """Return the next free row."""
        row, self.next_row = self.next_row, self.next_row + 1
        where = self.found.heading.address
        if self.totals and row > self.last:
            title = self.found.heading.sheet
            raise InputError(
                f"{title}!{self.totals}: the table has a row of totals, and no blank row above it;"
                " remove the row of totals, or insert rows above it"
            )
        if row > self.last:
            most = f"the {MAX_ROWS} that a table may have"
            raise InputError(f"{where}: more rows are needed than {most}")
        return row

    def number(self, name: str, value_m: float) -> float:
        """Return a length in the unit of a column."""
        return round(value_m / self.found.columns[name].si, DIGITS)
