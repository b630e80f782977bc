"""How a table of numbers is laid out in lines: headings, rows and separators, what programs add.

Quotes, `sep=`, commas at the ends and a row of units are taken off, each line at its index, so that
messages name the lines of the file. Reads no table. Read `plain_lines`, then `parse`.
"""

from __future__ import annotations

import csv
import math
import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from enum import Enum
from itertools import islice

import numpy as np

from solver.formats.numbers import DECIMAL_COMMA, NUMBER, field_problems, number_in
from solver.formats.source import Source
from solver.model import Floats, InputError
from solver.records.record import is_other_unit, is_raw, raise_any, unit_size

# Also as loggers of other languages head them.
_TIMES = {"t", "time", "times", "zeit", "tiempo", "temps", "tempo", "sec", "secs", "seconds"}
SECONDS = (
    dict.fromkeys(("s", "sec", "secs", "second", "seconds"), 1.0)
    | dict.fromkeys(("ms", "msec", "msecs", "millisecond", "milliseconds"), 0.001)
    | dict.fromkeys(("min", "mins", "minute", "minutes"), 60.0)
)
OTHER_TIMES = {"us", "µs", "μs", "ns", "usec", "h", "hr", "hrs", "hour", "hours", "day", "days"}
_INDEXES = {
    *("count", "counter", "frame", "i", "idx", "index", "n", "no", "nr", "number"),
    *("point", "points", "pt", "row", "sample", "samples", "step"),
}

_NOT_ACCELERATIONS = re.compile(
    r"(?<![a-z])(?:vel|veloc|velocity|velocities|disp|displ|displacements?|temp|temperature"
    r"|batt|battery|voltage|gyro|gyroscope|gyr|rotation|mag(?=[ _]?[xyz]\b)|magnet[a-z]*|pressure"
    r"|humidity|altitude|latitude|longitude|pitch|roll|yaw|quat[a-z]*|strain|jerk)(?![a-z])",
    re.IGNORECASE,
)
# The length of the vector, as loggers write it beside its components.
_MAGNITUDE = re.compile(
    r"(?<![a-z])(?:abs|absolute|[a-z]*betrag|res|resultante?|vector ?sum|sum|total|combined"
    r"|mag|magnitude|norm|modulus|srss)(?![a-z])|\|.*\||(?:at|tgf)$",
    re.IGNORECASE,
)
ACCELERATION = re.compile(r"(?<![a-z])acc", re.IGNORECASE)

_ABSCISSAS = re.compile(
    r"(?:freq|frequency|frequencies|periods?|tn)(?![a-z])|.*\bhz\b", re.IGNORECASE
)
_SPECTRAL = re.compile(
    r"(?<![a-z])(?:p?s_?[avd]|p?r?s_?acc|spectr(?:al|um)|pseudo|response)(?![a-z])", re.IGNORECASE
)

_BRACKETED = re.compile(r"([^\[(]*)[\[(]([^\])]*)[\])]\s*")
_IN = re.compile(r"(.*\S)\s+in\s+(\S+)", re.IGNORECASE)
_WORD = re.compile(r"[^\s\[(]+(?:\s?[\[(][^\])]*[\])])?")


class Kind(Enum):
    """Content of a column according to its heading."""

    TIME = "time"
    ACCELERATION = "acceleration"
    OTHER = "other"
    UNSAID = "unsaid"


@dataclass(frozen=True, slots=True, kw_only=True)
class Heading:
    """Heading of one column."""

    text: str  # as written
    name: str  # without its unit
    kind: Kind
    unit: str  # as written; empty if there is none
    seconds: float  # value [s] of the unit of a time, NaN if it is not known; 1 if there is none

    @property
    def is_magnitude(self) -> bool:
        """Whether it is a word for the length of a vector, if no value is below zero."""
        return bool(_MAGNITUDE.search(self.name.replace("_", " ")))

    @property
    def is_index(self) -> bool:
        """Whether it is a word for the number of a sample, if the values rise."""
        return not self.unit and self.name.rstrip(".").lower() in _INDEXES


def parse(text: str) -> Heading:
    """Interpret a heading such as ``t_s``, ``acc_g``, ``EW [cm/s2]`` or ``a in gal``."""
    # Excel quotes a heading that has a comma.
    text = text.strip().strip("\"'").strip()
    name, unit = _split(text)
    kind, seconds = _kind(name, unit)
    return Heading(text=text, name=name, kind=kind, unit=unit, seconds=seconds)


