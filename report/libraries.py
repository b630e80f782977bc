"""Libraries and workers take nothing from the current folder, which may be a stranger's.

For commands and their workers: a Python session trusts its folder, from which Python imports. What
numba reads is in `report.cli.main` and `solver.kernels.compiler`. Read `stay_apart`.

Where the native libraries of the PDF renderer are: on Windows in a package, else in the system.
"""

from __future__ import annotations

import os
import sys
from collections.abc import Iterator
from contextlib import chdir, contextmanager
from importlib.machinery import ModuleSpec, PathFinder
from pathlib import Path
from threading import RLock

_READ_IT = ("ezdxf", "matplotlib")
"""Libraries that read settings from the current folder as they are loaded."""
_ONE_AT_A_TIME = RLock()


@contextmanager
def apart() -> Iterator[None]:
    """Do something in the folder of the installation; a relative path means another file there."""
    with _ONE_AT_A_TIME, chdir(sys.prefix):
        yield


def stay_apart() -> None:
    """Have libraries loaded apart from the current folder, from now on."""
    if _Apart not in sys.meta_path:
        sys.meta_path.insert(0, _Apart)


class _Apart:
    @staticmethod
    def find_spec(name: str, _: object, __: object = None) -> ModuleSpec | None:
        spec = PathFinder.find_spec(name) if name in _READ_IT else None
        if spec and spec.loader:  # one of this library alone
            spec.loader.exec_module = apart()(spec.loader.exec_module)  # type: ignore[method-assign]
        return spec


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
    from ctypes.util import find_library  # of `doctor` alone: `--help` imports this module

    return find_library(name)


def load_renderer() -> None:
    """Import the renderer; on Windows with the libraries of the package, whatever else is there.

    Here, and at the top of no module: what it loads depends on what is set before.
    """
    if sys.platform == "win32":
        folder, usual = str(_shipped() / "bin"), os.environ["PATH"]
        os.environ["WEASYPRINT_DLL_DIRECTORIES"] = folder  # where they find each other
        os.environ.setdefault("FONTCONFIG_PATH", str(_shipped() / "etc" / "fonts"))
        os.environ["PATH"] = folder  # where the renderer finds them
        try:
            import weasyprint
        finally:
            os.environ["PATH"] = usual
    else:
        import weasyprint  # noqa: F401


def has_font_on_windows(letter: str) -> bool:
    """Whether fontconfig knows a font with a letter; Windows has no `fc-list` to ask."""
    from cffi import FFI  # installed with the renderer, and asked on Windows alone

    load_renderer()
    ffi = FFI()
    ffi.cdef(_FONTCONFIG)
    fontconfig = ffi.dlopen(library("fontconfig"))
    pattern = fontconfig.FcNameParse(f":charset={ord(letter):x}".encode())
    return bool(fontconfig.FcFontList(ffi.NULL, pattern, fontconfig.FcObjectSetCreate()).count)


def _shipped() -> Path:
    import gstreamer_libs  # a package of Windows

    return Path(gstreamer_libs.__file__).parent
