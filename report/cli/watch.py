"""The command `roofslip watch`: the report again after every save. Read `report.cli.report`."""

from __future__ import annotations

import os
import time
from contextlib import suppress
from pathlib import Path

import click

from report.cli.report import package, show
from report.cli.terminal import SOURCE, collect, input_errors, say
from report.making import OUTPUTS

POLL_S, MOST_POLLS, MOST_CHANGES = 0.3, 10, 12
NO_INPUTS = (*OUTPUTS, ".sha256", ".tmp", ".bak", ".swp", ".lock", "~")


@click.command()
@click.argument("source", metavar="DIR|WORKBOOK", type=SOURCE)
@click.option("--out", type=SOURCE, help="Output folder; default: out/ beside the input.")
def watch(source: Path, out: Path | None) -> None:
    """Check and report on every save of the workbook or a record, until Ctrl+C.

    Prints what changed since the round before. Waits while the workbook is half saved or locked.
    """
    from report.sheet.reading.archive import located

    with input_errors(source):
        workbook, results = located(source), b""
    while True:
        seen = settled(workbook)
        with suppress(SystemExit):  # after an error the next save is waited for as well
            results = report_again(workbook, out, results)
        collect()
        click.echo(f"watching {workbook.parent}; end with Ctrl+C")
        while stamps(workbook.parent) == seen:
            time.sleep(POLL_S)


def report_again(workbook: Path, out: Path | None, former: bytes) -> bytes:
    """Report, print what changed since the former results.json, and return the new one."""
    from report.results.compare import changes
    from report.results.since import former_from

    made = assessment, folder, files, _ = package(workbook, out)
    show(*made)
    if former:
        items = changes(former_from(former, folder), assessment).items
        say(f"changes since the round before: {len(items)}")
        for item in items[:MOST_CHANGES]:
            say(f"  {item.title} {item.cell}".rstrip() + f": {item.before} -> {item.now}")
    return files["results.json"]


def settled(workbook: Path) -> set[tuple[str, int, int]]:
    """Wait until a workbook opens and no file changes, if that comes; return `stamps`."""
    from report.sheet.reading.archive import open_book

    for _ in range(MOST_POLLS):
        seen = stamps(workbook.parent)
        time.sleep(POLL_S)
        with suppress(Exception):  # the report says what is wrong with it
            open_book(workbook)
            if stamps(workbook.parent) == seen:
                break
    return seen


def stamps(top: Path) -> set[tuple[str, int, int]]:
    """Return path, time and size of the files below a folder that may be inputs."""
    found = set()
    for folder, _, names in os.walk(top):
        for name in names:
            if not name.startswith((".", "~")) and not name.endswith(NO_INPUTS):
                with suppress(OSError):  # it may be gone by now
                    status = os.stat(path := os.path.join(folder, name))
                    found.add((path, status.st_mtime_ns, status.st_size))
    return found