def settled(headings: list[Heading]) -> list[Heading]:
    """Treat the g of ``ch_g`` as a letter, not a unit, if neighbors like ``ch_f`` have no unit."""
    if not any(heading.kind is Kind.UNSAID for heading in headings[1:]):
        return headings
    return [
        replace(heading, name=heading.text, kind=Kind.UNSAID, unit="")
        if heading.kind is Kind.ACCELERATION and heading.text.lower().endswith("_g")
        else heading
        for heading in headings
    ]


def words(line: str, separator: str | None) -> list[str]:
    """Headings in a line: between separators, or words, each with the bracket that follows it."""
    return _WORD.findall(line) if separator is None else line.split(separator)


def is_spectral(heading: Heading) -> bool:
    """Whether a column has ordinates of a spectrum."""
    return bool(_SPECTRAL.search(heading.name))


def of_a_spectrum(headings: list[Heading]) -> list[str]:
    """Return the headings by which a table is a spectrum: no time, or ordinates alone."""
    first, *others = headings
    spectral = [each.text for each in others if is_spectral(each)]
    if _ABSCISSAS.match(first.text):
        return [first.text, *spectral]
    return spectral if spectral and len(spectral) == len(others) else []


def remark(line: str, separator: str | None, width: int) -> list[Heading]:
    """Headings at the beginning of a comment, without any text after them; empty if none."""
    texts = words(line, separator)[:width]
    if len(texts) < width or width < 2 or parse(texts[0]).kind is not Kind.TIME:
        return []
    # The last heading may run on as text: then its first word counts.
    last = parse(texts[-1])
    if last.kind is Kind.UNSAID and (first_word := _WORD.search(texts[-1])):
        last = parse(first_word[0])
    return [*map(parse, texts[:-1]), last]


def _split(text: str) -> tuple[str, str]:
    """Name and unit of a heading."""
    for pattern in (_BRACKETED, _IN):
        match = pattern.fullmatch(text)
        if match and (_is_unit(match[2], bracketed=True) or _is_time(match[1])):
            return match[1].strip(), match[2].strip()
    # The first underscore with a unit behind it: a unit may have underscores, as m_s2.
    for place in (i for i, letter in enumerate(text) if letter == "_"):
        name, unit = text[:place], text[place + 1 :]
        if _is_unit(unit, bracketed=False) or (_is_time_unit(unit) and _is_time(name)):
            return name, unit
    # A unit alone, such as `min`; shorter ones may be directions: NS, S.
    is_unit = text.lower() == "ms" or (len(text) > 2 and _is_time_unit(text))
    return (text, text) if is_unit and not _is_time(text) else (text, "")


def _is_unit(text: str, *, bracketed: bool) -> bool:
    plain = text.strip().lower()
    if bracketed and (plain in SECONDS or (len(plain) > 2 and _is_time_unit(plain))):
        return True
    # After an underscore, `in` and `deg` may as well be words.
    other = is_other_unit(text) and (bracketed or "/" in text or text.lower() in ("mm", "cm", "m"))
    return other or is_raw(text) or not math.isnan(unit_size(text))


def _is_time(name: str) -> bool:
    return name.strip().lower() in _TIMES


def _is_time_unit(text: str) -> bool:
    return text.strip().lower() in SECONDS.keys() | OTHER_TIMES


def _kind(name: str, unit: str) -> tuple[Kind, float]:
    if _is_time_unit(unit):
        return Kind.TIME, SECONDS.get(unit.strip().lower(), math.nan)
    # A velocity in g is a velocity or an acceleration: no unit decides what a name denies.
    if _NOT_ACCELERATIONS.search(name) and not ACCELERATION.search(name):
        return Kind.OTHER, 1.0
    if not math.isnan(unit_size(unit)) or is_raw(unit):
        return Kind.ACCELERATION, 1.0
    if unit and is_other_unit(unit):
        return Kind.OTHER, 1.0
    if _is_time(name):
        return Kind.TIME, math.nan if unit else 1.0
    return Kind.OTHER if unit else Kind.UNSAID, 1.0


_SEP = re.compile(r'"?sep=([,;\t| ])"?', re.IGNORECASE)
_QUOTED = re.compile(r'"[^"]*" *([,;\t|])?')
_GROUPED = re.compile(r"[+-]?[1-9]\d{0,2},\d{3}", re.ASCII)
_MARKS = ",;\t"
_SEEN = 200
_BLANK_BETWEEN = re.compile(r"[^,\s]\s+[^,\s]")

