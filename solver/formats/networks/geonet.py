"""GeoNet files of New Zealand (.V1A uncorrected, .V2A corrected): three components, in mm/s2.

Handles this format only. Each component has 16 lines of text, 40 integers (10I8), 60 real numbers
(10F8.0), then accelerations (10F8.1) and, in V2A, velocities and displacements, which are ignored.
Read `read` first.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from functools import partial

from solver.errors import InputError
from solver.formats import channels
from solver.formats.numbers import Block, FieldFormat, each, fixed_values, header_values, printed
from solver.formats.record_file import MotionFile
from solver.formats.source import Source, Stated
from solver.records.record import Record

# Source: GeoNet, Strong motion file formats, geonet.org.nz/data/supplementary/
# strong_motion_file_formats (W.J. Cousins, GNS accelerogram data files, 2008): integers 34, 35 and
# 36 are the counts of accelerations, velocities and displacements. The meaning of real numbers 26
# (step [s]), 31 (peak of V1A) and 36 (peak of V2A) was inferred from files and their text.
_FIRST = re.compile(r"^\s*(UN)?CORRECTED ACCELEROGRAM\b", re.IGNORECASE)
_SITE = re.compile(r"\s*SITE\b", re.IGNORECASE)
_STEP_LINE = re.compile(
    r"(?<![\d.])([\d.]+)\s*S(?:EC)?\b(?:\s+INTERVALS)?", re.ASCII | re.IGNORECASE
)
_INTERVAL = re.compile(r"\bINTERVALS?\b", re.IGNORECASE)
_UNIT = re.compile(r"UNITS OF\s+([\d.]+)\s+([A-Z/0-9]+)", re.ASCII | re.IGNORECASE)
_PEAK_UNIT = re.compile(r"ACCELERATION:\s+PEAK\s+\S+\s+([A-Z/0-9]+)", re.IGNORECASE)

_LENGTH = re.compile(r"\bDURATION\s+([\d.]+)\s*SEC", re.ASCII | re.IGNORECASE)

_TEXT = 16
_WHOLE = FieldFormat(per_line=10, width=8)
_WHOLES, _REALS = 40, 60
_HEADING = _TEXT + _WHOLE.lines(_WHOLES) + _WHOLE.lines(_REALS)

# Positions of the numbers in the heading, from 1.
_ACCELERATIONS, _VELOCITIES, _DISPLACEMENTS = 34, 35, 36
_STEP, _PEAK_1, _PEAK_2 = 26, 31, 36
_LENGTH_LINE, _UNIT_LINE, _COMPONENT_LINE, _PEAK_LINE = 10, 11, 13, 14


def recognizes(source: Source) -> bool:
    """Whether the first two lines are those of a GNS accelerogram."""
    first, second = source.line(0), source.line(1)
    return bool(_FIRST.match(first)) and ("GNS" in first or bool(_SITE.match(second)))


def read(source: Source) -> MotionFile:
    """Read the accelerations of all components of a file."""
    parts = channels.parts_of(source, _FIRST)
    channels.check_components(source, parts)
    is_raw = source.line(0).strip().upper().startswith("UN")
    read = each(partial(_component, source, is_raw=is_raw), parts)
    return channels.motion_file(source, "GeoNet V1A" if is_raw else "GeoNet V2A", read)


def _component(source: Source, part: range, is_raw: bool) -> Record:
    integers = header_values(source, part.start + _TEXT, _WHOLES, _WHOLE)
    real = header_values(source, part.start + _TEXT + _WHOLE.lines(_WHOLES), _REALS, _WHOLE)
    count = integers[_ACCELERATIONS - 1]
    # A blank field is NaN, for which the comparison is false; damaged digits may give any number.
    if not 0.0 <= count.value < 1e8:
        raise InputError(
            f"{source.at(count.index)}: found no number of accelerations; use the complete file"
        )
    dt_s = source.step(_step(source, part, real[_STEP - 1]))
    scale = _scale(source, part)
    first = part.start + _HEADING
    end = first + _WHOLE.lines(int(count.value))
    # V1A has no velocities: all lines to the next heading are accelerations.
    is_alone = not integers[_VELOCITIES - 1].value > 0.0
    stop = part.stop if is_alone else min(end, part.stop)
    block = Block(first=first, stop=stop, count=int(count.value), promised=count.index)
    values = fixed_values(source, block, _WHOLE) * scale
    length_index = part.start + _LENGTH_LINE - 1
    if match := _LENGTH.search(source.line(length_index)):
        channels.check_length(source, printed(match[1], length_index), len(values) * dt_s, dt_s)
    peak = real[(_PEAK_1 if is_raw else _PEAK_2) - 1]
    notes = (
        *_rest(source, part, integers),
        *channels.peak_notes(source, peak.index, peak.value * scale, values),
    )
    return Record(
        name=source.line(part.start + _COMPONENT_LINE - 1),
        dt_s=dt_s,
        a_mps2=values,
        notes=(*notes, *channels.offset_notes(values)) if is_raw else notes,
    )


def _step(source: Source, part: range, exact: Stated) -> Stated:
    """Step in the real numbers of the heading, compared with the one in the text."""
    line_index = part.start + _UNIT_LINE - 1
    line = source.line(line_index)
    match = _STEP_LINE.search(line) if _INTERVAL.search(line) else None
    if not match:
        return exact
    stated = printed(match[1], line_index)
    if not exact.value > 0.0:
        return stated
    channels.check_steps(source, stated, exact)
    # Of two that agree, the one with more digits.
    return exact if exact.rounding <= stated.rounding else stated


def _scale(source: Source, part: range) -> float:
    """Value [m/s2] of one unit: from `Raw readings in units of 1.00 mm/s/s`, or of the peak."""
    line_index = part.start + _UNIT_LINE - 1
    if unit := _UNIT.search(source.line(line_index)):
        readings = printed(unit[1], line_index).value
        if not readings > 0.0:
            raise InputError(
                f"{source.at(line_index)}: found units of {unit[1]}; enter a number above 0"
            )
        return source.scale(unit[2], line_index) * readings
    line_index = part.start + _PEAK_LINE - 1
    unit = _PEAK_UNIT.match(source.line(line_index).strip())
    if not unit:
        raise InputError(
            f"{source.at(line_index)}: found no line Acceleration: peak ... mm/s/s; use the whole"
            " file"
        )
    return source.scale(unit[1], line_index)


def _rest(source: Source, part: range, integers: Sequence[Stated]) -> tuple[str, ...]:
    """Note that a file is truncated after its accelerations."""
    counts = [integers[place - 1].value for place in (_VELOCITIES, _DISPLACEMENTS)]
    counts = [count for count in counts if 0.0 < count < 1e8]
    lines = sum(_WHOLE.lines(int(count)) for count in [integers[_ACCELERATIONS - 1].value, *counts])
    # Each series begins on a new line.
    end = part.start + _HEADING + lines
    if end <= part.stop:
        channels.check_only_blank(source, end, part.stop, "the values of a component")
        return ()
    return ("velocities or displacements are incomplete; the file may be truncated",)
