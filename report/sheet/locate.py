"""Finds the inputs of a workbook by defined name, table name and heading.

Never uses positions or styles, which users change. `cells` converts the content of the cells.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

from openpyxl import Workbook
from openpyxl.utils import get_column_letter, range_boundaries
from openpyxl.worksheet.worksheet import Worksheet

from report.sheet import formerly
from report.sheet.answers import ANSWER_HEADINGS, STATUS_HEADING
from report.sheet.archive import OpenBook
from report.sheet.cells import Found
from report.sheet.fields import Entry, Section, entries
from solver.model import InputError

MAX_ROWS = 2000
MAX_COLUMNS = 200
SCANNED_ROWS = 200
_HEADING = re.compile(r"(.*?)\s*(?:\[([^\[\]]*)\])?")
_AREA = re.compile(r"(?:'((?:[^']|'')+)'|([^'!]+))!(\$?[A-Z]+\$?[0-9]+(?::\$?[A-Z]+\$?[0-9]+)?)")
FRESH = "copy it from a fresh workbook (roofslip new)"


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


@dataclass(frozen=True, slots=True, kw_only=True)
class FieldColumn:
    """A column of a table: its number, and the unit in its heading."""

    number: int
    unit: str
    si: float


@dataclass(frozen=True, slots=True, kw_only=True)
class TableFound:
    """A table of inputs.

    Attributes
    ----------
    heading : CellPosition
        Its first heading.
    columns : mapping of field to FieldColumn
        Of the headings that are present and readable.
    rows : range
        Rows that may contain inputs.
    others : tuple of CellPosition
        Headings that belong to no field.
    absent : tuple of str
        Optional fields without a column, as in workbooks of earlier versions or after a column was
        deleted.
    problems : tuple of str
        Finished lines about headings and merged cells.
    """

    heading: CellPosition
    columns: Mapping[str, FieldColumn]
    rows: Sequence[int]
    others: tuple[CellPosition, ...]
    absent: tuple[str, ...]
    problems: tuple[str, ...]


def found_at(book: OpenBook, position: CellPosition) -> Found:
    """Return the content of a cell, as typed and as computed."""
    cell = book.book[position.sheet].cell(position.row, position.column)
    return Found(
        sheet=position.sheet,
        cell=position.cell,
        value=cell.value,
        formula=book.formula(position.sheet, position.cell),
        is_error=cell.data_type == "e",
        number_format=str(cell.number_format),
    )


def find_cell(book: OpenBook, section: Section, entry: Entry) -> CellPosition:
    """Return the cell of a single field, by its defined name, or else beside its label.

    Raises
    ------
    InputError
    """
    position = _field_named(book, section, entry) or _beside_label(book, section, entry)
    if position is None:
        raise InputError(
            f"{section.sheet}: {entry.spoken} is missing (no name {section.cell_name(entry.name)}"
            f" and no label '{entry.cell.label}'); {FRESH}"
        )
    return position


def added_later(book: OpenBook, section: Section) -> tuple[Entry, ...]:
    """Return the fields that a block lacks because its workbook is of 0.1, which had none of them.

    A workbook that has some of them has lost the others.
    """
    fields = tuple(
        entry for entry in entries(section.model) if (section.key, entry.name) in formerly.ADDED
    )
    has_any = any(
        _field_named(book, section, entry) or _beside_label(book, section, entry)
        for entry in fields
    )
    return () if has_any else fields


def find_unit_cell(
    book: OpenBook, section: Section, entry: Entry, value: CellPosition
) -> CellPosition:
    """Return the cell that holds the unit of a single field, by name, or else next to the value."""
    names = _fields(section, entry)
    spots = (_named(book, section.unit_name(name)) for name in names)
    position = next((spot for spot in spots if spot is not None), None)
    return position or CellPosition(value.sheet, value.row, value.column + 1)


def is_absent(book: OpenBook, section: Section) -> bool:
    """Whether a workbook has neither names nor labels of a section."""
    if section.is_table:
        return sheet_titled(book, section.sheet) is None and _table_named(book, section) is None
    return not any(
        _field_named(book, section, entry) or _beside_label(book, section, entry)
        for entry in entries(section.model)
    )


def _sheets(book: OpenBook) -> list[Worksheet]:
    return list(book.book.worksheets)


def sheet_titled(book: OpenBook, title: str) -> Worksheet | None:
    """Return the sheet with a title, ignoring case."""
    wanted = title.strip().casefold()
    return next((s for s in _sheets(book) if s.title.strip().casefold() == wanted), None)


def _fields(section: Section, entry: Entry) -> tuple[str, ...]:
    """Return the name of a field and its earlier names."""
    return entry.name, *formerly.FIELDS.get((section.key, entry.name), ())


def _field_named(book: OpenBook, section: Section, entry: Entry) -> CellPosition | None:
    spots = (_named(book, section.cell_name(name)) for name in _fields(section, entry))
    return next((spot for spot in spots if spot is not None), None)


def _named(book: OpenBook, name: str) -> CellPosition | None:
    title, (left, top, right, bottom) = area_named(book.book, name) or ("", (0, 0, 0, 0))
    is_cell = title and (left, top) == (right, bottom)
    return CellPosition(title, top, left) if is_cell else None


# Of a sheet of Excel.
_LAST_COLUMN, _LAST_ROW = 16_384, 1_048_576


def _bounds(reference: str | None) -> tuple[int, int, int, int] | None:
    """Return left, top, right, bottom of a range; None unless it states all four."""
    try:
        left, top, right, bottom = range_boundaries((reference or "").replace("$", ""))
    except (ValueError, TypeError):
        return None
    # A:C has no rows, and a damaged file may say A0.
    if not (left and top and right and bottom):
        return None
    is_on_sheet = max(left, right) <= _LAST_COLUMN and max(top, bottom) <= _LAST_ROW
    return (left, top, right, bottom) if is_on_sheet else None


def _beside_label(book: OpenBook, section: Section, entry: Entry) -> CellPosition | None:
    sheet = sheet_titled(book, section.sheet)
    if sheet is None:
        return None
    wanted = labels_of(section, entry)
    for position in _scanned(book, sheet):
        if label_key(sheet.cell(position.row, position.column).value) in wanted:
            return CellPosition(position.sheet, position.row, position.column + 1)
    return None


def _scanned(book: OpenBook, sheet: Worksheet) -> Iterator[CellPosition]:
    extent = book.extent(sheet.title)
    for row in range(1, min(extent.last_row, SCANNED_ROWS) + 1):
        for column in range(1, min(extent.last_column, MAX_COLUMNS) + 1):
            yield CellPosition(sheet.title, row, column)


def label_key(text: object) -> str:
    """Return a label in the form that is compared: no unit, asterisk, case or extra spaces."""
    return " ".join(_split(text)[0].replace("*", " ").split()).casefold()


def _split(text: object) -> tuple[str, str]:
    """Return a heading's label and the unit in its brackets."""
    match = _HEADING.fullmatch(" ".join(str(text or "").split()))
    return (match[1], (match[2] or "").strip()) if match else (str(text), "")


