"""Writes blocks of single cells and tables of rows, with their hints, names and messages.

Independent of what the sections mean. Read `write_block` and `write_table`; `template` calls them.
"""

from __future__ import annotations

import textwrap
from collections.abc import Sequence
from dataclasses import dataclass
from datetime import date

from openpyxl import Workbook
from openpyxl.utils import get_column_letter
from openpyxl.worksheet.table import Table, TableColumn, TableFormula, TableStyleInfo
from openpyxl.worksheet.worksheet import Worksheet

from report.project.model.choices import UnitsFirst
from report.project.model.overrides import provision_name
from report.project.model.values import Frozen
from report.project.workbook.answer_columns import (
    SITE_ANSWERS,
    SITE_FORMAT,
    FormulaColumn,
    table_answers,
)
from report.project.workbook.entries import Entry, SheetSection, rows_of
from report.project.workbook.layout import TablePlace, Tables, name_cell
from report.project.write import style
from report.text.units import Unit

# Rows of a table without rows, and of one that is below others on its sheet.
BLANK_ROWS, FEWER_ROWS = 20, 6

SPARE_ROWS = 5
BLOCK_HEADS = ("", "Value", "Unit", "Computed", "Allowed", "Example", "Note")
BLOCK_WIDTHS = (29, 31, 13, 16, 27, 19, 54)
HINT_ROWS = ("", "Allowed", "Example")
CODE_WIDTH, NUMBER_WIDTH, TEXT_WIDTH = 10, 9, 22
HINTS_WIDTH = 10
# First column of a table; the words for its hints are in the one before it.
FIRST = 2

MANY, MANY_WIDTH = 6, 12
_WIDER = 0.85  # of a column for text that is typed, as fonts may be wider than Calibri
# Most lines of text that a row of a table is made tall for.
DATA_LINES = 5

# Names of the ranges that supply the dropdowns of columns.
_SOURCES = {
    ("overrides", "provision"): "rule_names",
    ("clearances", "array"): "array_names",
    ("clearances", "object"): "object_names",
    ("links", "array"): "array_names",
}


def _put_section_title(sheet: Worksheet, section: SheetSection) -> tuple[int, bool]:
    """Write heading and hint of a section; return the next free row and whether it is the first."""
    if sheet.max_row == 1:
        style.put_title(sheet, section.title, section.note)
        return 4, True
    row = sheet.max_row + 2
    style.put_heading(sheet, row, section.title, section.note)
    return row + 3, False


def write_block(
    book: Workbook,
    section: SheetSection,
    sections: Sequence[SheetSection],
    units: UnitsFirst,
    example: object,
) -> None:
    """Write a block, with the values that an example has by section, or blank but for defaults."""
    sheet = book[section.sheet]
    top, is_first = _put_section_title(sheet, section)
    # Of the blocks, Site alone has answers beside its inputs.
    unused = "" if section.key == "site" else "Computed"
    style.put_values(
        sheet, top, [head if head != unused else "" for head in BLOCK_HEADS], are_heads=True
    )
    rows = rows_of(section, sections)
    for row, (part, entry) in enumerate(rows, start=top + 1):
        value = units if entry.kind is UnitsFirst else entry.default
        if example is not None:
            value = getattr(getattr(example, part.key), entry.name)
        unit = entry.unit_in(is_us=units.is_us)
        style.put_input(sheet.cell(row, 2), entry, value, unit)
        _write_block_row(sheet, row, part, entry, unit)
    style.make_plain_when_filled(sheet, f"B{top + 1}:C{top + len(rows)}")
    if is_first:
        for column, width in enumerate(BLOCK_WIDTHS, start=1):
            sheet.column_dimensions[get_column_letter(column)].width = width
        sheet.freeze_panes = f"B{top + 1}"
        sheet.print_title_rows = f"{top}:{top}"


