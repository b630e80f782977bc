"""Finds the inputs of a workbook by name, wherever a user has moved them.

A table by its headings and their units, a single input by its defined name or its label.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence, Set
from dataclasses import dataclass, replace

from openpyxl.utils import get_column_letter
from openpyxl.worksheet.worksheet import Worksheet

from report.project.read.archive import OpenBook
from report.project.read.positions import (
    FRESH,
    MAX_COLUMNS,
    CellPosition,
    area_named,
    bounds_of,
    check_uncovered,
    fields_by_label,
    found_at,
    heading_parts,
    label_key,
    labels,
    labels_of,
    merged,
    sheets_titled,
    unit_size,
)
from report.project.workbook import SECTIONS
from report.project.workbook.answer_columns import ANSWER_HEADINGS
from report.project.workbook.earlier_workbooks import GONE, GoneInput
from report.project.workbook.entries import Entry, SheetSection
from solver.errors import InputError, Problem

MAX_ROWS = 2000

_Place = tuple[Worksheet, int, int, int, range]


@dataclass(frozen=True, slots=True, kw_only=True)
class FieldColumn:
    """A column of a table, and the unit in its heading."""

    number: int
    unit: str
    si: float
    heading: CellPosition  # the cell that states the unit


@dataclass(frozen=True, slots=True, kw_only=True)
class TableFound:
    """A table of inputs."""

    heading: CellPosition  # its first one
    columns: Mapping[str, FieldColumn]  # by field, of headings that are present and readable
    rows: Sequence[int]  # those that may contain inputs
    others: tuple[CellPosition, ...]  # headings that belong to no field
    gone: tuple[tuple[GoneInput, CellPosition], ...]  # headings of inputs that are no more
    absent: tuple[str, ...]  # optional fields without a column, as in earlier workbooks
    problems: tuple[Problem, ...]  # of headings and merged cells


def find_table(book: OpenBook, section: SheetSection) -> TableFound:
    """Return a table of inputs, by its name, or else by a row of its headings.

    Raises `InputError` if there is neither, or the sheet has data too far away.
    """
    sheet, left, top, right, below = table_named(book, section) or _headings(book, section)
    _check_reach(book, sheet, top)
    # Headings may go on beyond the table.
    while right < MAX_COLUMNS and sheet.cell(top, right + 1).value is not None:
        right += 1
    positions = [CellPosition(sheet.title, top, column) for column in range(left, right + 1)]
    # Formulas are not read.
    answers = ANSWER_HEADINGS.get(section.key, frozenset())
    gone = []
    for old_input in GONE.get(section.key, ()):
        for position in positions:
            if label_key(found_at(book, position).value) == label_key(old_input.label):
                gone.append((old_input, position))
    passed = {position for _, position in gone}
    headings = [
        p
        for p in positions
        if p not in passed and label_key(sheet.cell(top, p.column).value) not in answers
    ]
    columns, further, absent, problems = _columns(book, section, headings)
    used = [column.number for column in columns.values()]
    # Tables may lie below each other on one sheet.
    # To the last value of the sheet, not of the table: rows that were typed or pasted below it
    # would be lost without a word.
    last_row = min(book.extent(sheet.title).last_row, _next_table(sheet, top, used) - 1)
    problems += _merged(sheet, top, last_row, used)
    return TableFound(
        heading=headings[0],
        columns=columns,
        rows=[row for row in range(top + 1, last_row + 1) if row not in below],
        others=tuple(further),
        gone=tuple(gone),
        absent=tuple(absent),
        problems=tuple(problems),
    )


def table_named(book: OpenBook, section: SheetSection) -> _Place | None:
    """Return sheet, left, heading row, right and rows of totals of a section's table."""
    for sheet in book.book.worksheets:
        for table in sheet.tables.values():
            names = {str(table.displayName).casefold(), str(table.name).casefold()}
            bounds = bounds_of(table.ref)
            # Excel has tables without a row of headings.
            has_headings = table.headerRowCount != 0 and bounds and bounds[2] <= MAX_COLUMNS
            if section.table_name in names and bounds and has_headings:
                left, top, right, bottom = bounds
                totals = table.totalsRowCount or 0
                return sheet, left, top, right, range(bottom - totals + 1, bottom + 1)
    return None


def _headings(book: OpenBook, section: SheetSection) -> _Place:
    """Return the row with the most headings of a section; its own sheet is searched first."""
    sheets = sheets_titled(book, section.sheet)
    renamed = _sheet_renamed(book, section)
    for sheet in sheets or ([renamed] if renamed else book.book.worksheets):
        row, columns = _heading_row(book, section, sheet)
        # A row of another table has some headings in common, and not most of them.
        if len(columns) > len(section.entries) / 2:
            return sheet, min(columns), row, max(columns), range(0)
    lack = f"no table {section.table_name} and no row of its headings"
    missing = "" if sheets else "the worksheet is missing: "
    raise InputError(f"{section.sheet}: {missing}{lack}; {FRESH}")


