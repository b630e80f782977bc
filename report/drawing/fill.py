"""Which cells of a workbook a plan as drawn fills: arrays, objects, the roof, outlines.

Reads no drawing and writes no file (`report.drawing.plan_read`, `report.sheet.reading.parts`).
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

from report.drawing.matched import MatchedPlan
from report.drawing.plan_read import DrawnOutline
from report.sheet.reading.archive import OpenBook
from report.sheet.reading.growing import DIGITS, GrowingTable
from report.sheet.reading.locate import cell_as_column, find_cell, is_absent
from report.sheet.reading.parts import Value
from report.sheet.reading.positions import CellPosition, found_at
from report.sheet.schema import SECTION
from report.sheet.schema.choices import LayerKind
from report.sheet.schema.scene import DRAWING, DRAWN_MODULES, ROOF, SIDES
from report.sheet.schema.shapes import Polygon, Rectangle, Shape
from report.sheet.writing.legacy_notes import MOVE
from solver.model import InputError

_NAMED: Mapping[str, Sequence[str]] = {
    "arrays": ("id",), "objects": ("id",), "outlines": ("name",), "links": ("array",),
    "clearances": ("array", "object"),
}  # fmt: skip
"""Tables with the name of an array or an object, and the columns that have it."""


@dataclass(slots=True)
class _Fill:
    """The changes of a workbook so far, and the cells that are filled already."""

    book: OpenBook
    replace: bool
    outlines: GrowingTable | None = None
    lacking: list[str] = field(default_factory=list)  # outlines without the sheet for them
    cells: dict[CellPosition, Value] = field(default_factory=dict)
    filled: list[str] = field(default_factory=list)

    def refuse(self, position: CellPosition, name: str) -> None:
        """Note a place that is filled already."""
        if not self.replace:
            text = f"{name} is filled already; add --replace to overwrite it"
            self.filled.append(f"{position.address}: {text}")

    def put(self, position: CellPosition, value: Value, name: str) -> None:
        """Fill a cell, which is refused if it is filled already."""
        if not found_at(self.book, position).is_blank:
            self.refuse(position, name)
        self.cells[position] = value

    def done(self) -> dict[CellPosition, Value]:
        """Return the changes, if none was refused."""
        if self.filled:
            raise InputError(self.filled)
        return self.cells


def changes(
    book: OpenBook, told: MatchedPlan, layers: Mapping[str, LayerKind], *, replace: bool
) -> dict[CellPosition, Value]:
    """Return the cells to change so that a workbook has the plan, and what its layers are.

    Rows of the same ID get its place, and keep everything else; others are added below, and those
    that are to be taken out are emptied wherever they are named. A workbook without the sheet
    Layers stays without.

    Raises
    ------
    InputError
        For each place that is filled already, unless it may be replaced.
    """
    outlines = None if is_absent(book, SECTION["outlines"]) else GrowingTable.of(book, "outlines")
    fill = _Fill(book, replace, outlines)
    _fill_rows(fill, "arrays", told.plan.arrays)
    _fill_rows(fill, "objects", told.plan.objects)
    for name in told.gone if replace else ():
        _take_out(fill, name)
    for place in told.plan.roof:
        _fill_roof(fill, place)
    _fill_layers(fill, layers)
    if fill.lacking:
        names = ", ".join(fill.lacking)
        missing = f"Outlines: the sheet is missing, which {names} in the drawing need"
        raise InputError(f"{missing}. {MOVE}, then read the drawing into that")
    return fill.done()


def ballast_changes(
    book: OpenBook, weights_n: Mapping[str, float | None], *, replace: bool
) -> dict[CellPosition, Value]:
    """Return the cells to change so that arrays have a ballast weight [N]; raises as `changes`.

    None is no weight.
    """
    fill, table = _Fill(book, replace), GrowingTable.of(book, "arrays")
    for name, weight_n in weights_n.items():
        position = table.position(table.rows("id", name)[0], "ballast_n")
        weight = None if weight_n is None else table.number("ballast_n", weight_n)
        fill.put(position, weight, f"the ballast weight of {name}")
    return fill.done()


def _fill_rows(fill: _Fill, key: str, places: Sequence[DrawnOutline]) -> None:
    if not places:
        return
    table = GrowingTable.of(fill.book, key)
    for place in places:
        rows = table.rows("id", place.name)
        row = rows[0] if rows else table.added()
        taken = [side for side in SIDES if not table.cell(row, side).is_blank]
        if rows and taken:
            fill.refuse(table.position(row, taken[0]), f"the place of {place.name}")
        _fill_outline(fill, place)
        values: dict[str, Value] = {} if rows else {"id": place.name}
        if "place_from" in table.found.columns:  # not in earlier workbooks
            values["place_from"] = DRAWN_MODULES if place.modules else DRAWING
            if not place.modules and table.cell(row, "place_from").shown == DRAWN_MODULES:
                values["modules"] = None
        if key == "arrays" and place.modules and "modules" in table.found.columns:
            count = f"the number of modules of {place.name}"
            fill.put(table.position(row, "modules"), place.modules, count)
        if key == "objects" and (not rows or fill.replace):
            values["kind"] = place.kind.value
            if math.isfinite(place.height_m):
                values["height_m"] = table.number("height_m", place.height_m)
        for side, value in zip(SIDES, _sides(place.shape), strict=True):
            shown = None if value is None else table.number(side, value)
            if shown is not None or side in taken:
                values[side] = shown
        fill.cells |= table.cells(row, values)


def _take_out(fill: _Fill, name: str) -> None:
    """Empty the rows of an array or an object that is not drawn any more, and those beside it."""
    for key, columns in _NAMED.items():
        if is_absent(fill.book, SECTION[key]):
            continue
        table = GrowingTable.of(fill.book, key)
        for row in {row for column in columns for row in table.rows(column, name)}:
            fill.cells |= table.cells(row, dict.fromkeys(table.found.columns))


def _sides(shape: Shape) -> tuple[float | None, ...]:
    if isinstance(shape, Rectangle):
        return shape.x_from_m, shape.x_to_m, shape.y_from_m, shape.y_to_m
    return (None,) * len(SIDES)


def _fill_roof(fill: _Fill, place: DrawnOutline) -> None:
    section = SECTION["roof"]
    _fill_outline(fill, place)
    if isinstance(place.shape, Polygon) and is_absent(fill.book, section):
        return
    for side, value in zip(SIDES, _sides(place.shape), strict=True):
        position = find_cell(fill.book, section, section.entry(side))
        si = cell_as_column(fill.book, section, section.entry(side), position).si
        is_blank = found_at(fill.book, position).is_blank
        if not is_blank:
            fill.refuse(position, "the place of the roof")
        if value is not None or not is_blank:
            fill.cells[position] = None if value is None else round(value / si, DIGITS)


def _fill_layers(fill: _Fill, layers: Mapping[str, LayerKind]) -> None:
    if not layers or is_absent(fill.book, SECTION["layers"]):
        return
    table = GrowingTable.of(fill.book, "layers")
    for layer, kind in layers.items():
        for row in table.rows("layer", layer) or [table.added()]:
            fill.cells |= table.cells(row, {"layer": layer, "kind": kind.value})


def _fill_outline(fill: _Fill, place: DrawnOutline) -> None:
    """Fill in the outline of a place below the others, and clear a former one."""
    name = ROOF if place.kind.value == ROOF else place.name
    points = place.shape.points if isinstance(place.shape, Polygon) else ()
    table = fill.outlines
    if table is None:
        fill.lacking += [name] if points else []
        return
    rows = table.rows("name", name)
    if rows:
        fill.refuse(table.position(rows[0], "name"), f"the place of {name}")
    for row in rows:
        fill.cells |= table.cells(row, dict.fromkeys(table.found.columns))
    # Not in earlier workbooks.
    source = {"source": DRAWING} if "source" in table.found.columns else {}
    for x, y in points:
        place_m = {"x_m": table.number("x_m", x), "y_m": table.number("y_m", y)}
        fill.cells |= table.cells(table.added(), {"name": name, **place_m, **source})
