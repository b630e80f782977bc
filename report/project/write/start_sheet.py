"""The Start worksheet: answers, steps, links, a picture, the colors."""

from __future__ import annotations

import io
from pathlib import Path

from openpyxl import Workbook
from openpyxl.drawing.image import Image
from openpyxl.styles import Font
from openpyxl.utils import get_column_letter
from openpyxl.worksheet.hyperlink import Hyperlink
from openpyxl.worksheet.worksheet import Worksheet

from report.project.workbook import SECTIONS, answer_columns
from report.project.workbook.layout import Tables, name_cell
from report.project.write import style
from report.text.units import LENGTHS, STIFFNESSES, VELOCITIES, WEIGHTS, Quantity
from solver.rules.provisions import Neighbor

_ANSWERS_HINT = "Computed from the other worksheets. Values of the rule set: Provisions worksheet."
_HEADS = ("", "", "Value", "Separation", "", "", "Largest D/C", "", "Note")
_SEPARATIONS = {
    Neighbor.LIKE: "Separation, array of similar construction",
    Neighbor.FIXED: "Separation, fixed object or array of different construction",
    Neighbor.PARAPET: "Separation, edge with qualifying parapet",
    Neighbor.EDGE: "Separation, edge without qualifying parapet",
}


def write_panel(sheet: Worksheet, top: int, tables: Tables, *, is_us: bool) -> int:
    """Write the answers from a row on; return the row below them and one more."""
    style.put_heading(sheet, top, "Before any analysis", _ANSWERS_HINT)
    style.put_values(sheet, top + 2, _HEADS, are_heads=True)
    unit = Quantity.DISPLACEMENT.value[0 if is_us else 1]
    lengths = f'{answer_columns.decimals_format(unit)}" {unit.symbol}"'
    row = top + 3
    note = "As entered; if blank, the lowest category permitted by S_DS, S_D1 and S_1."
    _write_line(sheet, row, ("SDC used", answer_columns.CATEGORY_USED, note), "General")
    name_cell("live_sdc_used", sheet, row, 3)
    note = "The equation or the minimum of the rule set, whichever is larger."
    prescriptive = ("Prescriptive displacement", answer_columns.prescriptive(unit), note)
    _write_line(sheet, row + 1, prescriptive, lengths)
    name_cell("live_prescriptive", sheet, row + 1, 3)
    worst = answer_columns.written(answer_columns.WORST, tables, "clearances", row + 1)
    style.put_answer(sheet.cell(row + 1, 7), worst, "0.00")
    note = "Smallest design displacement permitted by analysis without peer review."
    _write_line(
        sheet, row + 2, ("Floor of the analysis displacement", answer_columns.FLOOR, note), lengths
    )
    for neighbor, label in _SEPARATIONS.items():
        number = answer_columns.SEPARATION_ROWS[neighbor]
        line = row + 2 + number
        factor = "I_e of the building" if neighbor.is_edge else "the largest I_p"
        note = f"PV1-2012: multiplied by {factor}."
        _write_line(sheet, line, (label, answer_columns.separation(unit, line), note), lengths)
        # The formula beside it reads which separation it is from this cell (`$D`).
        style.put(sheet, line, 4, "", color=style.GRAY).value = number
    return row + 3 + len(_SEPARATIONS) + 1


def _write_line(sheet: Worksheet, row: int, line: tuple[str, str, str], number_format: str) -> None:
    """Write label, formula and note."""
    label, formula, note = line
    style.put(sheet, row, 2, label).border = style.LINE
    style.put_answer(sheet.cell(row, 3), formula, number_format)
    style.put(sheet, row, 9, note, color=style.GRAY)
    sheet.row_dimensions[row].height = 28


START = "Start"
LINKS_COLUMN, COLORS_COLUMN = 7, 8
_WIDTHS = (5, 42, 14, 14, 16, 22, 14, 20, 42)
_PICTURE_PX = (730, 296)  # which ends before the links
_HINT = "How to get a calculation package from this workbook. No input cells on this worksheet."

# Sheets that are rarely needed: of nothing but tables that may be absent.
RARE = {section.sheet for section in SECTIONS} - {
    section.sheet for section in SECTIONS if not (section.is_table and section.may_be_absent)
}