# Index of a line, and its content.
Row = tuple[int, str]


def plain_lines(lines: Sequence[str]) -> list[str]:
    """Return the lines of a table without what its program added, as many as there are.

    Separators between quoted fields become semicolons; a decimal comma becomes a point where the
    columns are separated by something else and no number has a point.
    """
    plain = list(lines)
    first = next((i for i, line in enumerate(plain) if line.strip()), 0)
    separator = ""
    if plain and (match := _SEP.fullmatch(plain[first].strip(" "))):
        separator, plain[first] = match[1], ""
    near = list(islice((line for line in plain if _is_row(line)), _SEEN))
    if any('"' in line for line in near):
        marks = (match[1] for line in near for match in _QUOTED.finditer(line) if match[1])
        mark = separator or next(marks, ",")
        plain = [_unquoted(line, mark) if _is_row(line) else line for line in plain]
    elif separator == "|":
        plain = [line.replace("|", ";") if _is_row(line) else line for line in plain]
    return _without_decimal_commas(_without_units_row(_without_last_marks(plain)))


def _is_row(line: str) -> bool:
    return line.strip()[:1] not in ("", "#")


def _unquoted(line: str, mark: str) -> str:
    # Semicolons: a quoted field may have the comma that separated it.
    fields = next(csv.reader([line], delimiter=mark, skipinitialspace=True))
    return ";".join(field.replace(";", " ") for field in fields)


def _rows(lines: Sequence[str]) -> list[int]:
    """Indexes of the first rows, the heading among them."""
    return list(islice((i for i, line in enumerate(lines) if _is_row(line)), _SEEN))


def _without_last_marks(lines: list[str]) -> list[str]:
    """Take the separator off the ends of all lines, if each of the first ones has it there."""
    rows = [lines[i].rstrip(" ") for i in _rows(lines)]
    if len(rows) < 2 or not all(row.endswith(tuple(_MARKS)) for row in rows[1:]):
        return lines
    # Excel ends every line with the separator of an empty last column.
    mark, widths = rows[1][-1], {row.count(rows[1][-1]) for row in rows[1:]}
    is_headed = not rows[0].endswith(mark) and rows[0].count(mark) == rows[1].count(mark)
    if is_headed or len(widths) > 1:
        return lines  # the last column has a heading: its values are missing
    return [line.rstrip(" ").removesuffix(mark) for line in lines]


def _without_units_row(lines: list[str]) -> list[str]:
    """Put the units of a second row behind the headings of the first."""
    rows = _rows(lines)
    if len(rows) < 3:
        return lines
    top, below = lines[rows[0]], lines[rows[1]]
    mark = next((mark for mark in ";,\t" if mark in below), None)
    names, units = top.split(mark), below.split(mark)
    kinds = [parse(f"a [{unit.strip(' []()')}]") for unit in units if unit.strip()]
    is_units = kinds and all(
        each.kind in (Kind.ACCELERATION, Kind.TIME) or each.unit for each in kinds
    )
    if not is_units or len(names) != len(units) or any(map(NUMBER.fullmatch, units)):
        return lines
    pairs = zip(names, units, strict=True)
    said = [
        f"{name.strip()} [{plain}]" if (plain := u.strip(" []()")) else name for name, u in pairs
    ]
    return [*lines[: rows[0]], (mark or " ").join(said), *lines[rows[0] + 1 : rows[1]], "",
            *lines[rows[1] + 1 :]]  # fmt: skip


def _without_decimal_commas(lines: list[str]) -> list[str]:
    near = [lines[i] for i in _rows(lines)]
    mark = ";" if any(";" in line for line in near) else "\t"
    body = [line for line in near if mark in line and line.lstrip()[:1] in "+-.0123456789"]
    fields = [field.strip() for line in body for field in line.split(mark)]
    commas = [field for field in fields if "," in field]
    if (
        not commas
        or not all(DECIMAL_COMMA.fullmatch(field) or NUMBER.fullmatch(field) for field in fields)
        # 1,000 may be one or a thousand: it is left to be refused.
        or all(map(_GROUPED.fullmatch, commas))
        or any("." in line for line in lines if line.lstrip()[:1] in "+-.0123456789")
    ):
        return lines
    return [
        line.replace(",", ".") if line.lstrip()[:1] in "+-.0123456789" else line for line in lines
    ]


