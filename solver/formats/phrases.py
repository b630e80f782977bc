"""What a line of text states of the numbers below it: quantity, units, step or rate, and count.

One vocabulary for all readers of text; knows no format. Read `units_in`, then `step_in`.
"""

from __future__ import annotations

import math
import re

from solver.formats.layout import ACCELERATION, OTHER_TIMES, SECONDS, Kind, parse
from solver.formats.numbers import printed
from solver.formats.source import Source, Stated
from solver.model import InputError
from solver.records.record import is_other_unit, unit_size

# The peak of a velocity, or that of shear waves, tells of the record or the site, as does a
# quantity with its value.
_SPECTRUM = re.compile(
    r"\W*(?:freq|frequency|periods?)(?![a-z])|.*(?<![a-z])(?:spectr(?:al|um|a)|p?s_?a)(?![a-z])",
    re.IGNORECASE,
)
_QUANTITY = re.compile(
    r"\W*(?:(?!peak|max|wave|shear)\w+\W+){0,3}?(vel|velocity|velocities|disp|displacements?)"
    r"(?:\W+(?:time|history|histories|series|record|trace|data|in)\b|\W*[\[(,;]|\W*$)",
    re.IGNORECASE,
)

_IN_BRACKETS = re.compile(r"[\[(]([^\])]{1,16})[\])]")
_UNITS_OF = re.compile(
    r"\bunits?\b[\s:=]*+(?:(?:of|in|are|is)\b[\s:=]*+)*+([^\s,;()\[\]]+)", re.IGNORECASE
)
_STATES_UNITS = re.compile(r"\bunits?\b", re.IGNORECASE)
_IN_PROSE = re.compile(r"\bin\s+([^\s,;()\[\]]+)", re.IGNORECASE)

_VALUE = r"([+-]?(?:\d++\.?+\d*+|\.\d++)(?:[eE][+-]?\d++)?+)"
_HERTZ = r"(k?hz|sps|samples?(?: per |/)s(?:ec|econd)?)\b"
_RATE = re.compile(
    r"\b(?:sampl(?:ing|e)[ _]?(?:rate|freq(?:uency)?)|fs)\s*+"
    rf"(?:[\[(]\s*+{_HERTZ}\s*+[\])]\s*+)?+([:=]?)\s*+(?:(?:is|of)\b)?\s*+{_VALUE}\s*+(?:{_HERTZ})?+",
    re.ASCII | re.IGNORECASE,
)
_STEP = re.compile(
    r"\b(?:dt|delta[ _]t|(?:time|sampling|sample)[ _](?:step|interval|increment)|intervals? of)"
    r"(?:_([a-zµμ]++)|\s*+[\[(]\s*+([a-zµμ]++)\s*+[\])])?+"
    rf"\s*+([:=]?)\s*+(?:(?:is|of)\b)?\s*+{_VALUE}\s*+([a-zµμ]*)",
    re.IGNORECASE,
)
_COUNT = re.compile(
    r"\b(?:(?:number|no\.?) of (?:data )?(?:points|samples|values)|npts)\b"
    r"\s*+(?:[:=]\s*)?(\d{1,9})\b(?![.,]\d)",
    re.ASCII | re.IGNORECASE,
)


def is_of_a_spectrum(line: str) -> bool:
    """Whether a line of text says that the numbers below it are a spectrum."""
    return bool(_SPECTRUM.match(line))


def is_of_acceleration(line: str) -> bool:
    """Whether a line of text names accelerations or a unit of theirs."""
    return bool(ACCELERATION.search(line) or units_in(line))


def other_quantity(line: str) -> str:
    """What a line of text says that the numbers below it are, if no acceleration; "" for none."""
    quantity = _QUANTITY.match(line)
    # A length alone may be a word, or the unit of the site's coordinates.
    others = (unit for unit in _UNITS_OF.findall(line) if "/" in unit and is_other_unit(unit))
    return quantity[1].lower() if quantity else next(others, "")


def is_of_another(line: str) -> bool:
    """Whether a line of text says another quantity than acceleration, or another unit than g."""
    sizes = {unit_size(unit) for unit in units_in(line)}
    return bool(sizes - {unit_size("g")} or other_quantity(line))


def units_in(line: str) -> list[str]:
    """Units of acceleration stated in a line of text."""
    places = [*_IN_BRACKETS.findall(line), *_UNITS_OF.findall(line), *_IN_PROSE.findall(line)]
    named = [parse(word) for word in re.split(r"[\s,;]+", line)]
    places += [heading.unit for heading in named if heading.kind is Kind.ACCELERATION]
    plain = [place.rstrip(".").removesuffix("'s").removesuffix("'S") for place in places]
    return [place for place in plain if not math.isnan(unit_size(place))]


def stated_units(line: str) -> list[str]:
    """Units of acceleration in a line of text that says that it states units."""
    return units_in(line) if _STATES_UNITS.search(line) else []


def step_in(source: Source, index: int, line: str) -> Stated:
    """Time step [s] that the line at an index states, as a step or as a rate; NaN for none."""
    rate = _RATE.search(line)
    if rate and (rate[1] or rate[2] or rate[4]) and float(rate[3]) > 0.0:
        size = 1000.0 if "khz" in rate[0].lower() else 1.0
        return Stated(value=1.0 / (size * float(rate[3])), index=index)
    match = _STEP.search(line)
    if not match:
        return Stated(index=index)
    before, after = (match[1] or match[2] or "").lower(), match[5].lower()
    unit = before or after
    if unit in OTHER_TIMES:
        raise InputError(f"{source.at(index)}: found a step in {unit}; give it in s, ms or min")
    # Behind the number may be another word; before it, or without a sign, it must be a time.
    if unit not in SECONDS and (before or not match[3]):
        return Stated(index=index)
    size, stated = SECONDS.get(unit, 1.0), printed(match[4], index)
    return Stated(value=stated.value * size, rounding=stated.rounding * size, index=index)


def count_in(line: str) -> int:
    """Number of samples stated in a line of text; -1 for none."""
    match = _COUNT.search(line)
    return int(match[1]) if match else -1
