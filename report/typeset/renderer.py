"""Loads the renderer, and has it work quickly. Its three neighbors call `load` first; read it."""

from __future__ import annotations

import ctypes.util
import sys
import zlib
from functools import cache
from typing import Any

LEVEL = 3
"""Of compression: level 6 takes three times as long for a file that is 7 % smaller."""


@cache
def load() -> None:
    """Import the renderer without asking a compiler where its libraries are.

    It tries each library under the names of several systems. For those that the loader does not
    know, Python starts the compiler and the linker: fifty processes, a third of a second. On Linux
    the last name of each is the one that the loader knows, so that nobody need be asked.
    """
    asking = ctypes.util.find_library
    if sys.platform == "linux":
        ctypes.util.find_library = lambda name: None
    try:
        import pydyf
        import weasyprint  # noqa: F401
    finally:
        ctypes.util.find_library = asking
    pydyf.zlib = _Zlib


class _Zlib:
    """What the renderer asks of `zlib`, for which it asks level 9: that takes ten times as long."""

    @staticmethod
    def compressobj(level: int) -> Any:
        return zlib.compressobj(min(level, LEVEL))
