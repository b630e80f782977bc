"""Greek letters for their names (the solver writes `mu`, a page prints μ); superscripts.

Also the characters that no page may print, and those that nobody sees.
"""

from __future__ import annotations

import math
import re
import unicodedata

UNPRINTABLE = re.compile(
    r"[\x00-\x08\x0b\x0c\x0e-\x1f\x7f-\x9f\u2028-\u202e\u2066-\u2069\ud800-\udfff\ufffe\uffff]"
)
"""Control characters, those that separate lines or change the direction of a text, and what XML
does not allow."""

SHOWN = 60
"""Characters of a cell or a name that a message shows."""

_UNSEEN = "".join(filter(str.isspace, map(chr, range(0x3001)))) + (
    "\u00ad\u200b\u200c\u200d\u200e\u200f\u2060\u2061\u2062\u2063\u2064\ufeff"
)

_ALIKE = str.maketrans(
    "АВЕЅІЈКМНОРСТУХаеѕіјорсухΑΒΕΖΗΙΚΜΝΟΡΤΥΧο", "ABESIJKMHOPCTYXaesijopcyxABEZHIKMNOPTYXo"
)
"""Cyrillic and Greek letters that look like Latin ones."""

_LETTERS = {
    "mu": "μ",
    "theta": "θ",
    "phi": "φ",
    "omega": "ω",
    "eta": "η",
    "gamma": "γ",
    "beta": "β",
    "zeta": "ζ",
    "sigma": "σ",
    "pi": "π",
}
_NAMES = re.compile(rf"\b({'|'.join(_LETTERS)})\b")

_SIGNS = {"^2": "²", "m/s2": "m/s²", "v0": "v₀", "sqrt(": "√(", ">=": "≥", " - ": " − "}

_RAISED = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")


def cut(text: str, maximum: int = SHOWN) -> str:
    """Return a text on one line, shortened."""
    text = UNPRINTABLE.sub("?", text).replace("\n", " ")
    return text if len(text) <= maximum else f"{text[: maximum - 1]}…"


def latin(text: str) -> str:
    """Return a text with Latin letters for those that look like them."""
    return text.translate(_ALIKE)


def foreign_letters(text: str) -> str:
    """Return which letters of a text only look Latin, with their alphabets; empty for none."""
    found = dict.fromkeys(letter for letter in text if latin(letter) != letter)
    said = (f"'{one}' is a {unicodedata.name(one).split()[0].capitalize()} letter" for one in found)
    return ", ".join(said)


def power_of_ten(exponent: int) -> str:
    """Return `10⁻¹⁵` for -15."""
    return f"10{str(exponent).translate(_RAISED)}"


def power_above(value: float) -> str:
    """Return a power of ten above a value: its digits depend on the machine."""
    return power_of_ten(math.floor(math.log10(value)) + 1)


def below_mm(error_m: float) -> str:
    """Return the power of ten above an error, in mm."""
    return f"{power_above(1e3 * error_m)} mm" if error_m else "rounding error"


def lettered(text: str) -> str:
    """Return a text with Greek letters, root signs, superscript twos and true minus signs."""
    named = _NAMES.sub(lambda match: _LETTERS[match[1]], text)
    for plain, set_well in _SIGNS.items():
        named = named.replace(plain, set_well)
    return re.sub(r"(?<![\w-])-(?=[\w.])", "−", named)


def trimmed(text: str) -> str:
    """Return a text without spaces and characters of no width at its ends."""
    return text.strip(_UNSEEN)
