"""Typed characters that are invisible, or only look like Latin letters.

`А1` with a Cyrillic А looks like `A1`, and would be another array.
"""

from __future__ import annotations

import re
import unicodedata

# Control characters, those that separate lines or change the direction of a text, and what XML
# does not allow.
UNPRINTABLE = re.compile(
    r"[\x00-\x08\x0b\x0c\x0e-\x1f\x7f-\x9f\u2028-\u202e\u2066-\u2069\ud800-\udfff\ufffe\uffff]"
)

# Characters of a cell or a name that a message shows.
SHOWN = 60

# U+3000, the wide space of East Asian text, is the last that `str.isspace` knows.
_NO_WIDTH = "\u00ad\u200b\u200c\u200d\u200e\u200f\u2060\u2061\u2062\u2063\u2064\ufeff"
_UNSEEN = "".join(filter(str.isspace, map(chr, range(0x3001)))) + _NO_WIDTH
_REMOVE_NO_WIDTH = str.maketrans("", "", _NO_WIDTH)
_SHOW_NO_WIDTH = str.maketrans(dict.fromkeys(_NO_WIDTH, "?"))

# Cyrillic and Greek letters that look like Latin ones.
_ALIKE = str.maketrans(
    "АВЕЅІЈКМНОРСТУХаеѕіјорсухΑΒΕΖΗΙΚΜΝΟΡΤΥΧο", "ABESIJKMHOPCTYXaesijopcyxABEZHIKMNOPTYXo"
)


def cut(text: str, maximum: int = SHOWN) -> str:
    """Return a text on one line, shortened."""
    # A cell may hold what would move the cursor or turn the direction of the line.
    text = UNPRINTABLE.sub("?", text).replace("\n", " ").translate(_SHOW_NO_WIDTH)
    return text if len(text) <= maximum else f"{text[: maximum - 1]}…"


def visible(text: str) -> str:
    """Return a text without characters of no width."""
    return text.translate(_REMOVE_NO_WIDTH)


def looks(name: str) -> str:
    """Return a name as it looks, whatever its alphabet and capitals are."""
    return name.translate(_ALIKE).casefold()


def foreign_letters(text: str) -> str:
    """Return the letters of a text that only look Latin, with their alphabets; empty if none."""
    foreign = dict.fromkeys(letter for letter in text if ord(letter) in _ALIKE)
    return ", ".join(
        f"'{letter}' is a {unicodedata.name(letter).split()[0].capitalize()} letter"
        for letter in foreign
    )


def trimmed(text: str) -> str:
    """Return a text without spaces and characters of no width at its ends."""
    return text.strip(_UNSEEN)
