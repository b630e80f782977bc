"""What no line breaks within: a number and its unit, a date, a short name with a hyphen.

Changes no words. Read `unbroken`.
"""

from __future__ import annotations

import re

from report.words.units import Quantity

LONGEST = 8
"""Characters of a name that is kept whole: a longer one may need a second line in its column."""

_UNITS = {unit.symbol for quantity in Quantity for unit in quantity.value}
_MORE = ("g", "s", "Hz", "%", "s/m", "m g", "kB", "MB")
_QUANTITY = "[−]?\\d[\\d.,]* (?:{})(?![\\w/])".format(
    "|".join(map(re.escape, sorted({*_UNITS, *_MORE}, key=len, reverse=True)))
)
_DATE = r"\d{4}-\d\d-\d\d"
_NAME = rf"(?=[\w-]{{3,{LONGEST}}}(?![\w-]))[A-Z0-9]\w*(?:-\w+)+"
_PATTERN = re.compile(rf"<[^<>]*>|(?<![\w./-])(?P<whole>{_QUANTITY}|(?:{_DATE}|{_NAME})(?![\w-]))")


def unbroken(html: str) -> str:
    """Return a document in which no line breaks within such a text."""
    head, body, rest = html.partition("<body")
    return head + _PATTERN.sub(_kept, body + rest)


def _kept(match: re.Match[str]) -> str:
    whole = match["whole"]
    return f'<span style="white-space: nowrap">{whole}</span>' if whole else match[0]
