"""Converts the content of a cell to the value of a field, or to an error message.

Independent of sheets and files: `locate` finds the cells.
"""

from __future__ import annotations

import math
import re
import sys
from collections.abc import Mapping
from dataclasses import dataclass
from datetime import date, datetime, time, timedelta
from enum import StrEnum
from typing import Any

from openpyxl.utils.datetime import WINDOWS_EPOCH
from openpyxl.utils.escape import unescape

from report.project.model.choices import SlopeUnit, YesNo
from report.project.read.number_formats import is_percentage, misleading
from report.project.read.typed_text import (
    choice_in,
    dates_in,
    in_thousands,
    inches_in,
    number_in,
    rise_in,
)
from report.project.workbook.entries import Entry
from report.text.typed_letters import SHOWN, UNPRINTABLE, cut, trimmed
from report.text.units import LENGTHS, with_unit
from solver.errors import InputError, Problem
from solver.model import INCH_M

_WITH_UNIT = re.compile(
    r"[+-]?[0-9]+(?:\.[0-9]*)?\s*(?:[A-Za-z]{1,4}|['\"°%]|''|[A-Za-z]+/[A-Za-z0-9]+)\.?"
)
# ECMA-376-1, 22.9.2.19 (ST_Xstring): `_xHHHH_` in the text of a cell is a character by its number.
_ESCAPE = re.compile(r"_(?=x[0-9A-Fa-f]{4}_)")
# A date before it is refused, as by the sheet's own check.
EARLIEST = date(2000, 1, 1)
# Numbers in the cell of a date that are days since 1899-12-30: of the years 2000 to 2099.
EARLIEST_DAY, LATEST_DAY = 36526, 73050
# Magnitude above which a number is refused, so that no change of units can overflow.
LARGEST = 1e15


class CellError(InputError):
    """A cell with invalid content; the message has the form `is ...; enter ...`."""

    def __init__(self, fault: str, remedy: str = "") -> None:
        super().__init__(Problem(fault, remedy))


@dataclass(frozen=True, slots=True, kw_only=True)
class Found:
    """The content of a cell."""

    sheet: str
    cell: str
    value: Any  # as typed; for a formula, the last computed value
    formula: str = ""
    is_error: bool = False  # the value is one of Excel, such as #DIV/0!
    number_format: str = "General"
    day_zero: datetime = WINDOWS_EPOCH  # from which the workbook counts days

    @property
    def address(self) -> str:
        """Its address: `Arrays!D7`."""
        return f"{self.sheet}!{self.cell}"

    @property
    def is_blank(self) -> bool:
        """Whether nothing visible was typed."""
        return self.is_empty and not self.formula

    @property
    def is_empty(self) -> bool:
        """Whether it shows nothing: blank, or a formula whose value is an empty text."""
        if self.value is None:
            return not self.formula
        return isinstance(self.value, str) and not trimmed(self.value)

    @property
    def shown(self) -> str:
        """Its value as a user would type it; empty for none."""
        return "" if self.value is None else plain(self.value)

    @property
    def text(self) -> str:
        """The typed content, for the echo; for a formula, with its value."""
        return f"{self.formula} → {self.shown}" if self.formula else self.shown


def plain(value: object) -> str:
    """Return a cell's value as a user would type it."""
    match value:
        case bool():
            return "TRUE" if value else "FALSE"
        case datetime() if value.time() == time():
            return value.date().isoformat()
        case float() if value.is_integer() and abs(value) < 1e15:
            return str(int(value))
        case float():
            return f"{value:.15g}"  # the digits that a spreadsheet keeps of what was typed
        case date() | time():
            return value.isoformat()
        case _:
            return str(value)


def escaped(text: str) -> str:
    """Return a text as it is written to a cell: else a spreadsheet reads `_x0041_` as A."""
    return _ESCAPE.sub("_x005F_", text)


def as_used(value: object, entry: Entry, unit: str) -> str:
    """Return a field's value for the echo, with its unit: that of SI where it can be chosen."""
    if entry.quantity:
        unit = next(symbol for symbol, si in entry.quantity.accepted.items() if si == 1.0)
    if isinstance(value, bool):
        return str(YesNo.YES if value else YesNo.NO)
    if isinstance(value, float):
        return (entry.zero if value == 0.0 else "") or with_unit(f"{value:.6g}", unit)
    return "" if value is None else plain(value)


