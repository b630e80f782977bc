"""COSMOS files, format V1.20 (.V1C, .V2, .V2c): one or more channels, each with its own heading.

Handles this format only. A channel has lines of text, then blocks that state how many integers,
real numbers, comments and values follow, and in which format. Accelerations are read; velocities
and displacements after them are ignored; raw counts are refused. Read `read` first. Files of the
California Geological Survey lack the comma between the unit and the format.
"""

from __future__ import annotations

import re
from bisect import bisect_right
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from functools import partial

from solver.errors import InputError, raise_any
from solver.formats import channels
from solver.formats.numbers import Block, each, fixed_values, header_values, layout_of, printed
from solver.formats.record_file import MotionFile
from solver.formats.source import Source, Stated
from solver.records.record import Record, quoted, unit_size

# Source: COSMOS Strong Motion Programs Board, COSMOS strong motion data format, version 1.20, 2001:
# tables 1 (quantity) and 2 (units); real numbers 34 (step of the record [s]), 62 (step of the
# series [ms]), 63 (its length [s]) and 64 (its peak).
_FIRST = re.compile(
    r"\s*(RAW|UNCORRECTED|CORRECTED)\s+([A-Z]+)\b.*\(FORMAT\s+V", re.ASCII | re.IGNORECASE
)
_TEXT_LINES = re.compile(r"WITH\s+(\d{1,3})\s+TEXT LINES?", re.ASCII | re.IGNORECASE)
_WHOLES = re.compile(
    r"\d\s+INTEGER-HEADER VALUES FOLLOW ON\s+(\d{1,4})\s+LINES?,", re.ASCII | re.IGNORECASE
)
_COMMENTS = re.compile(r"(\d{1,4})\s+COMMENT LINES?(?:\(S\))?\s+FOLLOW", re.ASCII | re.IGNORECASE)
_REALS = re.compile(
    r"(\d{1,9})\s+REAL-HEADER VALUES FOLLOW ON\s+(\d{1,4})\s+LINES?,\s*FORMAT\s*=\s*\(([^)]*)\)",
    re.ASCII | re.IGNORECASE,
)
_DATA = re.compile(
    r"\s*(\d+)\s+((?:[A-Z]++\.?\s++){1,2})PTS,\s*APPROX\s+([\d.]+)\s*SECS?\s*,\s*UNITS?\s*="
    r"\s*+([^,(\s]*+(?:\s++(?!FORMAT\b)[^,(\s]++)*+)\s*+(?:\(\s*+(\d++)\s*+\)\s*+)?,?\s*+"
    r"FORMAT\s*=\s*\(([^)]*)\)",
    re.ASCII | re.IGNORECASE,
)
_TEXT, _REAL_NUMBERS = "text", "real numbers"
# Of the text the first line counts itself; of the other blocks it states what follows.
_BLOCKS = (
    (_TEXT_LINES, 1, _TEXT),
    (_WHOLES, 1, "integers"),
    (_REALS, 2, _REAL_NUMBERS),
    (_COMMENTS, 1, "comment"),
)
_END = re.compile(r"\s*END-OF-DATA", re.IGNORECASE)
# The line of the sensor, such as `Sta Chan 1: 360 deg (Rcrdr Chan 1) Location: Roof`.
_NAME = re.compile(r"\s*STA\s+CHA", re.IGNORECASE)

# Table 2: codes of the units of acceleration.
_UNITS = {2: "g", 4: "cm/s2", 7: "in/s2", 10: "gal", 11: "mg"}

# Positions of the real numbers, from 1.
_RECORD_STEP_S, _SERIES_STEP_MS, _SERIES_LENGTH_S, _PEAK = 34, 62, 63, 64

# The format codes an unknown real number as -999 or thereabouts.
_UNKNOWN = Stated()


@dataclass(frozen=True, slots=True, kw_only=True)
class _Part:
    """Lines of one series of values, from index `first` to before `stop`; its data line at `at`."""

    first: int
    at: int
    stop: int
    line: re.Match[str]


def recognizes(source: Source) -> bool:
    """Whether the first line names the quantity and the version of the format."""
    return bool(_FIRST.match(source.line(0)))


def read(source: Source) -> MotionFile:
    """Read the accelerations of all channels of a file."""
    for index, text in enumerate(source.lines):
        if (match := _FIRST.match(text)) and match[1].upper() == "RAW":
            raise InputError(
                f"{source.at(index)}: found raw counts; use the volume 1 or 2 file, of uncorrected"
                " or corrected acceleration"
            )
    series = _parts(source)
    raise_any(_heading_problems(source, series))
    parts = [part for part in series if "ACCEL" in part.line[2].upper()]
    read = each(partial(_channel, source), parts)
    notes = channels.recorder_notes(source, len({part.first for part in series}))
    return channels.motion_file(source, "COSMOS V1.20", read, notes)


def _parts(source: Source) -> list[_Part]:
    """All series: several may follow one heading, or each may have its own."""
    headings = [i for i, line in enumerate(source.lines) if _FIRST.match(line)]
    matches = enumerate(map(_DATA.match, source.lines))
    lines = [(index, match) for index, match in matches if match]
    channels.check_number(source, len(lines))
    # A series ends at the next heading, at the next line of data, or at the end of the file.
    borders = sorted([*headings, *(i for i, _ in lines), len(source.lines)])
    return [
        _Part(
            first=headings[bisect_right(headings, mark_index) - 1],
            at=mark_index,
            stop=borders[bisect_right(borders, mark_index)],
            line=match,
        )
        for mark_index, match in lines
    ]


