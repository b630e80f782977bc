"""A table of a workbook while rows are added to it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from openpyxl.utils.escape import unescape

from report.project.read.archive import OpenBook
from report.project.read.cells import Found
from report.project.read.changed_cells import Value
from report.project.read.locate_table import MAX_ROWS, TableFound, find_table, table_area
from report.project.read.positions import FRESH, CellPosition, found_at
from report.project.workbook import SECTION
from report.project.workbook.sections import SheetSection
from solver.model import InputError

# Decimals of a number that is written in the unit of its column.
DIGITS = 6


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
            label = self.section.entry(name).heading
            where = self.found.heading.address
            raise InputError(f"{where}: heading '{label}' is missing; {FRESH}")
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
