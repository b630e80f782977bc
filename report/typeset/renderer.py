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
    _keep_lines()


def _keep_lines() -> None:
    """Have the renderer keep each line of text from its layout until it is painted.

    It frees the line and sets it again, which takes a twelfth of the time.
    """
    from weasyprint.text.line_break import Layout

    again = Layout.reactivate

    def reactivate(self: Any, style: Any) -> None:
        if self.justification_spacing:  # the line is painted with other spaces
            again(self, style)

    Layout.reactivate, Layout.deactivate = reactivate, lambda self: None


class _Zlib:
    """What the renderer asks of `zlib`, for which it asks level 9: that takes ten times as long."""

    @staticmethod
    def compressobj(level: int) -> Any:
        return zlib.compressobj(min(level, LEVEL))
