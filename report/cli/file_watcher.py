"""Waits for saves in the folder of a project, and reports after each."""

from __future__ import annotations

import gc
import os
import time
from collections.abc import Sequence
from contextlib import suppress
from pathlib import Path
from typing import NoReturn

import click

from report.cli.console import say
from report.cli.input_errors import input_errors
from report.cli.one_package import package, show
from report.project.read.archive import located, open_book
from report.results.publish import OUTPUTS
from report.results.results_json import former_from
from report.results.revision_comparison import changes

POLL_S = 0.3
# Then the report is made as it is, and says what is wrong with the workbook.
MAX_POLLS = 10
MAX_CHANGES = 12
"""Changes that are printed after a report."""

# What the report writes itself, and files that programs keep beside one that is open.
NO_INPUTS = (*OUTPUTS, ".sha256", ".tmp", ".bak", ".swp", ".lock", "~")

FileStamps = set[tuple[str, int, int]]
"""Path, time and size of each file."""


def watch_project(source: Path, out: Path | None, interrupts: Sequence[int]) -> NoReturn:
    """Report, and again after every save, until Ctrl+C adds to `interrupts`."""
    with input_errors(source):
        workbook, results = located(source), b""
    while not interrupts:
        # Taken before the report: a save while it is made differs from them, and starts the next
        # round.
        stamps = settled(workbook)
        # After an error the next save is waited for as well.
        with suppress(SystemExit):
            results = report_again(workbook, out, results)
        gc.collect()  # a package leaves much that refers to itself
        click.echo(f"watching {workbook.parent}; press Ctrl+C to stop")
        while not interrupts and file_stamps(workbook.parent) == stamps:
            time.sleep(POLL_S)
    # Python drops it in a finalizer, and compiled code may raise an error of its own for it.
    raise KeyboardInterrupt


def report_again(workbook: Path, out: Path | None, earlier: bytes) -> bytes:
    """Report, print changes since the previous results.json, and return the new one."""
    made = package(workbook, out)
    show(made)
    if earlier:
        items = changes(former_from(earlier, made.folder), made.assessment).items
        say(f"changes since the last report: {len(items)}")
        # A changed S_DS changes most numbers; the package lists them all only with --since.
        for item in items[:MAX_CHANGES]:
            say(f"  {item.title} {item.cell}".rstrip() + f": {item.before} -> {item.now}")
    return made.files["results.json"]


def settled(workbook: Path) -> FileStamps:
    """Wait until a workbook opens and no file changes, if ever; return `file_stamps`."""
    for _ in range(MAX_POLLS):
        stamps = file_stamps(workbook.parent)
        time.sleep(POLL_S)
        # Excel writes a workbook in several steps, and locks it meanwhile.
        with suppress(Exception):  # the report says what is wrong with it
            open_book(workbook)
            if file_stamps(workbook.parent) == stamps:
                break
    return stamps


def file_stamps(top: Path) -> FileStamps:
    """Return the stamps of the files below a folder that may be inputs."""
    stamps = set()
    for folder, _, names in os.walk(top):
        for name in names:
            # Locks: Excel keeps ~$input.xlsx beside an open workbook, LibreOffice
            # .~lock.input.xlsx#.
            if not name.startswith((".", "~")) and not name.endswith(NO_INPUTS):
                path = os.path.join(folder, name)
                with suppress(OSError):  # it may be gone by now
                    status = os.stat(path)
                    stamps.add((path, status.st_mtime_ns, status.st_size))
    return stamps
