"""Shared by the sheets of results.xlsx: formats, and rows of an entity written as cells.

Owns no content: see `report.results.xlsx`. Read `SheetRow`, then `write_rows`.
"""

from __future__ import annotations

import datetime as dt
import math
from collections.abc import Iterable, Mapping, Sequence
from functools import cache
from io import BytesIO
from typing import Any, ClassVar, Self

from xlsxwriter.format import Format
from xlsxwriter.utility import xl_col_to_name
from xlsxwriter.workbook import Workbook
from xlsxwriter.worksheet import Worksheet

from report.assessment.overrides import OVERRIDDEN
from report.entities.cells import Column
from report.entities.columns import NO_VALUE
from report.entities.shown import Entity, columns_of

TOP = 5
"""First row below the headings of a sheet with a title."""

_INPUT = {"bg_color": "#FFF7CC", "border": 4}
"""Format of a cell that may be changed."""

_LETTER = 1


class SheetRow(Entity):
    """A row of a sheet: an entity, and what the formulas of its fields take from elsewhere.

    Attributes
    ----------
    refs : mapping
        Cells elsewhere, by the name that formulas give them.
    formulas : mapping of str to str
        Those of this row, by field, in place of that of its first column; empty for none.
    blanks : frozenset of str
        Fields without a cell in this row.
    """

    sheet: ClassVar[str]

    refs: Mapping[str, Any] = {}
    formulas: Mapping[str, str] = {}
    blanks: frozenset[str] = frozenset()

    @classmethod
    def beside(cls, row: Entity, **more: Any) -> Self:
        """Return an entity as a row, with what its sheet has beside it, or in place of it."""
        return cls.model_validate(dict(row) | more)


class Cells:
    """The cells of a row, or of several, by the names of the fields."""

    def __init__(self, model: type[SheetRow], first: int, last: int = 0, *, is_here: bool = False):
        self._letters, self._first, self._last = _letters(model), first, last
        self._sheet = "" if is_here else f"{model.sheet}!"

    def __getattr__(self, name: str) -> str:
        letter = self._letters[name]
        to = f":{letter}{self._last}" if self._last else ""
        return f"{self._sheet}{letter}{self._first}{to}"


def fixed(model: type[SheetRow], name: str, row: int) -> str:
    """Return the cell of a field, which stays the same where a formula is copied."""
    return f"{model.sheet}!${_letters(model)[name]}${row}"


@cache
def _letters(model: type[SheetRow]) -> Mapping[str, str]:
    """Return the letter of the first column of each field."""
    names = [name for name, _, _ in columns_of(model)]
    return {name: xl_col_to_name(names.index(name)) for name in names}


def typed(value: float) -> float:
    """Return a number as it was typed: without the rounding error of a conversion of units."""
    return float(f"{value:.12g}")


def print_on_letter(sheet: Worksheet, heading_row: int) -> None:
    """Print a sheet as wide as a landscape page, with its headings on each."""
    sheet.set_landscape()
    sheet.set_paper(_LETTER)
    sheet.set_margins(left=0.4, right=0.4, top=0.6, bottom=0.6)
    sheet.fit_to_pages(1, 0)
    sheet.repeat_rows(heading_row)
    sheet.set_footer("&L&F, &A&RPage &P of &N")


def text_workbook(buffer: BytesIO, date: dt.date, title: str = "") -> Workbook:
    """Return a workbook to write, in which text from an untrusted one is never a formula or link.

    Two runs give the same bytes: its date is that of the project, not the current date.
    """
    as_text = ("strings_to_formulas", "strings_to_urls", "strings_to_numbers")
    workbook = Workbook(buffer, dict.fromkeys(as_text, False) | {"nan_inf_to_errors": True})
    workbook.set_properties({"title": title, "created": dt.datetime.combine(date, dt.time())})
    return workbook


class Pages:
    """The formats that all sheets share."""

    def __init__(self, workbook: Workbook):
        self.workbook = workbook
        self.title = workbook.add_format({"bold": True, "font_size": 14})
        self.head = workbook.add_format(
            {"bold": True, "bottom": 1, "text_wrap": True, "valign": "top"}
        )
        self.note = workbook.add_format({"italic": True, "font_color": "#555555"})
        self.typed_text = workbook.add_format(_INPUT)
        self._numbers: dict[tuple[int, bool, bool], Format] = {}

    def number(
        self, decimals: int | None, mark: str = "", *, is_input: bool = False
    ) -> Format | None:
        """Return the format of a number, with its mark, which leaves it a number."""
        if decimals is None:
            return None
        key = (decimals, bool(mark), is_input)
        if key not in self._numbers:
            code = f"{0:.{decimals}f}" + (f'"{OVERRIDDEN}"' if mark else "")
            fill = _INPUT if is_input else {}
            self._numbers[key] = self.workbook.add_format({"num_format": code} | fill)
        return self._numbers[key]

    def sheet(self, name: str, title: str, note: str) -> Worksheet:
        """Return a sheet with its heading written."""
        sheet: Worksheet = self.workbook.get_worksheet_by_name(name)
        sheet.write_string(0, 0, title, self.title)
        sheet.write_string(1, 0, note, self.note)
        return sheet


