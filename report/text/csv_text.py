"""Rows as CSV that no spreadsheet computes.

`=2+3` is written as `'=2+3`, and -0.5, which is a number, as it is.
"""

from __future__ import annotations

import csv
import io
import re
from collections.abc import Iterable, Sequence
from typing import Any

_NUMBER = re.compile(r"[+-]?(\d+(\.\d*)?|\.\d+)([eE][+-]?\d+)?", re.ASCII)

# Their first characters; Excel in Japanese reads the wide ones as well.
_FORMULAS = tuple("=+-@＝＋－＠")


def csv_text(rows: Iterable[Sequence[Any]]) -> str:
    """Return rows as CSV, the same on every system, with no text that a spreadsheet computes."""
    text = io.StringIO()
    # It quotes only those line ends that are its own: a bare return would begin a row.
    csv.writer(text, lineterminator="\r\n").writerows([*map(_as_text, row)] for row in rows)
    return text.getvalue().replace("\r\n", "\n")


def _as_text(value: Any) -> Any:
    """Return a field, with an apostrophe before a text that would begin a formula."""
    # -0.5 begins as a formula does, and is a number.
    if not isinstance(value, str) or _NUMBER.fullmatch(value):
        return value
    is_live = value.startswith(("\t", "\r", "\n")) or value.lstrip().startswith(_FORMULAS)
    return f"'{value}" if is_live else value
