"""Writes the input workbook from the schema, blank or filled in.

Owns the layout of the sheets; `style` owns their appearance. `read` finds the cells by names and
headings, so positions here may change.
"""

from __future__ import annotations

import io
import math
from collections.abc import Sequence
from datetime import date
from pathlib import Path

from openpyxl import Workbook
from openpyxl.utils import get_column_letter, quote_sheetname
from openpyxl.workbook.defined_name import DefinedName
from openpyxl.worksheet.table import Table, TableColumn, TableStyleInfo
from openpyxl.worksheet.worksheet import Worksheet

from report.sheet import style
from report.sheet.fields import Entry, Frozen, Section, entries
from report.sheet.schema import PROVISION_KEYS, SECTIONS, ProjectInput, UnitsFirst
from report.words.units import LENGTHS, STIFFNESSES, VELOCITIES, WEIGHTS, Unit
from solver.files import write_whole

BLANK_ROWS = 20
SPARE_ROWS = 5
LAST_ROW = 500
BLOCK_HEADS = ("", "Value", "Unit", "Allowed", "Example", "Note")
BLOCK_WIDTHS = (28, 36, 13, 36, 32, 48)
HINT_ROWS = ("Required", "Allowed", "Example")
PROVISIONS = "Provisions"
CODE_WIDTH, NUMBER_WIDTH, TEXT_WIDTH = 14, 14, 32

STEPS = (
    "Fill in the yellow cells, sheet by sheet. Select a cell to see its instructions.",
    "Put the acceleration records in the folder “records” beside this workbook, or paste them"
    " as columns into a new sheet.",
    "Save the workbook as .xlsx and close it.",
    "Check the input with the command below, which lists every cell to correct.",
    "Write the calculation package, out/calc-package.pdf in the same folder.",
)
COMMANDS = (
    ("roofslip check FOLDER", "reads and checks the input; writes nothing"),
    ("roofslip report FOLDER", "writes the package to FOLDER/out"),
)
NOTES = (
    "FOLDER is the folder that contains this workbook, named input.xlsx.",
    "Units are in brackets in the table headings and elsewhere in the column Unit. You may change"
    f" them: lengths to {', '.join(LENGTHS)}; weights to {', '.join(WEIGHTS)}; stiffnesses to"
    f" {', '.join(STIFFNESSES)}; velocities to {', '.join(VELOCITIES)}.",
    "Sheets are protected against accidental changes, without a password (Review, Unprotect Sheet)."
    " You may rename sheets, insert rows, and reorder or add columns.",
    "Formulas are accepted. Macros are not: .xlsm files are rejected.",
)
LEGEND = (
    ("input", "000000", style.INPUT_FILL, "Input cell."),
    (
        "heading",
        style.WHITE,
        style.REQUIRED_FILL,
        "Required column. Other required cells are marked *.",
    ),
    ("heading", style.WHITE, style.OPTIONAL_FILL, "Optional column."),
    ("example", style.GRAY, style.HINT_FILL, "Allowed range and example; not read as input."),
)


def write_template(path: Path, *, units: UnitsFirst, example: ProjectInput | None = None) -> None:
    """Write an input workbook, blank or with the values of a project.

    Parameters
    ----------
    path : Path
        The .xlsx file to write or replace.
    units : UnitsFirst
        System of units of the sheets.
    example : ProjectInput, optional
        Values to fill in; without it the inputs are blank except for defaults.
    """
    book = Workbook()
    _write_readme(book)
    _write_provisions(book)
    for section in SECTIONS:
        if section.sheet not in book.sheetnames:
            book.create_sheet(section.sheet)
        rows = _rows(section, example)
        (_write_table if section.is_table else _write_block)(book, section, units, rows)
    book.move_sheet(PROVISIONS, len(book.sheetnames))
    for sheet in book.worksheets:
        style.finish(sheet, units is UnitsFirst.US)
    buffer = io.BytesIO()
    book.save(buffer)
    write_whole(path, buffer.getvalue())


def _rows(section: Section, example: ProjectInput | None) -> Sequence[Frozen]:
    if example is None:
        return ()
    value = getattr(example, section.key)
    return value if section.is_table else (value,)


