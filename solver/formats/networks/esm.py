"""Files of ESM, ITACA and AFAD (.asc), and AFAD's text: a heading of `KEY: value`, then columns.

Handles these two formats only. An .asc has one component, a value a line, and names its count,
step, unit, peak and quantity; corrected velocities, displacements and spectra have the same heading
and are refused. AFAD's text has three components below their names. Read `read` first.
"""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence

from solver.formats.channels import (
    MotionFile,
    centered_peak_notes,
    check_length,
    motion_file,
    offset_notes,
    time_in,
)
from solver.formats.numbers import Block, free_values, is_row, printed
from solver.formats.source import Source
from solver.model import InputError
from solver.records.record import Record, raise_any, shown

# Source: INGV, DYNA 1.0 and 1.2, the heading of the Engineering Strong-Motion database, esm-db.eu,
# and of ITACA, whose older files name the component `COMPONENT`; AFAD's text (STRONG GROUND MOTION
# RECORDS OF TURKIYE, 18 lines) as tadas.afad.gov.tr gives it: there is no written definition.
_LONGEST_HEADING = 100
_COUNTS = "NDATA", "NUMBER OF DATA"
_STEPS = "SAMPLING_INTERVAL_S", "SAMPLING INTERVAL (SEC)", "SAMPLING INTERVAL (S)"
_START = "DATE_TIME_FIRST_SAMPLE_YYYYMMDD_HHMMSS", "RECORD TIME"
_START_FORMATS = "%Y%m%d_%H%M%S.%f", "%Y%m%d_%H%M%S", "%d/%m/%Y %H:%M:%S.%f", "%d/%m/%Y %H:%M:%S"
_PEAK, _LENGTH, _QUANTITY, _UNIT = "PGA_CM/S^2", "DURATION_S", "DATA_TYPE", "UNITS"
_PEAKS = re.compile(r"(?:RAW )?PGA VALUES\s*\((.*)\)")
_NAMED_PEAK = re.compile(r"\(([NSEWUDVZ-]{1,3})\)\s*([+-]?[\d.]+)", re.ASCII)
_NAME = re.compile(r"[A-Z]-?[A-Z]?", re.IGNORECASE)

# Text and index of each line of a heading, by what stands before its colon, in capitals.
_Heading = Mapping[str, tuple[str, int]]


def recognizes(source: Source) -> bool:
    """Whether the first lines name the count and the step."""
    heading = _heading(source.lines)
    return any(key in heading for key in _COUNTS) and any(key in heading for key in _STEPS)


def read(source: Source) -> MotionFile:
    """Read the one component of an .asc, or the three of AFAD's text."""
    heading = _heading(source.lines)
    first = next((i for i, line in enumerate(source.lines) if is_row(line.split())), 0)
    count, promised = _entry(source, heading, *_COUNTS)
    step, at = _entry(source, heading, *_STEPS)
    # `printed` would take 21.0 for a count.
    if not count.isdecimal():
        raise InputError(f"{source.at(promised)}: found {shown(count)}; give the number of values")
    dt_s = source.step(printed(step, at))
    names = source.lines[first - 1].split()
    # Above the first row AFAD's text has the names of the components, and an .asc a line of its
    # heading.
    is_afad = len(names) > 1 and all(map(_NAME.fullmatch, names))
    number = int(count) * (len(names) if is_afad else 1)
    block = Block(first=first, stop=len(source.lines), count=number, promised=promised)
    if is_afad:
        form, channels = "AFAD text", _afad(source, heading, names, dt_s, block)
    else:
        form, channels = "ESM, ITACA, AFAD .asc", _asc(source, heading, dt_s, block)
    # AFAD has the time zone in parentheses behind the time.
    begins = next((heading[key][0] for key in _START if key in heading), "").partition("(")[0]
    return motion_file(source, form, channels, start=time_in(begins, *_START_FORMATS))


def _asc(source: Source, heading: _Heading, dt_s: float, block: Block) -> list[Record]:
    quantity, at = heading.get(_QUANTITY, ("ACCELERATION", 0))
    if "ACCELERATION" not in quantity.upper() or "SPECTRUM" in quantity.upper():
        raise InputError(f"{source.at(at)}: found {quantity.lower()}; give a file of acceleration")
    scale = source.scale(*_entry(source, heading, _UNIT))
    values = free_values(source, block) * scale
    length, at = heading.get(_LENGTH, ("", 0))
    check_length(source, printed(length, at), len(values) * dt_s, dt_s)
    peak, at = heading.get(_PEAK, ("", 0))
    name, _ = heading.get("STREAM", heading.get("COMPONENT", ("", 0)))
    notes = centered_peak_notes(source, at, 0.01 * printed(peak, at).value, values)
    return [Record(name=name, dt_s=dt_s, a_mps2=values, notes=notes)]


def _afad(
    source: Source, heading: _Heading, names: Sequence[str], dt_s: float, block: Block
) -> list[Record]:
    peaks = next(((m, *heading[key]) for key in heading if (m := _PEAKS.fullmatch(key))), None)
    if not peaks:
        raise InputError(f"{source.name}: found no line RAW PGA VALUES; give the whole heading")
    unit, text, at = peaks
    scale = source.scale(unit[1], at)
    raise_any(
        f"{source.at(index)}: found {len(fields)} values; give {len(names)}"
        for index in range(block.first, block.stop)
        if len(fields := source.lines[index].split()) not in (0, len(names))
    )
    columns = free_values(source, block).reshape(-1, len(names)).T * scale
    stated = {m[1]: printed(m[2], at).value * scale for m in _NAMED_PEAK.finditer(text.upper())}
    records = []
    for name, values in zip(names, columns, strict=True):
        notes = centered_peak_notes(source, at, stated.get(name.upper(), 0.0), values)
        notes = (*notes, *offset_notes(values))
        records.append(Record(name=name, dt_s=dt_s, a_mps2=values, notes=notes))
    return records


def _heading(lines: Sequence[str]) -> _Heading:
    heading: dict[str, tuple[str, int]] = {}
    for index, line in enumerate(lines[:_LONGEST_HEADING]):
        key, colon, text = line.partition(":")
        if colon:
            heading.setdefault(" ".join(key.split()).upper(), (text.strip(), index))
        elif is_row(line.split()):
            break
    return heading


def _entry(source: Source, heading: _Heading, *keys: str) -> tuple[str, int]:
    for key in keys:
        if key in heading:
            return heading[key]
    raise InputError(f"{source.name}: found no line {keys[0]}; give the whole heading")
