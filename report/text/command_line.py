"""How the reader calls the program: `roofslip`, or the launcher's path such as `./roofslip`."""

from __future__ import annotations

import os
import re
import shlex
import sys
from pathlib import Path

# The name in lower case before a word is a command; the product is Roofslip.
_COMMAND = re.compile(r"(?<![\w./-])roofslip(?= [a-z])")

# No shell of Windows takes it apart.
_PLAIN = re.compile(r"[\w.:\\/+-]+")


def called() -> str:
    """Return the program as the reader typed it, which the launcher passes on."""
    return quoted(os.environ.get("ROOFSLIP_COMMAND") or "roofslip")


def quoted(word: object) -> str:
    """Return a word as the shell takes it; on Windows, as both cmd and PowerShell do."""
    if str(word).startswith("-"):  # a path: it would be taken for options
        word = os.path.join(".", str(word))
    if sys.platform == "win32":
        return str(word) if _PLAIN.fullmatch(str(word)) else f'"{word}"'
    return shlex.quote(str(word))


def command(words: str, path: Path) -> str:
    """Return a command on a path, as it can be pasted into a shell."""
    return f"{called()} {words} {quoted(path)}"


def as_typed(text: str) -> str:
    """Return a text whose commands begin as the reader's own."""
    return _COMMAND.sub(lambda _: called(), text)
