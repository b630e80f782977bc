"""Runs one block under one motion: checks the input once, calls a kernel, packs the result.

Computes no physics itself (see `solver.kernels`) and knows no code rules (`solver.provisions`).
"""

from __future__ import annotations

import math
from collections.abc import Callable
from numbers import Real
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from solver import kernels
from solver.methods import (
    METHODS,
    NO_RECORD,
    Method,
    Outcome,
    Parameters,
    Scene,
    exact_events,
    least_normal,
)
from solver.model import (
    Event,
    EventKind,
    Floats,
    Heading,
    InputError,
    Motion,
    SlideHistory,
    SlideResult,
    Status,
)

STANDARD_GRAVITY_MPS2 = 9.80665

_NO_HISTORY = np.empty((2, 0))

# What a value of each parameter of a method has to be.
_WHOLE = "a whole number of 1 or more"
_POSITIVE = "a finite number above 0"
_TOLERANCE = "a number from 1e-13 to 0.1"
_WANTED: dict[str, tuple[str, Callable[[float], bool]]] = {
    "substeps": (_WHOLE, lambda v: v >= 1.0 and v.is_integer()),
    "stiffness_per_m": (_POSITIVE, lambda v: 0.0 < v < math.inf),
    "velocity_mps": (_POSITIVE, lambda v: 0.0 < v < math.inf),
    "tolerance": (_TOLERANCE, lambda v: 1e-13 <= v <= 0.1),
}


def slide(
    ax_mps2: ArrayLike,
    dt_s: float,
    *,
    slope_rad: float,
    mu: float,
    az_mps2: ArrayLike | None = None,
    scale: float = 1.0,
    g_mps2: float = STANDARD_GRAVITY_MPS2,
    method: str = "exact",
    **parameters: float,
) -> SlideResult:
    """Slide a block on a sloped, shaken roof, held by friction alone.

    Parameters
    ----------
    ax_mps2 : array_like, shape (n,)
        Horizontal roof acceleration at even intervals [m/s2], straight lines between samples.
    dt_s : float
        Sampling interval [s], > 0.
    slope_rad : float
        Roof slope [rad], positive down in the direction of positive ax; |slope| < pi/2.
    mu : float
        Friction coefficient, static and kinetic, >= 0.
    az_mps2 : array_like, shape (n,), optional
        Vertical roof acceleration, positive up [m/s2].
    scale : float
        Factor for both components.
    g_mps2 : float
        Acceleration of gravity [m/s2], > 0.
    method : str
        A key of `solver.METHODS`, which says what each one is. `exact` follows the interpolated
        record event by event, to rounding. `paper` is the explicit algorithm of Eqs. 1-19 of
        "Predicted Slip of Ballasted Solar Arrays on Angled Roofs due to Seismic Motion",
        horizontal shaking only.
    **parameters : float
        Those of the method: `substeps` in each sampling interval, `stiffness_per_m` of a link for
        each unit of the block's weight [1/m], `velocity_mps` and relative `tolerance` of the
        regularised friction.

    Returns
    -------
    SlideResult
        Horizontal displacement relative to the roof; NaN, with the status and the time, where
        the normal force falls below zero; NaN, with the status, where the method diverged.

    Raises
    ------
    InputError
        Every argument that is not as above.

    Examples
    --------
    >>> pulse = [0.0, 4.0, -4.0, 0.0]
    >>> slide(pulse, 0.1, slope_rad=0.0, mu=0.2).status
    <Status.OK: 'ok'>
    """
    scene = _checked(ax_mps2, dt_s, slope_rad, mu, az_mps2, scale, g_mps2, method, parameters)
    return _run(METHODS[method], parameters, scene, _NO_HISTORY)


def slide_history(
    ax_mps2: ArrayLike,
    dt_s: float,
    *,
    slope_rad: float,
    mu: float,
    az_mps2: ArrayLike | None = None,
    scale: float = 1.0,
    g_mps2: float = STANDARD_GRAVITY_MPS2,
    method: str = "exact",
    **parameters: float,
) -> SlideHistory:
    """Return the motion at the samples, with its events; arguments and errors as in `slide`.

    The method `exact` alone gives events: the slips of the others begin and end somewhere inside
    a step.
    """
    scene = _checked(ax_mps2, dt_s, slope_rad, mu, az_mps2, scale, g_mps2, method, parameters)
    samples = np.full((2, scene.ax.size), np.nan)
    result = _run(METHODS[method], parameters, scene, samples)
    events = _events(scene, result) if method == "exact" else ()
    return SlideHistory(
        t_s=np.arange(scene.ax.size, dtype=np.float64) * scene.dt,
        u_m=samples[0],
        v_mps=samples[1],
        events=events,
        result=result,
    )


def slide_motion(motion: Motion, *, slope_rad: float, mu: float, heading: Heading) -> SlideResult:
    """Slide under a `Motion`, with one of its horizontal components along the slope.

    Reversing the motion is the same as reversing the slope (the paper runs both slope signs).
    """
    return slide(**_arguments(motion, heading), slope_rad=slope_rad, mu=mu)


def slide_motion_history(
    motion: Motion, *, slope_rad: float, mu: float, heading: Heading
) -> SlideHistory:
    """Return the history of what `slide_motion` runs."""
    return slide_history(**_arguments(motion, heading), slope_rad=slope_rad, mu=mu)


def _arguments(motion: Motion, heading: Heading) -> dict[str, Any]:
    return {
        "ax_mps2": motion.along_mps2(heading),
        "dt_s": motion.dt_s,
        "az_mps2": motion.az_mps2 if motion.has_vertical else None,
        "scale": motion.scale,
    }


