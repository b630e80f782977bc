"""Parses statements about numbers: the heading of a column, or a line above or among them.

`EW [cm/s2]` heads an acceleration in cm/s2, and `dt = 5 ms` states a step of 0.005 s.

One vocabulary for all readers: quantity, units, step or rate, and count; knows no format. Read
`parse` of one heading, then `units_in` and `steps_in` of a line.
"""

from __future__ import annotations

import math
import re
from dataclasses import dataclass, replace
from enum import Enum

from solver.errors import InputError
from solver.formats.numbers import printed
from solver.formats.source import Source, Stated
from solver.records.record import is_other_unit, is_raw, unit_size

# Also as loggers of other languages head them.
_TIMES = {"t", "time", "times", "zeit", "tiempo", "temps", "tempo", "sec", "secs", "seconds"}
SECONDS = (
    dict.fromkeys(("s", "sec", "sec.", "secs", "seg", "second", "seconds"), 1.0)
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
    r"|humidity|altitude|latitude|longitude|pitch|roll|yaw|quat[a-z]*|strain|jerk|drift|husid|energy"
    r"|speed|power|moment|force|geschwindigkeit|verschiebung|vitesse|d[eé]placement|velocit[aà]"
    r"|velocidad|desplazamiento|spostamento)(?![a-z])|(?<!加)速度|位移|変位",
    re.IGNORECASE,
)
# The length of the vector, as loggers write it beside its components.
_MAGNITUDE = re.compile(
    r"(?<![a-z])(?:abs|absolute|[a-z]*betrag|res|resultante?|vector ?sum|sum|total|combined"
    r"|mag|magnitude|norm|modulus|srss)(?![a-z])|\|.*\||(?:at|tgf)$",
    re.IGNORECASE,
)
ACCELERATION = re.compile(r"(?<![a-z])ac(?:c|el)", re.IGNORECASE)

# acc*1000, 10*acc, acc_x1000, acc (g)/9.81, acc/PGA: what the values are in is not known.
_HAS_FACTOR = re.compile(
    r"[*×]\s?\d|\d\s?[*×]|(?<=[_\s(,)\]])x\s?10+(?!\d)|(?<![a-z\d])(?:1e-?\d|10\s?\^|10-\d)"
    r"|[)\]]\s*/\s*\d|/\s?pga\b",
    re.IGNORECASE,
)

_ABSCISSAS = re.compile(
    r"(?:freq|frequency|frequencies|periods?|tn)(?![a-z])|.*\bhz\b", re.IGNORECASE
)
_SPECTRAL = re.compile(
    r"(?<![a-z])(?:p?s_?[avd]|p?r?s_?acc|spectr(?:al|um)|pseudo|response)(?![a-z])", re.IGNORECASE
)

_BRACKETED = re.compile(r"([^\[(]*)[\[(]([^\])]*)[\])]\s*")
_IN = re.compile(r"(.*\S)\s+in\s+(\S+)", re.IGNORECASE)
_BEHIND = (re.compile(r"([^,]*[^,\s])\s*,\s*(\S+)"), re.compile(r"(.*[^\W\d_]\)?)\s*/\s*(\S+)"))
_WORD = re.compile(r"[^\s\[(]+(?:\s?[\[(][^\])]*[\])])?")

_IN_BRACKETS = re.compile(r"[\[(]([^\])]{1,16})[\])]")
UNITS_OF = re.compile(
    r"\bunits?\b[\s:=]*+(?:(?:of|in|are|is)\b(?!/)[\s:=]*+)*+([^\s,;()\[\]]+)", re.IGNORECASE
)
# Between marks, as in `Acceleration, cm/s2`; behind a number it is of that.
_BARE = re.compile(r"(?:^[#\s]*|[,;:=]\s*+|\s-\s+)([^\s,;:=]+)(?=\s*(?:[,;]|$))")
_STATES_UNITS = re.compile(r"\bunits?\b", re.IGNORECASE)
_IN_PROSE = re.compile(r"\bin\s+([^\s,;()\[\]]+)", re.IGNORECASE)