def find_table(book: OpenBook, section: Section) -> TableFound:
    """Return a table of inputs, by its name, or else by a row of its headings.

    Raises
    ------
    InputError
        If there is neither, or the sheet has data too far away.
    """
    sheet, left, top, right, below = _table_named(book, section) or _headings(book, section)
    _check_reach(book, sheet, top)
    last_column = _last_heading(sheet, top, right)
    positions = [CellPosition(sheet.title, top, column) for column in range(left, last_column + 1)]
    headings = [p for p in positions if not _is_answer(section, sheet.cell(top, p.column).value)]
    columns, others, seen, problems = _columns(book, section, headings)
    absent, missing = _unseen(book, section, headings, seen, others)
    problems += missing
    used = [column.number for column in columns.values()]
    last_row = min(book.extent(sheet.title).last_row, _next_table(sheet, top, used) - 1)
    problems += _merged(sheet, top, last_row, used)
    return TableFound(
        heading=headings[0],
        columns=columns,
        rows=[row for row in range(top + 1, last_row + 1) if row not in below],
        others=tuple(others),
        absent=absent,
        problems=tuple(problems),
    )


def _is_answer(section: Section, heading: object) -> bool:
    """Whether a heading is that of a column of formulas, which is not read."""
    return label_key(heading) in ANSWER_HEADINGS.get(section.key, {STATUS_HEADING.casefold()})


_Place = tuple[Worksheet, int, int, int, range]