def _write_block_row(
    sheet: Worksheet, row: int, section: SheetSection, entry: Entry, unit: Unit | None
) -> None:
    needed = entry.is_required
    style.put(sheet, row, 1, f"{entry.heading}{' *' if needed else ''}", bold=needed)
    # Bounds of quantities are 0 or open, so they are valid in any unit.
    texts = (_allowed(entry, unit), _example(entry, unit), entry.note)
    for column, text in enumerate(texts, start=5):
        style.put(sheet, row, column, text, color=style.GRAY, italic=column == 6)
    typed = str(sheet.cell(row, 2).value or "")
    lines = _lines((*texts, typed), (*BLOCK_WIDTHS[4:], _WIDER * BLOCK_WIDTHS[1]))
    sheet.row_dimensions[row].height = 4 + 13 * lines
    name_cell(section.cell_name(entry.name), sheet, row, 2)
    style.validate(sheet, f"B{row}", entry, 1.0)
    if section.key == "site" and entry.name in SITE_ANSWERS:
        formula, name = SITE_ANSWERS[entry.name]
        formula = formula.format(row=row, above=row - 2)
        style.put_answer(sheet.cell(row, 4), formula, SITE_FORMAT)
        name_cell(name, sheet, row, 4)
    if entry.quantity is None or unit is None:
        style.put(sheet, row, 3, str(entry.unit), color=style.GRAY)
        return
    sheet.cell(row, 3).value = unit.symbol
    style.style_input(sheet.cell(row, 3), str)
    name_cell(section.unit_name(entry.name), sheet, row, 3)
    style.offer(sheet, f"C{row}", entry.quantity.accepted, "Unit", "Unit of the value to the left.")


@dataclass(frozen=True, slots=True)
class GridColumn:
    """A column of a table to write: a field, or an answer."""

    name: str
    heading: str
    width: int
    entry: Entry | None = None
    answer: FormulaColumn | None = None

    @property
    def is_folded(self) -> bool:
        """Whether it is folded at the right."""
        is_rare = self.entry is not None and self.entry.is_rare
        return is_rare or (self.answer is not None and self.answer.is_rare)


def columns_of(section: SheetSection, units: UnitsFirst) -> list[GridColumn]:
    """Return the columns of a table: regular ones, answers, seldom-used ones."""
    fields = []
    for entry in section.entries:
        unit = entry.unit_in(is_us=units.is_us)
        symbol = unit.symbol if unit else str(entry.unit)
        heading = f"{entry.heading} [{symbol}]" if symbol else entry.heading
        fields.append(GridColumn(entry.name, heading, _width(entry), entry=entry))
    answers = [
        GridColumn(answer.name, answer.heading, answer.width, answer=answer)
        for answer in table_answers(section.key, is_us=units is UnitsFirst.US)
    ]
    return sorted((*fields, *answers), key=lambda c: (c.is_folded, bool(c.answer)))


def write_table(
    book: Workbook, section: SheetSection, units: UnitsFirst, rows: Sequence[Frozen]
) -> TablePlace:
    """Write a table, and return where its columns are; `write_answers` adds the formulas."""
    sheet = book[section.sheet]
    top, is_first = _put_section_title(sheet, section)
    header = top + len(HINT_ROWS)
    columns = columns_of(section, units)
    place = TablePlace(
        section=section,
        sheet=section.sheet,
        header=header,
        # A table grows in Excel as rows are typed below it: few blank ones will do.
        size=max(BLANK_ROWS if is_first else FEWER_ROWS, len(rows) + SPARE_ROWS),
        headings={column.name: column.heading for column in columns},
        letters={c.name: get_column_letter(k) for k, c in enumerate(columns, start=FIRST)},
    )
    if is_first:
        sheet.column_dimensions["A"].width = HINTS_WIDTH
    for number, column in enumerate(columns, start=FIRST):
        if is_first or number > len(BLOCK_WIDTHS):
            sheet.column_dimensions[get_column_letter(number)].width = column.width
    _write_hints(sheet, top, columns, units)
    lines = []
    for number, column in enumerate(columns, start=FIRST):
        _write_heading(sheet, header, number, column)
        if column.entry is not None:
            values = [_unless_default(getattr(row, column.name), column.entry) for row in rows]
            unit = column.entry.unit_in(is_us=units.is_us)
            lines.append(_write_column(sheet, place, number, column.entry, values, unit))
    for row, of_row in enumerate(zip(*lines, strict=True), start=header + 1):
        sheet.row_dimensions[row].height = 4 + 14 * min(max(of_row), DATA_LINES)
    _add_table(sheet, place)
    if is_first:
        _fold(sheet, columns, rows)
        sheet.freeze_panes = f"C{header + 1}"
        sheet.print_title_rows = f"{header}:{header}"
    return place


