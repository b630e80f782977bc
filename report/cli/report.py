"""The commands `roofslip new`, `roofslip report` and `roofslip watch`, a report after every save.

Parse and print; `report.making` goes from workbook to package.
"""

from __future__ import annotations

import gc
import os
import sys
import time
from collections.abc import Callable, Mapping
from contextlib import ExitStack, suppress
from pathlib import Path
from typing import TYPE_CHECKING

import click

from report.cli.several import report_several
from report.cli.terminal import (
    AS_JSON,
    FAIL_ON_NG,
    NOT_OK,
    QUIET,
    SOURCE,
    Progress,
    document,
    input_errors,
    outputs_of,
    plain,
    print_json,
    say,
    warn_of_others,
)
from report.making import OUTPUTS
from report.text.counts import command, numbered

if TYPE_CHECKING:
    from report.assessment.revision_changes import Changes
    from report.making import Made


@click.command()
@click.argument("folder", metavar="DIR", type=SOURCE)
@click.option("--units", type=click.Choice(["US", "SI"], case_sensitive=False), default="US",
              show_default=True,
              help="Units of the input cells and primary units of the package.")  # fmt: skip
@click.option("--example", is_flag=True, help="Fill it in, with motions, to try a report.")
@click.option("--study", is_flag=True, help="Write the workbook of a study instead.")
def new(folder: Path, units: str, example: bool, study: bool) -> None:
    """Write a blank DIR/input.xlsx and the folder DIR/records/ for the motions."""
    if example and study:
        raise click.UsageError("give --example or --study, not both; projects/study is an example")
    with input_errors(folder):
        path = _new_project(folder, units, is_example=example, is_study=study)
    if example:
        click.echo(f"{path}: a warehouse with three arrays and seven motions, complete;")
        click.echo(f"to see its package, run: {command('report', folder)}")
        return
    click.echo(f"{path}: fill in the yellow cells, put the roof motions in {folder / 'records'},")
    click.echo(f"then run: {command('study' if study else 'check', folder)}")


def _new_project(folder: Path, units: str, *, is_example: bool, is_study: bool) -> Path:
    """Write a workbook and its records folder; never overwrite a workbook or a record."""
    from report.project.model.choices import UnitsFirst
    from report.project.write.example import example_files
    from report.project.write.template import write_template
    from report.study.read import write_study
    from solver.files import add_folder, check_plain, write_all
    from solver.model import InputError

    path = folder / "input.xlsx"
    # A dangling link as well, which `exists` does not see.
    if os.path.lexists(path):
        raise InputError(f"{path}: already exists; choose another folder, or move the file")
    records = folder / "records"
    check_plain(records, folder, is_folder=True)
    try:
        if is_example and records.is_dir() and any(records.iterdir()):
            raise InputError(f"{records}: is not empty; choose another folder")
        with ExitStack() as undo:
            add_folder(records, undo)
            if is_example:
                write_all(example_files(UnitsFirst(units)), folder)
            else:
                write = write_study if is_study else write_template
                write(path, units=UnitsFirst(units))
            # All is written: only now nothing is taken back.
            undo.pop_all()
    except OSError as error:
        raise InputError(
            f"{path}: cannot be written ({error.strerror}); choose another folder"
        ) from error
    return path


@click.command()
@click.argument("sources", metavar="DIR|WORKBOOK...", nargs=-1, required=True, type=SOURCE)
@click.option("--out", type=SOURCE, help="Output folder; default: out/ beside the input.")
@click.option("--since", type=SOURCE, metavar="RESULTS.JSON",
              help="Of a former revision: the package states what changed.")  # fmt: skip
@click.option("--no-page", is_flag=True, help="Leave out calc-package.html.")
@FAIL_ON_NG
@QUIET
@AS_JSON
def report(
    sources: tuple[Path, ...],
    out: Path | None,
    since: Path | None,
    no_page: bool,
    fail_on_ng: bool,
    quiet: bool,
    as_json: bool,
) -> None:
    """Write calc-package.pdf, plan.dxf, results.xlsx and results.json, and print a summary.

    Beside the package, calc-package.html shows it in any browser, without Roofslip.

    Beside the date of each confirmation, the workbook gets what it covered, once: where these
    inputs change later, the package has a condition.

    Of several projects each has a line in one table; several workbooks of one folder are written to
    out/NAME/. One with an error stops no other: the exit code is 2 if any input has an error, and 1
    after an internal error.
    """
    if len(sources) > 1:
        if out or since:
            raise click.UsageError(
                "--out and --since are of one project; leave them out, and each project is written "
                "to its own out/, or report each on its own"
            )
        report_several(
            sources, fail_on_ng=fail_on_ng, quiet=quiet, as_json=as_json, has_page=not no_page
        )
    (source,) = sources
    lines: list[str] = []
    made = package(
        source,
        out,
        since,
        quiet=quiet,
        as_json=as_json,
        on_record=lines.append,
        has_page=not no_page,
    )
    if as_json:
        print_json(_document(made))
    elif not quiet:
        for line in lines:
            say(line)
        show(made)
    if fail_on_ng and made.assessment.verdict != "OK":
        sys.exit(NOT_OK)


