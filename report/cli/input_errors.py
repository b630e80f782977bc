"""Printing of input errors by a command: one problem per line, or JSON.

    with input_errors(source):
        sheet = read(source)

Also lists the outputs of an earlier run, which an error leaves unchanged.
"""

from __future__ import annotations

import datetime as dt
import os
import sys
import tempfile
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any, NoReturn

from report.cli.console import INPUT_ERROR, print_json, say
from report.results.publish import OUTPUTS
from report.text.counts import numbered
from solver.errors import InputError, Problem

SCHEMA_VERSION = 1
"""Of the documents of `--json`: raised where a key changes its name or meaning."""


@contextmanager
def input_errors(
    source: Path, *, as_json: bool = False, outputs: Sequence[Path] = ()
) -> Iterator[None]:
    """Print input errors, one problem per line or as JSON, and exit with code 2.

    The same for operating system errors, such as a file without permission or a missing folder.
    Existing outputs of an earlier run are listed.
    """
    try:
        yield
    # Nobody reads any more: no error of the input, and nothing to print it to.
    except BrokenPipeError:
        raise
    except OSError as error:
        _refuse(source, [system_problem(error)], outputs, as_json=as_json)
    except InputError as error:
        _refuse(source, error.parts, outputs, as_json=as_json)


def _refuse(
    source: Path, problems: Sequence[Problem], outputs: Sequence[Path], *, as_json: bool
) -> NoReturn:
    if as_json:
        print_json(document(source, problems))
    else:
        say_problems(source, problems)
    say_earlier_outputs(outputs)
    sys.exit(INPUT_ERROR)


def workbook_of(source: Path) -> Path:
    """Return the workbook passed to a command, as a file or by its folder."""
    # Unlike `Path.is_dir`, it raises nothing where a name is too long.
    return source / "input.xlsx" if os.path.isdir(source) else source


def outputs_of(source: Path, out: Path | None) -> tuple[Path, ...]:
    """Return the paths of the package and the tables of a workbook."""
    folder = out or workbook_of(source).parent / "out"
    return tuple(folder / name for name in OUTPUTS)


def say_earlier_outputs(outputs: Sequence[Path]) -> None:
    """Print which outputs are from an earlier run, after a run that has not replaced them."""
    # Files of an earlier run look like those of this one, which has none.
    files = [path for path in outputs if os.path.isfile(path)]
    if not files:
        return
    newest = dt.datetime.fromtimestamp(max(path.stat().st_mtime for path in files))
    are, were = ("is", "was") if len(files) == 1 else (f"and {len(files) - 1} more are", "were")
    text = f" {are} from an earlier run ({newest:%Y-%m-%d %H:%M}) and {were} not replaced"
    say(files[0], text, is_error=True)


def document(source: Path, problems: Sequence[Problem] = ()) -> dict[str, Any]:
    """Return the common part of every JSON document about a workbook: its path and its errors."""
    return {
        "schema_version": SCHEMA_VERSION,
        "workbook": str(source),
        "errors": [str(problem) for problem in problems],
    }


def say_problems(source: Path, problems: Sequence[Problem]) -> None:
    """Print the problems of an input, one per line; those of several cells once."""
    # Imported for an error alone: `motion` and `slide` need no models of a workbook.
    from report.project.check.finding_lines import grouped, line_of

    say(source, f": {numbered(len(problems), 'error')}:", is_error=True)
    for equal_problems in grouped(problems):
        say(f"  {line_of(equal_problems)}", is_error=True)


def system_problem(error: OSError) -> Problem:
    """Return an operating system error as a problem of an input."""
    reason = error.strerror or error
    if not error.filename:
        return Problem(
            f"a file cannot be written or read ({reason})",
            f"free disk space, also for temporary files{_place()}, or raise the file size limit",
        )
    return Problem(
        f"{error.filename}: the operating system denied access ({reason})",
        "check the path, its permissions and the free disk space",
    )


def _place() -> str:
    """Return the folder of temporary files, if there is one."""
    try:
        return f" in {tempfile.gettempdir()}"
    except OSError:
        return ""
