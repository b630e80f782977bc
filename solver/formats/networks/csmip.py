"""CSMIP volumes 1 and 2 (.V1, .RAW, .V2), and RENADIC, USC and BHRC files, which are volume 1.

Handles this format only. A file has one or more channels, each with lines of text, 100 integers and
50 or 100 real numbers of heading, then values. Volume 1 is uncorrected: pairs of time and
acceleration (10F7.3), which may be unevenly spaced, or evenly spaced values after a line that
states their step, and mostly their format. Volume 2 is corrected: evenly spaced accelerations,
velocities and displacements, of which the accelerations are read. Read `read` first.
"""

from __future__ import annotations

import math
import re
from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from solver.errors import InputError
from solver.formats import channels
from solver.formats.numbers import (
    Block,
    FieldFormat,
    each,
    fixed_values,
    free_values,
    header_values,
    layout_of,
    printed,
)
from solver.formats.record_file import MotionFile
from solver.formats.source import Source, Stated
from solver.formats.times import round_step, sampled
from solver.records.record import Record, unit_size

# Source: A.F. Shakal and M.J. Huang, Standard tape format for CSMIP strong-motion data tapes,
# California Division of Mines and Geology, OSMS 85-03, 1985.
# USC numbers its files, and BHRC of Iran begins with the name of the program of volume 1.
_VOLUME_1 = re.compile(
    r"^\s*(?:(FILE\s+\d+\s+OF\s+)?UNCORRECTED ACCELEROGRAM DATA|(\* VOL1DS FILE))", re.IGNORECASE
)
_VOLUME_2 = re.compile(r"^\s*CORRECTED ACCELEROGRAM\b", re.IGNORECASE)
_VOLUME_3 = re.compile(r"^\s*RESPONSE AND FOURIER AMPLITUDE SPECTRA", re.IGNORECASE)
_END = re.compile(r"\s*/&")
_ENDED = " (/&)", "channel"

# 16I5 on 7 lines below the text, then 8F10.3.
_WHOLE = 7
_REAL = FieldFormat(per_line=8, width=10)
_PAIRS = FieldFormat(per_line=10, width=7)
_STEP_2 = 45  # position of the step among the real numbers of volume 2, from 1

_POINTS = re.compile(r"NO\. OF POINTS\s*=\s*(\d+)", re.ASCII | re.IGNORECASE)
_PAIR_UNIT = re.compile(
    r"UNITS (?:OF UNCOR\s+\w+\s+)?(?:ARE\s+SEC(?:ONDS)?\s+AND|IS)\s+([A-Z/0-9]+)", re.IGNORECASE
)
_DURATION = re.compile(r"DURATION\s*=\s*([\d.]+)", re.ASCII | re.IGNORECASE)
_RATE_LINE = re.compile(
    r"(?<!\d)(\d+)\s+ACCELEROGRAM POINTS AT\s+([\d.]+)\s*PTS/SEC IN UNITS OF\s+([A-Z/0-9]++)"
    r".*FORMAT:\s*\(([^)]*)\)",
    re.ASCII | re.IGNORECASE,
)
_STEP_LINE = re.compile(
    r"(?<!\d)(\d+)\s+POINTS OF ACC(?:EL)? DATA EQUALLY SPACED AT\s+([\d.]+)\s*SEC[.,\s(]*"
    r"(?:(?:UNITS:|IN(?: UNITS)?)\s*([A-Z/0-9]+)[.\s)]*)?(?:\(([^)]*)\))?",
    re.ASCII | re.IGNORECASE,
)
_SERIES = re.compile(r"\s*\d+\s+POINTS OF (VEL|DIS|ACC)", re.ASCII | re.IGNORECASE)
_PEAK_1 = re.compile(r"\bMAX\s*=\s*([-+\d.]+)\s*([A-Z/0-9]+)", re.ASCII | re.IGNORECASE)
_PEAK_2 = re.compile(r"PEAK ACCELERATION\s*=\s*([-+\d.]+)\s*([A-Z/0-9]+)", re.ASCII | re.IGNORECASE)


