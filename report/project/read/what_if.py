"""A workbook as if other values had been typed into some of its cells; writes no file.

Read `retyped`.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import Any

from openpyxl.utils import coordinate_to_tuple

from report.project.check.faults import faults
from report.project.model.input_rows import Place
from report.project.read.cells import CellError, Found, blank_value, read_cell
from report.project.read.positions import CellPosition
from report.project.read.read import Gathered
from report.project.read.workbook_data import Sheet
from report.project.workbook import SECTION

# What is typed into a cell: a number in the unit of the cell, a text, or nothing.
Typed = float | str | None


def retyped(sheet: Sheet, typed: Mapping[Place, Typed]) -> Sheet:
    """Return a workbook with other values and their problems; the echo stays that of the file."""
    # A copy of each row: the sheet is that of the file, to which the page goes back.
    inputs = {key: [dict(row) for row in rows] for key, rows in sheet.inputs.items()}
    gathered = Gathered(inputs=inputs, addresses=dict(sheet.addresses), unfound=set(sheet.unfound))
    for place, value in typed.items():
        entry = SECTION[place.section].entry(place.field)
        # Emptied, a cell may stand for what others give: `_compute` has that.
        read = entry.default
        try:
            if value is not None:
                cell = Found(sheet="", cell="", value=value)
                read = read_cell(cell, entry, *_unit_of(sheet, place))
            inputs[place.section][place.row][place.field] = read
        except CellError as error:
            gathered.add(place, [error.parts[0].at(sheet.addresses[place], entry.spoken)])
    _compute(sheet, typed, inputs)
    gathered.take(faults(inputs, sheet.where))
    return replace(sheet, inputs=inputs, problems=tuple(gathered.problems))


def _compute(
    sheet: Sheet, typed: Mapping[Place, Typed], inputs: Mapping[str, list[dict[str, Any]]]
) -> None:
    """Compute again what blank cells of the rows stand for in which something is typed."""
    blank = {row.address for row in sheet.echo if not row.typed}
    for section, index in {(place.section, place.row) for place in typed}:
        row = inputs[section][index]
        for entry in SECTION[section].entries:
            place = Place(section, index, entry.name)
            # Emptied here, or blank in the file and left so.
            is_blank = (
                typed[place] is None if place in typed else sheet.addresses.get(place) in blank
            )
            if entry.name in row and is_blank:
                row[entry.name] = blank_value(entry, row)


def size_of_unit(sheet: Sheet, place: Place) -> float:
    """Return the size in SI of the unit in which the number of a cell is typed."""
    return _unit_of(sheet, place)[1]


def _unit_of(sheet: Sheet, place: Place) -> tuple[str, float]:
    """Return the unit of the number of a cell, and its size in SI."""
    quantity = SECTION[place.section].entry(place.field).quantity
    unit = sheet.units[sheet.addresses[place]]
    return unit, quantity.accepted[unit] if quantity else 1.0


def cells(sheet: Sheet, typed: Mapping[Place, Typed]) -> dict[CellPosition, Typed]:
    """Return the values to write, by cell of the file."""
    values = {}
    for place, value in typed.items():
        title, _, cell = sheet.addresses[place].rpartition("!")
        values[CellPosition(title, *coordinate_to_tuple(cell))] = value
    return values
