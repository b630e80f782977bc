"""Which cells of a workbook a plan as drawn fills: arrays, objects, the roof, outlines.

Reads no drawing and writes no file (`report.drawing.plan_read`, `report.sheet.reading.parts`).
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field

from report.drawing.plan_read import DrawnOutline, RoofPlan
from report.sheet.reading.archive import OpenBook
from report.sheet.reading.cells import Found
from report.sheet.reading.locate import cell_as_column, find_cell, is_absent
from report.sheet.reading.locate_tables import MAX_ROWS, TableFound, find_table, table_area
from report.sheet.reading.parts import Value
from report.sheet.reading.positions import FRESH, CellPosition, found_at
from report.sheet.schema import ROOF, SECTION, SIDES, Polygon, Rectangle
from report.sheet.schema.fields import SheetSection
from report.sheet.schema.shapes import Shape
from report.sheet.writing.legacy_notes import MOVE
from solver.model import InputError

_DIGITS = 6


@dataclass(slots=True)
class _Table:
    """A table of the workbook while rows are added to it."""

    book: OpenBook
    section: SheetSection
    found: TableFound
    next_row: int = 0
    last: int = 0
    totals: int = 0

    @classmethod
    def of(cls, book: OpenBook, key: str) -> _Table:
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

    def is_blank(self, row: int) -> bool:
        """Whether no field of a row is filled."""
        return all(self.cell(row, name).is_blank for name in self.found.columns)

    def rows(self, name: str, value: str) -> list[int]:
        """Return the rows whose field is a text."""
        return [
            row
            for row in self.found.rows
            if self.cell(row, name).shown.strip().casefold() == value.casefold()
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
            raise InputError(f"{where}: more than {MAX_ROWS} rows; draw with fewer vertices")
        return row

    def number(self, name: str, value_m: float) -> float:
        """Return a length in the unit of a column."""
        return round(value_m / self.found.columns[name].si, _DIGITS)


@dataclass(slots=True)
class _Fill:
    """The changes of a workbook so far, and the cells that are filled already."""

    book: OpenBook
    replace: bool
    cells: dict[CellPosition, Value] = field(default_factory=dict)
    filled: list[str] = field(default_factory=list)
    outlines: list[tuple[str, Polygon]] = field(default_factory=list)
    outlined: list[str] = field(default_factory=list)

    def refuse(self, position: CellPosition, name: str) -> None:
        """Note a place that is filled already."""
        if not self.replace:
            text = f"the place of {name} is filled already; add --replace to overwrite it"
            self.filled.append(f"{position.address}: {text}")


def changes(book: OpenBook, plan: RoofPlan, *, replace: bool) -> dict[CellPosition, Value]:
    """Return the cells to change so that a workbook has the plan.

    Rows of the same ID get its place, and keep everything else; others are added below.

    Raises
    ------
    InputError
        For each place that is filled already, unless it may be replaced.
    """
    fill = _Fill(book, replace)
    outlines = None if is_absent(book, SECTION["outlines"]) else _Table.of(book, "outlines")
    _fill_rows(fill, "arrays", plan.arrays, outlines)
    _fill_rows(fill, "objects", plan.objects, outlines)
    for place in plan.roof:
        _fill_roof(fill, place, outlines)
    _fill_outlines(fill, outlines)
    if fill.filled:
        raise InputError(fill.filled)
    return fill.cells


def _fill_rows(
    fill: _Fill, key: str, places: Sequence[DrawnOutline], outlines: _Table | None
) -> None:
    if not places:
        return
    table = _Table.of(fill.book, key)
    for place in places:
        rows = table.rows("id", place.name)
        row = rows[0] if rows else table.added()
        taken = [side for side in SIDES if not table.cell(row, side).is_blank]
        if rows and taken:
            fill.refuse(table.position(row, taken[0]), place.name)
        _note_outline(fill, place, outlines)
        if not rows:
            fill.cells[table.position(row, "id")] = place.name
        if key == "objects" and (not rows or fill.replace):
            fill.cells[table.position(row, "kind")] = place.kind.value
        if key == "objects" and math.isfinite(place.height_m) and (not rows or fill.replace):
            height = table.number("height_m", place.height_m)
            fill.cells[table.position(row, "height_m")] = height
        for side, value in zip(SIDES, _sides(place.shape), strict=True):
            shown = None if value is None else table.number(side, value)
            if shown is not None or side in taken:
                fill.cells[table.position(row, side)] = shown


def _sides(shape: Shape) -> tuple[float | None, ...]:
    if isinstance(shape, Rectangle):
        return shape.x_from_m, shape.x_to_m, shape.y_from_m, shape.y_to_m
    return (None,) * len(SIDES)


def _fill_roof(fill: _Fill, place: DrawnOutline, outlines: _Table | None) -> None:
    section = SECTION["roof"]
    _note_outline(fill, place, outlines)
    if isinstance(place.shape, Polygon) and is_absent(fill.book, section):
        return
    for side, value in zip(SIDES, _sides(place.shape), strict=True):
        position = find_cell(fill.book, section, section.entry(side))
        si = cell_as_column(fill.book, section, section.entry(side), position).si
        is_blank = found_at(fill.book, position).is_blank
        if not is_blank:
            fill.refuse(position, "the roof")
        if value is not None or not is_blank:
            fill.cells[position] = None if value is None else round(value / si, _DIGITS)


def _note_outline(fill: _Fill, place: DrawnOutline, outlines: _Table | None) -> None:
    """Note the outline of a place, and the rows of a former one."""
    name = ROOF if place.kind.value == ROOF else place.name
    rows = outlines.rows("name", name) if outlines is not None else []
    if rows and outlines is not None:
        fill.refuse(outlines.position(rows[0], "name"), name)
        fill.outlined.append(name)
    if isinstance(place.shape, Polygon):
        fill.outlines.append((name, place.shape))


def _fill_outlines(fill: _Fill, outlines: _Table | None) -> None:
    if outlines is None:
        if fill.outlines:
            names = ", ".join(name for name, _ in fill.outlines)
            missing = f"Outlines: the sheet is missing, which {names} in the drawing need"
            raise InputError(f"{missing}. {MOVE}, then read the drawing into that")
        return
    for name in fill.outlined:
        for row in outlines.rows("name", name):
            fill.cells |= {outlines.position(row, field): None for field in ("name", "x_m", "y_m")}
    for name, shape in fill.outlines:
        for x, y in shape.points:
            row = outlines.added()
            fill.cells[outlines.position(row, "name")] = name
            fill.cells[outlines.position(row, "x_m")] = outlines.number("x_m", x)
            fill.cells[outlines.position(row, "y_m")] = outlines.number("y_m", y)
