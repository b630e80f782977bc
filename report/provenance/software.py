"""The software that computes a package: the parts whose versions matter to numbers and pages."""

from __future__ import annotations

import platform
from collections.abc import Mapping
from contextlib import suppress
from functools import cache
from importlib import metadata

_LIBRARIES = (
    "numpy",
    "numba",
    "llvmlite",
    "pandas",
    "openpyxl",
    "lxml",
    "matplotlib",
    "weasyprint",
    "pydyf",
    "fonttools",
)


@cache
def versions() -> Mapping[str, str]:
    """Return the versions that a package prints, by name, without what is not installed."""
    found = {"roofslip": metadata.version("roofslip"), "python": platform.python_version()}
    for name in _LIBRARIES:
        with suppress(metadata.PackageNotFoundError):
            found[name] = metadata.version(name)
    return found


def environment() -> Mapping[str, str]:
    """Return the versions, and the system and processor."""
    system = f"{platform.system()} {platform.machine()} {' '.join(platform.libc_ver())}"
    return {**versions(), "system": system.strip()}
