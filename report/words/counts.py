"""Counts and lists in sentences: counts are spelled out up to nine, in digits beyond."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from itertools import groupby

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


def ranged(names: Iterable[str], order: Sequence[str]) -> str:
    """Return `A1 to A6, A9, A10`: three names or more that follow each other in an order."""
    places = enumerate(sorted(map(order.index, names)))
    # Places that follow each other are as far from their counts.
    groups = groupby(places, lambda found: found[1] - found[0])
    runs = ([order[at] for _, at in group] for _, group in groups)
    return ", ".join(f"{run[0]} to {run[-1]}" if run[2:] else ", ".join(run) for run in runs)
