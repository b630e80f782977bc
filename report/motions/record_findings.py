"""Findings on unusual records of a workbook: a peak, a step, a duration, a length, a spike.

A record of 50 Hz has a step of 0.02 s and no content above 25 Hz. Read `record_findings`.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence

import numpy as np

from report.motions.components import RecordFile
from report.motions.prepare import Shaking
from report.project.check.motion_faults import FIELDS
from report.project.model import ProjectInput
from report.project.model.finding import Finding, note, warning
from report.project.model.input_rows import Place
from report.text.units import G_MPS2, NO_BREAK
from solver.model import Motion

# Peak of a motion / that of the others, and the inverse, beyond which their units differ: the peaks
# of the motions of one site are within a factor of ten.
OTHER_UNIT = 100.0

# Time step [s] above which a record has no content at 25 Hz and above.
MOST_STEP_S = 0.02

# Duration [s] above which a time step is more probably wrong than right.
MOST_DURATION_S = 300.0

# Share of the longest component that may be trimmed from it without a warning.
MOST_UNEQUAL = 0.05


def record_findings(data: ProjectInput, shaking: Shaking) -> Iterator[Finding]:
    """Yield findings on unusual records of each motion."""
    yield from _unlike_peaks(shaking.motions)
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


def _unlike_peaks(motions: Sequence[Motion]) -> Iterator[Finding]:
    """Yield the motions whose peak as run is far above or below that of every other motion.

    A record in cm/s2 that is read in g is 981 times too large, one in g read in cm/s2 too small.
    """
    peaks_g = [
        float(np.abs(np.concatenate((motion.ax_mps2, motion.ay_mps2))).max()) / G_MPS2
        for motion in motions
    ]
    for index, peak_g in enumerate(peaks_g):
        ratios = [
            peak_g / other_g for other_g in peaks_g[:index] + peaks_g[index + 1 :] if other_g > 0.0
        ]
        if not ratios or peak_g <= 0.0:
            continue
        # Of the motion that is nearest: where one motion differs, the others are near each other.
        ratio = min(ratios, key=lambda value: abs(math.log(value)))
        if OTHER_UNIT**-1 < ratio < OTHER_UNIT:
            continue
        times, unit = (f"{ratio:.0f}", "cm/s2") if ratio > 1.0 else (f"1/{1.0 / ratio:.0f}", "g")
        text = (
            f"peak {peak_g:.3g}{NO_BREAK}g as run, {times} times the other motions: is the record "
            f"in {unit}? Correct its units or its scale factor"
        )
        yield warning(f"peak {motions[index].id}", Place("motions", index, "units"), text)


def _step(index: int, files: Sequence[RecordFile]) -> Iterator[Finding]:
    longest = max(files, key=lambda file: file.dt_s)
    if longest.dt_s > MOST_STEP_S * (1.0 + 1e-9):
        text = (
            f"{longest.name} has a time step of {longest.dt_s:g}{NO_BREAK}s, and so no content"
            f" above {0.5 / longest.dt_s:.3g}{NO_BREAK}Hz; {MOST_STEP_S:g}{NO_BREAK}s or less is"
            " typical: correct the time step, or use another record"
        )
        yield warning(f"step {longest.motion_id}", _place(index, longest), text)


def _duration(index: int, files: Sequence[RecordFile]) -> Iterator[Finding]:
    longest = max(files, key=_seconds)
    if _seconds(longest) > MOST_DURATION_S:
        text = (
            f"{longest.name} lasts {_seconds(longest):.0f}{NO_BREAK}s at a time step of"
            f" {longest.dt_s:g}{NO_BREAK}s; {MOST_DURATION_S:.0f}{NO_BREAK}s or less is typical:"
            " correct the time step, or trim it"
        )
        yield warning(f"duration {longest.motion_id}", _place(index, longest), text)


def _unequal(index: int, files: Sequence[RecordFile]) -> Iterator[Finding]:
    longest = max(files, key=lambda file: file.npts)
    cut = max(file.npts_trimmed for file in files)
    if cut > MOST_UNEQUAL * longest.npts:
        text = (
            f"{longest.name} has {longest.npts} samples, and {cut} of them are trimmed, to the"
            " shortest component; use components of one recording"
        )
        yield warning(f"length {longest.motion_id}", _place(index, longest), text)


def _spikes(index: int, file: RecordFile) -> Iterator[Finding]:
    if not file.spikes:
        return
    first, further = file.spikes[0], len(file.spikes) - 1
    which = f"sample {first + 1:,}" + (f" and {further} more" if further else "")
    text = (
        f"{file.name}: {which}, at {first * file.dt_s:.6g}{NO_BREAK}s,"
        f" {'reach' if further else 'is'} {file.peak_g:.4g}{NO_BREAK}g, and no other is more than"
        f" {file.others_g:.4g}{NO_BREAK}g; correct the file, or use another record"
    )
    yield warning(f"spike {file.motion_id} {file.component}", _place(index, file), text)


def _seconds(file: RecordFile) -> float:
    return (file.npts - 1) * file.dt_s


def _place(index: int, file: RecordFile) -> Place:
    return Place("motions", index, FIELDS[file.component])
