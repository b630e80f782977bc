"""Tables of a document: rows of finished strings, and rows of an entity by the names of its fields.

Templates print these. Owns no content. Read `table_of`.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import groupby, islice
from operator import itemgetter
from typing import Any

from markupsafe import Markup

from report.assessment.verdict import Verdict
from report.entities.shown import Entity, Shown, TableColumn, UnitFormat, shown_by
from report.text.counts import LONGEST, grouped_by, joined, name_order, ranged
from report.text.units import Unit
from report.typeset.letters import width_em
from report.typeset.pdf import pieces
from solver.model import DefectError

# The format of a table without quantities in two systems of units.
PLAIN = UnitFormat(us_first=True, none="—")

# Of a column of names.
MOST_SHARE = 1.9
# Of the package, as its style sheet has them: width of a text, and type size of its tables.
TEXT_IN, TYPE_PT = 7.0, 8.5
_ROUNDING = 1.03  # the renderer sets letters a little wider than they are measured
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
    """A table, whose caption the template says; equal headings of adjacent columns are merged."""

    columns: tuple[TableColumn, ...]
    rows: tuple[TableRow, ...]
    kind: str = ""
    whole_rows: int = WHOLE_ROWS
    wide_in: float = TEXT_IN

    @property
    def heads(self) -> tuple[tuple[str, int, str, str], ...]:
        """Headings, with number of columns spanned, alignment and width."""
        widths = iter(self._widths)
        groups = [list(group) for _, group in groupby(self.columns, key=lambda c: c.head)]
        return tuple(
            (
                group[0].head,
                len(group),
                "center" if len(group) > 1 else group[0].align,
                f"{100.0 * sum(islice(widths, len(group))):.2f}%",
            )
            for group in groups
        )

    @property
    def fits(self) -> bool:
        """Whether no column is narrower than its widest word."""
        return sum(self._least) <= 1.0

    @property
    def _widths(self) -> list[float]:
        """Widths of the columns, of 1 in all: by their shares, but each as wide as its words."""
        shares = [column.share for column in self.columns]
        least = self._least if self.fits else [0.0] * len(shares)
        widened: set[int] = set()
        while True:
            others = sum(share for k, share in enumerate(shares) if k not in widened)
            room = (1.0 - sum(least[k] for k in widened)) / (others or 1.0)
            more = {k for k, share in enumerate(shares) if room * share < least[k]} - widened
            if not more:
                return [least[k] if k in widened else room * x for k, x in enumerate(shares)]
            widened |= more

    @cached_property
    def _least(self) -> list[float]:
        """Least width of each column, of 1 in all: of its widest word with its padding."""
        words: list[set[str]] = [set() for _ in self.columns]
        for _, cells in self.body:
            at = 0
            for text, _, span, _ in cells:
                if span == 1:
                    words[at].update(pieces(text))
                at += span
        whole = sum(column.share for column in self.columns)
        # A mark may hang out of the column before one of words.
        inner_pt, outer_pt = (9.0, 5.0) if "compact" in self.kind else (11.0, 6.0)
        least = []
        for k, (column, own) in enumerate(zip(self.columns, words, strict=True)):
            padding_pt = inner_pt if k and column.align == "left" else outer_pt
            # A key stands for a longer name; one more letter is the comma after one.
            wide_em = max((width_em(word) for word in own if len(word) <= LONGEST + 1), default=0.0)
            head_em = max(width_em(word, is_bold=True) for word in pieces(column.head))
            of_words, of_head = (
                (_ROUNDING * TYPE_PT * em + padding_pt) / (72.0 * self.wide_in)
                for em in (wide_em, head_em)
            )
            # A heading may stand out of its column, but no farther than it does by its share.
            least.append(max(of_words, min(of_head, column.share / whole)))
        return least

    @property
    def body(self) -> Sequence[tuple[str, Sequence[tuple[str, str, int, str]]]]:
        """Rows as style and cells: text, marks after it, columns spanned, alignment."""
        aligns = [column.align for column in self.columns]
        return [(row.kind, _placed(row.cells, aligns)) for row in self.rows]

    @property
    def hold(self) -> str:
        """Style that keeps a short table on one page and lets a long one break."""
        # A long one would leave most of a sheet empty above it.
        return "whole" if len(self.rows) <= self.whole_rows else "split"


def _placed(
    cells: Sequence[str | Wide], aligns: Sequence[str]
) -> Sequence[tuple[str, str, int, str]]:
    placed, at = [], 0
    for cell in cells:
        if isinstance(cell, Wide):
            placed.append((cell.text, "", cell.span, "left"))
            at += cell.span
            continue
        # Marks after a number hang outside the column, so that the digits stay aligned.
        text = cell.rstrip("†‡") if aligns[at] == "right" else cell
        placed.append((text, cell[len(text) :], 1, aligns[at]))
        at += 1
    if at != len(aligns):
        raise DefectError(f"a row of {at} columns in a table of {len(aligns)}: {cells[0]}")
    return placed


def stamp(value: Verdict, text: str = "") -> Markup:
    """Return a verdict, highlighted where it is not OK; that on the project as a text."""
    return Markup('<b class="{}">{}</b>').format(value.name.lower(), text or value)


def table_of(
    rows: Sequence[Entity],
    names: str,
    fmt: UnitFormat,
    *,
    kind: str = "",
    heads: Mapping[str, str] = {},
    shares: Mapping[str, float] = {},
    wide_in: float = TEXT_IN,
) -> Table:
    """Return rows of one entity as a table of the named fields, in that order.

    With `heads` and `shares` where this table has another heading or width than a field says.
    """
    fields = [(name, shown_by(type(rows[0]), name)) for name in names.split()] if rows else []
    columns = [
        replace(column, field=name)
        for name, shown in fields
        for column in shown.columns(fmt, heads.get(name, shown.head), shares.get(name, shown.share))
    ]
    units, made = {name: shown.units(fmt) for name, shown in fields}, []
    for row in rows:
        cells: list[str] = []
        for name, shown in fields:
            value, mark, show = getattr(row, name), row.marks.get(name, ""), row.rounds.get(name)
            text = stamp(value) if isinstance(value, Verdict) else value
            cells += shown.cells(text, fmt.none, units[name], mark, show)
        made.append(TableRow(cells=tuple(cells), kind=row.style))
    return Table(columns=tuple(columns), rows=tuple(made), kind=kind, wide_in=wide_in)


_Value = Callable[[Any], Any]
Column = tuple[Shown, _Value] | tuple[Shown, _Value, _Value]
"""How a column is shown, what gives its value for an item, and what its marks, if it has any.

