"""The commands on records: `roofslip motion info`, `convert`, `rows`; `suite` is an extra.

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
from report.cli.terminal import AS_JSON, SOURCE, UNITS, input_errors, plain, say_next
from report.text.counts import numbered

if TYPE_CHECKING:
    from solver.formats import MotionFile
    from solver.records.record import Record

# Rounding error allowed in a converted record, relative to its peak.
_KEPT_WITHIN = 1e-9


@click.group(cls=SectionedGroup)
def motion() -> None:
    """Inspect and convert records, and generate suites of motions."""


motion.add_extra("report.cli.suite:suite")


def reading(command: Callable[..., None]) -> Callable[..., None]:
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
@reading
@AS_JSON
def info(file: Path, channel: str, as_json: bool, **how: Any) -> None:
    """List the channels of FILE with peaks, duration and drift.

    Prints peak acceleration, velocity and displacement, Arias intensity, significant duration (5 to
    95 % of it), and the velocity and displacement at the end, without baseline correction. The
    format is recognized from the content, not from the file name.
    """
    from report.motions.measured import summary, table

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
@reading
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
@click.argument("source", metavar="FOLDER|ZIP", type=Existing())
@click.argument("project", metavar="[DIR|WORKBOOK]", type=SOURCE, required=False)
@click.option("--at", type=click.Choice(["roof", "ground"]),
              help="Where they were recorded; required with a workbook.")  # fmt: skip
@click.option("--only", metavar="NAME", multiple=True,
              help="Take the motions of this name; * stands for any letters.")  # fmt: skip
@click.option("--without-vertical", is_flag=True,
              help="Take two horizontal records without a vertical one as a set.")  # fmt: skip
@reading
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
        from report.project.write.filled import changing
        from report.results.motions import row_cells, set_rows
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
