"""The command `roofslip doctor`: what is installed, and what a package needs; changes nothing."""

import os
import platform
import sys
from collections.abc import Callable, Iterator
from importlib.metadata import requires, version

import click

from report.typeset.native import library

NATIVE = {"pango-1.0": "libpango-1.0-0", "pangoft2-1.0": "libpangoft2-1.0-0",
          "harfbuzz-subset": "libharfbuzz-subset0", "fontconfig": "libfontconfig1"}  # fmt: skip
"""Native libraries of the PDF renderer, each with the Debian package that has it."""


@click.command()
def doctor() -> None:
    """Check versions, native libraries, a test run and a test page; list what to install."""
    wrong = []
    for name, look, remedy in _checks():
        try:
            found = look(name) or "missing"
        except Exception as error:  # whatever is wrong here is the finding
            found = f"fails: {'; '.join(str(error).splitlines()[:3]) or repr(error)}"
        click.echo(f"{name:15}  {found}")
        if found.startswith(("missing", "fails")):
            wrong.append(f"{name}: {remedy}")
    if wrong:
        raise click.ClickException("\n".join(wrong))
    click.echo("Everything that a package needs is here.")


def _checks() -> Iterator[tuple[str, Callable[[str], str | None], str]]:
    """Yield each check: a name, what finds it, and what to do where it finds nothing or fails."""
    yield "Python", lambda _: f"{platform.python_version()}, {platform.platform()}", ""
    yield "cores", lambda _: str(os.cpu_count()), ""
    launcher = os.path.join(".", "roofslip")
    locked = f"install it: {launcher} does so from requirements.lock"
    for name in ("roofslip", *(each for each in requires("roofslip") or () if ";" not in each)):
        yield name, version, locked
    for name, package in NATIVE.items():
        debian = f"install it: sudo apt-get install {package}"
        yield name, library, locked if sys.platform == "win32" else debian
    again = f"remove .venv and run {launcher} again; if it stays, report it"
    yield "test run", _slipped, again
    yield "test page", _laid_out, "install what is missing above, or the program again"


def _slipped(_: str) -> str:
    """Run a block whose displacement is known in closed form: mu g (0.8 s)^2 / 6."""
    from solver import slide

    slipped_m = slide([-0.2, 0.05], 1.0, slope_rad=0.0, mu=0.1, units="g").prd_m
    is_right = abs(slipped_m - 0.1 * 9.80665 * 0.8**2 / 6.0) < 1e-9
    return f"{'' if is_right else 'fails: '}{slipped_m:.9f} m"


def _laid_out(_: str) -> str:
    """Lay out a page in the style of a package."""
    from report.typeset.pdf import TEMPLATES, lay_out

    css = (TEMPLATES / "package.css").read_text(encoding="utf-8")
    page = f"<!DOCTYPE html><html lang='en-US'><title>Test page</title><style>{css}</style></html>"
    return f"{len(lay_out(page)):,} bytes"
