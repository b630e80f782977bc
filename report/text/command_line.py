"""The command as typed by the user: `roofslip`, or the launcher's path such as `./roofslip`."""

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
    """Return the program name as typed by the user, passed on by the launcher."""
    return quoted(os.environ.get("ROOFSLIP_COMMAND") or "roofslip")


def quoted(word: object) -> str:
    """Return a word quoted for the shell; on Windows, for both cmd and PowerShell."""
    if str(word).startswith("-"):  # a path: it would be taken for options
        word = os.path.join(".", str(word))
    if sys.platform == "win32":
        return str(word) if _PLAIN.fullmatch(str(word)) else f'"{word}"'
    return shlex.quote(str(word))


def command(words: str, path: Path) -> str:
    """Return a command on a path, as it can be pasted into a shell."""
    return f"{called()} {words} {quoted(path)}"


def as_typed(text: str) -> str:
    """Return a text whose commands begin as typed by the user."""
    return _COMMAND.sub(lambda _: called(), text)
