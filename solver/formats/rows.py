"""Rows of numbers in lines of text: without comments and blanks, with their separator.

`0.01, 0.2  # note` is a row of two numbers between commas, and `time_s,acc_g` a heading.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence

_BLANK_BETWEEN = re.compile(r"[^,\s]\s+[^,\s]")


# Index of a line, and its content.
Row = tuple[int, str]


def content_of(line: str) -> str:
    """Return a line without comment and blanks at its ends."""
    return line.partition("#")[0].strip()


def rows_of(lines: Sequence[str], start: int) -> Iterator[Row]:
    """Index and content of each line from index `start` on that is not blank or a comment."""
    for index in range(start, len(lines)):
        if content := content_of(lines[index]):
            yield index, content


def first_row(lines: Sequence[str]) -> int:
    """Index of the first line that may have numbers: after the heading, if there is one."""
    for index, content in rows_of(lines, 0):
        return index + 1 if is_heading(content) else index
    return len(lines)


def is_heading(content: str) -> bool:
    """Whether a line begins with what is no number."""
    word = re.split(r"[,;\s]", content)[0]
    return content[0] not in "+-.0123456789" and word.lower() not in {"nan", "inf", "infinity"}


def separator_of(content: str) -> str | None:
    """Separator of the columns; None for blanks and tabs. The commas of `0,1 0,2` are decimal."""
    if ";" in content:
        return ";"
    return "," if "," in content and not _BLANK_BETWEEN.search(content) else None
