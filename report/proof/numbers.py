"""Untrusted JSON, compared as numbers, and sheets as words. Knows neither PDF nor package."""

from __future__ import annotations

import difflib
import json
import math
from collections import Counter
from collections.abc import Iterator, Sequence
from itertools import takewhile
from typing import Any

from pydantic_core import from_json

from solver.model import InputError

MOST = 5
"""Differences told of one sheet or file; the others are counted."""

_LONGEST, _DIGITS = 60, 20
_MOST_PAIRS = 100_000  # of equal words of two sheets: those of a package have fewer


def parsed(content: bytes, name: str) -> Any:
    """Return JSON as data.

    Raises
    ------
    InputError
        If it is none, is nested too deep, names a key twice, or has a number beyond any of ours.
    """
    try:
        from_json(content, allow_inf_nan=False)  # it counts how deep, `json` ends in a traceback
    except ValueError as error:
        raise InputError(f"{name} is damaged: no JSON") from error
    try:
        return json.loads(content, object_pairs_hook=_unlike, parse_int=_whole, parse_float=_finite)
    except ValueError as error:
        raise InputError(f"{name} is damaged: {error}") from error


def _unlike(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    """Return an object of JSON; of a key given twice one program reads the first, one the last."""
    found = dict(pairs)
    if len(found) < len(pairs):
        twice = next(key for key, count in Counter(key for key, _ in pairs).items() if count > 1)
        raise ValueError(f"the key {_short(twice)} is given twice")
    return found


def _whole(digits: str) -> int:
    if len(digits) > _DIGITS:
        raise ValueError(f"{_short(digits)} is larger than any number of a package")
    return int(digits)


def _finite(digits: str) -> float:
    if math.isinf(float(digits)):
        raise ValueError(f"{_short(digits)} is larger than any number of a package")
    return float(digits)


def number_differences(one: Any, two: Any, tolerance: float, place: str = "") -> Iterator[str]:
    """Yield where two documents of JSON, as claimed and as computed, differ, and by how much.

    Parameters
    ----------
    tolerance : float
        Relative, of every number.
    place : str
        Where they are in larger ones.
    """
    if isinstance(one, dict) and isinstance(two, dict):
        for key in dict.fromkeys((*one, *two)):
            below = f"{place}.{key}".lstrip(".")
            if key in one and key in two:
                yield from number_differences(one[key], two[key], tolerance, below)
            else:
                yield f"{below} is {'missing' if key in two else 'not of this input'}"
    elif isinstance(one, list) and isinstance(two, list) and len(one) == len(two):
        for at, pair in enumerate(zip(one, two, strict=True)):
            yield from number_differences(*pair, tolerance, f"{place}[{at}]")
    elif not _is_same(one, two, tolerance):
        yield f"{place} is {_short(one)}; the input gives {_short(two)}{_by(one, two)}"


def _is_same(one: Any, two: Any, tolerance: float) -> bool:
    if _is_number(one) and _is_number(two):
        return math.isclose(one, two, rel_tol=tolerance, abs_tol=0.0) or one == two
    return type(one) is type(two) and bool(one == two)


def _is_number(value: Any) -> bool:
    return isinstance(value, (int, float)) and not isinstance(value, bool)


def _short(value: Any) -> str:
    return _cut(json.dumps(value, ensure_ascii=False))


def _cut(text: str) -> str:
    return text if len(text) <= _LONGEST else f"{text[:_LONGEST]}..."


def _by(one: Any, two: Any) -> str:
    """Return by how much two numbers differ, relative to the second."""
    if _is_number(one) and _is_number(two) and two:
        return f" ({abs(one - two) / abs(two):.1e} of it)"
    return ""


def word_differences(claimed: str, computed: str) -> list[str]:
    """Return where the words and numbers of a sheet differ; blanks and line breaks do not count."""
    one, two = claimed.split(), computed.split()
    if "".join(one) == "".join(two):
        return []
    first = sum(1 for _ in takewhile(lambda pair: pair[0] == pair[1], zip(one, two, strict=False)))
    one, two = one[first:], two[first:]
    if sum(map(Counter(two).__getitem__, one)) > _MOST_PAIRS:
        return [f"{_quoted(one)} where the input gives {_quoted(two)}"]
    matcher = difflib.SequenceMatcher(None, one, two, autojunk=False)
    return [
        f"{_quoted(one[a:b])} where the input gives {_quoted(two[c:d])}"
        for kind, a, b, c, d in matcher.get_opcodes()
        if kind != "equal"
    ]


def _quoted(words: Sequence[str]) -> str:
    return f"'{_cut(' '.join(words))}'" if words else "nothing"


def listed(differences: Sequence[str]) -> list[str]:
    """Return the first of many differences, and how many more there are."""
    more = len(differences) - MOST
    return [*differences[:MOST], *([f"and {more} more"] if more > 0 else [])]
