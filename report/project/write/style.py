"""Appearance of the input sheets: colors, cells, dropdowns, input messages, print setup.

Uses `fields` but no section of the workbook. Read `template` next.
"""

from __future__ import annotations

import math
from collections.abc import Collection, Iterable
from datetime import date
from enum import StrEnum
from functools import cache
from typing import Any

from openpyxl.cell import Cell
from openpyxl.formatting.rule import Rule
from openpyxl.styles import Alignment, Border, Font, PatternFill, Side
from openpyxl.styles.differential import DifferentialStyle
from openpyxl.worksheet.datavalidation import DataValidation
from openpyxl.worksheet.worksheet import Worksheet

from report.project.model.choices import YesNo
from report.project.read.cells import escaped, wish
from report.project.workbook.entries import Entry
from report.text.command_line import as_typed
from report.text.units import Unit

INK = "1F3A4D"
GRAY = "7A7F85"
WHITE = "FFFFFF"
INPUT_FILL = PatternFill("solid", start_color="FFF6CC")
REQUIRED_FILL = PatternFill("solid", start_color=INK)
OPTIONAL_FILL = PatternFill("solid", start_color="6C8796")
RARE_FILL = PatternFill("solid", start_color="C9CDD1")
HELP_FILL = PatternFill("solid", start_color="4A90C2")
HINT_FILL = PatternFill("solid", start_color="F3F4F5")
ANSWER_FILL = PatternFill("solid", start_color="E3EDF5")
ANSWER_HEAD_FILL = PatternFill("solid", start_color="9DB4C4")
PLAIN = DifferentialStyle(fill=PatternFill("solid", start_color=WHITE, end_color=WHITE))
HAIR = Side(style="thin", color="C9CDD1")
BOX = Border(left=HAIR, right=HAIR, top=HAIR, bottom=HAIR)
LINE = Border(bottom=HAIR)
# For an end that a field does not have: Excel's rule `between` needs two.
NUMBER_LIMIT = 1e8
_INPUT_FONT = Font(name="Calibri", size=11, color="000000")
_ANSWER_FONT = Font(name="Calibri", size=11, color=INK)
_INDENTED = Alignment(vertical="center", horizontal="left", wrap_text=True, indent=1)


@cache
def _font(size: int, color: str, bold: bool, italic: bool) -> Font:
    return Font(name="Calibri", size=size, bold=bold, italic=italic, color=color)


@cache
def _alignment(wrap: bool, indent: int) -> Alignment:
    return Alignment(vertical="center", horizontal="left", wrap_text=wrap, indent=indent)


def put(
    sheet: Worksheet,
    row: int,
    column: int,
    text: str,
    *,
    color: str = INK,
    bold: bool = False,
    italic: bool = False,
    size: int = 10,
    wrap: bool = True,
) -> Cell:
    """Write a text in a cell that has no format yet; return the cell."""
    cell: Any = sheet.cell(row, column)
    # Its commands begin as the reader typed the one that writes it.
    # openpyxl would take a text that begins with = for a formula.
    cell.value, cell.data_type = as_typed(text), "s"
    indent = 1 if wrap and column > 1 else 0
    cell.font = _font(size, color, bold, italic)
    cell.alignment = _alignment(wrap, indent)
    assert isinstance(cell, Cell)  # no cell is merged here
    return cell


# What a row of a static sheet has in a cell.
Value = str | float


def put_values(
    sheet: Worksheet, row: int, values: Iterable[Value], *, are_heads: bool = False
) -> None:
    """Write the cells of a row of a static sheet; NaN where a table has no number."""
    for column, value in enumerate(values, start=1):
        match value:
            case str():
                put(sheet, row, column, value, bold=are_heads).border = LINE
            case _ if math.isnan(value):
                put(sheet, row, column, "site-specific", color=GRAY, size=9)
            case _:
                cell = put(sheet, row, column, "")
                cell.value, cell.data_type, cell.border = value, "n", LINE


