"""The command line: every command by the module of its options, each loaded on first use.

Only the modules of `report.cli` print and catch. Read `report.cli.one_package` for the steps from
workbook to package.
"""

from __future__ import annotations

import atexit
import gc
import os
import sys
from pathlib import Path
from typing import Any

import click

from report.cli.commands.installation import VARIABLE
from report.cli.console import INPUT_ERROR, INTERRUPTED, color_choice, say
from report.cli.lazy_group import LazyGroup
from report.cli.streams import (
    UntilClosed,
    interrupts,
    say_unwritten,
    set_up_console,
    show_warnings,
)
from report.libraries import stay_apart
from report.text.command_line import called


class _Commands(LazyGroup):
    """The group of all commands; reports if its output cannot be written."""

    def main(self, *arguments: Any, **options: Any) -> Any:
        """Run a command; a full disk under the output ends with a message and exit code 2.

        A closed pipe ends nothing, and Ctrl+C ends with one line and exit code 130.
        """
        # First: it looks at the streams themselves, and `UntilClosed` stands in front of them.
        set_up_console()
        for name in ("stdout", "stderr"):
            stream = getattr(sys, name)
            if stream:  # closed, it is None
                setattr(sys, name, UntilClosed(stream))
        options = {"prog_name": called(), "complete_var": VARIABLE} | options
        try:
            return super().main(*arguments, **options)
        except OSError as error:
            say_unwritten(error)
            sys.exit(INPUT_ERROR)

    def invoke(self, ctx: click.Context) -> Any:
        """Invoke a command that Ctrl+C may interrupt."""
        with interrupts() as received:
            ctx.obj = received  # for a command that goes on after errors
            try:
                return super().invoke(ctx)
            except Exception as error:
                # Compiled code (pydantic's is) may raise an error of its own for the interrupt.
                # A prompt of click turns Ctrl+C into its own Abort, which its `main` would end
                # with code 1.
                if not received and not isinstance(error, click.Abort):
                    raise
            except KeyboardInterrupt:
                pass
        click.echo("Interrupted before the end.", err=True)
        sys.exit(INTERRUPTED)


def _print_version(ctx: click.Context, _: click.Parameter, is_asked: bool) -> None:
    if is_asked and not ctx.resilient_parsing:
        # Imported where it is printed: it reads files, and in a checkout asks git.
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
    settings = os.path.abspath(".numba_config.yaml")
    if os.path.lexists(settings):
        say(
            Path(settings),
            ": this file can make numba, the compiler of the solver, run code from this folder; "
            "delete it, or change to another folder. Use environment variables for numba settings "
            "instead.",
            is_error=True,
        )
        sys.exit(INPUT_ERROR)
    threads = os.environ.get("NUMBA_NUM_THREADS", "1")
    if not threads.isdecimal() or int(threads) == 0:
        fault = f"The environment variable NUMBA_NUM_THREADS is '{threads}'"
        say(f"{fault}; set it to a number of threads, 1 or more, or remove it.", is_error=True)
        sys.exit(INPUT_ERROR)
    stay_apart()


_COMMANDS = "report.cli.commands"
main.add_section(
    "Package",
    f"{_COMMANDS}.project:report",
    f"{_COMMANDS}.project:watch",
    f"{_COMMANDS}.serve:serve",
    f"{_COMMANDS}.project:schema",
)
main.add_section(
    "Workbook", f"{_COMMANDS}.project:new", f"{_COMMANDS}.project:check", f"{_COMMANDS}.plan:plan"
)
main.add_section("Motions", f"{_COMMANDS}.motion:motion", f"{_COMMANDS}.motion:slide")
main.add_section("Studies", f"{_COMMANDS}.study:study")
main.add_section(
    "Trust",
    f"{_COMMANDS}.trust:verify",
    f"{_COMMANDS}.trust:verify_package",
    f"{_COMMANDS}.trust:sign",
)
main.add_section(
    "Installation",
    f"{_COMMANDS}.installation:doctor",
    f"{_COMMANDS}.installation:completion",
    f"{_COMMANDS}.installation:test",
)
