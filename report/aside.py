"""Work done aside, in a copy of this process, where that is safe: a report has two cores to use."""

from __future__ import annotations

import os
import pickle
import sys
import threading
import warnings
from collections.abc import Callable, Iterable, Iterator
from itertools import islice
from typing import TypeVar

T = TypeVar("T")


def begin(work: Callable[[], Iterable[T]]) -> Iterator[T]:
    """Begin some work in a copy of this process; return an iterator over its outcomes.

    Each outcome can be had as soon as the work yields it. Where a copy is not safe (other threads,
    other systems) the work is done here, and where one fails, what it did not give.
    """
    if sys.platform != "linux" or threading.active_count() > 1:
        return iter(work())
    reading, writing = os.pipe()
    with warnings.catch_warnings():
        # Later Pythons warn of threads that only wait inside numerical libraries.
        warnings.simplefilter("ignore", DeprecationWarning)
        child = os.fork()
    if child == 0:
        # With a reading end of its own it would wait for ever where nobody asks for the outcome.
        os.close(reading)
        _work_and_exit(work, writing)
    os.close(writing)
    return _outcomes(work, child, reading)


def _outcomes(work: Callable[[], Iterable[T]], child: int, reading: int) -> Iterator[T]:
    count = 0
    with os.fdopen(reading, "rb") as pipe:
        while pipe.peek(1):
            try:
                found: T = pickle.load(pipe)
            except (EOFError, pickle.UnpicklingError):
                break  # the copy ended in the middle of it
            yield found
            count += 1
    _, status = os.waitpid(child, 0)
    if status != 0:
        yield from islice(work(), count, None)


def _work_and_exit(work: Callable[[], Iterable[object]], writing: int) -> None:
    status = 1
    try:
        with os.fdopen(writing, "wb") as pipe:
            for outcome in work():
                pickle.dump(outcome, pipe)
                pipe.flush()
        status = 0
    finally:
        os._exit(status)  # without flushing or closing what belongs to the other process