def _write_column(
    sheet: Worksheet,
    place: TablePlace,
    number: int,
    entry: Entry,
    values: Sequence[object],
    unit: Unit | None,
) -> list[int]:
    """Write the inputs of a column with their messages; return the lines of each."""
    width = max(int(sheet.column_dimensions[get_column_letter(number)].width), 1)
    if entry.name == "provision":
        values = [provision_name(str(value)) for value in values]
    lines = []
    for row in range(place.size):
        value = values[row] if row < len(values) else None
        cell = sheet.cell(place.header + 1 + row, number)
        style.put_input(cell, entry, value, unit)
        typed = "" if entry.choices else str(style.in_cell(value, unit) or "")
        lines.append(_lines([typed], [_WIDER * width]))
    if source := _SOURCES.get((place.section.key, entry.name)):
        style.suggest(sheet, place.cells(entry.name), source, entry.heading, entry.note)
    else:
        style.validate(sheet, place.cells(entry.name), entry, unit.si if unit else 1.0)
    style.make_plain_when_filled(sheet, place.cells(entry.name))
    return lines


def _fold(sheet: Worksheet, columns: Sequence[GridColumn], rows: Sequence[Frozen]) -> None:
    """Group the seldom-used columns; those without a value are collapsed."""
    folded = [(count, c) for count, c in enumerate(columns, start=FIRST) if c.is_folded]
    used = set()
    for _, column in folded:
        if column.entry:
            values = [getattr(row, column.name) for row in rows]
            if any(_unless_default(value, column.entry) not in (None, "") for value in values):
                used.add(column.name)
    for count, column in folded:
        dimension = sheet.column_dimensions[get_column_letter(count)]
        dimension.outlineLevel = 1
        dimension.hidden = column.name not in used
    # LibreOffice would close an open group that is said to be collapsed.
    if folded and not used:
        after = sheet.column_dimensions[get_column_letter(folded[-1][0] + 1)]
        after.collapsed = True


def _unless_default(value: object, entry: Entry) -> object:
    """Return a value, or None if a blank cell means the same."""
    return None if not entry.is_required and value == entry.default else value


def _write_hints(
    sheet: Worksheet, top: int, columns: Sequence[GridColumn], units: UnitsFirst
) -> None:
    for offset, name in enumerate(HINT_ROWS):
        style.put(sheet, top + offset, 1, name, color=style.GRAY, size=9)
    for number, column in enumerate(columns, start=FIRST):
        for row, text in enumerate(_hints(column, units), start=top):
            is_example = row == top + 2
            hint = style.put(sheet, row, number, text, color=style.GRAY, size=9, italic=is_example)
            hint.fill, hint.border = style.HINT_FILL, style.BOX
    unfolded = [place for place, column in enumerate(columns, start=FIRST) if not column.is_folded]
    widths = [int(sheet.column_dimensions[get_column_letter(place)].width) for place in unfolded]
    for row in range(top, top + len(HINT_ROWS)):
        texts = [str(sheet.cell(row, number).value) for number in unfolded]
        sheet.row_dimensions[row].height = 5 + 12.5 * _lines(texts, widths)


def _hints(column: GridColumn, units: UnitsFirst) -> tuple[str, str, str]:
    if column.entry is None:
        return "computed", column.answer.note if column.answer else "", ""
    unit = column.entry.unit_in(is_us=units.is_us)
    return column.entry.needed, _allowed(column.entry, unit), _example(column.entry, unit)


