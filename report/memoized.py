"""Results that a warm process keeps, under a hash of everything they are computed from.

`roofslip watch` computes nearly the same again after each save. A kept result is found only by the
function and the content of all its arguments, so that none can be stale. Elsewhere nothing is kept
and nothing is hashed. Read `memoized`, then `new_generation`.
"""

from __future__ import annotations

import hashlib
import pickle
from collections.abc import Callable
from dataclasses import dataclass
from functools import wraps
from typing import Any, ParamSpec, TypeVar

_P = ParamSpec("_P")
_R = TypeVar("_R")

GENERATIONS = 3
"""Generations after which a result that none asked for is dropped: an input is often changed
back."""


@dataclass(slots=True)
class _Result:
    value: Any
    last_generation: int


class _Store:
    """The results that a process keeps: those that the last `GENERATIONS` generations asked for."""

    def __init__(self) -> None:
        self._results: dict[bytes, _Result] = {}
        self._generation = 0

    def new_generation(self) -> None:
        self._generation += 1
        oldest = self._generation - GENERATIONS
        self._results = {
            key: result for key, result in self._results.items() if result.last_generation >= oldest
        }

    def result(self, function: Callable[..., Any], *call: Any) -> Any:
        # Two values that differ never have one pickle: it can be read back.
        content = pickle.dumps((function.__module__, function.__qualname__, *call))
        key = hashlib.sha256(content).digest()
        found = self._results.get(key)
        if found is None:
            positional, named = call
            found = self._results[key] = _Result(function(*positional, **named), 0)
        found.last_generation = self._generation
        return found.value


_store: _Store | None = None


def new_generation() -> None:
    """Keep results in this process from now on, and drop what no recent generation asked for."""
    global _store
    _store = _store or _Store()
    _store.new_generation()


def clear() -> None:
    """Drop all results and keep none."""
    global _store
    _store = None


def memoized(function: Callable[_P, _R]) -> Callable[_P, _R]:
    """Return a function whose results are kept for generations, and shared: none may be changed.

    It must depend on its arguments alone, which must be picklable: no files, no clock.
    """

    @wraps(function)
    def asked(*args: _P.args, **kwargs: _P.kwargs) -> _R:
        if _store is None:
            return function(*args, **kwargs)
        result: _R = _store.result(function, args, kwargs)
        return result

    return asked
