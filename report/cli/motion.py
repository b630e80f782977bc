"""The commands on records: `roofslip motion info`, `motion convert`, `motion suite`.

Parses, calls, prints; heavy imports stay inside the commands. Read `report.cli.terminal` for what
all commands share, then `solver.records.record`.
"""

from __future__ import annotations

import json
import math
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import click

from report.cli.terminal import UNITS, Progress, input_errors

if TYPE_CHECKING:
    from report.suite.inputs import SuiteTargets
    from solver.formats import MotionFile
    from solver.records.record import Record

_FILE = click.Path(path_type=Path)

# Of the record's peak: what a converted record may lose.
_KEPT_WITHIN = 1e-9
_PICTURES = (".svg", ".png")


@click.group()
def motion() -> None:
    """Look at records, convert them, and make suites of them."""


def _reading(command: Callable[..., None]) -> Callable[..., None]:
    """Add the options that say how to read a file."""
    options = (
        click.option("--units", type=click.Choice(UNITS),
                     help="Units, where the file does not say."),
        click.option("--dt", "dt_s", type=float, default=math.nan, metavar="S",
                     help="Time step [s], where the file has none."),
    )  # fmt: skip
    for option in options:
        command = option(command)
    return command


_channel = click.option("--channel", default="", metavar="NAME",
                        help="One channel: its name, or its number in the file.")  # fmt: skip


def _picture(_: click.Context, __: click.Parameter, path: Path | None) -> Path | None:
    """Let only names of pictures pass, so that no record is ever written over."""
    if path and path.suffix.lower() not in _PICTURES:
        raise click.BadParameter(f"{path} is no name of a picture; end it in .svg or .png")
    return path


@motion.command()
@click.argument("file", metavar="FILE", type=_FILE)
@_channel
@_reading
@click.option("--json", "as_json", is_flag=True, help="Print JSON: SI, units in the keys.")
@click.option("--plot", metavar="OUT.svg|OUT.png", type=_FILE, callback=_picture,
              help="Draw the records and their 5 % damped response spectra.")  # fmt: skip
def info(
    file: Path, channel: str, units: str | None, dt_s: float, as_json: bool, plot: Path | None
) -> None:
    """Say what FILE holds: channels, peaks, duration, drift.

    Peak acceleration, velocity and displacement, Arias intensity, significant duration from 5 to
    95 % of it, and the velocity and displacement left at the end. No base line is taken off. The
    format is told by the content, whatever the name of the file.
    """
    from report.suite.info import summary, table

    with input_errors(file):
        found = _read(file, units, dt_s)
        records = [found.channel(channel)] if channel else found.channels
        if plot:
            _draw(records, plot)
    channels = [summary(record) for record in records]
    if as_json:
        about = {"file": str(file), "format": found.format, "notes": list(found.notes)}
        click.echo(json.dumps(about | {"channels": channels}))
        return
    click.echo(f"{file}: {found.format}")
    for line in (*table(channels), *(f"note: {note}" for note in found.notes)):
        click.echo(line)
    if plot:
        click.echo(plot)


@motion.command()
@click.argument("file", metavar="FILE", type=_FILE)
@click.argument("out", metavar="OUT.csv", type=_FILE)
@_channel
@_reading
def convert(file: Path, out: Path, channel: str, units: str | None, dt_s: float) -> None:
    """Write FILE as csv: time in s, acceleration in g.

    Never over a file that is there. Of several channels one has to be chosen.
    """
    with input_errors(file):
        found = _read(file, units, dt_s)
        _write(found.channel(channel), out)
    for note in found.notes:
        click.echo(f"note: {note}")
    click.echo(out)


@motion.command()
@click.argument("folder", metavar="DIR", type=_FILE)
@click.argument("more", metavar="", nargs=-1)
@click.option("--sds", "s_ds_g", type=float, default=math.nan, help="S_DS [g].")
@click.option("--zh", "z_over_h", type=float, default=1.0, show_default=True,
              help="Height of the array over that of the roof.")  # fmt: skip
@click.option("--code", type=click.Choice(["asce7-16", "asce7-22", "pv1"]),
              help="Edition whose AC156 spectrum is the target.")  # fmt: skip
@click.option("--tail", type=click.Choice(["ac156", "1/T"]), default="ac156", show_default=True,
              help="Below 1.3 Hz: the line of AC156, or 1/T.")  # fmt: skip
