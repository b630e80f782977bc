"""Checks that everything a package needs is installed, and states what to install.

Imports each library only when it is checked, because a failed import is a finding.
"""

from __future__ import annotations

import os
import platform
import re
import sys
from collections.abc import Callable, Iterator
from functools import partial
from importlib.metadata import requires
from importlib.metadata import version as installed_version

import click

from report.libraries import library
from report.provenance.release import version

# Native libraries of the PDF renderer, each with the Debian package that has it.
NATIVE = {"pango-1.0": "libpango-1.0-0", "pangoft2-1.0": "libpangoft2-1.0-0",
          "harfbuzz-subset": "libharfbuzz-subset0", "fontconfig": "libfontconfig1"}  # fmt: skip


def check_installation() -> None:
    """Print a line for each part; raise `ClickException` with what to install."""
    remedies = []
    for name, find, remedy in _checks():
        try:
            result = find() or "missing"
        except Exception as error:  # whatever is wrong here is the finding
            result = f"fails: {'; '.join(str(error).splitlines()[:3]) or repr(error)}"
        click.echo(f"{name:15}  {result}")
        if result.startswith(("missing", "fails")):
            remedies.append(f"{name}: {remedy}")
    if remedies:
        raise click.ClickException("\n".join(remedies))
    click.echo("Everything needed to create a package is installed.")


def _checks() -> Iterator[tuple[str, Callable[[], str | None], str]]:
    """Yield each check: a name, a function that performs it, and the remedy if it fails."""
    yield "Python", _python_and_system, ""
    yield "cores", partial(str, os.cpu_count()), ""
    launcher = os.path.join(".", "roofslip")
    locked = f"run {launcher}, which installs it from requirements.lock"
    yield "roofslip", version, locked
    # Extras have a marker after a semicolon: a package needs none of them.
    for requirement in requires("roofslip") or ():
        if ";" not in requirement:
            name = re.split("[<>=!~]", requirement)[0]
            yield name, partial(installed_version, name), locked
    for name, package in NATIVE.items():
        debian = f"install it: sudo apt-get install {package}"
        yield name, partial(library, name), locked if sys.platform == "win32" else debian
    again = f"delete .venv and run {launcher} again; if the error persists, report it"
    yield "test run", _test_run, again
    yield (
        "test page",
        _test_page,
        "install what is missing above, or reinstall the program",
    )


def _python_and_system() -> str:
    return f"{platform.python_version()}, {platform.platform()}"


def _test_run() -> str:
    """Run a block whose displacement is known in closed form: mu g (0.8 s)^2 / 6."""
    from solver.sliding.checked import slide

    # A line from -0.2 g to 0.05 g in 1 s. The block slides from the first sample, since 0.2 > mu;
    # its relative velocity (0.1 t - 0.125 t^2) g is 0 again at 0.8 s, where 0 g is less than mu.
    prd_m = slide([-0.2, 0.05], 1.0, slope_rad=0.0, mu=0.1, units="g").prd_m
    is_right = abs(prd_m - 0.1 * 9.80665 * 0.8**2 / 6.0) < 1e-9
    return f"{'' if is_right else 'fails: '}{prd_m:.9f} m"


def _test_page() -> str:
    """Lay out a page in the style of a package."""
    from report.typeset.pdf import TEMPLATES, lay_out

    css = (TEMPLATES / "package.css").read_text(encoding="utf-8")
    page = f"<!DOCTYPE html><html lang='en-US'><title>Test page</title><style>{css}</style></html>"
    return f"{len(lay_out(page)):,} bytes"
