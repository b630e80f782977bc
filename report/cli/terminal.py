"""What every command does alike: errors that a user can fix, and progress.

Says nothing of its own. Heavy imports stay out, so that `--help` is quick. Read `report.cli.main`
next.
"""

from __future__ import annotations

import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import click

UNITS = ("g", "m/s2", "cm/s2", "mm/s2", "gal")
"""Those of `solver.formats.UNIT_CHOICES`, which takes too long to import for `--help`."""

_QUIET_SECONDS = 1.0


@contextmanager
def input_errors(source: Path) -> Iterator[None]:
    """Print what the user can fix, each problem on its line, and exit 2."""
    try:
        yield
    except Exception as error:
        from solver.model import InputError

        if not isinstance(error, InputError):
            raise
        count = len(error.problems)
        click.echo(f"{source}: {count} problem{'s' if count > 1 else ''} found.", err=True)
        for problem in error.problems:
            click.echo(f"  {problem}", err=True)
        sys.exit(2)


class Progress:
    """Says what is being done: one changing line on a terminal, plain lines elsewhere.

    Silent for the first second, so that quick work says nothing.
    """

    def __init__(self) -> None:
        self._started = time.monotonic()
        self._terminal = sys.stderr.isatty()

    def __enter__(self) -> Progress:
        return self

    def __call__(self, doing: str) -> None:
        """Say what is being done."""
        seconds = time.monotonic() - self._started
        line = f"[{seconds:4.1f} s] {doing}"
        if self._terminal:
            click.echo(f"\r\x1b[2K{line}", nl=False, err=True)
        elif seconds > _QUIET_SECONDS:
            click.echo(line, err=True)

    def __exit__(self, *_: Any) -> None:
        if self._terminal:
            click.echo("\r\x1b[2K", nl=False, err=True)
