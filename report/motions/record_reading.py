"""Reads one record of a workbook: a file next to it, or a column in one of its sheets.

`solver.formats` reads the record formats, `report.motions.pasted_column` a column; which files a
workbook may access is in `report.project.read.documents`. Read `read_component`.
"""

from __future__ import annotations

import hashlib
import math
from collections.abc import Callable, Set
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from report.motions.pasted_column import heading_on, read_column
from report.project.model.input_rows import Place
from report.project.read.archive import OpenBook
from report.project.read.documents import path_beside
from report.project.read.positions import CellPosition
from report.project.read.unseen import Unseen, unseen
from solver.errors import InputError
from solver.formats import MotionFile, read_motion_file
from solver.records.record import Record

MAX_BYTES = 64_000_000

# Bytes of record files beyond which a package holds their hashes only.
MOST_RECORDS = 20_000_000

# Separates a file from its channel; not allowed in Windows file names.
BAR = "|"

# `solver.formats.read_motion_file`, or a cached version of it.
Reader = Callable[..., MotionFile]


@dataclass(frozen=True, slots=True, kw_only=True)
class Component:
    """A record as read."""

    record: Record
    sha256: str  # of the file, or of a pasted column's values as little-endian doubles in m/s2
    format: str  # such as ``PEER AT2``, or ``pasted column``
    notes: tuple[str, ...]  # remarks on how the file was read
    hold_s: float  # hold of the envelope [s], if the file says that it was generated; otherwise NaN
    size: int  # of the file [bytes]; 0 for a pasted column
    unseen: tuple[Unseen, ...] = ()  # of a pasted column: cells that the workbook keeps from sight


def read_component(
    book: OpenBook, name: str, units: str, dt_s: float | None, read: Reader = read_motion_file
) -> Component:
    """Return the record named in a workbook as file, file | channel, or Sheet!Header.

    Without `units` and `dt_s` the file must state them.

    Raises `InputError` with every problem of the record.
    """
    heading = find_heading(book, name)
    if heading is not None:
        return _read_column(book, name, heading, units, dt_s)
    path, channel = find_file(book, name)
    motion_file = read(path, units=units, dt_s=math.nan if dt_s is None else dt_s)
    content = motion_file.content
    sha256 = hashlib.sha256(content).hexdigest()
    # The same file under two motions counts once.
    kept_bytes = sum(len(data) for key, data in book.records.items() if key != sha256)
    # Beyond it the package has the hash alone; the record is run all the same.
    if kept_bytes + len(content) <= MOST_RECORDS:
        book.records[sha256] = content
    return Component(
        record=motion_file.channel(channel),
        sha256=sha256,
        format=motion_file.format,
        notes=motion_file.notes,
        hold_s=motion_file.hold_s,
        size=len(content),
    )


def find_file(book: OpenBook, name: str) -> tuple[Path, str]:
    """Return the file of a name and the channel, empty if none is named.

    Raises `InputError` if it does not exist, or is outside the workbook's folder.
    """
    file, _, channel = name.partition(BAR)
    cells = book.cells("Motions") if "Motions" in book.sheets else ()
    # Files that the sheet names are not proposed for one that is missing.
    taken = (str(cell.value).partition(BAR)[0].strip() for cell in cells if cell.value)
    path = path_beside(book.path.parent, file.strip(), MAX_BYTES, "records/m1-x.csv", taken)
    return path, channel.strip()


def bytes_of(book: OpenBook, names: Set[str]) -> int:
    """Return the total size of named files [bytes]; other names are ignored."""
    total = 0
    for name in names:
        with suppress(InputError):
            if find_heading(book, name) is None:
                total += find_file(book, name)[0].stat().st_size
    return total


def find_heading(book: OpenBook, name: str) -> CellPosition | None:
    """Return the heading of a pasted column; None for a file.

    Raises `InputError` if there is neither a sheet nor a file of that name.
    """
    if "!" not in name:
        return None
    for sheet in book.book.worksheets:
        # Excel quotes the title of a sheet in a reference.
        for title in (sheet.title, f"'{sheet.title}'"):
            if name.casefold().startswith(f"{title}!".casefold()):
                return heading_on(book, sheet.title, name[len(title) + 1 :].strip())
    # A file may have an exclamation mark in its name.
    if (book.path.parent / name.partition(BAR)[0].strip().replace("\\", "/")).is_file():
        return None
    raise InputError(f"'{name}' is not a worksheet of this workbook; enter Sheet!Header, or a file")


def _read_column(
    book: OpenBook, name: str, heading: CellPosition, units: str, dt_s: float | None
) -> Component:
    missing = [("time step", dt_s is None), ("units", not units)]
    if problems := [f"'{name}' is a pasted column; enter its {w}" for w, is_so in missing if is_so]:
        raise InputError(problems)
    record, cells = read_column(book, name, heading, units, float(dt_s or 0.0))
    # Little-endian whatever the machine: a package has the same hash on each.
    data = np.ascontiguousarray(record.a_mps2, dtype="<f8").tobytes()
    return Component(
        record=record,
        sha256=hashlib.sha256(data).hexdigest(),
        format="pasted column",
        notes=(),
        hold_s=math.nan,
        size=0,
        unseen=unseen(book, ((Place("motions"), cell) for cell in cells)),
    )
