"""Letters for their names, as the solver writes `mu` and a page prints μ; raised exponents."""

from __future__ import annotations

import re

_LETTERS = {
    "mu": "μ",
    "theta": "θ",
    "phi": "φ",
    "omega": "ω",
    "eta": "η",
    "gamma": "γ",
    "beta": "β",
}
_NAMES = re.compile(rf"\b({'|'.join(_LETTERS)})\b")

_RAISED = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")


def power_of_ten(exponent: int) -> str:
    """Return `10⁻¹⁵` for -15."""
    return f"10{str(exponent).translate(_RAISED)}"


def lettered(text: str) -> str:
    """Return a text with letters for their names, raised twos and a true minus before a number."""
    named = _NAMES.sub(lambda found: _LETTERS[found[1]], text)
    named = named.replace("^2", "²").replace("m/s2", "m/s²").replace("v0", "v₀")
    return re.sub(r"(?<![\w-])-(?=[\d.])", "−", named)
