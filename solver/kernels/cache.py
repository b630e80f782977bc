"""Compiled code on disk: where it cannot be kept, a process compiles for itself and goes on.

Knows no kernel; `solver.kernels` makes it known to numba before any kernel is loaded.
"""

from __future__ import annotations

import warnings
from functools import cache
from typing import Any

from numba.core import dispatcher
from numba.core.caching import FunctionCache, NullCache

NOT_KEPT = (
    "the compiled solver cannot be kept on disk ({reason}), so every run compiles it again; set "
    "the environment variable NUMBA_CACHE_DIR to a folder that can be written"
)


class WillingCache(FunctionCache):
    """The cache of numba, without which a run is slower but no different."""

    def load_overload(self, sig: Any, target_context: Any) -> Any:
        """Return compiled code, None if there is none or it cannot be read."""
        try:
            return super().load_overload(sig, target_context)
        except OSError:
            return None

    def save_overload(self, sig: Any, data: Any) -> None:
        """Keep compiled code if the disk takes it."""
        try:
            super().save_overload(sig, data)
        except OSError as error:
            _warn(error.strerror or str(error))


def cache_of(function: Any) -> Any:
    """Return the cache of a kernel; one that keeps nothing where no folder can be written."""
    try:
        return WillingCache(function)
    except RuntimeError:
        _warn("no folder for it can be written")
        return NullCache()


@cache  # once; numba forgets while it compiles which warnings were printed
def _warn(reason: str) -> None:
    warnings.warn(NOT_KEPT.format(reason=reason), stacklevel=1)


dispatcher.FunctionCache = cache_of