def _heading_row(book: OpenBook, section: SheetSection, sheet: Worksheet) -> tuple[int, list[int]]:
    """Return the row of a sheet with the most headings of a section, and their columns."""
    # Sections have headings in common, and one without a table must not read that of another.
    names = {str(table.name).casefold(): table.ref for table in sheet.tables.values()}
    further = [
        ref for name, ref in names.items() if name.endswith("_table") and name != section.table_name
    ]
    taken = {bounds[1] for ref in further if (bounds := bounds_of(ref))}
    fields = fields_by_label(section)
    rows: dict[int, list[int]] = {0: []}
    for position, label in labels(book, sheet):
        if position.row not in taken and label in fields:
            rows.setdefault(position.row, []).append(position.column)
    best = max(rows, key=lambda row: len(rows[row]))
    return best, rows[best]


def _sheet_renamed(book: OpenBook, section: SheetSection) -> Worksheet | None:
    """Return the sheet with the title of no section that has all headings of one."""
    titles = {section_read.sheet.casefold() for section_read in SECTIONS}
    for sheet in book.book.worksheets:
        is_titled = sheet.title.strip().casefold() in titles
        if not is_titled and len(_heading_row(book, section, sheet)[1]) >= len(section.entries):
            return sheet
    return None


def is_table_absent(book: OpenBook, section: SheetSection) -> bool:
    """Whether a workbook has neither the sheet of a table, nor the table, nor its headings."""
    if sheets_titled(book, section.sheet) or table_area(book, section):
        return False
    return _sheet_renamed(book, section) is None


def _check_reach(book: OpenBook, sheet: Worksheet, top: int) -> None:
    extent, far = book.extent(sheet.title), []
    # Every row down to a stray cell would be read.
    if extent.last_row > top + MAX_ROWS:
        far.append((extent.row_cell, f"more than {MAX_ROWS} rows below the headings"))
    if extent.last_column > MAX_COLUMNS:
        far.append((extent.column_cell, f"beyond column {get_column_letter(MAX_COLUMNS)}"))
    if far:
        stray = [(f"contains data {where}", f"{sheet.title}!{cell}") for cell, where in far]
        raise InputError([Problem(text, "clear it", address) for text, address in stray])


def _columns(
    book: OpenBook, section: SheetSection, headings: Sequence[CellPosition]
) -> tuple[dict[str, FieldColumn], list[CellPosition], list[str], list[Problem]]:
    """Return the columns of fields, other headings, fields without a column, and problems."""
    fields = fields_by_label(section)
    places: dict[str, CellPosition] = {}
    columns: dict[str, FieldColumn] = {}
    further: list[CellPosition] = []
    problems: list[Problem] = []
    for position in headings:
        text = found_at(book, position).value
        entry = fields.get(label_key(text))
        if entry is None:
            further += [position] if text is not None else []
        elif entry.name in places:
            twice = f"heading '{entry.heading}' appears twice, also in {places[entry.name].cell}"
            problems.append(Problem(twice, "keep one", position.address))
        else:
            places[entry.name] = position
            try:
                unit, si = unit_size(entry, heading_parts(text)[1], position.address)
            except InputError as error:
                problems += error.parts
                continue
            columns[entry.name] = FieldColumn(
                number=position.column, unit=unit, si=si, heading=position
            )
    absent: list[str] = []
    following = headings[0]  # where a missing one belongs: after that of the field before it
    for entry in section.entries:
        if entry.name not in places and not entry.is_expected and not further:
            absent.append(entry.name)
        elif entry.name not in places:
            # With an unknown heading no field counts as absent: the heading may be a renamed one.
            instead = f", '{found_at(book, following).value}' found" if following in further else ""
            missing = f"heading '{entry.heading}' is missing{instead}"
            remedy = f"write it here in its own column, or {FRESH}"
            problems.append(Problem(missing, remedy, following.address))
        following = replace(following, column=places.get(entry.name, following).column + 1)
    return columns, further, absent, problems


def _next_table(sheet: Worksheet, top: int, columns: Sequence[int]) -> int:
    """Return the first row of the next table below, or the row after the last one."""
    starts = [sheet.max_row + 1]
    for table in sheet.tables.values():
        bounds = bounds_of(table.ref)
        if bounds and bounds[1] > top and any(bounds[0] <= c <= bounds[2] for c in columns):
            starts.append(bounds[1])
    return min(starts)


def _merged(sheet: Worksheet, top: int, last_row: int, columns: Sequence[int]) -> list[Problem]:
    # Sorted: they are a set, whose order is another one in each process.
    return [
        merged(sheet.title, area.coord)
        for area in sorted(sheet.merged_cells.ranges, key=str)
        if any(area.min_col <= column <= area.max_col for column in columns)
        if area.min_row <= last_row and area.max_row >= top
    ]


