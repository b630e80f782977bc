"""Reads one record that a workbook names: a file beside it, or a column in one of its sheets.

Owns what a workbook may reach on the disk. Formats of records are for `solver.formats`.
"""

from __future__ import annotations

import hashlib
import math
from dataclasses import dataclass
from pathlib import Path, PurePosixPath, PureWindowsPath

import numpy as np

from report.sheet.archive import OpenBook
from report.sheet.cells import CellError, Found, check_saved, number
from report.sheet.locate import MAX_COLUMNS, Spot, cells_below
from solver.formats import read_record
from solver.model import InputError
from solver.motion import Record, record_from_values

MAX_BYTES = 64_000_000
HEADING_ROWS = 10
MAX_SAMPLES = 200_000
MAX_TOLD = 5


@dataclass(frozen=True, slots=True)
class Component:
    """A record as it was found, with its hash."""

    record: Record
    sha256: str


def read_component(book: OpenBook, name: str, units: str, dt_s: float | None) -> Component:
    """Return the record of a name, as the workbook gives it.

    Raises
    ------
    InputError
        With every problem of the record.
    """
    heading = _heading(book, name) if "!" in name else None
    if heading is not None:
        return _read_column(book, name, heading, units, dt_s)
    path = _path(book.path.parent, name)
    record = read_record(path, units=units, dt_s=math.nan if dt_s is None else dt_s)
    return Component(record, hashlib.sha256(path.read_bytes()).hexdigest())


def _path(folder: Path, name: str) -> Path:
    """Return the file of a name, which must lie within the workbook's folder."""
    name = name.replace("\\", "/")
    where = "give a file within the workbook's folder, such as records/m1-x.csv"
    if PurePosixPath(name).is_absolute() or PureWindowsPath(name).drive or ".." in name.split("/"):
        raise InputError(f"'{name}' leads out of the workbook's folder; {where}")
    try:
        path = (folder / name).resolve()
        if not path.is_relative_to(folder.resolve()):
            raise InputError(f"'{name}' leads out of the workbook's folder by a link; {where}")
        if not path.exists():
            raise InputError(f"'{name}' is not there; {where}")
        if not path.is_file():
            raise InputError(f"'{name}' is no file; {where}")
        size = path.stat().st_size
    except (OSError, RuntimeError, ValueError) as error:
        if isinstance(error, InputError):
            raise
        raise InputError(f"'{name}' cannot be found; {where}") from error
    if size > MAX_BYTES:
        raise InputError(f"'{name}' has {size / 1e6:.0f} MB; at most {MAX_BYTES / 1e6:.0f} MB do")
    return path


def _heading(book: OpenBook, name: str) -> Spot | None:
    """Return the heading of a pasted column; None where no sheet has the name before the !."""
    for sheet in book.typed.worksheets:
        for title in (sheet.title, f"'{sheet.title}'"):
            if name.casefold().startswith(f"{title}!".casefold()):
                return _heading_on(book, sheet.title, name[len(title) + 1 :].strip())
    if (book.path.parent / name.replace("\\", "/")).is_file():
        return None
    raise InputError(f"'{name}' names no sheet of this workbook; write Sheet!Header, or a file")


def _heading_on(book: OpenBook, title: str, header: str) -> Spot:
    extent, sheet = book.extent(title), book.computed[title]
    spots = [
        Spot(title, row, column)
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
        places = " and ".join(spot.address for spot in spots[:2])
        raise InputError(f"heading '{header}' is at {places}; give each its own")
    return spots[0]


def _read_column(
    book: OpenBook, name: str, heading: Spot, units: str, dt_s: float | None
) -> Component:
    if dt_s is None:
        raise InputError(f"'{name}' is a pasted column; give its time step")
    extent = book.extent(heading.sheet)
    if extent.last_row > heading.row + MAX_SAMPLES:
        raise InputError(
            f"{heading.sheet}!{extent.row_cell} holds something more than {MAX_SAMPLES:,} rows"
            " below the heading; clear it, or give the record as a file"
        )
    values = _numbers(cells_below(book, heading))
    record = record_from_values(name, values, units=units, dt_s=dt_s)
    data = np.ascontiguousarray(record.a_mps2, dtype="<f8").tobytes()
    return Component(record, hashlib.sha256(data).hexdigest())


def _numbers(cells: list[Found]) -> list[float]:
    while cells and cells[-1].is_blank:
        cells.pop()
    values, problems = [], []
    for cell in cells:
        try:
            values.append(_number(cell))
        except CellError as error:
            problems.append(f"{cell.address} {error.problems[0]}")
    if len(problems) > MAX_TOLD:
        problems[MAX_TOLD:] = [f"... and {len(problems) - MAX_TOLD} more cells"]
    if problems:
        raise InputError(problems)
    return values


def _number(cell: Found) -> float:
    if cell.is_blank:
        raise CellError("is blank, with values below; close the gap")
    check_saved(cell)
    return number(cell)
