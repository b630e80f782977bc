"""Spaces in texts: 30.0 in keeps its unit on the line of the number."""

from __future__ import annotations

NO_BREAK = "\u00a0"
"""Between a number and its unit, wherever a text is composed."""


def spaced(text: str) -> str:
    """Return a text with ordinary spaces, as all have it but pages."""
    return text.replace(NO_BREAK, " ")
