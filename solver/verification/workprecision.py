"""Accuracy against run time: every method with each setting, timed and compared with the exact one.

Times are of the processor, warm, the least of several repeats, after the input is checked: `TIME`
with the record prepared, as one of many runs of it, and `SINGLE` with what the method prepares. See
`solver.rivals.methods` for the methods and their settings.

One axis is compared with the exact method (`work_points`), two axes with themselves at the tightest
tolerance (`work`).
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable, Iterable, Iterator, Mapping
from functools import partial
from typing import Any

import numpy as np
import pandas as pd

from solver.kernels import rivals, runge_kutta
from solver.kernels.one_axis import bounds
from solver.model import STANDARD_GRAVITY_MPS2, Floats, Motion, Scene, SlideResult, Status, coulomb
from solver.records.record import Record
from solver.rivals import by_scipy
from solver.rivals.methods import METHODS
from solver.sliding import two_axes
from solver.sliding.method import AxisScene, Method
from solver.sliding.one_axis import RecordBounds, bounds_of
from solver.verification.evidence import percent_off
from solver.verification.study_cases import (
    CLOCK,
    MODEL_CASES,
    TIGHT,
    Case,
    clocked,
    prepared,
    processor_seconds,
    run,
    runnable_methods,
    samples_of,
    scene_of,
)
from solver.verification.verification_motions import cut

NO_SAMPLES = np.empty((2, 0))
TIME, SINGLE = "time per run [s]", "time of a single run [s]"
RUN = ["record", "case"]

ROUNDING_PERCENT = 1e-10
"""Errors that rounding explains: a method with no more is as accurate as any."""


def work_points(runs: Iterable[tuple[Record, Case]], *, quick: bool) -> pd.DataFrame:
    """Run every method with each setting on every record and its case, see `settings`.

    Returns
    -------
    DataFrame
        A row for each run, with columns as in verification.csv and `setting`, NaN for a method
        without one. Errors are against the exact method, see `percent_off`; a failed run has no
        time and no errors, which are NaN.
    """
    rows = []
    for record, case in runs:
        exact = run(record, case)
        for method in runnable_methods():
            for value, parameters in settings(method, record, quick=quick):
                row = {
                    "method": method.name,
                    "setting": value,
                    "parameters": " ".join(f"{k}={v:g}" for k, v in parameters.items()),
                    "record": record.name,
                    "case": str(case),
                }
                rows.append(row | _measured(record, case, method, parameters, exact))
    return pd.DataFrame(rows)


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
    return processor_seconds(partial(method.follow, scene, parameters, NO_SAMPLES))


def _measured(
    record: Record, case: Case, method: Method, parameters: Mapping[str, float], exact: SlideResult
) -> dict[str, Any]:
    result, seconds = run(record, case, method.name, **parameters), math.nan
    prepares_s = 0.0
    # A run that gave up has taken a time that says nothing.
    if result.status not in (Status.DIVERGED, Status.UPLIFT):
        scene = prepared(record, case)
        seconds = timed(method, scene, parameters)
        if method.name == "exact":  # bounds of the record, and those of no vertical one
            prepares_s = sum(processor_seconds(partial(bounds, a)) for a in (scene.ax, scene.az))
    return {
        TIME: seconds,
        SINGLE: seconds + prepares_s,
        "PRD error [m]": abs(result.prd_m - exact.prd_m),
        "PRD error [%]": float(percent_off(result.prd_m, exact.prd_m)),
        "residual error [m]": abs(result.residual_m - exact.residual_m),
        "residual error [%]": float(percent_off(result.residual_m, exact.residual_m)),
        "status": result.status,
    }


def times_longer(runs: pd.DataFrame, ours: pd.DataFrame, error: str, time: str = TIME) -> float:
    """Return the least time of runs as accurate as ours, over that of ours: median of the cases."""
    both = runs.merge(ours, on=RUN, suffixes=("", " of ours"))
    # If our error happened to be zero, no rival would be as accurate.
    near = both[both[error] <= both[f"{error} of ours"].clip(ROUNDING_PERCENT)]
    ratios = near[time] / near[f"{time} of ours"]
    return float(ratios.groupby([near[name] for name in RUN]).min().median())


OURS = "power series, by events"
FIXED = "fixed steps, stick at reversal"
REGULARIZED = METHODS["regularized"]

# Samples of the part of a motion if quick: SciPy takes seconds for a whole one.
SAMPLES = 101

TOLERANCES = (1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9)
OF_EVENTS = (1e-3, 1e-5, 1e-7, 1e-9, 1e-11)
"""Tolerances of the compiled solvers with events."""
OF_SCIPY = 1e-9
"""That of SciPy's."""
SUBSTEPS = (1, 4, 16, 64, 256, 1024)

