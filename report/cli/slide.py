"""The command `roofslip slide`: one block under one motion, with the simplest adequate model.

Parses and prints; `solver.formats` reads, `solver.sliding.model_selection` selects and runs the
model.
"""

from __future__ import annotations

import json
import math
from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from report.cli.options import TIME_STEP, Number
from report.cli.terminal import AS_JSON, UNITS, input_errors

if TYPE_CHECKING:
    from solver.model import Scene
    from solver.records.record import Record


@click.command()
@click.argument("record")
@click.option("--slope-deg", required=True,
              type=Number("deg", -45.0, 45.0, is_open=True), help="Roof slope; positive if "
              "positive acceleration points downslope.")  # fmt: skip
@click.option("--mu", type=Number(low=0.0), required=True, help="Friction coefficient.")
@click.option("--transverse", metavar="RECORD", help="Second horizontal record, acting "
              "cross-slope.")  # fmt: skip
@click.option("--vertical", metavar="RECORD", help="Vertical record, positive up.")
@click.option(
    "--ppa-g", type=Number("g"), help="Scale all components so that RECORD peaks at this PPA."
)
@click.option("--factor", type=Number(), help="Scale all components by this factor.")
@click.option("--dt", type=TIME_STEP, help="Time step, if the record has no time column.")
@click.option("--units", type=UNITS,
              help="Units of the records, if the files do not state them.")  # fmt: skip
@AS_JSON
def slide(
    record: str,
    transverse: str | None,
    vertical: str | None,
    slope_deg: float,
    mu: float,
    ppa_g: float | None,
    factor: float | None,
    dt: float | None,
    units: str | None,
    as_json: bool,
) -> None:
    """Compute the sliding of one block under one RECORD, for a quick check or in a script.

    If a file has several channels, give RECORD as "FILE | CHANNEL" (name or number).
    """
    if ppa_g is not None and factor is not None:
        raise click.UsageError("give --ppa-g or --factor, not both")
    from solver.friction_tests import MOST_MU

    # Checked here, as the limit is slow to import where options are made.
    if mu > MOST_MU:
        raise click.BadParameter(f"it is {mu:g}; give 0 to {MOST_MU:g}.", param_hint="'--mu'")
    step_s = math.nan if dt is None else dt
    with input_errors(Path(record)):
        records = _read((record, transverse, vertical), units or "", step_s)
        scale = _scale(records[0], ppa_g, factor)
        scene = _scene(records, slope_deg, mu, scale)
        values = {"slope_deg": slope_deg, "mu": mu, "scale": scale, "dt_s": scene.dt_s}
        values |= _solved(scene)
    from report.text.formats import aligned, finite

    if as_json:
        click.echo(json.dumps(finite(values)))
        return
    shown = (f"{v:.6g}" if isinstance(v, float) else str(v) for v in values.values())
    for line in aligned(list(zip(values, shown, strict=True)), "><"):
        click.echo(line)


def _read(names: tuple[str | None, ...], units: str, dt_s: float) -> list[Record | None]:
    """Read the horizontal, transverse and vertical records."""
    from solver.formats import read_record
    from solver.model import InputError
    from solver.records.record import has_gravity

    problems: list[str] = []
    records: list[Record | None] = []
    for name in names:
        records.append(None)
        if name is None:
            continue
        # From the right: a channel may be named in a path that has a bar itself.
        file, _, channel = name.rpartition("|") if "|" in name else (name, "", "")
        try:
            path = Path(file.strip())
            records[-1] = read_record(path, units=units, dt_s=dt_s, channel=channel.strip())
        except InputError as error:
            # The errors of all files at once, not one at each attempt.
            problems += error.problems
    components = [record for record in records if record is not None]
    problems += [
        f"{record.name}: has a mean of about 1 g: gravity is in it; subtract the mean"
        for record in components
        if has_gravity(record.a_mps2)
    ]
    problems += _mismatches(components)
    if problems:
        raise InputError(problems)
    return records


def _mismatches(records: list[Record]) -> list[str]:
    return [
        f"{other.name}: has {len(other.a_mps2)} samples at {other.dt_s:g} s, but "
        f"{records[0].name} has {len(records[0].a_mps2)} at {records[0].dt_s:g} s; give components "
        "of equal length and time step"
        for other in records[1:]
        if (len(other.a_mps2), other.dt_s) != (len(records[0].a_mps2), records[0].dt_s)
    ]


def _scale(record: Record | None, ppa_g: float | None, factor: float | None) -> float:
    from solver.model import STANDARD_GRAVITY_MPS2, InputError

    if ppa_g is None or record is None:
        return 1.0 if factor is None else factor
    peak = float(abs(record.a_mps2).max())
    if peak == 0.0:
        raise InputError(
            f"{record.name}: is all zeros and cannot be scaled to a PPA; give another record"
        )
    return ppa_g * STANDARD_GRAVITY_MPS2 / peak


def _scene(records: list[Record | None], slope_deg: float, mu: float, scale: float) -> Scene:
    from solver.sliding.checked import scene

    x, y, z = records
    assert x is not None  # the argument is required
    return scene(
        x.a_mps2,
        x.dt_s,
        slope_rad=math.radians(slope_deg),
        mu=mu,
        ay_mps2=y.a_mps2 if y else None,
        az_mps2=z.a_mps2 if z else None,
        units="m/s2",
        scale=scale,
    )


def _solved(scene: Scene) -> dict[str, Any]:
    """Return the results by name, with the model used."""
    from solver.sliding.model_selection import solve

    solution = solve(scene)
    return asdict(solution.result) | {
        "outcome": solution.result.status.sentence,
        "model": f"{int(solution.model)}, {solution.model.title}",
        "reason": solution.reason,
        "next_model": f"{int(solution.next_model)}, {solution.next_model.title}",
        "next_effect_m": solution.next_effect_m,
        "error_m": solution.result.error_m,
        "friction_demand": solution.friction_demand,
    }
