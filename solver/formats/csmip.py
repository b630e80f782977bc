"""CSMIP volumes 1 and 2 (.V1, .RAW, .V2), and RENADIC files, which are volume 1.

Handles this format only. A file has one or more channels, each with lines of text, 100 integers and
50 or 100 real numbers of heading, then values. Volume 1 is uncorrected: pairs of time and
acceleration (10F7.3), which may be unevenly spaced, or evenly spaced values after a line that
states their step, and mostly their format. Volume 2 is corrected: evenly spaced accelerations,
velocities and displacements, of which the accelerations are read. Read `read` first.

Source: A.F. Shakal and M.J. Huang, Standard tape format for CSMIP strong-motion data tapes,
California Division of Mines and Geology, OSMS 85-03, 1985.
"""

from __future__ import annotations

import math
import re
from collections.abc import Sequence

from solver.formats.channels import (
    Channel,
    MotionFile,
    check_length,
    check_only_blank,
    check_steps,
    motion_file,
    offset_notes,
    parts_of,
    peak_notes,
    recorder_notes,
)
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
from solver.formats.source import Source, Stated
from solver.formats.times import sampled
from solver.model import Floats, InputError
from solver.records.record import unit_size

_VOLUME_1 = re.compile(r"^\s*UNCORRECTED ACCELEROGRAM DATA", re.IGNORECASE)
_VOLUME_2 = re.compile(r"^\s*CORRECTED ACCELEROGRAM\b", re.IGNORECASE)
_VOLUME_3 = re.compile(r"^\s*RESPONSE AND FOURIER AMPLITUDE SPECTRA", re.IGNORECASE)
_END = re.compile(r"\s*/&")

# Lines of text, then 16I5 on 7 lines, then 8F10.3.
_TEXT_1, _TEXT_2, _WHOLE = 13, 25, 7
_REALS_1, _REALS_2 = 50, 100
_REAL = FieldFormat(per_line=8, width=10)
_PAIRS = FieldFormat(per_line=10, width=7)

# Positions of real numbers, from 1: length of the record [s], and its step [s].
_LENGTH_1, _LENGTH_2, _STEP_2 = 3, 44, 45

_POINTS = re.compile(r"NO\. OF POINTS\s*=\s*(\d+)", re.ASCII | re.IGNORECASE)
_PAIR_UNIT = re.compile(
    r"UNITS OF UNCOR\s+\w+\s+(?:ARE\s+SEC\s+AND|IS)\s+([A-Z/0-9]+)", re.IGNORECASE
)
_EVEN_1 = re.compile(
    r"(?<!\d)(\d+)\s+ACCELEROGRAM POINTS AT\s+([\d.]+)\s*PTS/SEC IN UNITS OF\s+([A-Z/0-9]++)"
    r".*FORMAT:\s*\(([^)]*)\)",
    re.ASCII | re.IGNORECASE,
)
_EVEN_2 = re.compile(
    r"(?<!\d)(\d+)\s+POINTS OF ACCEL DATA EQUALLY SPACED AT\s+([\d.]+)\s*SEC[.,\s(]*(?:UNITS:|IN)"
    r"\s*([A-Z/0-9]+)[.\s)]*(?:\(([^)]*)\))?",
    re.ASCII | re.IGNORECASE,
)
_ANY_2 = re.compile(r"\s*\d+\s+POINTS OF (VELOC|DISPL|ACCEL)", re.ASCII | re.IGNORECASE)
_PEAK_1 = re.compile(r"\bMAX\s*=\s*([-+\d.]+)\s*([A-Z/0-9]+)", re.ASCII | re.IGNORECASE)
_PEAK_2 = re.compile(r"PEAK ACCELERATION\s*=\s*([-+\d.]+)\s*([A-Z/0-9]+)", re.ASCII | re.IGNORECASE)


def recognizes(lines: Sequence[str]) -> bool:
    """Whether the first line is that of a volume of CSMIP."""
    first = lines[0] if lines else ""
    return any(pattern.match(first) for pattern in (_VOLUME_1, _VOLUME_2, _VOLUME_3))


