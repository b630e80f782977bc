"""What a line of text says of all numbers below it: another quantity, another unit, a factor.

`Velocity, cm/s` heads no accelerations, and `Scale: 1000` may be a factor that is not applied.

Knows no format; `solver.formats.phrases` reads the headings of columns, units and steps. Read
`is_of_another`.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence

from solver.errors import InputError
from solver.formats.phrases import ACCELERATION, UNITS_OF, units_in
from solver.formats.source import Source
from solver.records.record import is_other_unit, quoted, unit_size

_SPECTRUM = re.compile(
    r"\W*(?:freq|frequency|periods?)(?![a-z])|.*(?<![a-z])(?:spectr(?:al|um|a)|p?s_?a)(?![a-z])",
    re.IGNORECASE,
)
# The peak of a velocity, or that of shear waves, tells of the record or the site, as does a
# quantity with its value.
_QUANTITY = re.compile(
    r"\W*(?:(?!peak|max|wave|shear)\w+\W+){0,3}?(vel|velocit(?:y|ies|[aà])|velocidad(?:es)?"
    r"|vitesses?|geschwindigkeit(?:en)?|disp|displacements?|d[eé]placements?|desplazamientos?|jerk)"
    r"(?:\W+(?:time|history|histories|series|record|trace|motion|data|in)\b|\W*[\[(,;]|\W*$)",
    re.IGNORECASE,
)

# Of all values below a line of a curve or a spectrum.
_OTHERWISE = re.compile(
    r"(?:%|\bpercent\b)\s*(?:of\s+)?g\b|\bin (?:%|percent)(?!\s*damp)|\bp?s[vd]\b|\bpg[vd]\b"
    r"|\b1e-\d|\blog(?:10)?\b|\bln\b|\b(?:velocity|displacement) spectr|percentile|fractile"
    r"|\bper (?:century|month|day|1,?000)|\bnon-?exceed|\bMCE(?:_?R)?\b|\bmaximum considered\b"
    r"|\bfourier\b|\bspectral density\b|\binelastic\b|\bductility\b|\breduced by\b"
    r"|/\s?(?:S_?DS|PGA)\b",
    re.IGNORECASE,
)
_DAMPING = re.compile(
    r"(?:damp[a-z_]{0,20}|\b(?:zeta|xi|h(?= ?= ?[\d.]+ ?%))\b|[ζξ])"
    r"\W{0,3}(?:ratio\W{0,3}|(?:at|of|is)\b\W?)?"
    r"(\d++(?:\.\d++)?+|\.\d++)(?! ?(?:hz|sec|s)\b)"
    r"|(?<![\d.])(\d++(?:\.\d++)?+|\.\d++) ?(?:%|percent|pct)[\w -]{0,20}damp",
    re.ASCII | re.IGNORECASE,
)
_NUMBER = r"\d++(?:\.\d*+)?(?:[eE][+-]?\d+)?"
_FACTOR = re.compile(
    r"\b(?:scal(?:e|es|ed|ing)|multiply|multiplie[dr]|(?:conversion|calibration|multiplication"
    r"|amplitude)[ _]factor|factor(?=\s?[:=])|gain|divide[ds]?|divisor|times(?= \d))\b"
    rf"[^\d;]{{0,20}}(?P<number>{_NUMBER}(?:\s?[:/]\s?\d+)?)(?![\d/(-])|\b1 ?g ?= ?[\d.]++"
    rf"|(?<![\w.)*])[x×*]\s?(?:10\s?\^\s?-?\d|{_NUMBER})\b|\bnormali[sz]ed\b"
    r"|\bdivided by\b|\b(?:raw|digital|in) counts\b|\b(?:ln|log(?:10)?)\s?\(|\bLSB\b|\bm?V/g\b"
    rf"|(?<![\w.]){_NUMBER}\s?[x×*]\s(?=[a-z])",
    re.ASCII | re.IGNORECASE,
)
_ONE = re.compile(r"1(?:\.0*)?")
# 0.01 g, 1/1000 g, 10^-3 g; and g*1000, cm/s2 x 10, g/100, which are no units.
_TIMES_UNIT = re.compile(
    rf"(?:\bunits?\b|\bin\b|[x×*])[\s:=]*+(?:(?:of|in|are|is)\s++)?"
    rf"(10\s?\^\s?[+-]?\d|{_NUMBER}(?:\s?/\s?\d+)?)\s?[x×*]?\s?+([a-zµ%][^\s,;()\[\]]{{0,15}})",
    re.ASCII | re.IGNORECASE,
)
_PERCENT = re.compile(r"(?:%|\bpercent)\s?of g\b", re.IGNORECASE)
_UNIT_TIMES = re.compile(
    r"(?:\bunits?\b|\bin\b)[\s:=]*+(?:(?:of|in|are|is)\s++)?([a-zµ%][^\s,;()\[\]×]{0,15}?)"
    r"(\s?\(?\s?(?:[x×/]|(?<!\*)\*(?!\*))\s?\(?[\d.]++)",
    re.ASCII | re.IGNORECASE,
)


def is_of_a_spectrum(line: str) -> bool:
    """Whether a line of text states that the numbers below it are a spectrum."""
    return bool(_SPECTRUM.match(line))


def is_of_acceleration(line: str) -> bool:
    """Whether a line of text names accelerations or a unit of theirs."""
    return bool(ACCELERATION.search(line) or units_in(line))


def other_quantity(line: str) -> str:
    """Quantity that a line of text states for the numbers below, if not acceleration; else ""."""
    quantity = _QUANTITY.match(line)
    # A length alone may be a word, or the unit of the site's coordinates.
    units = (unit for unit in UNITS_OF.findall(line) if "/" in unit and is_other_unit(unit))
    return quantity[1].lower() if quantity else next(units, "")


def is_of_another(line: str) -> bool:
    """Whether a line of text says another quantity than acceleration, or another unit than g.

    So says one of a factor, a logarithm, a percentile or a ratio of the values below it.
    """
    if _OTHERWISE.search(line) or factor_in(line) or times_unit(line):
        return True
    sizes = {unit_size(unit) for unit in units_in(line)}
    return bool(sizes - {unit_size("g")} or other_quantity(line))


def is_other_damping(line: str) -> bool:
    """Whether a line of text states another damping ratio than 5%, that of the codes."""
    # A spectrum at 2% damping is larger than one at 5%: as a target it would be a stronger motion
    # than the code asks for, and one at 10% a weaker one.
    damping = _DAMPING.search(line)
    ratio = float(damping[1] or damping[2]) if damping else 0.05
    return abs(ratio - (0.05 if ratio < 1.0 else 5.0)) > 1e-6


def times_unit(line: str) -> str:
    """Multiple of a unit in which a line of text states the numbers below it, as 0.01 g."""
    if percent := _PERCENT.search(line):
        return percent[0]
    for match in _TIMES_UNIT.finditer(line):
        if match[1] != "1" and unit_size(match[2].rstrip(".")) > 0.0:
            return f"{match[1]} {match[2].rstrip('.')}"
    for match in _UNIT_TIMES.finditer(line):
        # g/10 is a unit of its own.
        if unit_size(match[1]) > 0.0 and not unit_size(match[1] + match[2].strip()) > 0.0:
            return (match[1] + match[2]).rstrip(".")
    return ""


def check_units_alone(source: Source, lines: Sequence[str]) -> None:
    """Raise at the first line of the source, of those given, that states a multiple of a unit."""
    for index, line in enumerate(lines):
        if words := times_unit(line):
            raise InputError(
                f"{source.at(index)}: found {quoted(words)}, a multiple of a unit; convert the"
                " values to a unit alone, and correct the line"
            )


def factor_in(line: str) -> str:
    """Words of a line of text that state a factor of the numbers below it; empty for none."""
    match = _FACTOR.search(line)
    return match[0].strip() if match and not _ONE.fullmatch(match["number"] or "") else ""


def factor_notes(lines: Iterable[tuple[int, str]]) -> list[str]:
    """Note the factors that lines state, each with its index: they may be applied already."""
    factors = ((index, factor_in(line)) for index, line in lines)
    return [
        f"line {index + 1} states {factor!r}: no factor is applied"
        for index, factor in factors
        if factor
    ]
