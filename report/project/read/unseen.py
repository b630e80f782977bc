"""Content of a workbook that a reader may not see: hidden cells, copied sheets, old values.

Read `unseen`, and `warnings` for what is said of it.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence, Set
from dataclasses import dataclass, replace
from enum import StrEnum
from itertools import chain, groupby, islice
from typing import Any

from openpyxl.styles.colors import COLOR_INDEX, Color
from openpyxl.utils import coordinate_to_tuple, get_column_letter
from openpyxl.worksheet.worksheet import Worksheet

from report.project.check.finding_lines import listed
from report.project.model.finding import Finding, warning
from report.project.model.input_rows import Place
from report.project.read.archive import OpenBook
from report.project.read.cells import Found
from report.project.read.number_formats import shows_nothing
from report.project.read.positions import CellPosition, bounds_of, fields_by_label, labels
from report.project.workbook.entries import SheetSection
from report.text.typed_letters import cut

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
    """How a cell is hidden, as printed in the echo."""

    SHEET = "hidden sheet"
    HIDDEN = "hidden"
    FILTERED = "filtered out"
    STRUCK = "struck through"
    INVISIBLE = "invisible"


_SENTENCES: Mapping[Concealment, str] = {
    Concealment.SHEET: "the worksheet is {state}, but {cells} on it {are} used: unhide it, or"
    " clear the cells"
    " that you do not want",
    Concealment.HIDDEN: "{cells} {are} in hidden rows or columns but {are} used: unhide them, or"
    " clear the cells that you do not want",
    Concealment.FILTERED: "{cells} {are} in rows that a filter hides but {are} used: clear the"
    " filter, and delete the rows that you do not want",
    Concealment.STRUCK: "{cells} {are} struck through but {are} used: clear the cells that you do"
    " not want, and remove the strikethrough from the others",
    Concealment.INVISIBLE: "{cells} {are} invisible because of the text color or the number format"
    " but {are} used: change the format, or clear the cells that you do not want",
}
_STATES = {"hidden": "hidden", "veryHidden": "hidden so that the menu of Excel does not list it"}


@dataclass(frozen=True, slots=True, kw_only=True)
class Unseen:
    """Cells of a sheet that are read but hidden in one way."""

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
    """Return hidden cells that are read, one item for each sheet and way of hiding."""
    sights: dict[str, _Sight] = {}
    by_sheet: dict[tuple[str, Concealment], list[tuple[Place, tuple[int, int]]]] = {}
    for place, cell in used:
        if cell.sheet not in sights:
            sights[cell.sheet] = _Sight(book.book[cell.sheet])
        position = coordinate_to_tuple(cell.cell)
        for kind in sights[cell.sheet].kinds(*position, cell):
            by_sheet.setdefault((cell.sheet, kind), []).append((place, position))
    return tuple(
        Unseen(
            kind=kind,
            sheet=sheet,
            state=book.book[sheet].sheet_state,
            place=cells[0][0],
            cells=tuple(position for _, position in cells),
        )
        for (sheet, kind), cells in by_sheet.items()
    )


def by_cell(unseen_cells: Iterable[Unseen]) -> Mapping[str, str]:
    """Return how each cell is hidden, as text by its address."""
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
    """The hidden cells of a sheet; each style is looked up once."""

    def __init__(self, sheet: Worksheet) -> None:
        self._sheet = sheet
        self._is_hidden = sheet.sheet_state != "visible"
        self._rows: dict[int, Concealment] = {}
        filtered = tuple(islice(_filtered(sheet), _MOST_FILTERS))
        for row, dimension in sheet.row_dimensions.items():
            if dimension.hidden or _is_less(dimension.height, LEAST_HEIGHT):
                is_filtered = any(row in rows for rows in filtered)
                self._rows[row] = Concealment.FILTERED if is_filtered else Concealment.HIDDEN
        self._columns = [
            range(column.min or 0, (column.max or 0) + 1)
            for column in sheet.column_dimensions.values()
            if column.hidden or _is_less(column.width, LEAST_WIDTH)
        ]
        self._styles: dict[int, Sequence[Concealment]] = {}

    def kinds(self, row: int, column: int, content: Found) -> Sequence[Concealment]:
        """Return how a cell is hidden."""
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
        # On a hidden sheet everything is hidden: its rows and columns say nothing more.
        if self._is_hidden:
            return (Concealment.SHEET,)
        if row in self._rows:
            return (self._rows[row],)
        return (Concealment.HIDDEN,) if any(column in columns for columns in self._columns) else ()


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
    # Lightened or darkened by a share of the theme's color, which is not known here.
    if color.tint:
        return ()
    if color.type == "theme":
        return _OF_THEME[color.theme] if color.theme < len(_OF_THEME) else ()
    if color.type == "indexed" and color.indexed < len(COLOR_INDEX):
        return tuple(bytes.fromhex(COLOR_INDEX[color.indexed][-6:]))
    return default


# Labels in each row of a sheet, in the form that is compared.
Rows = tuple[frozenset[str], ...]


def copies(
    book: OpenBook, sections: Iterable[SheetSection], addresses: Mapping[Place, str]
) -> Iterator[Finding]:
    """Yield a warning for each sheet with all labels of one that is read."""
    rows = {sheet.title: _rows(book, sheet) for sheet in book.book.worksheets}
    warned: set[str] = set()
    for section in sections:
        addresses_of = (
            address for place, address in addresses.items() if place.section == section.key
        )
        read = next(addresses_of, "").rpartition("!")[0]
        labels = _labels(section, rows[read]) if read in rows else frozenset()
        for title in rows:
            if labels and title not in (read, *warned) and labels <= _labels(section, rows[title]):
                warned.add(title)
                text = (
                    f"worksheets '{read}' and '{title}' both have the labels of {section.title};"
                    f" '{read}' is read, and '{title}' is ignored: delete the one that you do"
                    " not want"
                )
                yield warning(f"copy {title}", Place(section.key), text)


def _rows(book: OpenBook, sheet: Worksheet) -> Rows:
    rows: dict[int, set[str]] = {}
    for position, label in labels(book, sheet):
        rows.setdefault(position.row, set()).add(label)
    return tuple(map(frozenset, rows.values()))


def _labels(section: SheetSection, rows: Rows) -> Set[str]:
    """Return the labels of a section on a sheet: of a table, those in one row."""
    fields = fields_by_label(section)
    places = rows if section.is_table else (frozenset().union(*rows),)
    labels = ({fields[label].name for label in place & fields.keys()} for place in places)
    return max(labels, key=len, default=set())


_MOST_LISTED = 8


def over_example(
    book: OpenBook, section: SheetSection, columns: Mapping[str, CellPosition]
) -> Iterator[Finding]:
    """Yield a warning if a row is typed over the example above the headings, given by field."""
    first = next(iter(columns.values()))
    sheet, row = book.sheets[first.sheet], first.row - 1
    if row < 1 or first.column < 2 or sheet.cell(row, first.column - 1).value != "Example":
        return
    for name, heading in columns.items():
        value, example = sheet.cell(row, heading.column).value, section.entry(name).example
        # Examples are texts, of which that of an ID is the same in all workbooks.
        is_id = name == "id" and isinstance(value, str) and value != example
        if is_id or (isinstance(value, int | float) and not isinstance(value, bool)):
            text = f"the row Example has {cut(str(value))}, and is not read: enter your values"
            text += " below the headings"
            cell = f"{sheet.title}!{get_column_letter(heading.column)}{row}"
            yield replace(warning(f"example {sheet.title}", Place(section.key), text), cell=cell)
            return


def from_outside(book: OpenBook, place: Place) -> Iterator[Finding]:
    """Yield a warning if a workbook takes values from elsewhere: by DDE, or of other files."""
    if book.outside:
        names = (cut(link).encode("ascii", "replace").decode() for link in book.outside)
        which = listed(names, _MOST_LISTED)
        text = f"the workbook refers to other sources ({which}), whose saved values are"
        yield warning("outside", place, f"{text} used: type the values instead")


def not_calculated(book: OpenBook, used: Used, of_book: Place) -> Iterator[Finding]:
    """Yield a warning if the values of formulas may not follow from the cells they refer to."""
    says = book.calculation
    read = [(place, cell.address) for place, cell in used if cell.formula]
    # Written by Excel where calculation is manual, or was stopped (ECMA-376-1, 18.2.2).
    if says.get("calcCompleted", "1") in ("0", "false"):
        manual = " (calculation is manual)" if says.get("calcMode") == "manual" else ""
        why = f"was saved before its formulas were calculated{manual}"
    # So does a fresh one, which has such values only in formulas that are read.
    elif read and says.get("fullCalcOnLoad", "0") in ("1", "true"):
        why = "is set to recalculate when it is opened"
    else:
        return
    if read or any(scan.formulas for scan in book.scans.values()):
        place, cell = read[0] if read else (of_book, "")
        which = listed((address for _, address in read), _MOST_LISTED) or "its computed cells"
        text = f"the workbook {why}, and {which} may show previous values: calculate it (F9; in"
        text += " LibreOffice Ctrl+Shift+F9) and save it"
        yield replace(warning("calculation", place, text), cell=cell)
