"""Reads a record that is pasted into a column of the workbook, and checks it against its sheet.

What the heading says of units, and a column of times to the left of it, must agree with the row on
the sheet Motions, as they must in a file. Read `read_column`.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from report.sheet.reading.archive import OpenBook
from report.sheet.reading.cells import CellError, Found, check_saved, number
from report.sheet.reading.positions import MAX_COLUMNS, CellPosition, cells_below, found_at
from solver.formats.headings import Heading, Kind, is_spectral, parse
from solver.formats.source import Source
from solver.formats.times import Sampled, sampled
from solver.model import Floats, InputError, Problem
from solver.records.record import Record, record_from_values
from solver.records.units import unit_size

HEADING_ROWS = 10
MAX_SAMPLES = 200_000
MAX_TOLD = 5


def heading_on(book: OpenBook, title: str, header: str) -> CellPosition:
    """Return the cell of a heading on a sheet.

    Raises
    ------
    InputError
        If it is not there, or twice.
    """
    extent, sheet = book.extent(title), book.book[title]
    spots = [
        CellPosition(title, row, column)
        for row in range(1, min(HEADING_ROWS, extent.last_row) + 1)
        for column in range(1, min(MAX_COLUMNS, extent.last_column) + 1)
        if str(sheet.cell(row, column).value or "").strip().casefold() == header.casefold()
    ]
    if not spots:
        raise InputError(
            f"sheet '{title}' has no heading '{header}' in its first {HEADING_ROWS} rows; write it"
            " above the column"
        )
    if len(spots) > 1:
        places = " and ".join(position.address for position in spots[:2])
        raise InputError(f"heading '{header}' appears at {places}; rename one")
    return spots[0]


def read_column(
    book: OpenBook, name: str, heading: CellPosition, units: str, dt_s: float
) -> tuple[Record, list[Found]]:
    """Return the record below a heading, and the cells that it is read from.

    It is in the units and at the time step of its motion.

    Raises
    ------
    InputError
        For a cell without a number, and where the sheet says something else.
    """
    extent = book.extent(heading.sheet)
    if extent.last_row > heading.row + MAX_SAMPLES:
        raise InputError(
            f"{heading.sheet}!{extent.row_cell} contains data more than {MAX_SAMPLES:,} rows"
            " below the heading; clear it, or give the record as a file"
        )
    _check_units(book, heading, units)
    below = _filled(cells_below(book, heading))
    values = _numbers(below, units)
    times = _check_times(book, heading, len(values), dt_s)
    # 1 gal = 1 cm/s2; the solver's table has one name for each unit.
    units = "cm/s2" if units == "gal" else units
    record = record_from_values(name, values, units=units, dt_s=dt_s)
    return record, [found_at(book, heading), *below, *times]


def _said(book: OpenBook, position: CellPosition) -> Heading:
    return parse(str(found_at(book, position).value or ""))


def _check_units(book: OpenBook, heading: CellPosition, units: str) -> None:
    said = _said(book, heading)
    if said.kind in (Kind.TIME, Kind.OTHER) or is_spectral(said):
        raise InputError(
            f"{heading.address} is '{said.text}', which is no acceleration by time; give the"
            " column of one"
        )
    if said.kind is Kind.ACCELERATION and not math.isclose(unit_size(said.unit), unit_size(units)):
        raise InputError(
            f"{heading.address} is '{said.text}', but the record units are {units}; correct one of"
            " them"
        )


@dataclass(frozen=True, slots=True, kw_only=True)
class _Times(Source):
    """A column of times, as a source of messages that name its cells."""

    heading: CellPosition

    def at(self, index: int) -> str:
        """Return the address of a time."""
        row = self.heading.row + 1 + index
        return CellPosition(self.heading.sheet, row, self.heading.column).address


def _check_times(book: OpenBook, heading: CellPosition, count: int, dt_s: float) -> list[Found]:
    """Raise where a column of times contradicts the time step, or lacks samples; return it."""
    at = _heading_of_times(book, heading)
    if at is None or count < 2:
        return []
    unit_s = _said(book, at).seconds
    if math.isnan(unit_s):
        raise InputError(f"{at.address} is '{_said(book, at).text}'; give times in s, ms or min")
    cells = cells_below(book, at)[:count]
    t_s = unit_s * np.array(_numbers(cells, _said(book, at).unit or "s"))
    source = _Times(name=at.address, lines=[], units="", dt_s=math.nan, heading=at)
    even = _evened(source, t_s, unit_s)
    if even.notes:
        raise InputError(_uneven(source, t_s))
    try:
        _evened(replace(source, dt_s=dt_s), t_s, unit_s)
    except InputError as error:
        raise InputError(
            f"{at.address} has times at a step of {even.dt_s:.6g} s, but the time step is"
            f" {dt_s:.6g} s; correct one of them"
        ) from error
    return [found_at(book, at), *cells]


def _evened(source: Source, t_s: Floats, unit_s: float) -> Sampled:
    """Return times as those of a file are evened; there is no need of samples."""
    return sampled(source, t_s, np.zeros((1, len(t_s))), lambda index: index, unit_s)


def _uneven(source: Source, t_s: Floats) -> str:
    steps = np.diff(t_s)
    usual = np.median(steps)
    i = int(np.abs(steps - usual).argmax())
    return (
        f"{source.at(i + 1)} is {t_s[i + 1]:.6g} s, {steps[i]:.3g} s after the row above it, but"
        f" the typical step is {usual:.3g} s; fill in the missing rows, or give the record as a"
        " file, which is resampled"
    )


def _heading_of_times(book: OpenBook, heading: CellPosition) -> CellPosition | None:
    """Return the nearest heading of times to the left of another; None without one."""
    places = (
        CellPosition(heading.sheet, heading.row, column)
        for column in range(heading.column - 1, 0, -1)
    )
    return next((place for place in places if _said(book, place).kind is Kind.TIME), None)


def _filled(cells: list[Found]) -> list[Found]:
    """Return cells without the blank ones at their end."""
    last = max((i for i, cell in enumerate(cells) if not cell.is_blank), default=-1)
    return cells[: last + 1]


def _numbers(cells: list[Found], unit: str) -> list[float]:
    values, problems = [], []
    for cell in cells:
        try:
            values.append(_number(cell, unit))
        except CellError as error:
            problems.append(error.problem.at("", cell.address))
    if len(problems) > MAX_TOLD:
        problems[MAX_TOLD:] = [Problem(f"... and {len(problems) - MAX_TOLD} more cells")]
    if problems:
        raise InputError(problems)
    return values


def _number(cell: Found, unit: str) -> float:
    if cell.is_blank:
        raise CellError("is blank, beside or above values", "fill it in, or delete its row")
    check_saved(cell)
    return number(cell, unit=unit)
