"""K-NET and KiK-net ASCII files of Japan (.NS, .EW, .UD, .NS2, ...): one component, as counts.

Handles this format only. Seventeen named lines of heading, then counts, eight per line. The scale
factor is in gal per count; the counts include the offset of the instrument. Read `read` first.

Source: NIED, About K-NET ASCII format, www.kyoshin.bosai.go.jp/kyoshin/man/knetform_en.html, and
the KiK-net notes there (channels 1 to 3 in the borehole, 4 to 6 at the surface; the stated peak is
without the mean).
"""

from __future__ import annotations

import re
from collections.abc import Sequence

from solver.formats.channels import Channel, motion_file, offset_notes, peak_notes
from solver.formats.motionfile import MotionFile
from solver.formats.numbers import Block, free_values, printed
from solver.formats.source import Source, Stated
from solver.model import InputError
from solver.records.record import shown

_HEADING_LINES = 20
_SCALE = re.compile(r"([\d.]+)\s*\(\s*([A-Z]+)\s*\)\s*/\s*([\d.]+)", re.ASCII | re.IGNORECASE)
_LEADING = re.compile(r"[\d.]+", re.ASCII)

_KIK_NET = {"1": "NS1", "2": "EW1", "3": "UD1", "4": "NS2", "5": "EW2", "6": "UD2"}


def recognizes(lines: Sequence[str]) -> bool:
    """Whether the heading begins with the origin time and has a scale factor."""
    near = lines[:_HEADING_LINES]
    begins = bool(near) and near[0].startswith("Origin Time")
    return begins and any(line.startswith("Scale Factor") for line in near)


def read(source: Source) -> MotionFile:
    """Read the one component of a file."""
    rate = _number(source, "Sampling Freq(Hz)")
    duration = _number(source, "Duration Time(s)")
    _, memo = _entry(source, "Memo.")
    dt_s = source.step(Stated(value=1.0 / rate.value, rounding=0.0, index=rate.index))
    count = round(duration.value * rate.value)
    block = Block(first=memo + 1, stop=len(source.lines), count=count, promised=duration.index)
    values = free_values(source, block) * _scale(source)
    peak, at = _entry(source, "Max. Acc. (gal)", "Max Acc. (gal)")
    stated_mps2 = 0.01 * printed(peak, at).value
    centered = values - values.mean() if len(values) else values
    notes = [*peak_notes(source, at, stated_mps2, centered), *offset_notes(values)]
    direction, _ = _entry(source, "Dir.")
    name = _KIK_NET.get(direction, direction)
    if name.endswith("1"):
        notes.append("the sensor is in the borehole, not at the surface")
    form = "KiK-net" if direction in _KIK_NET else "K-NET"
    channel = Channel(name=name, dt_s=dt_s, a_mps2=values, notes=tuple(notes))
    return motion_file(source, form, [channel])


def _entry(source: Source, *names: str) -> tuple[str, int]:
    """Text of a line of the heading behind its name, and its index."""
    for index, line in enumerate(source.lines[:_HEADING_LINES]):
        for name in names:
            if line.startswith(name):
                return line[len(name) :].strip(), index
    raise InputError(f"{source.name}: found no line {names[0]}; give the whole heading")


def _number(source: Source, name: str) -> Stated:
    text, index = _entry(source, name)
    match = _LEADING.match(text)
    stated = printed(match[0] if match else "", index)
    if not 0.0 < stated.value < 1e6:
        raise InputError(f"{source.at(index)}: found {shown(text)}; give a number above 0")
    return stated


def _scale(source: Source) -> float:
    """Value of one count [m/s2]."""
    text, index = _entry(source, "Scale Factor")
    match = _SCALE.match(text)
    over, under = (printed(match[i], index).value for i in (1, 3)) if match else (0.0, 0.0)
    if not match or not (over > 0.0 and under > 0.0):
        raise InputError(
            f"{source.at(index)}: found {shown(text)}; give a scale as 3920(gal)/6182761"
        )
    return source.scale(match[2], index) * over / under
