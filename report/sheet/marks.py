"""The conditional formats of the input sheets: every color that depends on what is typed.

Red for a cell that a begun row or block lacks, amber for a number or choice outside its usual
range, green for a complete row. Read `mark_table`.
"""

from __future__ import annotations

import math

from openpyxl.formatting.rule import Rule
from openpyxl.styles import Font, PatternFill
from openpyxl.styles.differential import DifferentialStyle
from openpyxl.worksheet.worksheet import Worksheet

from report.sheet.answers import STATUS
from report.sheet.fields import Entry, entries
from report.sheet.layout import BlockPlace, TablePlace
from report.sheet.needs import block_begun, condition

RED, AMBER, GREEN = "F4B6B0", "FFCE8A", "2E7D4F"
RED_INK = "B3261E"
_RED_FILL = PatternFill("solid", start_color=RED, end_color=RED)
_AMBER_FILL = PatternFill("solid", start_color=AMBER, end_color=AMBER)
_GREEN_FONT = Font(color=GREEN, bold=True)
_RED_FONT = Font(color=RED_INK, bold=True)
_EQUAL = 1e-9


def mark_table(sheet: Worksheet, place: TablePlace) -> None:
    """Mark the cells of a table and its first column."""
    status = place.cell(STATUS)
    for entry in entries(place.section.model):
        cell = place.cell(entry.name)
        needed = "TRUE" if entry.is_required else condition(place.section.key, entry, place.cell)
        if needed:
            lacks = f'{status}<>"",TRIM({cell})=""'
            test = f"AND({lacks})" if entry.is_required else f"AND({lacks},{needed})"
            _mark(sheet, place.cells(entry.name), test, fill=_RED_FILL)
        size = f"*unit_{place.section.key}_{entry.name}" if entry.quantity else ""
        _mark_unusual(sheet, place.cells(entry.name), cell, entry, size)
    _mark(sheet, place.cells(STATUS), f"AND(ISNUMBER({status}),{status}=0)", font=_GREEN_FONT)
    _mark(sheet, place.cells(STATUS), f"AND(ISNUMBER({status}),{status}>0)", font=_RED_FONT)


def mark_block(sheet: Worksheet, place: BlockPlace) -> None:
    """Mark the cells of a block, and the labels of required cells that are filled."""
    begun = block_begun(place)
    for entry in entries(place.section.model):
        cell = place.cell(entry.name)
        at = cell.replace("$", "")
        if entry.is_required:
            _mark(sheet, at, f'AND({begun},TRIM({cell})="")', fill=_RED_FILL)
            label = at.replace("B", "A")
            _mark(sheet, label, f'TRIM({cell})<>""', font=_GREEN_FONT)
        needed = condition(place.section.key, entry, place.cell)
        if needed:
            starts = f"{begun}," if begun else ""
            _mark(sheet, at, f'AND({starts}{needed},TRIM({cell})="")', fill=_RED_FILL)
        size = f"*unit_{place.section.key}_{entry.name}" if entry.quantity else ""
        _mark_unusual(sheet, at, cell, entry, size)


def mark_ratio(sheet: Worksheet, cells: str, cell: str) -> None:
    """Mark a demand/capacity ratio: red above 1, green otherwise."""
    _mark(sheet, cells, f'OR({cell}="∞",AND(ISNUMBER({cell}),{cell}>1))', font=_RED_FONT)
    _mark(sheet, cells, f"AND(ISNUMBER({cell}),{cell}<=1)", font=_GREEN_FONT)


def mark_count(sheet: Worksheet, cell: str, count: str) -> None:
    """Mark the line at the top of a sheet by the number of cells that it lacks."""
    _mark(sheet, cell, f"{count}=0", font=_GREEN_FONT)
    _mark(sheet, cell, f"{count}<>0", font=_RED_FONT)


def _mark_unusual(sheet: Worksheet, cells: str, cell: str, entry: Entry, size: str) -> None:
    if entry.choices:
        known = f"|{'|'.join(entry.choices)}|".casefold()
        test = f'ISERROR(FIND("|"&LOWER(TRIM({cell}))&"|","{known}"))'
    elif entry.kind in (int, float):
        test = _outside(f"{cell}{size}", entry, cell)
    else:
        return
    _mark(sheet, cells, f'IF(TRIM({cell})="",FALSE,{test})', fill=_AMBER_FILL)


def _outside(value: str, entry: Entry, cell: str) -> str:
    """Return whether a value is no number or outside its expected range."""
    low, high = entry.expected.low, entry.expected.high
    parts = []
    if math.isfinite(low):
        parts.append(f"{value}<{low - _EQUAL * abs(low):.12g}")
    if math.isfinite(high):
        parts.append(f"{value}>{high + _EQUAL * abs(high):.12g}")
    tests = f"OR({','.join(parts)})" if parts else "FALSE"
    return f"IF(ISNUMBER({cell}),{tests},TRUE)"


def _mark(
    sheet: Worksheet,
    cells: str,
    formula: str,
    *,
    fill: PatternFill | None = None,
    font: Font | None = None,
) -> None:
    look = DifferentialStyle(font=font, fill=fill)
    rule = Rule(type="expression", dxf=look, formula=[formula])
    sheet.conditional_formatting.add(cells, rule)
