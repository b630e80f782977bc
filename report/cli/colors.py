"""Verdicts and levels in color. `click.echo` takes it off where no terminal reads.

Read `colored`.
"""

from __future__ import annotations

import os
import re
from collections.abc import Mapping
from typing import Any

import click

_GREEN, _RED, _YELLOW = ({"fg": color, "bold": True} for color in ("green", "red", "yellow"))
_STYLES: Mapping[str, Mapping[str, Any]] = {
    "OK with conditions": _YELLOW,
    "OK": _GREEN,
    "PASS": _GREEN,
    "NG": _RED,
    "FAIL": _RED,
    "Condition": _YELLOW,
}
_LEVELS: Mapping[str, Mapping[str, Any]] = {  # at the beginning of a line
    "condition": _YELLOW,
    "warning": {"fg": "yellow"},
    "note": {"dim": True},
}
_ALL = {**_STYLES, **_LEVELS}
_WORD = re.compile(rf"\b(?:{'|'.join(_STYLES)})\b|^(?:{'|'.join(_LEVELS)})(?=: )")


def colored(line: str) -> str:
    """Return a line with its verdicts, and the level it begins with, in color."""
    return _WORD.sub(lambda found: click.style(found[0], **_ALL[found[0]]), line)


def color_choice() -> bool | None:
    """Return whether to color: not where NO_COLOR is set or the terminal has none; else by click.

    NO_COLOR counts if it is not empty (no-color.org).
    """
    return False if os.environ.get("NO_COLOR") or os.environ.get("TERM") == "dumb" else None
