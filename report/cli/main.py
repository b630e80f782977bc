"""The command line: every command by name. Only the modules of this folder print and catch.

Heavy imports stay inside the commands so that `--help` is quick. Exit codes: 0 done, whatever the
verdict; 130 cut off by Ctrl+C; 4 where `verify-package` could not compare all; 3 with --fail-on-ng
where the verdict is not OK; 2 input error; 1 internal error (with the traceback), failed
verification checks, or a package that differs.
Read `report` for the way from workbook to package. `completion`, `schema` and `doctor` are here.
"""

from __future__ import annotations

import atexit
import gc
import json
import os
import re
import sys
from collections.abc import Callable, Iterator
from typing import Any

import click

from report.cli.check import check
from report.cli.motion import motion
from report.cli.options import SectionedGroup
from report.cli.report import new, report, watch
from report.cli.slide import slide
from report.cli.terminal import (
    INPUT_ERROR,
    INTERRUPTED,
    UntilClosed,
    color_choice,
    interrupts,
    plain,
    show_warnings,
    suit_windows,
    unwritten,
)
from report.libraries import stay_apart
from report.text.counts import called

# Set by the script in which the shell asks for completions.
VARIABLE = "_ROOFSLIP_COMPLETE"


@click.command()
@click.argument("shell", type=click.Choice(["bash", "zsh", "fish"]))
def completion(shell: str) -> None:
    """Print the script by which a shell completes commands, options and files.

    In bash: `eval "$(roofslip completion bash)"`, which also completes ./roofslip. In zsh the same
    with zsh, after compinit. In fish: `roofslip completion fish | source`. zsh and fish complete a
    roofslip that is in the PATH.
    """
    from click.shell_completion import get_completion_class

    root = click.get_current_context().find_root().command
    script = get_completion_class(shell)
    assert script is not None  # by the choice of shells
    click.echo(script(root, {}, "roofslip", VARIABLE).source())


@click.command()
@click.option("--quick", is_flag=True, help="The short ones, some of every test file.")
@click.option("--nightly", is_flag=True, help="All, with the coverage of the program.")
@click.option("--golden", is_flag=True, help="Accept what changed in the words of the pages.")
@click.argument("paths", metavar="[PATH]...", nargs=-1)
def test(**_: object) -> None:
    """Run the tests of a checkout, after its linters: all of PATH, else what every day runs.

    What pytest takes may follow. The first call installs what tests need, 1.1 GB.
    """
    raise click.UsageError("tests are run by the launcher of a checkout: ./roofslip test")


@click.command()
def schema() -> None:
    """Print the JSON schema of results.json."""
    from report.results import schema as of_results

    click.echo(json.dumps(of_results.schema(), indent=1))


# Native libraries of the PDF renderer, each with the Debian package that has it.
NATIVE = {"pango-1.0": "libpango-1.0-0", "pangoft2-1.0": "libpangoft2-1.0-0",
          "harfbuzz-subset": "libharfbuzz-subset0", "fontconfig": "libfontconfig1"}  # fmt: skip


@click.command()
def doctor() -> None:
    """Check versions, native libraries, a test run and a test page; list what to install."""
    wrong = []
    for name, look, remedy in _checks():
        try:
            version = look(name) or "missing"
        except Exception as error:  # whatever is wrong here is the finding
            version = f"fails: {'; '.join(str(error).splitlines()[:3]) or repr(error)}"
        click.echo(f"{name:15}  {version}")
        if version.startswith(("missing", "fails")):
            wrong.append(f"{name}: {remedy}")
    if wrong:
        raise click.ClickException("\n".join(wrong))
    click.echo("Everything that a package needs is here.")


def _checks() -> Iterator[tuple[str, Callable[[str], str | None], str]]:
    """Yield each check: a name, what finds it, and what to do where it finds nothing or fails."""
    import platform
    from importlib.metadata import requires
    from importlib.metadata import version as installed

    from report.libraries import library
    from report.provenance.release import version

    yield "Python", lambda _: f"{platform.python_version()}, {platform.platform()}", ""
    yield "cores", lambda _: str(os.cpu_count()), ""
    launcher = os.path.join(".", "roofslip")
    locked = f"install it: {launcher} does so from requirements.lock"
    yield "roofslip", lambda _: version(), locked
    # Extras have a marker after a semicolon: a package needs none of them.
    for requirement in (each for each in requires("roofslip") or () if ";" not in each):
        yield re.split("[<>=!~]", requirement)[0], installed, locked
    for name, package in NATIVE.items():
        debian = f"install it: sudo apt-get install {package}"
        yield name, library, locked if sys.platform == "win32" else debian
    again = f"remove .venv and run {launcher} again; if it stays, report it"
    yield "test run", _slipped, again
    yield "test page", _laid_out, "install what is missing above, or the program again"


