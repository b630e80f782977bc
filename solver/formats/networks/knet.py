"""K-NET and KiK-net files of Japan: ASCII (.NS, .EW, .UD, .NS2, ...) and CSV.

Handles these formats only. ASCII is one component: seventeen named lines of heading, then counts,
eight per line, with a scale factor in gal per count. CSV is a station: lines of heading after `#`,
then a date, the time from the start and the three or six components in gal. Both include the offset
of the instrument. Read `read` first.
"""

from __future__ import annotations

import re

from solver.errors import InputError
from solver.formats.channels import centered_peak_notes, motion_file, offset_notes, time_in
from solver.formats.numbers import COMPARED, Block, check_last, dated_table, free_values, printed
from solver.formats.record_file import MotionFile
from solver.formats.source import Source, Stated
from solver.formats.times import sampled
from solver.model import Floats
from solver.records.record import Record, quoted
from solver.spaces import NO_BREAK

# Source: NIED, About K-NET ASCII format, www.kyoshin.bosai.go.jp/kyoshin/man/knetform_en.html, and
# the KiK-net notes there (channels 1 to 3 in the borehole, 4 to 6 at the surface; the stated peak
# is without the mean). CSV: the files of NIED from 2024 on; the duration is in whole seconds.
_HEADING_LINES = 20
_SCALE = re.compile(r"([\d.]+)\s*\(\s*([A-Z]+)\s*\)\s*/\s*([\d.]+)", re.ASCII | re.IGNORECASE)
_LEADING = re.compile(r"[\d.]+", re.ASCII)

_CSV_HEADING_LINES = 40
_COLUMNS = re.compile(r"#?\s*Time\s*,\s*RelativeTime\s*\(s\)\s*,", re.IGNORECASE)
_IN_UNIT = re.compile(r"([^()\s]*+)\s*+\(([^()]+)\)")

_START = "%Y/%m/%d %H:%M:%S.%f"

_BOREHOLE = "the sensor is in the borehole, not at the surface"
_KIK_NET = {"1": "NS1", "2": "EW1", "3": "UD1", "4": "NS2", "5": "EW2", "6": "UD2"}


def recognizes(source: Source) -> bool:
    """Whether the heading has origin time and scale factor, or the columns of the CSV."""
    near = source.lines[:_HEADING_LINES]
    begins = bool(near) and near[0].startswith("Origin Time")
    is_csv = any(map(_COLUMNS.match, source.lines[:_CSV_HEADING_LINES]))
    return is_csv or (begins and any(line.startswith("Scale Factor") for line in near))


def read(source: Source) -> MotionFile:
    """Read the one component of a file of counts, or all of a CSV."""
    lines = enumerate(source.lines[:_CSV_HEADING_LINES])
    index = next((i for i, line in lines if _COLUMNS.match(line)), -1)
    return _csv(source, index) if index >= 0 else _counts(source)


def _csv(source: Source, top: int) -> MotionFile:
    """Read the components below the line of columns at an index."""
    heads = [text.strip() for text in source.lines[top].split(",")]
    rows = [(i, row.split(",")) for i, row in enumerate(source.lines) if i > top and row.strip()]
    if len(rows) < 2:
        raise InputError(
            f"{source.at(top)}: found {len(rows)} rows below it; use the complete file"
        )
    table = dated_table(source, rows, len(heads))
    lines = [index for index, _ in rows]
    check_last(source, rows[-1][0], [fields[-1].strip() for _, fields in rows[-COMPARED:]])
    dt_s, columns, notes = sampled(source, table[:, 0], table[:, 1:].T, lines.__getitem__)
    channels = [
        _component(source, top, head, dt_s, values)
        for head, values in zip(heads[2:], columns, strict=True)
    ]
    # KiK-net names its channels NS1 to UD2, K-NET names them N-S, E-W and U-D.
    form = "KiK-net CSV" if channels[0].name[-1:].isdecimal() else "K-NET CSV"
    notes += _length_notes(source, len(table) * dt_s)
    return motion_file(source, form, channels, notes, time_in(rows[0][1][0], _START))