def stated_unit(entry: Entry, row: Mapping[str, Any], cells: Mapping[str, Found]) -> str:
    """Return the unit of a number stated in another cell; empty if none."""
    if entry.unit_from is None:
        return ""
    name, unit_of = entry.unit_from
    # That cell is among what was read of the row so far, or among the cells of the row.
    text = row[name] if name in row else cells[name].value if name in cells else None
    return "" if text is None else unit_of(plain(text).strip())


def read_cell(cell: Found, entry: Entry, unit: str, si: float, stated: str = "") -> Any:
    """Return a field's value in SI from a cell that is not blank.

    `unit` is the unit of the number in the cell, for messages, `si` its size, and `stated` what
    another cell says of the unit of a number that has none of its own.

    Raises `CellError`.
    """
    check_saved(cell)
    remedy = wish(entry, unit, si)
    text = trimmed(cell.value) if isinstance(cell.value, str) else ""
    # Marks of feet and inches say their own unit, whatever the column has.
    is_length = entry.quantity is not None and entry.quantity.accepted is LENGTHS
    inches = inches_in(text) if is_length else math.nan
    value: Any
    if entry.kind is date:
        value = _date(cell, remedy)
    elif entry.choices:
        value = _choice(cell, entry, remedy)
    elif entry.kind is str:
        value = _text(cell)
    elif entry.zero and text.casefold() == entry.zero:
        value = 0.0
    elif math.isfinite(inches):
        # Over the unit of the column, by which all numbers are multiplied below.
        value = inches * INCH_M / si
    else:
        value = number(cell, remedy, unit or stated)
        # Excel stores every number as a floating-point one: 6 stories are 6.0.
        value = int(value) if entry.kind is int and value.is_integer() else value
    if isinstance(value, float):
        value *= si
    # Not `>`: NaN is refused as well.
    if isinstance(value, float | int) and not abs(value) <= LARGEST:
        raise CellError(_is(cell, entry), f"{remedy}, below {LARGEST:g} in size")
    if not entry.accepts(value):
        raise CellError(_is(cell, entry), remedy)
    return entry.key_of(value) if entry.kind is str else value


def blank_value(entry: Entry, row: Mapping[str, Any]) -> Any:
    """Return the value of a blank cell, from the fields of its row that were read before it."""
    value = entry.computed(row) if entry.computed else None
    return entry.default if value is None else value


def check_saved(cell: Found) -> None:
    """Raise if a cell contains an Excel error, or a formula that was never computed."""
    if cell.is_error:
        cause = f" (from {cut(cell.formula)})" if cell.formula else ""
        raise CellError(f"is {cell.value}{cause}", "correct the formula, or type a value")
    # Libraries write formulas without values; a spreadsheet saves both.
    if cell.formula and cell.value is None:
        raise CellError(
            f"is a formula with no saved value ({cut(cell.formula)})",
            "open the workbook in Excel or LibreOffice and save it",
        )


def wish(entry: Entry, unit: str = "", si: float = 1.0) -> str:
    """Return the accepted input of a field: `enter a number from 0 to 1.5`."""
    if entry.choices:
        return f"choose {', '.join(entry.choices[:-1])} or {entry.choices[-1]}"
    if entry.kind in (int, float):
        noun = "a whole number" if entry.kind is int else "a number"
        span = entry.bounds.words(si)
        if span:
            is_closed = math.isfinite(entry.bounds.low) and math.isfinite(entry.bounds.high)
            start = "from " if is_closed else "of "
            span = f" {span}" if entry.bounds.excludes_low else f" {start}{span}"
        return f"enter {noun}{span}" + (f" [{unit}]" if unit else "") + entry.or_zero
    if entry.kind is date:
        return "enter a date such as 2026-03-05"
    return f"enter text of at most {entry.max_length} characters"


def wish_for_missing(entry: Entry, unit: str = "", si: float = 1.0) -> str:
    """Return the input for a blank cell: same as `wish`, and for text an example."""
    is_text = entry.kind is str and not entry.choices
    return f"enter text such as '{entry.example}'" if is_text else wish(entry, unit, si)


def _is(cell: Found, entry: Entry) -> str:
    if isinstance(cell.value, str) and len(cell.value) > SHOWN and entry.kind is str:
        return f"is {len(cell.value)} characters long"
    return f"is {_quoted(cell.value)}"