_End = Callable[[], tuple[float, float]]
"""Runs a method and returns the final position, x and y [m]."""


def work(triples: Iterable[Motion], *, quick: bool) -> pd.DataFrame:
    """Run every method with each of its settings on every motion, or its strongest part if quick.

    Returns
    -------
    DataFrame
        A row for each run, as those of `work_points`; the residual error is that of the position,
        in percent of the PRD. A failed run has no time and no error: NaN.
    """
    rows = []
    for triple, case in itertools.product(triples, MODEL_CASES):
        part = cut(triple, SAMPLES) if quick else triple
        scene = scene_of(part, case, coulomb(case.mu))
        truth = two_axes.run(scene, TIGHT)
        bounds_s, rows_s = (processor_seconds(partial(f, scene)) for f in (bounds_of, samples_of))
        # Interpreted steps take half a minute for a whole motion: they are run in one case of it.
        interpreted = quick or case == MODEL_CASES[0]
        for method, setting, words, solve in _runs_in_plane(scene, interpreted=interpreted):
            end, seconds = clocked(solve, CLOCK)
            off_m = math.dist(end, (truth.residual_m, truth.residual_across_m))
            # One run is enough where it takes seconds.
            if method != SCIPY:
                seconds = math.nan if math.isnan(off_m) else processor_seconds(solve)
            rows.append(
                {
                    "method": method,
                    "setting": setting,
                    "parameters": words,
                    "record": part.id,
                    "case": str(case),
                    TIME: seconds,
                    SINGLE: seconds + (bounds_s if method == OURS else rows_s),
                    "residual error [%]": 100.0 * off_m / truth.prd_m,
                }
            )
    return pd.DataFrame(rows)


SCIPY = METHODS["events-dop853"].label


def _runs_in_plane(scene: Scene, *, interpreted: bool) -> Iterator[tuple[str, float, str, _End]]:
    """Yield each method's name and setting with a callable that runs it, once prepared."""
    bounds, rows = bounds_of(scene), samples_of(scene)
    dt, cosine = scene.dt_s, math.cos(scene.slope_rad)
    for tolerance in TOLERANCES:
        yield OURS, tolerance, f"tol. {tolerance:g}", partial(_series, scene, tolerance, bounds)
    for count in SUBSTEPS:
        fixed = partial(rivals.slide_fixed, rows, dt, cosine, count)
        yield FIXED, count, f"P = {count}", partial(_place, fixed)
    for name, order in (("compiled-dop853", 8), ("compiled-rk45", 5)):
        for tolerance in OF_EVENTS:
            steps = partial(runge_kutta.slide_plane, rows, dt, cosine, order, tolerance)
            yield METHODS[name].label, tolerance, f"tol. {tolerance:g}", partial(_place, steps)
    if not by_scipy.is_installed():
        return
    for v0 in REGULARIZED.sweep:
        smooth = partial(by_scipy.regularized, rows, dt, v0, REGULARIZED.parameters["tolerance"])
        yield REGULARIZED.label, v0, f"{1e3 * v0:g} mm/s", partial(_end, smooth, cosine)
    if interpreted:
        plane = partial(by_scipy.plane, rows, dt, "DOP853", OF_SCIPY)
        yield SCIPY, OF_SCIPY, f"tol. {OF_SCIPY:g}", partial(_end, plane, cosine)


def _series(scene: Scene, tolerance: float, bounds: RecordBounds) -> tuple[float, float]:
    result = two_axes.run_bounded(scene, tolerance, bounds)
    return result.residual_m, result.residual_across_m


def _place(run: Callable[[], tuple[float, float, float, float]]) -> tuple[float, float]:
    _, x, y, _ = run()
    return x, y


def _end(run: Callable[[], Floats], cosine: float) -> tuple[float, float]:
    x, y = run()[:2, -1].tolist()
    return cosine * x, y
