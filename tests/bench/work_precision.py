"""Claim: no method is faster than the exact one, and those as accurate are a thousand times slower.

Every method with its best settings on the same runs, in one process: the 18 real records of
pySLAMMER, a case each, where it is installed, else the records and cases of the manual; other
programs where they are installed; and two axes on one scene. Errors are relative to the exact
method, which `solver_accuracy` compares with 40-digit arithmetic. Draws the chart of the docs.
"""

import io
import itertools
import statistics
from collections.abc import Sequence
from dataclasses import asdict, fields
from functools import partial

import pandas as pd
from measure import ROOT, SMOKE, figure, seconds
from PIL import Image

from report.figures.base import png_bytes
from report.figures.work import overview
from solver.records.record import Record
from solver.rivals.methods import METHODS
from solver.verification import peers, workprecision
from solver.verification.evidence import PeerPoint
from solver.verification.study import Case, compared_runs, own_triples, prepared, real_records
from solver.verification.workprecision import NO_SAMPLES, work_points

PICTURE = ROOT / "docs" / "pictures" / "work-precision.png"
FLOOR_PERCENT = 1e-13
"""Error at which the exact method is drawn, see `solver_accuracy`."""


def printed(name: str, times_s: pd.Series, errors: pd.Series) -> None:
    """Print the median time of a method or program, with its errors."""
    words = f"ms; error of the PRD {errors.median():.2g} % in the median, {errors.max():.3g} %"
    figure(name, float(times_s.median()) * 1e3, f"{words} at most")


def ratio(runs: Sequence[tuple[Record, Case]]) -> float:
    """Median over the runs of the time of the faster solver with events over that of `exact`.

    Processor time, which other programs change less than the times of the chart.
    """
    ratios = []
    for scene in itertools.starmap(prepared, runs):
        exact, *events = (
            partial(METHODS[name].follow, scene, {}, NO_SAMPLES)
            for name in ("exact", "events-dop853", "events-rk45")
        )
        exact_s, *events_s = seconds(
            lambda run=exact: [run() for _ in range(200)], *events, repeats=1
        )
        ratios.append(200.0 * min(events_s) / exact_s)
    return statistics.median(ratios)


def one_axis() -> None:
    """Print time and error of each method and program, and draw them."""
    runs, source = compared_runs(SMOKE), "real" if real_records() and not SMOKE else "made"
    figure("runs of each method", len(runs), f"under {source} records")
    found = work_points(runs, quick=SMOKE)
    time, error = "time per run [s]", "PRD error [%]"
    for (name, value), own in found.groupby(["method", "setting"], sort=False, dropna=False):
        method = METHODS[name]
        if method.knob in ("", "velocity_mps") or value == method.parameters[method.knob]:
            at = f", {method.knob} = {value:g}" if method.knob else ""
            printed(f"{method.label}{at}", own[time], own[error])
    figure("the faster of SciPy's with events relative to exact", ratio(runs))
    judges = {peers.ONE_AXIS: peers.JUDGES[peers.ONE_AXIS]}
    points = list(peers.peer_points(judges, runs, (), quick=SMOKE))
    judged = pd.DataFrame(map(asdict, points), columns=[each.name for each in fields(PeerPoint)])
    for name, own in judged.groupby("peer", sort=False):
        printed(f"{name} {own['version'].iloc[0]}", own["seconds"], own["prd_error_percent"])
    if not SMOKE:
        picture = Image.open(io.BytesIO(overview(found, FLOOR_PERCENT, points, png_bytes)))
        picture.convert("RGB").quantize(64).save(PICTURE, optimize=True)


def two_axes() -> None:
    """Print time and error of each method at its finest setting, on one scene."""
    found = workprecision.work(own_triples(quick=SMOKE)[0], quick=SMOKE)
    for run in found.groupby("method", sort=False).tail(1).to_dict("records"):
        words = f"ms; error of the position {run['residual error [%]']:.2g} % of the PRD"
        name = f"two axes: {run['method']}, {run['parameters']}"
        figure(name, run["time per run [s]"] * 1e3, words)


if __name__ == "__main__":
    one_axis()
    two_axes()
