"""Limits on what a process of the page may use, where the system has them.

Windows has none of these; there only the limit on time holds. Read `confine`.
"""

from __future__ import annotations

import errno
import importlib
import os
from contextlib import suppress

FULL = "The disk of the server is full. Make room there, then try it again."
INTERNAL = "An internal error; see what roofslip serve printed."


def confine(nice: int, **limits: int) -> None:
    """Let other processes go first, as the command nice does, and limit this one.

    Parameters
    ----------
    **limits : int
        By the names of the module `resource`: RLIMIT_AS, memory [bytes]; RLIMIT_FSIZE, each file
        that is written [bytes]; RLIMIT_CPU, processor time [s]. Those it starts have the same.
    """
    os.environ["OPENBLAS_NUM_THREADS"] = "1"  # the matrices are small; read as NumPy is loaded
    if hasattr(os, "nice"):
        os.nice(nice)
    with suppress(ModuleNotFoundError):
        resource = importlib.import_module("resource")
        for name, value in limits.items():
            kind = getattr(resource, name)
            _, most = resource.getrlimit(kind)
            if most != resource.RLIM_INFINITY:
                value = min(value, most)
            resource.setrlimit(kind, (value, most))


def is_full(error: BaseException | None) -> bool:
    """Whether there is no room for what was to be written."""
    return isinstance(error, OSError) and error.errno in (errno.ENOSPC, errno.EDQUOT)
