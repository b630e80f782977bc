"""Fills cells of a workbook, and is the one way in which a command changes one.

Read `changing`.
"""

from __future__ import annotations

import os
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path

from report.sheet.reading.archive import OpenBook, book_of, located, open_book
from report.sheet.reading.parts import Formula, Value, changed
from report.sheet.reading.positions import CellPosition
from report.sheet.writing.live import BROKEN, live_formulas
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

    def fill(self, cells: Mapping[CellPosition, Value]) -> None:
        """Change cells; raises as `filled`."""
        self.book = filled(self.book, cells)

    @property
    def has_formulas(self) -> bool:
        """Whether it has formulas, whose cached values stay."""
        return any(scan.formulas for scan in self.book.scans.values())


@contextmanager
def changing(source: Path) -> Iterator[WorkbookChange]:
    """Give a workbook to change, as it is once no other command changes it; write it at the end.

    It and the files beside it are written together, with `NAME.before.xlsx`, the workbook as it
    was; nothing is written if the work on it fails, or changes nothing.

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
        before = change.book.data
        yield change
        if change.files or change.book.data != before:
            copy = {f"{path.stem}{BEFORE}": before}
            write_all({**change.files, **copy, path.name: change.book.data}, path.parent)


def filled(book: OpenBook, cells: Mapping[CellPosition, Value]) -> OpenBook:
    """Return a workbook with other contents of cells; those of `changed` may be refused.

    Rows that a table has grown by are given their formulas.
    """
    if not cells:
        return book
    before = live_formulas(book)
    book = book_of(book.path, changed(book.data, cells))
    after = live_formulas(book)
    # Excel gives the rows that a table has grown by their formulas only where they are typed.
    grown = {at: Formula(after[at]) for at in after.keys() - before.keys()}
    # An earlier workbook lacks columns that the formulas of today refer to.
    whole = {at: formula for at, formula in grown.items() if BROKEN not in formula}
    return book_of(book.path, changed(book.data, whole)) if whole else book
