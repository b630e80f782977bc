"""The current step of a command, with the time left."""

from __future__ import annotations

import shutil
import sys
import time
from collections.abc import Sequence
from threading import Event, Thread
from typing import Any

import click

QUIET_SECONDS = 1.0
TIMED_SECONDS = 2.0
_BAR = 20


class Progress:
    """Prints the current step: on a terminal a line with the time left, elsewhere plain lines.

    The line is written again every second. Plain lines start after one second, so that quick
    commands print none.
    """

    def __init__(self, steps: int | Sequence[float] = 0, *, quiet: bool = False) -> None:
        """Begin; `steps` is their number or their typical fractions of the time, 0 if unknown."""
        shares = [1.0] * steps if isinstance(steps, int) else steps
        # Without steps the list is empty: then there is no bar, and no time left.
        self._shares_before = [sum(shares[:n]) / sum(shares) for n in range(len(shares))]
        self._started = time.monotonic()
        self._quiet = quiet
        # Closed, it is None.
        self._terminal = not quiet and sys.stderr is not None and sys.stderr.isatty()
        self._done, self._doing, self._expected_s = 0, "", 0.0
        self._ended = Event()
        # A thread: a step may last a minute without a call, and the seconds are to go on.
        self._rewriting = Thread(target=self._rewrite, daemon=True)

    def __enter__(self) -> Progress:
        if self._terminal:
            self._rewriting.start()
        return self

    def __call__(self, doing: object, done: int | None = None) -> None:
        """Print the current step and the number done, by default one more at each call."""
        seconds = time.monotonic() - self._started
        if self._quiet:
            return
        self._done = self._done if done is None else done
        if self._terminal:
            part = self._part()
            self._expected_s = seconds / part if part else 0.0
            self._doing = str(doing)
            self._show(seconds)
        # A quick command prints none.
        elif seconds > QUIET_SECONDS:
            # To the error output, as the line of a terminal: the output is for files, tables and
            # JSON.
            click.echo(f"[{seconds:4.1f} s] {doing}", err=True)
        self._done += 1

    def _part(self) -> float:
        """Return the fraction done when the current step began."""
        before = self._shares_before
        # More calls than steps, as where a step repeats, leave the bar at its last part.
        return before[min(self._done, len(before) - 1)] if before else 0.0

    def _show(self, seconds: float) -> None:
        # 7 of 10 may be 0.6999.
        filled = int(_BAR * self._part() + 1e-9)
        bar = f"[{'#' * filled}{'.' * (_BAR - filled)}] " if self._shares_before else ""
        remaining = _left(self._expected_s - seconds) if seconds > TIMED_SECONDS else ""
        line = f"{bar}{seconds:4.1f} s{remaining}  {self._doing}"
        # A line that wraps could not be written over.
        _over(line[: shutil.get_terminal_size().columns - 1])

    def _rewrite(self) -> None:
        while not self._ended.wait(1.0):
            if self._doing:
                self._show(time.monotonic() - self._started)

    def __exit__(self, *_: Any) -> None:
        if self._terminal:
            self._ended.set()
            self._rewriting.join()
            _over("")


def _left(seconds: float) -> str:
    if seconds < 1.0:
        return ""
    return f", {seconds:.0f} s left" if seconds < 100.0 else f", {seconds / 60.0:.0f} min left"


def _over(line: str) -> None:
    """Write a line over the current one of the terminal."""
    # It is no color that is asked for: click would take the code off with NO_COLOR.
    click.echo(f"\r\x1b[2K{line}", nl=False, err=True, color=True)
