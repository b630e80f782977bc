"""Numbers, dates and choices in texts as people type them, read where they have one meaning.

Knows no cells (`report.sheet.reading.cells`, which says what would do where there is none).
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterable
from datetime import date, datetime
from fractions import Fraction

_DIGITS = r"(?:[0-9]+(?:\.[0-9]*)?|\.[0-9]+)"
_SHARE = r"[0-9]{1,3}/[1-9][0-9]{0,2}"
_NUMBER = re.compile(rf"[+-]?{_DIGITS}(?:[eE][+-]?[0-9]+)?")
_DECIMAL_COMMA = re.compile(r"([+-]?[0-9]*),([0-9]+)")
_THOUSANDS = re.compile(r"[+-]?[1-9][0-9]{0,2}(?:,[0-9]{3})+(?:\.[0-9]+)?")
_REMARK = re.compile(
    r"(.{0,40}?)\s{0,3}\(\s{0,3}(wet|dry|tested|measured|mean|average|avg\.?|typ\.?|typical)"
    r"\s{0,3}\)",
    re.IGNORECASE,
)
_FEET = re.compile(
    rf"(?P<sign>[+-]?)(?:(?P<feet>{_DIGITS})\s*')?[\s-]*"
    rf"(?:(?P<inches>{_DIGITS})(?:[\s-]+(?P<share>{_SHARE}))?\s*\"|(?P<only>{_SHARE})\s*\")?"
)
_RISE = re.compile(rf"(?:({_DIGITS})|(?:([0-9]+)[\s-]+)?({_SHARE}))\s*(?::|in)\s*12")
_MARKS = {"\u2018": "'", "\u2019": "'", "\u2032": "'", "\u201d": '"', "\u2033": '"', "''": '"'}
_INCHES_PER_FOOT = 12.0

_DATES = ("%b %d, %Y", "%B %d, %Y", "%b %d %Y", "%B %d %Y", "%b. %d, %Y", "%d %b %Y", "%d %B %Y",
          "%d-%b-%Y", "%Y/%m/%d")  # fmt: skip
_SLASHED = re.compile(r"([0-9]{1,2})[/.-]([0-9]{1,2})[/.-]([0-9]{4})")


def number_in(text: str) -> float:
    """Return the number in a text: `0.45`, `0,5`, `1,234.5`, `0.45 (wet)`; NaN for none, or two.

    A comma before three digits may be either.
    """
    if remark := _REMARK.fullmatch(text):
        text = remark[1]
    if comma := _DECIMAL_COMMA.fullmatch(text):
        text = text if _THOUSANDS.fullmatch(text) else f"{comma[1]}.{comma[2]}"
    elif _THOUSANDS.fullmatch(text):
        text = text.replace(",", "")
    return float(text) if _NUMBER.fullmatch(text) else math.nan


def in_thousands(text: str) -> str:
    """Return a number with a comma before its thousands without it; empty for another text."""
    return text.replace(",", "") if _THOUSANDS.fullmatch(text) else ""


def remark_in(text: str) -> str:
    """Return the remark behind a number: `wet` of `0.45 (wet)`; empty for none."""
    remark = _REMARK.fullmatch(text)
    return remark[2] if remark else ""


def inches_in(text: str) -> float:
    """Return a length with marks [in]: `28'-6"`, `4'`, `3 1/2"`; NaN for another text."""
    for mark, plain in _MARKS.items():
        text = text.replace(mark, plain)
    found = _FEET.fullmatch(text)
    if not found or not text.endswith(("'", '"')):
        return math.nan
    share = Fraction(found["share"] or found["only"] or 0)
    inches = float(found["inches"] or 0.0) + float(share)
    return (_INCHES_PER_FOOT * float(found["feet"] or 0.0) + inches) * (
        -1.0 if found["sign"] == "-" else 1.0
    )


def rise_in(text: str) -> float:
    """Return the rise of a slope in 12: `1/2:12`, `0.5 in 12`, `1 1/2:12`; NaN for another text."""
    found = _RISE.fullmatch(text)
    if not found:
        return math.nan
    return float(found[1] or 0.0) + float(found[2] or 0.0) + float(Fraction(found[3] or 0))


def dates_in(text: str) -> list[date]:
    """Return the dates that a text may mean: one of `Nov 20, 2026`, two of `3/5/2026`."""
    try:
        return [date.fromisoformat(text)]
    except ValueError:
        pass
    if slashed := _SLASHED.fullmatch(text):
        first, second, year = map(int, slashed.groups())
        found = []
        for month, day in dict.fromkeys(((first, second), (second, first))):
            try:
                found.append(date(year, month, day))
            except ValueError:
                continue
        return found
    plain = " ".join(text.split()).removesuffix(".").replace("Sept ", "Sep ")
    for pattern in _DATES:
        try:
            return [datetime.strptime(plain, pattern).date()]
        except ValueError:
            continue
    return []


def separator(lines: Iterable[str]) -> str:
    """Return what separates the columns of a CSV: a semicolon or tab if any, else a comma."""
    text = "\n".join(lines)
    return next((mark for mark in ";\t" if mark in text), ",")


def choice_in(text: str, choices: Iterable[str]) -> str:
    """Return the only choice that a text means; empty for none.

    It is that choice but for capitals and blanks, or its first words.
    """
    said = " ".join(text.split()).casefold()
    choices = list(choices)
    same = [choice for choice in choices if choice.casefold() == said]
    if not same and len(_bare(said)) > 3:
        same = [choice for choice in choices if _bare(choice) == _bare(said)]
    if not same and len(said) > 1:
        same = [choice for choice in choices if choice.casefold().startswith(f"{said} ")]
    return same[0] if len(same) == 1 else ""


def _bare(text: str) -> str:
    return re.sub(r"/sei\b|[\s()_-]", "", text.casefold())