STEPS = (
    "Fill in the yellow cells, one worksheet at a time. Select a cell to see its instructions.",
    "Put the acceleration records in the folder “records” next to this workbook, or paste them as"
    " columns into a new worksheet.",
    "Review the blue cells (formulas) here and on the Site, Arrays and Clearances worksheets.",
    "Save the workbook as .xlsx and close it.",
    "Run roofslip check FOLDER to list missing and incorrect entries. The browser page (roofslip"
    " serve) lists them too. FOLDER contains this workbook, named input.xlsx.",
    "Run roofslip report FOLDER. It writes the calculation package to FOLDER/out.",
)
_NOTES = (
    "If the Motions worksheet is empty, no analysis is run. The package uses the prescriptive"
    " displacement for every array and states how much an analysis could reduce it.",
    "Units are in brackets in the table headings and elsewhere in the column Unit. You may change"
    f" them: lengths to {', '.join(LENGTHS)}; weights to {', '.join(WEIGHTS)}; stiffnesses to"
    f" {', '.join(STIFFNESSES)}; velocities to {', '.join(VELOCITIES)}.",
    "To add a row, type in the row below the last one. You may rename worksheets, insert rows, and"
    " add columns to the right of a table. Seldom-used columns are grouped at the right; click +"
    " above the headings to show them.",
    "Seldom-used worksheets are hidden while they are empty: right-click a tab and choose Unhide"
    " (in LibreOffice, Show Sheet). So is Tables, with the lookup tables of the formulas.",
    "To import the roof plan from a DXF drawing, run roofslip plan read ROOF.DXF FOLDER. The Layers"
    " worksheet lists what is drawn on each layer.",
    "Blue cells show prescriptive values only; the analysis displacement appears only in the"
    " package. They are not read as input. If you overwrite one, roofslip check reports it."
    " Formulas in yellow cells are accepted. Macros are not: .xlsm files are rejected.",
)
_SAMPLES = (
    ("", "000000", style.INPUT_FILL, "Input cell; turns white when filled in."),
    ("heading, tab", style.WHITE, style.REQUIRED_FILL,
     "Required column or worksheet; also cells with *."),
    ("heading, tab", style.WHITE, style.OPTIONAL_FILL, "Optional column or worksheet."),
    ("tab", style.INK, style.RARE_FILL, "Seldom-used worksheet, hidden while empty."),
    ("tab", style.WHITE, style.HELP_FILL, "Worksheet without input cells."),
    ("heading", style.INK, style.ANSWER_HEAD_FILL,
     "Computed cells: formulas, not read as input."),
    ("example", style.GRAY, style.HINT_FILL, "Allowed range and example; not read as input."),
)  # fmt: skip


def write_start(book: Workbook, tables: Tables, *, is_us: bool) -> None:
    """Write the sheet."""
    sheet = book[START]
    for column, width in enumerate(_WIDTHS, start=1):
        sheet.column_dimensions[get_column_letter(column)].width = width
    style.put_title(sheet, "Roofslip input workbook", _HINT)
    picture = _write_steps(sheet, write_panel(sheet, 4, tables, is_us=is_us))
    links = _write_links(book, _put_heading(sheet, picture, "Worksheets", LINKS_COLUMN))
    colors = _write_colors(sheet, picture)
    row = _put_heading(sheet, max(_put_picture(sheet, picture), links, colors), "Notes")
    for line, note in enumerate(_NOTES, start=row):
        style.put(sheet, line, 2, note)
        sheet.merge_cells(start_row=line, end_row=line, start_column=2, end_column=len(_WIDTHS))
        sheet.row_dimensions[line].height = 28


def _write_links(book: Workbook, row: int) -> int:
    """Write a link to each sheet of inputs; return the row below and one more."""
    titles = list(dict.fromkeys(section.sheet for section in SECTIONS))
    for line, title in enumerate(titles, start=row):
        # By a defined name, which follows a sheet that is renamed.
        name = f"top_{title.lower().replace(' ', '_')}"
        name_cell(name, book[title], 1, 1)
        words = f"{title} (seldom used)" if title in RARE else title
        cell = style.put(book[START], line, LINKS_COLUMN, words, wrap=False)
        cell.hyperlink = Hyperlink(ref=cell.coordinate, location=name)
        cell.font = Font(name="Calibri", size=10, color=style.INK, underline="single")
    return row + len(titles) + 1


def _put_heading(sheet: Worksheet, row: int, title: str, column: int = 1) -> int:
    style.put(sheet, row, column, title, bold=True, size=13, wrap=False)
    sheet.row_dimensions[row].height = 24
    return row + 1


def _write_steps(sheet: Worksheet, row: int) -> int:
    for line, step in enumerate(STEPS, start=row):
        style.put(sheet, line, 1, str(line - row + 1), bold=True, size=12)
        style.put(sheet, line, 2, step, size=11, wrap=False)
        sheet.row_dimensions[line].height = 20
    return row + len(STEPS) + 1


def _put_picture(sheet: Worksheet, row: int) -> int:
    """Place the picture, and return the row below it."""
    picture = Image(io.BytesIO(Path(__file__).with_name("start.png").read_bytes()))
    picture.width, picture.height = _PICTURE_PX
    sheet.add_image(picture, f"B{row}")
    # At 96 px an inch, 0.75 pt a pixel; a row is 15 pt tall.
    return row + int(_PICTURE_PX[1] * 0.75 / 15) + 1


def _write_colors(sheet: Worksheet, row: int) -> int:
    row = _put_heading(sheet, row, "Colors", COLORS_COLUMN)
    for line, (sample, color, fill, meaning) in enumerate(_SAMPLES, start=row):
        cell = style.put(sheet, line, COLORS_COLUMN, sample, color=color, bold=color != "000000")
        cell.fill, cell.border = fill, style.BOX
        style.put(sheet, line, COLORS_COLUMN + 1, meaning, color=style.GRAY)
        sheet.row_dimensions[line].height = 20
    return row + len(_SAMPLES) + 1
