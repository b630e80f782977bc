"""How the reader calls the program: `roofslip`, or the launcher's path such as `./roofslip`.

Texts say `roofslip`; what prints them passes them through `as_typed`. Packages and JSON are the
same however the program was called.
"""

from __future__ import annotations

import os
import re
import shlex
from pathlib import Path

# The name in lower case before a word is a command; the product is Roofslip.
_COMMAND = re.compile(r"(?<![\w./-])roofslip(?= [a-z])")


def called() -> str:
    """Return the program as the reader typed it, which the launcher passes on."""
    return shlex.quote(os.environ.get("ROOFSLIP_COMMAND") or "roofslip")


def command(words: str, path: Path) -> str:
    """Return a command on a path, as it can be pasted into a shell."""
    return f"{called()} {words} {shlex.quote(str(path))}"


def as_typed(text: str) -> str:
    """Return a text whose commands begin as the reader's own."""
    return _COMMAND.sub(lambda _: called(), text)