def put_title(sheet: Worksheet, title: str, hint: str) -> None:
    """Write the title of a sheet and the line below it."""
    put(sheet, 1, 1, title, bold=True, size=16, wrap=False)
    put(sheet, 2, 1, hint, color=GRAY, wrap=False)
    sheet.row_dimensions[1].height, sheet.row_dimensions[3].height = 28, 20


def put_heading(sheet: Worksheet, row: int, title: str, hint: str) -> None:
    """Write the heading of a part of a sheet and the line below it."""
    put(sheet, row, 1, title, bold=True, size=13, wrap=False)
    put(sheet, row + 1, 1, hint, color=GRAY, wrap=False)
    sheet.row_dimensions[row].height = 28


def put_input(cell: Any, entry: Entry, value: object, unit: Unit | None) -> None:
    """Format a cell as input of a field, and write a value in SI, if any."""
    style_input(cell, entry.kind)
    typed = entry.zero if value == 0.0 and entry.zero else in_cell(value, unit)
    if typed is None:
        return
    cell.value = typed
    if isinstance(typed, str):
        cell.data_type = "s"  # text that starts with = is not a formula
    elif isinstance(typed, date):
        cell.number_format = "yyyy-mm-dd"


def style_input(cell: Any, kind: type[Any]) -> None:
    """Format a cell as input; text cells keep entries such as 3-5 as typed."""
    cell.font = _INPUT_FONT
    cell.fill, cell.border = INPUT_FILL, BOX
    cell.alignment = _INDENTED
    if kind is date:
        cell.number_format = "yyyy-mm-dd"
    elif kind not in (int, float):
        # Text, or Excel makes a date of 3-5 and a number of 007.
        cell.number_format = "@"


def make_plain_when_filled(sheet: Worksheet, cells: str) -> None:
    """Make the input cells of a range lose their color once something is typed."""
    first, _, _ = cells.partition(":")
    # Relative to the first cell of the range, as formulas of conditional formats are: each cell
    # asks of itself.
    filled = Rule(type="expression", dxf=PLAIN, formula=[f"NOT(ISBLANK({first}))"])
    sheet.conditional_formatting.add(cells, filled)


def is_answer(cell: Any) -> bool:
    """Whether a cell is marked as computed."""
    # Excel and LibreOffice save the color with another opacity, in its first two digits.
    return bool(cell.has_style and str(cell.fill.fgColor.rgb)[2:] == ANSWER_FILL.fgColor.rgb[2:])


def put_answer(cell: Any, formula: str, number_format: str = "General") -> None:
    """Write a formula, without its equals sign, and mark its cell as computed."""
    cell.value = f"={formula}"
    cell.font = _ANSWER_FONT
    cell.fill, cell.border, cell.alignment = ANSWER_FILL, BOX, _INDENTED
    cell.number_format = number_format


def in_cell(value: object, unit: Unit | None) -> str | float | int | date | None:
    """Return a value as written to a cell: in the sheet's unit, without rounding error."""
    match value:
        case None | "":
            return None
        case bool():
            return str(YesNo.YES if value else YesNo.NO)
        case StrEnum():
            return str(value)
        case float() if unit is not None:
            # 12 digits: 1.0922 m are 43 in, not 43.00000000000001.
            return float(f"{value / unit.si:.12g}")
        case str():
            return escaped(value)
        case int() | float() | date():
            return value
    raise TypeError(f"cannot write a {type(value).__name__} to a cell")


