"""What all commands share: input errors and progress.

Prints no text of its own. Heavy imports stay out, so that `--help` is quick. Read `report.cli.main`
next.
"""

from __future__ import annotations

import gc
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager
from functools import cached_property
from pathlib import Path
from typing import Any

import click


class UnitChoice(click.Choice[str]):
    """Units of acceleration of a file; `solver`, slow to import, is imported when they are used."""

    def __init__(self) -> None:
        self.case_sensitive = True

    @cached_property
    def choices(self) -> tuple[str, ...]:  # type: ignore[override]  # it is writable
        """As in `solver.records.units`."""
        from solver.records.units import UNIT_CHOICES

        return UNIT_CHOICES


_QUIET_SECONDS = 1.0


@contextmanager
def input_errors(source: Path) -> Iterator[None]:
    """Print input errors, one problem per line, and exit with code 2."""
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


@contextmanager
def no_collections() -> Iterator[None]:
    """Suspend the cyclic garbage collector: layout keeps about a million objects alive.

    What is left is exempt from later collections, that at the exit of the process included.
    """
    gc.disable()
    try:
        yield
    finally:
        gc.freeze()
        gc.enable()


class Progress:
    """Prints the current step: one updated line on a terminal, plain lines elsewhere.

    Plain lines start after one second, so that quick commands print none.
    """

    def __init__(self) -> None:
        self._started = time.monotonic()
        self._terminal = sys.stderr.isatty()

    def __enter__(self) -> Progress:
        return self

    def __call__(self, doing: str) -> None:
        """Print the current step."""
        seconds = time.monotonic() - self._started
        line = f"[{seconds:4.1f} s] {doing}"
        if self._terminal:
            click.echo(f"\r\x1b[2K{line}", nl=False, err=True)
        elif seconds > _QUIET_SECONDS:
            click.echo(line, err=True)

    def __exit__(self, *_: Any) -> None:
        if self._terminal:
            click.echo("\r\x1b[2K", nl=False, err=True)
