"""Fills cells of a workbook, and is the one way in which a command changes one.

Read `changing`.
"""

from __future__ import annotations

import os
from collections.abc import Iterator, Mapping, Set
from contextlib import contextmanager
from dataclasses import dataclass, field
from itertools import starmap
from pathlib import Path

from openpyxl.formula.translate import Translator
from openpyxl.utils import coordinate_to_tuple

from report.sheet.reading.archive import OpenBook, book_of, located, open_book
from report.sheet.reading.formula_text import references
from report.sheet.reading.locate_tables import TableArea, table_area
from report.sheet.reading.parts import Formula, Value, changed
from report.sheet.reading.positions import CellPosition, bounds_of
from report.sheet.reading.read import Sheet, read_book
from report.sheet.reading.what_if import cells
from report.sheet.schema import SECTIONS
from report.sheet.schema.choices import ClearanceSource
from report.sheet.schema.fields import DraftRow, Place
from report.sheet.writing.style import is_answer
from solver.files import check_plain, locked, write_all
from solver.model import InputError

BEFORE = ".before.xlsx"
"""Ends the name under which a workbook is kept as it was before the last command changed it."""

_OPEN_ELSEWHERE = ("~${}", ".~lock.{}#")
"""Files that Excel and LibreOffice put beside a workbook while they have it open."""


@dataclass(slots=True)
class WorkbookChange:
    """A workbook that is being changed, and files that are written beside it by their names."""

    book: OpenBook
    files: dict[str, bytes] = field(default_factory=dict)
    before: OpenBook = field(init=False)
    written: set[CellPosition] = field(default_factory=set)

    def __post_init__(self) -> None:
        self.before = self.book

    def fill(self, cells: Mapping[CellPosition, Value]) -> None:
        """Change cells; raises as `filled`."""
        self.book = filled(self.book, cells)
        self.written |= cells.keys()

    def note(self, cells: Mapping[CellPosition, Value]) -> None:
        """Change cells that no formula refers to."""
        self.book = book_of(self.book.path, changed(self.book.data, cells, recalculates=False))

    @property
    def areas(self) -> str:
        """The cells that were written, by runs of rows: `Arrays!A7:W9, Outlines!A8:D19`."""
        found = []
        for sheet in self.book.scans:
            cells = [each for each in self.written if each.sheet == sheet]
            rows = sorted({each.row for each in cells})
            starts = [row for row in rows if row - 1 not in rows]
            ends = [row for row in rows if row + 1 not in rows]
            for start, end in zip(starts, ends, strict=True):
                columns = [each.column for each in cells if start <= each.row <= end]
                first = CellPosition(sheet, start, min(columns))
                last = CellPosition(sheet, end, max(columns))
                found.append(first.address + (f":{last.cell}" if last != first else ""))
        return ", ".join(found)

    @property
    def has_formulas(self) -> bool:
        """Whether it has formulas, whose cached values stay."""
        return any(scan.formulas for scan in self.book.scans.values())


@contextmanager
def changing(source: Path, *, keeps_copy: bool = True) -> Iterator[WorkbookChange]:
    """Give a workbook to change, as it is once no other command changes it; write it at the end.

    It and the files beside it are written together, with `NAME.before.xlsx`, the workbook as it
    was, unless no copy is kept; nothing is written if the work on it fails, or changes nothing.

    Raises
    ------
    InputError
        If the workbook cannot be read or written, or a program has it open.
    """
    path = Path(os.path.realpath(source)) if source.is_file() else located(source)
    check_plain(path, path.parent)
    with locked(path.parent):
        for pattern in _OPEN_ELSEWHERE:
            if os.path.lexists(beside := path.with_name(pattern.format(path.name))):
                raise InputError(
                    f"{beside}: is there, so a program has the workbook open; close it there, or"
                    " delete that file if none has"
                )
        change = WorkbookChange(open_book(path))
        yield change
        if change.files or change.book.data != change.before.data:
            copy = {f"{path.stem}{BEFORE}": change.before.data} if keeps_copy else {}
            write_all({**change.files, **copy, path.name: change.book.data}, path.parent)