def read(source: Source) -> MotionFile:
    """Read the accelerations of all channels of a file."""
    if _VOLUME_3.match(source.line(0)):
        raise InputError(f"{source.at(0)}: found spectra; give a file of volume 1 or 2")
    if _VOLUME_2.match(source.line(0)):
        parts = parts_of(source, _VOLUME_2)
        channels = each(lambda p: _volume_2(source, p), parts)
        return motion_file(source, "CSMIP V2", channels, recorder_notes(source, len(parts)))
    parts = parts_of(source, _VOLUME_1)
    text = " ".join(source.lines[:_TEXT_1]).upper()
    form = "RENADIC V1" if "RENADIC" in text else "CSMIP V1"
    channels = each(lambda p: _volume_1(source, p), parts)
    return motion_file(source, form, channels, recorder_notes(source, len(parts)))


def _volume_1(source: Source, part: range) -> Channel:
    if even := _search(source, part, _EVEN_1):
        at, line = even
        rate = printed(line[2], at).value
        step = Stated(value=1.0 / rate if rate > 0.0 else 0.0, rounding=0.0, index=at)
        dt_s, values, notes = _even_values(source, part, at, line, step)
    elif even := _search(source, part, _EVEN_2):
        at, line = even
        dt_s, values, notes = _even_values(source, part, at, line, printed(line[2], at))
    else:
        dt_s, values, notes = _pair_values(source, part)
    at, peak_mps2 = _peak(source, part, _PEAK_1)
    return Channel(
        name=_name(source, part, _TEXT_1),
        dt_s=dt_s,
        a_mps2=values,
        notes=(*notes, *peak_notes(source, at, peak_mps2, values), *offset_notes(values)),
    )


