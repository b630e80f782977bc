"""The sheet Start: the six steps, links to the sheets, a picture of the words, and the colors.

Has no inputs. Read `write_start`.
"""

from __future__ import annotations

import io
from pathlib import Path

from openpyxl import Workbook
from openpyxl.drawing.image import Image
from openpyxl.styles import Font
from openpyxl.worksheet.hyperlink import Hyperlink
from openpyxl.worksheet.worksheet import Worksheet

from report.sheet.schema import SECTIONS
from report.sheet.schema.layout import name_cell
from report.sheet.writing import style
from report.words.units import LENGTHS, STIFFNESSES, VELOCITIES, WEIGHTS

START = "Start"
LINKS_COLUMN = 4
_WIDTHS = (5, 24, 76, 16, 14)
_HINT = "From this workbook to the calculation package. This sheet has no input cells."

STEPS = (
    "Fill in the yellow cells, sheet by sheet. Select a cell to see its instructions.",
    "Put the acceleration records in the folder “records” beside this workbook, or paste them as"
    " columns into a new sheet.",
    "Look at the blue cells, which compute.",
    "Save the workbook as .xlsx and close it.",
    "Run roofslip check FOLDER, which finds what is missing or wrong, as does the page of roofslip"
    " serve. FOLDER contains this workbook, named input.xlsx.",
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
    " analysis. They are not read as input. If one is typed over, roofslip check lists it. Formulas"
    " in yellow cells are accepted. Macros are not: .xlsm files are rejected.",
)
_SAMPLES = (
    ("", "000000", style.INPUT_FILL, "Input cell. It loses its color once it is filled."),
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


def write_start(book: Workbook) -> None:
    """Write the sheet."""
    sheet = book[START]
    for column, width in zip("ABCDE", _WIDTHS, strict=True):
        sheet.column_dimensions[column].width = width
    style.put_title(sheet, "Roofslip input workbook", _HINT)
    sheet.page_setup.fitToHeight = 1
    picture = _write_steps(sheet, 4)
    links = _write_links(book, _put_heading(sheet, picture, "Sheets", LINKS_COLUMN))
    row = max(_put_picture(sheet, picture), links)
    row = _put_heading(sheet, _write_colors(sheet, row), "Notes")
    for at, note in enumerate(_NOTES, start=row):
        style.put(sheet, at, 2, note)
        sheet.merge_cells(start_row=at, end_row=at, start_column=2, end_column=5)
        sheet.row_dimensions[at].height = 34


def _write_links(book: Workbook, row: int) -> int:
    """Write a link to each sheet of inputs; return the row below and one more."""
    titles = list(dict.fromkeys(section.sheet for section in SECTIONS))
    for at, title in enumerate(titles, start=row):
        # By a defined name, which follows a sheet that is renamed.
        name = f"top_{title.lower().replace(' ', '_')}"
        name_cell(name, book[title], 1, 1)
        cell = style.put(book[START], at, LINKS_COLUMN, title)
        cell.hyperlink = Hyperlink(ref=cell.coordinate, location=name)
        cell.font = Font(name="Calibri", size=10, color=style.INK, underline="single")
    return row + len(titles) + 1


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
    picture = Image(io.BytesIO(Path(__file__).with_name("start.png").read_bytes()))
    picture.width, picture.height = 922, 374
    sheet.add_image(picture, f"B{row}")
    return row + 19


def _write_colors(sheet: Worksheet, row: int) -> int:
    row = _put_heading(sheet, row, "Colors")
    for at, (sample, color, fill, meaning) in enumerate(_SAMPLES, start=row):
        cell = style.put(sheet, at, 2, sample, color=color, bold=color != "000000")
        cell.fill, cell.border = fill, style.BOX
        style.put(sheet, at, 3, meaning, color=style.GRAY)
        sheet.row_dimensions[at].height = 18
    return row + len(_SAMPLES) + 1
