"""The commands on records and one block: `roofslip motion info`, `convert`, `rows`, and `slide`."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import click

from report.cli.lazy_group import LazyGroup
from report.cli.option_types import AS_JSON, SOURCE, TIME_STEP, UNITS, Existing, Number, reading


@click.group(cls=LazyGroup)
def motion() -> None:
    """Inspect and convert records, and generate suites of motions."""


_HERE = "report.cli.commands.motion"
motion.add_section("Commands", f"{_HERE}:convert", f"{_HERE}:info", f"{_HERE}:rows")
motion.add_section("Commands", "report.cli.commands.suite:suite")

_per_line = click.option("--values-per-line", type=click.IntRange(1), help="Values run across the "
                         "lines, this many per line (the last line may be shorter).")  # fmt: skip
_response = click.option("--response", default="", metavar="STATION.xml|NUMBER", help="Instrument"
                         " response of raw counts: StationXML, or counts per m/s2.")  # fmt: skip
_channel = click.option("--channel", default="", metavar="NAME",
                        help="Channel to read: its name, or its number in the file.")  # fmt: skip


@click.command()
@click.argument("file", metavar="FILE", type=SOURCE)
@_channel
@_per_line
@_response
@reading
@AS_JSON
def info(file: Path, **options: Any) -> None:
    """List the channels of FILE with peaks, duration and drift.

    Prints peak acceleration, velocity and displacement, Arias intensity, significant duration (5 to
    95%), and the velocity and displacement at the end, without baseline correction. The
    format is recognized from the content, not from the file name.
    """
    from report.cli.record_file import print_channels

    print_channels(file, **options)


@click.command()
@click.argument("file", metavar="FILE", type=SOURCE)
@click.argument("out", metavar="OUT.csv", type=SOURCE)
@_channel
@click.option("--factor", type=Number(), default=1.0, help="Multiply the samples by this"
                                                           " factor; use -1 "
              "for a vertical record that is positive downward.")  # fmt: skip
@_per_line
@_response
@reading
def convert(file: Path, out: Path, **options: Any) -> None:
    """Write FILE as CSV: time in s, acceleration in g.

    An existing file is never overwritten. If FILE has several channels, select one with --channel.
    """
    from report.cli.record_file import convert_record

    convert_record(file, out, **options)


@click.command()
@click.argument("source", metavar="FOLDER|ZIP", type=Existing())
@click.argument("project", metavar="[DIR|WORKBOOK]", type=SOURCE, required=False)
@click.option("--at", "recorded_at", type=click.Choice(["roof", "ground"]),
              help="Where they were recorded; required with a workbook.")  # fmt: skip
@click.option("--only", metavar="NAME", multiple=True,
              help="Add only motions with this name; * matches any characters.")  # fmt: skip
@click.option("--without-vertical", is_flag=True,
              help="Accept two horizontal records without a vertical one as a set.")  # fmt: skip
@reading
def rows(source: Path, project: Path | None, **options: Any) -> None:
    """List the motions (sets of three records) in FOLDER or ZIP; add them to a workbook.

    Ambiguous sets are listed with the reason and are not added. Records are copied into records/
    next to the workbook, unless they are in its folder.
    """
    from report.cli.motion_rows import add_motions

    add_motions(source, project, **options)


@click.command()
@click.argument("record")
@click.option("--slope-deg", required=True,
              type=Number("deg", -45.0, 45.0, is_open=True), help="Roof slope; positive if "
              "positive acceleration points downslope.")  # fmt: skip
@click.option("--mu", type=Number(low=0.0), required=True, help="Friction coefficient.")
@click.option("--transverse", metavar="RECORD", help="Second horizontal record, acting "
              "cross-slope.")  # fmt: skip
@click.option("--vertical", metavar="RECORD", help="Vertical record, positive upward.")
@click.option(
    "--ppa-g", type=Number("g"), help="Scale all components so that RECORD peaks at this PPA."
)
@click.option("--factor", type=Number(), help="Scale all components by this factor.")
@click.option("--dt", "dt_s", type=TIME_STEP, help="Time step, if the record has no time column.")
@click.option("--units", type=UNITS,
              help="Units of the records, if the files do not state them.")  # fmt: skip
@AS_JSON
def slide(ppa_g: float | None, factor: float | None, **options: Any) -> None:
    """Compute the sliding of one block under one RECORD, for a quick check or in a script.

    If a file has several channels, enter RECORD as "FILE | CHANNEL" (name or number).
    """
    if ppa_g is not None and factor is not None:
        raise click.UsageError("use --ppa-g or --factor, not both")
    from report.cli.one_block import slide_block

    slide_block(ppa_g=ppa_g, factor=factor, **options)
