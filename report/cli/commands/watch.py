"""The command `roofslip watch`: a report after every save."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import click

from report.cli.options import SOURCE


@click.command()
@click.argument("source", metavar="DIR|WORKBOOK", type=SOURCE)
@click.option("--out", type=SOURCE, help="Output folder; default: out/ next to the input.")
@click.pass_obj
def watch(interrupts: Sequence[int], source: Path, out: Path | None) -> None:
    """Check and report on every save of the workbook or a record, until Ctrl+C.

    Prints what changed since the round before. Waits while the workbook is half saved or locked.
    """
    from report.cli.file_watcher import watch_project

    watch_project(source, out, interrupts)
