"""The blue cells of a workbook whose formula is gone. Read `overwritten`."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import groupby

from openpyxl.utils import coordinate_to_tuple

from report.sheet.reading.archive import OpenBook
from report.sheet.reading.cells import Found, plain
from report.sheet.reading.locate_tables import table_area
from report.sheet.reading.positions import FRESH, CellPosition, area_named, found_at
from report.sheet.schema import SECTIONS
from report.sheet.schema.fields import Finding, Level, Place
from report.sheet.writing.start import START
from report.sheet.writing.style import is_answer
from report.words.letters import cut

_PANEL = "live_prescriptive_in"
_BROKEN = "#REF!"
"""In a formula that refers to a column which the workbook lacks."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Overwritten:
    """A cell that has lost its formula."""

    position: CellPosition
    found: Found  # what it contains instead
    title: str  # what the formula computes

    @property
    def is_broken(self) -> bool:
        """Whether the workbook lacks a column that the formula refers to."""
        return _BROKEN in self.found.formula


def overwritten(book: OpenBook) -> tuple[Overwritten, ...]:
    """Return the blue cells that have lost their formula, by sheet, column and row.

    Start of earlier workbooks has samples of their color alone, and their column Status no use.
    """
    lost = [
        Overwritten(position=position, found=found, title=title)
        for position in _blue(book)
        if not (found := found_at(book, position)).formula or _BROKEN in found.formula
        if (title := _title(book, position)) != "Status"
    ]
    titles = book.book.sheetnames
    lost.sort(key=lambda o: (titles.index(o.position.sheet), o.position.column, o.position.row))
    return tuple(lost)


def _blue(book: OpenBook) -> Iterator[CellPosition]:
    panel = area_named(book.book, _PANEL)
    if panel is None:
        return
    for sheet in book.book.worksheets:
        for cell in (cell for row in sheet.iter_rows() for cell in row):
            if is_answer(cell) and (sheet.title != START or panel[0] == START):
                yield CellPosition(sheet.title, *coordinate_to_tuple(cell.coordinate))


def findings(lost: Sequence[Overwritten]) -> Iterator[Finding]:
    """Yield a warning for each run of cells below each other."""
    keys = {section.sheet: section.key for section in reversed(SECTIONS)}
    for run in _runs(lost):
        first, last = run[0], run[-1]
        cell = first.position.address
        cells = f"{cell}:{last.position.cell}" if len(run) > 1 else cell
        place = Place(keys.get(first.position.sheet, SECTIONS[0].key))
        text = _text(first, len(run))
        yield Finding(level=Level.WARNING, place=place, text=text, cell=cells)


def _runs(lost: Sequence[Overwritten]) -> Iterator[list[Overwritten]]:
    def key(numbered: tuple[int, Overwritten]) -> tuple[str, int, int, bool]:
        count, item = numbered
        at = item.position
        return at.sheet, at.column, at.row - count, item.is_broken

    for _, run in groupby(enumerate(lost), key):
        yield [item for _, item in run]


def _text(item: Overwritten, count: int) -> str:
    title = f"{item.title} ({count} cells)" if count > 1 else item.title
    if item.is_broken:
        return f"{title} refers to a column that is missing; write its heading again, or {FRESH}"
    if item.found.is_blank:
        return f"{title} is blank, and its formula is gone; {FRESH}"
    return f"{title} is {cut(plain(item.found.value))}, typed over its formula; {FRESH}"


def _title(book: OpenBook, position: CellPosition) -> str:
    """Return what a cell computes: the heading of its column, or else the label of its row."""
    sheet = book.book[position.sheet]
    for section in SECTIONS:
        area = table_area(book, section) if section.is_table else None
        if area and area.sheet == position.sheet and area.header < position.row <= area.last:
            return str(sheet.cell(area.header, position.column).value)
    labels = (sheet.cell(position.row, column).value for column in range(1, position.column))
    found = next((str(label) for label in labels if isinstance(label, str) and label), "cell")
    return f"{found.removesuffix(' *')}, computed," if position.sheet == "Site" else found


def has_live_formulas(book: OpenBook) -> bool:
    """Whether a workbook computes while it is filled in, as those of 0.1 do not."""
    return area_named(book.book, _PANEL) is not None
