"""What all commands share: input errors, progress, verdicts and levels in color.

Prints no text of its own. Heavy imports stay out, so that `--help` is quick. Read `report.cli.main`
next.
"""

from __future__ import annotations

import datetime as dt
import json
import os
import re
import shutil
import signal
import sys
import tempfile
import time
import warnings
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager, suppress
from io import TextIOWrapper
from pathlib import Path
from threading import Event, Thread
from typing import TYPE_CHECKING, Any, NoReturn, TextIO

import click

from report.text.counts import as_typed, command, numbered

if TYPE_CHECKING:
    from types import FrameType

    from solver.model import Problem


_GREEN, _RED, _YELLOW = ({"fg": color, "bold": True} for color in ("green", "red", "yellow"))
_STYLES: Mapping[str, Mapping[str, Any]] = {
    "OK with conditions": _YELLOW,
    "OK": _GREEN,
    "PASS": _GREEN,
    "NG": _RED,
    "FAIL": _RED,
    "Condition": _YELLOW,
}
_LEVELS: Mapping[str, Mapping[str, Any]] = {  # at the beginning of a line
    "condition": _YELLOW,
    "warning": {"fg": "yellow"},
    "note": {"dim": True},
}
_ALL = {**_STYLES, **_LEVELS}
_WORD = re.compile(rf"\b(?:{'|'.join(_STYLES)})\b|^(?:{'|'.join(_LEVELS)})(?=: )")


def colored(line: str) -> str:
    """Return a line with its verdicts, and the level it begins with, in color."""
    # `click.echo` takes the codes off where no terminal reads.
    return _WORD.sub(lambda word: click.style(word[0], **_ALL[word[0]]), line)


def color_choice() -> bool | None:
    """Return whether to color: not with NO_COLOR or where the terminal has none; else by click."""
    # NO_COLOR counts if it is not empty (no-color.org).
    return False if os.environ.get("NO_COLOR") or os.environ.get("TERM") == "dumb" else None


SOURCE = click.Path(path_type=Path)


# Of acceleration, of a file: `solver.records.record.UNIT_CHOICES`, which is slow to import.
UNITS = click.Choice(("g", "m/s2", "cm/s2", "mm/s2", "gal"))

QUIET_SECONDS = 1.0
TIMED_SECONDS = 2.0
_BAR = 20
_LONGEST = 2000

# Control characters, and those that separate lines or change the direction of a text.
_UNSAFE = re.compile(r"[\x00-\x1f\x7f-\x9f\u200e\u200f\u2028-\u202e\u2066-\u2069\ud800-\udfff]")


def plain(text: object) -> str:
    """Return a text as a terminal may show it: without control characters, and not too long."""
    line = _UNSAFE.sub("?", str(text))
    return line if len(line) <= _LONGEST else f"{line[:_LONGEST]}..."


def say(line: str) -> None:
    """Print a line of words: verdicts in color, and commands as the reader calls them."""
    click.echo(colored(as_typed(plain(line))))


# Raised where a key that `--json` prints changes its name or meaning.
SCHEMA_VERSION = 1

# Exit codes: an error of the program; a package differs; an error in the input; not OK where that
# is asked for; not all could be compared; cut off by Ctrl+C, which shells write as 128 + signal 2.
INTERNAL_ERROR, DIFFERS, INPUT_ERROR, NOT_OK, NOT_COMPARED, INTERRUPTED = 1, 1, 2, 3, 4, 130

QUIET = click.option("--quiet", is_flag=True, help="Print errors only.")
AS_JSON = click.option(
    "--json", "as_json", is_flag=True, help="Print JSON, with the units in the keys."
)
FAIL_ON_NG = click.option(
    "--fail-on-ng", is_flag=True, help=f"Exit with code {NOT_OK} where the verdict is not OK."
)


@contextmanager
def interrupts() -> Iterator[list[int]]:
    """Give a list that grows with each Ctrl+C, which is still raised as KeyboardInterrupt."""
    received: list[int] = []

    def note(number: int, frame: FrameType | None) -> None:
        received.append(number)
        signal.default_int_handler(number, frame)

    # As under nohup, or within a program that calls this one.
    if signal.getsignal(signal.SIGINT) is not signal.default_int_handler:
        yield received
        return
    signal.signal(signal.SIGINT, note)
    try:
        yield received
    finally:
        signal.signal(signal.SIGINT, signal.default_int_handler)


