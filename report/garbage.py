"""Python's search for garbage, put off: what a report makes lives until its end.

Knows nothing of reports.
"""

from __future__ import annotations

import atexit
import gc
from collections.abc import Iterator
from contextlib import contextmanager


@contextmanager
def no_collections() -> Iterator[None]:
    """Look for no garbage: among a million live boxes the search takes a third of the time."""
    was_enabled = gc.isenabled()
    gc.disable()
    try:
        yield
    finally:
        if was_enabled:
            gc.enable()


def none_at_exit() -> None:
    """Spare the last search, as the process ends: all memory goes then."""
    atexit.register(gc.freeze)