def write_headings(pages: Pages, sheet: Worksheet, row: int, headings: Sequence[str]) -> None:
    """Write a row of headings and freeze it."""
    sheet.write_row(row, 0, headings, pages.head)
    sheet.set_row(row, 48)
    sheet.set_column(0, len(headings) - 1, 13)
    sheet.freeze_panes(row + 1, 1)
    print_on_letter(sheet, row)


def write_live(
    pages: Pages, model: type[SheetRow], rows: Sequence[SheetRow], title: str, note: str
) -> Worksheet:
    """Write rows as a sheet with live formulas."""
    sheet = pages.sheet(model.sheet, title, note)
    write_headings(pages, sheet, TOP - 2, _headings(model))
    write_rows(pages, sheet, TOP, rows)
    return sheet


def write_rows(pages: Pages, sheet: Worksheet, top: int, rows: Iterable[SheetRow]) -> None:
    """Write rows from a row of a sheet on: each formula with the value that it gives."""
    for number, row in enumerate(rows, start=top):
        letters = _letters(type(row))
        own = {name: f"{letter}{number}" for name, letter in letters.items()}
        for at, (name, _, column) in enumerate(columns_of(type(row))):
            if name in row.blanks:
                continue
            # A field may have several columns: the formula of a row is that of the first.
            is_first = letters[name] == xl_col_to_name(at)
            formula = row.formulas.get(name, column.formula) if is_first else column.formula
            formula = formula.format(**own, **row.refs)
            _write(pages, sheet, (number - 1, at), row, name, column, formula)


def _write(
    pages: Pages,
    sheet: Worksheet,
    place: tuple[int, int],
    row: SheetRow,
    name: str,
    column: Column,
    formula: str,
) -> None:
    value = _finite(_value(row, name, column))
    is_input = column.is_input and not formula
    shown = pages.number(column.decimals, row.marks.get(name, ""), is_input=is_input)
    if formula and (column.is_always or value != NO_VALUE):
        sheet.write_formula(*place, formula, shown, value)
    elif isinstance(value, str):
        sheet.write_string(*place, value, pages.typed_text if is_input else None)
    else:
        sheet.write_number(*place, typed(value) if is_input else value, shown)


def write_list(pages: Pages, name: str, rows: Sequence[Entity]) -> None:
    """Write entities as a sheet without formulas."""
    model = type(rows[0])
    columns = [
        [_value(row, field, column) for row in rows] for field, _, column in columns_of(model)
    ]
    write_table(pages, name, dict(zip(_headings(model), columns, strict=True)))


def write_table(pages: Pages, name: str, table: Mapping[str, Sequence[Any]]) -> None:
    """Write columns by heading as a sheet, as wide as their texts."""
    sheet = pages.workbook.add_worksheet(name)
    sheet.freeze_panes(1, 0)
    print_on_letter(sheet, 0)
    for at, (heading, values) in enumerate(table.items()):
        texts = [heading, *map(str, values[:50])]
        is_number = all(isinstance(value, float) for value in values)
        width = 11 if is_number else min(max(map(len, texts)) + 2, 66)
        sheet.set_column(at, at, width, pages.number(3) if is_number else None)
        sheet.write_string(0, at, heading, pages.head)
        sheet.write_column(1, at, map(_finite, values))


def _headings(model: type[Entity]) -> Sequence[str]:
    return [heading for _, heading, _ in columns_of(model)]


def _value(row: Entity, name: str, column: Column) -> Any:
    """Return the value of a field in the unit of its column."""
    value = getattr(row, name)
    if value is None:
        return "not given"
    return column.held(value)


def _finite(value: Any) -> Any:
    """Return what a cell holds of a value: a text for a number that a workbook does not have."""
    if isinstance(value, float) and not math.isfinite(value):
        return NO_VALUE if math.isnan(value) else str(value)
    return value
