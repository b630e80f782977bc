"""Cells of a workbook by position, with their labels and names.

Knows no input; `locate` finds them with it.
"""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from itertools import product

from openpyxl import Workbook
from openpyxl.cell.cell import MergedCell
from openpyxl.utils import get_column_letter, range_boundaries
from openpyxl.worksheet.worksheet import Worksheet

from report.project.read.archive import OpenBook
from report.project.read.cells import Found
from report.project.read.scan import LAST_COLUMN, LAST_ROW
from report.project.workbook.entries import Entry, SheetSection
from report.text.typed_letters import visible
from solver.errors import InputError, Problem

MAX_COLUMNS = 200
SCANNED_ROWS = 200
FRESH = "copy it from a new workbook (roofslip new FOLDER)"
_HEADING = re.compile(r"(.*?) ?(?:\[([^\[\]]*)\])?")
# Excel doubles an apostrophe in the title of a sheet, and quotes a title with blanks.
_AREA = re.compile(r"(?:'((?:[^']|'')+)'|([^'!]+))!(\$?[A-Z]+\$?[0-9]+(?::\$?[A-Z]+\$?[0-9]+)?)")


@dataclass(frozen=True, slots=True)
class CellPosition:
    """A cell by its position."""

    sheet: str
    row: int
    column: int

    @property
    def cell(self) -> str:
        """Its coordinate: `D7`."""
        return f"{get_column_letter(self.column)}{self.row}"

    @property
    def address(self) -> str:
        """Its address: `Arrays!D7`."""
        return f"{self.sheet}!{self.cell}"


def found_at(book: OpenBook, position: CellPosition) -> Found:
    """Return the content of a cell, as typed and as computed."""
    cell = book.sheets[position.sheet].cell(position.row, position.column)
    # openpyxl reads the empty text of =IF(B1="","",B1) as no value, like a formula never computed.
    computed = book.scans[position.sheet].computed
    is_empty = cell.value is None and (position.row, position.column) in computed
    return Found(
        sheet=position.sheet,
        cell=position.cell,
        value="" if is_empty else cell.value,
        formula=book.formula(position.sheet, position.cell),
        is_error=cell.data_type == "e",
        number_format=str(cell.number_format),
        day_zero=book.book.epoch,
    )


def check_uncovered(book: OpenBook, *positions: CellPosition) -> None:
    """Raise InputError for cells covered by merged ones: entries there are lost."""
    problems = []
    for position in positions:
        sheet = book.book[position.sheet]
        if isinstance(sheet.cell(position.row, position.column), MergedCell):
            areas = (area.coord for area in sheet.merged_cells.ranges if position.cell in area)
            problems.append(merged(position.sheet, next(areas, position.cell)))
    if problems:
        raise InputError(list(dict.fromkeys(problems)))


def merged(title: str, area: str) -> Problem:
    """Return the error for merged cells."""
    return Problem(f"{title}!{area}: cells are merged", "unmerge them")


def cells_below(book: OpenBook, heading: CellPosition) -> list[Found]:
    """Return the content of the cells below a heading, down to the last row of the sheet."""
    last = book.extent(heading.sheet).last_row
    return [
        found_at(book, CellPosition(heading.sheet, row, heading.column))
        for row in range(heading.row + 1, last + 1)
    ]


def sheets_titled(book: OpenBook, title: str) -> list[Worksheet]:
    """Return the sheet with a title, ignoring case; else those that Numbers made of its tables."""
    key = title.strip().casefold()
    titles = {sheet.title.strip().casefold(): sheet for sheet in book.book.worksheets}
    if key in titles:
        return [titles[key]]
    # Such as `Arrays - Table 1`: without names and tables of Excel, but with the headings.
    return [sheet for name, sheet in titles.items() if key in re.split(" [-–] ", name)]


def labels(book: OpenBook, sheet: Worksheet) -> Sequence[tuple[CellPosition, str]]:
    """Return each cell that may be a label or heading, row by row, with `label_key` of its text."""
    # Each section looks through the sheets that it may be on.
    if sheet.title not in book.labels:
        extent = book.extent(sheet.title)
        # Records that are pasted into a sheet make it long: labels are above them.
        rows = range(1, min(extent.last_row, SCANNED_ROWS) + 1)
        columns = range(1, min(extent.last_column, MAX_COLUMNS) + 1)
        labeled: list[tuple[CellPosition, str]] = []
        for row, column in product(rows, columns):
            value = sheet.cell(row, column).value
            if value is not None:
                labeled.append((CellPosition(sheet.title, row, column), label_key(value)))
        book.labels[sheet.title] = labeled
    return book.labels[sheet.title]


def area_named(book: Workbook, name: str) -> tuple[str, tuple[int, int, int, int]] | None:
    """Return the sheet of a named range, and its left, top, right, bottom; None without one."""
    # Names have no case in Excel.
    for defined in book.defined_names.values():
        if str(defined.name).casefold() != name:
            continue
        match = _AREA.fullmatch(str(defined.attr_text))
        if not match:
            continue
        bounds = bounds_of(match[3])
        title = match[2] or match[1].replace("''", "'")
        if bounds and title in book.sheetnames:
            return title, bounds
    return None


def bounds_of(reference: str | None) -> tuple[int, int, int, int] | None:
    """Return left, top, right, bottom of a range; None unless it states all four."""
    try:
        left, top, right, bottom = range_boundaries((reference or "").replace("$", ""))
    except (ValueError, TypeError):
        return None
    # A:C has no rows, and a damaged file may say A0.
    if not (left and top and right and bottom):
        return None
    is_on_sheet = max(left, right) <= LAST_COLUMN and max(top, bottom) <= LAST_ROW
    return (left, top, right, bottom) if is_on_sheet else None


def label_key(text: object) -> str:
    """Return a label in the form for comparison: no unit, asterisk, case or extra spaces."""
    # The template marks a required label with an asterisk.
    return " ".join(heading_parts(text)[0].replace("*", " ").split()).casefold()


def heading_parts(text: object) -> tuple[str, str]:
    """Return a heading's label and the unit in its brackets."""
    match = _HEADING.fullmatch(" ".join(visible(str(text or "")).split()))
    return (match[1], (match[2] or "").strip()) if match else (str(text), "")


def labels_of(entry: Entry) -> set[str]:
    """Return the label of a field and its earlier label, in the form for comparison."""
    return {label_key(label) for label in (entry.heading, entry.former) if label}


@cache
def fields_by_label(section: SheetSection) -> Mapping[str, Entry]:
    """Return the fields of a section by each of their labels, in the form for comparison."""
    fields: dict[str, Entry] = {}
    for entry in section.entries:
        fields |= dict.fromkeys(labels_of(entry), entry)
    return fields


def unit_size(entry: Entry, unit: str, where: str = "") -> tuple[str, float]:
    """Return a unit's symbol and its size in SI; raise InputError if a field does not accept it."""
    fixed = "" if entry.quantity else str(entry.unit)
    accepted = entry.quantity.accepted if entry.quantity else {fixed: 1.0}
    if not entry.quantity and not unit:
        return fixed, 1.0
    for symbol, si in accepted.items():
        if symbol.casefold() == unit.casefold():
            return symbol, si
    problem = f"is '{unit}'" if unit else "is missing"
    first, *more_units = accepted
    remedy = (
        f"enter the number in {first}, and write {first}" if first else "it has no unit: delete it"
    )
    if more_units:
        remedy = f"write one of {', '.join(accepted)}"
    raise InputError(Problem(f"unit of {entry.spoken} {problem}", remedy, where))
