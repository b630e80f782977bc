"""Makes the design curves: recorded components on rock and on three roofs, and what follows.

    .venv/bin/python -m projects.curves.make RECORDS [--scheduler tcp://HOST:PORT]

RECORDS is the folder `records` of USGS SLAMMER (github.com/maddyblue/slammer): a component is a
file of accelerations [g] in the folder of its event, and the file `eq.sql` lists event, file and
step [s]. The records are not shipped: they come from PEER. Writes the tables beside this file, and
the figures of `docs/design-curves.md`. Read `main`.
"""

from __future__ import annotations

import argparse
import json
import resource
import sys
import time
from collections.abc import Iterator, Sequence
from dataclasses import asdict
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import pandas as pd

from projects.curves.equation import (
    RoofRuns,
    Scatter,
    ambraseys_menu_m,
    fit_equation,
    jibson_m,
    pooled,
    saygili_rathje_m,
    scatter,
)
from solver.building.roof import to_roof
from solver.building.structure import building_of_periods
from solver.errors import InputError
from solver.model import STANDARD_GRAVITY_MPS2, Floats
from solver.records.spectrum import response_spectrum
from solver.studies.curves import first_allowed
from solver.studies.sweep import sweep

HERE = Path(__file__).resolve().parent
PICTURES = HERE.parents[1] / "docs" / "pictures"
LIST = "eq.sql"
G = STANDARD_GRAVITY_MPS2
INCH = 0.0254

PERIODS_S = (0.0, 0.3, 0.8, 1.5)
"""First periods of what the arrays stand on; 0 is rock, the others shear buildings with 5%."""

SLOPES_DEG = np.linspace(0.0, 7.0, 29)
MUS = np.round(np.linspace(0.30, 1.00, 15), 2)
S_DS_G = np.round(np.linspace(0.2, 3.2, 16), 1)
LIMITS_IN = (6, 12, 24, 48)
"""PRD for which the least friction and the capacities are given."""

PLATEAU_S = np.geomspace(0.1, 0.5, 21)
"""Periods [s] at which the geometric mean of the spectrum of a component is its S_DS."""

AT_ONCE = 50
"""Components that are given to the cluster at a time: what is under way stays small."""


class Component(NamedTuple):
    """A recorded component: event, name, step [s] and accelerations [m/s2]."""

    event: str
    name: str
    dt_s: float
    a_mps2: Floats


class Response(NamedTuple):
    """What a component does, each an array of shape (periods, ...).

    Peak acceleration [m/s2] and velocity [m/s] of the roof for S_DS = 1 g, and the PRD [m] by
    slope, friction coefficient and S_DS: NaN where the block would lift off.
    """

    ppa_mps2: Floats
    ppv_mps: Floats
    prd_m: Floats
    unfinished: int  # runs that are still sliding at the end


def components(folder: Path) -> list[Component]:
    """Read the components of a folder.

    Raises
    ------
    InputError
        If the list or components are missing or not as described, with all of them.
    """
    listed = folder / LIST
    if not listed.is_file():
        raise InputError(f"{listed}: not found; give the folder `records` of SLAMMER")
    read, problems = [], []
    for line in listed.read_text(encoding="latin-1").splitlines():
        event, name, step = line.split("\t")[:3]
        try:
            values = np.array((folder / event / name).read_text().split(), dtype=np.float64)
            read.append(Component(event, name, float(step), G * values))
        except (OSError, ValueError) as error:
            problems.append(f"{folder / event / name}: {error}")
    if problems or not read:
        raise InputError(problems or [f"{listed}: lists no component"])
    return read


