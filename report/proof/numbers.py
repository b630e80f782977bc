"""JSON and words from strangers, compared. Knows neither PDF nor package."""

from __future__ import annotations

import json
import math
from collections import Counter
from collections.abc import Iterator, Sequence
from itertools import takewhile
from typing import Any

from pydantic_core import from_json

from solver.model import InputError

RELATIVE, ABSOLUTE = 1e-9, 1e-14
"""Differences of two numbers that other processors explain."""

_LONGEST, _DIGITS = 60, 20


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
        return json.loads(content, object_pairs_hook=_object, parse_int=_whole, parse_float=_finite)
    except ValueError as error:
        raise InputError(f"{name} is damaged: {error}") from error


def _object(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
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


def differences(one: Any, two: Any, place: str = "", *, shared: bool = False) -> Iterator[str]:
    """Yield where two documents of JSON, as claimed and as computed, differ.

    Parameters
    ----------
    place : str
        Where they are in larger ones.
    shared : bool
        Compare only the numbers that both have.
    """
    if isinstance(one, dict) and isinstance(two, dict):
        for key in dict.fromkeys((*one, *two)):
            below = f"{place}.{key}".lstrip(".")
            if key in one and key in two:
                yield from differences(one[key], two[key], below, shared=shared)
            elif not shared:
                yield f"{below} is {'missing' if key in two else 'not of this input'}"
    elif isinstance(one, list) and isinstance(two, list) and (shared or len(one) == len(two)):
        for at, pair in enumerate(zip(one, two, strict=False)):
            yield from differences(*pair, f"{place}[{at}]", shared=shared)
    elif _is_number(one) and _is_number(two):
        if abs(one - two) > _allowed(one, two, place):
            yield f"{place} is {_short(one)}; the input gives {_short(two)}"
    elif not shared and (type(one) is not type(two) or one != two):
        yield f"{place} is {_short(one)}; the input gives {_short(two)}"


def _is_number(value: Any) -> bool:
    return isinstance(value, (int, float)) and not isinstance(value, bool)


def _allowed(one: float, two: float, place: str) -> float:
    """Return how far two numbers may be apart; an estimated error, by its own size."""
    if place.rpartition(".")[2] == "error_m":
        return max(abs(two), ABSOLUTE)
    return max(RELATIVE * max(abs(one), abs(two)), ABSOLUTE)


def _short(value: Any) -> str:
    text = json.dumps(value, ensure_ascii=False)
    return text if len(text) <= _LONGEST else f"{text[:_LONGEST]}..."


def first_other_word(claimed: str, computed: str) -> str:
    """Return where the words of two texts first differ, or nothing; blanks do not count."""
    one, two = claimed.split(), computed.split()
    letters = "".join(one), "".join(two)
    if letters[0] == letters[1]:
        return ""
    same = takewhile(lambda pair: pair[0] == pair[1], zip(*letters, strict=False))
    at = sum(1 for _ in same)
    return f"{_word(one, at)} where the input gives {_word(two, at)}"


def _word(words: Sequence[str], letter: int) -> str:
    """Return the word that has a letter, counted without blanks."""
    for word in words:
        letter -= len(word)
        if letter < 0:
            return _short(word)
    return "nothing"