@dataclass(frozen=True, slots=True, kw_only=True)
class _Volume:
    """The shape of a volume: how many lines of text and real numbers, and what is where."""

    first: re.Pattern[str]
    text: int
    reals: int
    length: int  # position of the length [s] among the real numbers, from 1
    even: tuple[re.Pattern[str], ...]  # lines above evenly spaced values
    peak: re.Pattern[str]

    @property
    def heading(self) -> int:
        """Number of lines above the values, or above the line that states their layout."""
        return self.text + _WHOLE + _REAL.lines(self.reals)


_ONE = _Volume(
    first=_VOLUME_1, text=13, reals=50, length=3, even=(_RATE_LINE, _STEP_LINE), peak=_PEAK_1
)
_TWO = _Volume(first=_VOLUME_2, text=25, reals=100, length=44, even=(_STEP_LINE,), peak=_PEAK_2)


def recognizes(source: Source) -> bool:
    """Whether the first line is that of a volume of CSMIP."""
    return any(pattern.match(source.line(0)) for pattern in (_VOLUME_1, _VOLUME_2, _VOLUME_3))


def read(source: Source) -> MotionFile:
    """Read the accelerations of all channels of a file."""
    if _VOLUME_3.match(source.line(0)):
        raise InputError(f"{source.at(0)}: found spectra; use a volume 1 or 2 file")
    volume = _TWO if _VOLUME_2.match(source.line(0)) else _ONE
    # RENADIC of Chile writes volume 1 of CSMIP, and says so in its text.
    text = " ".join(source.lines[: volume.text]).upper()
    # At USC are stations of others, too.
    names = ("RENADIC", "USC#", "BHRC") if volume is _ONE else ("USC#",)
    name = next((name.rstrip("#") for name in names if name in text), "CSMIP")
    if name == "USC":  # a blank begins each line of values of volume 1, and nothing ends them
        skipped = int(volume is _ONE)
        rows = (line[skipped:] for line in source.lines[volume.heading :])
        # The end mark of CSMIP is added, so that the same code reads both.
        source = replace(source, lines=[*source.lines[: volume.heading], *rows, "/&"])
    parts = channels.parts_of(source, volume.first)
    if name == "BHRC":
        channels.check_components(source, parts)
    form = f"{name} V{1 if volume is _ONE else 2}"
    read = each(partial(_channel, source, volume=volume), parts)
    return channels.motion_file(source, form, read, channels.recorder_notes(source, len(parts)))


def _channel(source: Source, part: range, volume: _Volume) -> Record:
    places = (_search(source, part, pattern) for pattern in volume.even)
    place = next(filter(None, places), None)
    if place:
        record = _even_values(source, part, volume, *place)
    elif volume is _ONE:
        record = _values_of_one(source, part)
    else:
        raise InputError(
            f"{source.at(part.start)}: found no line ... POINTS OF ACCEL DATA EQUALLY SPACED AT"
            " ...; use the complete file"
        )
    peak_index, peak = _search(source, part, volume.peak) or (part.start, None)
    peak_mps2 = printed(peak[1], peak_index).value * unit_size(peak[2]) if peak else 0.0
    notes = (*record.notes, *channels.peak_notes(source, peak_index, peak_mps2, record.a_mps2))
    if volume is _ONE:
        notes += channels.offset_notes(record.a_mps2)
    # USC writes the length of a line in its columns 73 to 80.
    heading = [source.lines[index].strip()[:72] for index in part[: volume.text]]
    names = [line for line in heading if line.upper().startswith(("CHAN", "COMP "))]
    name = next(iter(names), "")
    return replace(record, name=name, notes=notes)


