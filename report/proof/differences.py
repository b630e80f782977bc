"""Differences between two JSON documents or texts: one claimed, one computed.

`differences({"prd_m": 0.11}, {"prd_m": 0.12})` yields `prd_m is 0.11; the input gives 0.12`.
"""

from __future__ import annotations

import json
import math
from collections import Counter
from collections.abc import Iterator, Sequence
from itertools import takewhile
from typing import Any

from pydantic_core import from_json

from solver.errors import InputError

# Differences of two numbers that other processors explain.
RELATIVE, ABSOLUTE = 1e-9, 1e-14
_LONGEST, _DIGITS = 60, 20


def parsed(content: bytes, name: str) -> Any:
    """Return JSON as data.

    Raises `InputError` if it is not JSON, is nested too deep, repeats a key, or contains a number
    that is too large.
    """
    try:
        # It counts how deep it goes; `json` ends in a traceback.
        from_json(content, allow_inf_nan=False)
    except ValueError as error:
        raise InputError(f"{name} is damaged: not JSON") from error
    try:
        return json.loads(content, object_pairs_hook=_object, parse_int=_whole, parse_float=_finite)
    except ValueError as error:
        raise InputError(f"{name} is damaged: {error}") from error


def _object(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    """Return an object of JSON."""
    # Of a key given twice one program reads the first, another the last.
    members = dict(pairs)
    if len(members) < len(pairs):
        twice = next(key for key, count in Counter(key for key, _ in pairs).items() if count > 1)
        raise ValueError(f"the key {_short(twice)} appears twice")
    return members


def _whole(digits: str) -> int:
    # Python needs quadratic time for the digits of a whole number.
    if len(digits) > _DIGITS:
        raise ValueError(f"{_short(digits)} is larger than any number of a package")
    return int(digits)


def _finite(digits: str) -> float:
    # 1e999 is infinite in Python and an error elsewhere.
    if math.isinf(float(digits)):
        raise ValueError(f"{_short(digits)} is larger than any number of a package")
    return float(digits)


def differences(
    claimed: Any, computed: Any, place: str = "", *, shared: bool = False
) -> Iterator[str]:
    """Yield differences between a claimed and a computed JSON document.

    `place` is where they are in larger ones; `shared` compares only the numbers that both have.
    """
    if isinstance(claimed, dict) and isinstance(computed, dict):
        for key in dict.fromkeys((*claimed, *computed)):
            below = f"{place}.{key}".lstrip(".")
            if key in claimed and key in computed:
                yield from differences(claimed[key], computed[key], below, shared=shared)
            elif not shared:
                yield f"{below} is {'missing' if key in computed else 'not produced by this input'}"
    elif (
        isinstance(claimed, list)
        and isinstance(computed, list)
        and (shared or len(claimed) == len(computed))
    ):
        for index, pair in enumerate(zip(claimed, computed, strict=False)):
            yield from differences(*pair, f"{place}[{index}]", shared=shared)
    elif _is_number(claimed) and _is_number(computed):
        if abs(claimed - computed) > _allowed(claimed, computed, place):
            yield f"{place} is {_short(claimed)}; the input produces {_short(computed)}"
    # By type first: True == 1 in Python, and not in JSON.
    elif not shared and (type(claimed) is not type(computed) or claimed != computed):
        yield f"{place} is {_short(claimed)}; the input produces {_short(computed)}"


def _is_number(value: Any) -> bool:
    return isinstance(value, (int, float)) and not isinstance(value, bool)


def _allowed(claimed: float, computed: float, place: str) -> float:
    """Return the permitted difference of two numbers."""
    # An estimate of an error is itself mostly rounding: it may differ by its own size.
    if place.rpartition(".")[2] == "error_m":
        return max(abs(computed), ABSOLUTE)
    return max(RELATIVE * max(abs(claimed), abs(computed)), ABSOLUTE)


def _short(value: Any) -> str:
    text = json.dumps(value, ensure_ascii=False)
    return text if len(text) <= _LONGEST else f"{text[:_LONGEST]}..."


def first_other_word(claimed: str, computed: str) -> str:
    """Return the first difference between the words of two texts, or nothing; ignores blanks."""
    first, second = claimed.split(), computed.split()
    # Where a line breaks, and with it where blanks are, follows from the fonts that lay it out.
    letters = "".join(first), "".join(second)
    if letters[0] == letters[1]:
        return ""
    same = takewhile(lambda pair: pair[0] == pair[1], zip(*letters, strict=False))
    index = sum(1 for _ in same)
    return f"{_word(first, index)} where the input produces {_word(second, index)}"


def _word(words: Sequence[str], letter: int) -> str:
    """Return the word that has a letter, counted without blanks."""
    for word in words:
        letter -= len(word)
        if letter < 0:
            return _short(word)
    return "nothing"