def _component(source: Source, index: int, head: str, dt_s: float, values: Floats) -> Record:
    """Return a column of the CSV as a record by its heading, a name with its unit."""
    unit = _IN_UNIT.fullmatch(head)
    if not unit:
        raise InputError(f"{source.at(index)}: found {quoted(head)}; enter a column as N-S(gal)")
    name, a_mps2 = _KIK_NET.get(unit[1], unit[1]), values * source.scale(unit[2], index)
    borehole = (_BOREHOLE,) if name.endswith("1") else ()
    return Record(name=name, dt_s=dt_s, a_mps2=a_mps2, notes=(*offset_notes(a_mps2), *borehole))


def _length_notes(source: Source, length_s: float) -> tuple[str, ...]:
    """Compare a CSV with the duration that its heading states, in whole seconds."""
    lines = source.lines[:_CSV_HEADING_LINES]
    named = (i for i, line in enumerate(lines) if line.startswith("#DurationTime"))
    index = next(named, len(lines))
    stated_s = printed(source.line(index + 1).strip("#, "), index + 1).value
    if not abs(stated_s - length_s) > 1e-6:
        return ()
    words = f"the heading states {stated_s:g}{NO_BREAK}s, the record lasts {length_s:g}{NO_BREAK}s"
    # Whole seconds hide less than one; more is a file that was cut.
    if abs(stated_s - length_s) >= 1.0:
        raise InputError(f"{source.at(index + 1)}: {words}; use the complete file")
    return (words,)


def _counts(source: Source) -> MotionFile:
    rate = _number(source, "Sampling Freq(Hz)")
    duration = _number(source, "Duration Time(s)")
    _, memo = _entry(source, "Memo.")
    dt_s = source.step(Stated(value=1.0 / rate.value, index=rate.index))
    # The format does not state a count.
    count = round(duration.value * rate.value)
    block = Block(first=memo + 1, stop=len(source.lines), count=count, promised=duration.index)
    values = free_values(source, block) * _scale(source)
    peak, index = _entry(source, "Max. Acc. (gal)", "Max Acc. (gal)")
    # In gal, and without the mean, which the counts have.
    stated_mps2 = 0.01 * printed(peak, index).value
    notes = [*centered_peak_notes(source, index, stated_mps2, values), *offset_notes(values)]
    direction, _ = _entry(source, "Dir.")
    name = _KIK_NET.get(direction, direction)
    if name.endswith("1"):
        notes.append(_BOREHOLE)
    form = "KiK-net" if direction in _KIK_NET else "K-NET"
    channel = Record(name=name, dt_s=dt_s, a_mps2=values, notes=tuple(notes))
    return motion_file(source, form, [channel])


def _entry(source: Source, *names: str) -> tuple[str, int]:
    """Text of a line of the heading behind its name, and its index."""
    for index, line in enumerate(source.lines[:_HEADING_LINES]):
        for name in names:
            if line.startswith(name):
                return line[len(name) :].strip(), index
    raise InputError(f"{source.name}: found no line {names[0]}; use the complete heading")


def _number(source: Source, name: str) -> Stated:
    text, index = _entry(source, name)
    match = _LEADING.match(text)
    stated = printed(match[0] if match else "", index)
    if not 0.0 < stated.value < 1e6:
        raise InputError(f"{source.at(index)}: found {quoted(text)}; enter a number above 0")
    return stated


def _scale(source: Source) -> float:
    """Value of one count [m/s2]."""
    text, index = _entry(source, "Scale Factor")
    match = _SCALE.match(text)
    over, under = (printed(match[i], index).value for i in (1, 3)) if match else (0.0, 0.0)
    if not match or not (over > 0.0 and under > 0.0):
        raise InputError(
            f"{source.at(index)}: found {quoted(text)}; enter a scale as 3920(gal)/6182761"
        )
    return source.scale(match[2], index) * over / under
