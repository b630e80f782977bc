"""Loads the renderer, quickly. Its three neighbors import it from here first; read `load`."""

from __future__ import annotations

import ctypes.util
import sys
from functools import cache


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
        import weasyprint  # noqa: F401
    finally:
        ctypes.util.find_library = asking
