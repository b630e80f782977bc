"""Tables of a document: rows of finished strings, built from items by a list of columns.

Templates print these. Owns no content. Read `listed`.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import groupby
from operator import itemgetter
from typing import Any

from markupsafe import Markup

from report.assessment.design.verdict import Verdict
from report.document.columns import ColumnHead, TableColumn
from report.text.grouping import grouped_by
from report.text.names import LONGEST, joined, name_order, ranged
from report.text.unit_format import UnitFormat
from report.text.units import Unit
from solver.errors import DefectError

# The format of a table without quantities in two systems of units.
PLAIN = UnitFormat(us_first=True, none="—")

# Of a column of names.
MOST_SHARE = 1.9
# Letters of a word that is never broken, also in the narrow table beside a plan.
WHOLE_WORD, NARROW_WORD = 16, 8
# Columns at the left that may have names, and letters of one that is given more room.
NAMED, LONG_NAME = 3, 16
# Longer tables may break across pages, with the heading repeated.
WHOLE_ROWS = 6


@dataclass(frozen=True, slots=True)
class Wide:
    """A cell that spans several columns, left-aligned."""

    text: str
    span: int


@dataclass(frozen=True, slots=True, kw_only=True)
class TableRow:
    """A row of formatted strings; `kind` is its style, such as total."""

    cells: tuple[str | Wide, ...]
    kind: str = ""


@dataclass(frozen=True, kw_only=True)
class Table:
    """A table, captioned by its template; equal headings of adjacent columns are merged."""

    columns: tuple[TableColumn, ...]
    rows: tuple[TableRow, ...]
    kind: str = ""
    whole_rows: int = WHOLE_ROWS
    is_narrow: bool = False

    @property
    def heads(self) -> tuple[tuple[str, int, str, str], ...]:
        """Headings, with number of columns spanned, alignment and width."""
        columns = [replace(column, share=self._share(k)) for k, column in enumerate(self.columns)]
        total_share = sum(column.share for column in columns)
        groups = [list(group) for _, group in groupby(columns, key=lambda c: c.head)]
        return tuple(
            (
                group[0].head,
                len(group),
                "center" if len(group) > 1 else group[0].align,
                # The renderer widens a column to its longest word.
                f"{100.0 * sum(column.share for column in group) / total_share:.2f}%",
            )
            for group in groups
        )

    def _share(self, k: int) -> float:
        """Return the share of a column: larger for long names, so that each fits on two lines."""
        share = self.columns[k].share
        full_rows = (row for row in self.rows if not any(type(cell) is Wide for cell in row.cells))
        cells = [_letters(row.cells[k]) for row in full_rows]
        longest = max(map(len, cells), default=0)
        # Names are in the first columns; what is longer than any name is a sentence.
        is_named = k < NAMED and self.columns[k].align == "left"
        if not is_named or not LONG_NAME < longest <= 2 * LONGEST:
            return share
        return max(share, 0.055 * longest)

    @property
    def body(self) -> Sequence[tuple[str, Sequence[tuple[str, str, int, str]]]]:
        """Rows as style and cells: text, marks after it, columns spanned, style."""
        aligns = [column.align for column in self.columns]
        longest_word = NARROW_WORD if self.is_narrow else WHOLE_WORD
        return [(row.kind, _placed(row.cells, aligns, longest_word)) for row in self.rows]

    @property
    def hold(self) -> str:
        """Style that keeps a short table on one page and lets a long one break."""
        # A long one would leave most of a sheet empty above it.
        return "whole" if len(self.rows) <= self.whole_rows else "split"


def _placed(
    cells: Sequence[str | Wide], aligns: Sequence[str], whole_word: int
) -> Sequence[tuple[str, str, int, str]]:
    placed, place = [], 0
    for cell in cells:
        if isinstance(cell, Wide):
            placed.append((cell.text, "", cell.span, "left"))
            place += cell.span
            continue
        # Marks after a number hang outside the column, so that the digits stay aligned.
        text = cell.rstrip("†‡") if aligns[place] == "right" else cell
        longest = max(map(len, _letters(text).split()), default=0)
        is_long = aligns[place] == "left" and longest > whole_word
        style = f"{aligns[place]} long" if is_long else aligns[place]
        placed.append((text, cell[len(text) :], 1, style))
        place += 1
    # A cell too many would move every number after it under another heading.
    if place != len(aligns):
        raise DefectError(f"a row of {place} columns in a table of {len(aligns)}: {cells[0]}")
    return placed


def _letters(cell: object) -> str:
    """Return the visible length of a cell, without tags."""
    return cell.striptags() if isinstance(cell, Markup) else str(cell)


def stamp(value: Verdict, text: str = "") -> Markup:
    """Return a verdict, highlighted if it is not OK; that on the project as text."""
    return Markup('<b class="{}">{}</b>').format(value.name.lower(), text or value)


_Value = Callable[[Any], Any]
Column = (
    tuple[ColumnHead, _Value]
    | tuple[ColumnHead, _Value, _Value]
    | tuple[ColumnHead, _Value, _Value, _Value]
)
"""The head of a column, and what gives for an item its value, its marks, and how it is rounded.

