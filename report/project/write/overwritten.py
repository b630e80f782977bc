"""Blue cells whose formula was overwritten."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import groupby

from report.project.model.finding import Finding, Level
from report.project.model.input_rows import Place
from report.project.read.archive import OpenBook
from report.project.read.cells import Found, plain
from report.project.read.locate import table_area
from report.project.read.positions import FRESH, CellPosition, area_named, found_at
from report.project.workbook import SECTIONS
from report.project.write.start_sheet import START
from report.project.write.style import is_answer
from report.text.typed_letters import cut

_PANEL = "live_sdc_used"
# In a formula that refers to a column which the workbook lacks.
_BROKEN = "#REF!"


@dataclass(frozen=True, slots=True, kw_only=True)
class Overwritten:
    """A cell that has lost its formula."""

    position: CellPosition
    content: Found  # what it has instead
    title: str  # what the formula computes

    @property
    def is_broken(self) -> bool:
        """Whether the workbook lacks a column that the formula refers to."""
        return _BROKEN in self.content.formula


def overwritten(book: OpenBook) -> tuple[Overwritten, ...]:
    """Return the blue cells that have lost their formula, by sheet, column and row."""
    lost = []
    for position in _blue(book):
        content = found_at(book, position)
        if not content.formula or _BROKEN in content.formula:
            title = _title(book, position)
            lost.append(Overwritten(position=position, content=content, title=title))
    titles = book.book.sheetnames
    lost.sort(key=lambda o: (titles.index(o.position.sheet), o.position.column, o.position.row))
    return tuple(lost)


def _blue(book: OpenBook) -> Iterator[CellPosition]:
    panel = area_named(book.book, _PANEL)
    if panel is None:
        return
    for title in book.sheets:
        # Start of earlier workbooks has samples of the color alone.
        if title == START and panel[0] != START:
            continue
        for cell in book.cells(title):
            if is_answer(cell):
                yield CellPosition(title, cell.row, cell.column)


def formula_findings(lost: Sequence[Overwritten]) -> Iterator[Finding]:
    """Yield a warning for each run of cells below each other."""
    # Reversed, so that of several sections on a sheet the first one stays.
    keys = {section.sheet: section.key for section in reversed(SECTIONS)}

    def key(numbered: tuple[int, Overwritten]) -> tuple[str, int, int, bool]:
        count, item = numbered
        position = item.position
        # Row less count is the same for cells below each other: they are one warning.
        return position.sheet, position.column, position.row - count, item.is_broken

    for _, group in groupby(enumerate(lost), key):
        run = [item for _, item in group]
        first, last = run[0], run[-1]
        cell = first.position.address
        cells = f"{cell}:{last.position.cell}" if len(run) > 1 else cell
        place = Place(keys.get(first.position.sheet, SECTIONS[0].key))
        text = _text(first, len(run))
        yield Finding(level=Level.WARNING, place=place, text=text, cell=cells)


def _text(item: Overwritten, count: int) -> str:
    title = f"{item.title} ({count} cells)" if count > 1 else item.title
    if item.is_broken:
        return f"{title} refers to a column that is missing; write its heading again, or {FRESH}"
    if item.content.is_blank:
        return f"{title} is blank, and its formula is gone; {FRESH}"
    return f"the formula of {title} was overwritten with {cut(plain(item.content.value))}; {FRESH}"


def _title(book: OpenBook, position: CellPosition) -> str:
    """Return the title of a computed cell: its column heading, or else the label of its row."""
    sheet = book.book[position.sheet]
    for section in SECTIONS:
        area = table_area(book, section) if section.is_table else None
        if area and area.sheet == position.sheet and area.header < position.row <= area.last:
            return str(sheet.cell(area.header, position.column).value)
    filled, row = book.scans[position.sheet].cells, position.row
    columns = (column for column in range(1, position.column) if (row, column) in filled)
    labels = (sheet.cell(row, column).value for column in columns)
    title = next((str(label) for label in labels if isinstance(label, str) and label), "cell")
    return f"{title.removesuffix(' *')}, computed," if position.sheet == "Site" else title
