"""Headings of columns of text: their names, and the units that they state.

Interprets headings; reads no numbers. Read `parse` first.
"""

from __future__ import annotations

import math
import re
from dataclasses import dataclass, replace
from enum import Enum

from solver.records.units import is_other_unit, unit_size

_TIMES = {"t", "time", "times", "zeit", "tiempo", "temps", "tempo", "sec", "secs", "seconds"}
_SECONDS = (
    dict.fromkeys(("s", "sec", "secs", "second", "seconds"), 1.0)
    | dict.fromkeys(("ms", "msec"), 0.001)
    | dict.fromkeys(("min", "mins", "minute", "minutes"), 60.0)
)
_OTHER_TIMES = {"us", "µs", "μs", "ns", "usec", "h", "hr", "hrs", "hour", "hours", "day", "days"}
_INDEXES = {
    *("count", "counter", "frame", "i", "idx", "index", "n", "no", "nr", "number"),
    *("point", "points", "pt", "row", "sample", "samples", "step"),
}

_NOT_ACCELERATIONS = re.compile(
    r"(?<![a-z])(?:vel|veloc|velocity|velocities|disp|displ|displacement|displacements)(?![a-z])",
    re.IGNORECASE,
)
_ACCELERATION = re.compile(r"(?<![a-z])acc", re.IGNORECASE)

_ABSCISSAS = re.compile(
    r"(?:freq|frequency|frequencies|periods?|tn)(?![a-z])|.*\bhz\b", re.IGNORECASE
)
_SPECTRAL = re.compile(
    r"(?<![a-z])(?:p?s_?[avd]|p?r?s_?acc|spectr(?:al|um)|pseudo|response)(?![a-z])", re.IGNORECASE
)

_BRACKETED = re.compile(r"([^\[(]*)[\[(]([^\])]*)[\])]\s*")
_IN = re.compile(r"(.*\S)\s+in\s+(\S+)", re.IGNORECASE)
_WORD = re.compile(r"[^\s\[(]+(?:\s?[\[(][^\])]*[\])])?")
_IN_BRACKETS = re.compile(r"[\[(]([^\])]{1,16})[\])]")
_UNITS_OF = re.compile(
    r"\bunits?\b[\s:=]*+(?:(?:of|in|are|is)\b[\s:=]*+)?([^\s,;]+)", re.IGNORECASE
)
_STATES_UNITS = re.compile(r"\bunits?\b", re.IGNORECASE)
_IN_PROSE = re.compile(r"\bin\s+([^\s,;]+)", re.IGNORECASE)
_STEP = re.compile(
    r"\b(?:dt|time[ _]step)(?:_s\b|\b)\s*+(?:[\[(]s[\])]\s*+)?[:=]\s*"
    r"([+-]?[0-9.]+(?:[eE][+-]?\d+)?)\s*(ms\b)?",
    re.ASCII | re.IGNORECASE,
)


_COUNT = re.compile(
    r"\b(?:number|no\.?) of (?:points|samples|values)\b\s*+(?:[:=]\s*)?(\d{1,9})\b(?![.,]\d)",
    re.ASCII | re.IGNORECASE,
)


class Kind(Enum):
    """Content of a column according to its heading."""

    TIME = "time"
    ACCELERATION = "acceleration"
    OTHER = "other"
    UNSAID = "unsaid"


@dataclass(frozen=True, slots=True, kw_only=True)
class Heading:
    """Heading of one column.

    Attributes
    ----------
    text : str
        As written.
    name : str
        The heading without its unit.
    kind : Kind
    unit : str
        As written; "" if there is none.
    seconds : float
        Value [s] of the unit of a time, NaN if it is not known; 1 if there is none.
    """

    text: str
    name: str
    kind: Kind
    unit: str
    seconds: float

    @property
    def is_index(self) -> bool:
        """Whether it is a word for the number of a sample, if the values rise."""
        return not self.unit and self.name.rstrip(".").lower() in _INDEXES


def parse(text: str) -> Heading:
    """Interpret a heading such as ``t_s``, ``acc_g``, ``EW [cm/s2]`` or ``a in gal``."""
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
    last = parse(texts[-1])
    if last.kind is Kind.UNSAID and (first_word := _WORD.search(texts[-1])):
        last = parse(first_word[0])
    return [*map(parse, texts[:-1]), last]


def units_in(line: str) -> list[str]:
    """Units of acceleration stated in a line of text."""
    places = [*_IN_BRACKETS.findall(line), *_UNITS_OF.findall(line), *_IN_PROSE.findall(line)]
    named = [parse(word) for word in re.split(r"[\s,;]+", line)]
    places += [heading.unit for heading in named if heading.kind is Kind.ACCELERATION]
    plain = [place.rstrip(".") for place in places]
    return [place for place in plain if not math.isnan(unit_size(place))]


def stated_units(line: str) -> list[str]:
    """Units of acceleration in a line of text that says that it states units."""
    return units_in(line) if _STATES_UNITS.search(line) else []


def step_in(line: str) -> tuple[str, float]:
    """Time step stated in a line of text, as printed ("" for none), and its unit [s]."""
    match = _STEP.search(line)
    return (match[1], 0.001 if match[2] else 1.0) if match else ("", 1.0)


def count_in(line: str) -> int:
    """Number of samples stated in a line of text; -1 for none."""
    match = _COUNT.search(line)
    return int(match[1]) if match else -1


def _split(text: str) -> tuple[str, str]:
    """Name and unit of a heading."""
    for pattern in (_BRACKETED, _IN):
        match = pattern.fullmatch(text)
        if match and (_is_unit(match[2], bracketed=True) or _is_time(match[1])):
            return match[1].strip(), match[2].strip()
    for place in (i for i, letter in enumerate(text) if letter == "_"):
        name, unit = text[:place], text[place + 1 :]
        if _is_unit(unit, bracketed=False) or (_is_time_unit(unit) and _is_time(name)):
            return name, unit
    # A unit alone, such as `min`; shorter ones may be directions: NS, S.
    is_unit = text.lower() == "ms" or (len(text) > 2 and _is_time_unit(text))
    return (text, text) if is_unit and not _is_time(text) else (text, "")


def _is_unit(text: str, *, bracketed: bool) -> bool:
    plain = text.strip().lower()
    if bracketed and (plain in _SECONDS or (len(plain) > 2 and _is_time_unit(plain))):
        return True
    # After an underscore, `in` and `ft` may as well be words.
    other = is_other_unit(text) and (bracketed or text.lower() not in ("in", "ft"))
    return other or not math.isnan(unit_size(text))


def _is_time(name: str) -> bool:
    return name.strip().lower() in _TIMES


def _is_time_unit(text: str) -> bool:
    return text.strip().lower() in _SECONDS.keys() | _OTHER_TIMES


def _kind(name: str, unit: str) -> tuple[Kind, float]:
    if _is_time_unit(unit):
        return Kind.TIME, _SECONDS.get(unit.strip().lower(), math.nan)
    # A velocity in g is a velocity or an acceleration: no unit decides what a name denies.
    if _NOT_ACCELERATIONS.search(name) and not _ACCELERATION.search(name):
        return Kind.OTHER, 1.0
    if not math.isnan(unit_size(unit)):
        return Kind.ACCELERATION, 1.0
    if unit and is_other_unit(unit):
        return Kind.OTHER, 1.0
    if _is_time(name):
        return Kind.TIME, math.nan if unit else 1.0
    return Kind.OTHER if unit else Kind.UNSAID, 1.0
