"""The command `roofslip motion suite`: motions that match a spectrum.

Parses, calls, prints; heavy imports stay inside the command. Read `report.suite.inputs`.
"""

from __future__ import annotations

import math
import os
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from report.cli.motion import reading
from report.cli.options import Number
from report.cli.terminal import SOURCE, Progress, input_errors, plain, say_next
from report.text.counts import called, numbered

if TYPE_CHECKING:
    from report.project.read.workbook_data import Sheet
    from report.suite.inputs import SuiteTargets


@click.command()
@click.argument("folder", metavar="DIR", type=SOURCE)
@click.argument("more", metavar="", nargs=-1)
@click.option("--sds", "s_ds_g", type=Number("g"), help="S_DS.")
@click.option("--zh", "z_over_h", type=Number(),
              help="Height ratio z/h of the array; 1 by default.")  # fmt: skip
@click.option("--code", help="Edition for the AC156 target spectrum, e.g. asce7-16 or pv1.")
@click.option("--tail", type=click.Choice(["ac156", "1/T"]), help="Target below 1.3 Hz: the AC156 "
              "line, the default, or 1/T.")  # fmt: skip
@click.option("--target", metavar="BOOK.xlsx!SHEET|CSV", help="Your own target spectrum, with "
              "columns frequency [Hz] or period [s], horizontal [g], vertical [g].")  # fmt: skip
@click.option("--count", type=click.IntRange(1, 99), default=7, show_default=True,
              help="Number of motions.")  # fmt: skip
@click.option("--seed", type=click.IntRange(0), default=1, show_default=True,
              help="The same seed gives the same files.")  # fmt: skip
@click.option("--records", metavar="FILES", multiple=True, help="Use records as seeds, not "
              "noise: one motion per file, or per files joined by commas. After DIR.")  # fmt: skip
@click.option("--into", metavar="DIR|WORKBOOK", type=SOURCE, help="Add the motions to the sheet "
              "Motions; DIR must be in its folder. Without any of --sds, --zh, --code, --tail and "
              "--target, the target is that of its site.")  # fmt: skip
@reading
def suite(
    folder: Path,
    more: tuple[str, ...],
    s_ds_g: float | None,
    z_over_h: float | None,
    code: str | None,
    tail: str | None,
    target: str | None,
    count: int,
    seed: int,
    records: tuple[str, ...],
    into: Path | None,
    units: str | None,
    dt_s: float,
) -> None:
    """Generate spectrum-compatible motions in DIR: x, y and z records, suite.json, suite.png.

    Each motion lasts 30 s, with 5 s of rise and 5 s of decay, and ends with zero velocity and
    displacement. Existing files of the same names are replaced.
    """
    if more and not records:
        raise click.UsageError(f"unexpected argument '{more[0]}'; write --records before the files")
    os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")  # the motions are on all cores already
    # What comes before the first motion takes no share, so that the time left is theirs.
    shares = (0.0, *[1.0] * count, 1.0)
    with input_errors(into or folder), Progress(shares) as progress:
        from report.project.read.read import read
        from report.results.motions import add_suite, said_near, suite_rows
        from report.results.publish import output_folder, publish
        from report.suite.files import generate, suite_table
        from report.suite.inputs import check_folder, read_seeds

        # Before minutes of work: a folder that cannot be written is told at once.
        check_folder(folder, count)
        output_folder(folder, folder, "")
        sheet = read(into) if into else None
        asked = {"s_ds_g": s_ds_g, "z_over_h": z_over_h, "code": code, "tail": tail}
        options = {name: value for name, value in asked.items() if value is not None}
        targets, taken = _targets(options, target, sheet)
        rows = suite_rows(sheet.book, folder, count, targets.source(seed)) if sheet else []
        seeds = read_seeds((*records, *more), units=units or "", dt_s=dt_s)
        motions, files = generate(targets, count, seed, seeds, progress)
        # With a workbook both or neither are written: rows without their records would be errors.
        if into:
            change = add_suite(into, folder, rows, files)
        else:
            publish(files, folder)
    for line in (*taken, *suite_table(motions, targets), *seeds.notes):
        click.echo(line)
    click.echo(f"{folder}: {len(files) - 2} records, suite.json, suite.png; seed {seed}")
    if sheet:
        renewed = len(
            {row["id"] for row in rows} & {row.get("id") for row in sheet.inputs["motions"]}
        )
        also = f", {renewed} renewed" if renewed else ""
        added = f"{numbered(count - renewed, 'row')} added to the sheet Motions{also}"
        click.echo(f"{sheet.path}: {added}: {change.areas}")
        say_next(sheet.path, change.has_formulas)
        return
    for line in said_near(folder):
        click.echo(plain(f"warning: {line}"), err=True)
    click.echo("Next: copy the records into records/ of a project, list them on its sheet Motions,")
    click.echo(f"then run: {called()} check DIR")


def _targets(
    options: dict[str, Any], target: str | None, sheet: Sheet | None
) -> tuple[SuiteTargets, list[str]]:
    """Return the target of a suite, and what of it is from which cells of a workbook."""
    from report.suite.inputs import ac156_targets, site_targets, table_targets
    from report.suite.target_table import read_target
    from solver.model import InputError
    from solver.rules.hazard import Tail

    # Any of the options makes a target of its own; half of a site and half of options would be
    # nobody's.
    if sheet and not options and not target:
        return site_targets(sheet)
    whole: dict[str, Any] = {"s_ds_g": math.nan, "z_over_h": 1.0} | options
    whole["tail"] = Tail.RECIPROCAL if options.get("tail") == "1/T" else Tail.AC156
    if target:
        table = read_target(target)
        return table_targets(table, s_ds_g=whole["s_ds_g"], tail=whole["tail"]), []
    if not {"s_ds_g", "code"} <= options.keys():
        raise InputError("no target; give --sds and --code, or --target")
    return ac156_targets(**whole), []
