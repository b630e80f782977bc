"""Builds one package, and prints the summary of `roofslip report`."""

from __future__ import annotations

import sys
from collections.abc import Callable
from pathlib import Path

from report.assessment.revision_changes import Changes
from report.cli.console import NOT_OK, print_json, say
from report.cli.input_errors import document, input_errors, outputs_of
from report.cli.progress import Progress
from report.making import Made, make
from report.pages import terminal as summaries
from report.pages.changes import counted
from report.results.publish import OUTPUTS
from report.steps import STEPS
from report.text.counts import numbered


def report_one(
    source: Path,
    out: Path | None,
    since: Path | None,
    *,
    fail_on_ng: bool,
    quiet: bool,
    as_json: bool,
    has_page: bool,
) -> None:
    """Make the package of a project, and print its summary."""
    lines: list[str] = []
    flags = {"quiet": quiet, "as_json": as_json, "has_page": has_page}
    made = package(source, out, since, on_record=lines.append, **flags)
    if as_json:
        files = {"files": [str(made.folder / name) for name in made.files]}
        workbook = made.assessment.source.path
        print_json(document(workbook) | summaries.document(made.assessment) | files)
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
    """Build a package with `make`; print input errors and exit with code 2."""
    with (
        input_errors(source, as_json=as_json, outputs=outputs_of(source, out)),
        Progress(STEPS, quiet=quiet) as progress,
    ):
        made = make(source, out, since, progress, on_record, has_page=has_page)
    # After the progress has ended: its line would be written over the warning.
    warn_of_other_packages(made.folder / OUTPUTS[0])
    return made


def show(made: Made) -> None:
    """Print the summary of a package and its files; the verdict with the package is last."""
    # The last lines are what is still on the screen after many findings and paths.
    *lines, verdict = summaries.summary(made.assessment)
    for line in lines:
        say(line)
    if made.changes.is_asked_for:
        _print_changes(made.changes)
    say("")
    package, *tables = (made.folder / name for name in made.files)
    for path in tables:
        say(path)
    say(f"{verdict}; ", package, f", {numbered(made.sheets, 'sheet')}")


def warn_of_other_packages(written: Path) -> None:
    """Warn of packages next to a new one that are from another input."""
    packages = sorted(path for path in written.parent.glob("*.pdf") if path.name != written.name)
    if packages:
        # An extra, which a report imports only here: it takes most of a second.
        from report.proof.opened_package import warn_of_other_input

        warn_of_other_input(written, packages)


def _print_changes(changes: Changes) -> None:
    before = {item.title: item.before for item in changes.items if item.cell}
    # Both changed: one alone may be a correction.
    if {"Project name", "Project number"} <= before.keys():
        say(
            f"the --since file is from another project: {before['Project number']},"
            f" {before['Project name']}; check that it is the previous revision of this one"
        )
    say(
        f"since revision {changes.revision}: {counted(changes)}; the package lists them after its "
        "summary"
    )
