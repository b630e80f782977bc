"""Loads the records that a workbook names: files beside it, or columns in one of its sheets.

Owns what a workbook may reach on the disk. Formats of records are for `solver.formats`.
"""

from __future__ import annotations

import hashlib
import math
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path, PurePosixPath, PureWindowsPath
from typing import Any

import numpy as np

from report.sheet.archive import OpenBook
from report.sheet.cells import CellError, Found, check_saved, number
from report.sheet.fields import Fault, Place
from report.sheet.locate import MAX_COLUMNS, Spot, cells_below
from report.sheet.schema import Polarity, Scaling
from report.units import G_MPS2
from solver.formats import read_record
from solver.model import Floats, InputError, Motion
from solver.motion import Record, record_from_values

MAX_BYTES = 64_000_000
HEADING_ROWS = 10
MAX_SAMPLES = 200_000
MAX_TOLD = 5
SIGNS = {Polarity.BOTH: (1, -1), Polarity.AS_RECORDED: (1,), Polarity.REVERSED: (-1,)}


@dataclass(frozen=True, slots=True, kw_only=True)
class RecordFile:
    """One component of a motion as it was found, before scaling.

    Attributes
    ----------
    motion_id, component : str
        Component is ``horizontal`` or ``vertical``.
    name, sha256 : str
        As the workbook names it; hash of the file, or of a column's values as little-endian
        doubles in m/s2.
    npts : int
    dt_s, peak_g : float
    """

    motion_id: str
    component: str
    name: str
    sha256: str
    npts: int
    dt_s: float
    peak_g: float


@dataclass(frozen=True, slots=True, kw_only=True)
class Loaded:
    """A motion with the records that it was made of."""

    motion: Motion
    files: tuple[RecordFile, ...]


@dataclass(frozen=True, slots=True)
class _Component:
    record: Record
    sha256: str


def load_motion(book: OpenBook, index: int, row: Mapping[str, Any]) -> Loaded | list[Fault]:
    """Load a motion, or say what is wrong with its records.

    Parameters
    ----------
    book : OpenBook
    index : int
        Of the row in its table.
    row : mapping
        Fields of `report.sheet.schema.MotionInput`; one that could not be read is absent, and is
        stood in for, so that its records are looked at all the same.
    """
    faults: list[Fault] = []
    components = {
        field: _component(book, row, field, faults, index)
        for field in ("record", "vertical")
        if row.get(field)
    }
    horizontal, vertical = components.get("record"), components.get("vertical")
    if horizontal and vertical:
        faults += _mismatch(index, horizontal.record, vertical.record)
    if horizontal and row.get("scaling") is Scaling.PPA and not horizontal.record.a_mps2.any():
        text = "horizontal record is all zeros; a PPA cannot scale it"
        faults.append(Fault(Place("motions", index, "record"), text))
    if faults or horizontal is None:
        return faults
    return _loaded(row, horizontal, vertical)


def _component(
    book: OpenBook, row: Mapping[str, Any], field: str, faults: list[Fault], index: int
) -> _Component | None:
    try:
        return _read(book, str(row[field]), str(row.get("units", "g")), row.get("dt_s", 0.01))
    except InputError as error:
        label = "horizontal record" if field == "record" else "vertical record"
        place = Place("motions", index, field)
        faults += [Fault(place, f"{label}: {problem}") for problem in error.problems]
        return None


def _read(book: OpenBook, name: str, units: str, dt_s: float | None) -> _Component:
    heading = _heading(book, name) if "!" in name else None
    if heading is not None:
        return _read_column(book, name, heading, units, dt_s)
    path = _path(book.path.parent, name)
    record = read_record(path, units=units, dt_s=math.nan if dt_s is None else dt_s)
    return _Component(record, hashlib.sha256(path.read_bytes()).hexdigest())


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
) -> _Component:
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
    return _Component(record, hashlib.sha256(data).hexdigest())


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


def _mismatch(index: int, horizontal: Record, vertical: Record) -> list[Fault]:
    place, faults = Place("motions", index, "vertical"), []
    if abs(vertical.dt_s - horizontal.dt_s) > 1e-9 * horizontal.dt_s:
        text = (
            f"vertical record has a time step of {vertical.dt_s:g} s, the horizontal one"
            f" {horizontal.dt_s:g} s; give both the same"
        )
        faults.append(Fault(place, text))
    if len(vertical.a_mps2) != len(horizontal.a_mps2):
        text = (
            f"vertical record has {len(vertical.a_mps2)} samples, the horizontal one"
            f" {len(horizontal.a_mps2)}; give both the same"
        )
        faults.append(Fault(place, text))
    return faults


def _loaded(row: Mapping[str, Any], horizontal: _Component, vertical: _Component | None) -> Loaded:
    ax, motion_id = horizontal.record.a_mps2, str(row.get("id", ""))
    files = [_file(motion_id, "horizontal", str(row["record"]), horizontal)]
    if vertical:
        files.append(_file(motion_id, "vertical", str(row["vertical"]), vertical))
    motion = Motion(
        id=motion_id,
        source=str(row.get("source", "")),
        dt_s=horizontal.record.dt_s,
        ax_mps2=ax,
        az_mps2=vertical.record.a_mps2 if vertical else _nothing(),
        scale=_scale(row, ax),
        signs=SIGNS[row.get("polarity", Polarity.BOTH)],
    )
    return Loaded(motion=motion, files=tuple(files))


def _nothing() -> Floats:
    empty = np.empty(0)
    empty.setflags(write=False)
    return empty


def _scale(row: Mapping[str, Any], ax_mps2: Floats) -> float:
    value = row.get("scale_value")
    if value is None or row.get("scaling") is Scaling.AS_RECORDED:
        return 1.0
    if row.get("scaling") is Scaling.PPA:
        return float(value * G_MPS2 / np.abs(ax_mps2).max())
    return float(value)


def _file(motion_id: str, component: str, name: str, found: _Component) -> RecordFile:
    a = found.record.a_mps2
    return RecordFile(
        motion_id=motion_id,
        component=component,
        name=name,
        sha256=found.sha256,
        npts=len(a),
        dt_s=found.record.dt_s,
        peak_g=float(np.abs(a).max() / G_MPS2),
    )