@dataclass(frozen=True, slots=True, kw_only=True)
class TableArea:
    """A named table with all of its headings, those of formulas included."""

    sheet: str
    header: int
    last: int  # row above its totals
    totals: int  # 0 without them
    headings: Mapping[str, CellPosition]  # by `label_key`


def table_area(book: OpenBook, section: SheetSection) -> TableArea | None:
    """Return the table of a section, found by its name; None without one."""
    area = table_named(book, section)
    if area is None:
        return None
    sheet, left, top, right, totals = area
    places = [CellPosition(sheet.title, top, column) for column in range(left, right + 1)]
    return TableArea(
        sheet=sheet.title,
        header=top,
        last=totals.start - 1,
        totals=totals.start if totals else 0,
        headings={label_key(sheet.cell(top, place.column).value): place for place in places},
    )


def find_cell(book: OpenBook, section: SheetSection, entry: Entry) -> CellPosition:
    """Return the cell of a single field by name, or else next to its label, or raise InputError."""
    position = _position(book, section, entry)
    if position is None:
        raise InputError(
            f"{section.sheet_of(entry.name)}: {entry.spoken} is missing"
            f" (no name {section.cell_name(entry.name)} and no label '{entry.heading}'); {FRESH}"
        )
    return position


def beside(book: OpenBook, section: SheetSection) -> Mapping[str, list[CellPosition]]:
    """Return the cells with content next to the labels of each field on the sheets of a block."""
    fields = fields_by_label(section)
    by_field: dict[str, list[CellPosition]] = {}
    for position, label in _labels(book, section):
        if label in fields:
            value_cell = replace(position, column=position.column + 1)
            if not found_at(book, value_cell).is_blank:
                by_field.setdefault(fields[label].name, []).append(value_cell)
    return by_field


def cell_as_column(
    book: OpenBook, section: SheetSection, entry: Entry, position: CellPosition
) -> FieldColumn:
    """Return the unit of a single field; raise InputError if it is not accepted, or covered."""
    if entry.kind not in (int, float):
        check_uncovered(book, position)
        return FieldColumn(number=position.column, unit="", si=1.0, heading=position)
    named = _named(book, section.unit_name(entry.name))
    unit_cell = named or replace(position, column=position.column + 1)
    check_uncovered(book, position, unit_cell)
    unit, si = unit_size(entry, found_at(book, unit_cell).shown.strip(), unit_cell.address)
    return FieldColumn(number=position.column, unit=unit, si=si, heading=unit_cell)


def added_later(book: OpenBook, section: SheetSection) -> tuple[Entry, ...]:
    """Return the fields that a block lacks because its workbook is of a version before them."""
    return tuple(
        entry for entry in section.entries if entry.is_new and not _position(book, section, entry)
    )


def is_absent(book: OpenBook, section: SheetSection) -> bool:
    """Whether a workbook has neither names nor labels of a section."""
    if section.is_table:
        return is_table_absent(book, section)
    return not any(_position(book, section, entry) for entry in section.entries)


def _named(book: OpenBook, name: str) -> CellPosition | None:
    """Return a named range that is a single cell."""
    area = area_named(book.book, name)
    if area is None:
        return None
    title, (left, top, *end) = area
    # A name that was stretched over several cells is none: which of them is meant nobody can tell.
    return CellPosition(title, top, left) if [left, top] == end else None


def _position(book: OpenBook, section: SheetSection, entry: Entry) -> CellPosition | None:
    return _found(book, section, entry.name, labels_of(entry))


def _found(
    book: OpenBook, section: SheetSection, field: str, names: Set[str]
) -> CellPosition | None:
    """Return the cell that has the name of a field, or else is next to one of some labels."""
    named = _named(book, section.cell_name(field))
    if named:
        return named
    places = (position for position, label in _labels(book, section) if label in names)
    label_cell = next(places, None)
    return replace(label_cell, column=label_cell.column + 1) if label_cell else None


def gone_cells(book: OpenBook, section: SheetSection) -> Iterator[tuple[GoneInput, CellPosition]]:
    """Yield the cells of a block of an earlier workbook for inputs that no longer exist."""
    for gone in GONE.get(section.key, ()):
        position = _found(book, section, gone.field, {label_key(gone.label)})
        if position:
            yield gone, position


def _labels(book: OpenBook, section: SheetSection) -> Iterator[tuple[CellPosition, str]]:
    """Yield cells that may be a label of a block, from its sheets."""
    titles = [section.sheet_of(entry.name) for entry in section.entries]
    for title in dict.fromkeys(titles):
        for sheet in sheets_titled(book, title):
            yield from labels(book, sheet)
