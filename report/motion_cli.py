"""The commands on records: `roofslip motion info`, `motion convert`.

Parses, calls, prints; heavy imports stay inside the commands. Read `report.terminal` for what all
commands share, then `solver.motion`.
"""

from __future__ import annotations

import json
import math
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import click

from report.terminal import input_errors

if TYPE_CHECKING:
    from solver.motion import Record

_FILE = click.Path(path_type=Path)

# Of the record's peak: what a converted record may lose.
_KEPT_WITHIN = 1e-9
_PICTURES = (".svg", ".png")


@click.group()
def motion() -> None:
    """Look at records and convert them."""


def _reading(command: Callable[..., None]) -> Callable[..., None]:
    """Add the options that say how to read a file."""
    units = click.Choice(["g", "m/s2", "cm/s2", "mm/s2", "gal"])
    options = (
        click.option("--units", type=units, help="Units, where the file does not say."),
        click.option("--dt", "dt_s", type=float, help="Time step [s], where the file has none."),
    )  # fmt: skip
    for option in options:
        command = option(command)
    return command


def _picture(_: click.Context, __: click.Parameter, path: Path | None) -> Path | None:
    """Let only names of pictures pass, so that no record is ever written over."""
    if path and path.suffix.lower() not in _PICTURES:
        raise click.BadParameter(f"{path} is no name of a picture; end it in .svg or .png")
    return path


@motion.command()
@click.argument("file", metavar="FILE", type=_FILE)
@_reading
@click.option("--json", "as_json", is_flag=True, help="Print JSON: SI, units in the keys.")
@click.option("--plot", metavar="OUT.svg|OUT.png", type=_FILE, callback=_picture,
              help="Draw the records and their 5 % damped response spectra.")  # fmt: skip
def info(
    file: Path, units: str | None, dt_s: float | None, as_json: bool, plot: Path | None
) -> None:
    """Say what FILE holds: sampling, peaks, Arias intensity, duration, drift at the end."""
    from report.motion_info import summary, table

    with input_errors(file):
        records = [_record(file, units, dt_s)]
        if plot:
            _draw(records, plot)
    channels = [summary(record) for record in records]
    if as_json:
        found = {"file": str(file), "format": "text", "notes": [], "channels": channels}
        click.echo(json.dumps(found))
        return
    for line in table(channels):
        click.echo(line)
    if plot:
        click.echo(plot)


@motion.command()
@click.argument("file", metavar="FILE", type=_FILE)
@click.argument("out", metavar="OUT.csv", type=_FILE)
@_reading
def convert(file: Path, out: Path, units: str | None, dt_s: float | None) -> None:
    """Write FILE as OUT.csv: time in s and acceleration in g; never over a file that is there."""
    with input_errors(file):
        _write(_record(file, units, dt_s), out)
    click.echo(out)


def _record(path: Path, units: str | None, dt_s: float | None) -> Record:
    from solver.formats import read_record

    return read_record(path, units=units or "", dt_s=math.nan if dt_s is None else dt_s)


def _write(record: Record, out: Path) -> None:
    from solver.model import InputError
    from solver.motion import write_record

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
    from report.motion_info import PERIODS_S, spectra_g
    from report.pdf import TEMPLATES
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
