"""Finds the single inputs of a workbook, by defined name or by label."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Set
from dataclasses import replace

from report.project.read.archive import OpenBook
from report.project.read.locate_table import FieldColumn, is_table_absent
from report.project.read.positions import (
    FRESH,
    CellPosition,
    area_named,
    check_uncovered,
    fields_by_label,
    found_at,
    label_key,
    labels,
    labels_of,
    sheets_titled,
    unit_size,
)
from report.project.workbook.earlier_workbooks import GONE, GoneInput
from report.project.workbook.entries import Entry
from report.project.workbook.sections import SheetSection
from solver.errors import InputError


def find_cell(book: OpenBook, section: SheetSection, entry: Entry) -> CellPosition:
    """Return the cell of a single field by name, or else beside its label, or raise InputError."""
    position = _position(book, section, entry)
    if position is None:
        raise InputError(
            f"{section.sheet_of(entry.name)}: {entry.spoken} is missing"
            f" (no name {section.cell_name(entry.name)} and no label '{entry.heading}'); {FRESH}"
        )
    return position


def beside(book: OpenBook, section: SheetSection) -> Mapping[str, list[CellPosition]]:
    """Return the cells with content beside the labels of each field on the sheets of a block."""
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
    return CellPosition(title, top, left) if [left, top] == end else None


def _position(book: OpenBook, section: SheetSection, entry: Entry) -> CellPosition | None:
    return _found(book, section, entry.name, labels_of(entry))


def _found(
    book: OpenBook, section: SheetSection, field: str, names: Set[str]
) -> CellPosition | None:
    """Return the cell that has the name of a field, or else is beside one of some labels."""
    named = _named(book, section.cell_name(field))
    if named:
        return named
    places = (position for position, label in _labels(book, section) if label in names)
    label_cell = next(places, None)
    return replace(label_cell, column=label_cell.column + 1) if label_cell else None


def gone_cells(book: OpenBook, section: SheetSection) -> Iterator[tuple[GoneInput, CellPosition]]:
    """Yield the cells that a block of an earlier workbook has for inputs that are no more."""
    for gone in GONE.get(section.key, ()):
        position = _found(book, section, gone.field, {label_key(gone.label)})
        if position:
            yield gone, position


def _labels(book: OpenBook, section: SheetSection) -> Iterator[tuple[CellPosition, str]]:
    """Yield what may be a label of a block, from its sheets."""
    titles = [section.sheet_of(entry.name) for entry in section.entries]
    for title in dict.fromkeys(titles):
        for sheet in sheets_titled(book, title):
            yield from labels(book, sheet)