@click.option("--target", metavar="BOOK.xlsx!SHEET|CSV", help="A spectrum of your own: columns "
              "frequency [Hz] or period [s], horizontal [g], vertical [g].")  # fmt: skip
@click.option("--count", type=click.IntRange(1, 99), default=7, show_default=True,
              help="Number of motions.")  # fmt: skip
@click.option("--seed", type=click.IntRange(0), default=1, show_default=True,
              help="The same seed gives the same files.")  # fmt: skip
@click.option("--records", metavar="FILES", multiple=True, help="Grow from records, not noise: a "
              "motion from each file, or from several joined by commas. After DIR.")  # fmt: skip
@_reading
def suite(
    folder: Path,
    more: tuple[str, ...],
    s_ds_g: float,
    z_over_h: float,
    code: str | None,
    tail: str,
    target: str | None,
    count: int,
    seed: int,
    records: tuple[str, ...],
    units: str | None,
    dt_s: float,
) -> None:
    """Make motions that follow a spectrum, into DIR: x, y and z of each, suite.json, suite.png.

    Each lasts 30 s, 5 to rise and 5 to decay, and ends at rest where it began. Older files of the
    same names are replaced.
    """
    if more and not records:
        raise click.UsageError(f"'{more[0]}' belongs to nothing; write --records before files")
    with input_errors(folder), Progress() as progress:
        from report.results.publish import publish
        from report.suite.files import suite_files, suite_table
        from report.suite.inputs import check_folder, read_seeds
        from solver.synthesis import make_suite

        check_folder(folder, count)
        targets = _targets(code, s_ds_g, z_over_h, tail, target)
        found = read_seeds((*records, *more), units=units or "", dt_s=dt_s)
        progress("compiling the solver, the first time")
        made = make_suite(
            targets.horizontal,
            targets.vertical,
            count=count,
            seed=seed,
            records=found.groups,
            progress=progress,
        )
        progress("drawing the spectra")
        files = suite_files(made, targets, seed=seed, records=found.sha256)
        publish(files, folder)
    for line in (*suite_table(made, targets), *found.notes):
        click.echo(line)
    click.echo(f"{folder}: {len(files) - 2} records, suite.json, suite.png; seed {seed}")


def _targets(
    code: str | None, s_ds_g: float, z_over_h: float, tail: str, target: str | None
) -> SuiteTargets:
    from report.suite.inputs import ac156_targets, table_targets
    from report.suite.target_table import read_target
    from solver.model import InputError
    from solver.rules.spectra import Tail

    rule = Tail.RECIPROCAL if tail == "1/T" else Tail.AC156
    if target:
        return table_targets(read_target(target), s_ds_g=s_ds_g, tail=rule)
    if code is None or math.isnan(s_ds_g):
        raise InputError("no target; give --sds and --code, or --target")
    return ac156_targets(code, s_ds_g=s_ds_g, z_over_h=z_over_h, tail=rule)


def _read(path: Path, units: str | None, dt_s: float) -> MotionFile:
    from solver.formats import read_motion_file

    return read_motion_file(path, units=units or "", dt_s=dt_s)


def _write(record: Record, out: Path) -> None:
    from solver.model import InputError
    from solver.records.record import write_record

    if out.exists():
        raise InputError(f"{out}: is there already; give another name, or move it away")
    try:
        write_record(out, record, within=_KEPT_WITHIN)
    except OSError as error:
        raise InputError(f"{out}: cannot be written ({error.strerror})") from error


def _draw(records: Sequence[Record], out: Path) -> None:
    """Write the picture of records, over an older one too."""
    from report.figures.base import load_fonts
    from report.figures.records import MOST, records_png, records_svg
    from report.suite.info import PERIODS_S, spectra_g
    from report.typeset.pdf import TEMPLATES
    from solver.model import InputError

    if len(records) > MOST:
        raise InputError(f"{out.name}: a picture holds {MOST} channels; choose one by its name")
    load_fonts(TEMPLATES / "fonts")
    drawing = records_png if out.suffix.lower() == ".png" else records_svg
    picture = drawing(records, PERIODS_S, spectra_g(records))
    try:
        out.write_bytes(picture if isinstance(picture, bytes) else picture.encode())
    except OSError as error:
        raise InputError(f"{out}: cannot be written ({error.strerror})") from error