def package(
    source: Path,
    out: Path | None,
    since: Path | None = None,
    *,
    quiet: bool = False,
    as_json: bool = False,
    on_record: Callable[[str], None] | None = None,
    has_page: bool = True,
) -> Made:
    """Make a package as `make` does; an input error is printed, and ends with exit code 2."""
    from report.making import STEPS, make

    with (
        input_errors(source, as_json=as_json, outputs=outputs_of(source, out)),
        Progress(STEPS, quiet=quiet) as progress,
    ):
        made = make(source, out, since, progress, on_record, has_page=has_page)
    warn_of_others(made.folder / OUTPUTS[0])
    return made


def show(made: Made) -> None:
    """Print the summary of a package and its files; last the verdict, with the package."""
    from report.pages.terminal import summary

    *lines, verdict = summary(made.assessment)
    for line in lines:
        say(line)
    if made.changes.is_asked_for:
        _print_changes(made.changes)
    click.echo("")
    package, *tables = (made.folder / name for name in made.files)
    for path in tables:
        click.echo(path)
    say(f"{verdict}; {package}, {numbered(made.sheets, 'sheet')}")


def _document(made: Made) -> Mapping[str, object]:
    from report.pages import terminal

    written = {"files": [str(made.folder / name) for name in made.files]}
    return document(made.assessment.sheet.path) | terminal.document(made.assessment) | written


def _print_changes(changed: Changes) -> None:
    from report.pages.changes import counted

    before = {item.title: plain(item.before) for item in changed.items if item.cell}
    # Both changed: one alone may be a correction.
    if {"Project name", "Project number"} <= before.keys():
        click.echo(
            f"--since is of another project: {before['Project number']},"
            f" {before['Project name']}; check that it is the former revision of this one"
        )
    click.echo(
        f"since revision {changed.revision}: {counted(changed)}; the package lists them after its "
        "summary"
    )


POLL_S, MOST_POLLS, MOST_CHANGES = 0.3, 10, 12
# What the report writes itself, and files that programs keep beside one that is open.
NO_INPUTS = (*OUTPUTS, ".sha256", ".tmp", ".bak", ".swp", ".lock", "~")


@click.command()
@click.argument("source", metavar="DIR|WORKBOOK", type=SOURCE)
@click.option("--out", type=SOURCE, help="Output folder; default: out/ beside the input.")
def watch(source: Path, out: Path | None) -> None:
    """Check and report on every save of the workbook or a record, until Ctrl+C.

    Prints what changed since the round before. Waits while the workbook is half saved or locked.
    """
    from report.project.read.archive import located

    with input_errors(source):
        workbook, results = located(source), b""
    while True:
        seen = settled(workbook)
        # After an error the next save is waited for as well.
        with suppress(SystemExit):
            results = report_again(workbook, out, results)
        gc.collect()  # a package leaves much that refers to itself
        click.echo(f"watching {workbook.parent}; end with Ctrl+C")
        while stamps(workbook.parent) == seen:
            time.sleep(POLL_S)


def report_again(workbook: Path, out: Path | None, former: bytes) -> bytes:
    """Report, print what changed since the former results.json, and return the new one."""
    from report.results.changes import changes
    from report.results.results_json import former_from

    made = package(workbook, out)
    show(made)
    if former:
        items = changes(former_from(former, made.folder), made.assessment).items
        say(f"changes since the round before: {len(items)}")
        for item in items[:MOST_CHANGES]:
            say(f"  {item.title} {item.cell}".rstrip() + f": {item.before} -> {item.now}")
    return made.files["results.json"]


def settled(workbook: Path) -> set[tuple[str, int, int]]:
    """Wait until a workbook opens and no file changes, if that comes; return `stamps`."""
    from report.project.read.archive import open_book

    for _ in range(MOST_POLLS):
        seen = stamps(workbook.parent)
        time.sleep(POLL_S)
        # Excel writes a workbook in several steps, and locks it meanwhile.
        with suppress(Exception):  # the report says what is wrong with it
            open_book(workbook)
            if stamps(workbook.parent) == seen:
                break
    return seen


def stamps(top: Path) -> set[tuple[str, int, int]]:
    """Return path, time and size of the files below a folder that may be inputs."""
    seen = set()
    for folder, _, names in os.walk(top):
        for name in names:
            if not name.startswith((".", "~")) and not name.endswith(NO_INPUTS):
                with suppress(OSError):  # it may be gone by now
                    status = os.stat(path := os.path.join(folder, name))
                    seen.add((path, status.st_mtime_ns, status.st_size))
    return seen
