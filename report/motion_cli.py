"""The commands on records: `roofslip motion info`, `motion convert`.

Parses, calls, prints; heavy imports stay inside the commands. Read `report.terminal` for what all
commands share, then `solver.motion`.
"""

from __future__ import annotations

import json
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from report.terminal import input_errors

if TYPE_CHECKING:
    from solver.motion import Record

_FILE = click.Path(path_type=Path)

# Of the record's peak: what a converted record may lose.
_KEPT_WITHIN = 1e-9


@click.group()
def motion() -> None:
    """Look at records and convert them."""


def _reading(command: Callable[..., None]) -> Callable[..., None]:
    """Add the options that say how to read a file."""
    units = click.Choice(["g", "m/s2", "cm/s2", "mm/s2"])
    options = (
        click.option("--units", type=units, default="g", show_default=True,
                     help="Units of the file."),
        click.option("--dt", "dt_s", type=float, help="Time step [s], where the file has none."),
    )  # fmt: skip
    for option in options:
        command = option(command)
    return command


@motion.command()
@click.argument("file", metavar="FILE", type=_FILE)
@_reading
@click.option("--json", "as_json", is_flag=True, help="Print JSON: SI, units in the keys.")
def info(file: Path, units: str, dt_s: float | None, as_json: bool) -> None:
    """Say what FILE holds: its sampling, length and peaks."""
    with input_errors(file):
        record = _record(file, units, dt_s)
    found = {"file": str(file), "channels": [_summary(record)]}
    if as_json:
        click.echo(json.dumps(found))
        return
    _print_table([_summary(record)])


@motion.command()
@click.argument("file", metavar="FILE", type=_FILE)
@click.argument("out", metavar="OUT.csv", type=_FILE)
@_reading
def convert(file: Path, out: Path, units: str, dt_s: float | None) -> None:
    """Write FILE as OUT.csv: time in s and acceleration in g; never over a file that is there."""
    with input_errors(file):
        _write(_record(file, units, dt_s), out)
    click.echo(out)


def _record(path: Path, units: str, dt_s: float | None) -> Record:
    from solver.motion import read_record

    return read_record(path, units=units, dt_s=dt_s)


def _write(record: Record, out: Path) -> None:
    from solver.model import InputError
    from solver.motion import write_record

    if out.exists():
        raise InputError(f"{out}: is there already; give another name, or move it away")
    try:
        write_record(out, record, within=_KEPT_WITHIN)
    except OSError as error:
        raise InputError(f"{out}: cannot be written ({error.strerror})") from error


def _summary(record: Record) -> dict[str, Any]:
    from solver.motion import UNITS

    npts = len(record.a_mps2)
    return {
        "name": record.name,
        "dt_s": record.dt_s,
        "npts": npts,
        "duration_s": (npts - 1) * record.dt_s,
        "pga_g": float(abs(record.a_mps2).max()) / UNITS["g"],
    }


def _print_table(channels: Sequence[dict[str, Any]]) -> None:
    for channel in channels:
        for key, value in channel.items():
            text = f"{value:.6g}" if isinstance(value, float) else value
            click.echo(f"{key:>12}  {text}")
