"""Cells that are read though the workbook does not show them, or shows them struck through.

Knows no field. Read `unseen`, and `warnings` for what is said of it.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from enum import StrEnum
from itertools import chain, groupby, islice
from typing import Any

from openpyxl.styles.colors import COLOR_INDEX, Color
from openpyxl.utils import coordinate_to_tuple, get_column_letter
from openpyxl.worksheet.worksheet import Worksheet

from report.project.model.finding import Finding, warning
from report.project.model.place import Place
from report.project.read.archive import OpenBook
from report.project.read.cells import Found
from report.project.read.number_formats import shows_nothing
from report.project.read.positions import bounds_of

# Cells that are read, each with the place that it is read for.
Used = Iterable[tuple[Place, Found]]

# Height [points] and width [characters] below which nothing in a row or column can be read.
LEAST_HEIGHT, LEAST_WIDTH = 3.0, 0.4

# Difference of two colors in red, green and blue, each of 255, below which they look alike.
_LIKE = 24

_MOST_RANGES = 8

# Filters of a sheet that are told from other ways to hide a row.
_MOST_FILTERS = 50


class Concealment(StrEnum):
    """How a cell is kept from sight, as the echo prints it."""

    SHEET = "hidden sheet"
    HIDDEN = "hidden"
    FILTERED = "filtered out"
    STRUCK = "struck through"
    INVISIBLE = "invisible"


_SENTENCES: Mapping[Concealment, str] = {
    Concealment.SHEET: "the sheet is {state}, and {cells} on it {are} read: show it, or clear what"
    " is not meant",
    Concealment.HIDDEN: "{cells} {are} in hidden rows or columns, and {are} read: show them, or"
    " clear what is not meant",
    Concealment.FILTERED: "{cells} {are} in rows that a filter hides, and {are} read: clear the"
    " filter, and delete the rows that are not meant",
    Concealment.STRUCK: "{cells} {are} struck through, and {are} read: clear what is not meant,"
    " and remove the strikethrough from the rest",
    Concealment.INVISIBLE: "{cells} cannot be seen for the color of the text or the number format,"
    " and {are} read: change it, or clear what is not meant",
}
_STATES = {"hidden": "hidden", "veryHidden": "hidden so that Excel's menu does not list it"}


@dataclass(frozen=True, slots=True, kw_only=True)
class Unseen:
    """Cells of a sheet that are read and kept from sight in one way."""

    kind: Concealment
    sheet: str
    state: str  # of the sheet, as openpyxl names it
    place: Place  # of the first cell
    cells: tuple[tuple[int, int], ...]  # row and column of each

    @property
    def words(self) -> str:
        """The cells as ranges: `cells B5, B7:B9`."""
        ranges = list(_ranges(self.cells))
        n_more = len(ranges) - _MOST_RANGES
        listed = ", ".join(ranges[:_MOST_RANGES])
        if n_more > 0:
            listed += f" and {n_more} more range{'s' if n_more > 1 else ''}"
        return f"{'cells' if self.are_many else 'cell'} {listed}"

    @property
    def are_many(self) -> bool:
        """Whether it is more than one cell."""
        return len(set(self.cells)) > 1


def unseen(book: OpenBook, used: Used) -> tuple[Unseen, ...]:
    """Return what is read and kept from sight, one for each sheet and kind."""
    sights: dict[str, _Sight] = {}
    by_sheet: dict[tuple[str, Concealment], list[tuple[Place, tuple[int, int]]]] = {}
    for place, cell in used:
        if cell.sheet not in sights:
            sights[cell.sheet] = _Sight(book.book[cell.sheet])
        at = coordinate_to_tuple(cell.cell)
        for kind in sights[cell.sheet].kinds(*at, cell):
            by_sheet.setdefault((cell.sheet, kind), []).append((place, at))
    return tuple(
        Unseen(
            kind=kind,
            sheet=sheet,
            state=book.book[sheet].sheet_state,
            place=cells[0][0],
            cells=tuple(at for _, at in cells),
        )
        for (sheet, kind), cells in by_sheet.items()
    )


def by_cell(unseen_cells: Iterable[Unseen]) -> Mapping[str, str]:
    """Return in words how each cell is kept from sight, by its address."""
    words: dict[str, str] = {}
    for unseen in unseen_cells:
        for row, column in unseen.cells:
            address = f"{unseen.sheet}!{get_column_letter(column)}{row}"
            words[address] = ", ".join(filter(None, (words.get(address, ""), unseen.kind.value)))
    return words


def warnings(unseen_cells: Iterable[Unseen]) -> Iterator[Finding]:
    """Yield a warning for each sheet and kind, with the cells."""

    def key(together: Unseen) -> tuple[str, str]:
        return together.sheet, together.kind

    for _, group in groupby(sorted(unseen_cells, key=key), key=key):
        parts = list(group)
        cells = tuple(chain.from_iterable(part.cells for part in parts))
        together = replace(parts[0], cells=cells)
        text = _SENTENCES[together.kind].format(
            state=_STATES.get(together.state, "hidden"),
            cells=together.words,
            are="are" if together.are_many else "is",
        )
        row, column = together.cells[0]
        address = f"{together.sheet}!{get_column_letter(column)}{row}"
        yield replace(
            warning(f"{together.kind} {together.sheet}", together.place, text), cell=address
        )


def _ranges(cells: Iterable[tuple[int, int]]) -> Iterator[str]:
    """Yield cells as ranges: the runs of each row, as one where those below have its columns."""
    open_: dict[tuple[int, int], tuple[int, int]] = {}
    done: list[tuple[int, int, int, int]] = []
    for row, group in groupby(sorted(set(cells)), key=lambda cell: cell[0]):
        runs = list(_runs(column for _, column in group))
        for run in runs:
            top, last = open_.get(run, (row, row))
            if last < row - 1:
                done.append((top, run[0], last, run[1]))
                top = row
            open_[run] = top, row
    done += [(top, left, last, right) for (left, right), (top, last) in open_.items()]
    for top, left, last, right in sorted(done):
        first, end = f"{get_column_letter(left)}{top}", f"{get_column_letter(right)}{last}"
        yield first if first == end else f"{first}:{end}"


def _runs(numbers: Iterable[int]) -> Iterator[tuple[int, int]]:
    """Yield first and last of each run of successive numbers, which increase."""
    for _, group in groupby(enumerate(numbers), key=lambda cell: cell[1] - cell[0]):
        run = [number for _, number in group]
        yield run[0], run[-1]


class _Sight:
    """What a sheet hides; what it says of a style is looked up once."""

    def __init__(self, sheet: Worksheet) -> None:
        self._sheet = sheet
        self._is_hidden = sheet.sheet_state != "visible"
        self._rows = dict(_hidden_rows(sheet))
        self._columns = [
            range(column.min or 0, (column.max or 0) + 1)
            for column in sheet.column_dimensions.values()
            if column.hidden or _is_less(column.width, LEAST_WIDTH)
        ]
        self._styles: dict[int, Sequence[Concealment]] = {}

    def kinds(self, row: int, column: int, content: Found) -> Sequence[Concealment]:
        """Return how a cell is kept from sight."""
        of_place = self._of_place(row, column)
        cell = self._sheet.cell(row, column)
        if not cell.has_style:
            return of_place
        style = cell.style_id
        if style not in self._styles:
            self._styles[style] = tuple(_of_style(cell))
        is_blanked = shows_nothing(content.number_format, content.value)
        blanked = (Concealment.INVISIBLE,) * is_blanked
        return tuple(dict.fromkeys((*of_place, *self._styles[style], *blanked)))

    def _of_place(self, row: int, column: int) -> Sequence[Concealment]:
        if self._is_hidden:
            return (Concealment.SHEET,)
        if row in self._rows:
            return (self._rows[row],)
        return (Concealment.HIDDEN,) if any(column in columns for columns in self._columns) else ()


def _hidden_rows(sheet: Worksheet) -> Iterator[tuple[int, Concealment]]:
    filtered = tuple(islice(_filtered(sheet), _MOST_FILTERS))
    for row, dimension in sheet.row_dimensions.items():
        if dimension.hidden or _is_less(dimension.height, LEAST_HEIGHT):
            is_filtered = any(row in rows for rows in filtered)
            yield row, Concealment.FILTERED if is_filtered else Concealment.HIDDEN


def _is_less(size: float | None, minimum: float) -> bool:
    return size is not None and size < minimum


def _filtered(sheet: Worksheet) -> Iterator[range]:
    """Yield the rows of each filter that is in use, without that of its headings."""
    for area in (sheet.auto_filter, *(table.autoFilter for table in sheet.tables.values())):
        bounds = bounds_of(area.ref) if area is not None and area.filterColumn else None
        if bounds:
            yield range(bounds[1] + 1, bounds[3] + 1)


def _of_style(cell: Any) -> Iterator[Concealment]:
    if cell.font.strike:
        yield Concealment.STRUCK
    fill = cell.fill
    behind = _rgb(fill.fgColor, _WHITE) if getattr(fill, "fill_type", None) == "solid" else _WHITE
    color = _rgb(cell.font.color, _BLACK)
    if color and behind and all(abs(a - b) < _LIKE for a, b in zip(color, behind, strict=True)):
        yield Concealment.INVISIBLE


_WHITE, _BLACK = (255, 255, 255), (0, 0, 0)
# The first two colors of a theme: those of background and text.
_OF_THEME = (_WHITE, _BLACK)


def _rgb(color: Color | None, default: tuple[int, ...]) -> tuple[int, ...]:
    """Return red, green and blue of a color; empty for one that only a theme knows."""
    if color is None:
        return default
    # The first two of eight digits are the opacity, which programs set as they like.
    if color.type == "rgb":
        return tuple(bytes.fromhex(str(color.rgb)[-6:]))
    if color.tint:
        return ()
    if color.type == "theme":
        return _OF_THEME[color.theme] if color.theme < len(_OF_THEME) else ()
    if color.type == "indexed" and color.indexed < len(COLOR_INDEX):
        return tuple(bytes.fromhex(COLOR_INDEX[color.indexed][-6:]))
    return default
