"""A workbook as if other values had been typed into some of its cells.

Reads each new value as a cell is read and checks the whole again; writes no file
(`report.sheet.reading.parts`). Read `retyped`.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import Any

from openpyxl.utils import coordinate_to_tuple

from report.sheet.checking.checks import faults
from report.sheet.reading.cells import CellError, Found, read_cell
from report.sheet.reading.positions import CellPosition
from report.sheet.reading.read import Gathered, Sheet
from report.sheet.schema import SECTION
from report.sheet.schema.fields import Place

Typed = float | str | None
"""What is typed into a cell: a number in the unit of the cell, a text, or nothing."""


def retyped(sheet: Sheet, typed: Mapping[Place, Typed]) -> Sheet:
    """Return a workbook with other values in cells that it has; their problems are its own.

    The echo stays that of the file.
    """
    draft = {key: [dict(row) for row in rows] for key, rows in sheet.draft.items()}
    gathered = Gathered(draft=draft, addresses=dict(sheet.addresses), unfound=set(sheet.unfound))
    units = {row.address: row.unit for row in sheet.echo}
    for place, value in typed.items():
        entry = SECTION[place.section].entry(place.field)
        address = sheet.addresses[place]
        try:
            draft[place.section][place.row][place.field] = _read(place, value, units[address])
        except CellError as error:
            gathered.add(place, [error.problem.at(address, entry.spoken)])
    gathered.take(faults(draft, gathered.where))
    return replace(sheet, draft=draft, problems=tuple(gathered.problems))


def size_of_unit(sheet: Sheet, place: Place) -> float:
    """Return the size in SI of the unit in which the number of a cell is typed."""
    quantity = SECTION[place.section].entry(place.field).quantity
    address = sheet.addresses[place]
    unit = next(row.unit for row in sheet.echo if row.address == address)
    return quantity.accepted[unit] if quantity else 1.0


def cells(sheet: Sheet, typed: Mapping[Place, Typed]) -> dict[CellPosition, Typed]:
    """Return what to write into which cells of the file."""
    found = {}
    for place, value in typed.items():
        title, _, cell = sheet.addresses[place].rpartition("!")
        found[CellPosition(title, *coordinate_to_tuple(cell))] = value
    return found


def _read(place: Place, value: Typed, unit: str) -> Any:
    entry = SECTION[place.section].entry(place.field)
    if value is None:
        return entry.default
    si = entry.quantity.accepted[unit] if entry.quantity else 1.0
    return read_cell(Found(sheet="", cell="", value=value), entry, unit, si)