def respond(component: Component) -> Response:
    """Run a component, scaled to each S_DS, on every roof."""
    a, dt_s = component.a_mps2, component.dt_s
    s_ds_g = np.exp(np.log(response_spectrum(a, dt_s, PLATEAU_S) / G).mean())
    ppa, ppv, prd, unfinished = [], [], [], 0
    for period_s in PERIODS_S:
        if period_s:
            roof = to_roof(a, dt_s, building_of_periods([period_s]))
            roof_mps2, step_s = roof.a_mps2, roof.dt_s
        else:
            roof_mps2, step_s = a, dt_s
        runs = sweep(
            roof_mps2, step_s, slopes_rad=np.radians(SLOPES_DEG), mus=MUS, scales=S_DS_G / s_ds_g
        )
        velocity = np.cumsum(0.5 * (roof_mps2[1:] + roof_mps2[:-1])) * step_s
        ppa.append(np.abs(roof_mps2).max() / s_ds_g)
        ppv.append(np.abs(velocity).max() / s_ds_g)
        prd.append(runs.prd_m.astype(np.float32))
        unfinished += int((runs.status == 1).sum())
    return Response(np.array(ppa), np.array(ppv), np.array(prd), unfinished)


def respond_all(found: Sequence[Component], scheduler: str) -> list[Response]:
    """Run all components on a Dask cluster: that of a scheduler, or the cores of this machine."""
    from distributed import Client, LocalCluster

    where = scheduler or LocalCluster(threads_per_worker=1, dashboard_address=None)
    responses: list[Response] = []
    with Client(where) as client:
        for start in range(0, len(found), AT_ONCE):
            some = found[start : start + AT_ONCE]
            responses += client.gather(client.map(respond, some, pure=False))
            print(f"{len(responses)} of {len(found)} components", file=sys.stderr)
    if not scheduler:
        where.close()
    return responses


def prescriptive_m(s_ds_g: Floats) -> Floats:
    """Return the displacement of SEAOC PV1-2012, 60 in x (S_DS - 0.4)^2, without its least [m]."""
    return np.asarray(60.0 * INCH * np.maximum(s_ds_g - 0.4, 0.0) ** 2)