def _title(sheet: Worksheet, title: str, hint: str) -> int:
    """Write a heading below the existing content and return the next free row."""
    row = 1 if sheet.max_row == 1 else sheet.max_row + 3
    style.put(sheet, row, 1, title, bold=True, size=16 if row == 1 else 13, wrap=False)
    style.put(sheet, row + 1, 1, hint, color=style.GRAY, wrap=False)
    sheet.row_dimensions[row].height = 28
    return row + 3


def _write_block(
    book: Workbook, section: Section, units: UnitsFirst, rows: Sequence[Frozen]
) -> None:
    sheet = book[section.sheet]
    is_first = sheet.max_row == 1
    top = _title(sheet, section.title, section.hint)
    for column, (head, width) in enumerate(zip(BLOCK_HEADS, BLOCK_WIDTHS, strict=True), start=1):
        sheet.column_dimensions[get_column_letter(column)].width = width
        style.put(sheet, top, column, head, bold=True).border = style.LINE
    for row, entry in enumerate(entries(section.model), start=top + 1):
        value = getattr(rows[0], entry.name) if rows else _preset(entry, units)
        style.put_input(sheet.cell(row, 2), entry, value, _unit(entry, units))
        _write_block_row(book, row, section, entry, _unit(entry, units))
    if is_first:
        sheet.freeze_panes = f"A{top + 1}"


def _preset(entry: Entry, units: UnitsFirst) -> object:
    return units if entry.kind is UnitsFirst else entry.default


def _write_block_row(
    book: Workbook, row: int, section: Section, entry: Entry, unit: Unit | None
) -> None:
    sheet, needed = book[section.sheet], entry.is_required
    style.put(sheet, row, 1, f"{entry.cell.label}{' *' if needed else ''}", bold=needed)
    # Bounds of quantities are 0 or open, so they are valid in any unit.
    texts = (_allowed(entry, 1.0), _example(entry, unit), entry.cell.help)
    for column, text in enumerate(texts, start=4):
        style.put(sheet, row, column, text, color=style.GRAY, italic=column == 5)
    sheet.row_dimensions[row].height = 9 + 13 * _lines(texts, BLOCK_WIDTHS[3:])
    _name(book, section.cell_name(entry.name), sheet, row, 2)
    style.validate(sheet, f"B{row}", entry, 1.0)
    if entry.quantity is None or unit is None:
        style.put(sheet, row, 3, str(entry.cell.unit), color=style.GRAY)
        return
    sheet.cell(row, 3).value = unit.symbol
    style.style_input(sheet.cell(row, 3), str)
    _name(book, section.unit_name(entry.name), sheet, row, 3)
    style.offer(sheet, f"C{row}", entry.quantity.accepted, "Unit", "Unit of the value to the left.")


def _name(book: Workbook, name: str, sheet: Worksheet, row: int, column: int) -> None:
    target = f"{quote_sheetname(sheet.title)}!${get_column_letter(column)}${row}"
    book.defined_names[name] = DefinedName(name, attr_text=target)


def _write_table(
    book: Workbook, section: Section, units: UnitsFirst, rows: Sequence[Frozen]
) -> None:
    sheet, fields = book[section.sheet], entries(section.model)
    has_block = sheet.max_row > 1
    top = _title(sheet, section.title, section.hint)
    header = top + len(HINT_ROWS)
    _write_hints(sheet, top, fields, units)
    size = max(BLANK_ROWS, len(rows) + SPARE_ROWS)
    for column, entry in enumerate(fields, start=2):
        _write_header(sheet, header, column, entry, units)
        values = [_unless_default(getattr(row, entry.name), entry) for row in rows]
        values += [None] * (size - len(values))
        _write_inputs(sheet, header, column, entry, _unit(entry, units), values)
        _write_help(book, section, header, column, entry, units)
        if not has_block or column > len(BLOCK_WIDTHS):
            sheet.column_dimensions[get_column_letter(column)].width = _width(entry)
    _add_table(sheet, section, header, size, [_header(entry, units) for entry in fields])
    if not has_block:
        sheet.column_dimensions["A"].width = 10
        sheet.freeze_panes = f"C{header + 1}"
        sheet.print_title_rows = f"{header}:{header}"


def _unless_default(value: object, entry: Entry) -> object:
    """Return a value, or None if a blank cell means the same."""
    return None if not entry.is_required and value == entry.default else value