def _write_heading(sheet: Worksheet, row: int, number: int, column: GridColumn) -> None:
    color, fill = style.INK, style.ANSWER_HEAD_FILL
    if column.entry is not None:
        is_expected = column.entry.is_expected
        color, fill = style.WHITE, style.REQUIRED_FILL if is_expected else style.OPTIONAL_FILL
    cell = style.put(sheet, row, number, column.heading, bold=True, color=color)
    cell.fill, cell.border = fill, style.BOX
    height = 5 + 13 * _lines([column.heading], [column.width - 1])  # bold
    sheet.row_dimensions[row].height = max(sheet.row_dimensions[row].height or 44, height)


def _add_table(sheet: Worksheet, place: TablePlace) -> None:
    first, *_, last = place.letters.values()
    area = f"{first}{place.header}:{last}{place.header + place.size}"
    table = Table(displayName=place.section.table_name, ref=area)
    # Columns are named here: openpyxl would add filter buttons.
    table.tableColumns = [
        TableColumn(id=count, name=name)
        for count, name in enumerate(place.headings.values(), start=1)
    ]
    table.tableStyleInfo = TableStyleInfo(name="TableStyleLight1", showRowStripes=False)
    sheet.add_table(table)


def write_answers(book: Workbook, tables: Tables, place: TablePlace, *, is_us: bool) -> None:
    """Write the formulas of a table; in Excel new rows get them by themselves."""
    sheet = book[place.section.sheet]
    answers = {answer.name: answer for answer in table_answers(place.section.key, is_us=is_us)}
    columns = sheet.tables[place.section.table_name].tableColumns
    for count, name in enumerate(place.letters):
        if name not in answers:
            continue
        first = place.header + 1
        for row in range(first, first + place.size):
            formula = answers[name].written(tables, place.section.key, row)
            style.put_answer(sheet.cell(row, count + FIRST), formula, answers[name].number_format)
        # Its references to cells are those of the first row.
        formula = answers[name].written(tables, place.section.key, first)
        columns[count].calculatedColumnFormula = TableFormula(attr_text=formula)


def _allowed(entry: Entry, unit: Unit | None) -> str:
    if entry.choices:
        return " / ".join(entry.choices)
    if entry.kind in (int, float):
        si = unit.si if unit else 1.0
        words = (entry.bounds.words(si) or "any number") + entry.or_zero
        if entry.usual is None:
            return words
        usual = (entry.expected.low, entry.expected.high)
        low, high = (float(f"{bound / si:.3g}") for bound in usual)
        return f"{words}; typical {low:g} to {high:g}"
    return "a date" if entry.kind is date else "text"


def _example(entry: Entry, unit: Unit | None) -> str:
    value = entry.example
    if unit is not None and entry.quantity is not None and isinstance(value, float):
        # 42000 lb keeps all digits; 186.825 kN becomes 187.
        digits = 5 if unit == entry.quantity.us else 3
        rounded = f"{value * entry.quantity.us.si / unit.si:.{digits}g}"
        return f"{float(rounded):g}"  # 1020, not 1.02e+03
    return f"{value:g}" if isinstance(value, float) else str(value)


def _width(entry: Entry) -> int:
    longest = max(map(len, entry.heading.split())) + 3
    if entry.choices:
        widest = max(map(len, entry.choices)) + 2
        # Many long choices are listed above the heading in a few lines.
        return max(CODE_WIDTH, longest, widest + (MANY_WIDTH if len(entry.choices) > MANY else 0))
    if entry.kind is str and entry.max_length > 40:
        return TEXT_WIDTH
    return max(CODE_WIDTH if entry.kind is date else NUMBER_WIDTH, longest)


def _lines(texts: Sequence[str], widths: Sequence[float]) -> int:
    """Return the number of lines of the tallest text at its column's width."""
    # Broken between words, in a type wider than Calibri: a width is counted in digits.
    broken = map(textwrap.wrap, texts, (max(int(width) - 1, 1) for width in widths))
    return max(1, *map(len, broken))
