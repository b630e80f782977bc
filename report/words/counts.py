"""Counts and lists in sentences: counts are spelled out up to nine, in digits beyond."""

from __future__ import annotations

from collections.abc import Callable, Hashable, Iterable, Mapping, Sequence
from typing import TypeVar

_Item = TypeVar("_Item")
_Key = TypeVar("_Key", bound=Hashable)

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


def grouped_by(items: Iterable[_Item], key: Callable[[_Item], _Key]) -> Mapping[_Key, list[_Item]]:
    """Return items in groups of one key, in the order of their first items."""
    groups: dict[_Key, list[_Item]] = {}
    for item in items:
        groups.setdefault(key(item), []).append(item)
    return groups


def ranged(names: Iterable[str]) -> str:
    """Return names in their order, three or more that count on as one: `A1 to A6, A9, A10`."""
    runs: list[list[str]] = []
    for name in names:
        if runs and name == _following(runs[-1][-1]):
            runs[-1].append(name)
        else:
            runs.append([name])
    return ", ".join(f"{run[0]} to {run[-1]}" if len(run) > 2 else ", ".join(run) for run in runs)


def _following(name: str) -> str:
    """Return the name that counts on from one, with its leading zeros: A10 from A9."""
    stem = name.rstrip("0123456789")
    digits = name[len(stem) :]
    return f"{stem}{int(digits) + 1:0{len(digits)}d}" if digits else ""


def named(names: Sequence[str], noun: str) -> str:
    """Return names with their noun before them: `array A9`, `arrays A1 to A6`."""
    return f"{noun}{'' if len(names) == 1 else 's'} {ranged(names)}"