def filled(book: OpenBook, cells: Mapping[CellPosition, Value]) -> OpenBook:
    """Return a workbook with other contents of cells; those of `changed` may be refused.

    Rows that a table has grown by are given their formulas; those that may refer to the cells lose
    their values.
    """
    if not cells:
        return book
    after = book_of(book.path, changed(book.data, cells, _dependents(book, cells.keys())))
    # Excel gives the rows that a table has grown by their formulas only where they are typed.
    grown = dict(_in_grown_rows(book, after))
    looks = dict(_looks_of_grown_rows(book, after))
    return book_of(book.path, changed(after.data, grown, looks=looks)) if grown or looks else after


def _looks_of_grown_rows(
    before: OpenBook, after: OpenBook
) -> Iterator[tuple[CellPosition, CellPosition]]:
    """Yield the cells of the rows that each table has grown by, with those of its last row."""
    for was, now in _tables(before, after):
        for heading in was.headings.values():
            last = CellPosition(was.sheet, was.last, heading.column)
            for row in range(was.last + 1, now.last + 1):
                yield CellPosition(was.sheet, row, heading.column), last


def _tables(before: OpenBook, after: OpenBook) -> Iterator[tuple[TableArea, TableArea]]:
    for section in (section for section in SECTIONS if section.is_table):
        was, now = table_area(before, section), table_area(after, section)
        if was is not None and now is not None:
            yield was, now


def _in_grown_rows(before: OpenBook, after: OpenBook) -> Iterator[tuple[CellPosition, Formula]]:
    """Yield the formulas of the last row that each table had for the rows that it has grown by."""
    for was, now in _tables(before, after):
        for heading in was.headings.values():
            last = CellPosition(was.sheet, was.last, heading.column)
            formula = before.formula(last.sheet, last.cell)
            if formula and is_answer(before.book[last.sheet].cell(last.row, last.column)):
                for row in range(was.last + 1, now.last + 1):
                    at = CellPosition(was.sheet, row, heading.column)
                    moved = Translator(formula, last.cell).translate_formula(at.cell)
                    yield at, Formula(moved)


def _dependents(book: OpenBook, cells: Set[CellPosition]) -> Set[CellPosition]:
    """Return the formulas that may refer to cells, also by other formulas."""
    areas = {
        CellPosition(title, *coordinate_to_tuple(cell)): [
            _area(reference, title) for reference in references(scan.formula(cell))
        ]
        for title, scan in book.scans.items()
        for cell in scan.formulas
    }
    titles, found = {title.casefold() for title in book.scans}, set(cells)

    def may_refer(title: str, bounds: tuple[int, int, int, int] | None) -> bool:
        if bounds is None or title not in titles:  # a name, a column of a table, other files
            return True
        left, top, right, bottom = bounds
        return any(
            title == at.sheet.casefold() and left <= at.column <= right and top <= at.row <= bottom
            for at in found
        )

    while more := {at for at in areas if at not in found and any(starmap(may_refer, areas[at]))}:
        found |= more
    return found - cells


def _area(reference: str, title: str) -> tuple[str, tuple[int, int, int, int] | None]:
    """Return the sheet of a reference, if its own is another, and its bounds where it has any."""
    given, _, cells = reference.rpartition("!")
    named = given.removeprefix("'").removesuffix("'").replace("''", "'")
    return (named or title).casefold(), bounds_of(cells)


def withdrawn(change: WorkbookChange) -> list[str]:
    """Empty who confirmed the distances from the drawing, and when, if they changed; say so."""
    before = read_book(change.before)
    stated = {
        Place("project", 0, field): row[field]
        for row in before.draft["project"]
        for field in ("drawing_confirmed_by", "drawing_confirmed_date", "drawing_covered")
        if row.get(field)
    }
    if not stated or _drawn(before) == _drawn(read_book(change.book)):
        return []
    emptied = cells(before, dict.fromkeys(stated))
    change.fill(emptied)
    where = ", ".join(position.address for position in emptied)
    by = ", ".join(str(value) for value in [*stated.values()][:2])
    return [
        f"{where}: 'Drawing distances confirmed by {by}' is taken out: distances from the drawing"
        " have changed; confirm them again"
    ]


def _drawn(sheet: Sheet) -> list[DraftRow]:
    rows = sheet.draft["clearances"]
    return [row for row in rows if row.get("source") is ClearanceSource.DRAWING]
