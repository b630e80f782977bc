"""The height of an object in a line of text: `RTU-1 HT. 4'-6"` is RTU-1 with a height of 1.37 m.

Knows no drawing. Read `read_line` first.
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterable
from fractions import Fraction
from typing import NamedTuple

from report.project.read.typed_text import DASHES, plain_marks
from report.text.units import LENGTHS

_NUMBER, _SHARE = r"(?:\d{1,6}(?:\.\d{1,6})?|\.\d{1,6})", r"\d{1,2}/[1-9]\d?"
# Between feet and inches, as in `3 ft, 6 in`; behind `3 ft, 900 lb` is another quantity.
_COMMA = r"(?:,(?= ?(?:\d|1[01])(?:\.\d+|[ -]\d+/\d+)? ?(?:\"|in)))?"
_TOP = r"(?:TO[CPW]|TOP(?: OF(?: [A-Z]{1,12}){1,2})?|T(?:\.O\.(?:[A-Z]\.)?|/O?) ?(?:[A-Z]{1,12})?)"
_ABOUT = r"(?:\+/-|[+±~])"
_UNIT = r"(?P<unit>inches|inch|in|feet|ft|mm|cm|m)\.?"  # in brackets behind a word: HEIGHT (IN): 48
_KEYWORD = re.compile(
    rf"(?<!\w)(?:(HT|HGT|HEIGHT(?: ABOVE ROOF)?|(?:{_TOP} ?)?EL(?:EV(?:ATION)?)?|{_TOP})(?: OF)?"
    rf"(?:\.? ?[(\[]{_UNIT}[)\]])?[.:=@ ]*(?<![:=@ ]\.)(?:{_ABOUT} ?)?"
    rf"|([HZ]) ?[=:] ?(?:{_ABOUT} ?)?)"
    # The point of `HT.42` is that of the word, and that of `HT .42` a decimal one.
    rf"(?=\.?\d)|(?:(?<=[\s(])|^)({_ABOUT}) ?(?=\.?\d)",
    re.IGNORECASE,
)
# What may be a height as well, before or behind a number with a unit: it is said.
_LIKE_ONE = re.compile(
    r"(?<![\w./])(?:H|H(?:EIG)?HT|HGT|T[./]O|TO[CPW]|EL|ELEV|Z|ABV|ABOVE|A\.?F\.?F)(?![a-z])",
    re.IGNORECASE,
)
_LENGTH = re.compile(r"\d ?(?:[\"']|(?:ft|feet|inch|inches|in|mm|cm|m)\b)", re.IGNORECASE)
# Heights above the roof; what other words give may be above a datum.
ABOVE_ROOF = ("H", "HT", "HGT", "HEIGHT", "HEIGHT ABOVE ROOF")
_ALSO_A_NAME = ("TOP", "TOC", "TOW", "T/", "+", "+/-", "±", "~")  # before no unit
_DIGITS = r"\d(?:[\d .'/#^-]|,(?=\d)){0,16}?"
# As sizes of equipment are written: a number with its unit before a lone H.
_BEFORE = re.compile(
    rf"(?<![\w./'\"#^-])(?P<value>(?:{_DIGITS}(?:'|(?:ft|feet)\.?){_COMMA}[ -]{{0,3}})?"
    rf"{_DIGITS}(?:['\"]|(?:ft|feet|inches|inch|in|mm|cm|m)\.?))"
    r"[ -]?\(?(?:H|HT|HIGH|TALL|ABOVE|ABV|A\.?(?:F\.?)?R)\b(?![.:= ]*\d)",
    re.IGNORECASE,
)
_RANGE = re.compile(r"(?<!\S)[^\s\d]*+\d\S*+ (?:TO|OR|-) ?$", re.IGNORECASE)
_OTHER_SIZES = re.compile(r"(?:[\d.'\"/-]{1,12}+ ?+[WLD]?+ ?+[x×] ?+){1,3}+$", re.IGNORECASE)
_METRIC = re.compile(r"(?<![\w.,'\"/-])(\d{1,6}),(\d{1,2})(?= ?(?:mm|cm|m)\b)", re.IGNORECASE)
_OF_A_FLOOR = re.compile(
    r" ?\(?(?:A\.?F\.?[FG]|(?:ABOVE|ABV\.?) (?:FIN|FLOOR|GRADE))", re.IGNORECASE
)
_VALUE = re.compile(
    rf"(?:(?P<feet>{_NUMBER})(?: (?P<of_foot>{_SHARE}))?[ -]?(?:'|[(\[]?(?:ft|feet)\b\.?[)\]]?)"
    rf"{_COMMA}[ -]{{0,3}}"
    rf"(?:(?P<of_inch>{_SHARE})[ -]?\")?)?"
    rf"(?:(?P<number>{_NUMBER})(?:[ -](?P<share>{_SHARE}))?"
    r"(?:[ -]?[(\[]?(?P<unit>\"|(?:inches|inch|in|mm|cm|m)(?![a-z]))\.?[)\]]?)?)?"
    # Nothing of the number is left: neither `42x60` nor `42-48` nor `42 1/2` is a height of 42.
    r"(?![\w./'\"#^{\\°´`%]|±[\"']|,\d|\s{0,3}(?:[-/]|TO|OR)\s{0,3}\d|\s{1,3}\d{1,2}/\d)",
    re.IGNORECASE,
)
# A second length that may be of the same height, such as that of a curb, and is no width or depth.
_SECOND = re.compile(
    r"\s{0,3}(?:[,;&+]|AND\b)?\s{0,3}\d[\d ./'-]{0,12}"
    r"(?:[\"']|(?:ft|feet|inch|inches|in|mm|cm|m)\b)"
    r"(?! ?(?:[WLDx×]|WIDE|LONG|DEEP)\b)",
    re.IGNORECASE,
)
_HEIGHT_UNITS = (
    LENGTHS | dict.fromkeys(('"', "inch", "inches"), LENGTHS["in"]) | {"feet": LENGTHS["ft"]}
)


class Height(NamedTuple):
    """A height [m] as written, NaN if that is not understood: by which word, with a unit or not."""

    value_m: float
    word: str
    has_unit: bool


def read_line(text: str, unit_m: float) -> tuple[str, Height | None]:
    """Return the name and the height in a line, whose height without a unit is in `unit_m` [m]."""
    # 1,20 m is 1.20 m: before a metric unit a comma is a decimal one.
    text = _METRIC.sub(r"\1.\2", plain_marks(text))
    plain = text.translate(DASHES)  # as long as the text, whose name keeps its dashes
    word = _KEYWORD.search(plain)
    if word:
        match, start = _VALUE.match(plain, word.end()), word.start()
        keyword, end = (word[1] or word[3] or word[4]).strip(), match.end() if match else 0
    elif before := _BEFORE.search(plain):
        is_range = _RANGE.search(plain[: before.start()])
        match = None if is_range else _VALUE.fullmatch(before["value"])
        start, keyword, end = before.start(), "H", before.end()
    else:
        # A height that is missed lets a parapet fail, one that is misread lets it pass: what may
        # be one is named instead of guessed.
        is_like = _LIKE_ONE.search(plain) and _LENGTH.search(plain)
        return text, Height(math.nan, "", False) if is_like else None
    name = _OTHER_SIZES.sub("", text[:start]).lstrip(" ,;:-").rstrip(" ,;:-(@")
    name = name if ")" in name else name.lstrip("(")  # `(N) RTU-1` is one
    unclear = Height(math.nan, keyword.upper(), False)
    # A height above a floor or above grade is not one above the roof.
    if not match or not match[0] or _OF_A_FLOOR.match(plain, end):
        return name, unclear
    before_colon = (word and word["unit"]) or ""
    unit = match["unit"] or ('"' if match["feet"] else before_colon)
    if not unit and keyword.upper() in _ALSO_A_NAME:
        return text, None if keyword[0] in "Tt" else unclear
    if word and not unit and plain[end:].lstrip()[:1].isalnum():
        return name, unclear  # such as `42 yd` or `42 1/0`
    if word and _SECOND.match(plain, end):
        return name, unclear
    value_m = _value_m(match, _HEIGHT_UNITS.get(unit.lower(), unit_m))
    return name, Height(value_m, keyword.upper(), bool(unit))


def _value_m(match: re.Match[str], size_m: float) -> float:
    """Return a height [m] from its parts, its number in a unit [m]; NaN if they do not fit."""
    shares = [Fraction(match[name] or 0) for name in ("share", "of_foot", "of_inch")]
    feet, value = (float(match[name] or 0.0) for name in ("feet", "number"))
    # 4'-11/2" is 4'-1 1/2" without its blank, 4'-42" a slip, and 1'200 mm has no feet.
    is_slip = any(share >= 1 for share in shares) or (feet > 0.0 and value >= 12.0)
    if is_slip or (feet and value and size_m != LENGTHS["in"]):
        return math.nan
    value += float(shares[0] + shares[2])
    return value * size_m + (feet + float(shares[1])) * LENGTHS["ft"]


def first_height(lines: Iterable[str], unit_m: float) -> tuple[Height | None, str]:
    """Return the first height in lines that is understood; else the first line that is not.

    Heights above the roof go before elevations. If two of them differ, none is understood.
    """
    unclear, heights = "", []
    for line in lines:
        height = read_line(line, unit_m)[1]
        if height and math.isfinite(height.value_m):
            heights.append((height, line))
        unclear = unclear or (line if height else "")
    above = [item for item in heights if item[0].word in ABOVE_ROOF] or heights
    for height, line in above[1:]:
        if not math.isclose(height.value_m, above[0][0].value_m, rel_tol=0.01):
            return None, f"{above[0][1]}; {line}"
    return (above[0][0], "") if above else (None, unclear)
