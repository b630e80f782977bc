"""Models 1 and 2: one block along the slope, by the exact method or another one.

Samples of 0, 4, -4, 0 m/s2 at 0.1 s move a block with mu = 0.2 on a flat roof 4.9 mm, in two slips.

Checks no input (`solver.sliding.arguments`) and computes no physics (`solver.kernels.one_axis`,
`solver.sliding.method`). Read `run` first.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from solver.forces import components
from solver.kernels import one_axis as kernel
from solver.model import Event, EventKind, Floats, Scene, SlideHistory, SlideResult, Status
from solver.records.record import NO_RECORD
from solver.sliding.method import (
    EXACT,
    AxisScene,
    Method,
    Outcome,
    Parameters,
    minimum_normal,
)

_NO_HISTORY, _NO_EVENTS = np.empty((2, 0)), np.empty((0, 3))


class RecordBounds(NamedTuple):
    """`kernel.bounds` of the three records of a scene; of any slope, friction and scale."""

    x: Floats
    y: Floats
    z: Floats


def bounds_of(scene: Scene) -> RecordBounds:
    """Return the bounds of the records of a scene; across and up of zeros where there is none."""
    return RecordBounds(*map(kernel.bounds, components(scene)))


# Positional only, so that a user's method may have a parameter named `scene`.
def run(scene: Scene, method: Method = EXACT, /, **parameters: float) -> SlideResult:
    """Slide a checked scene along the slope by a method; cross-slope shaking is neglected."""
    return _run(method, parameters, prepared(scene), _NO_HISTORY)[0]


def run_bounded(scene: Scene, bounds: RecordBounds) -> SlideResult:
    """Return `run` of a scene with known bounds, by the exact method."""
    # None, not zeros: the kernel is compiled once more for it (`slide_exact`).
    az, z = (scene.az_mps2, bounds.z) if scene.az_mps2.size else (None, None)
    n_min_g, cs, error_m, *run = kernel.slide_checked(
        scene.ax_mps2,
        az,
        bounds.x,
        z,
        scene.dt_s,
        scene.slope_rad,
        scene.friction.mu_slow,
        scene.g_mps2,
        scene.scale,
    )
    outcome = Outcome(True, *run)
    # One comparison for both: infinity is not below infinity, nor is NaN.
    if n_min_g < 0.0 or not outcome.s_max - outcome.s_min < math.inf:
        # Tells what gives no displacement.
        return _run(EXACT, {}, prepared(scene, bounds), _NO_HISTORY)[0]
    return result_of(outcome, cs, n_min_g, error_m)


def run_history(scene: Scene, method: Method = EXACT, /, **parameters: float) -> SlideHistory:
    """Return the displacement history of `run`; only the exact method gives events."""
    samples = np.full((2, scene.ax_mps2.size), np.nan)
    result, events = _run(method, parameters, prepared(scene), samples)
    cs = math.cos(scene.slope_rad)
    return SlideHistory(
        t_s=sample_times(scene),
        u_m=samples[0],
        v_mps=samples[1],
        across_m=NO_RECORD,
        across_mps=NO_RECORD,
        events=tuple(
            Event(t_s=t, kind=EventKind.STOP if kind == kernel.STOP else EventKind.SLIP, u_m=cs * s)
            for t, kind, s in events.tolist()
        ),
        result=result,
    )


def rounding(scene: AxisScene) -> float:
    """Return the allowance for rounding error in a displacement by the method `exact` [m]."""
    c, z = scene, scene.z if scene.az.size else None
    error_m: float = kernel.rounding(c.x, z, c.dt, c.sn, c.cs, c.mu, c.g, c.scale, c.ax.size)
    return error_m


def _run(
    method: Method, parameters: Parameters, scene: AxisScene, samples: Floats
) -> tuple[SlideResult, Floats]:
    """Run a scene, and return its events as well, if `samples` is of shape (2, n).

    It is filled with u and u'; of shape (2, 0) it is not.
    """
    # Before any method: all of them assume N >= 0 throughout.
    n_min_g, t_uplift = minimum_normal(scene)
    if n_min_g < 0.0:
        return without_displacement(Status.UPLIFT, n_min_g, t_uplift), _NO_EVENTS
    outcome = method.follow(scene, dict(method.parameters) | dict(parameters), samples)
    if not (outcome.followed and math.isfinite(outcome.s_max - outcome.s_min)):
        samples[:] = np.nan
        return without_displacement(Status.DIVERGED, n_min_g, math.nan), _NO_EVENTS
    # Methods give s and s' along the slope; displacements are horizontal, u = s cos(theta).
    samples *= scene.cs
    # Not of a method that runs the exact one in another scene: its events are of that scene.
    error_m, events = (
        (rounding(scene), outcome.events) if method is EXACT else (math.nan, _NO_EVENTS)
    )
    return result_of(outcome, scene.cs, n_min_g, error_m), events


def result_of(outcome: Outcome, cs: float, n_min_g: float, error_m: float) -> SlideResult:
    """Return the result of a run that has a displacement; an outcome is along the slope."""
    return SlideResult(
        # Exactly zero: methods set the speed at a stop.
        status=Status.OK if outcome.w_end == 0.0 else Status.SLIDING_AT_END,
        prd_m=cs * max(outcome.s_max, -outcome.s_min),
        residual_m=cs * outcome.s_end,
        down_m=cs * outcome.s_max,
        up_m=cs * abs(outcome.s_min),
        across_m=0.0,
        residual_across_m=0.0,
        t_prd_s=outcome.t_peak,
        n_stops=outcome.n_stops,
        n_min_g=n_min_g,
        t_uplift_s=math.nan,
        end_speed_mps=cs * outcome.w_end,
        peak_speed_mps=outcome.w_max,
        error_m=error_m,
    )


def without_displacement(status: Status, n_min_g: float, t_uplift: float) -> SlideResult:
    """Return the result of a run that gives no displacement."""
    return SlideResult(
        status=status,
        prd_m=math.nan,
        residual_m=math.nan,
        down_m=math.nan,
        up_m=math.nan,
        across_m=math.nan,
        residual_across_m=math.nan,
        t_prd_s=math.nan,
        n_stops=0,
        n_min_g=n_min_g,
        t_uplift_s=t_uplift,
        end_speed_mps=math.nan,
        peak_speed_mps=math.nan,
        error_m=math.nan,
    )


def sample_times(scene: Scene) -> Floats:
    """Return the times of the samples [s]."""
    return np.arange(scene.ax_mps2.size, dtype=np.float64) * scene.dt_s


def prepared(scene: Scene, bounds: RecordBounds | None = None) -> AxisScene:
    """Return a scene in the notation of the one-axis kernels."""
    return AxisScene(
        ax=scene.ax_mps2,
        x=bounds.x if bounds else kernel.bounds(scene.ax_mps2),
        az=scene.az_mps2,
        # Without a vertical component, `bounds_of` has bounds of zeros, but `AxisScene` requires
        # those of an empty record.
        z=bounds.z if bounds and scene.az_mps2.size else kernel.bounds(scene.az_mps2),
        dt=scene.dt_s,
        sn=math.sin(scene.slope_rad),
        cs=math.cos(scene.slope_rad),
        # One axis neglects a friction law and uses the low-velocity coefficient.
        mu=scene.friction.mu_slow,
        g=scene.g_mps2,
        scale=scene.scale,
    )