def validate(sheet: Worksheet, cells: str, entry: Entry, si: float) -> None:
    """Add the dropdown or the range check of a field to cells, with its messages."""
    label, message = entry.heading, entry.note
    if entry.choices:
        offer(sheet, cells, entry.choices, label, message)
    elif entry.kind in (int, float):
        if allowed := entry.bounds.words(si):
            message = f"{message} Allowed: {allowed}{entry.or_zero}."
        if entry.zero:  # a rule on numbers would refuse the word
            suggest(sheet, cells, f'"{entry.zero}"', label, message)
            return
        _add(sheet, cells, _number_rule(entry, si), label, message, wish(entry, "", si))
    elif entry.kind is date:
        # After the serial number of 2000-01-01, `EARLIEST` of the reader.
        rule = DataValidation(type="date", operator="greaterThan", formula1="36526")
        _add(sheet, cells, rule, label, f"{message} For example 2026-03-05.", wish(entry))
    else:
        rule = DataValidation(type="textLength", operator="lessThanOrEqual")
        rule.formula1 = str(entry.max_length)
        _add(sheet, cells, rule, label, message, wish(entry))


def offer(sheet: Worksheet, cells: str, choices: Collection[str], title: str, message: str) -> None:
    """Add a dropdown of texts that accepts nothing else."""
    # Excel takes at most 255 characters of a list; the longest here, the content of layers, has
    # 105.
    rule = DataValidation(type="list", formula1=f'"{",".join(choices)}"')
    _add(sheet, cells, rule, title, message, f"choose {', '.join(choices)}")


def suggest(sheet: Worksheet, cells: str, source: str, title: str, message: str) -> None:
    """Add a dropdown of a range of cells, or of a text, that also accepts what is not in it."""
    rule = DataValidation(type="list", formula1=source)
    _add(sheet, cells, rule, title, message, "choose from the list")
    rule.showErrorMessage = False


def _add(
    sheet: Worksheet, cells: str, rule: DataValidation, title: str, message: str, remedy: str
) -> None:
    rule.allow_blank = True
    rule.showInputMessage = rule.showErrorMessage = True
    # As many characters as Excel allows.
    rule.promptTitle = rule.errorTitle = title[:32]
    rule.prompt = message[:255]
    choice = "Click Retry to correct the entry, or Cancel to restore the previous one."
    error = f"{title}: {remedy}. {choice}"
    rule.error = error if len(error) <= 225 else f"{error[:224]}…"
    rule.add(cells)
    sheet.add_data_validation(rule)


def _number_rule(entry: Entry, si: float) -> DataValidation:
    bounds = entry.bounds
    rule = DataValidation(type="whole" if entry.kind is int else "decimal")
    if math.isinf(bounds.high) and not math.isinf(bounds.low):
        rule.operator = "greaterThan" if bounds.excludes_low else "greaterThanOrEqual"
        rule.formula1 = f"{bounds.low / si:.9g}"
        return rule
    # The rule `between` needs two numbers.
    low, high = max(bounds.low / si, -NUMBER_LIMIT), min(bounds.high / si, NUMBER_LIMIT)
    rule.operator, rule.formula1, rule.formula2 = "between", f"{low:.9g}", f"{high:.9g}"
    return rule


# Percent at which every sheet is printed, and characters that a page then has room for.
_ZOOM, _WIDEST = 55, 190


def finish(sheet: Worksheet, is_us: bool) -> None:
    """Set up view and printing: landscape, at one zoom, the first columns on each page."""
    sheet.sheet_view.showGridLines = False
    sheet.sheet_view.zoomScale = 100
    page = sheet.page_setup
    page.orientation, page.scale = "landscape", _ZOOM
    # Letter, or A4, by the numbers of the file format.
    page.paperSize = 1 if is_us else 9
    visible = (column for column in sheet.column_dimensions.values() if not column.hidden)
    if sheet.tables and sum(column.width for column in visible) > _WIDEST:
        sheet.print_title_cols = "A:B"
    margins = sheet.page_margins
    # A4 is lower and wider than letter: the same rows fill a page of both.
    margins.left = margins.right = 0.4 if is_us else 0.75
    margins.top, margins.bottom, margins.footer = (0.4, 0.6, 0.3) if is_us else (0.3, 0.46, 0.2)
    footer: Any = sheet.oddFooter
    footer.left.text, footer.center.text, footer.right.text = "Roofslip input", "&A", "&P of &N"