A value that is `Wide` covers the columns that follow.
"""


def by_place(*heads: ColumnHead) -> Sequence[Column]:
    """Return columns for items that are rows of values: each uses the value at its index."""
    return [(head, itemgetter(place)) for place, head in enumerate(heads)]


def headed(
    *columns: Sequence[Any], rows: Iterable[Sequence[Any]] = (), whole_rows: int = WHOLE_ROWS,
    kind: str = "",
) -> Table:  # fmt: skip
    """Return a table of rows of values.

    A column is its heading and share; its alignment if that is not left, and its unit if any.
    """

    def head_of(head: str, share: float, align: str = "left", unit: str = "") -> ColumnHead:
        return ColumnHead(head=head, share=share, align=align, unit=unit)

    shown_columns = by_place(*(head_of(*column) for column in columns))
    return listed(rows, shown_columns, kind=kind, whole_rows=whole_rows)


def listed(
    items: Iterable[Any],
    columns: Sequence[Column],
    fmt: UnitFormat = PLAIN,
    *,
    kind: str = "",
    whole_rows: int = WHOLE_ROWS,
    style: Callable[[Any], str] = lambda _: "",
) -> Table:
    """Return items as a table: each column supplies its heading and its values."""
    units = [head.units(fmt) for head, *_ in columns]
    return Table(
        columns=tuple(column for head, *_ in columns for column in head.columns(fmt)),
        rows=tuple(
            TableRow(cells=_listed_cells(item, columns, units, fmt.none), kind=style(item))
            for item in items
        ),
        kind=kind,
        whole_rows=whole_rows,
    )


def _listed_cells(
    item: Any, columns: Sequence[Column], units: Sequence[Sequence[Unit]], none: str
) -> tuple[str | Wide, ...]:
    cells: list[str | Wide] = []
    covered = 0
    for (head, value_of, *functions), of_column in zip(columns, units, strict=True):
        if covered:
            covered -= len(of_column)
            continue
        value = value_of(item)
        if isinstance(value, Wide):
            # Its own column counts with each of its units.
            covered = value.span - len(of_column)
            cells.append(value)
        else:
            mark, show = [function(item) for function in functions] + ["", None][len(functions) :]
            text = stamp(value) if isinstance(value, Verdict) else value
            cells += head.cells(text, none, of_column, mark, show)
    return tuple(cells)


def grouped(
    groups: Mapping[str, Iterable[Any]], columns: Sequence[Column], fmt: UnitFormat = PLAIN
) -> Table:
    """Return a compact table of the same, with a row that names each group of items."""
    table, rows = listed((), columns, fmt, kind="compact"), []
    for name, items in groups.items():
        rows.append(TableRow(cells=(Wide(name, len(table.columns)),), kind="total"))
        rows += listed(items, columns, fmt).rows
    return replace(table, rows=tuple(rows))


def part_of(table: Table, start: int, stop: int | None = None, *, is_narrow: bool = False) -> Table:
    """Return rows of a table as one of their own."""
    return replace(table, rows=table.rows[start:stop], is_narrow=is_narrow)


def compared_with(table: Table, cells: Sequence[str]) -> Table:
    """Return a table whose first row is the reference for the others."""
    return replace(table, rows=(TableRow(cells=tuple(cells), kind="total"), *table.rows))


def closed_by(table: Table, cells: Sequence[str]) -> Table:
    """Return a table with one more row, set off from the others."""
    return replace(table, rows=(*table.rows, TableRow(cells=tuple(cells), kind="total")))


def merged(table: Table, *heads: str, once: bool = False) -> Table:
    """Return a table with one row for rows that differ only in names, which it lists.

    The names are in the columns with these headings, else in the first. Those of
    the others follow the first in their order, or are said `once` each, that count on as one.
    """
    names = [k for k, column in enumerate(table.columns) if column.head in heads] or [0]
    rows, columns = [], list(table.columns)

    def unnamed_cells(row: TableRow) -> tuple[object, ...]:
        cells = enumerate(row.cells)
        return row.kind, *(c for k, c in cells if k not in names or isinstance(c, Wide))

    for alike in grouped_by(table.rows, unnamed_cells).values():
        cells = list(alike[0].cells)
        # Those of one name beside each other: of a clearance both arrays.
        one_by_one = grouped_by(alike, lambda row: str(row.cells[names[0]]))
        # A9 before A10.
        firsts = sorted(one_by_one, key=name_order)
        for k in names if len(alike) > 1 else ():
            of_each = [joined([str(row.cells[k]) for row in one_by_one[name]]) for name in firsts]
            of_all = of_each if len(set(of_each)) > 1 else of_each[:1]
            listed_names = firsts if k == names[0] else [str(row.cells[k]) for row in alike if once]
            cells[k] = label = ranged(listed_names) or ", ".join(of_all)
            room = min(0.1 * len(label), MOST_SHARE)
            columns[k] = replace(columns[k], share=max(columns[k].share, room))
        rows.append(replace(alike[0], cells=tuple(cells)))
    return replace(table, columns=tuple(columns), rows=tuple(rows))