def _run(method: Method, parameters: Parameters, scene: Scene, samples: Floats) -> SlideResult:
    """Run a scene; `samples` of shape (2, n) is filled with u and its rate, (2, 0) with nothing."""
    n_min_g, t_uplift = least_normal(scene)
    if n_min_g < 0.0:
        return _without_displacement(Status.UPLIFT, n_min_g, t_uplift)
    found = method.follow(scene, dict(method.parameters) | dict(parameters), samples)
    if not found.followed:
        samples[:] = np.nan
        return _without_displacement(Status.DIVERGED, n_min_g, math.nan)
    samples *= scene.cs
    return _result(found, scene.cs, n_min_g)


def _events(scene: Scene, result: SlideResult) -> tuple[Event, ...]:
    """Return the events of the exact method: at most a slip before each stop, and one more."""
    if math.isnan(result.prd_m):
        return ()
    return tuple(
        Event(
            t_s=t,
            kind=EventKind.STOP if kind == kernels.STOP else EventKind.SLIP,
            u_m=scene.cs * s,
        )
        for t, kind, s in exact_events(scene, result.n_stops).tolist()
    )


def _result(found: Outcome, cs: float, n_min_g: float) -> SlideResult:
    return SlideResult(
        status=Status.OK if found.w_end == 0.0 else Status.SLIDING_AT_END,
        prd_m=cs * max(found.s_max, -found.s_min),
        residual_m=cs * found.s_end,
        down_m=cs * found.s_max,
        up_m=cs * abs(found.s_min),
        t_prd_s=found.t_peak,
        n_stops=found.n_stops,
        n_min_g=n_min_g,
        t_uplift_s=math.nan,
        end_speed_mps=cs * found.w_end,
    )


def _without_displacement(status: Status, n_min_g: float, t_uplift: float) -> SlideResult:
    return SlideResult(
        status=status,
        prd_m=math.nan,
        residual_m=math.nan,
        down_m=math.nan,
        up_m=math.nan,
        t_prd_s=math.nan,
        n_stops=0,
        n_min_g=n_min_g,
        t_uplift_s=t_uplift,
        end_speed_mps=math.nan,
    )


def _checked(
    ax_mps2: ArrayLike,
    dt_s: float,
    slope_rad: float,
    mu: float,
    az_mps2: ArrayLike | None,
    scale: float,
    g_mps2: float,
    method: str,
    parameters: Parameters,
) -> Scene:
    """Return the scene with read-only contiguous records, or raise with every fault."""
    problems: list[str] = []
    ax = checked_record("ax_mps2", ax_mps2, problems)
    az = NO_RECORD if az_mps2 is None else checked_record("az_mps2", az_mps2, problems)
    if az_mps2 is not None and az.shape != ax.shape:
        problems.append(f"az_mps2 has shape {az.shape}; give the shape of ax_mps2, {ax.shape}")
    if not (math.isfinite(dt_s) and dt_s > 0.0):
        problems.append(f"dt_s is {dt_s!r}; give a number of seconds above 0")
    if not abs(slope_rad) < math.pi / 2:
        problems.append(f"slope_rad is {slope_rad!r}; give an angle between -pi/2 and pi/2")
    if not (math.isfinite(mu) and mu >= 0.0):
        problems.append(f"mu is {mu!r}; give a friction coefficient of 0 or more")
    if not math.isfinite(scale):
        problems.append(f"scale is {scale!r}; give a finite factor")
    if not (math.isfinite(g_mps2) and g_mps2 > 0.0):
        problems.append(f"g_mps2 is {g_mps2!r}; give a number of m/s2 above 0")
    if method not in METHODS:
        problems.append(f"method is {method!r}; give one of {', '.join(METHODS)}")
    else:
        problems += _faults(METHODS[method], parameters, az_mps2 is not None)
    if problems:
        raise InputError(problems)
    return Scene(
        ax=ax,
        x=kernels.bounds(ax),
        az=az,
        dt=float(dt_s),
        sn=math.sin(slope_rad),
        cs=math.cos(slope_rad),
        mu=float(mu),
        g=float(g_mps2),
        scale=float(scale),
    )


def _faults(method: Method, parameters: Parameters, with_vertical: bool) -> list[str]:
    """Return what a method does not take, and values that its parameters cannot have."""
    found = []
    if with_vertical and not method.takes_vertical:
        found.append(f"method {method.name!r} takes horizontal shaking only; leave az_mps2 out")
    for name, value in parameters.items():
        if name not in method.parameters:
            known = ", ".join(method.parameters) or "none"
            found.append(f"method {method.name!r} has no parameter {name!r}; it has {known}")
            continue
        wanted, fits = _WANTED[name]
        if not (isinstance(value, Real) and fits(float(value))):
            found.append(f"{name} is {value!r}; give {wanted}")
    return found


def checked_record(name: str, values: ArrayLike, problems: list[str]) -> Floats:
    """Return a read-only float64 view: read-only arrays alone keep one compiled version."""
    try:
        record = np.ascontiguousarray(values, dtype=np.float64)
    except (TypeError, ValueError):
        problems.append(f"{name} is not an array of numbers; give a sequence of accelerations")
        return NO_RECORD
    if record.ndim != 1 or record.size < 2:
        problems.append(f"{name} has shape {record.shape}; give one row of 2 samples or more")
        return NO_RECORD
    if not np.isfinite(record).all():
        first = int(np.flatnonzero(~np.isfinite(record))[0])
        problems.append(f"{name}[{first}] is {record[first]}; give finite accelerations")
    record = record.view()
    record.setflags(write=False)
    return record
