"""Runs one block under one motion: checks the input once, calls a kernel, packs the result.

Computes no physics itself (see `solver.kernels`) and knows no code rules (`solver.provisions`).
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from solver import kernels, rivals
from solver.model import (
    Event,
    EventKind,
    Floats,
    InputError,
    Motion,
    SlideHistory,
    SlideResult,
    Status,
)

STANDARD_GRAVITY_MPS2 = 9.80665
METHODS = ("exact", "paper")

_NO_EVENTS = np.empty((0, 3))
_NO_HISTORY = np.empty((2, 0))
_NO_RECORD = np.empty(0)
_NO_RECORD.setflags(write=False)


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
    substeps: int = 64,
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
    method : {"exact", "paper"}
        `exact` follows the interpolated record event by event, to rounding. `paper` is the
        explicit algorithm of Eqs. 1-19 of "Predicted Slip of Ballasted Solar Arrays on Angled
        Roofs due to Seismic Motion", horizontal shaking only.
    substeps : int
        P, the sub-steps in each sampling interval of the method `paper`, >= 1.

    Returns
    -------
    SlideResult
        Horizontal displacement relative to the roof; NaN, with the status and the time, where
        the normal force falls below zero.

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
    scene = _checked(ax_mps2, dt_s, slope_rad, mu, az_mps2, scale, g_mps2, method, substeps)
    return _run(scene, _NO_HISTORY)[0]


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
    substeps: int = 64,
) -> SlideHistory:
    """Return the motion at the samples, with its events; arguments and errors as in `slide`.

    The method `paper` gives no events: its slips begin and end somewhere inside a sub-step.
    """
    scene = _checked(ax_mps2, dt_s, slope_rad, mu, az_mps2, scale, g_mps2, method, substeps)
    samples = np.full((2, scene.ax.size), np.nan)
    result, events = _run(scene, samples)
    return SlideHistory(
        t_s=np.arange(scene.ax.size, dtype=np.float64) * scene.dt,
        u_m=samples[0],
        v_mps=samples[1],
        events=events,
        result=result,
    )


def slide_motion(motion: Motion, *, slope_rad: float, mu: float, sign: int) -> SlideHistory:
    """Slide under a `Motion`, with one polarity (sign +1 or -1) of its horizontal component.

    Reversing the motion is the same as reversing the slope (the paper runs both slope signs).
    """
    return slide_history(
        motion.ax_mps2 * sign,
        motion.dt_s,
        slope_rad=slope_rad,
        mu=mu,
        az_mps2=motion.az_mps2 if motion.has_vertical else None,
        scale=motion.scale,
    )


@dataclass(frozen=True, slots=True)
class _Scene:
    """Checked arguments in the letters of the kernels."""

    ax: Floats
    az: Floats
    dt: float
    sn: float
    cs: float
    mu: float
    g: float
    scale: float
    substeps: int  # 0: exact


def _run(scene: _Scene, samples: Floats) -> tuple[SlideResult, tuple[Event, ...]]:
    """Run a scene; `samples` of shape (2, n) is filled with u and its rate, (2, 0) with nothing."""
    n_min_g, t_uplift = kernels.least_normal(
        scene.ax, scene.az, scene.dt, scene.sn, scene.cs, scene.g, scene.scale
    )
    if n_min_g < 0.0:
        return _uplift(n_min_g, t_uplift), ()
    if scene.substeps:
        return _paper(scene, samples, n_min_g), ()
    return _exact(scene, samples, n_min_g)


def _exact(scene: _Scene, samples: Floats, n_min_g: float) -> tuple[SlideResult, tuple[Event, ...]]:
    out = _exact_kernel(scene, _NO_EVENTS, samples)
    s_max, s_min, s_end, w_end, t_prd, n_stops, n_events = out
    cs = scene.cs
    result = _result(cs * s_max, cs * s_min, cs * s_end, cs * w_end, t_prd, n_stops, n_min_g)
    if not samples.size:
        return result, ()
    rows = np.empty((n_events, 3))
    _exact_kernel(scene, rows, samples)
    samples *= cs
    return result, tuple(
        Event(
            t_s=float(t),
            kind=EventKind.SLIP if kind == kernels.SLIP else EventKind.STOP,
            u_m=cs * float(s),
        )
        for t, kind, s in rows
    )


def _exact_kernel(
    scene: _Scene, events: Floats, samples: Floats
) -> tuple[float, float, float, float, float, int, int]:
    c = scene
    out: tuple[float, float, float, float, float, int, int] = kernels.slide_exact(
        c.ax, c.az, c.dt, c.sn, c.cs, c.mu, c.g, c.scale, events, samples
    )
    return out


def _paper(scene: _Scene, samples: Floats, n_min_g: float) -> SlideResult:
    c = scene
    code, u_max, u_min, u_end, v_end, t_prd, n_stops, t_uplift = rivals.slide_paper(
        c.ax, c.dt, c.sn, c.cs, c.mu, c.g, c.scale, c.substeps, samples
    )
    if code == rivals.UPLIFTED:
        return _uplift(n_min_g, t_uplift)
    return _result(u_max, u_min, u_end, v_end, t_prd, n_stops, n_min_g)


def _result(
    u_max: float,
    u_min: float,
    u_end: float,
    v_end: float,
    t_prd: float,
    n_stops: int,
    n_min_g: float,
) -> SlideResult:
    return SlideResult(
        status=Status.OK if v_end == 0.0 else Status.SLIDING_AT_END,
        prd_m=max(u_max, -u_min),
        residual_m=u_end,
        down_m=u_max,
        up_m=abs(u_min),
        t_prd_s=t_prd,
        n_stops=n_stops,
        n_min_g=n_min_g,
        t_uplift_s=math.nan,
        end_speed_mps=v_end,
    )


def _uplift(n_min_g: float, t_uplift: float) -> SlideResult:
    return SlideResult(
        status=Status.UPLIFT,
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
    substeps: int,
) -> _Scene:
    """Return the scene with read-only contiguous records, or raise with every fault."""
    problems: list[str] = []
    ax = _record("ax_mps2", ax_mps2, problems)
    az = _NO_RECORD if az_mps2 is None else _record("az_mps2", az_mps2, problems)
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
    if method == "paper" and az_mps2 is not None:
        problems.append("method 'paper' takes horizontal shaking only; leave az_mps2 out")
    if not (isinstance(substeps, int) and substeps >= 1):
        problems.append(f"substeps is {substeps!r}; give a whole number of 1 or more")
    if problems:
        raise InputError(problems)
    return _Scene(
        ax=ax,
        az=az,
        dt=float(dt_s),
        sn=math.sin(slope_rad),
        cs=math.cos(slope_rad),
        mu=float(mu),
        g=float(g_mps2),
        scale=float(scale),
        substeps=substeps if method == "paper" else 0,
    )


def _record(name: str, values: ArrayLike, problems: list[str]) -> Floats:
    """Return a read-only float64 view: read-only arrays alone keep one compiled version."""
    try:
        record = np.ascontiguousarray(values, dtype=np.float64)
    except (TypeError, ValueError):
        problems.append(f"{name} is not an array of numbers; give a sequence of accelerations")
        return _NO_RECORD
    if record.ndim != 1 or record.size < 2:
        problems.append(f"{name} has shape {record.shape}; give one row of 2 samples or more")
        return _NO_RECORD
    if not np.isfinite(record).all():
        first = int(np.flatnonzero(~np.isfinite(record))[0])
        problems.append(f"{name}[{first}] is {record[first]}; give finite accelerations")
    record = record.view()
    record.setflags(write=False)
    return record
