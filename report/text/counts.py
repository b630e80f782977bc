"""Counts in sentences: spelled out up to nine, in digits beyond.

    counted(3, "array")    three arrays
    numbered(12, "run")    12 runs
    thousands(12000)       12,000

Read `spelled`.
"""

from __future__ import annotations

_WORDS = ("no", "one", "two", "three", "four", "five", "six", "seven", "eight", "nine")


def spelled(count: int) -> str:
    """Return a count in words up to nine, such as `three`, and in digits beyond; `no` for 0."""
    return _WORDS[count] if count < len(_WORDS) else str(count)


def counted(count: int, noun: str) -> str:
    """Return a number of things, such as `one array`, `three arrays` or `12 arrays`."""
    return f"{spelled(count)} {noun}" if count == 1 else f"{spelled(count)} {noun}s"


def numbered(count: int, noun: str) -> str:
    """Return the same in digits, such as `1 problem` or `3 problems`."""
    return f"{count} {noun}" if count == 1 else f"{count} {noun}s"


def thousands(count: int) -> str:
    """Return a count in digits, in groups of three."""
    return f"{count:,}"
