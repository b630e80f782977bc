"""Models 3 and 4: a block in two axes, friction constant or by velocity, to a tolerance.

Samples of 0, 4, -4, 0 m/s2 along and half as much across, at 0.1 s, move a block with mu = 0.2 on a
flat roof 7.4 mm, and leave it 2.2 mm along and 1.1 mm across.

Computes no physics itself (see `solver.kernels.two_axes`) and checks no input
(`solver.sliding.arguments` does). Read `solver.model.Scene`, then `follow`.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from solver.forces import components
from solver.kernels import two_axes as kernel
from solver.model import Event, EventKind, Floats, Scene, SlideHistory, SlideResult, Status
from solver.sliding.method import minimum_normal
from solver.sliding.one_axis import (
    RecordBounds,
    bounds_of,
    prepared,
    sample_times,
    without_displacement,
)

DEFAULT_TOLERANCE = 1e-6
# Smallest and largest tolerance that `follow` accepts.
TOLERANCES = (1e-10, 1e-2)

# Tolerance of a step / tolerance of the run. With this ratio the error bound is below the tolerance
# of the run at the first attempt except for long slips.
_SHARE = 1.5e-3
# Largest tolerance of a step: above it the bound is missed at the first attempt so often that a run
# to 0.01 takes 1.4 times as long (21 runs of the example, 1.35 instead of 0.95 ms each).
_LARGEST_STEP = 4.5e-6
# The result of the last attempt is returned with the error that it reached.
_ATTEMPTS = 5

# Limit on the steps of a run: a fixed number and an addition per sample. A record of 30 s at
# 0.005 s takes about 5,000. The limit corresponds to about half a second of computing time, which
# only a friction law that reaches its final value within a micrometer per second approaches.
_MOST_STEPS, _MOST_STEPS_OF_SAMPLE = 200_000, 20

_STATUSES = {
    kernel.FOLLOWED: Status.OK,
    kernel.TOO_MANY_STEPS: Status.STEP_LIMIT,
    kernel.NOT_FINITE: Status.DIVERGED,
}

_NO_EVENTS, _NO_HISTORY = np.empty((0, 4)), np.empty((4, 0))

# Step tolerance of the finer run / that of the run, where the difference of the two estimates the
# error because no bound holds.
_FINER = 0.03
_SAFE = 16.0  # error / difference of two runs: of 300,000 random scenes the worst needed 7.2


@dataclass(frozen=True, slots=True, kw_only=True)
class TwoAxesOutcome:
    """The motion of a block in plan, relative to the roof: x downslope, y cross-slope.

    Unless the status is `Status.OK` the numbers are meaningless.
    """

    status: Status
    prd_m: float  # largest distance from the start
    t_prd_s: float
    down_m: float  # largest excursion toward +x, then -x, +y and -y, all >= 0
    up_m: float
    left_m: float
    right_m: float
    end_m: tuple[float, float]  # at the end of the record, x and y
    end_mps: tuple[float, float]
    peak_mps: float  # along the surface of the roof
    # Of any position from the exact motion under the interpolated record: a bound if friction is
    # monotone, otherwise an estimate, `_SAFE` times the difference between runs at two tolerances,
    # at least rounding error. None sees a stop that both runs take and an exact block would not.
    error_m: float
    n_stops: int
    n_events: int
    n_steps: int
    step_tolerance: float  # of the last attempt

    @property
    def places(self) -> tuple[float, ...]:
        """PRD, the four excursions and the displacement at the end, x and y [m]."""
        return self.prd_m, self.down_m, self.up_m, self.left_m, self.right_m, *self.end_m


def run(scene: Scene, tolerance: float = DEFAULT_TOLERANCE) -> SlideResult:
    """Slide a checked scene in two axes, to a tolerance relative to the PRD."""
    return run_bounded(scene, tolerance, bounds_of(scene))


def run_bounded(scene: Scene, tolerance: float, bounds: RecordBounds) -> SlideResult:
    """Return `run` of a scene with known bounds."""
    return _run_checked(scene, tolerance, bounds)[0]


def _run_checked(
    scene: Scene, tolerance: float, bounds: RecordBounds
) -> tuple[SlideResult, TwoAxesOutcome | None]:
    """Return the result and the outcome behind it; None if that gives no displacement."""
    # N does not depend on ay, so it is the same as in one axis.
    n_min_g, t_uplift = minimum_normal(prepared(scene, bounds))
    if n_min_g < 0.0:
        return without_displacement(Status.UPLIFT, n_min_g, t_uplift), None
    outcome = _followed(scene, tolerance, bounds)
    if outcome.status is not Status.OK:
        return without_displacement(outcome.status, n_min_g, math.nan), None
    speed = math.hypot(*outcome.end_mps)
    result = SlideResult(
        status=Status.OK if speed == 0.0 else Status.SLIDING_AT_END,
        prd_m=outcome.prd_m,
        residual_m=outcome.end_m[0],
        down_m=outcome.down_m,
        up_m=outcome.up_m,
        across_m=max(outcome.left_m, outcome.right_m),
        residual_across_m=outcome.end_m[1],
        t_prd_s=outcome.t_prd_s,
        n_stops=outcome.n_stops,
        n_min_g=n_min_g,
        t_uplift_s=math.nan,
        end_speed_mps=speed,
        peak_speed_mps=outcome.peak_mps,
        error_m=outcome.error_m,
    )
    return result, outcome


def run_history(scene: Scene, tolerance: float = DEFAULT_TOLERANCE) -> SlideHistory:
    """Return the displacement history of `run`."""
    result, outcome = _run_checked(scene, tolerance, bounds_of(scene))
    samples = np.full((4, scene.ax_mps2.size), np.nan)
    events: tuple[Event, ...] = ()
    if outcome is not None:
        samples, events = follow_history(scene, outcome)
    return SlideHistory(
        t_s=sample_times(scene),
        u_m=samples[0],
        v_mps=samples[2],
        across_m=samples[1],
        across_mps=samples[3],
        events=events,
        result=result,
    )


def follow(scene: Scene, tolerance: float = DEFAULT_TOLERANCE) -> TwoAxesOutcome:
    """Compute the motion of a block to a tolerance relative to its PRD.

    Assumes that the normal force never falls below zero (`solver.kernels.one_axis.minimum_normal`).
    The tolerance, within `TOLERANCES`, is relative to the PRD or to one micrometer, whichever is
    larger: the run is repeated with finer steps until `error_m` is below it or rounding error
    prevents that.
    """
    return _followed(scene, tolerance, bounds_of(scene))


def _followed(scene: Scene, tolerance: float, bounds: RecordBounds) -> TwoAxesOutcome:
    if scene.friction.is_monotone:
        return _bounded(scene, tolerance, bounds)
    # Not above the default: a block that nearly stops may go on, and two rough runs may agree on
    # the wrong one.
    motion = _bounded(scene, min(tolerance, DEFAULT_TOLERANCE), bounds)
    if motion.status is not Status.OK:
        return motion
    # Friction that falls by speed lets two near motions part: only a second run tells by how much.
    finer = _run(scene, bounds, _FINER * motion.step_tolerance, _NO_EVENTS, _NO_HISTORY)
    changes = np.subtract(finer.places, motion.places)
    change = _SAFE * float(np.abs(changes).max())
    return replace(finer, error_m=max(change, _rounding_m(scene, finer)))


def _rounding_m(scene: Scene, outcome: TwoAxesOutcome) -> float:
    """Return the sum of the rounding errors of the accelerations and of the positions [m]."""
    friction, seconds = scene.friction, scene.dt_s * (scene.ax_mps2.size - 1)
    along, across, up = (float(np.abs(a).max()) for a in components(scene))
    largest_mu = max(friction.mu_slow, friction.mu_fast, friction.mu_static)
    terms = abs(scene.scale) * (along + across) + (1.0 + largest_mu) * (
        scene.g_mps2 + abs(scene.scale) * up
    )
    # Of positions: |x| + |y| and what a step adds, by one rounding a step.
    steps = 2.0 * outcome.prd_m + outcome.peak_mps * scene.dt_s
    # An acceleration d moves a block by d t^2 / 2 at most: friction only reduces it.
    return kernel.ROUNDING * terms * 0.5 * seconds**2 + kernel.EPS * outcome.n_steps * steps


def follow_history(scene: Scene, outcome: TwoAxesOutcome) -> tuple[Floats, tuple[Event, ...]]:
    """Return x, y and their rates at the samples, shape (4, n) [m], [m/s], and the events.

    The outcome is that of `follow` for the same scene.
    """
    events, samples = np.empty((outcome.n_events, 4)), np.empty((4, len(scene.ax_mps2)))
    _run(scene, bounds_of(scene), outcome.step_tolerance, events, samples)
    # Of the rows x, y, x', y' the first and the third are along the slope: u = s cos(theta).
    cs = math.cos(scene.slope_rad)
    samples[0::2] *= cs
    kinds = {kernel.SLIP: EventKind.SLIP, kernel.STOP: EventKind.STOP}
    return samples, tuple(Event(t, kinds[kind], cs * sx, sy) for t, kind, sx, sy in events.tolist())


def _bounded(scene: Scene, tolerance: float, bounds: RecordBounds) -> TwoAxesOutcome:
    """Return the first of successively finer runs whose error bound is within the tolerance."""
    steps, share = 0, min(_SHARE * tolerance, _LARGEST_STEP)
    for _ in range(_ATTEMPTS):
        outcome = _run(scene, bounds, share, _NO_EVENTS, _NO_HISTORY)
        steps += outcome.n_steps
        allowed_m = tolerance * max(outcome.prd_m, kernel.SMALL)
        settled = not scene.friction.is_monotone or outcome.error_m <= allowed_m
        if settled or outcome.status is not Status.OK or share <= kernel.LEAST_TOLERANCE:
            break
        # The bound falls about as the tolerance of a step; 0.3 so that the next attempt suffices.
        share *= max(0.3 * allowed_m / outcome.error_m, 1e-3)
    return replace(outcome, n_steps=steps)


def _run(
    scene: Scene, bounds: RecordBounds, step: float, events: Floats, samples: Floats
) -> TwoAxesOutcome:
    friction, cs = scene.friction, math.cos(scene.slope_rad)
    law = None
    if not friction.is_constant:
        drop = friction.mu_fast - friction.mu_slow
        law = (friction.mu_fast, drop, friction.rate_s_per_m, friction.mu_static)
    ax, ay, az = components(scene)
    top, end = np.empty(7), np.empty(4)  # the kernel fills them
    outcome, error, n_stops, n_events, n_steps = kernel.slide_plane(
        ax,
        ay,
        az,
        *bounds,
        scene.dt_s,
        math.sin(scene.slope_rad),
        cs,
        friction.mu_slow if law is None else 1.0,  # a law has mu in it
        scene.g_mps2,
        scene.scale,
        step,
        # The degree that was measured as fastest for the tolerance of a step.
        min(kernel.ORDER, 4 + math.ceil(-0.5 * math.log(step))),
        _MOST_STEPS + _MOST_STEPS_OF_SAMPLE * len(scene.ax_mps2),
        law,
        events,
        samples,
        top,
        end,
    )
    prd, t_prd, s_max, s_min, y_max, y_min, peak = top.tolist()
    sx, sy, vx, vy = end.tolist()
    return TwoAxesOutcome(
        status=_STATUSES[outcome],
        prd_m=prd,
        t_prd_s=t_prd,
        down_m=cs * s_max,
        up_m=cs * abs(s_min),
        left_m=y_max,
        right_m=abs(y_min),
        end_m=(cs * sx, sy),
        end_mps=(cs * vx, vy),
        peak_mps=peak,
        error_m=error,
        n_stops=n_stops,
        n_events=n_events,
        n_steps=n_steps,
        step_tolerance=step,
    )