def _table_named(book: OpenBook, section: Section) -> _Place | None:
    """Return sheet, left, heading row, right and rows of totals of a section's table."""
    for sheet in _sheets(book):
        for table in sheet.tables.values():
            names = {str(table.displayName).casefold(), str(table.name).casefold()}
            bounds = _bounds(table.ref)
            has_headings = table.headerRowCount != 0 and bounds and bounds[2] <= MAX_COLUMNS
            if section.table_name in names and bounds and has_headings:
                left, top, right, bottom = bounds
                totals = table.totalsRowCount or 0
                return sheet, left, top, right, range(bottom - totals + 1, bottom + 1)
    return None


def _headings(book: OpenBook, section: Section) -> _Place:
    """Return the row with the most headings of a section; its own sheet is searched first."""
    own = sheet_titled(book, section.sheet)
    fields = entries(section.model)
    wanted = set[str]().union(*(labels_of(section, entry) for entry in fields))
    for sheet in [own] if own else _sheets(book):
        rows: dict[int, list[int]] = {}
        for position in _scanned(book, sheet):
            if label_key(sheet.cell(position.row, position.column).value) in wanted:
                rows.setdefault(position.row, []).append(position.column)
        best = max(rows, key=lambda row: len(rows[row]), default=0)
        if best and len(rows[best]) > len(fields) / 2:
            return sheet, min(rows[best]), best, max(rows[best]), range(0)
    what = f"no table {section.table_name} and no row of its headings"
    missing = "" if own else "the sheet is missing: "
    raise InputError(f"{section.sheet}: {missing}{what}; {FRESH}")


def _check_reach(book: OpenBook, sheet: Worksheet, top: int) -> None:
    extent, far = book.extent(sheet.title), []
    if extent.last_row > top + MAX_ROWS:
        far.append((extent.row_cell, f"more than {MAX_ROWS} rows below the headings"))
    if extent.last_column > MAX_COLUMNS:
        far.append((extent.column_cell, f"beyond column {get_column_letter(MAX_COLUMNS)}"))
    if far:
        raise InputError(
            [f"{sheet.title}!{cell}: contains data {where}; clear it" for cell, where in far]
        )


def _last_heading(sheet: Worksheet, top: int, right: int) -> int:
    """Return the last column that has a heading, or is within the table."""
    while right < MAX_COLUMNS and sheet.cell(top, right + 1).value is not None:
        right += 1
    return right


def _columns(
    book: OpenBook, section: Section, headings: Sequence[CellPosition]
) -> tuple[dict[str, FieldColumn], list[CellPosition], set[str], list[str]]:
    fields = {
        label: entry for entry in entries(section.model) for label in labels_of(section, entry)
    }
    columns: dict[str, FieldColumn] = {}
    others: list[CellPosition] = []
    problems: list[str] = []
    seen: set[str] = set()
    for position in headings:
        text = found_at(book, position).value
        entry = fields.get(label_key(text))
        if entry is None:
            others += [position] if text is not None else []
        elif entry.name in seen:
            problems.append(
                f"{position.address}: heading '{entry.cell.label}' appears twice; keep one"
            )
        else:
            seen.add(entry.name)
            try:
                columns[entry.name] = _column(position, entry, _split(text)[1])
            except InputError as error:
                problems += error.problems
    return columns, others, seen, problems


def _unseen(
    book: OpenBook,
    section: Section,
    headings: Sequence[CellPosition],
    seen: set[str],
    others: Sequence[CellPosition],
) -> tuple[tuple[str, ...], list[str]]:
    """Return optional fields that have no column, and a problem for each other missing field.

    If a table has an unknown heading, no field counts as absent: the heading may be a renamed one.
    """
    fields = entries(section.model)
    places = _heading_places(book, section, headings)
    absent = [e.name for e in fields if e.name not in seen and not e.is_expected and not others]
    problems = []
    for entry in fields:
        if entry.name not in seen and entry.name not in absent:
            position = places[entry.name]
            text = found_at(book, position).value
            instead = f", '{text}' found" if position in others else ""
            missing = f"{position.address}: heading '{entry.cell.label}' is missing{instead};"
            problems.append(f"{missing} write it here in its own column, or {FRESH}")
    return tuple(absent), problems


