"""Accuracy against run time: every method with each setting, timed and compared with the exact one.

Times are for one thread, warm, the least of several repeats, after the record is prepared and the
input checked. See `solver.rivals.methods` for the methods and their settings.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from functools import partial
from typing import Any

import numpy as np
import pandas as pd

from solver.model import STANDARD_GRAVITY_MPS2, SlideResult, Status
from solver.records.record import Record
from solver.rivals.methods import METHODS, AxisScene, Method
from solver.verification.evidence import percent_off
from solver.verification.scenes import CASES, Case, is_runnable
from solver.verification.study import clocked, minimum_seconds, prepared, run

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