def _pair_values(source: Source, part: range) -> tuple[float, Floats, tuple[str, ...]]:
    """Pairs of time and acceleration, ten numbers per line."""
    points = _search(source, part, _POINTS)
    unit = _search(source, part, _PAIR_UNIT)
    if not points or not unit:
        wanted = "NO. OF POINTS" if not points else "UNITS OF UNCOR ACCEL"
        raise InputError(
            f"{source.at(part.start)}: found no line {wanted} = ...; give the whole file"
        )
    scale = source.scale(unit[1][1], unit[0])
    first = part.start + _TEXT_1 + _WHOLE + _REAL.lines(_REALS_1)
    stop, ended = _stop(source, first, part.stop)
    block = Block(first=first, stop=stop, count=2 * int(points[1][1]), promised=points[0])
    pairs = fixed_values(source, block, _PAIRS).reshape(-1, 2)
    if len(pairs) < 2:
        raise InputError(f"{source.at(points[0])}: found {len(pairs)} points; give at least 2")
    per_line = _PAIRS.per_line // 2
    even = sampled(source, pairs[:, 0], pairs[:, 1:].T, lambda i: first + i // per_line)
    length = _reals_1(source, part)[_LENGTH_1 - 1]
    check_length(source, length, float(pairs[-1, 0]), even.dt_s)
    return even.dt_s, even.columns[0] * scale, (*even.notes, *ended)


def _even_values(
    source: Source, part: range, at: int, match: re.Match[str], step: Stated
) -> tuple[float, Floats, tuple[str, ...]]:
    """Evenly spaced values after a line with their count, rate or step, unit and maybe format."""
    _check_heading(source, part, at, _TEXT_1 + _WHOLE + _REAL.lines(_REALS_1))
    layout = layout_of(match[4]) if match[4] else None
    if not step.value > 0.0 or (match[4] and not layout):
        raise InputError(
            f"{source.at(at)}: found {match[2]} points per second in format ({match[4]}); give a"
            " rate above 0 and a format as (8f9.6)"
        )
    dt_s = source.step(step)
    scale = source.scale(match[3], at)
    stop, ended = _stop(source, at + 1, part.stop)
    block = Block(first=at + 1, stop=stop, count=int(match[1]), promised=at)
    numbers = fixed_values(source, block, layout) if layout else free_values(source, block)
    values = numbers * scale
    length = _reals_1(source, part)[_LENGTH_1 - 1]
    check_length(source, length, len(values) * dt_s, dt_s)
    return dt_s, values, ended


def _volume_2(source: Source, part: range) -> Channel:
    place = _search(source, part, _EVEN_2)
    if not place:
        raise InputError(
            f"{source.at(part.start)}: found no line ... POINTS OF ACCEL DATA EQUALLY SPACED AT"
            " ...; give the whole file"
        )
    at, line = place
    _check_heading(source, part, at, _TEXT_2 + _WHOLE + _REAL.lines(_REALS_2))
    dt_s = source.step(_step_2(source, part, printed(line[2], at)))
    scale = source.scale(line[3], at)
    others = (i for i in range(at + 1, part.stop) if _ANY_2.match(source.lines[i]))
    stop, ended = _stop(source, at + 1, part.stop)
    block = Block(first=at + 1, stop=next(others, stop), count=int(line[1]), promised=at)
    layout = layout_of(line[4]) if line[4] else _REAL
    if not layout:
        raise InputError(f"{source.at(at)}: found format ({line[4]}); give one as (8f10.3)")
    values = fixed_values(source, block, layout) * scale
    length = _reals_2(source, part)[_LENGTH_2 - 1]
    check_length(source, length, len(values) * dt_s, dt_s)
    peak_at, peak_mps2 = _peak(source, part, _PEAK_2)
    return Channel(
        name=_name(source, part, _TEXT_2),
        dt_s=dt_s,
        a_mps2=values,
        notes=(*ended, *peak_notes(source, peak_at, peak_mps2, values)),
    )


def _step_2(source: Source, part: range, stated: Stated) -> Stated:
    """Step of the real heading, which has more digits than the line above the values."""
    exact = _reals_2(source, part)[_STEP_2 - 1]
    if math.isnan(exact.value):
        raise InputError(
            f"{source.at(exact.index)}: found no step as real number {_STEP_2} of the heading; give"
            " the whole file"
        )
    if not exact.value > 0.0:
        return stated
    check_steps(source, stated, exact)
    return exact


def _check_heading(source: Source, part: range, at: int, due: int) -> None:
    """Raise if the heading above the line of values has more or fewer lines than the format."""
    length = at - part.start
    if length != due:
        raise InputError(
            f"{source.at(at)}: found {length} lines of heading above this one, where the format has"
            f" {due}; give the whole file"
        )


def _reals_1(source: Source, part: range) -> list[Stated]:
    return header_values(source, part.start + _TEXT_1 + _WHOLE, _REALS_1, _REAL)


def _reals_2(source: Source, part: range) -> list[Stated]:
    return header_values(source, part.start + _TEXT_2 + _WHOLE, _REALS_2, _REAL)


def _search(
    source: Source, part: range, pattern: re.Pattern[str]
) -> tuple[int, re.Match[str]] | None:
    """First line of a channel's heading that contains the pattern."""
    for index in part[: _TEXT_2 + _WHOLE + _REAL.lines(_REALS_2) + 1]:
        if match := pattern.search(source.lines[index]):
            return index, match
    return None


def _stop(source: Source, first: int, stop: int) -> tuple[int, tuple[str, ...]]:
    """Index of the line that ends a channel, with a note if there is none."""
    for index in range(first, stop):
        if _END.match(source.lines[index]):
            check_only_blank(source, index + 1, stop, "the end of a channel")
            return index, ()
    return stop, ("no end-of-data line (/&) follows the values: the file may be truncated",)


def _peak(source: Source, part: range, pattern: re.Pattern[str]) -> tuple[int, float]:
    place = _search(source, part, pattern)
    if not place:
        return part.start, 0.0
    index, match = place
    return index, printed(match[1], index).value * unit_size(match[2])


def _name(source: Source, part: range, lines: int) -> str:
    heading = (source.lines[index] for index in part[:lines])
    return next((line for line in heading if line.strip().upper().startswith("CHAN")), "")
