"""Counts and lists in sentences: counts are spelled out up to nine, in digits beyond."""

from __future__ import annotations

from collections.abc import Callable, Hashable, Iterable, Mapping, Sequence
from typing import Any, TypeVar

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


def ids_by(items: Iterable[Any], key: Callable[[Any], _Key]) -> Mapping[_Key, list[str]]:
    """Return the same of items with an id, each by that."""
    groups = grouped_by(items, key).items()
    return {found: [item.id for item in alike] for found, alike in groups}


def ranged(names: Iterable[str]) -> str:
    """Return names, each once and sorted, three or more that count on as one: `A1 to A6, A9`."""
    runs: list[list[tuple[str, int, str]]] = []
    for stem, number, name in sorted(set(map(name_order, names))):
        if runs and runs[-1][-1][:2] == (stem, number - 1):
            runs[-1].append((stem, number, name))
        else:
            runs.append([(stem, number, name)])
    own = ([name for *_, name in run] for run in runs)
    return ", ".join(f"{run[0]} to {run[-1]}" if len(run) > 2 else ", ".join(run) for run in own)


def name_order(name: str) -> tuple[str, int, str]:
    """Return what is before the number at the end of a name, the number, and the name."""
    stem = name.rstrip("0123456789")
    return stem, int(name[len(stem) :] or -2), name


def named(names: Sequence[str], noun: str) -> str:
    """Return names with their noun before them: `array A9`, `arrays A1 to A6`."""
    return f"{noun}{'' if len(names) == 1 else 's'} {ranged(names)}"
