"""The command line: every command by name. Only the modules of this folder print and catch.

Heavy imports stay inside the commands so that `--help` is quick. Exit codes: 0 done, whatever the
verdict; 130 cut off by Ctrl+C; 4 where `verify-package` could not compare all; 3 with --fail-on-ng
where the verdict is not OK; 2 input error; 1 internal error (with the traceback), failed
verification checks, or a package that differs.
Read `report` for the way from workbook to package.
"""

from __future__ import annotations

import os
import sys
from typing import Any

import click

from report.cli.check import check
from report.cli.colors import color_choice
from report.cli.completion import VARIABLE, completion
from report.cli.doctor import doctor
from report.cli.groups import SectionedGroup
from report.cli.motion import motion
from report.cli.plan import plan
from report.cli.report import new, report
from report.cli.schema import schema
from report.cli.serve import serve
from report.cli.sign import sign
from report.cli.slide import slide
from report.cli.study import study
from report.cli.terminal import (
    INPUT_ERROR,
    INTERRUPTED,
    UntilClosed,
    interrupts,
    plain,
    show_warnings,
    suit_windows,
    unwritten,
)
from report.cli.verify import verify
from report.cli.verify_package import verify_package
from report.cli.watch import watch
from report.elsewhere import stay_apart
from report.words.command import as_typed, called

_FORMER = {
    "batch": "Give its projects to roofslip report.",
    "sbom": "Each package lists the versions of the software that matters on its page Records and "
    "software and in its attachment roofslip.json.",
    "check --repair": "Nothing is read from the formulas of the workbook. Where one was typed "
    "over, copy it from a fresh workbook (roofslip new FOLDER).",
    "watch --once": "Run roofslip report in its place.",
}
"""What replaces a command or an option, for one version after it was removed."""


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

    def get_command(self, ctx: click.Context, name: str) -> click.Command | None:
        """Return a command by its name; for one version, what replaces a former one is said."""
        _replaced(name, ctx)
        return super().get_command(ctx, name)

    def invoke(self, ctx: click.Context) -> Any:
        """Invoke a command that Ctrl+C may cut off."""
        with interrupts() as received:
            try:
                return super().invoke(ctx)
            except click.NoSuchOption as error:
                _replaced(f"{ctx.invoked_subcommand} {error.option_name}", ctx)
                raise
            except Exception as error:
                # Compiled code (pydantic's is) may raise an error of its own for the interrupt.
                if not received and not isinstance(error, click.Abort):
                    raise
            except KeyboardInterrupt:
                pass
        click.echo("Interrupted: the work was cut off.", err=True)
        sys.exit(INTERRUPTED)


def _replaced(former: str, ctx: click.Context) -> None:
    """Refuse a command or an option that was removed, with what replaces it."""
    if former in _FORMER:
        raise click.UsageError(as_typed(f"'{former}' was removed. {_FORMER[former]}"), ctx)


@click.group(
    cls=_Commands, context_settings={"help_option_names": ["-h", "--help"], "max_content_width": 96}
)
@click.version_option(package_name="roofslip", prog_name="roofslip")
def main() -> None:
    """Calculation packages for the seismic sliding of ballasted rooftop solar arrays.

    Start with `roofslip new DIR`, fill in DIR/input.xlsx, then run `roofslip report DIR`.
    """
    show_warnings()
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


main.add_section("Package", report, watch, serve, schema)
main.add_section("Sheet", new, check, plan)
main.add_section("Motions", motion, slide)
main.add_section("Studies", study)
main.add_section("Trust", verify, verify_package, sign)
main.add_section("Installation", doctor, completion)