@contextmanager
def input_errors(
    source: Path, *, as_json: bool = False, outputs: Sequence[Path] = ()
) -> Iterator[None]:
    """Print input errors, one problem per line or as JSON, and exit with code 2.

    So with what the system refuses, such as a file without permission or a folder that is gone.
    Outputs of an earlier run that are there are named.
    """
    try:
        yield
    # Nobody reads any more: no error of the input, and nothing to print it to.
    except BrokenPipeError:
        raise
    except OSError as error:
        _refuse(source, [system_problem(error)], outputs, as_json=as_json)
    except Exception as error:
        from solver.model import InputError

        if not isinstance(error, InputError):
            raise
        _refuse(source, error.parts, outputs, as_json=as_json)


def _refuse(
    source: Path, problems: Sequence[Problem], outputs: Sequence[Path], *, as_json: bool
) -> NoReturn:
    if as_json:
        print_json(document(source, problems))
    else:
        say_problems(source, problems)
    say_former(outputs)
    sys.exit(INPUT_ERROR)


def workbook_of(source: Path) -> Path:
    """Return the workbook that a command is given, by itself or by its folder."""
    # Unlike `Path.is_dir`, it raises nothing where a name is too long.
    return source / "input.xlsx" if os.path.isdir(source) else source


def outputs_of(source: Path, out: Path | None) -> tuple[Path, ...]:
    """Return where the package and the tables of a workbook are written."""
    from report.making import OUTPUTS

    folder = out or workbook_of(source).parent / "out"
    return tuple(folder / name for name in OUTPUTS)


def warn_of_others(new: Path) -> None:
    """Warn of packages beside a new one that are of another input."""
    if others := sorted(path for path in new.parent.glob("*.pdf") if path.name != new.name):
        # It takes most of a second to import.
        from report.proof.package import warn_of_other_input

        warn_of_other_input(new, others)


def say_former(outputs: Sequence[Path]) -> None:
    """Say which outputs are there from an earlier run, after one that has not replaced them."""
    # Files of an earlier run look like those of this one, which has none.
    there = [path for path in outputs if os.path.isfile(path)]
    if there:
        last = dt.datetime.fromtimestamp(max(path.stat().st_mtime for path in there))
        which = f" and {len(there) - 1} more are" if len(there) > 1 else " is"
        when = f"of an earlier run, {last:%Y-%m-%d %H:%M}, and not replaced"
        click.echo(plain(f"{there[0]}{which} {when}"), err=True)


def document(source: Path, problems: Sequence[Problem] = ()) -> dict[str, Any]:
    """Return what every document about a workbook has: which one it is, and its errors."""
    return {
        "schema_version": SCHEMA_VERSION,
        "workbook": str(source),
        "errors": [str(each) for each in problems],
    }


def print_json(document: Any) -> None:
    """Print a document."""
    click.echo(json.dumps(document, ensure_ascii=False))


def say_problems(source: Path, problems: Sequence[Problem]) -> None:
    """Print the problems of an input, one per line; those of several cells once."""
    from report.project.check.problem_lines import grouped, line_of

    click.echo(f"{plain(source)}: {numbered(len(problems), 'problem')} found.", err=True)
    for equal in grouped(problems):
        click.echo(f"  {as_typed(plain(line_of(equal)))}", err=True)


def say_next(project: Path, has_formulas: bool) -> None:
    """Say what comes after cells of a workbook were filled in."""
    click.echo(f"Next: {command('check', project)}")
    if has_formulas:
        click.echo("Formulas that refer to it have no value until Excel or LibreOffice saves it.")


def system_problem(error: OSError) -> Problem:
    """Return what the system refuses, as a problem of an input."""
    from solver.model import Problem

    reason = error.strerror or error
    if not error.filename:
        return Problem(
            f"a file cannot be written or read ({reason})",
            f"free disk space, also for temporary files{_place()}, or raise the limit on the size "
            "of files",
        )
    return Problem(
        f"{error.filename}: the system refuses it ({reason})",
        "correct the path, its rights or the space on its disk",
    )