def _heading_places(
    book: OpenBook, section: Section, headings: Sequence[CellPosition]
) -> Mapping[str, CellPosition]:
    """Return where each heading is, or where it belongs: after that of the field before it."""
    fields = entries(section.model)
    labels = {label: entry.name for entry in fields for label in labels_of(section, entry)}
    places = {
        labels[key]: position
        for position in headings
        if (key := label_key(found_at(book, position).value)) in labels
    }
    first = headings[0]
    following = first
    for entry in fields:
        position = places.setdefault(entry.name, following)
        following = CellPosition(first.sheet, first.row, position.column + 1)
    return places


def _column(position: CellPosition, entry: Entry, unit: str) -> FieldColumn:
    try:
        symbol, si = unit_size(entry, unit)
    except InputError as error:
        raise InputError(f"{position.address}: {error.problems[0]}") from error
    return FieldColumn(number=position.column, unit=symbol, si=si)


def unit_size(entry: Entry, unit: str) -> tuple[str, float]:
    """Return a unit's symbol and its size in SI, as accepted by a field.

    Raises
    ------
    InputError
    """
    fixed = "" if entry.quantity else str(entry.cell.unit)
    accepted = entry.quantity.accepted if entry.quantity else {fixed: 1.0}
    if not entry.quantity and not unit:
        return fixed, 1.0
    for symbol, si in accepted.items():
        if symbol.casefold() == unit.casefold():
            return symbol, si
    problem = f"is '{unit}'" if unit else "is missing"
    wanted = ", ".join(symbol for symbol in accepted if symbol) or "none"
    raise InputError(f"unit of {entry.spoken} {problem}; write one of {wanted}")


def _next_table(sheet: Worksheet, top: int, columns: Sequence[int]) -> int:
    """Return the first row of the next table below, or the row after the last one."""
    starts = [sheet.max_row + 1]
    for table in sheet.tables.values():
        bounds = _bounds(table.ref)
        if bounds and bounds[1] > top and any(bounds[0] <= c <= bounds[2] for c in columns):
            starts.append(bounds[1])
    return min(starts)


def _merged(sheet: Worksheet, top: int, last_row: int, columns: Sequence[int]) -> list[str]:
    problems = []
    for area in sorted(sheet.merged_cells.ranges, key=str):
        reaches = any(area.min_col <= column <= area.max_col for column in columns)
        if reaches and area.min_row <= last_row and area.max_row >= top:
            problems.append(f"{sheet.title}!{area.coord}: cells are merged; unmerge them")
    return problems


@dataclass(frozen=True, slots=True, kw_only=True)
class TableArea:
    """A named table with all of its headings, those of formulas included.

    Attributes
    ----------
    sheet : str
    header, last, totals : int
        Row of the headings, last row above its totals, and row of the totals; 0 without one.
    headings : mapping of str to CellPosition
        By label: without unit, asterisk, case or extra spaces.
    """

    sheet: str
    header: int
    last: int
    totals: int
    headings: Mapping[str, CellPosition]


def table_area(book: OpenBook, section: Section) -> TableArea | None:
    """Return the table of a section, found by its name; None without one."""
    found = _table_named(book, section)
    if found is None:
        return None
    sheet, left, top, right, totals = found
    places = [CellPosition(sheet.title, top, column) for column in range(left, right + 1)]
    return TableArea(
        sheet=sheet.title,
        header=top,
        last=totals.start - 1,
        totals=totals.start if totals else 0,
        headings={label_key(sheet.cell(top, place.column).value): place for place in places},
    )


def area_named(book: Workbook, name: str) -> tuple[str, tuple[int, int, int, int]] | None:
    """Return the sheet of a named range, and its left, top, right, bottom; None without one."""
    for defined in book.defined_names.values():
        if str(defined.name).casefold() != name:
            continue
        match = _AREA.fullmatch(str(defined.attr_text))
        if not match:
            continue
        bounds = _bounds(match[3])
        title = match[2] or match[1].replace("''", "'")
        if bounds and title in book.sheetnames:
            return title, bounds
    return None


def labels_of(section: Section, entry: Entry) -> set[str]:
    """Return the label of a field and its earlier labels, in the form that is compared."""
    earlier = formerly.LABELS.get((section.key, entry.name), ())
    return {label_key(label) for label in (entry.cell.label, *earlier)}


def cells_below(book: OpenBook, heading: CellPosition) -> list[Found]:
    """Return the content of the cells below a heading, down to the last row of the sheet."""
    last = book.extent(heading.sheet).last_row
    return [
        found_at(book, CellPosition(heading.sheet, row, heading.column))
        for row in range(heading.row + 1, last + 1)
    ]