# Also `0,005`, and `1/200` of a second.
# The quantifiers ++, *+ and ?+ are possessive: they prevent backtracking, so that the time of a
# match is proportional to the length of the text (checked by `tests/test_patterns.py`).
_VALUE = r"([+-]?(?:\d++(?:\.\d*+|,\d++)?+|\.\d++)(?:[eE][+-]?\d++)?(?:/\d++)?)"
_HERTZ = r"(k?hz|sps|samples?(?: per |/)s(?:ec|econd)?)\b"
_RATE = re.compile(
    r"(?<![a-z])(?:sampl(?:ing|e)[ _]?(?:rate|freq(?:uency)?)|frecuencia de muestreo|abtastrate|fs"
    r"|sampling|sr|sps|samples?(?: per |/)s(?:ec(?:ond)?)?|采样(?:频?率)|サンプリング周波数)\s*+"
    rf"(?:[\[(]\s*+{_HERTZ}\s*+[\])]\s*+)?+([:=]?)\s*+(?:(?:is|of)\b)?\s*+{_VALUE}\s*+(?:{_HERTZ})?+"
    r"(?:([a-z]++)(?!\^?-))?+(\s*+$)?+",
    re.ASCII | re.IGNORECASE,
)
# 200 Hz of a filter are no rate, but 200 samples per second are.
_SAMPLED = re.compile(
    rf"\b(?:rate|sampled|digiti[sz]ed|recorded)\b[^\d;,.]{{0,25}}{_VALUE}\s*+{_HERTZ}"
    rf"|(?<![\w.,/]){_VALUE}\s*+(sps|samples?(?: per |/)s(?:ec|econd)?)\b",
    re.ASCII | re.IGNORECASE,
)
_STEP = re.compile(
    r"(?<![a-z])(?:dt|Δt|delta[ _]t"
    r"|(?:time|sampling|sample)[ _-]?(?:step|interval|period|increment)|intervals? of|spaced at"
    r"|intervalo de muestreo(?:, C\d-C\d)?|采样间隔|時間間隔|时间间隔"
    r"|(delta|step|interval|paso|passo|pas de temps|zeitschritt|digiti[sz]ed at|points at))"
    r"(?:_([a-zµμ]++)|\s*+[\[(]\s*+([a-zµμ]++)\s*+[\])])?+"
    rf"\s*+([:=]?)[\s/]*+(?:(?:is|of)\b)?\s*+{_VALUE}\s*+([a-zµμ]*)",
    re.IGNORECASE,
)
_INTERVAL = re.compile(
    rf"(?<![\w.,/]){_VALUE}\s*+([a-z]{{1,12}})\.?[ -](?:(?:time|sampling)[ -])?"
    r"(?:step|interval|increment)s?\b",
    re.ASCII | re.IGNORECASE,
)
_LONGEST_STEP_S = 0.1  # of a word such as delta, which may be a distance
_GROUPED = re.compile(r"[1-9]\d{0,2},\d{3}", re.ASCII)  # one, or a thousand
_COUNT = re.compile(
    r"\b(?:(?:number|no\.?) of (?:data )?(?:points|samples|values)|npts)\b"
    # The 4 of 4,000 is not a count.
    r"\s*+(?:[:=]\s*)?(\d{1,9})\b(?![.,]\d)",
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
    if _HAS_FACTOR.search(name):
        unit, seconds = text, math.nan
        kind = Kind.TIME if kind is Kind.TIME else Kind.OTHER
    return Heading(text=text, name=name, kind=kind, unit=unit, seconds=seconds)


def settled(headings: list[Heading]) -> list[Heading]:
    """Treat the g of ``ch_g`` as a letter, not a unit, if others like ``ch_f`` have no unit."""
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
    """Return the headings that mark a table as a spectrum: no time, or ordinates alone."""
    first, *ordinates = headings
    spectral = [heading.text for heading in ordinates if is_spectral(heading)]
    if _ABSCISSAS.match(first.text):
        return [first.text, *spectral]
    return spectral if spectral and len(spectral) == len(ordinates) else []


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
    # acc/gal or acc, g: without a unit of acceleration, it may be a direction.
    for match in filter(None, (pattern.fullmatch(text) for pattern in _BEHIND)):
        if not math.isnan(unit_size(match[2])):
            return match[1].strip(), match[2]
    # The first underscore with a unit behind it: a unit may have underscores, as m_s2.
    for place in (i for i, letter in enumerate(text) if letter == "_"):
        name, unit = text[:place], text[place + 1 :]
        if _is_unit(unit, bracketed=False) or (_is_time_unit(unit) and _is_time(name)):
            return name, unit
    # A unit alone, such as `min`; shorter ones may be directions: NS, S.
    is_unit = text.lower() == "ms" or (
        len(text) > 2 and (_is_time_unit(text) or not math.isnan(unit_size(text)))
    )
    return (text, text) if is_unit and not _is_time(text) else (text, "")


def _is_unit(text: str, *, bracketed: bool) -> bool:
    plain = text.strip().lower()
    if bracketed and (plain in SECONDS or (len(plain) > 2 and _is_time_unit(plain))):
        return True
    # After an underscore, `in` and `deg` may as well be words.
    is_of_another = is_other_unit(text) and (
        bracketed or "/" in text or text.lower() in ("mm", "cm", "m")
    )
    return is_of_another or is_raw(text) or not math.isnan(unit_size(text))


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


def units_in(line: str) -> list[str]:
    """Units of acceleration stated in a line of text."""
    places = [*_IN_BRACKETS.findall(line), *UNITS_OF.findall(line), *_IN_PROSE.findall(line)]
    named = [parse(word) for word in re.split(r"[\s,;]+", line)]
    places += [word for word in _BARE.findall(line) if "/" in word or word.lower() == "gal"]
    # A unit alone is no heading here: it may be of a number before it.
    named = [heading for heading in named if heading.unit != heading.text]
    places += [heading.unit for heading in named if heading.kind is Kind.ACCELERATION]
    plain = [place.rstrip(".").removesuffix("'s").removesuffix("'S") for place in places]
    return [place for place in plain if not math.isnan(unit_size(place))]


def stated_units(line: str) -> list[str]:
    """Units of acceleration in a line of text that is labeled as stating units."""
    return units_in(line) if _STATES_UNITS.search(line) else []


def steps_in(source: Source, index: int, line: str) -> list[Stated]:
    """Time steps [s] that the line at an index states, as a step or as a rate."""
    steps: list[Stated] = []
    rate = _RATE.search(line)
    unit = (rate[5] or "").lower() if rate else ""
    # A unit, a sign or the end of the line makes a rate of it; otherwise the number may belong to
    # the prose.
    if rate and (rate[1] or rate[2] or rate[4] or unit in SECONDS or rate[6] is not None):
        stated = _stated(source, index, rate[3])
        if unit in SECONDS:
            steps.append(_times(stated, SECONDS[unit]))
        elif stated.value > 0.0:
            steps.append(_per_second(stated, rate[0]))
    elif match := _SAMPLED.search(line):
        stated = _stated(source, index, match[1] or match[3])
        steps += [_per_second(stated, match[0])] if stated.value > 0.0 else []
    if (match := _INTERVAL.search(line)) and match[2].lower() in SECONDS:
        return [*steps, _times(_stated(source, index, match[1]), SECONDS[match[2].lower()])]
    match = _STEP.search(line)
    if not match:
        return steps
    before, after = (match[2] or match[3] or "").lower(), match[6].lower()
    unit = before or after
    stated = _stated(source, index, match[5])
    if match[1] and not (after in SECONDS or (not unit and stated.value <= _LONGEST_STEP_S)):
        return steps
    # A step of 5000 in microseconds must not be read as 5000 s.
    if unit in OTHER_TIMES:
        raise InputError(f"{source.at(index)}: found a step in {unit}; enter it in s, ms or min")
    # Behind the number may be another word; before it, or without a sign, it must be a time.
    if unit in SECONDS or (match[4] and not before):
        steps.append(_times(stated, SECONDS.get(unit, 1.0)))
    return steps


def _per_second(stated: Stated, text: str) -> Stated:
    """Return the step [s] of a rate above 0 in Hz or, as the text says, kHz."""
    size = 1000.0 if "khz" in text.lower() else 1.0
    return Stated(value=1.0 / (size * stated.value), index=stated.index)


def _stated(source: Source, index: int, text: str) -> Stated:
    """Read a number with a point, a decimal comma or a stroke of division."""
    if _GROUPED.fullmatch(text):
        raise InputError(f"{source.at(index)}: found {text!r}; enter a number with a decimal point")
    above, _, below = text.replace(",", ".").partition("/")
    number = printed(above, index)
    return replace(number, value=number.value / float(below)) if float(below or 0.0) else number


def _times(stated: Stated, size: float) -> Stated:
    return replace(stated, value=stated.value * size, rounding=stated.rounding * size)


def count_in(line: str) -> int:
    """Number of samples stated in a line of text; -1 for none."""
    match = _COUNT.search(line)
    return int(match[1]) if match else -1
