"""The conditional formats of the input sheets: every color that depends on what is typed.

Red for a cell that a begun row or block lacks and for what `roofslip check` refuses, amber for a
number outside its usual range, green for a complete row, violet for a computed cell that has lost
its formula. Read `mark_table`.
"""

from __future__ import annotations

import math

from openpyxl import Workbook
from openpyxl.formatting.rule import Rule
from openpyxl.styles import Font, PatternFill
from openpyxl.styles.differential import DifferentialStyle
from openpyxl.worksheet.cell_range import CellRange
from openpyxl.worksheet.worksheet import Worksheet

from report.sheet.schema.answers import STATUS
from report.sheet.schema.fields import Entry, entries
from report.sheet.schema.layout import LAST_ROW, BlockPlace, Layout, TablePlace
from report.sheet.writing.needs import block_begun, condition, is_wrong

RED, AMBER, GREEN, VIOLET = "F4B6B0", "FFCE8A", "2E7D4F", "D9C3EC"
RED_INK = "B3261E"
_RED_FILL, _AMBER_FILL, _VIOLET_FILL = (
    DifferentialStyle(fill=PatternFill("solid", start_color=color, end_color=color))
    for color in (RED, AMBER, VIOLET)
)
_GREEN_FONT, _RED_FONT = (
    DifferentialStyle(font=Font(color=color, bold=True)) for color in (GREEN, RED_INK)
)
_EQUAL = 1e-9  # difference from a limit / limit that is rounding error of a conversion of units
_IS_FORMULA = "_xlfn.ISFORMULA"  # Excel 2013 writes it so; LibreOffice reads it so


def mark_table(sheet: Worksheet, place: TablePlace) -> None:
    """Mark the cells of a table and its first column."""
    status = place.cell(STATUS)
    # A row that was inserted has no status, but a name.
    begun = f'{status}&TRIM({place.cell(entries(place.section.model)[0].name)})<>""'
    for entry in entries(place.section.model):
        cell = place.cell(entry.name)
        needed = "TRUE" if entry.is_required else condition(place.section.key, entry, place.cell)
        if needed:
            lacks = f'{begun},TRIM({cell})=""'
            test = f"AND({lacks})" if entry.is_required else f"AND({lacks},{needed})"
            _mark(sheet, place.cells(entry.name), test, _RED_FILL)
        unit = f"unit_{place.section.key}_{entry.name}"
        _mark_values(sheet, place.cells(entry.name), cell, entry, unit)
    _mark_names(sheet, place)
    _mark(sheet, place.cells(STATUS), f"AND(ISNUMBER({status}),{status}=0)", _GREEN_FONT)
    _mark(sheet, place.cells(STATUS), f"AND(ISNUMBER({status}),{status}<>0)", _RED_FONT)


def _mark_names(sheet: Worksheet, place: TablePlace) -> None:
    """Mark an id that is given twice, and a clearance of what is in no table."""
    cell = place.cell
    if "id" in place.letters:
        ids = place.cells("id").replace(place.letters["id"], f"${place.letters['id']}$")
        twice = f'AND(TRIM({cell("id")})<>"",SUMPRODUCT(--(TRIM({ids})=TRIM({cell("id")})))>1)'
        _mark(sheet, place.cells("id"), twice, _RED_FILL)
    if place.section.key == "clearances":
        rows = {"array": ("array_row",), "object": ("other_row", "object_row")}
        for name, found in rows.items():
            nowhere = f'{"&".join(map(cell, found))}=""'
            unknown = f'AND(TRIM({cell(name)})<>"",{nowhere})'
            _mark(sheet, place.cells(name), unknown, _RED_FILL)


def mark_block(sheet: Worksheet, place: BlockPlace) -> None:
    """Mark the cells of a block, and the labels of required cells that are filled."""
    begun = block_begun(place)
    for entry in entries(place.section.model):
        cell = place.cell(entry.name)
        at = cell.replace("$", "")
        if entry.is_required:
            _mark(sheet, at, f'AND({begun},TRIM({cell})="")', _RED_FILL)
            label = at.replace("B", "A")
            _mark(sheet, label, f'TRIM({cell})<>""', _GREEN_FONT)
        needed = condition(place.section.key, entry, place.cell)
        if needed:
            starts = f"{begun}," if begun else ""
            _mark(sheet, at, f'AND({starts}{needed},TRIM({cell})="")', _RED_FILL)
        _mark_values(sheet, at, cell, entry, f"unit_{place.section.key}_{entry.name}")


def mark_lost(book: Workbook, layout: Layout) -> None:
    """Mark computed cells that have lost their formula: each alone, and the columns of tables."""
    for sheet in book.worksheets:
        areas = [CellRange(table.ref) for table in sheet.tables.values()]
        for cell in (cell for row in sheet for cell in row if cell.data_type == "f"):
            if not any(cell.coordinate in area for area in areas):
                lost = f"NOT({_IS_FORMULA}({cell.coordinate}))"
                _mark(sheet, cell.coordinate, lost, _VIOLET_FILL)
    for place in layout.tables.values():
        sheet, first = book[place.section.sheet], entries(place.section.model)[0]
        for letter in place.letters.values():
            at = f"{letter}{place.header + 1}"
            if sheet[at].data_type == "f":
                begun = f'OR({at}<>"",TRIM({place.cell(first.name)})<>"")'
                lost = f"AND({begun},NOT({_IS_FORMULA}({at})))"
                _mark(sheet, f"{at}:{letter}{LAST_ROW}", lost, _VIOLET_FILL)


def mark_ratio(sheet: Worksheet, cells: str, cell: str) -> None:
    """Mark a demand/capacity ratio: red above 1, green otherwise."""
    _mark(sheet, cells, f'OR({cell}="∞",AND(ISNUMBER({cell}),{cell}>1))', _RED_FONT)
    _mark(sheet, cells, f"AND(ISNUMBER({cell}),{cell}<=1)", _GREEN_FONT)


def mark_count(sheet: Worksheet, cell: str, count: str) -> None:
    """Mark the line at the top of a sheet by the number of cells that it lacks."""
    _mark(sheet, cell, f"{count}=0", _GREEN_FONT)
    _mark(sheet, cell, f"{count}<>0", _RED_FONT)


def _mark_values(sheet: Worksheet, cells: str, cell: str, entry: Entry, unit: str) -> None:
    """Mark what is refused, and a number that is not usual."""
    for test in is_wrong(cell, entry, unit):
        _mark(sheet, cells, test, _RED_FILL)
    if entry.kind in (int, float) and not entry.choices:
        value = f"{cell}*{unit}" if entry.quantity else cell
        _mark(sheet, cells, f"AND(ISNUMBER({cell}),{_outside(value, entry)})", _AMBER_FILL)


def _outside(value: str, entry: Entry) -> str:
    """Return whether a number is outside its expected range."""
    low, high = entry.expected.low, entry.expected.high
    parts = []
    if math.isfinite(low):
        parts.append(f"{value}<{low - _EQUAL * abs(low):.12g}")
    if math.isfinite(high):
        parts.append(f"{value}>{high + _EQUAL * abs(high):.12g}")
    return f"OR({','.join(parts)})" if parts else "FALSE"


def _mark(sheet: Worksheet, cells: str, formula: str, look: DifferentialStyle) -> None:
    sheet.conditional_formatting.add(cells, Rule(type="expression", dxf=look, formula=[formula]))