def _heading_problems(source: Source, series: Sequence[_Part]) -> Iterator[str]:
    """Problems of headings without values, and of blocks that are not as long as they state."""
    filled = {part.first for part in series}
    for index, line in enumerate(source.lines):
        if _FIRST.match(line) and index not in filled:
            yield (
                f"{source.at(index)}: found a heading without a line ... pts, approx ... secs and"
                " values; use the complete file"
            )
    # The first series below each heading: the blocks of the heading are between the two. Reversed,
    # because a dict keeps the last of equal keys.
    for part in {part.first: part for part in reversed(series)}.values():
        starts: list[tuple[int, int, str]] = []
        for index in range(part.first, part.at):
            for pattern, group, block in _BLOCKS:
                if match := pattern.search(source.lines[index]):
                    starts.append((index, int(match[group]), block))
        # `_reals` refuses a heading without them.
        if all(block != _REAL_NUMBERS for _, _, block in starts):
            continue
        ends = [*(index for index, _, _ in starts[1:]), part.at]
        for (index, stated, block), end in zip(starts, ends, strict=True):
            if (lines := end - index - 1 + (block == _TEXT)) != stated:
                yield (
                    f"{source.at(index)}: states {stated} lines of {block}, found {lines}; use the"
                    " whole file"
                )


def _channel(source: Source, part: _Part) -> Record:
    line, layout = part.line, layout_of(part.line[6])
    if not layout:
        raise InputError(f"{source.at(part.at)}: found format ({line[6]}); enter one as (8F10.3)")
    scale = _scale(source, part)
    reals = _reals(source, part)
    dt_s = source.step(_step(part, reals))
    lines = range(part.at + 1, part.stop)
    stop, notes = channels.end_of_values(source, lines, _END.match, "", "series")
    if part.stop < len(source.lines):
        notes = ()  # another series follows at once
    block = Block(first=part.at + 1, stop=stop, count=int(line[1]), promised=part.at)
    values = fixed_values(source, block, layout) * scale
    stated_s, length_s = printed(line[3], part.at).value, len(values) * dt_s
    if abs(length_s - stated_s) > 1.0 + dt_s + 0.01 * stated_s:  # it is in whole seconds
        raise InputError(
            f"{source.at(part.at)}: states about {stated_s:g} s, count times step is {length_s:g}"
            " s; use a file whose headings agree"
        )
    channels.check_length(source, _real(reals, _SERIES_LENGTH_S), length_s, dt_s)
    peak = _real(reals, _PEAK)
    notes = (*notes, *channels.peak_notes(source, peak.index, peak.value * scale, values))
    top, *heading = source.lines[part.first : part.at]
    is_uncorrected = top.strip().upper().startswith("UN")
    return Record(
        name=next((text for text in heading if _NAME.match(text)), ""),
        dt_s=dt_s,
        a_mps2=values,
        notes=(*notes, *channels.offset_notes(values)) if is_uncorrected else notes,
    )


def _scale(source: Source, part: _Part) -> float:
    """Value [m/s2] of the unit, which is given by name, by code or both."""
    name, code = part.line[4].strip().rstrip("."), part.line[5]
    coded = _UNITS.get(int(code), "") if code else ""
    if code and not coded:
        raise InputError(
            f"{source.at(part.at)}: found unit {quoted(name)}, code {int(code)}; use a file of"
            " acceleration in g or cm/s2"
        )
    if coded and name and unit_size(name) != unit_size(coded):
        raise InputError(
            f"{source.at(part.at)}: found unit {quoted(name)} with code {int(code)}, which is"
            f" {coded}; use a file in which they agree"
        )
    return source.scale(name or coded, part.at)


def _reals(source: Source, part: _Part) -> list[Stated]:
    """Real numbers of the heading."""
    for index in range(part.first, part.at):
        match = _REALS.search(source.lines[index])
        layout = layout_of(match[3]) if match else None
        if match and layout:
            # The format has 100. The limit prevents a damaged count from requesting a billion
            # values.
            return header_values(source, index + 1, min(int(match[1]), 1000), layout)
    raise InputError(
        f"{source.at(part.first)}: found no block ... Real-header values follow ...; use the whole"
        " file"
    )


def _real(reals: Sequence[Stated], place: int) -> Stated:
    """Real number at a position, counted from 1; NaN if unknown, which is coded as about -999."""
    number = reals[place - 1] if place <= len(reals) else _UNKNOWN
    return number if number.value > -990.0 else _UNKNOWN


def _step(part: _Part, reals: Sequence[Stated]) -> Stated:
    """Step of the series, or else that of the original record."""
    for place, seconds in ((_SERIES_STEP_MS, 0.001), (_RECORD_STEP_S, 1.0)):
        number = _real(reals, place)
        if number.value > 0.0:
            value, rounding = number.value * seconds, number.rounding * seconds
            # 7.8125 ms are 0.0078125 s: without the binary digits that the product adds.
            return Stated(value=float(f"{value:.12g}"), rounding=rounding, index=number.index)
    return replace(_UNKNOWN, index=reals[0].index if reals else part.first)
