"""Formulas in running text: letters, signs, and no line break inside.

The solver writes `mu`, a page prints μ.
"""

from __future__ import annotations

import re

_LETTERS = {
    "mu": "μ", "theta": "θ", "phi": "φ", "omega": "ω", "eta": "η", "gamma": "γ", "beta": "β",
    "zeta": "ζ", "sigma": "σ", "pi": "π",
}  # fmt: skip

_NAMES = re.compile(rf"\b({'|'.join(_LETTERS)})\b")

_SIGNS = {"^2": "²", "m/s2": "m/s²", "v0": "v₀", "sqrt(": "√(", ">=": "≥", " - ": " − "}


def lettered(text: str) -> str:
    """Return a text with Greek letters, root signs, superscript twos and true minus signs."""
    named = _NAMES.sub(lambda match: _LETTERS[match[1]], text)
    for plain, set_well in _SIGNS.items():
        named = named.replace(plain, set_well)
    # A hyphen within a word or an option, such as --json, stays one.
    return re.sub(r"(?<![\w-])-(?=[\w.])", "−", named)


def unbroken(text: str) -> str:
    """Return a text with no line break inside `μ = 0.4` and `1 g`."""
    return re.sub(r" (?=[=/])|(?<=[=/]) | (?=g\b)", "\u00a0", text)
