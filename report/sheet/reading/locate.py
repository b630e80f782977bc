"""Finds the single inputs of a workbook by defined name and by label; `locate_tables` the others.

Never uses positions or styles, which users change. `cells` converts the content of the cells.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import replace

from report.sheet.reading.archive import OpenBook
from report.sheet.reading.locate_tables import FieldColumn, table_area
from report.sheet.reading.positions import (
    FRESH,
    CellPosition,
    area_named,
    check_uncovered,
    fields_by_label,
    found_at,
    labels,
    labels_of,
    sheet_titled,
    unit_size,
)
from report.sheet.schema import legacy_labels
from report.sheet.schema.fields import Entry, SheetSection, entries
from solver.model import InputError


def find_cell(book: OpenBook, section: SheetSection, entry: Entry) -> CellPosition:
    """Return the cell of a single field by name, or else beside its label, or raise InputError."""
    position = _position(book, section, entry)
    if position is None:
        raise InputError(
            f"{section.sheet_of(entry.name)}: {entry.spoken} is missing"
            f" (no name {section.cell_name(entry.name)} and no label '{entry.cell.label}'); {FRESH}"
        )
    return position


def beside(book: OpenBook, section: SheetSection) -> Mapping[str, list[CellPosition]]:
    """Return the cells with content beside the labels of each field on the sheets of a block."""
    fields = fields_by_label(section)
    found: dict[str, list[CellPosition]] = {}
    for position, label in _labels(book, section):
        at = replace(position, column=position.column + 1)
        if label in fields and not found_at(book, at).is_blank:
            found.setdefault(fields[label].name, []).append(at)
    return found


def cell_as_column(
    book: OpenBook, section: SheetSection, entry: Entry, position: CellPosition
) -> FieldColumn:
    """Return the unit of a single field, as a column has it: by name, or else next to the value.

    Raises
    ------
    InputError
        If the unit is not accepted, or merged cells cover either.
    """
    if entry.kind not in (int, float):
        check_uncovered(book, position)
        return FieldColumn(number=position.column, unit="", si=1.0, heading=position)
    named = _named(book, map(section.unit_name, _fields(section, entry)))
    at = named or replace(position, column=position.column + 1)
    check_uncovered(book, position, at)
    unit, si = unit_size(entry, found_at(book, at).shown.strip(), at.address)
    return FieldColumn(number=position.column, unit=unit, si=si, heading=at)


def added_later(book: OpenBook, section: SheetSection) -> tuple[Entry, ...]:
    """Return the fields that a block lacks because its workbook is of a version before them.

    A workbook that has some of those that came together has lost the others.
    """
    groups = (
        [entry for entry in entries(section.model) if (section.key, entry.name) in added]
        for added in legacy_labels.ADDED
    )
    return tuple(entry for group in groups if not _has_any(book, section, group) for entry in group)


def _has_any(book: OpenBook, section: SheetSection, fields: Sequence[Entry]) -> bool:
    return any(_position(book, section, entry) for entry in fields)


def is_absent(book: OpenBook, section: SheetSection) -> bool:
    """Whether a workbook has neither names nor labels of a section."""
    if section.is_table:
        return sheet_titled(book, section.sheet) is None and table_area(book, section) is None
    return not _has_any(book, section, entries(section.model))


def _fields(section: SheetSection, entry: Entry) -> tuple[str, ...]:
    """Return the name of a field and its earlier names."""
    return entry.name, *legacy_labels.FIELDS.get((section.key, entry.name), ())


def _named(book: OpenBook, names: Iterable[str]) -> CellPosition | None:
    """Return the first of named ranges that is a single cell."""
    for name in names:
        title, (left, top, right, bottom) = area_named(book.book, name) or ("", (0, 0, 0, 0))
        if title and (left, top) == (right, bottom):
            return CellPosition(title, top, left)
    return None


def _position(book: OpenBook, section: SheetSection, entry: Entry) -> CellPosition | None:
    named = _named(book, map(section.cell_name, _fields(section, entry)))
    if named:
        return named
    wanted = labels_of(section, entry)
    found = (position for position, label in _labels(book, section) if label in wanted)
    at = next(found, None)
    return replace(at, column=at.column + 1) if at else None


def _labels(book: OpenBook, section: SheetSection) -> Iterator[tuple[CellPosition, str]]:
    """Yield what may be a label of a block, from its sheets and the one of earlier workbooks."""
    titles = [section.sheet_of(entry.name) for entry in entries(section.model)]
    earlier = legacy_labels.SHEETS.get(section.key, section.sheet)
    for title in dict.fromkeys((*titles, earlier)):
        if sheet := sheet_titled(book, title):
            yield from labels(book, sheet)
