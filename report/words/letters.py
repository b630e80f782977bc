"""Greek letters for their names (the solver writes `mu`, a page prints μ); superscripts."""

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
    "zeta": "ζ",
    "sigma": "σ",
    "pi": "π",
}
_NAMES = re.compile(rf"\b({'|'.join(_LETTERS)})\b")

_SIGNS = {"^2": "²", "m/s2": "m/s²", "v0": "v₀", "sqrt(": "√(", ">=": "≥", " - ": " − "}

_RAISED = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")


def power_of_ten(exponent: int) -> str:
    """Return `10⁻¹⁵` for -15."""
    return f"10{str(exponent).translate(_RAISED)}"


def lettered(text: str) -> str:
    """Return a text with Greek letters, root signs, superscript twos and true minus signs."""
    named = _NAMES.sub(lambda match: _LETTERS[match[1]], text)
    for plain, set_well in _SIGNS.items():
        named = named.replace(plain, set_well)
    return re.sub(r"(?<![\w-])-(?=[\w.])", "−", named)