def _quoted(value: object) -> str:
    text = cut(plain(value))
    return f"'{text}'" if isinstance(value, str) else text


def number(cell: Found, remedy: str = "enter a number", unit: str = "") -> float:
    """Return the number in a cell or its text, in its unit; raise CellError for a false format."""
    value = cell.value
    if isinstance(value, str):
        return _number_in_text(trimmed(value), remedy, unit)
    if isinstance(value, bool):
        raise CellError(f"is {plain(value)}, a logical value", remedy)
    # A number that Excel took for a date, as 3-5 typed for a range is March 5.
    if isinstance(value, date | time | timedelta):
        raise CellError(f"is a date or time ({plain(value)})", f"{remedy}, formatted as a number")
    # Whole numbers of any length are read as such; `float` has no value for 400 digits.
    if not abs(value) <= sys.float_info.max:
        raise CellError(f"is {_quoted(value)}", remedy)
    # 5% in a cell of percent may be meant as 5 or as 0.05.
    if is_percentage(cell.number_format):
        raise CellError(
            f"is a percentage ({100 * value:g}%, which Excel stores as {value:g})",
            f"{remedy}, formatted as a number",
        )
    if how := misleading(cell.number_format, unit):
        raise CellError(
            f"is {plain(value)}, shown {how} by its number format ({cut(cell.number_format)})",
            f"{remedy}, formatted as a number",
        )
    return float(value)


def _number_in_text(text: str, remedy: str, unit: str) -> float:
    value, rise = number_in(text), rise_in(text)
    if math.isfinite(value):
        return value
    if math.isfinite(rise):
        # 1/2 in. in 12 is a rise only where the column of units says so: in degrees it would be
        # read as half a degree.
        if choice_in(unit, SlopeUnit) == SlopeUnit.IN_PER_12:
            return rise
        raise CellError(
            f"is '{cut(text)}'", f"{remedy}, or choose the slope unit {SlopeUnit.IN_PER_12}"
        )
    if number_text := in_thousands(text):
        raise CellError(f"is '{cut(text)}'", f"write {number_text}, without a comma")
    if _WITH_UNIT.fullmatch(text):
        raise CellError(f"is '{cut(text)}'", f"{remedy}, with no unit in the cell")
    raise CellError(f"is '{cut(text)}'", remedy)


def _date(cell: Found, remedy: str) -> date:
    value = cell.value
    if isinstance(value, datetime):
        day = value.date()
    elif isinstance(value, date):
        day = value
    elif isinstance(value, int | float) and EARLIEST_DAY <= value <= LATEST_DAY:
        # SheetJS writes dates without their format.
        day = (cell.day_zero + timedelta(days=int(value))).date()
    else:
        days = dates_in(trimmed(value)) if isinstance(value, str) else []
        if len(days) != 1:
            either = f"write {' or '.join(map(str, days))}" if days else remedy
            raise CellError(f"is {_quoted(value)}", either)
        (day,) = days
    # A spreadsheet shows a small number, such as 3.5, as a day of 1900.
    if day < EARLIEST:
        raise CellError(f"is {day}, before {EARLIEST}", remedy)
    return day


def _choice(cell: Found, entry: Entry, remedy: str) -> StrEnum | bool:
    text = trimmed(plain(cell.value))
    if entry.kind is bool:
        text = {"true": "yes", "false": "no"}.get(text.casefold(), text)
    if choice := choice_in(text, entry.choices):
        return choice == YesNo.YES if entry.kind is bool else entry.kind(choice)
    try:
        # What a choice is called otherwise, its own class knows; bool takes anything.
        if entry.kind is not bool:
            return entry.kind(text.casefold())  # type: ignore[no-any-return]
    except ValueError:
        pass
    raise CellError(f"is {_quoted(cell.value)}", remedy)


def _text(cell: Found) -> str:
    # A project number such as 3-5 that Excel took for a date cannot be told from a date any more.
    if isinstance(cell.value, date | time | timedelta | bool):
        raise CellError(
            f"is {plain(cell.value)}, which is not text", "format the cell as text and retype it"
        )
    # Excel writes characters that XML does not allow, and a pasted CR, as _x000D_.
    text = trimmed(unescape(plain(cell.value)).replace("\r\n", "\n").replace("\r", "\n"))
    if UNPRINTABLE.search(text):
        raise CellError(f"is '{cut(text)}', with control characters", "retype it")
    return text
