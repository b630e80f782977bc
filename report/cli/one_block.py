"""One block under one motion, with the simplest adequate model.

`solver.formats` reads, `solver.sliding.model_selection` selects and runs the model.
"""

from __future__ import annotations

import math
from dataclasses import asdict
from pathlib import Path

import click

from report.cli.console import print_json, say
from report.cli.input_errors import input_errors
from report.text.aligned import aligned
from report.text.json_numbers import finite
from solver.errors import InputError
from solver.formats import read_record
from solver.friction_tests import MOST_MU
from solver.model import STANDARD_GRAVITY_MPS2
from solver.records.record import Record, has_gravity
from solver.sliding.checked import scene
from solver.sliding.model_selection import solve
from solver.spaces import spaced


def slide_block(
    record: str,
    *,
    transverse: str | None,
    vertical: str | None,
    slope_deg: float,
    mu: float,
    ppa_g: float | None,
    factor: float | None,
    dt_s: float | None,
    units: str | None,
    as_json: bool,
) -> None:
    """Run a block under the records of up to three components, and print its results."""
    # Checked here, as the limit is slow to import where options are made.
    if mu > MOST_MU:
        raise click.BadParameter(f"it is {mu:g}; enter 0 to {MOST_MU:g}.", param_hint="'--mu'")
    with input_errors(Path(record)):
        step_s = math.nan if dt_s is None else dt_s
        x, y, z = _read((record, transverse, vertical), units or "", step_s)
        assert x is not None  # the argument is required
        scale = 1.0 if factor is None else factor
        if ppa_g is not None:
            scale = _scale_to(ppa_g, x)
        block = scene(
            x.a_mps2,
            x.dt_s,
            slope_rad=math.radians(slope_deg),
            mu=mu,
            ay_mps2=y.a_mps2 if y else None,
            az_mps2=z.a_mps2 if z else None,
            units="m/s2",
            scale=scale,
        )
        solution = solve(block)
    values = {
        "slope_deg": slope_deg,
        "mu": mu,
        "scale": scale,
        "dt_s": block.dt_s,
        **asdict(solution.result),
        "outcome": solution.result.status.sentence,
        "model": f"{int(solution.model)}, {solution.model.title}",
        "reason": spaced(solution.reason),
        "next_model": f"{int(solution.next_model)}, {solution.next_model.title}",
        "next_effect_m": solution.next_effect_m,
        "error_m": solution.result.error_m,
        "friction_demand": solution.friction_demand,
    }
    if as_json:
        print_json(finite(values))
        return
    rows = []
    # Six digits: the numbers are read by a person here; --json has all of them.
    for name, value in values.items():
        rows.append((name, f"{value:.6g}" if isinstance(value, float) else str(value)))
    for line in aligned(rows, "><"):
        say(line)


def _read(names: tuple[str | None, ...], units: str, dt_s: float) -> list[Record | None]:
    """Read the horizontal, transverse and vertical records; the errors of all are one error."""
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
            problems += error.problems
    components = [record for record in records if record is not None]
    for record in components:
        if has_gravity(record.a_mps2):
            problems.append(
                f"{record.name}: the mean is about 1 g because the record includes gravity;"
                " subtract the mean"
            )
    for record in components[1:]:
        first = components[0]
        if (len(record.a_mps2), record.dt_s) != (len(first.a_mps2), first.dt_s):
            problems.append(
                f"{record.name}: has {len(record.a_mps2)} samples at {record.dt_s:g} s, but "
                f"{first.name} has {len(first.a_mps2)} at {first.dt_s:g} s; use components of "
                "equal length and time step"
            )
    if problems:
        raise InputError(problems)
    return records


def _scale_to(ppa_g: float, record: Record) -> float:
    """Return the factor by which a record peaks at a PPA."""
    peak_mps2 = float(abs(record.a_mps2).max())
    if peak_mps2 == 0.0:
        raise InputError(
            f"{record.name}: is all zeros and cannot be scaled to a PPA; use another record"
        )
    return ppa_g * STANDARD_GRAVITY_MPS2 / peak_mps2