def _slipped(_: str) -> str:
    """Run a block whose displacement is known in closed form: mu g (0.8 s)^2 / 6."""
    from solver.sliding.checked import slide

    slipped_m = slide([-0.2, 0.05], 1.0, slope_rad=0.0, mu=0.1, units="g").prd_m
    is_right = abs(slipped_m - 0.1 * 9.80665 * 0.8**2 / 6.0) < 1e-9
    return f"{'' if is_right else 'fails: '}{slipped_m:.9f} m"


def _laid_out(_: str) -> str:
    """Lay out a page in the style of a package."""
    from report.typeset.pdf import TEMPLATES, lay_out

    css = (TEMPLATES / "package.css").read_text(encoding="utf-8")
    page = f"<!DOCTYPE html><html lang='en-US'><title>Test page</title><style>{css}</style></html>"
    return f"{len(lay_out(page)):,} bytes"


class _Commands(SectionedGroup):
    """The group of all commands, which says so where what it prints cannot be written."""

    def main(self, *arguments: Any, **options: Any) -> Any:
        """Run a command; a full disk under the output ends with a message and exit code 2.

        A closed pipe ends nothing, and Ctrl+C ends with one line and exit code 130.
        """
        suit_windows()
        for name in ("stdout", "stderr"):
            if stream := getattr(sys, name):  # closed, it is None
                setattr(sys, name, UntilClosed(stream))
        options = {"prog_name": called(), "complete_var": VARIABLE} | options
        try:
            return super().main(*arguments, **options)
        except OSError as error:
            unwritten(error)
            sys.exit(INPUT_ERROR)

    def invoke(self, ctx: click.Context) -> Any:
        """Invoke a command that Ctrl+C may cut off."""
        with interrupts() as received:
            try:
                return super().invoke(ctx)
            except Exception as error:
                # Compiled code (pydantic's is) may raise an error of its own for the interrupt.
                if not received and not isinstance(error, click.Abort):
                    raise
            except KeyboardInterrupt:
                pass
        click.echo("Interrupted: the work was cut off.", err=True)
        sys.exit(INTERRUPTED)


def _print_version(ctx: click.Context, _: click.Parameter, is_asked: bool) -> None:
    if is_asked and not ctx.resilient_parsing:
        from report.provenance.release import version

        click.echo(f"roofslip, version {version()}")
        ctx.exit()


@click.group(
    cls=_Commands, context_settings={"help_option_names": ["-h", "--help"], "max_content_width": 96}
)
@click.option("--version", is_flag=True, expose_value=False, is_eager=True, callback=_print_version,
              help="Show the version and exit.")  # fmt: skip
def main() -> None:
    """Calculation packages for the seismic sliding of ballasted rooftop solar arrays.

    Start with `roofslip new DIR`, fill in DIR/input.xlsx, then run `roofslip report DIR`.
    """
    show_warnings()
    # Collections search all that is alive and find little: a third of the time of a report.
    gc.set_threshold(100_000, 20, 100)
    atexit.register(gc.freeze)  # the last one as well
    click.get_current_context().color = color_choice()
    try:
        os.getcwd()
    except OSError:
        click.echo("The working folder no longer exists; change to another folder.", err=True)
        sys.exit(INPUT_ERROR)
    if os.path.lexists(settings := os.path.abspath(".numba_config.yaml")):
        click.echo(
            f"{plain(settings)}: this file can make the compiler of the solver run code that came "
            "with it; remove it, or change to another folder. Settings of numba can be given as "
            "environment variables.",
            err=True,
        )
        sys.exit(INPUT_ERROR)
    stay_apart()


# Those of the extras by their place: nothing of the core imports them.
main.add_section("Package", report, watch, "report.cli.serve:serve", schema)
main.add_section("Sheet", new, check, "report.cli.plan:plan")
main.add_section("Motions", motion, slide)
main.add_section("Studies", "report.cli.study:study")
TRUST = (f"report.cli.verify:{name}" for name in ("verify", "verify_package", "sign"))
main.add_section("Trust", *TRUST)
main.add_section("Installation", doctor, completion, test)
