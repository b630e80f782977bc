"""Spaces and signs in texts: 30.0 in keeps its unit on the line of the number."""

from __future__ import annotations

NO_BREAK = "\u00a0"
"""Between a number and its unit, wherever a text is composed."""


def with_minus(value: float) -> str:
    """Return a number with a true minus sign."""
    return f"{value:g}".replace("-", "−")


def equation(letter: str, value: float, unit: str = "") -> str:
    """Return `μ = 0.4` or `PPA = 1.5 g`, on one line."""
    return NO_BREAK.join([letter, "=", with_minus(value), *unit.split()])


def spaced(text: str) -> str:
    """Return a text with ordinary spaces, as used everywhere except on pages."""
    return text.replace(NO_BREAK, " ")
