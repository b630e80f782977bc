"""User-defined target spectra: a workbook sheet or CSV file, read into corner points.

    period [s], horizontal [g]
    0.03, 1.2
    0.12, 1.6

Independent of code rules; `report.project.read.archive` checks the workbook. Read `read_target`.
"""

from __future__ import annotations

import csv
import math
import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import chain
from pathlib import Path

import numpy as np

from report.project.read.archive import OpenBook, open_book
from report.project.read.cells import CellError, Found, check_saved, number
from report.project.read.positions import CellPosition, found_at
from report.project.read.typed_text import separator, with_point
from solver.bounds import ORDINATE, PhysicalBounds
from solver.errors import InputError, Problem
from solver.formats.remarks import is_of_another, is_other_damping
from solver.formats.source import open_source
from solver.model import Floats
from solver.suggestions import meant
from solver.synthesis.matching import BAND_HZ

MAX_ROWS = 2000
MAX_COLUMNS = 30
HEADING_ROWS = 10
MAX_TOLD = 10

_FREQUENCY, _PERIOD, _HORIZONTAL, _VERTICAL = "frequency", "period", "horizontal", "vertical"
# Of each kind of column: its names, and the range of its values.
_KINDS = {
    _FREQUENCY: (("frequency", "freq", "f"), PhysicalBounds(1e-3, 1e3, "Hz")),
    _PERIOD: (("period", "t"), PhysicalBounds(1e-3, 1e3, "s")),
    _HORIZONTAL: (("horizontal", "sa"), ORDINATE),
    _VERTICAL: (("vertical",), ORDINATE),
}

_NAMES: dict[str, str] = {}
for _kind, (_names, _) in _KINDS.items():
    _NAMES |= dict.fromkeys(_names, _kind)
_HEADING = re.compile(r"([a-z]+)\s*(?:_|\[|\()?\s*([^\s\])]*)\s*[\])]?")
# Of ordinates in g below a heading without a unit: more than any code asks for.
_UNSAID_G = 5.0
_WANTED = "frequency [Hz] or period [s], horizontal [g] and, optionally, vertical [g]"
# Allows for band limits given as rounded periods, such as 3.33 s.
_ROUNDED = 0.01


@dataclass(frozen=True, slots=True, kw_only=True)
class TargetTable:
    """A target spectrum as read."""

    source: str  # file and sheet
    freq_hz: Floats  # shape (m,): increasing frequencies [Hz]
    horizontal_g: Floats  # shape (m,): accelerations [g]
    vertical_g: Floats  # shape (m,) or (0,): empty if the table has no vertical

    @property
    def has_vertical(self) -> bool:
        """Whether the table has a vertical column."""
        return len(self.vertical_g) > 0


class _Field(Found):
    """A field of a CSV file."""

    @property
    def address(self) -> str:
        """Its file and line."""
        return f"{self.sheet}:{self.cell}"


_Rows = Sequence[Sequence[Found]]


def read_target(named: str) -> TargetTable:
    """Read a target spectrum: `BOOK.xlsx!Sheet`, `BOOK.xlsx` with one sheet, or a CSV file.

    One of the first ten rows has the headings; other columns are ignored, and the rows below may be
    in any order. Raises `InputError` with every problem, each with its cell or ``file:LINE``.
    """
    path, sheet = _split(named)
    if path.suffix.lower() == ".xlsx":
        book = open_book(path)
        title = _title(book, sheet)
        return _table(f"{path.name}!{title}", _sheet_rows(book, title))
    return _table(path.name, _text_rows(path))


def _split(named: str) -> tuple[Path, str]:
    match = re.fullmatch(r"(.*?\.xlsx)!(.*)", named, re.IGNORECASE | re.DOTALL)
    # A file may have an exclamation mark in its own name.
    if match is None or Path(named).is_file():
        return Path(named), ""
    return Path(match[1]), match[2].strip().strip("'")


def _title(book: OpenBook, sheet: str) -> str:
    titles = [worksheet.title for worksheet in book.book.worksheets]
    if not sheet and len(titles) == 1:
        return titles[0]
    for title in titles:
        if title.casefold() == sheet.casefold():
            return title
    name, listed = book.path.name, ", ".join(f"'{title}'" for title in titles[:MAX_TOLD])
    if not sheet:
        raise InputError(
            f"{name}: has {len(titles)} worksheets; enter {name}!Sheet, one of {listed}"
        )
    raise InputError(f"{name}: has no worksheet '{sheet}'; enter one of {listed}")


