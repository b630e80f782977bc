"""Generates a suite of motions that match a spectrum, and adds it to a workbook."""

from __future__ import annotations

import math
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import click

from report.cli.console import say, say_next
from report.cli.input_errors import input_errors
from report.cli.progress import Progress
from report.project.read.read import read
from report.project.read.workbook_data import Sheet
from report.results.added_motions import add_suite, said_near, suite_rows
from report.results.publish import output_folder, publish
from report.suite.seed_records import read_seeds
from report.suite.suite_files import check_folder, generate
from report.suite.suite_table import suite_table
from report.suite.target_table import read_target
from report.suite.targets import (
    SuiteTargets,
    ac156_targets,
    site_targets,
    table_targets,
)
from report.text.command_line import command
from report.text.counts import numbered
from solver.errors import InputError
from solver.rules.ac156 import Tail


def generate_suite(
    folder: Path,
    *,
    seed_files: Sequence[str],
    target: str | None,
    count: int,
    seed: int,
    into: Path | None,
    units: str | None,
    dt_s: float,
    **spectrum: Any,
) -> None:
    """Write the records of a suite to a folder, and list them in a workbook if one is given.

    `spectrum` are `s_ds_g`, `z_over_h`, `code` and `tail`; None if not given.
    """
    # What comes before the first motion takes no share, so that the time left is theirs.
    shares = (0.0, *[1.0] * count, 1.0)
    with input_errors(into or folder), Progress(shares) as progress:
        # Before minutes of work: a folder that cannot be written is told at once.
        # Motions of an earlier, larger suite would remain beside the new ones, and pass for them.
        check_folder(folder, count)
        output_folder(folder, folder, "")
        sheet = read(into) if into else None
        options = {name: value for name, value in spectrum.items() if value is not None}
        targets, taken = _targets(options, target, sheet)
        rows = suite_rows(sheet.book, folder, count, targets.source(seed)) if sheet else []
        seeds = read_seeds(seed_files, units=units or "", dt_s=dt_s)
        motions, files = generate(targets, count, seed, seeds, progress)
        # With a workbook both or neither are written: rows without their records would be errors.
        if into:
            change = add_suite(into, folder, rows, files)
        else:
            publish(files, folder)
    for line in (*taken, *suite_table(motions, targets), *seeds.notes):
        say(line)
    say(folder, f": {len(files) - 2} records, suite.json, suite.png; seed {seed}")
    if sheet:
        earlier_ids = {row.get("id") for row in sheet.inputs["motions"]}
        renewed = len({row["id"] for row in rows} & earlier_ids)
        also = f", {renewed} updated" if renewed else ""
        added = f"{numbered(count - renewed, 'row')} added to the Motions worksheet{also}"
        say(sheet.path, f": {added}: {change.areas}")
        say_next(sheet.path, change.has_formulas)
        return
    for line in said_near(folder):
        say(f"warning: {line}", is_error=True)
    click.echo(f"Next: {command('motion rows', folder)} DIR --at roof")


def _targets(
    options: dict[str, Any], target: str | None, sheet: Sheet | None
) -> tuple[SuiteTargets, list[str]]:
    """Return the target of a suite, and the workbook cells that its values are from."""
    # Any of the options makes a target of its own; half of a site and half of options would be
    # nobody's.
    if sheet and not options and not target:
        return site_targets(sheet)
    spectrum: dict[str, Any] = {"s_ds_g": math.nan, "z_over_h": 1.0} | options
    spectrum["tail"] = Tail.RECIPROCAL if options.get("tail") == "1/T" else Tail.AC156
    if target:
        table = read_target(target)
        return table_targets(table, s_ds_g=spectrum["s_ds_g"], tail=spectrum["tail"]), []
    if not {"s_ds_g", "code"} <= options.keys():
        raise InputError("no target; use --sds and --code, or --target")
    return ac156_targets(**spectrum), []
