"""The command `roofslip doctor`: what is installed, and what a package needs.

Looks and prints; changes nothing. Heavy imports stay inside the checks: each may fail.
"""

from __future__ import annotations

import os
import platform
import sys
import time
from collections.abc import Iterator
from ctypes.util import find_library
from dataclasses import dataclass
from importlib.metadata import PackageNotFoundError, version

import click

PACKAGES = (
    "numpy", "numba", "pydantic", "openpyxl", "xlsxwriter", "jinja2", "matplotlib", "weasyprint",
    "ziamath", "ezdxf", "click",
)  # fmt: skip

NATIVE = {
    "pango-1.0": "libpango-1.0-0",
    "pangoft2-1.0": "libpangoft2-1.0-0",
    "harfbuzz-subset": "libharfbuzz-subset0",
    "fontconfig": "libfontconfig1",
}
"""Native libraries of the PDF renderer, each with the Debian package that has it."""

LEAST_PYTHON = (3, 11)


@dataclass(frozen=True, slots=True)
class InstallationCheck:
    """What one check found: a name, what it is, and what to do where it is not as needed."""

    name: str
    found: str
    remedy: str = ""


@click.command()
def doctor() -> None:
    """Check the installation: versions, native libraries, fonts, cores, and a test page.

    It exits with 1 and lists what to install if something is missing.
    """
    looks = [look for check in CHECKS for look in check()]
    width = max(len(look.name) for look in looks)
    for look in looks:
        click.echo(f"{look.name:{width}}  {look.found}")
    wrong = [look for look in looks if look.remedy]
    for look in wrong:
        click.echo(f"{look.name}: {look.remedy}", err=True)
    if wrong:
        sys.exit(1)
    click.echo("Everything that a package needs is here.")


def _python() -> Iterator[InstallationCheck]:
    remedy = "" if sys.version_info >= LEAST_PYTHON else "install Python 3.11 or later"
    yield InstallationCheck("Python", f"{platform.python_version()}, {platform.platform()}", remedy)


def _packages() -> Iterator[InstallationCheck]:
    for name in ("roofslip", *PACKAGES):
        try:
            yield InstallationCheck(name, version(name))
        except PackageNotFoundError:
            yield InstallationCheck(
                name, "missing", "install it: ./roofslip does so from requirements.lock"
            )


def _native() -> Iterator[InstallationCheck]:
    """Look for the native libraries as the renderer does, by the names that it loads."""
    for name, package in NATIVE.items():
        path = find_library(name)
        remedy = "" if path else f"install it: sudo apt-get install {package}"
        yield InstallationCheck(name, path or "missing", remedy)


def _fonts() -> Iterator[InstallationCheck]:
    from report.typeset.pdf import TEMPLATES

    fonts = sorted(path.stem for path in (TEMPLATES / "fonts").glob("*.[ot]tf"))
    remedy = "" if fonts else f"restore {TEMPLATES / 'fonts'} from the distribution"
    yield InstallationCheck(
        "fonts", f"{len(fonts)} with the program" if fonts else "missing", remedy
    )


def _cores() -> Iterator[InstallationCheck]:
    count = len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count()
    yield InstallationCheck("cores", str(count))


_MU, _G_MPS2, _END_S = 0.1, 9.80665, 1.0
# The push falls linearly from 2 mu g to -mu g / 2: with u'' = push - mu g, the block starts at
# once, stops after 0.8 s, and stays.
_PUSHED_M = _MU * _G_MPS2 * (0.8 * _END_S) ** 2 / 6.0


def _solver_run() -> tuple[str, str]:
    """Run one block for which the displacement is known in closed form."""
    import numpy as np

    from solver import scene, solve

    accelerations = _MU * _G_MPS2 * np.array([-2.0, 0.5])
    displacement_m = solve(scene(accelerations, _END_S, slope_rad=0.0, mu=_MU)).result.prd_m
    is_right = abs(displacement_m - _PUSHED_M) < 1e-9
    remedy = "" if is_right else "the solver is wrong on this computer; report it"
    return f"{displacement_m:.9f} m", remedy


def _page() -> tuple[str, str]:
    """Lay out a page in the style of a package."""
    from report.typeset.pdf import TEMPLATES, lay_out

    style = (TEMPLATES / "package.css").read_text(encoding="utf-8")
    return f"{len(lay_out(_PAGE.format(style=style))):,} bytes", ""


_PAGE = (
    "<!DOCTYPE html><html lang='en-US'><head><title>Test page</title><style>{style}</style></head>"
    "<body><p>Test page</p></body></html>"
)


_TRIED = (
    ("test run", _solver_run, "reinstall: remove .venv and run ./roofslip again"),
    ("test page", _page, "install what is missing above, then try again"),
)


def _tries() -> Iterator[InstallationCheck]:
    """Run a block and lay out a page."""
    for name, run, remedy in _TRIED:
        started = time.perf_counter()
        try:
            found, wrong = run()
        except Exception as error:  # whatever is wrong here is the finding
            found = "; ".join(str(error).strip().splitlines()[:3]) or repr(error)
            yield InstallationCheck(name, f"fails: {found}", remedy)
        else:
            seconds = time.perf_counter() - started
            yield InstallationCheck(name, f"{found} in {seconds:.1f} s", wrong)


CHECKS = (_python, _packages, _native, _fonts, _cores, _tries)
