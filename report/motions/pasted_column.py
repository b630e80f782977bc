"""A record pasted into a worksheet of the workbook: the column below its heading.

`Records!x_g` names it. The heading's unit and a column of times to its left are checked against the
units and the time step of the motion. Read `read_column`.
"""

from __future__ import annotations

import math
from contextlib import suppress
from dataclasses import dataclass, replace
from itertools import product

import numpy as np

from report.project.read.archive import OpenBook
from report.project.read.cells import CellError, Found, check_saved, number
from report.project.read.positions import MAX_COLUMNS, CellPosition, cells_below, found_at
from solver.errors import InputError, Problem
from solver.formats.phrases import Heading, Kind, is_spectral, parse
from solver.formats.source import Source
from solver.formats.times import sampled
from solver.records.record import (
    Record,
    check_peak,
    has_gravity,
    record_from_values,
    unit_size,
)

HEADING_ROWS = 10

MAX_SAMPLES = 200_000

MAX_TOLD = 5
_FEW = 10  # samples: fewer may be a sketch of a pulse


def heading_on(book: OpenBook, title: str, header: str) -> CellPosition:
    """Return the cell of a heading on a sheet; raises `InputError` if it is missing or repeated."""
    extent, sheet = book.extent(title), book.book[title]
    rows = range(1, min(HEADING_ROWS, extent.last_row) + 1)
    columns = range(1, min(MAX_COLUMNS, extent.last_column) + 1)
    spots = [
        CellPosition(title, row, column)
        for row, column in product(rows, columns)
        if str(sheet.cell(row, column).value or "").strip().casefold() == header.casefold()
    ]
    if not spots:
        raise InputError(
            f"worksheet '{title}' has no heading '{header}' in its first {HEADING_ROWS} rows; write"
            " it above the column"
        )
    if len(spots) > 1:
        places = " and ".join(position.address for position in spots[:2])
        raise InputError(f"heading '{header}' appears at {places}; rename one")
    return spots[0]


def read_column(
    book: OpenBook, name: str, heading: CellPosition, units: str, dt_s: float
) -> tuple[Record, list[Found]]:
    """Return the record below a heading, and the cells that it is read from.

    It is in the units and at the time step of its motion. Raises `InputError` for a cell without a
    number, or if the sheet contradicts the motion.
    """
    extent = book.extent(heading.sheet)
    if extent.last_row > heading.row + MAX_SAMPLES:
        raise InputError(
            f"{heading.sheet}!{extent.row_cell} contains data more than {MAX_SAMPLES:,} rows"
            " below the heading; clear it, or use the record as a file"
        )
    _check_units(book, heading, units)
    below = cells_below(book, heading)
    last = max((i for i, cell in enumerate(below) if not cell.is_blank), default=-1)
    # Blank cells below the record: another column of the sheet may be longer.
    below = below[: last + 1]
    values = _numbers(below, units)
    parsed = _parsed_heading(book, heading)
    # What has no sign would push one way only.
    is_positive = min(values, default=-1.0) >= 0.0
    if parsed.is_magnitude and is_positive:
        raise InputError(
            f"{heading.address} is '{parsed.text}', the magnitude of a vector; use a component"
        )
    is_told = parsed.kind is Kind.ACCELERATION or has_gravity(unit_size(units) * np.array(values))
    if is_positive and any(values) and len(values) > _FEW and not is_told:
        raise InputError(
            f"{heading.address} is '{parsed.text}', and no value below it is less than zero: this"
            " is a curve or a magnitude, not a record; use a component, or a heading such as"
            " acc_g if it is one"
        )
    times = _check_times(book, heading, len(values), dt_s)
    # 1 gal = 1 cm/s2; the solver's table has one name for each unit.
    units = "cm/s2" if units == "gal" else units
    record = record_from_values(name, values, units=units, dt_s=dt_s)
    check_peak(name, record.a_mps2)
    return record, [found_at(book, heading), *below, *times]


def _parsed_heading(book: OpenBook, position: CellPosition) -> Heading:
    return parse(str(found_at(book, position).value or ""))


def _check_units(book: OpenBook, heading: CellPosition, units: str) -> None:
    parsed = _parsed_heading(book, heading)
    if parsed.kind in (Kind.TIME, Kind.OTHER) or is_spectral(parsed):
        raise InputError(
            f"{heading.address} is '{parsed.text}', which is not an acceleration history; enter the"
            " column of one"
        )
    if parsed.kind is Kind.ACCELERATION and not math.isclose(
        unit_size(parsed.unit), unit_size(units)
    ):
        raise InputError(
            f"{heading.address} is '{parsed.text}', but the record units are {units}; correct one"
            " of them"
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
    time_heading = _heading_of_times(book, heading)
    if time_heading is None or count < 2:
        return []
    unit_s = _parsed_heading(book, time_heading).seconds
    if math.isnan(unit_s):
        raise InputError(
            f"{time_heading.address} is '{_parsed_heading(book, time_heading).text}'; enter times"
            " in s, ms or min"
        )
    cells = cells_below(book, time_heading)[:count]
    t_s = unit_s * np.array(_numbers(cells, _parsed_heading(book, time_heading).unit or "s"))
    source = _Times(
        name=time_heading.address, lines=[], units="", dt_s=math.nan, heading=time_heading
    )
    # Samples, of which there is no need.
    none = np.zeros((1, count))
    # First by the step that the sheet states: if the times fit it, nothing is to be said.
    with suppress(InputError):
        sampled(replace(source, dt_s=dt_s), t_s, none, int, unit_s)
        return [found_at(book, time_heading), *cells]
    of_times_s, _, notes = sampled(source, t_s, none, int, unit_s)
    if notes:
        steps = np.diff(t_s)
        usual = np.median(steps)
        i = int(np.abs(steps - usual).argmax())
        raise InputError(
            f"{source.at(i + 1)} is {t_s[i + 1]:.6g} s, {steps[i]:.3g} s after the row above it,"
            f" but the typical step is {usual:.3g} s; fill in the missing rows, or use the record"
            " as a file, which is resampled"
        )
    raise InputError(
        f"{time_heading.address} has times at a step of {of_times_s:.6g} s, but the time step is"
        f" {dt_s:.6g} s; correct one of them"
    )


def _heading_of_times(book: OpenBook, heading: CellPosition) -> CellPosition | None:
    """Return the nearest heading of times to the left of another; None without one."""
    places = (
        CellPosition(heading.sheet, heading.row, column)
        # To the left alone: a sheet may have a column of times before each record.
        for column in range(heading.column - 1, 0, -1)
    )
    return next((place for place in places if _parsed_heading(book, place).kind is Kind.TIME), None)


def _numbers(cells: list[Found], unit: str) -> list[float]:
    values, problems = [], []
    for cell in cells:
        try:
            values.append(_number(cell, unit))
        except CellError as error:
            problems.append(error.parts[0].at("", cell.address))
    if len(problems) > MAX_TOLD:
        problems[MAX_TOLD:] = [Problem(f"... and {len(problems) - MAX_TOLD} more cells")]
    if problems:
        raise InputError(problems)
    return values


def _number(cell: Found, unit: str) -> float:
    if cell.is_blank:
        raise CellError("is blank, next to or above values", "fill it in, or delete its row")
    check_saved(cell)
    return number(cell, unit=unit)
