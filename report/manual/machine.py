"""Machine and software versions of a verification."""

from __future__ import annotations

import os
import platform
from importlib import metadata
from pathlib import Path

_LIBRARIES = ("numpy", "numba", "llvmlite", "scipy", "pandas", "matplotlib", "jinja2", "weasyprint")
_CPU_INFO = Path("/proc/cpuinfo")


def this_machine() -> dict[str, str]:
    """Return labels with versions or descriptions, without names of persons, hosts or paths."""
    return {
        "Roofslip": metadata.version("roofslip"),
        "Python": platform.python_version(),
        **{name: installed(name) for name in _LIBRARIES},
        "Processor": processor(),
        "Cores": str(os.cpu_count() or 1),
        "System": f"{platform.system()} {platform.release()}, {platform.machine()}",
    }


def installed(library: str) -> str:
    """Return the version of a library, or that it is not installed."""
    try:
        return metadata.version(library)
    except metadata.PackageNotFoundError:
        return "not installed"


def processor() -> str:
    """Return the processor's model name, if the system reports it."""
    try:
        lines = _CPU_INFO.read_text(encoding="utf-8").splitlines()
    except OSError:
        lines = []
    names = [line.partition(":")[2].strip() for line in lines if line.startswith("model name")]
    return names[0] if names else platform.processor() or platform.machine()
