"""Numbers, dates and choices as people type them.

Knows no cells (`report.project.read.cells`, which states the remedy if there is no value).
"""

from __future__ import annotations

import math
import re
from collections.abc import Collection, Iterable
from datetime import date, datetime
from fractions import Fraction

_DIGITS = r"(?:[0-9]+(?:\.[0-9]*)?|\.[0-9]+)"
_SHARE = r"[0-9]{1,3}/[1-9][0-9]{0,2}"
_NUMBER = re.compile(rf"[+-]?{_DIGITS}(?:[eE][+-]?[0-9]+)?")
_DECIMAL_COMMA = re.compile(r"([+\u2212-]?[0-9]*),([0-9]+)")
_THOUSANDS = re.compile(r"[+-]?[1-9][0-9]{0,2}(?:,[0-9]{3})+(?:\.[0-9]+)?")
_MIXED = re.compile(rf"([0-9]+)[\s-]+({_SHARE})")
_FEET = re.compile(
    rf"(?P<sign>[+-]?)(?:(?P<feet>{_DIGITS})\s*')?[\s-]*"
    rf"(?:(?P<inches>{_DIGITS})(?:[\s-]+(?P<share>{_SHARE}))?\s*\"|(?P<only>{_SHARE})\s*\")?"
)
_RISE = re.compile(
    rf"(?:({_DIGITS})|(?:([0-9]+)[\s-]+)?({_SHARE}))(?:\s*(?:\"|in\.?))?"
    r"\s*(?:(?:/|per)\s*(?:ft\.?|foot)|:\s*12\"?|(?<=in)\s*12)"
)
_ONE_IN = re.compile(rf"1\s*:\s*({_DIGITS})")
_MARKS = {
    **dict.fromkeys("\u2018\u2019\u2032", "'"), **dict.fromkeys("\u201c\u201d\u2033", '"'),
    "''": '"',
}  # fmt: skip
_SHARES = {"\u00bc": "1/4", "\u00bd": "1/2", "\u00be": "3/4"}
_INCHES_PER_FOOT = 12.0
# Hyphens and dashes of typography, one letter each: between feet and inches they are a hyphen.
DASHES = str.maketrans(dict.fromkeys("\u2010\u2011\u2012\u2013\u2014\u2212", "-"))

_DATES = ("%b %d %Y", "%B %d %Y", "%d %b %Y", "%d %B %Y", "%Y %m %d")
_BESIDE_DATE = re.compile(
    r"(?:mon|tues|wednes|thurs|fri|satur|sun)day\b|(?<=[0-9])(?:st|[nr]d|th)\b"
)
_SLASHED = re.compile(r"([0-9]{1,2})[/.-]([0-9]{1,2})[/.-]([0-9]{4})")


def number_in(text: str) -> float:
    """Return the number in a text: `0.45`, `0,5`, `1,234.5`, `4 1/2`; else NaN."""
    text = text.replace("\u2212", "-")
    mixed = _MIXED.fullmatch(plain_marks(text))
    # 4 13/8 is a slip of typing.
    if mixed and Fraction(mixed[2]) < 1:
        return float(mixed[1]) + float(Fraction(mixed[2]))
    # A comma before three digits has two meanings.
    if comma := _DECIMAL_COMMA.fullmatch(text):
        text = text if _THOUSANDS.fullmatch(text) else f"{comma[1]}.{comma[2]}"
    elif _THOUSANDS.fullmatch(text):
        text = text.replace(",", "")
    return float(text) if _NUMBER.fullmatch(text) else math.nan


def in_thousands(text: str) -> str:
    """Return a number with a comma before its thousands without it; empty for another text."""
    return text.replace(",", "") if _THOUSANDS.fullmatch(text) else ""


def plain_marks(text: str) -> str:
    """Return a text with plain marks of feet and inches, and fractions of two numbers."""
    for mark, plain in _MARKS.items():
        text = text.replace(mark, plain)
    for mark, share in _SHARES.items():
        text = re.sub(rf"(?<=[0-9]) ?{mark}", f" {share}", text).replace(mark, share)
    return text


def inches_in(text: str) -> float:
    """Return a length with marks [in]: `28'-6"`, `4'`, `3 1/2"`; NaN for another text."""
    text = plain_marks(text).translate(DASHES)
    match = _FEET.fullmatch(text)
    # A bare 4 fits the pattern, too: without a mark the unit is that of the column.
    if not match or not text.endswith(("'", '"')):
        return math.nan
    share = Fraction(match["share"] or match["only"] or 0)
    # 5'-11/2" is 5'-1 1/2" without its blank.
    if share >= 1:
        return math.nan
    inches = float(match["inches"] or 0.0) + float(share)
    # Of inches beside feet, 12 and more are a slip of the finger.
    if match["feet"] and inches >= _INCHES_PER_FOOT:
        return math.nan
    return (_INCHES_PER_FOOT * float(match["feet"] or 0.0) + inches) * (
        -1.0 if match["sign"] == "-" else 1.0
    )


def rise_in(text: str) -> float:
    """Return the rise in 12: `1/2:12`, `0.5 in 12`, `1/4"/ft`, `1:24` is 0.5; NaN for none."""
    # Below 1 it would be steeper than 45 degrees, which is refused.
    if (one_in := _ONE_IN.fullmatch(text)) and float(one_in[1]) >= 1.0:
        return 12.0 / float(one_in[1])
    match = _RISE.fullmatch(plain_marks(text))
    if not match or Fraction(match[3] or 0) >= 1:
        return math.nan
    return float(match[1] or 0.0) + float(match[2] or 0.0) + float(Fraction(match[3] or 0))


def dates_in(text: str) -> list[date]:
    """Return the dates that a text may mean: one of `Nov 20, 2026`, two of `3/5/2026`."""
    try:
        # ISO 8601 first: 2026-11-20 has one meaning.
        return [datetime.fromisoformat(text).date()]
    except ValueError:
        pass
    # Day and month in either order, as far as both are dates.
    if slashed := _SLASHED.fullmatch(text):
        first, second, year = map(int, slashed.groups())
        dates = []
        for month, day in dict.fromkeys(((first, second), (second, first))):
            try:
                dates.append(date(year, month, day))
            except ValueError:
                continue
        return dates
    plain = " ".join(re.sub(r"[.,/-]", " ", _BESIDE_DATE.sub("", text.casefold())).split())
    # `strptime` knows Sep and September alone.
    plain = plain.replace("sept ", "sep ")
    for pattern in _DATES:
        try:
            return [datetime.strptime(plain, pattern).date()]
        except ValueError:
            continue
    return []


def separator(lines: Collection[str]) -> str:
    """Return the separator of a CSV: the one in most of its lines, `;` before `,`."""
    # A semicolon goes before a comma of as many lines: where it separates, the comma is a decimal
    # one.
    return max(";\t,", key=lambda mark: sum(mark in line for line in lines))


def with_point(text: str, separated_by: str) -> str:
    """Return a number with a decimal point, of a CSV whose columns a semicolon separates."""
    comma = _DECIMAL_COMMA.fullmatch(text) if separated_by == ";" else None
    return f"{comma[1]}.{comma[2]}" if comma else text


def choice_in(text: str, choices: Iterable[str]) -> str:
    """Return the choice equal to a text except for capitals, blanks, hyphens and brackets."""
    return next((choice for choice in choices if _bare(choice) == _bare(text)), "")


def _bare(text: str) -> str:
    return re.sub(r"[\s()-]", "", text.casefold())