def _place() -> str:
    """Return where temporary files are, if there is such a place."""
    try:
        return f" in {tempfile.gettempdir()}"
    except OSError:
        return ""


def unwritten(error: OSError) -> None:
    """Say that the output or the error output cannot be written, as far as that can be said."""
    with suppress(OSError):
        click.echo(f"The output cannot be written ({error.strerror or error}).", err=True)
    # What is still in the buffers would fail again as the process ends.
    sys.stdout = sys.stderr = open(os.devnull, "w")  # noqa: SIM115  # until the process ends


class UntilClosed:
    """An output whose reader may leave: the rest is dropped, and the work goes on."""

    def __init__(self, stream: TextIO) -> None:
        self._stream = stream

    def __getattr__(self, name: str) -> Any:
        return getattr(self._stream, name)

    def write(self, text: str) -> int:
        """Write a text, if anyone reads it."""
        try:
            return self._stream.write(text)
        except BrokenPipeError:
            self._drop()
            return len(text)

    def flush(self) -> None:
        """Write what is in the buffer, if anyone reads it."""
        try:
            self._stream.flush()
        except BrokenPipeError:
            self._drop()

    def _drop(self) -> None:
        # The buffer still has the text; it would fail again as the process ends.
        nowhere = os.open(os.devnull, os.O_WRONLY)
        os.dup2(nowhere, self._stream.fileno())
        os.close(nowhere)


def suit_windows() -> None:
    """On Windows, have pipes take UTF-8 rather than its code page, and terminals their codes."""
    if sys.platform == "win32":
        from ctypes import windll

        for stream, handle in ((sys.stdout, -11), (sys.stderr, -12)):
            if isinstance(stream, TextIOWrapper) and not stream.isatty():
                stream.reconfigure(encoding="utf-8")
            elif stream is not None:
                windll.kernel32.SetConsoleMode(windll.kernel32.GetStdHandle(handle), 7)


def show_warnings() -> None:
    """Print warnings to the user as one line; those to developers stay as they are."""
    usual = warnings.showwarning

    def shown(message: Warning | str, category: type[Warning], *place: Any, **more: Any) -> None:
        if category is UserWarning:
            click.echo(f"warning: {plain(message)}", err=True)
        else:
            usual(message, category, *place, **more)

    warnings.showwarning = shown


class Progress:
    """Prints the current step: on a terminal a line with the time left, elsewhere plain lines.

    The line is written again every second. Plain lines start after one second, so that quick
    commands print none.
    """

    def __init__(self, steps: int | Sequence[float] = 0, *, quiet: bool = False) -> None:
        """Begin; `steps` is their number or their usual shares of the time, 0 if not known."""
        shares = [1.0] * steps if isinstance(steps, int) else steps
        self._shares_before = [sum(shares[:n]) / sum(shares) for n in range(len(shares))]
        self._started = time.monotonic()
        self._quiet = quiet
        # Closed, it is None.
        self._terminal = not quiet and sys.stderr is not None and sys.stderr.isatty()
        self._done, self._doing, self._expected_s = 0, "", 0.0
        self._ended = Event()
        self._rewriting = Thread(target=self._rewrite, daemon=True)

    def __enter__(self) -> Progress:
        if self._terminal:
            self._rewriting.start()
        return self

    def __call__(self, doing: object, done: int | None = None) -> None:
        """Print the current step, and that so many are done: one more at each call if not given."""
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
            click.echo(f"[{seconds:4.1f} s] {doing}", err=True)
        self._done += 1

    def _part(self) -> float:
        """Return how much was done when the current step began."""
        before = self._shares_before
        return before[min(self._done, len(before) - 1)] if before else 0.0

    def _show(self, seconds: float) -> None:
        # 7 of 10 may be 0.6999.
        filled = int(_BAR * self._part() + 1e-9)
        bar = f"[{'#' * filled}{'.' * (_BAR - filled)}] " if self._shares_before else ""
        left = _left(self._expected_s - seconds) if seconds > TIMED_SECONDS else ""
        line = f"{bar}{seconds:4.1f} s{left}  {self._doing}"
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
