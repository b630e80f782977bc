"""The sheet Start: the six steps, a picture that explains the words, the colors, what is missing.

Has no inputs. Read `write_start`.
"""

from __future__ import annotations

import io

from openpyxl import Workbook
from openpyxl.drawing.image import Image
from openpyxl.styles import PatternFill
from openpyxl.worksheet.worksheet import Worksheet

from report.sheet.schema import SECTIONS
from report.sheet.writing import marks, style
from report.sheet.writing.counts import COUNTS_COLUMN, START
from report.sheet.writing.sketch import SIZE_IN, sketch_png
from report.words.units import LENGTHS, STIFFNESSES, VELOCITIES, WEIGHTS

_WIDTHS = (5, 24, 76, 16, 14)
_HINT = "From this workbook to the calculation package. This sheet has no input cells."

STEPS = (
    "Fill in the yellow cells, sheet by sheet. Select a cell to see its instructions.",
    "Put the acceleration records in the folder “records” beside this workbook, or paste them as"
    " columns into a new sheet.",
    "Look at the blue cells, which compute, and at the line at the top of each sheet.",
    "Save the workbook as .xlsx and close it.",
    "Run roofslip check FOLDER. It lists every cell to correct and writes nothing. FOLDER contains"
    " this workbook, named input.xlsx.",
    "Run roofslip report FOLDER. It writes the calculation package to FOLDER/out.",
)
_NOTES = (
    "Units are in brackets in the table headings and elsewhere in the column Unit. You may change"
    f" them: lengths to {', '.join(LENGTHS)}; weights to {', '.join(WEIGHTS)}; stiffnesses to"
    f" {', '.join(STIFFNESSES)}; velocities to {', '.join(VELOCITIES)}.",
    "Tables grow: type in the row below the last one. You may rename sheets, insert rows, and add"
    " columns to the right of a table. Columns that are rarely needed are folded at the right: the"
    " + above the headings opens them.",
    "A roof that is drawn is read by roofslip plan read ROOF.DXF FOLDER; the sheet Layers says what"
    " is drawn on each layer of the drawing.",
    "The blue cells compute prescriptive values only; the package alone has the displacement from"
    " analysis. They are not read as input. If one is typed over, it turns violet, roofslip check"
    " lists it, and roofslip check --repair restores its formula. Formulas in yellow cells are"
    " accepted. Macros are not: .xlsm files are rejected.",
)
_RED_FILL, _AMBER_FILL, _VIOLET_FILL, _DRAWN_FILL = (
    PatternFill("solid", start_color=color)
    for color in (marks.RED, marks.AMBER, marks.VIOLET, marks.DRAWN)
)
_SAMPLES = (
    ("input", "000000", style.INPUT_FILL, "Input cell."),
    (
        "heading, tab",
        style.WHITE,
        style.REQUIRED_FILL,
        "Required column or sheet; also cells with *.",
    ),
    ("heading, tab", style.WHITE, style.OPTIONAL_FILL, "Optional column or sheet."),
    ("tab", style.INK, style.RARE_FILL, "Sheet that is rarely needed."),
    ("tab", style.WHITE, style.HELP_FILL, "Sheet without input cells."),
    ("1.566", style.INK, style.ANSWER_FILL, "Computed cell: a formula, not read as input."),
    ("example", style.GRAY, style.HINT_FILL, "Allowed range and example; not read as input."),
    (
        "",
        "000000",
        _RED_FILL,
        "Required and still blank, or refused: no number, out of range, no choice, unknown.",
    ),
    ("1.2", "000000", _AMBER_FILL, "Outside the usual range."),
    ("8.25", "000000", _DRAWN_FILL, "Row of Outlines or Clearances taken from a drawing."),
    ("1.5", style.INK, _VIOLET_FILL, "Computed cell that has lost its formula."),
    ("✓", marks.GREEN, style.ANSWER_FILL, "Nothing is missing, and roofslip check accepts it."),
    (marks.SEE_CHECK, marks.UNDECIDED, style.ANSWER_FILL, "Nothing is missing; check decides."),
)


def color_tabs(book: Workbook) -> None:
    """Color the tab of each sheet by the need for it."""
    for sheet in book.worksheets:
        sections = [section for section in SECTIONS if section.sheet == sheet.title]
        fill = style.RARE_FILL if sections else style.HELP_FILL
        if not all(section.may_be_absent for section in sections):
            is_needed = any(section.is_needed for section in sections)
            fill = style.REQUIRED_FILL if is_needed else style.OPTIONAL_FILL
        sheet.sheet_properties.tabColor = fill.start_color.rgb


def write_start(book: Workbook) -> int:
    """Write the sheet; return the first row of the list of what each sheet lacks."""
    sheet = book[START]
    for column, width in zip("ABCDE", _WIDTHS, strict=True):
        sheet.column_dimensions[column].width = width
    style.put_title(sheet, "Roofslip input workbook", _HINT)
    sheet.page_setup.fitToHeight = 1
    picture = _write_steps(sheet, 4)
    counts = _put_heading(sheet, picture, "Missing or wrong", COUNTS_COLUMN)
    titles = {section.sheet for section in SECTIONS}
    row = max(_put_picture(sheet, picture), counts + len(titles) + 1)
    row = _put_heading(sheet, _write_colors(sheet, row), "Notes")
    for at, note in enumerate(_NOTES, start=row):
        style.put(sheet, at, 2, note)
        sheet.merge_cells(start_row=at, end_row=at, start_column=2, end_column=5)
        sheet.row_dimensions[at].height = 34
    return counts


def _put_heading(sheet: Worksheet, row: int, title: str, column: int = 1) -> int:
    style.put(sheet, row, column, title, bold=True, size=13, wrap=False)
    sheet.row_dimensions[row].height = 24
    return row + 1


def _write_steps(sheet: Worksheet, row: int) -> int:
    for at, step in enumerate(STEPS, start=row):
        style.put(sheet, at, 1, str(at - row + 1), bold=True, size=12)
        style.put(sheet, at, 2, step, size=11, wrap=False)
        sheet.row_dimensions[at].height = 20
    return row + len(STEPS) + 1


def _put_picture(sheet: Worksheet, row: int) -> int:
    """Place the picture, and return the row below it."""
    picture = Image(io.BytesIO(sketch_png()))
    picture.width, picture.height = (round(side * 96) for side in SIZE_IN)
    sheet.add_image(picture, f"B{row}")
    return row + int(SIZE_IN[1] * 72 / 15) + 1


def _write_colors(sheet: Worksheet, row: int) -> int:
    row = _put_heading(sheet, row, "Colors")
    for at, (sample, color, fill, meaning) in enumerate(_SAMPLES, start=row):
        cell = style.put(sheet, at, 2, sample, color=color, bold=color != "000000")
        cell.fill, cell.border = fill, style.BOX
        style.put(sheet, at, 3, meaning, color=style.GRAY)
        sheet.row_dimensions[at].height = 18
    return row + len(_SAMPLES) + 1
