"""Accuracy against run time: every method with each setting, timed and compared with the exact one.

Times are for one thread, warm, the least of several repeats, after the record is prepared and the
input checked. See `solver.rivals.methods` for the methods and their settings.

Two axes: the same on one scene.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from functools import partial
from typing import Any

import numpy as np
import pandas as pd

from solver.kernels import rivals
from solver.model import STANDARD_GRAVITY_MPS2, Floats, Motion, Scene, SlideResult, Status, coulomb
from solver.records.record import Record
from solver.rivals import by_scipy
from solver.rivals.methods import METHODS, AxisScene, Method
from solver.sliding import two_axes
from solver.verification.evidence import percent_off
from solver.verification.study import (
    MODEL_CASES,
    TIGHT,
    Case,
    cut,
    minimum_seconds,
    prepared,
    run,
    runnable_methods,
    samples_of,
    scene_of,
)

NO_SAMPLES = np.empty((2, 0))


def work_points(runs: Iterable[tuple[Record, Case]], *, quick: bool) -> pd.DataFrame:
    """Run every method with each setting on every record and its case, see `settings`.

    Returns
    -------
    DataFrame
        A row for each run, with columns as in verification.csv and `setting`, NaN for a method
        without one. Errors are against the exact method, see `percent_off`; a failed run has no
        time and no errors, which are NaN.
    """
    return pd.DataFrame(
        {
            "method": method.name,
            "setting": value,
            "parameters": " ".join(f"{k}={v:g}" for k, v in parameters.items()),
            "record": record.name,
            "case": str(case),
            **_measured(record, case, method, parameters, exact),
        }
        for record, case in runs
        for exact in [run(record, case)]
        for method in runnable_methods()
        for value, parameters in settings(method, record, quick=quick)
    )


def settings(
    method: Method, record: Record, *, quick: bool
) -> Iterator[tuple[float, Mapping[str, float]]]:
    """Yield values of the setting with all parameters, every second one if quick."""
    if not method.knob:
        yield math.nan, method.parameters
    for value in method.sweep[::2] if quick else method.sweep:
        yield value, method.settings(value, record.dt_s, STANDARD_GRAVITY_MPS2)


def timed(method: Method, scene: AxisScene, parameters: Mapping[str, float]) -> float:
    """Return the least time of a run by a method on a prepared scene [s]."""
    return minimum_seconds(partial(method.follow, scene, parameters, NO_SAMPLES))


def _measured(
    record: Record, case: Case, method: Method, parameters: Mapping[str, float], exact: SlideResult
) -> dict[str, Any]:
    result, seconds = run(record, case, method.name, **parameters), math.nan
    # A run that gave up has taken a time that says nothing.
    if result.status not in (Status.DIVERGED, Status.UPLIFT):
        seconds = timed(method, prepared(record, case), parameters)
    return {
        "time per run [s]": seconds,
        "PRD error [m]": abs(result.prd_m - exact.prd_m),
        "PRD error [%]": float(percent_off(result.prd_m, exact.prd_m)),
        "residual error [m]": abs(result.residual_m - exact.residual_m),
        "residual error [%]": float(percent_off(result.residual_m, exact.residual_m)),
        "status": result.status,
    }


OURS = "Power series, event by event"
HOLDING = "Fixed steps, stick at velocity reversal"
CHATTERING = "Fixed steps, no stick"
REGULARIZED = METHODS["regularized"]

CASE = MODEL_CASES[1]
# Samples of the part of a motion, quick and full: SciPy takes up to a second per run.
SAMPLES = (101, 151)

TOLERANCES = (1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9)
OF_EVENTS = (1e-3, 1e-5, 1e-7, 1e-9, 1e-11)
"""Tolerances of SciPy's solvers with events."""
SUBSTEPS = (1, 4, 16, 64, 256, 1024)

_End = Callable[[], tuple[float, float]]
"""Runs a method and returns the final position, x and y [m]."""


def work(triple: Motion, *, quick: bool) -> pd.DataFrame:
    """Run every method with each of its settings on the strongest part of a motion.

    Returns
    -------
    DataFrame
        A row for each run, with columns as in verification.csv; the residual error is that of the
        position, in percent of the PRD. A failed run has no time and no error: NaN.
    """
    part = cut(triple, SAMPLES[not quick])
    scene = scene_of(part, CASE, coulomb(CASE.mu))
    truth = two_axes.run(scene, TIGHT)
    rows = []
    for method, setting, solve in _runs_in_plane(scene, OF_EVENTS[::2] if quick else OF_EVENTS):
        off_m = math.dist(solve(), (truth.residual_m, truth.residual_across_m))
        rows.append(
            {
                "method": method,
                "parameters": setting,
                "case": f"{part.id}, {CASE}",
                "time per run [s]": math.nan if math.isnan(off_m) else minimum_seconds(solve),
                "residual error [%]": 100.0 * off_m / truth.prd_m,
            }
        )
    return pd.DataFrame(rows)


def _runs_in_plane(scene: Scene, of_events: Sequence[float]) -> Iterator[tuple[str, str, _End]]:
    """Yield the name of a method and its setting with what runs it."""
    for tolerance in TOLERANCES:
        yield OURS, f"tol. {tolerance:g}", partial(_series, scene, tolerance)
    # Prepared before the clock starts, as the scene of our own method is.
    rows, dt, cosine = samples_of(scene), scene.dt_s, math.cos(scene.slope_rad)
    for method, holds in ((HOLDING, True), (CHATTERING, False)):
        for count in SUBSTEPS:
            fixed = partial(rivals.slide_fixed, rows, dt, cosine, count, holds)
            yield method, f"P = {count}", partial(_fixed, fixed)
    if not by_scipy.is_installed():
        return
    for v0 in REGULARIZED.sweep:
        smooth = partial(by_scipy.regularized, rows, dt, v0, REGULARIZED.parameters["tolerance"])
        yield REGULARIZED.label, f"{1e3 * v0:g} mm/s", partial(_end, smooth, cosine)
    for solver in ("DOP853", "RK45"):
        label = METHODS[f"events-{solver.lower()}"].label
        for tolerance in of_events:
            run = partial(by_scipy.plane, rows, dt, solver, tolerance)
            yield label, f"tol. {tolerance:g}", partial(_end, run, cosine)


def _series(scene: Scene, tolerance: float) -> tuple[float, float]:
    return two_axes.follow(scene, tolerance).end_m


def _fixed(run: Callable[[], tuple[float, float, float, float]]) -> tuple[float, float]:
    _, x, y, _ = run()
    return x, y


def _end(run: Callable[[], Floats], cosine: float) -> tuple[float, float]:
    x, y = run()[:2, -1].tolist()
    return cosine * x, y
