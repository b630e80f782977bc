"""Results compared as numbers, and sheets as words. Knows neither PDF nor package."""

from __future__ import annotations

import difflib
import json
import math
from collections.abc import Iterator, Sequence
from typing import Any

MOST = 5
"""Differences told of one sheet or file; the others are counted."""

_LONGEST = 60
_OWN = ("roofslip_version",)
"""Keys that name the version, which is told apart."""


def number_differences(claimed: bytes, computed: bytes, tolerance: float) -> list[str]:
    """Return where two results.json differ, and by how much.

    Parameters
    ----------
    tolerance : float
        Relative, of every number.
    """
    try:
        claims = json.loads(claimed)
    except ValueError:
        return ["results.json cannot be read"]
    return [*_walk("", claims, json.loads(computed), tolerance)]


def _walk(place: str, one: Any, two: Any, tolerance: float) -> Iterator[str]:
    if isinstance(one, dict) and isinstance(two, dict):
        for key in dict.fromkeys((*one, *two)):
            if key in _OWN:
                continue
            below = f"{place}.{key}".lstrip(".")
            if key in one and key in two:
                yield from _walk(below, one[key], two[key], tolerance)
            else:
                yield f"{below} is {'missing' if key in two else 'not of this input'}"
    elif isinstance(one, list) and isinstance(two, list) and len(one) == len(two):
        for at, pair in enumerate(zip(one, two, strict=True)):
            yield from _walk(f"{place}[{at}]", *pair, tolerance)
    elif not _is_same(one, two, tolerance):
        yield f"{place} is {_short(one)}; the input gives {_short(two)}{_by(one, two)}"


def _is_same(one: Any, two: Any, tolerance: float) -> bool:
    if _is_number(one) and _is_number(two):
        return math.isclose(one, two, rel_tol=tolerance, abs_tol=0.0) or one == two
    return type(one) is type(two) and bool(one == two)


def _is_number(value: Any) -> bool:
    return isinstance(value, (int, float)) and not isinstance(value, bool)


def _short(value: Any) -> str:
    text = json.dumps(value, ensure_ascii=False)
    return text if len(text) <= _LONGEST else f"{text[:_LONGEST]}..."


def _by(one: Any, two: Any) -> str:
    """Return by how much two numbers differ, relative to the second."""
    if _is_number(one) and _is_number(two) and two:
        return f" ({abs(one - two) / abs(two):.1e} of it)"
    return ""


def word_differences(claimed: str, computed: str) -> list[str]:
    """Return where the words and numbers of a sheet differ; line breaks do not count."""
    one, two = claimed.split(), computed.split()
    if one == two:
        return []
    matcher = difflib.SequenceMatcher(None, one, two, autojunk=False)
    return [
        f"{_quoted(one[a:b])} where the input gives {_quoted(two[c:d])}"
        for kind, a, b, c, d in matcher.get_opcodes()
        if kind != "equal"
    ]


def _quoted(words: Sequence[str]) -> str:
    text = " ".join(words)
    shown = text if len(text) <= _LONGEST else f"{text[:_LONGEST]}..."
    return f"'{shown}'" if words else "nothing"


def listed(differences: Sequence[str]) -> list[str]:
    """Return the first of many differences, and how many more there are."""
    more = len(differences) - MOST
    return [*differences[:MOST], *([f"and {more} more"] if more > 0 else [])]
