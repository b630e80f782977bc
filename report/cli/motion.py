"""The commands on records: `roofslip motion info`, `convert`, `suite`, `rows`.

Parses, calls, prints; heavy imports stay inside the commands. Read `report.cli.terminal` for what
all commands share, then `solver.records.record`.
"""

from __future__ import annotations

import json
import math
import os
from collections.abc import Callable
from dataclasses import replace
from fnmatch import fnmatchcase
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING, Any

import click

from report.cli.options import TIME_STEP, Existing, Number, SectionedGroup
from report.cli.terminal import AS_JSON, SOURCE, UNITS, Progress, input_errors, plain, say_next
from report.text.counts import called, numbered

if TYPE_CHECKING:
    from report.sheet.reading.read import Sheet
    from report.suite.inputs import SuiteTargets
    from solver.formats import MotionFile
    from solver.records.record import Record

# Rounding error allowed in a converted record, relative to its peak.
_KEPT_WITHIN = 1e-9


@click.group(cls=SectionedGroup)
def motion() -> None:
    """Inspect and convert records, and generate suites of motions."""


def _reading(command: Callable[..., None]) -> Callable[..., None]:
    """Add the options for reading a file."""
    step = click.option("--dt", "dt_s", type=TIME_STEP, default=math.nan,
                        help="Time step, if the file has none.")  # fmt: skip
    units = click.option("--units", type=UNITS, help="Units, if the file does not state them.")
    return step(units(command))


_per_line = click.option("--values-per-line", type=click.IntRange(1), default=None, callback=lambda
                         *about: about[2] or 0, help="The values follow each other across the "
                         "lines, so many in each but the last.")  # fmt: skip
_response = click.option("--response", default="", metavar="STATION.xml|NUMBER", help="Of raw "
                         "counts, as in miniSEED: StationXML, or the counts per m/s2.")  # fmt: skip
_channel = click.option("--channel", default="", metavar="NAME",
                        help="One channel: its name or its number in the file.")  # fmt: skip


@motion.command()
@click.argument("file", metavar="FILE", type=SOURCE)
@_channel
@_per_line
@_response
@_reading
@AS_JSON
def info(file: Path, channel: str, as_json: bool, **how: Any) -> None:
    """List the channels of FILE with peaks, duration and drift.

    Prints peak acceleration, velocity and displacement, Arias intensity, significant duration (5 to
    95 % of it), and the velocity and displacement at the end, without baseline correction. The
    format is recognized from the content, not from the file name.
    """
    from report.suite.files import summary, table

    with input_errors(file):
        motion_file = _read(file, **how)
        records = [motion_file.channel(channel)] if channel else motion_file.channels
    channels = [summary(record) for record in records]
    if as_json:
        about = {"file": str(file), "format": motion_file.format, "notes": list(motion_file.notes)}
        click.echo(json.dumps(about | {"channels": channels}))
        return
    click.echo(f"{file}: {motion_file.format}")
    for line in (*table(channels), *(f"note: {note}" for note in motion_file.notes)):
        click.echo(line)


@motion.command()
@click.argument("file", metavar="FILE", type=SOURCE)
@click.argument("out", metavar="OUT.csv", type=SOURCE)
@_channel
@click.option("--factor", type=Number(), default=1.0, help="Multiply the samples, by -1 for a "
              "vertical record that is positive downward.")  # fmt: skip
@_per_line
@_response
@_reading
def convert(file: Path, out: Path, channel: str, factor: float, **how: Any) -> None:
    """Write FILE as CSV: time in s, acceleration in g.

    An existing file is never overwritten. If FILE has several channels, select one with --channel.
    """
    with input_errors(file):
        motion_file = _read(file, **how)
        record = motion_file.channel(channel)
        _write(replace(record, a_mps2=factor * record.a_mps2), out)
    for note in motion_file.notes:
        click.echo(f"note: {note}")
    click.echo(out)


@motion.command()
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
@_reading
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
        from report.results.motions import add_suite, said_near, suite_rows
        from report.results.publish import output_folder, publish
        from report.sheet.reading.read import read
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
            {row["id"] for row in rows} & {row.get("id") for row in sheet.draft["motions"]}
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


@motion.command()
@click.argument("source", metavar="FOLDER|ZIP", type=Existing())
@click.argument("project", metavar="[DIR|WORKBOOK]", type=SOURCE, required=False)
@click.option("--at", type=click.Choice(["roof", "ground"]),
              help="Where they were recorded; required with a workbook.")  # fmt: skip
@click.option("--only", metavar="NAME", multiple=True,
              help="Take the motions of this name; * stands for any letters.")  # fmt: skip
@click.option("--without-vertical", is_flag=True,
              help="Take two horizontal records without a vertical one as a set.")  # fmt: skip
@_reading
def rows(
    source: Path,
    project: Path | None,
    at: str | None,
    only: tuple[str, ...],
    without_vertical: bool,
    units: str | None,
    dt_s: float,
) -> None:
    """List the motions in FOLDER or ZIP, sets of three records; add them to a workbook.

    Sets that are not clear are listed with the reason and not added. Records are copied into
    records/ beside the workbook, unless they are in its folder.
    """
    with input_errors(source), TemporaryDirectory() as temporary:
        from report.motions.sets import sets_of, table
        from report.motions.stored import unpack
        from report.results.motions import row_cells, set_rows
        from report.sheet.writing.filled import changing
        from solver.model import InputError

        # A default would be wrong in silence: ground motions go through the building.
        if project and not at:
            raise InputError(
                "--at is missing; give --at roof or --at ground, where the motions were recorded"
            )
        folder, whole = source, ""
        if not folder.is_dir():
            # The name of a zip is that of motions, and never of a folder: it may be "..".
            zipped, folder, whole = folder, Path(temporary), folder.stem
            unpack(zipped, folder)
        sets, left = sets_of(
            folder, units or "", dt_s, whole=whole, without_vertical=without_vertical
        )
        wanted = [name.casefold() for name in only or ("*",)]
        for name in list(sets):
            if not any(fnmatchcase(name.casefold(), each) for each in wanted):
                del sets[name]
        for line in (*table(sets), *(f"not taken: {what}: {why}" for what, why in left)):
            click.echo(plain(line))
        if flat := [name for name, group in sets.items() if len(group) == 2]:
            click.echo(
                f"note: {plain(', '.join(flat))}: without a vertical record. Motions for analysis"
                " have two horizontal components and the vertical together: the value from"
                " analysis is not permitted with these."
            )
        if not sets:
            raise InputError("no set of two horizontal records and a vertical one to take")
        if project:
            about = {"recorded_at": at, "units": units, "dt_s": None if math.isnan(dt_s) else dt_s}
            with changing(project) as change:
                added, change.files = set_rows(change.book, folder, sets, about)
                change.fill(row_cells(change.book, added))
            path, count = change.book.path, len(change.files)
            click.echo(f"{path.parent}: {numbered(count, 'record')} copied.")
            rows_added = f"{numbered(len(added), 'row')} added to the sheet Motions"
            click.echo(f"{path}: {rows_added}: {change.areas}")
            say_next(path, change.has_formulas)


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


def _read(path: Path, units: str | None, **how: Any) -> MotionFile:
    from solver.formats import read_motion_file

    return read_motion_file(path, units=units or "", **how)


def _write(record: Record, out: Path) -> None:
    from solver.files import write_whole
    from solver.model import InputError
    from solver.records.record import record_csv

    if os.path.lexists(out):  # a dangling link as well
        raise InputError(f"{out}: already exists; give another name, or move the file")
    write_whole(out, record_csv(record, within=_KEPT_WITHIN).encode())