def content_of(line: str) -> str:
    """Return a line without comment and blanks at its ends."""
    return line.partition("#")[0].strip()


def rows_of(lines: Sequence[str], start: int) -> Iterator[Row]:
    """Index and content of each line from index `start` on that is not blank or a comment."""
    for index in range(start, len(lines)):
        if content := content_of(lines[index]):
            yield index, content


def first_row(lines: Sequence[str]) -> int:
    """Index of the first line that may have numbers: after the heading, if there is one."""
    for index, content in rows_of(lines, 0):
        return index + 1 if is_heading(content) else index
    return len(lines)


def is_heading(content: str) -> bool:
    """Whether a line begins with what is no number."""
    word = re.split(r"[,;\s]", content)[0]
    return content[0] not in "+-.0123456789" and word.lower() not in {"nan", "inf", "infinity"}


def separator_of(content: str) -> str | None:
    """Separator of the columns; None for blanks and tabs. The commas of `0,1 0,2` are decimal."""
    if ";" in content:
        return ";"
    return "," if "," in content and not _BLANK_BETWEEN.search(content) else None


# No shaking rises from line to line. Fewer rows than `_FEW` show nothing; in `_MANY` a column need
# not rise evenly, as times of loggers do not.
_FEW, _MANY = 5, 12
_EVEN_WITHIN, _OFTEN = 0.01, 0.1  # of a step, of all steps


def rising(table: Floats) -> list[int]:
    """Indexes of the columns that rise from row to row, evenly where there are few rows."""
    rows = len(table)
    if rows < _FEW:
        return []
    steps = np.diff(table, axis=0)
    usual = (table[-1] - table[0]) / (rows - 1)
    # Rounded times stand twice; zeros up to a last pulse are no times.
    rises = (steps >= 0.0).all(axis=0) & ((steps > 0.0).mean(axis=0) > _OFTEN)
    if rows < _MANY:
        rises &= np.abs(steps - usual).max(axis=0) <= _EVEN_WITHIN * usual
    return [int(column) for column in np.flatnonzero(rises)]


def remedy(table: Floats) -> str:
    """Return what would do for a table of two or more columns without headings."""
    heading = f"a heading such as time_s,x_g{',y_g' * (table.shape[1] > 2)}"
    if not (columns := rising(table)):
        return (
            f"give {heading}, or put one on each line, or give the values per line to motion"
            f" convert (--values-per-line {table.shape[1]})"
        )
    which = ", ".join(str(column + 1) for column in columns)
    return (
        f"times or line numbers rise in column {which}: put each time first on a line with its"
        f" values, below {heading}; delete line numbers"
    )


def check_shape(source: Source, start: int, separator: str | None) -> None:
    """Raise for rows that are no columns: values across the lines, or a first row unlike all."""
    rows = [(i, len(row.split(separator))) for i, row in rows_of(source.lines, start)]
    (first, width), *others = rows
    heading = content_of(source.lines[start - 1]) if start else ""
    is_headed = bool(heading) and len(words(heading, separator)) == width
    if len(others) < 2:
        return
    *middle, (last, left) = others
    widths = {numbers for _, numbers in middle}
    if not is_headed and widths == {width} and left < width:
        table = across(source, start, separator, width)[:-left].reshape(-1, width)
        raise InputError(
            f"{source.at(last)}: found {left} values after lines of {width}: values across the"
            f" lines, not in columns; {remedy(table)}"
        )
    if len(widths) == 1 and widths != {width} and left <= min(widths):
        raise InputError(
            f"{source.at(first)}: found {width} numbers above rows of {min(widths)}; if they are no"
            " samples, put # before them, and give the time step"
        )


def across(source: Source, start: int, separator: str | None, due: int) -> Floats:
    """Return values across the lines, as many in each but the last, as one column, shape (n, 1)."""
    rows = [(i, row.rstrip(",;").split(separator)) for i, row in rows_of(source.lines, start)]
    raise_any(
        f"{source.at(index)}: found {len(fields)} values; give {due} as in every line but the last"
        for index, fields in rows
        if len(fields) > due or (len(fields) < due and index != rows[-1][0])
    )
    raise_any(problem for i, fields in rows for problem in field_problems(source, i, fields))
    values = np.array([number_in(field) for _, fields in rows for field in fields])
    table = values[: values.size // due * due].reshape(-1, due)
    if due > 1 and rising(table):
        raise InputError(f"{source.name}: found no values across the lines; {remedy(table)}")
    return values.reshape(-1, 1)
