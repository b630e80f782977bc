"""Accuracy against run time: every method with each setting, timed and compared with the exact one.

Times are for one thread, warm, the least of several repeats, after the record is prepared and the
input checked. See `solver.rivals.methods` for the methods and their settings.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from functools import partial

import numpy as np

from solver.model import STANDARD_GRAVITY_MPS2, SlideResult, Status
from solver.records.record import Record
from solver.rivals.methods import METHODS, AxisScene, Method
from solver.verification.evidence import WorkPoint, percent_off
from solver.verification.scenes import CASES, Case, is_runnable
from solver.verification.study import clocked, minimum_seconds, prepared, run

SLOW_CASES = 2
"""Number of cases of each record for a method that takes a second per run."""

NO_SAMPLES = np.empty((2, 0))


def work_points(records: Sequence[Record], *, quick: bool) -> Iterator[WorkPoint]:
    """Run every method with each setting on every record and case, see `settings`."""
    cases = CASES[:3] if quick else CASES
    methods = [method for method in METHODS.values() if is_runnable(method.name)]
    for record in records:
        for k, case in enumerate(cases):
            exact = run(record, case)
            for method in methods:
                if is_slow(method) and k >= SLOW_CASES:
                    continue
                for value, parameters in settings(method, record, quick=quick):
                    yield _point(record, case, method, value, parameters, exact)


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


def _point(
    record: Record,
    case: Case,
    method: Method,
    value: float,
    parameters: Mapping[str, float],
    exact: SlideResult,
) -> WorkPoint:
    result, seconds = clocked(partial(run, record, case, method.name, **parameters))
    if result.status in (Status.DIVERGED, Status.UPLIFT):
        seconds = math.nan
    elif not is_slow(method):
        seconds = timed(method, prepared(record, case), parameters)
    return WorkPoint(
        method=method.name,
        setting=value,
        parameters=parameters,
        record=record.name,
        scene=str(case),
        seconds=seconds,
        prd_error_m=abs(result.prd_m - exact.prd_m),
        prd_error_percent=float(percent_off(result.prd_m, exact.prd_m)),
        residual_error_m=abs(result.residual_m - exact.residual_m),
        residual_error_percent=float(percent_off(result.residual_m, exact.residual_m)),
        status=result.status,
    )
