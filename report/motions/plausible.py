"""Warnings and notes on records: step, duration, unequal components, spikes, how each was read.

Measures nothing that the files do not state. Read `record_findings`.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from report.motions.components import RecordFile
from report.motions.prepare import Shaking
from report.sheet.checking.findings import note, warning
from report.sheet.checking.motion_checks import FIELDS
from report.sheet.schema import ProjectInput
from report.sheet.schema.fields import Finding, Place

MOST_STEP_S = 0.02
"""Time step [s] above which a record has no content at 25 Hz and above."""

MOST_DURATION_S = 300.0
"""Duration [s] above which a time step is more probably wrong than right."""

MOST_UNEQUAL = 0.05
"""Share of the longest component that may be trimmed from it without a warning."""


def record_findings(data: ProjectInput, shaking: Shaking) -> Iterator[Finding]:
    """Yield what is unusual in the records of each motion."""
    for index, row in enumerate(data.motions):
        files = [file for file in shaking.records if file.motion_id == row.id]
        if files:
            yield from _step(index, files)
            yield from _duration(index, files)
            yield from _unequal(index, files)
        for file in files:
            yield from _spikes(index, file)
            place = Place("motions", index, FIELDS[file.component])
            yield from (note(place, f"{file.name}: {text}") for text in file.notes)


def _step(index: int, files: Sequence[RecordFile]) -> Iterator[Finding]:
    longest = max(files, key=lambda file: file.dt_s)
    if longest.dt_s > MOST_STEP_S * (1.0 + 1e-9):
        text = (
            f"{longest.name} has a time step of {longest.dt_s:g} s, and so no content above"
            f" {0.5 / longest.dt_s:.3g} Hz; {MOST_STEP_S:g} s or less is usual: correct the time"
            " step, or give another record"
        )
        yield warning(f"step {longest.motion_id}", _place(index, longest), text)


def _duration(index: int, files: Sequence[RecordFile]) -> Iterator[Finding]:
    longest = max(files, key=_seconds)
    if _seconds(longest) > MOST_DURATION_S:
        text = (
            f"{longest.name} lasts {_seconds(longest):.0f} s at a time step of {longest.dt_s:g} s;"
            f" {MOST_DURATION_S:.0f} s or less is usual: correct the time step, or trim the record"
        )
        yield warning(f"duration {longest.motion_id}", _place(index, longest), text)


def _unequal(index: int, files: Sequence[RecordFile]) -> Iterator[Finding]:
    longest = max(files, key=lambda file: file.npts)
    cut = max(file.npts_trimmed for file in files)
    if cut > MOST_UNEQUAL * longest.npts:
        text = (
            f"{longest.name} has {longest.npts} samples, and {cut} of them are trimmed, to the"
            " shortest component; give components of one recording"
        )
        yield warning(f"length {longest.motion_id}", _place(index, longest), text)


def _spikes(index: int, file: RecordFile) -> Iterator[Finding]:
    if not file.spikes:
        return
    first, more = file.spikes[0], len(file.spikes) - 1
    which = f"sample {first + 1:,}" + (f" and {more} more" if more else "")
    text = (
        f"{file.name}: {which}, at {first * file.dt_s:.6g} s, {'reach' if more else 'is'}"
        f" {file.peak_g:.4g} g, and no other is more than {file.others_g:.4g} g; correct the file,"
        " or give another record"
    )
    yield warning(f"spike {file.motion_id} {file.component}", _place(index, file), text)


def _seconds(file: RecordFile) -> float:
    return (file.npts - 1) * file.dt_s


def _place(index: int, file: RecordFile) -> Place:
    return Place("motions", index, FIELDS[file.component])