def _sheet_rows(book: OpenBook, title: str) -> _Rows:
    extent = book.extent(title)
    if extent.last_row > MAX_ROWS + HEADING_ROWS:
        raise InputError(
            f"{title}!{extent.row_cell}: contains data beyond row {MAX_ROWS + HEADING_ROWS}; "
            f"enter at most {MAX_ROWS} rows"
        )
    columns = range(1, min(extent.last_column, MAX_COLUMNS) + 1)
    return [
        [found_at(book, CellPosition(title, row, column)) for column in columns]
        for row in range(1, extent.last_row + 1)
    ]


def _text_rows(path: Path) -> _Rows:
    if not path.is_file():
        remedy = f"use BOOK.xlsx!Sheet or a CSV file with {_WANTED}"
        raise InputError(f"{path}: no such file; {meant(path) or remedy}")
    # Neither units nor a step: they are those of a record.
    lines = open_source(path, units="", dt_s=math.nan).lines
    try:
        mark = separator(lines)
        rows = list(csv.reader(lines, delimiter=mark, strict=True))
    except csv.Error as error:
        raise InputError(f"{path.name}: not CSV; use {_WANTED}") from error
    if len(rows) > MAX_ROWS + HEADING_ROWS:
        raise InputError(f"{path.name}: has {len(rows)} lines; enter at most {MAX_ROWS} rows")
    return [
        [
            _Field(sheet=path.name, cell=str(k), value=with_point(field.strip(), mark))
            for field in row
        ]
        for k, row in enumerate(rows, start=1)
    ]


def _table(source: str, rows: _Rows) -> TargetTable:
    top, columns = _headings(source, rows)
    below = [row for row in rows[top + 1 :] if not all(cell.is_blank for cell in row)]
    problems: list[Problem] = []
    values = {
        kind: np.array([_value(row, column, kind, problems) for row in below])
        for kind, column in columns.items()
    }
    for row in below:
        # A decimal comma between commas makes two values of one.
        if not all(cell.is_blank for cell in row[len(rows[top]) :]):
            text = f"has {len(row)} values below {len(rows[top])} headings"
            remedy = "enter decimal points, or semicolons between the columns"
            problems.append(Problem(text, remedy, row[0].address))
    for kind in columns.keys() & {_HORIZONTAL, _VERTICAL}:
        cell = rows[top][columns[kind]]
        if not _heading(cell)[1] and (largest := values[kind].max(initial=0.0)) > _UNSAID_G:
            text = f"is '{cell.shown.strip()}', above values up to {largest:g}"
            problems.append(Problem(text, f"enter {kind} [g], and the values in g", cell.address))
    if not problems:
        problems = list(_range_problems(source, _frequencies(values)))
    if problems:
        unlisted = len(problems) - MAX_TOLD
        summary = [Problem(f"... and {unlisted} more")] if unlisted > 0 else []
        raise InputError(problems[:MAX_TOLD] + summary)
    return _sorted(source, values)


def _headings(source: str, rows: _Rows) -> tuple[int, Mapping[str, int]]:
    """Return the row of the headings and the column of each kind."""
    # Lines above the headings may say where the spectrum is from, not that it is of another unit.
    for top, row in enumerate(rows[:HEADING_ROWS]):
        headings = [_heading(cell) for cell in row]
        kinds = {kind for kind, _ in headings}
        if {_FREQUENCY, _PERIOD} & kinds and _HORIZONTAL in kinds:
            above = [cell for cell in chain.from_iterable(rows[:top]) if not cell.is_blank]
            return top, _columns(above, row, headings)
    raise InputError(
        f"{source}: no row of headings in the first {HEADING_ROWS} rows; enter {_WANTED}"
    )


def _heading(cell: Found) -> tuple[str, str]:
    """Return the kind of a column and its unit in small letters; each empty if there is none."""
    text = cell.shown.strip().casefold()
    if match := _HEADING.fullmatch(text):
        return _NAMES.get(match[1], ""), match[2]
    # One that begins as a column that is read is not ignored: what it says is no unit.
    return _NAMES.get(text.partition(" ")[0], ""), text