def _values_of_one(source: Source, part: range) -> Record:
    """Pairs of time and acceleration, ten numbers per line; of BHRC, even accelerations."""
    points = _search(source, part, _POINTS)
    unit = _search(source, part, _PAIR_UNIT)
    if not points or not unit:
        missing = "NO. OF POINTS" if not points else "UNITS OF UNCOR ACCEL"
        raise InputError(
            f"{source.at(part.start)}: found no line {missing} = ...; use the complete file"
        )
    scale = source.scale(unit[1][1], unit[0])
    first = part.start + _ONE.heading
    lines = range(first, part.stop)
    stop, ended = channels.end_of_values(source, lines, _END.match, *_ENDED)
    count = int(points[1][1])
    duration = _DURATION.search(source.lines[points[0]])
    if duration and source.line(part.start).startswith("*"):
        even = Block(first=first, stop=stop, count=count, promised=points[0])
        values = free_values(source, even) * scale
        length = printed(duration[1], points[0])
        # The length is rounded once, over all steps.
        rounding = length.rounding / count
        step_s = round_step(length.value / count, rounding)
        stated = Stated(value=step_s, rounding=rounding, index=points[0])
        return Record(name="", dt_s=source.step(stated), a_mps2=values, notes=ended)
    block = Block(first=first, stop=stop, count=2 * count, promised=points[0])
    pairs = fixed_values(source, block, _PAIRS).reshape(-1, 2)
    if len(pairs) < 2:
        raise InputError(f"{source.at(points[0])}: found {len(pairs)} points; enter at least 2")
    times, columns = pairs[:, 0], pairs[:, 1:].T
    # Each line has five pairs; messages state the line of a time.
    line_of = (first + np.arange(len(times)) // (_PAIRS.per_line // 2)).tolist().__getitem__
    dt_s, columns, notes = sampled(source, times, columns, line_of)
    length = _real(source, part, _ONE, _ONE.length)
    channels.check_length(source, length, float(times[-1]), dt_s)
    return Record(name="", dt_s=dt_s, a_mps2=columns[0] * scale, notes=(*notes, *ended))


def _even_values(
    source: Source, part: range, volume: _Volume, index: int, line: re.Match[str]
) -> Record:
    """Evenly spaced values after a line with their count, rate or step, unit and maybe format."""
    # Where a line is lost, the real numbers are not where they are looked for.
    if index - part.start != volume.heading:
        raise InputError(
            f"{source.at(index)}: found {index - part.start} lines of heading above this one, where"
            f" the format has {volume.heading}; use the complete file"
        )
    layout = layout_of(line[4]) if line[4] else (None if volume is _ONE else _REAL)
    if line[4] and not layout:
        raise InputError(f"{source.at(index)}: found format ({line[4]}); enter one as (8f10.3)")
    dt_s = source.step(_step(source, part, volume, index, line))
    lines = range(index + 1, part.stop)
    stop, ended = channels.end_of_values(source, lines, _END.match, *_ENDED)
    # Velocities and displacements follow the accelerations of volume 2.
    later = (i for i in range(index + 1, stop) if _SERIES.match(source.lines[i]))
    block = Block(first=index + 1, stop=next(later, stop), count=int(line[1]), promised=index)
    numbers = fixed_values(source, block, layout) if layout else free_values(source, block)
    # USC states no unit there.
    peak = None if line[3] else _search(source, part, volume.peak)
    values = numbers * source.scale(peak[1][2] if peak else line[3] or "", index)
    length = _real(source, part, volume, volume.length)
    channels.check_length(source, length, len(values) * dt_s, dt_s)
    return Record(name="", dt_s=dt_s, a_mps2=values, notes=ended)


def _step(source: Source, part: range, volume: _Volume, index: int, line: re.Match[str]) -> Stated:
    """Step of the line above the values; in volume 2 that of the heading, with more digits."""
    stated = printed(line[2], index)
    if line.re is _RATE_LINE:
        # A rate is exact; `.005 SEC` is rounded to its digits.
        step_s = 1.0 / stated.value if stated.value > 0.0 else 0.0
        return Stated(value=step_s, index=index)
    if volume is _ONE:
        return stated
    exact = _real(source, part, volume, _STEP_2)
    if math.isnan(exact.value):
        raise InputError(
            f"{source.at(exact.index)}: found no step as real number {_STEP_2} of the heading; use"
            " the whole file"
        )
    # The field may be zero; then only the text above the values states the step.
    if not exact.value > 0.0:
        return stated
    channels.check_steps(source, stated, exact)
    return exact


def _real(source: Source, part: range, volume: _Volume, place: int) -> Stated:
    first = part.start + volume.text + _WHOLE
    return header_values(source, first, volume.reals, _REAL)[place - 1]


def _search(
    source: Source, part: range, pattern: re.Pattern[str]
) -> tuple[int, re.Match[str]] | None:
    """First line of a channel's heading that contains the pattern."""
    # The longer heading is that of volume 2; the values below it are not searched.
    for index in part[: _TWO.heading + 1]:
        if match := pattern.search(source.lines[index]):
            return index, match
    return None