def cases(prd_m: Floats) -> pd.DataFrame:
    """Return the statistics over the components of each case.

    Parameters
    ----------
    prd_m : array, shape (components, periods, slopes, mus, S_DS)
        A PRD that is NaN counts as larger than any other.
    """
    ordered = np.sort(np.where(np.isnan(prd_m), np.inf, prd_m), axis=0)
    count = len(ordered)
    rank = {name: -(-count * percent // 100) - 1 for name, percent in (("median", 50), ("p84", 84))}
    over = (ordered > prescriptive_m(S_DS_G)).mean(axis=0)
    columns = {
        "median_m": ordered[rank["median"]],
        "p84_m": ordered[rank["p84"]],
        "envelope_m": ordered[-1],
        "share_over_prescriptive": over,
        "without_value": np.isnan(prd_m).sum(axis=0),
    }
    axes = {"period_s": PERIODS_S, "slope_deg": SLOPES_DEG, "mu": MUS, "s_ds_g": S_DS_G}
    index = pd.MultiIndex.from_product(axes.values(), names=list(axes))
    return pd.DataFrame({name: values.ravel() for name, values in columns.items()}, index=index)


def least_friction(table: pd.DataFrame) -> pd.DataFrame:
    """Return the least friction coefficient for which the 84% PRD is within each limit.

    Interpolated between those run, and rounded up to 0.01; NaN where the largest is not enough.
    """
    columns = {}
    by_mu = table["p84_m"].unstack("mu")
    for limit in LIMITS_IN:
        least = [
            first_allowed(MUS, np.where(np.isfinite(row), row, np.nan), limit * INCH)
            for row in by_mu.to_numpy()
        ]
        columns[f"least_mu_{limit}_in"] = np.ceil(np.round(100.0 * np.array(least), 6)) / 100.0
    return pd.DataFrame(columns, index=by_mu.index)


def capacities(prd_m: Floats) -> pd.DataFrame:
    """Return the S_DS at which 16, 50 and 84% of the components exceed each limit.

    The capacity of a component is the S_DS at which its PRD first exceeds a limit, on straight
    lines between the runs, and `beta` the record-to-record dispersion, half of ln(84% / 16%).
    Blank outside the S_DS that were run.
    """
    rows = []
    for limit in LIMITS_IN:
        first = _first_over(prd_m, limit * INCH)
        low, median, high = np.quantile(first, (0.16, 0.5, 0.84), axis=0, method="inverted_cdf")
        rows.append(np.stack([np.full(low.shape, limit), low, median, high], axis=-1))
    table = np.stack(rows, axis=-2).reshape(-1, 4)
    table[(table < S_DS_G[0]) | np.isinf(table)] = np.nan
    axes = {"period_s": PERIODS_S, "slope_deg": SLOPES_DEG, "mu": MUS, "limit_in": LIMITS_IN}
    index = pd.MultiIndex.from_product(axes.values(), names=list(axes))
    names = ["limit_in", "s_ds_16_g", "s_ds_50_g", "s_ds_84_g"]
    made = pd.DataFrame(table, columns=names, index=index).drop(columns="limit_in")
    made["beta"] = 0.5 * np.log(made["s_ds_84_g"] / made["s_ds_16_g"])
    return made


def _first_over(prd_m: Floats, limit_m: float) -> Floats:
    """Return the S_DS at the first exceedance; infinite where none, below the least run where 0."""
    over = ~(prd_m <= limit_m)
    at = np.argmax(over, axis=-1)
    below = np.take_along_axis(prd_m, np.maximum(at - 1, 0)[..., None], axis=-1)[..., 0]
    above = np.take_along_axis(prd_m, at[..., None], axis=-1)[..., 0]
    part = np.where(np.isnan(above), 1.0, (limit_m - below) / np.maximum(above - below, 1e-12))
    step = S_DS_G[1] - S_DS_G[0]
    inside = S_DS_G[np.maximum(at - 1, 0)] + step * part
    return np.where(over.any(axis=-1), np.where(at == 0, 0.0, inside), np.inf)


def halves(events: Sequence[str]) -> np.ndarray:
    """Return whether each component is of the half of the events to which a formula is fitted.

    Events are dealt out by their number of components, the largest first, each to the smaller half.
    """
    names, counts = np.unique(list(events), return_counts=True)
    fitted: set[str] = set()
    sizes = {True: 0, False: 0}
    for count, name in sorted(zip(-counts, names, strict=True)):
        is_fitted = sizes[True] <= sizes[False]
        sizes[is_fitted] -= count
        if is_fitted:
            fitted.add(name)
    return np.array([event in fitted for event in events])


def peaks(response: Response, period: int) -> RoofRuns:
    """Return the runs of a component on one roof."""
    slope, mu, s_ds = np.meshgrid(np.radians(SLOPES_DEG), MUS, S_DS_G, indexing="ij")
    return RoofRuns(
        ppa_mps2=response.ppa_mps2[period] * s_ds.ravel(),
        ppv_mps=response.ppv_mps[period] * s_ds.ravel(),
        slope_rad=slope.ravel(),
        mu=mu.ravel(),
        prd_m=response.prd_m[period].ravel().astype(np.float64),
    )


def equation(responses: Sequence[Response], events: Sequence[str]) -> dict[str, Any]:
    """Fit the formula to half of the events, and hold it and others against the other half."""
    is_fitted = halves(events)

    def parts(half: bool, roofs: Sequence[int]) -> Iterator[tuple[RoofRuns, Floats]]:
        for response, mine in zip(responses, is_fitted, strict=True):
            if mine == half:
                for period in roofs:
                    runs = peaks(response, period)
                    yield (
                        runs.only(runs.holds),
                        np.tile(S_DS_G, SLOPES_DEG.size * MUS.size)[runs.holds],
                    )

    everywhere = range(len(PERIODS_S))
    fitted = fit_equation(runs for runs, _ in parts(True, everywhere))
    swapped = fit_equation(runs for runs, _ in parts(False, everywhere))
    formulas = {
        "this formula": lambda runs, s_ds_g: fitted.prd_m(runs),
        "Saygili and Rathje 2008": lambda runs, s_ds_g: saygili_rathje_m(runs),
        "Ambraseys and Menu 1988": lambda runs, s_ds_g: ambraseys_menu_m(runs),
        "Jibson 2007": lambda runs, s_ds_g: jibson_m(runs),
        "60 in (S_DS − 0.4)²": lambda runs, s_ds_g: prescriptive_m(s_ds_g),
    }

    def held(half: bool, roofs: Sequence[int], name: str) -> Scatter:
        computed, by_formula = [], []
        for runs, s_ds_g in parts(half, roofs):
            value = formulas[name](runs, s_ds_g)
            computed.append(runs.prd_m[value > 0.0])
            by_formula.append(value[value > 0.0])
        return scatter(np.concatenate(computed), np.concatenate(by_formula))

    of_fitted = held(True, everywhere, "this formula")
    of_others = held(False, everywhere, "this formula")
    places = {"rock": [0], "roofs": [1, 2, 3], "all": list(everywhere)}
    medians = zip(
        PERIODS_S,
        np.median([one.ppa_mps2 / G for one in responses], axis=0),
        np.median([one.ppv_mps for one in responses], axis=0),
        strict=True,
    )
    return {
        "constants": asdict(fitted),
        "of_the_other_half": asdict(swapped),
        "every_run": asdict(pooled((of_fitted, of_others))),
        "fitted": asdict(of_fitted),
        "tried": {
            place: {name: asdict(held(False, roofs, name)) for name in formulas}
            for place, roofs in places.items()
        },
        "events_fitted": sorted({e for e, mine in zip(events, is_fitted, strict=True) if mine}),
        "events_tried": sorted({e for e, mine in zip(events, is_fitted, strict=True) if not mine}),
        "peaks": [
            {"period_s": period, "ppa_per_s_ds": float(ppa), "ppv_mps_per_s_ds_g": float(ppv)}
            for period, ppa, ppv in medians
        ],
    }


def main() -> None:
    """Write the tables beside this file and the figures of the documentation."""
    from projects.curves.figures import draw

    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("records", type=Path, help="folder `records` of USGS SLAMMER")
    parser.add_argument("--scheduler", default="", help="address of a Dask scheduler")
    parser.add_argument("--out", type=Path, default=HERE, help="folder of the tables")
    given = parser.parse_args()
    started = time.perf_counter()
    found = components(given.records)
    responses = respond_all(found, given.scheduler)
    prd_m = np.stack([response.prd_m for response in responses])
    ran_s = time.perf_counter() - started
    made = cases(prd_m)
    tables = {
        "curves": made,
        "least-friction": least_friction(made),
        "fragility": capacities(prd_m),
    }
    about = equation(responses, [one.event for one in found]) | {
        "components": len(found),
        "events": len({one.event for one in found}),
        "runs": prd_m.size,
        "without_value": int(np.isnan(prd_m).sum()),
        "still_sliding_at_the_end": sum(response.unfinished for response in responses),
        "wall_s": round(ran_s, 1),
        "peak_mb_of_a_process": _peak_mb(),
    }
    for name, table in tables.items():
        table.to_parquet(given.out / f"{name}.parquet", compression="zstd")
        table.reset_index().to_csv(given.out / f"{name}.csv", index=False, float_format="%.4g")
    (given.out / "equation.json").write_text(json.dumps(about, indent=1) + "\n")
    draw(tables, about, responses, [one.event for one in found], PICTURES)
    print(f"{prd_m.size:,} runs in {ran_s:.0f} s; {given.out}")


def _peak_mb() -> int:
    """Return the largest peak of memory of this process and the workers that have ended [MB]."""
    who = (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN)
    return max(resource.getrusage(each).ru_maxrss for each in who) // 1024


if __name__ == "__main__":
    main()