def _columns(
    above: Sequence[Found], row: Sequence[Found], headings: Sequence[tuple[str, str]]
) -> Mapping[str, int]:
    problems, columns = [], {}
    for cell in above:
        if is_of_another(cell.shown):
            remedy = "use accelerations in g, or delete the line if it is not part of the table"
            problems.append(Problem(f"says '{cell.shown.strip()[:60]}'", remedy, cell.address))
        if is_other_damping(cell.shown):
            remedy = "use the spectrum at 5% damping, or delete a line that is not of the columns"
            problems.append(Problem(f"says '{cell.shown.strip()[:60]}'", remedy, cell.address))
    for column, (cell, (kind, unit)) in enumerate(zip(row, headings, strict=True)):
        if not kind:
            continue
        due = _KINDS[kind][1].unit
        if unit not in ("", due.casefold()):
            remedy = f"enter {kind} [{due}]"
            problems.append(Problem(f"is '{cell.shown.strip()}'", remedy, cell.address))
        if kind in columns:
            problems.append(Problem(f"a second {kind} column", "delete one", cell.address))
        columns[kind] = column
    if _FREQUENCY in columns and _PERIOD in columns:
        place = row[columns[_PERIOD]].address
        problems.append(Problem("both frequency and period", "delete one of them", place))
    if problems:
        raise InputError(problems)
    return columns


def _value(row: Sequence[Found], column: int, kind: str, problems: list[Problem]) -> float:
    """Return a number greater than 0; NaN, with a problem added, if there is none."""
    if column >= len(row) or row[column].is_blank:
        place = row[min(column, len(row) - 1)].address
        problems.append(Problem(f"{kind} is blank", "enter a number greater than 0", place))
        return float("nan")
    bounds = _KINDS[kind][1]
    cell, remedy = row[column], f"enter a number greater than 0 [{bounds.unit}]"
    try:
        check_saved(cell)
        value = number(cell, remedy, bounds.unit)
    except CellError as error:
        problems.append(error.parts[0].at(cell.address, kind))
        return float("nan")
    if not bounds.has(value):
        problems.append(
            Problem(f"{kind} is {value:g}", f"enter a number from {bounds.words}", cell.address)
        )
    return value


def _frequencies(values: Mapping[str, Floats]) -> Floats:
    return values[_FREQUENCY] if _FREQUENCY in values else 1.0 / values[_PERIOD]


def _range_problems(source: str, freq_hz: Floats) -> Iterator[Problem]:
    if len(freq_hz) < 2:
        count = "1 row" if len(freq_hz) else "no rows"
        yield Problem(f"has {count} of numbers", "enter at least 2", source)
        return
    # Two ordinates at one frequency: interpolated, the slope between them has no end.
    apart = np.diff(np.sort(freq_hz)) > 1e-9 * np.sort(freq_hz)[1:]
    if not apart.all():
        repeated_hz = float(np.sort(freq_hz)[1:][~apart][0])
        fault = f"{repeated_hz:g} Hz ({1 / repeated_hz:g} s) appears twice"
        yield Problem(fault, "enter each frequency once", source)
    low, high = BAND_HZ[0] * (1.0 + _ROUNDED), BAND_HZ[1] * (1.0 - _ROUNDED)
    if freq_hz.min() > low or freq_hz.max() < high:
        band = f"{BAND_HZ[0]:g} to {BAND_HZ[1]:g} Hz (periods from 0.03 to 3.33 s) or more"
        fault = f"covers {freq_hz.min():.4g} to {freq_hz.max():.4g} Hz"
        yield Problem(fault, f"enter {band}", source)


def _sorted(source: str, values: Mapping[str, Floats]) -> TargetTable:
    freq_hz = _frequencies(values)
    order = np.argsort(freq_hz)
    none: Floats = np.empty(0)
    return TargetTable(
        source=source,
        freq_hz=freq_hz[order],
        horizontal_g=values[_HORIZONTAL][order],
        vertical_g=values[_VERTICAL][order] if _VERTICAL in values else none,
    )
