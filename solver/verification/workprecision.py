"""Accuracy against run time: every method with each setting, timed and compared with the exact one.

Times are for one thread, warm, the least of several repeats, after the record is prepared and the
input checked. See `solver.rivals.methods` for the methods and their settings.

Two axes: accuracy against run time, and the behavior of each method after a block has stopped.
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
from solver.rivals.methods import METHODS, AxisScene, Method
from solver.sliding import two_axes
from solver.verification import plane_scipy
from solver.verification.evidence import percent_off
from solver.verification.model_checks import stopped_scene
from solver.verification.plane_scipy import Integrated, Solver, samples_of
from solver.verification.scenes import CASES, Case, is_runnable
from solver.verification.study import (
    MODEL_CASES,
    TIGHT,
    clocked,
    cut,
    minimum_seconds,
    prepared,
    run,
    scene_of,
)

SLOW_CASES = 2
"""Number of cases of each record for a method that takes a second per run."""

NO_SAMPLES = np.empty((2, 0))


def work_points(records: Sequence[Record], *, quick: bool) -> pd.DataFrame:
    """Run every method with each setting on every record and case, see `settings`.

    Returns
    -------
    DataFrame
        A row for each run, with columns as in verification.csv and `setting`, NaN for a method
        without one. Errors are against the exact method, see `percent_off`; a failed run has no
        time and no errors, which are NaN.
    """
    return pd.DataFrame(list(_runs(records, CASES[:3] if quick else CASES, quick=quick)))


def _runs(
    records: Sequence[Record], cases: Sequence[Case], *, quick: bool
) -> Iterator[dict[str, Any]]:
    methods = [method for method in METHODS.values() if is_runnable(method.name)]
    for record in records:
        for k, case in enumerate(cases):
            exact = run(record, case)
            for method in methods:
                if is_slow(method) and k >= SLOW_CASES:
                    continue
                for value, parameters in settings(method, record, quick=quick):
                    yield {
                        "method": method.name,
                        "setting": value,
                        "parameters": " ".join(f"{k}={v:g}" for k, v in parameters.items()),
                        "record": record.name,
                        "case": str(case),
                        **_measured(record, case, method, parameters, exact),
                    }


def is_slow(method: Method) -> bool:
    """Whether the method runs in plain Python."""
    return method.name == "regularized"


def settings(
    method: Method, record: Record, *, quick: bool
) -> Iterator[tuple[float, Mapping[str, float]]]:
    """Yield values of the setting with all parameters, every second one if quick."""
    if not method.knob:
        yield math.nan, method.parameters
        return
    sweep = method.sweep[::2] if quick else method.sweep
    if is_slow(method):
        sweep = method.sweep[:2] if quick else method.sweep[:5]
    for value in sweep:
        yield value, method.settings(value, record.dt_s, STANDARD_GRAVITY_MPS2)


def timed(method: Method, scene: AxisScene, parameters: Mapping[str, float]) -> float:
    """Return the least time of a run by a method on a prepared scene [s]."""
    return minimum_seconds(lambda: method.follow(scene, parameters, NO_SAMPLES))


def _measured(
    record: Record,
    case: Case,
    method: Method,
    parameters: Mapping[str, float],
    exact: SlideResult,
) -> dict[str, Any]:
    result, seconds = clocked(partial(run, record, case, method.name, **parameters))
    if result.status in (Status.DIVERGED, Status.UPLIFT):
        seconds = math.nan
    elif not is_slow(method):
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

CASE = MODEL_CASES[1]
SAMPLES = (101, 151)
"""Samples of the part of a motion, quick and full: SciPy takes a second per run."""

TOLERANCES = (1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9)
SUBSTEPS = (1, 4, 16, 64, 256, 1024)

_BySciPy = Sequence[tuple[Solver, float, tuple[float, ...]]]

SCIPY: _BySciPy = (
    ("RK45", 1e-2, (1e-3, 1e-4, 1e-5, 1e-6)),
    ("RK45", 1e-3, (1e-3, 1e-4, 1e-5, 1e-6)),
    ("DOP853", 1e-3, (1e-3, 1e-4, 1e-5, 1e-6)),
    ("Radau", 1e-3, (1e-3, 1e-4, 1e-5)),
    ("Radau", 1e-4, (1e-4, 1e-5)),
)
"""Solver, v0 [m/s] of the friction mu N tanh(w / v0), relative tolerances."""

STOPS_BY_SCIPY: _BySciPy = (
    ("RK45", 1e-2, (1e-4,)),
    ("RK45", 1e-3, (1e-6,)),
    ("Radau", 1e-3, (1e-6,)),
    ("Radau", 1e-5, (1e-6,)),
    ("DOP853", 0.0, (1e-6,)),
)

_Run = tuple[str, str, Callable[[], Integrated]]


def work(triple: Motion, *, quick: bool) -> pd.DataFrame:
    """Run every method with each of its settings on the strongest part of a motion.

    Returns
    -------
    DataFrame
        A row for each run, with columns as in verification.csv, the `steps` (for SciPy, evaluations
        of the right-hand side), and position error and velocity at the end. The PRD error of the
        power series is its largest at a sample. A failed run has no time and no errors: NaN.
    """
    part = cut(triple, SAMPLES[not quick])
    scene = scene_of(part, CASE, coulomb(CASE.mu))
    solvers = (
        [(solver, v0, tolerances[:2]) for solver, v0, tolerances in SCIPY[:3]] if quick else SCIPY
    )
    steps = {f"P = {count}": count for count in SUBSTEPS}
    measured = _measured_in_plane(scene, _runs_in_plane(scene, TOLERANCES, steps, solvers))
    # Their errors of the PRD may be zero by chance.
    largest = [_largest_percent(scene, tolerance) for tolerance in TOLERANCES]
    measured.loc[measured["method"] == OURS, "PRD error [%]"] = largest
    return measured.assign(case=f"{part.id}, {CASE}")


def stops() -> pd.DataFrame:
    """Run the block that stops under a transverse acceleration and rests for 1.8 s, every method.

    Its position is known in closed form, see `model_checks.stopped_scene` and its checks.
    """
    scene = stopped_scene()
    steps = {f"{1e3 * scene.dt_s / count:g} ms": count for count in (10, 100, 1000)}
    return _measured_in_plane(scene, _runs_in_plane(scene, (1e-4, 1e-6), steps, STOPS_BY_SCIPY))


def _measured_in_plane(scene: Scene, runs: Iterable[_Run]) -> pd.DataFrame:
    truth = two_axes.run(scene, TIGHT)
    place = truth.residual_m, truth.residual_across_m
    rows = []
    for method, setting, solve in runs:
        (prd_m, end_m, speed_mps, steps), seconds = clocked(solve)
        if math.isnan(prd_m):
            seconds = math.nan
        elif not method.startswith("SciPy"):  # the first call compiles
            seconds = minimum_seconds(solve)
        rows.append(
            {
                "method": method,
                "parameters": setting,
                "time per run [s]": seconds,
                "PRD error [%]": 100.0 * abs(prd_m - truth.prd_m) / truth.prd_m,
                "steps": steps,
                "position error [m]": math.dist(end_m, place),
                "final velocity [m/s]": speed_mps,
            }
        )
    return pd.DataFrame(rows)


def _largest_percent(scene: Scene, tolerance: float) -> float:
    """Return the largest error at the samples, in percent of the PRD."""
    truth, seen = (two_axes.run_history(scene, each) for each in (TIGHT, tolerance))
    off_m = max(
        abs(seen.result.prd_m - truth.result.prd_m),
        float(abs(seen.u_m - truth.u_m).max()),
        float(abs(seen.across_m - truth.across_m).max()),
    )
    return 100.0 * off_m / truth.result.prd_m


def _runs_in_plane(
    scene: Scene, tolerances: Sequence[float], steps: dict[str, int], solvers: _BySciPy
) -> Iterator[_Run]:
    """Yield every method with each of its settings."""
    for tolerance in tolerances:
        yield OURS, f"tol. {tolerance:g}", partial(_series, scene, tolerance)
    rows, cosine = samples_of(scene), math.cos(scene.slope_rad)
    for method, holds in ((HOLDING, True), (CHATTERING, False)):
        for setting, count in steps.items():
            yield method, setting, partial(_fixed, rows, scene.dt_s, cosine, count, holds)
    if not plane_scipy.is_installed():
        return
    for solver, v0_mps, its_tolerances in solvers:
        friction = f"v0 = {1e3 * v0_mps:g} mm/s" if v0_mps else "Coulomb, no events"
        for tolerance in its_tolerances:
            run = partial(plane_scipy.regularized, scene, solver, v0_mps, tolerance)
            yield f"SciPy {solver}, {friction}", f"tol. {tolerance:g}", run


def _series(scene: Scene, tolerance: float) -> Integrated:
    outcome = two_axes.follow(scene, tolerance)
    speed_mps = math.hypot(*outcome.end_mps)
    return Integrated(outcome.prd_m, outcome.end_m, speed_mps, outcome.n_steps)


def _fixed(rows: Floats, dt_s: float, cosine: float, substeps: int, holds: bool) -> Integrated:
    prd_m, x, y, speed = rivals.slide_fixed(rows, dt_s, cosine, substeps, holds)
    return Integrated(prd_m, (x, y), speed, substeps * (len(rows) - 1))
