"""Makes motions of the records that a workbook names, one component or three.

Owns how components go together and how they are scaled; `files` reads them.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from report.sheet.archive import OpenBook
from report.sheet.fields import Fault, Place
from report.sheet.files import Component, read_component
from report.sheet.schema import Polarity, Scaling
from report.units import G_MPS2
from solver.model import Floats, InputError, Motion

COMPONENTS = {"record": "horizontal", "transverse": "transverse", "vertical": "vertical"}
"""Fields of a motion that name a record, each with what the component is called."""

SIGNS = {Polarity.BOTH: (1, -1), Polarity.AS_RECORDED: (1,), Polarity.REVERSED: (-1,)}


@dataclass(frozen=True, slots=True, kw_only=True)
class RecordFile:
    """One component of a motion as it was found, before scaling.

    Attributes
    ----------
    motion_id, component : str
        Component is ``horizontal``, ``transverse`` or ``vertical``.
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
    found: dict[str, Component] = {}
    for field in COMPONENTS:
        if row.get(field):
            try:
                found[field] = _read(book, row, field)
            except InputError as error:
                place, label = Place("motions", index, field), f"{COMPONENTS[field]} record"
                faults += [Fault(place, f"{label}: {problem}") for problem in error.problems]
    if "record" not in found:
        return faults
    faults += [*_mismatches(index, found), *_unscalable(index, row, found["record"])]
    return faults or _loaded(row, found)


def _read(book: OpenBook, row: Mapping[str, Any], field: str) -> Component:
    name, units = str(row[field]), str(row.get("units", "g"))
    return read_component(book, name, units, row.get("dt_s", 0.01))


def _mismatches(index: int, found: Mapping[str, Component]) -> Iterator[Fault]:
    """Yield components that do not go with the horizontal one sample by sample."""
    horizontal = found["record"].record
    for field, component in found.items():
        record, label = component.record, f"{COMPONENTS[field]} record"
        if abs(record.dt_s - horizontal.dt_s) > 1e-9 * horizontal.dt_s:
            text = (
                f"{label} has a time step of {record.dt_s:g} s, the horizontal one"
                f" {horizontal.dt_s:g} s; give both the same"
            )
            yield Fault(Place("motions", index, field), text)
        if len(record.a_mps2) != len(horizontal.a_mps2):
            text = (
                f"{label} has {len(record.a_mps2)} samples, the horizontal one"
                f" {len(horizontal.a_mps2)}; give both the same"
            )
            yield Fault(Place("motions", index, field), text)


def _unscalable(index: int, row: Mapping[str, Any], horizontal: Component) -> Iterator[Fault]:
    if row.get("scaling") is Scaling.PPA and not horizontal.record.a_mps2.any():
        text = "horizontal record is all zeros; a PPA cannot scale it"
        yield Fault(Place("motions", index, "record"), text)


def _loaded(row: Mapping[str, Any], found: Mapping[str, Component]) -> Loaded:
    motion_id = str(row.get("id", ""))
    a_mps2 = {field: component.record.a_mps2 for field, component in found.items()}
    motion = Motion(
        id=motion_id,
        source=str(row.get("source", "")),
        dt_s=found["record"].record.dt_s,
        ax_mps2=a_mps2["record"],
        ay_mps2=a_mps2.get("transverse", _nothing()),
        az_mps2=a_mps2.get("vertical", _nothing()),
        scale=_scale(row, a_mps2["record"]),
        signs=SIGNS[row.get("polarity", Polarity.BOTH)],
    )
    files = (_file(motion_id, COMPONENTS[f], str(row[f]), one) for f, one in found.items())
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


def _file(motion_id: str, component: str, name: str, found: Component) -> RecordFile:
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
