"""Limits on what a process of the page may use, where the system has them.

Windows has none of these; there only the limit on time holds. Read `limit_memory`.
"""

from __future__ import annotations

import errno
import importlib
import os

FULL = "The disk of the server is full. Make room there, then try it again."
INTERNAL = "An internal error; see what roofslip serve printed."


def limit_memory(maximum_bytes: int) -> None:
    """Limit the address space of this process and of those it starts."""
    _limit("RLIMIT_AS", maximum_bytes)


def limit_files(maximum_bytes: int) -> None:
    """Limit the size of each file that is written."""
    _limit("RLIMIT_FSIZE", maximum_bytes)


def limit_processor(maximum_s: int) -> None:
    """Limit the processor time of this process."""
    _limit("RLIMIT_CPU", maximum_s)


def give_way(nice: int) -> None:
    """Let other processes go first, as the command nice does."""
    if hasattr(os, "nice"):
        os.nice(nice)


def is_full(error: BaseException | None) -> bool:
    """Whether there is no room for what was to be written."""
    return isinstance(error, OSError) and error.errno in (errno.ENOSPC, errno.EDQUOT)


def _limit(name: str, value: int) -> None:
    try:
        resource = importlib.import_module("resource")
    except ModuleNotFoundError:
        return
    kind = getattr(resource, name)
    _, most = resource.getrlimit(kind)
    if most != resource.RLIM_INFINITY:
        value = min(value, most)
    resource.setrlimit(kind, (value, most))