A value that is `Wide` covers the columns that follow.
"""


def by_place(*heads: Shown) -> Sequence[Column]:
    """Return columns for items that are rows of values: each takes the value at its place."""
    return [(head, itemgetter(at)) for at, head in enumerate(heads)]


def headed(
    *columns: Sequence[Any], rows: Iterable[Sequence[Any]] = (), whole_rows: int = WHOLE_ROWS,
    kind: str = "",
) -> Table:  # fmt: skip
    """Return a table of a template, with rows of values or none, which `framed` then has.

    A column is its heading and share; its alignment if that is not left, and its unit if any.
    """

    def shown(head: str, share: float, align: str = "left", unit: str = "") -> Shown:
        return Shown(head=head, share=share, align=align, unit=unit)

    shown_columns = by_place(*(shown(*column) for column in columns))
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
    """Return items that are no entity as a table: each column says its heading and its value."""
    units = [shown.units(fmt) for shown, *_ in columns]
    return Table(
        columns=tuple(
            column
            for shown, *_ in columns
            for column in shown.columns(fmt, shown.head, shown.share)
        ),
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
    for (shown, value_of, *mark_of), of_column in zip(columns, units, strict=True):
        if covered:
            covered -= len(of_column)
            continue
        value = value_of(item)
        if isinstance(value, Wide):
            # Its own column counts with each of its units.
            covered = value.span - len(of_column)
            cells.append(value)
        else:
            mark = mark_of[0](item) if mark_of else ""
            cells += shown.cells(value, none, of_column, mark)
    return tuple(cells)


def grouped(groups: Mapping[str, Iterable[Any]], columns: Sequence[Column]) -> Table:
    """Return a compact table of the same, with a row that names each group of items."""
    table, rows = listed((), columns, kind="compact"), []
    for name, items in groups.items():
        rows.append(TableRow(cells=(Wide(name, len(table.columns)),), kind="total"))
        rows += listed(items, columns).rows
    return replace(table, rows=tuple(rows))


def compared_with(table: Table, cells: Sequence[str]) -> Table:
    """Return a table whose first row is the one that the others are compared with."""
    return replace(table, rows=(TableRow(cells=tuple(cells), kind="total"), *table.rows))


def merged(table: Table, *fields: str, once: bool = False) -> Table:
    """Return a table with one row for those that differ in names alone, which it lists.

    The names are in the columns of the fields, or with these headings; else in the first. Those of
    the others follow the first in their order, or are said `once` each, that count on as one.
    """
    names = [k for k, column in enumerate(table.columns) if (column.field or column.head) in fields]
    names = names if fields else [0]
    rows, columns = [], list(table.columns)

    def others(row: TableRow) -> tuple[object, ...]:
        cells = enumerate(row.cells)
        return row.kind, *(c for k, c in cells if k not in names or isinstance(c, Wide))

    for alike in grouped_by(table.rows, others).values():
        cells = list(alike[0].cells)
        # Those of one name beside each other: of a clearance both arrays.
        one_by_one = grouped_by(alike, lambda row: str(row.cells[names[0]]))
        # A9 before A10.
        firsts = sorted(one_by_one, key=name_order)
        for k in names if len(alike) > 1 else ():
            of_each = [joined([str(row.cells[k]) for row in one_by_one[name]]) for name in firsts]
            of_all = of_each if len(set(of_each)) > 1 else of_each[:1]
            own = firsts if k == names[0] else [str(row.cells[k]) for row in alike if once]
            cells[k] = said = ranged(own) or ", ".join(of_all)
            room = min(0.1 * len(said), MOST_SHARE)
            columns[k] = replace(columns[k], share=max(columns[k].share, room))
        rows.append(replace(alike[0], cells=tuple(cells)))
    return replace(table, columns=tuple(columns), rows=tuple(rows))
