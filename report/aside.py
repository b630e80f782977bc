"""Work done aside, in a copy of this process, where that is safe: a report has two cores to use."""

from __future__ import annotations

import os
import pickle
import sys
import threading
import warnings
from collections.abc import Callable
from typing import TypeVar

T = TypeVar("T")


def begin(work: Callable[[], T]) -> Callable[[], T]:
    """Begin some work in a copy of this process; return what waits for its outcome.

    Where a copy is not safe (other threads, other systems) or fails, the work is done here.
    """
    if sys.platform != "linux" or threading.active_count() > 1:
        return work
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

    def outcome() -> T:
        with os.fdopen(reading, "rb") as pipe:
            data = pipe.read()
        _, status = os.waitpid(child, 0)
        if status != 0:
            return work()
        found: T = pickle.loads(data)
        return found

    return outcome


def _work_and_exit(work: Callable[[], object], writing: int) -> None:
    status = 1
    try:
        with os.fdopen(writing, "wb") as pipe:
            pickle.dump(work(), pipe)
        status = 0
    finally:
        os._exit(status)  # without flushing or closing what belongs to the other process
