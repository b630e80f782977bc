"""Output of the commands: plain lines, verdicts and levels in color, JSON; exit codes."""

from __future__ import annotations

import json
import os
import re
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import click

from report.text.command_line import as_typed, command
from solver.spaces import spaced

# Exit codes; 0 is done, whatever the verdict.
INTERNAL_ERROR = 1
"""The program failed (with the traceback), or checks of `verify` did."""
DIFFERS = 1
"""A package differs from what its own input gives."""
# As click exits for a wrong option.
INPUT_ERROR = 2
NOT_OK = 3
"""With --fail-on-ng: the verdict is not OK."""
NOT_COMPARED = 4
"""`verify-package` could not compare all of a package."""
INTERRUPTED = 130
"""Ended by Ctrl+C, which shells write as 128 + signal 2."""

_GREEN, _RED, _YELLOW = ({"fg": color, "bold": True} for color in ("green", "red", "yellow"))
_STYLES: Mapping[str, Mapping[str, Any]] = {
    # Before "OK": of several words at one place, a regular expression takes the first.
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
    # `click.echo` takes the codes off where no terminal reads.
    return _WORD.sub(lambda word: click.style(word[0], **_ALL[word[0]]), line)


def color_choice() -> bool | None:
    """Return whether to color: not with NO_COLOR or without terminal support; else by click."""
    # NO_COLOR counts if it is not empty (no-color.org).
    return False if os.environ.get("NO_COLOR") or os.environ.get("TERM") == "dumb" else None


# A cell of Excel has up to 32,767 characters, and an error may quote it.
_LONGEST = 2000

# Control characters, and those that separate lines or change the direction of a text.
_UNSAFE = re.compile(r"[\x00-\x1f\x7f-\x9f\u200e\u200f\u2028-\u202e\u2066-\u2069\ud800-\udfff]")


def plain(text: object) -> str:
    """Return a text suitable for a terminal: with spaces, no control characters, not too long."""
    line = _UNSAFE.sub("?", spaced(str(text)))
    return line if len(line) <= _LONGEST else f"{line[:_LONGEST]}..."


def say(*parts: str | Path, is_error: bool = False) -> None:
    """Print a line: words as `plain`, with verdicts in color and the reader's commands; paths."""
    # A path is copied from the line: a no-break space of its own stays.
    texts = [
        _UNSAFE.sub("?", str(part)) if isinstance(part, Path) else colored(as_typed(plain(part)))
        for part in parts
    ]
    click.echo("".join(texts), err=is_error)


def print_json(document: Any) -> None:
    """Print a document."""
    # Letters as they are: `set_up_console` has every pipe take UTF-8.
    click.echo(json.dumps(document, ensure_ascii=False))


def say_next(project: Path, has_formulas: bool) -> None:
    """Print the next step after cells of a workbook were filled in."""
    click.echo(f"Next: {command('check', project)}")
    if has_formulas:
        click.echo(
            "Open and save the workbook in Excel or LibreOffice once to recalculate its formulas."
        )
