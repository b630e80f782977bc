"""The conditional formats of the input sheets: every color that depends on what is typed.

Red for a cell that a begun row or block lacks and for what `roofslip check` refuses, amber for a
number outside its usual range, green for a complete row, violet for a computed cell that has lost
its formula, pale green for a row from a drawing. Read `mark_table`.
"""

from __future__ import annotations

import math
from collections.abc import Iterable

from openpyxl import Workbook
from openpyxl.formatting.rule import Rule
from openpyxl.styles import Font, PatternFill
from openpyxl.styles.differential import DifferentialStyle
from openpyxl.styles.numbers import NumberFormat
from openpyxl.worksheet.cell_range import CellRange
from openpyxl.worksheet.worksheet import Worksheet

from report.sheet.checking.usual import ROUNDING
from report.sheet.schema.answers import STATUS
from report.sheet.schema.fields import Entry, SheetSection, entries
from report.sheet.schema.layout import LAST_ROW, BlockPlace, Layout, TablePlace
from report.sheet.schema.scene import DRAWING
from report.sheet.writing.needs import block_begun, lacks, undecided_names, wrong_name

RED, AMBER, GREEN, VIOLET, DRAWN = "F4B6B0", "FFCE8A", "2E7D4F", "D9C3EC", "CFE9E1"
RED_INK, UNDECIDED = "B3261E", "5F6A72"
SEE_CHECK = "see check"
"""What stands in place of a tick where no formula tells whether `check` accepts."""
_RED_FILL, _AMBER_FILL, _VIOLET_FILL, _DRAWN_FILL = (
    DifferentialStyle(fill=PatternFill("solid", start_color=color, end_color=color))
    for color in (RED, AMBER, VIOLET, DRAWN)
)
_GREEN_FONT, _RED_FONT = (
    DifferentialStyle(font=Font(color=color, bold=True)) for color in (GREEN, RED_INK)
)
_UNDECIDED = DifferentialStyle(
    font=Font(color=UNDECIDED, bold=True),
    numFmt=NumberFormat(numFmtId=300, formatCode=f'"{SEE_CHECK}"'),
)
_IS_FORMULA = "_xlfn.ISFORMULA"  # Excel 2013 writes it so; LibreOffice reads it so


def mark_table(sheet: Worksheet, place: TablePlace) -> None:
    """Mark the cells of a table and its first column."""
    status = place.cell(STATUS)
    # A row that was inserted has no status, but a name.
    begun = f'{status}&TRIM({place.cell(entries(place.section.model)[0].name)})<>""'
    for entry in entries(place.section.model):
        _mark_cells(sheet, place.cells(entry.name), place, entry, begun)
        if "source" in place.letters:
            drawn = f'TRIM({place.cell("source")})="{DRAWING}"'
            _mark(sheet, place.cells(entry.name), drawn, _DRAWN_FILL)
    mark_count(sheet, place.cells(STATUS), status, [place.section])


def mark_block(sheet: Worksheet, place: BlockPlace) -> None:
    """Mark the cells of a block, and the labels of required cells that are filled."""
    begun = block_begun(place)
    for entry in entries(place.section.model):
        cell = place.cell(entry.name)
        at = cell.replace("$", "")
        _mark_cells(sheet, at, place, entry, begun or "TRUE")
        if entry.is_required:
            wrong = wrong_name(place.section, entry.name)
            done = f'AND(TRIM({cell})<>"",NOT({wrong}))'
            _mark(sheet, at.replace("B", "A"), done, _GREEN_FONT)


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


def mark_ratio(sheet: Worksheet, place: TablePlace, name: str) -> None:
    """Mark a demand/capacity ratio: red above 1, green up to 1 in a complete row."""
    cells, cell, status = place.cells(name), place.cell(name), place.cell(STATUS)
    _mark(sheet, cells, f'OR({cell}="∞",AND(ISNUMBER({cell}),{cell}>1))', _RED_FONT)
    green = f"AND(ISNUMBER({cell}),{cell}<=1,ISNUMBER({status}),{status}=0)"
    _mark(sheet, cells, green, _GREEN_FONT)


def mark_count(sheet: Worksheet, cells: str, count: str, sections: Iterable[SheetSection]) -> None:
    """Mark a row, or the line at the top of a sheet, by the number of cells that it lacks.

    What lacks none has another look where no formula tells whether its sections are accepted.
    """
    done = f"AND(ISNUMBER({count}),{count}=0)"
    if names := undecided_names(sections):
        _mark(sheet, cells, f"AND({done},OR({','.join(names)}))", _UNDECIDED)
    _mark(sheet, cells, done, _GREEN_FONT)
    _mark(sheet, cells, f"AND(ISNUMBER({count}),{count}<>0)", _RED_FONT)


def _mark_cells(
    sheet: Worksheet, cells: str, place: BlockPlace | TablePlace, entry: Entry, begun: str
) -> None:
    """Mark what is missing, what is refused, and a number that is not usual."""
    if missing := lacks(place.section, entry, place.cell):
        _mark(sheet, cells, f"AND({begun},{missing})", _RED_FILL)
    _mark(sheet, cells, wrong_name(place.section, entry.name), _RED_FILL)
    if entry.kind in (int, float) and not entry.choices:
        cell, unit = place.cell(entry.name), f"unit_{place.section.cell_name(entry.name)}"
        value = f"{cell}*{unit}" if entry.quantity else cell
        _mark(sheet, cells, f"AND(ISNUMBER({cell}),{_outside(value, entry)})", _AMBER_FILL)


def _outside(value: str, entry: Entry) -> str:
    """Return whether a number is outside its expected range."""
    low, high = entry.expected.low, entry.expected.high
    parts = []
    if math.isfinite(low):
        parts.append(f"{value}<{low - ROUNDING * abs(low):.12g}")
    if math.isfinite(high):
        parts.append(f"{value}>{high + ROUNDING * abs(high):.12g}")
    return f"OR({','.join(parts)})" if parts else "FALSE"


def _mark(sheet: Worksheet, cells: str, formula: str, look: DifferentialStyle) -> None:
    sheet.conditional_formatting.add(cells, Rule(type="expression", dxf=look, formula=[formula]))
