"""Shared by the sheets of results.xlsx: columns, and rows written as their cells.

Owns no content: see `report.results.xlsx`. Read `SheetColumn`, then `write_rows`.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Collection, Iterable, Mapping, Sequence
from dataclasses import KW_ONLY, dataclass, field, replace
from functools import cached_property, partial
from typing import Any

from xlsxwriter.utility import xl_col_to_name
from xlsxwriter.worksheet import Worksheet

from report.results.sheet_pages import TOP, Pages, lay_out
from report.text.unit_format import NO_VALUE
from report.text.units import NEWTONS_PER_POUND, NOISE, Rounding, spaced
from solver.model import INCH_M

# What a value in SI is in the units of a sheet; a value in another unit stays as it is.
_FROM_SI: Mapping[str, Callable[[Any], Any]] = {
    "in": lambda value_m: value_m / INCH_M,
    "mm": lambda value_m: value_m * 1e3,
    "lb": lambda value_n: value_n / NEWTONS_PER_POUND,
    "in/s": lambda value_mps: value_mps / INCH_M,
}

# A cell as the package prints it; in Excel ROUNDUP rounds away from zero.
_ROUNDED_UP = (
    '=IF(ISTEXT({{{name}}}),"none",MAX(0,ROUNDUP({{{name}}}{times}-{noise:.0e},{decimals})))'
)


@dataclass(frozen=True, slots=True)
class SheetColumn:
    """A column of a sheet: its name in formulas, its heading, its value for an item."""

    name: str  # a second column of one name has the same in another unit
    head: str  # with its unit
    value: Callable[[Any], Any]  # of the item of a row; in SI, converted by the unit in the heading
    decimals: int | None = None  # of a number; None to show it as it is
    formula: str = ""  # live, with names of columns and of other cells in braces; empty for none
    _: KW_ONLY
    is_always: bool = False  # whether the formula is written also where it gives no value
    is_input: bool = False  # whether what has no formula may be changed there
    # of what is shown: formulas take the exact value, from a column at the end of the row
    rounding: Rounding = Rounding.NEAREST

    def held(self, item: Any) -> Any:
        """Return the value of an item for a cell."""
        value = self.value(item)
        if value is None:
            return "not entered"
        # By the unit in the heading, so that heading and number cannot differ.
        convert = _FROM_SI.get(self.unit)
        converted = convert(value) if convert and not isinstance(value, str) else value
        is_rounded = self.rounding is not Rounding.NEAREST
        return self.rounding.of(converted, self.decimals or 0) if is_rounded else converted

    @property
    def unit(self) -> str:
        """The unit in the heading."""
        return self.head.partition("[")[2].rstrip("]")

    def rounded(self) -> SheetColumn:
        """Return it as a column that is rounded from the exact one of its name."""
        # A value that is rounding error above a printed one is that one: 24.00000001 prints 24.0,
        # as in the PDF.
        noise = NOISE / 10.0 ** (self.decimals or 0)
        times = "*25.4" if self.unit == "mm" else ""
        formula = _ROUNDED_UP.format(
            name=self.name, times=times, noise=noise, decimals=self.decimals
        )
        return replace(self, formula=formula)

    def exact(self) -> SheetColumn:
        """Return the exact column of its name."""
        head, _, unit = self.head.partition(" [")
        head = f"{head}, unrounded [{unit}" if unit else f"{head}, unrounded"
        return replace(self, head=head, decimals=None, rounding=Rounding.NEAREST)


up_column = partial(SheetColumn, rounding=Rounding.UP)
"""A column of a demand, or of what is required: rounded up."""


@dataclass(frozen=True)
class SheetLayout:
    """The columns of a sheet with formulas."""

    sheet: str
    own: Sequence[SheetColumn]
    key_columns: int = 1  # that say which row it is: they stay in sight, and stand on every page
    # Name of the last on paper; those after it, and unrounded values, are to be traced on a screen.
    last_printed: str = ""

    @cached_property
    def columns(self) -> Sequence[SheetColumn]:
        """The columns, with the exact one of each name that is rounded up at the end."""
        columns: list[SheetColumn] = []
        exact: dict[str, SheetColumn] = {}
        for column in self.own:
            is_up = column.rounding is Rounding.UP
            columns.append(column.rounded() if is_up else column)
            if is_up:
                exact.setdefault(column.name, column.exact())
        return *columns, *exact.values()

    @cached_property
    def letters(self) -> Mapping[str, str]:
        """The letter of the first column of each name."""
        names = [column.name for column in self.columns]
        # Of a value that is shown rounded up, that of its exact column, the last.
        exact = {column.name for column in self.own if column.rounding is Rounding.UP}
        places = {name: place for place, name in enumerate(names) if name in exact}
        return {name: xl_col_to_name(places.get(name, names.index(name))) for name in names}

    @property
    def n_printed(self) -> int | None:
        """Number of columns that print; None for all."""
        names = [column.name for column in self.columns]
        return names.index(self.last_printed) + 1 if self.last_printed else None

    def fixed(self, name: str, row: int) -> str:
        """Return the cell of a column, which stays the same where a formula is copied."""
        return f"{self.sheet}!${self.letters[name]}${row}"

    def printed(self, item: Any, name: str) -> float | str:
        """Return the value of an item for the first cell of a name."""
        column = next(column for column in self.columns if column.name == name)
        value: float | str = written(column.held(item))
        return value


@dataclass(frozen=True, slots=True, kw_only=True)
class SheetRow:
    """A row of a sheet: what its columns hold a part of, and what is of this row alone."""

    item: Any
    refs: Mapping[str, Any] = field(default_factory=dict)  # cells elsewhere, by name in formulas
    # those of this row, by column, in place of that of the first of its name; empty for none
    formulas: Mapping[str, str] = field(default_factory=dict)
    blanks: Collection[str] = ()  # columns without a cell in this row
    marks: Mapping[str, str] = field(default_factory=dict)  # of overrides, by column


class Cells:
    """The cells of a row, or of several, by the names of the columns."""

    def __init__(self, layout: SheetLayout, first: int, last: int = 0, *, is_here: bool = False):
        self._layout, self._first, self._last = layout, first, last
        self._sheet = "" if is_here else f"{layout.sheet}!"

    def __getattr__(self, name: str) -> str:
        letter = self._layout.letters[name]
        return self._range(letter)

    def printed(self, name: str) -> str:
        """Return the cells of a column as they print: rounded up where it is."""
        names = [column.name for column in self._layout.columns]
        return self._range(xl_col_to_name(names.index(name)))

    def _range(self, letter: str) -> str:
        end = f":{letter}{self._last}" if self._last else ""
        return f"{self._sheet}{letter}{self._first}{end}"


def typed(value: float) -> float:
    """Return a number as it was typed."""
    # Without the rounding error of a conversion of units.
    return float(f"{value:.12g}")


def write_live(
    pages: Pages, layout: SheetLayout, rows: Sequence[SheetRow], title: str, note: str
) -> Worksheet:
    """Write rows as a sheet with live formulas."""
    columns = layout.columns
    texts = [[_shown(column.held(row.item), column.decimals) for column in columns] for row in rows]
    headings = [column.head for column in columns]
    sheet = pages.sheet(
        layout.sheet, title, note, headings, texts, layout.key_columns, layout.n_printed
    )
    write_rows(pages, sheet, layout, TOP, rows)
    return sheet


def write_rows(
    pages: Pages, sheet: Worksheet, layout: SheetLayout, top: int, rows: Iterable[SheetRow]
) -> None:
    """Write rows from a row of a sheet on: each formula with its value."""
    for number, row in enumerate(rows, start=top):
        cells = {name: f"{letter}{number}" for name, letter in layout.letters.items()}
        for place, column in enumerate(layout.columns):
            if column.name in row.blanks:
                continue
            # A name may have several columns: the formula of a row is that of the first.
            is_first = layout.letters[column.name] == xl_col_to_name(place)
            formula = row.formulas.get(column.name, column.formula) if is_first else column.formula
            formula = formula.format(**cells, **row.refs)
            _write(pages, sheet, (number - 1, place), row, column, formula)


def _write(
    pages: Pages,
    sheet: Worksheet,
    place: tuple[int, int],
    row: SheetRow,
    column: SheetColumn,
    formula: str,
) -> None:
    value = written(column.held(row.item))
    is_input = column.is_input and not formula
    look = pages.number(column.decimals, row.marks.get(column.name, ""), is_input=is_input)
    if isinstance(value, str) and column.decimals is None:
        look = pages.typed_text if is_input else pages.text
    # Without a value there is nothing for the formula to be compared with, unless a yellow cell
    # may give it one.
    if formula and (column.is_always or value != NO_VALUE):
        # With its value: a program that computes nothing shows it, too.
        sheet.write_formula(*place, formula, look, value)
    elif isinstance(value, str):
        sheet.write_string(*place, value, look)
    else:
        sheet.write_number(*place, typed(value) if is_input else value, look)


def write_list(
    pages: Pages,
    name: str,
    columns: Sequence[SheetColumn],
    items: Sequence[Any],
    keys: int = 1,
    *,
    is_printed: bool = True,
) -> None:
    """Write items as a sheet without formulas."""
    table = {column.head: [column.held(item) for item in items] for column in columns}
    decimals = {column.head: column.decimals for column in columns}
    write_table(pages, name, table, keys, decimals, is_printed=is_printed)


def write_table(
    pages: Pages,
    name: str,
    table: Mapping[str, Sequence[Any]],
    keys: int = 1,
    own_decimals: Mapping[str, int | None] = {},
    *,
    is_printed: bool = True,
) -> None:
    """Write columns by heading as a sheet."""
    sheet: Worksheet = pages.workbook.get_worksheet_by_name(name)
    decimals = [
        (own_decimals.get(heading) or 3)
        if all(isinstance(value, float) for value in values)
        else None
        for heading, values in table.items()
    ]
    texts = [list(map(_shown, row, decimals)) for row in zip(*table.values(), strict=True)]
    lay_out(pages, sheet, 0, list(table), texts, keys, None if is_printed else 0)
    for place, (values, digits) in enumerate(zip(table.values(), decimals, strict=True)):
        is_text = any(isinstance(value, str) for value in values)
        look = pages.text if is_text else pages.number(digits)
        sheet.write_column(1, place, map(written, values), look)


def _shown(value: Any, decimals: int | None) -> str:
    """Return the text shown in a cell."""
    number = written(value)
    if isinstance(number, float) and decimals is not None:
        return f"{number:.{decimals}f}"
    # As the format General shows it.
    return f"{number:.9g}" if isinstance(number, float) else str(number)


def written(value: Any) -> Any:
    """Return the content of a cell: ordinary spaces, and text if there is no number."""
    if isinstance(value, float) and not math.isfinite(value):
        return NO_VALUE if math.isnan(value) else str(value)
    return spaced(value) if isinstance(value, str) else value
