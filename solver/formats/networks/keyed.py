"""Records below a heading of `KEY: value` lines, in English or Spanish, whatever network wrote it.

One vocabulary for all of them: count, step or rate, unit, peak, length, components and start, with
a unit before or behind the colon. Values are columns below the names of components, or one
component across the lines; its peak must be the one that is stated. Read `read` first.
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import chain

import numpy as np

from solver.errors import InputError, raise_any
from solver.formats import phrases, remarks
from solver.formats.channels import (
    centered_peak_notes,
    check_length,
    check_steps,
    motion_file,
    offset_notes,
    time_in,
)
from solver.formats.columns import remedy, rising
from solver.formats.not_accelerations import FEW
from solver.formats.numbers import DECIMAL_COMMA, Block, free_values, is_row, printed, separated
from solver.formats.record_file import MotionFile
from solver.formats.source import Source, Stated
from solver.formats.times import sampled
from solver.model import Floats
from solver.records.record import Record, has_gravity, quoted, unit_size

# Source: INGV, DYNA 1.0 and 1.2, the heading of the Engineering Strong-Motion database, esm-db.eu,
# and of ITACA, whose older files name the component `COMPONENT`; isesd.hi.is, Datafile Format (the
# CD-ROM of 2000); the files of AFAD, CSMNC, CWA, JMA and UNAM (ASA 2.0): no written definition.
_KEYS = {
    "count": r"NDATA|N(?:UMBER|O\.|UM\.|[UÚ]MERO) (?:OF|(?:TOTAL )?DE)"
    r" (?:DATA|SAMPLES|POINTS|VALUES|DATOS|MUESTRAS|PUNTOS)",
    "unit": r"(?:AMPLITUDE)?UNITS?|UNIDADES(?: DE LOS DATOS)?",
    "peak": r"(?:RAW )?PGA|PEAK (?:VALUE|ACCELERATION)|AMPLITUDEMAX"
    r"|ACEL(?:ERACI[OÓ]N)?\.? M[AÁ]X(?:IMA)?(?!.*MUESTRA)",
    "length": r"DURATION|RECORD ?LENGTH|DURACI[OÓ]N",
    "names": r"STREAM|COMPONENTE?|ORIENTATION|ORIENTACI[OÓ]N|DATASEQUENCE|COMP\.",
    "quantity": "DATA_TYPE",
    "start": r"DATE_TIME_FIRST_SAMPLE_YYYYMMDD|RECORD(?:ER)? TIME|START ?TIME|INITIAL TIME"
    r"|TIME OF FIRST SAMPLE",
}
# A line may state two: `NO. OF POINTS:  12800  EQUALLY SPACED INTERVALS OF:  0.005  SEC`.
_ENTRIES = {
    name: re.compile(
        rf"(?:.*\s)?(?:{words})(?![A-Z])([^:=]{{0,40}})(?:[:=]|(?<=COMP\.))\s*+(.*)",
        re.IGNORECASE,
    )
    for name, words in _KEYS.items()
}
_NEXT = re.compile(r"(?<!\s)\s\s++\w")
_FORMS = {
    "AFAD text": "STRONG GROUND MOTION RECORDS OF",
    "ESM, ITACA, AFAD .asc": "NDATA",
    "ISESD": "waveform code",
    "CSMNC": "CSMNC",
    "CWA": "#StationCode",
    "JMA": "SITE CODE=",
    "UNAM": "ARCHIVO ESTANDAR DE ACELERACION",
}
_START_FORMATS = (
    *("%Y%m%d_%H%M%S.%f", "%Y%m%d_%H%M%S", "%d/%m/%Y %H:%M:%S.%f", "%d/%m/%Y %H:%M:%S"),
    *("%d.%m.%Y %H:%M:%S.%f", "%Y-%m-%d %H:%M:%S.%f", "%Y/%m/%d-%H:%M:%S.%f", "%Y %m %d %H %M %S"),
)
_LONGEST_HEADING, _FEWEST, _NEEDED = 120, 2, ("count", "unit")
_NUMBER = re.compile(r"[+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?", re.ASCII)
_VALUED = re.compile(r"[:=]\s*[+-]?\.?\d", re.ASCII)
_NAMED_PEAK = re.compile(r"\(([NSEWUDVZ-]{1,3})\)\s*([+-]?[\d.]+)", re.ASCII)
_NAME = re.compile(r"[A-Z]-?[A-Z]?", re.IGNORECASE)
_UNCORRECTED = re.compile(r"\b(?:RAW|UNCORRECTED)\b", re.IGNORECASE)

# What is behind a key, what is behind its colon, and the index of the line.
_Entry = tuple[str, str, int]


@dataclass(frozen=True, slots=True, kw_only=True)
class _Heading:
    """Entries of the lines above the first row, by what they state."""

    entries: dict[str, list[_Entry]]
    steps: list[Stated]
    first: int  # index of the first row

    def get(self, name: str) -> _Entry:
        """Return the first entry of a name; an empty one for none."""
        return self.entries.get(name, [("", "", 0)])[0]


def recognizes(source: Source) -> bool:
    """Whether lines of text state the step and the count or unit of the numbers below them."""
    heading = _heading(source)
    if heading.first == len(source.lines) or not heading.steps:
        return False
    lines = [source.lines[i] for *_, i in chain.from_iterable(heading.entries.values())]
    # A table below comments alone is text, unless they name its columns.
    is_text = all(line.startswith("#") for line in lines) and len(_words(heading)) < 2
    return len(lines) >= _FEWEST and not heading.entries.keys().isdisjoint(_NEEDED) and not is_text


def read(source: Source) -> MotionFile:
    """Read the one component of a file, or its columns."""
    heading = _heading(source)
    first = heading.first
    top = source.lines[:first]
    if "," in source.lines[first]:
        rows = source.lines[first:]
        is_decimal = all(map(DECIMAL_COMMA.fullmatch, rows[0].split())) and "." not in "".join(rows)
        # `0,12 -0,34` are two numbers, and so are `12, -34`.
        plain = (line.replace(",", "." if is_decimal else " ") for line in rows)
        source = replace(source, lines=[*top, *plain])
    quantity, line = heading.get("quantity")[1:]
    if quantity and ("ACCELERATION" not in quantity.upper() or "SPECTRUM" in quantity.upper()):
        raise InputError(f"{source.at(line)}: found {quantity.lower()}; use a file of acceleration")
    # Of a quantity with its value, such as a peak velocity, the file may still be accelerations.
    titles = [] if any(map(phrases.ACCELERATION.search, top)) else enumerate(top)
    for index, title in titles:
        if (other := remarks.other_quantity(title)) and not _VALUED.search(title):
            raise InputError(
                f"{source.at(index)}: found {other!r} but no acceleration; use the acceleration"
                " file, or correct the line"
            )
    stated = source.agreed(heading.steps)
    dt_s = source.step(stated)
    names = _names(source, heading)
    # Behind the accelerations of ISESD are velocities and displacements.
    later = (i for i in range(first, len(source.lines)) if source.lines[i].startswith("->"))
    columns = _columns(source, heading, next(later, len(source.lines)), len(names))
    if len(names) > 1 and phrases.parse(names[0]).kind is phrases.Kind.TIME:
        even_s, columns, _ = sampled(source, columns[0], columns[1:], first.__add__)
        even = Stated(value=even_s, rounding=1e-4 * even_s, index=first)
        check_steps(source, stated, even)
        names = names[1:]
    scale = _scale(source, heading)
    _, length, index = heading.get("length")
    number = _NUMBER.match(length)
    check_length(source, printed(number[0] if number else "", index), len(columns[0]) * dt_s, dt_s)
    head = "\n".join(top)
    is_uncorrected = _UNCORRECTED.search(head)
    peaks = dict(_peaks(heading, names, scale))
    channels = []
    for name, values in zip(names, columns * scale, strict=True):
        peak_mps2, index = peaks.get(name.upper(), (0.0, 0))
        notes = centered_peak_notes(source, index, peak_mps2, values)
        if is_uncorrected:
            notes += offset_notes(values)
        if len(values) > FEW and values.min() >= 0.0 and values.any() and not has_gravity(values):
            notes += ("no value is below zero: is it a component of acceleration?",)
        channels.append(Record(name=name, dt_s=dt_s, a_mps2=values, notes=notes))
    form = next((form for form, mark in _FORMS.items() if mark in head), "KEY: value")
    # The time zone may stand behind the time.
    begins = re.split(r"\(|[A-Z]", heading.get("start")[1])[0].rstrip()
    factors = remarks.factor_notes(enumerate(top))
    return motion_file(source, form, channels, factors, time_in(begins, *_START_FORMATS))


def _heading(source: Source) -> _Heading:
    entries: dict[str, list[_Entry]] = {}
    steps: list[Stated] = []
    for index, line in enumerate(source.lines[:_LONGEST_HEADING]):
        # A number alone may stand among the lines of a heading.
        if entries and is_row(separated(line.replace(",", " "))):
            return _Heading(entries=entries, steps=steps, first=index)
        steps += phrases.steps_in(source, index, line)
        for name, pattern in _ENTRIES.items():
            if match := pattern.fullmatch(line.strip("# ")):
                value = match[2]
                # Text after two blanks is the next entry of the line if a colon or an equals sign
                # follows.
                next_entry = _NEXT.search(value, 0, max(value.rfind(":"), value.rfind("="), 0))
                value = value[: next_entry and next_entry.start()].strip()
                # All are kept: CWA states the peak of each component on a separate line.
                entries.setdefault(name, []).append((match[1], value, index))
    return _Heading(entries=entries, steps=steps, first=len(source.lines))


def _words(heading: _Heading) -> list[str]:
    """Names of components: between strokes, or with the direction of each in parentheses."""
    _, text, _ = heading.get("names")
    if "/" in text:
        return [word.strip() for word in text.split("/") if word.strip()]
    return re.findall(r"\b\w++(?=[( ])", text) if ";" in text else [text]


def _names(source: Source, heading: _Heading) -> list[str]:
    """Names of the columns: above them, or in the heading; of one component its own, or ""."""
    above = source.lines[heading.first - 1].replace(",", " ").split()
    if len(above) > 1 and all(map(_NAME.fullmatch, above)):
        return above
    named = _words(heading)
    return named if len(named) in (1, len(separated(source.lines[heading.first]))) else [""]


def _columns(source: Source, heading: _Heading, stop: int, width: int) -> Floats:
    """Values, shape (k, n), as many as are stated."""
    rows = [(i, separated(source.lines[i])) for i in range(heading.first, stop)]
    if width > 1:
        raise_any(
            f"{source.at(index)}: found {len(fields)} values; enter {width}"
            for index, fields in rows
            if len(fields) not in (0, width)
        )
    count = sum(len(fields) for _, fields in rows)
    _, text, index = heading.get("count")
    across = len(rows[0][1])
    if not text and width < across:
        raise InputError(
            f"{source.at(heading.first)}: found {across} values in a line, and neither their number"
            " nor names of columns above; enter the names, or the number as in NDATA: 4000"
        )
    if text:
        number = text.strip("/").partition("/")[0]
        if not number.isdecimal():
            raise InputError(
                f"{source.at(index)}: found {quoted(text)}; enter the number of values"
            )
        # With several columns, the number of lines is stated.
        count = width * int(number)
    block = Block(first=heading.first, stop=stop, count=count, promised=index)
    values = free_values(source, block)
    # Full lines only: the last one may be short.
    table = values[: values.size // across * across].reshape(-1, across)
    if width == 1 < across and rising(table):
        raise InputError(f"{source.at(heading.first)}: {remedy(table)}")
    return np.ascontiguousarray(values.reshape(-1, width).T)


def _scale(source: Source, heading: _Heading) -> float:
    """Value [m/s2] of the unit of the values: stated alone, or with the peak of raw values."""
    _, text, index = heading.get("unit")
    if not text:
        peak_text, _, index = heading.get("peak")
        text = peak_text[peak_text.find("(") + 1 :].partition(")")[0]
    # `m/s*s, m/s & s` are those of three series, `gal(cm/s/s)` is one twice.
    parts = [part.strip(" .") for part in re.split(r"[,;()]|\.\s", text)]
    known = next((part for part in parts if not math.isnan(unit_size(part))), text)
    return source.scale(known, index) if text else source.stated_scale(())


def _peaks(
    heading: _Heading, names: Sequence[str], scale: float
) -> Iterator[tuple[str, tuple[float, int]]]:
    """Yield the stated peak [m/s2] of each component that has one, and its line."""
    for peak_text, text, index in heading.entries.get("peak", ()):
        words = re.split(r"[\s()_,.]+", peak_text.strip())
        size = next((unit_size(word) for word in words if not math.isnan(unit_size(word))), scale)
        values = [float(number) for number in _NUMBER.findall(text)]
        if words[-1] in names:  # `AmplitudeMAX. U: 35.9~ -31.2`
            yield words[-1].upper(), (size * max(map(abs, values), default=0.0), index)
        elif named := _NAMED_PEAK.findall(text.upper()):
            yield from ((name, (size * float(value), index)) for name, value in named)
        elif len(values) >= len(names):
            pairs = zip(names, values, strict=False)
            yield from ((name.upper(), (size * value, index)) for name, value in pairs)
