"""Where the native libraries of the PDF renderer are: on Windows in a package, else in the system.

Read `library` and `load_renderer`.
"""

from __future__ import annotations

import ctypes.util
import os
import sys
from pathlib import Path

_FONTCONFIG = """
    typedef struct { int count; int room; void **fonts; } FcFontSet;
    void *FcNameParse(const char *name);
    void *FcObjectSetCreate(void);
    FcFontSet *FcFontList(void *config, void *pattern, void *objects);
"""


def library(name: str) -> str | None:
    """Return the path or name of a library, by its name without prefix, number and ending."""
    if sys.platform == "win32":
        return next((str(path) for path in _shipped().glob(f"bin/{name}*.dll")), None)
    return ctypes.util.find_library(name)


def load_renderer() -> None:
    """Import the renderer; on Windows with the libraries of the package, whatever else is there."""
    if sys.platform == "win32":
        folder, usual = str(_shipped() / "bin"), os.environ["PATH"]
        os.environ["WEASYPRINT_DLL_DIRECTORIES"] = folder  # where they find each other
        os.environ.setdefault("FONTCONFIG_PATH", str(_shipped() / "etc" / "fonts"))
        os.environ["PATH"] = folder  # where the renderer finds them
        try:
            import weasyprint
        finally:
            os.environ["PATH"] = usual
    elif sys.platform == "linux":
        # Of the names that the renderer tries, the loader knows one; for each of the others a
        # compiler would be started, which takes longer than all other imports of the renderer.
        asked, ctypes.util.find_library = ctypes.util.find_library, lambda name: None
        try:
            import weasyprint  # noqa: F401
        finally:
            ctypes.util.find_library = asked


def has_font_on_windows(letter: str) -> bool:
    """Whether fontconfig knows a font with a letter; Windows has no `fc-list` to ask."""
    from cffi import FFI

    load_renderer()
    ffi = FFI()
    ffi.cdef(_FONTCONFIG)
    fontconfig = ffi.dlopen(library("fontconfig"))
    wanted = fontconfig.FcNameParse(f":charset={ord(letter):x}".encode())
    return bool(fontconfig.FcFontList(ffi.NULL, wanted, fontconfig.FcObjectSetCreate()).count)


def _shipped() -> Path:
    import gstreamer_libs

    return Path(gstreamer_libs.__file__).parent