def _write_hints(sheet: Worksheet, top: int, fields: Sequence[Entry], units: UnitsFirst) -> None:
    for offset, name in enumerate(HINT_ROWS):
        style.put(sheet, top + offset, 1, name, color=style.GRAY, size=9)
    for column, entry in enumerate(fields, start=2):
        unit = _unit(entry, units)
        texts = (entry.need, _allowed(entry, unit.si if unit else 1.0), _example(entry, unit))
        for row, text in enumerate(texts, start=top):
            is_example = row == top + 2
            hint = style.put(sheet, row, column, text, color=style.GRAY, size=9, italic=is_example)
            hint.fill, hint.border = style.HINT_FILL, style.BOX
    widths = [_width(entry) for entry in fields]
    for row in (top + 1, top + 2):
        said = [str(sheet.cell(row, column).value) for column in range(2, 2 + len(fields))]
        sheet.row_dimensions[row].height = 4 + 12.5 * _lines(said, widths)


def _write_header(sheet: Worksheet, row: int, column: int, entry: Entry, units: UnitsFirst) -> None:
    cell = style.put(sheet, row, column, _header(entry, units), bold=True, color=style.WHITE)
    cell.fill = style.REQUIRED_FILL if entry.is_expected else style.OPTIONAL_FILL
    cell.border = style.BOX
    sheet.row_dimensions[row].height = 44


def _write_inputs(
    sheet: Worksheet,
    header: int,
    column: int,
    entry: Entry,
    unit: Unit | None,
    values: Sequence[object],
) -> None:
    dimension = sheet.column_dimensions[get_column_letter(column)]
    for row, value in enumerate(values, start=header + 1):
        style.put_input(sheet.cell(row, column), entry, value, unit)
        lines = _lines([str(value or "")], [max(int(dimension.width), _width(entry))])
        height = sheet.row_dimensions[row].height or 0
        sheet.row_dimensions[row].height = max(height, 3 + 14 * lines)
    # Cells below the prepared rows stay unlocked: they are read as well.
    dimension.protection = style.OPEN


def _write_help(
    book: Workbook, section: Section, header: int, column: int, entry: Entry, units: UnitsFirst
) -> None:
    sheet, letter, unit = book[section.sheet], get_column_letter(column), _unit(entry, units)
    cells = f"{letter}{header + 1}:{letter}{LAST_ROW}"
    source = _source(book, section, entry)
    if source:
        style.suggest(sheet, cells, source, entry.cell.label, entry.cell.help)
    else:
        style.validate(sheet, cells, entry, unit.si if unit else 1.0)


def _add_table(
    sheet: Worksheet, section: Section, header: int, size: int, headers: Sequence[str]
) -> None:
    last = get_column_letter(1 + len(headers))
    table = Table(displayName=section.table_name, ref=f"B{header}:{last}{header + size}")
    # Columns are named here: openpyxl would add filter buttons, which a protected sheet disables.
    table.tableColumns = [TableColumn(id=i, name=name) for i, name in enumerate(headers, start=1)]
    table.tableStyleInfo = TableStyleInfo(name="TableStyleLight1", showRowStripes=False)
    sheet.add_table(table)


def _source(book: Workbook, section: Section, entry: Entry) -> str:
    """Return the range that supplies the dropdown of a table's column; empty for none."""
    if section.key == "overrides" and entry.name == "provision":
        first = book[PROVISIONS].max_row - len(PROVISION_KEYS) + 1
        return f"{PROVISIONS}!$A${first}:$A${book[PROVISIONS].max_row}"
    if section.key in ("clearances", "links") and entry.name in ("array", "object"):
        sheet = book["Arrays" if entry.name == "array" else "Objects"]
        first = next(iter(sheet.tables.values())).ref.split(":")[0].lstrip("B")
        return f"{sheet.title}!$B${int(first) + 1}:$B${LAST_ROW}"
    return ""


