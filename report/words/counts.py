"""Counts and lists in sentences: counts are spelled out up to nine, in digits beyond."""

from __future__ import annotations

from collections.abc import Sequence

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


def capitalized(text: str) -> str:
    """Return a text with its first letter in upper case, the rest as it is."""
    return text[:1].upper() + text[1:]


def lowered(text: str) -> str:
    """Return a text with its first letter in lower case, as within a sentence."""
    return text[:1].lower() + text[1:]


def joined(names: Sequence[str]) -> str:
    """Return `a, b and c`."""
    *first, last = names
    return f"{', '.join(first)} and {last}" if first else last
