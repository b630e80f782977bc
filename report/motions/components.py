"""Reads the components of each motion in a workbook, and processes them as requested.

Owns how components are combined; `record_reading` reads them, `history` makes motions of them.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from functools import cache
from typing import Any

import numpy as np

from report.motions.record_reading import Component, Reader, find_file, find_heading, read_component
from report.project.check.motion_faults import LABELS, SHORTEST_S
from report.project.model.choices import AccelUnit, Baseline, Scaling
from report.project.model.finding import Finding
from report.project.model.input_rows import Place
from report.project.model.motion_input import MotionInput
from report.project.read.archive import OpenBook
from report.project.read.unseen import Unseen
from report.text.units import G_MPS2
from solver.errors import InputError
from solver.formats import read_motion_file
from solver.model import Floats
from solver.records.processing import Processing, process, process_together
from solver.records.record import Record, has_gravity

# Samples far above all others are a digit, a sign of a missing value or a loose contact.
# Smallest spike / largest other sample: shaking rises to its peak over several samples.
FACTOR = 3.0

MOST = 10

LEAST_SAMPLES_FOR_EACH = 100


def spikes(a: Floats) -> tuple[tuple[int, ...], float]:
    """Return the indexes of the spikes of a record, and the largest magnitude of the others.

    Of 0.1, 0.2, 9.3, 0.3 g the third is one, in a longer record.
    """
    # At most `MOST` samples, and at most one in `LEAST_SAMPLES_FOR_EACH`, each of which is more
    # than `FACTOR` times any sample that is none.
    size = np.abs(a)
    count_allowed = min(MOST, len(a) // LEAST_SAMPLES_FOR_EACH)
    # Stable: of equal samples the first is named, on every machine.
    largest = np.argsort(-size, kind="stable")[: count_allowed + 1]
    for count in range(1, count_allowed + 1):
        if size[largest[count - 1]] > FACTOR * size[largest[count]]:
            return tuple(sorted(map(int, largest[:count]))), float(size[largest[count]])
    return (), float(size.max(initial=0.0))


@dataclass(frozen=True, slots=True, kw_only=True)
class RecordFile:
    """One component of a motion as read, before processing and scaling."""

    motion_id: str
    component: str  # ``horizontal``, ``transverse`` or ``vertical``
    name: str  # as the workbook names it
    sha256: str  # of the file, or of a column's values as little-endian doubles in m/s2
    format: str
    npts: int
    dt_s: float
    peak_g: float
    npts_trimmed: int  # samples at the end that the shortest component of the motion does not have
    notes: tuple[str, ...]  # remarks on how the file was read
    # Hold of the envelope [s], if the file says that it was generated and is run from its first to
    # its last sample; otherwise NaN.
    hold_s: float
    size: int  # of the file [bytes]; 0 for a pasted column
    spikes: tuple[int, ...]  # indexes of samples far above all others
    others_g: float  # largest magnitude of the other samples [g]
    unseen: tuple[Unseen, ...] = ()  # of a pasted column: cells that the workbook keeps from sight

    @property
    def is_file(self) -> bool:
        """Whether it is a file next to the workbook, not a column of one of its sheets."""
        return self.size > 0


@dataclass(frozen=True, slots=True, kw_only=True)
class Components:
    """The components of one motion, read and processed."""

    files: tuple[RecordFile, ...]
    # by field of `MotionInput`: record, transverse, vertical; with equal time step and length
    records: Mapping[str, Record]
    # the same without the high-pass filter; empty if there is none
    unfiltered: Mapping[str, Record]
    whole: Mapping[str, Record]  # as read, before processing


def read_components(
    book: OpenBook, index: int, row: Mapping[str, Any]
) -> Components | list[Finding]:
    """Read and process the records of a motion, or return their faults.

    A field of the row (`MotionInput`) that could not be read is absent; without units or time step,
    records are located but not read.
    """
    faults: list[Finding] = []
    components: dict[str, Component] = {}
    # A file with three channels is read once for its motion.
    read = cache(read_motion_file)
    for field in LABELS:
        if row.get(field):
            try:
                for component in _read(book, row, field, read):
                    components[field] = component
            except InputError as error:
                faults += _faults(index, field, error, row)
    # Without the horizontal record there is nothing to compare the others with.
    if "record" not in components:
        return faults
    to_s = row.get("to_s")
    # Cut to the end time first: beyond it the components of one recording often differ in length.
    up_to = Processing(to_s=math.inf if to_s is None else to_s)
    try:
        records = {field: process(channel.record, up_to) for field, channel in components.items()}
    except InputError as error:
        return [*faults, *_faults(index, "record", error, row)]
    faults += [*_mismatches(index, records), *_unscalable(index, row, records)]
    # A field that could not be read is not in the row, and is told already.
    if faults or any(name not in row for name in MotionInput.model_fields):
        return faults
    return _processed(index, MotionInput(**row), components, records)


# What would do where a cell contradicts its file.
_LEFT_TO_THE_FILE = {
    "units": f"enter the units of the file, or '{AccelUnit.FROM_FILE}'",
    "dt_s": "enter the time step of the file, or leave it blank",
}


def _faults(index: int, field: str, error: InputError, row: Mapping[str, Any]) -> list[Finding]:
    """Return the faults of a record, each at the cell to change: units and step have their own."""
    findings = []
    for problem in error.parts:
        place = Place("motions", index, problem.about or field)
        is_given = row.get(problem.about) not in (None, AccelUnit.FROM_FILE)
        # What was typed contradicts the file: the file is right more often than the cell.
        remedy = _LEFT_TO_THE_FILE[problem.about] if is_given else problem.remedy
        findings.append(Finding.error(place, f"{LABELS[field]} record: {problem.found}", remedy))
    return findings


def _read(book: OpenBook, row: Mapping[str, Any], field: str, read: Reader) -> Iterator[Component]:
    """Yield the component of a field; nothing if its units or time step could not be read."""
    name = str(row[field])
    if "units" in row and "dt_s" in row:
        units = "" if row["units"] is AccelUnit.FROM_FILE else str(row["units"])
        yield read_component(book, name, units, row["dt_s"], read)
    elif find_heading(book, name) is None:
        find_file(book, name)


def _mismatches(index: int, records: Mapping[str, Record]) -> Iterator[Finding]:
    horizontal = records["record"]
    for field, record in records.items():
        label, dt_s = f"{LABELS[field]} record", horizontal.dt_s
        # Steps that differ by the rounding of a division are one.
        if abs(record.dt_s - dt_s) > 1e-9 * dt_s:
            text = (
                f"{label} has a time step of {record.dt_s:g} s, but the horizontal record has "
                f"{dt_s:g} s"
            )
            yield Finding.error(Place("motions", index, field), text, "make them equal")


# Fields of a motion that name its horizontal components.
HORIZONTAL = ("record", "transverse")

# A PPA is of the record alone, a target of the horizontal pair.
_TO_A_LEVEL = {Scaling.PPA: ("record",), Scaling.TARGET: ("record", "transverse")}


def _unscalable(
    index: int, row: Mapping[str, Any], records: Mapping[str, Record]
) -> Iterator[Finding]:
    scaling = row.get("scaling")
    for field in _TO_A_LEVEL.get(scaling, ()) if scaling else ():
        if field in records and not records[field].a_mps2.any():
            goal = "a PPA" if scaling is Scaling.PPA else "a target spectrum"
            text = f"{LABELS[field]} record is all zeros and cannot be scaled to {goal}"
            remedy = "change the record or scaling"
            yield Finding.error(Place("motions", index, field), text, remedy)


def _no_motion(index: int, records: Mapping[str, Record]) -> Iterator[Finding]:
    """Yield faults of motions as run: too short, or without a horizontal component."""
    horizontal = records["record"]
    duration_s = (len(horizontal.a_mps2) - 1) * horizontal.dt_s
    place = Place("motions", index, "record")
    if duration_s < SHORTEST_S * (1.0 - 1e-9):
        text = (
            f"horizontal record lasts {duration_s:.4g} s as run ({len(horizontal.a_mps2)} samples)"
        )
        yield Finding.error(place, text, f"use a record of {SHORTEST_S:g} s or more")
    for field, record in records.items():
        if has_gravity(record.a_mps2):
            mean_g = float(record.a_mps2.mean()) / G_MPS2
            text = f"{LABELS[field]} record has a mean of {mean_g:.3g} g: it includes gravity"
            remedy = "use it without, or remove the mean by the column Baseline"
            yield Finding.error(Place("motions", index, field), text, remedy)
    if not any(records[field].a_mps2.any() for field in HORIZONTAL if field in records):
        which = "and transverse records are" if "transverse" in records else "record is"
        yield Finding.error(place, f"horizontal {which} all zeros", "use a record of the shaking")


def _processed(
    index: int,
    row: MotionInput,
    components: Mapping[str, Component],
    records: Mapping[str, Record],
) -> Components | list[Finding]:
    # Time steps that differ by rounding error are equal from here on, and so are lengths: the
    # components of one recording often differ by a few samples at the end.
    count = min(len(record.a_mps2) for record in records.values())
    raw = [
        replace(record, dt_s=records["record"].dt_s, a_mps2=record.a_mps2[:count])
        for record in records.values()
    ]
    processing = processing_of(row)
    if processing.problems():
        # Reported at their cells by `motion_checks`.
        return []
    try:
        done = process_together(raw, processing)
        # For the table that says how much of the slip the filter removes.
        bare = process_together(raw, replace(processing, highpass_hz=0.0))
    except InputError as error:
        return _faults(index, "record", error, row.model_dump())
    processed = dict(zip(components, done, strict=True))
    # Again, as run: a window of time or a filter may leave nothing of a record.
    faults = list(_unscalable(index, {"scaling": row.scaling}, processed)) or list(
        _no_motion(index, processed)
    )
    if faults:
        return faults
    has_highpass = row.highpass_hz is not None
    return Components(
        files=tuple(
            _file(row, field, component, len(records[field].a_mps2) - count)
            for field, component in components.items()
        ),
        records=processed,
        unfiltered=dict(zip(components, bare, strict=True)) if has_highpass else {},
        whole={field: component.record for field, component in components.items()},
    )


def processing_of(row: MotionInput) -> Processing:
    """Return the processing that a row of the sheet requests."""
    return Processing(
        from_s=row.from_s or 0.0,
        to_s=math.inf if row.to_s is None else row.to_s,
        # The choices of the sheet begin with none, which is degree -1.
        baseline=list(Baseline).index(row.baseline) - 1,
        highpass_hz=row.highpass_hz or 0.0,
        lowpass_hz=row.lowpass_hz or 0.0,
        order=row.order,
        dt_s=row.new_dt_s or 0.0,
        pad_s=row.pad_s or 0.0,
    )


def _file(row: MotionInput, field: str, component: Component, trimmed: int) -> RecordFile:
    a = component.record.a_mps2
    # A cut record may have lost the hold that its file states.
    is_whole = row.from_s is None and row.to_s is None and trimmed == 0
    last = f"last {trimmed} of {len(a)} samples trimmed to the length of the shortest component"
    far_above, others_mps2 = spikes(a)
    return RecordFile(
        motion_id=row.id,
        component=LABELS[field],
        name=getattr(row, field),
        sha256=component.sha256,
        format=component.format,
        npts=len(a),
        dt_s=component.record.dt_s,
        peak_g=float(np.abs(a).max() / G_MPS2),
        npts_trimmed=trimmed,
        notes=(*component.notes, *([last] if trimmed else [])),
        hold_s=component.hold_s if is_whole else math.nan,
        size=component.size,
        spikes=far_above,
        others_g=others_mps2 / G_MPS2,
        unseen=component.unseen,
    )