def _write_readme(book: Workbook) -> None:
    sheet = book.worksheets[0]
    sheet.title = "README"
    for column, width in zip("ABC", (5, 30, 92), strict=True):
        sheet.column_dimensions[column].width = width
    row = _title(sheet, "Roofslip input workbook", "From this workbook to the calculation package.")
    row = _write_steps(sheet, row)
    row = _write_pairs(sheet, row, "Commands", COMMANDS)
    row = _write_legend(sheet, row)
    _write_pairs(sheet, row, "Notes", tuple(("", note) for note in NOTES))


def _write_steps(sheet: Worksheet, row: int) -> int:
    for number, step in enumerate(STEPS, start=1):
        style.put(sheet, row, 1, str(number), bold=True, size=12)
        style.put(sheet, row, 2, step, size=11, wrap=False)
        sheet.row_dimensions[row].height = 21
        row += 1
    return row + 1


def _write_pairs(sheet: Worksheet, row: int, title: str, pairs: Sequence[tuple[str, str]]) -> int:
    style.put(sheet, row, 1, title, bold=True, size=13, wrap=False)
    sheet.row_dimensions[row].height = 24
    for left, right in pairs:
        row += 1
        style.put(sheet, row, 2, left or right, bold=bool(left), wrap=bool(left))
        if left:
            style.put(sheet, row, 3, right, color=style.GRAY)
        elif len(right) > 120:
            sheet.merge_cells(start_row=row, end_row=row, start_column=2, end_column=3)
            sheet.cell(row, 2).alignment = style.WRAPPED
        sheet.row_dimensions[row].height = 32 if len(right) > 120 else 19
    return row + 2


def _write_legend(sheet: Worksheet, row: int) -> int:
    style.put(sheet, row, 1, "Colors", bold=True, size=13, wrap=False)
    sheet.row_dimensions[row].height = 24
    for sample, color, fill, meaning in LEGEND:
        row += 1
        cell = style.put(sheet, row, 2, sample, color=color, bold=color == style.WHITE)
        cell.fill, cell.border = fill, style.BOX
        style.put(sheet, row, 3, meaning, color=style.GRAY)
        sheet.row_dimensions[row].height = 21
    return row + 2


def _write_provisions(book: Workbook) -> None:
    sheet = book.create_sheet(PROVISIONS)
    hint = "Numbers that can be overridden on the sheet Options. This sheet has no input cells."
    top = _title(sheet, "Provisions", hint)
    for column, width in zip("AB", (30, 90), strict=True):
        sheet.column_dimensions[column].width = width
    for row, (key, meaning) in enumerate(PROVISION_KEYS.items(), start=top):
        style.put(sheet, row, 1, key, bold=True).border = style.LINE
        style.put(sheet, row, 2, meaning, color=style.GRAY).border = style.LINE
        sheet.row_dimensions[row].height = 18


def _unit(entry: Entry, units: UnitsFirst) -> Unit | None:
    if entry.quantity is None:
        return None
    return entry.quantity.us if units is UnitsFirst.US else entry.quantity.si


def _header(entry: Entry, units: UnitsFirst) -> str:
    unit = _unit(entry, units)
    symbol = unit.symbol if unit else entry.cell.unit
    return f"{entry.cell.label} [{symbol}]" if symbol else entry.cell.label


def _allowed(entry: Entry, si: float) -> str:
    if entry.choices:
        return " / ".join(entry.choices)
    if entry.kind in (int, float):
        return entry.bounds.words(si) or "any number"
    return "a date" if entry.kind is date else "text"


def _example(entry: Entry, unit: Unit | None) -> str:
    value = entry.cell.example
    if unit is not None and entry.quantity is not None and isinstance(value, float):
        # 42000 lb keeps all digits; 186.825 kN becomes 187.
        digits = 5 if unit == entry.quantity.us else 3
        return f"{value * entry.quantity.us.si / unit.si:.{digits}g}"
    return f"{value:g}" if isinstance(value, float) else str(value)


def _width(entry: Entry) -> int:
    if entry.choices:
        return max(CODE_WIDTH, max(map(len, entry.choices)) + 4)
    if entry.kind is str and entry.max_length > 40:
        return TEXT_WIDTH
    return NUMBER_WIDTH


def _lines(texts: Sequence[str], widths: Sequence[int]) -> int:
    """Return the number of lines of the tallest text at its column's width."""
    return max(
        math.ceil(max(len(text), 1) / (1.2 * width))
        for text, width in zip(texts, widths, strict=True)
    )
