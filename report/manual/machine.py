"""Machine and software versions of a verification."""

from __future__ import annotations

import os
import platform
from dataclasses import dataclass
from importlib import metadata
from pathlib import Path

_LIBRARIES = ("numpy", "numba", "llvmlite", "scipy", "pandas", "matplotlib", "jinja2", "weasyprint")
_CPU_INFO = Path("/proc/cpuinfo")


@dataclass(frozen=True, slots=True)
class Machine:
    """Labels and versions or descriptions, the program first."""

    rows: tuple[tuple[str, str], ...]

    @property
    def line(self) -> str:
        """Processor, cores and system in one line."""
        values = dict(self.rows)
        return f"{values['Processor']}, {values['Cores']} cores, {values['System']}"


def this_machine() -> Machine:
    """Return this machine, without names of persons, hosts or paths."""
    return Machine(
        (
            ("Roofslip", metadata.version("roofslip")),
            ("Python", platform.python_version()),
            *((name, _version(name)) for name in _LIBRARIES),
            ("Processor", processor()),
            ("Cores", str(os.cpu_count() or 1)),
            ("System", f"{platform.system()} {platform.release()}, {platform.machine()}"),
        )
    )


def _version(library: str) -> str:
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
