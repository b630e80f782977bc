"""Runs one block under one motion: checks the input once, calls a kernel, packs the result.

Computes no physics itself (see `solver.kernels`, and `solver.plane` for two axes), knows no code
rules (`solver.provisions`) and chooses no model (`solver.ladder`). Read `slide` first, then
`scene`.
"""

from __future__ import annotations

import math
import sys
from collections.abc import Callable, Mapping
from dataclasses import replace
from numbers import Real

import numpy as np
from numpy.typing import ArrayLike

from solver import kernels, plane
from solver.methods import (
    METHODS,
    NO_RECORD,
    Method,
    Outcome,
    Parameters,
    Prepared,
    exact_events,
    least_normal,
)
from solver.model import (
    STANDARD_GRAVITY_MPS2,
    Event,
    EventKind,
    Floats,
    Friction,
    InputError,
    Scene,
    SlideHistory,
    SlideResult,
    Status,
    coulomb,
)
from solver.plane import PlaneOutcome

_NO_HISTORY = np.empty((2, 0))

_LARGEST = 1e120
"""Of accelerations [m/s2] and of distances [m]: their squares are finite."""

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
    mu: float | Friction,
    ay_mps2: ArrayLike | None = None,
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
    mu : float or Friction
        Friction coefficient, static and kinetic, >= 0; or a law by speed (`solver.Friction`), which
        the method `exact` alone takes and follows to a `tolerance`.
    ay_mps2 : array_like, shape (n,), optional
        Horizontal roof acceleration across the slope, positive to the left of down the slope
        [m/s2]. With it the block slides in two axes, followed to a `tolerance`.
    az_mps2 : array_like, shape (n,), optional
        Vertical roof acceleration, positive up [m/s2].
    scale : float
        Factor for all components.
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
        regularised friction; in two axes and with a law `tolerance`, of the PRD.

    Returns
    -------
    SlideResult
        Horizontal displacement relative to the roof with its error; NaN, with the status and the
        time, where the normal force falls below zero; NaN, with the status, where the method
        diverged or took too many steps.

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
    records = {"ax_mps2": ax_mps2, "ay_mps2": ay_mps2, "az_mps2": az_mps2}
    run = _checked(records, dt_s, slope_rad, mu, scale, g_mps2, method, parameters)
    if _is_followed_in_plane(run):
        return in_plane(run, **parameters)
    return _run(METHODS[method], parameters, _prepared(run), _NO_HISTORY)


def slide_history(
    ax_mps2: ArrayLike,
    dt_s: float,
    *,
    slope_rad: float,
    mu: float | Friction,
    ay_mps2: ArrayLike | None = None,
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
    records = {"ax_mps2": ax_mps2, "ay_mps2": ay_mps2, "az_mps2": az_mps2}
    run = _checked(records, dt_s, slope_rad, mu, scale, g_mps2, method, parameters)
    if _is_followed_in_plane(run):
        return _plane_history(run, **parameters)
    return _history(METHODS[method], parameters, run)


def scene(
    ax_mps2: ArrayLike,
    dt_s: float,
    *,
    slope_rad: float,
    mu: float | Friction,
    ay_mps2: ArrayLike | None = None,
    az_mps2: ArrayLike | None = None,
    scale: float = 1.0,
    g_mps2: float = STANDARD_GRAVITY_MPS2,
) -> Scene:
    """Return a scene for `solver.solve`; arguments and errors as in `slide`."""
    records = {"ax_mps2": ax_mps2, "ay_mps2": ay_mps2, "az_mps2": az_mps2}
    return _checked(records, dt_s, slope_rad, mu, scale, g_mps2, "exact", {})


def along(scene: Scene) -> SlideResult:
    """Slide a checked scene along the slope, exactly: what shakes it across is left out."""
    return _run(METHODS["exact"], {}, _prepared(scene), _NO_HISTORY)


def in_plane(scene: Scene, tolerance: float = plane.DEFAULT_TOLERANCE) -> SlideResult:
    """Slide a checked scene in two axes, to a tolerance relative to the PRD."""
    n_min_g, t_uplift = least_normal(_prepared(scene))
    if n_min_g < 0.0:
        return _without_displacement(Status.UPLIFT, n_min_g, t_uplift)
    return _plane_result(plane.follow(_with_second_axis(scene), tolerance), n_min_g)


def along_history(scene: Scene) -> SlideHistory:
    """Return the history of what `along` runs."""
    return _history(METHODS["exact"], {}, scene)


def in_plane_history(scene: Scene, tolerance: float = plane.DEFAULT_TOLERANCE) -> SlideHistory:
    """Return the history of what `in_plane` runs."""
    return _plane_history(scene, tolerance)


def rounding(scene: Scene) -> float:
    """Return what rounding may change in a displacement by the method `exact` [m], at most.

    Drive and friction are rounded by 4 units in the last place of the terms they are made of.
    Friction is monotone, so a push that is off by d makes the speed off by d t after a time t, and
    the place by d t^2 / 2: over the whole record, here with twice that for the sums.
    """
    return _rounding(_prepared(scene))


def _rounding(scene: Prepared) -> float:
    c, up = scene, abs(scene.scale) * float(max(-scene.z[0, -1], scene.z[1, -1], 0.0))
    along = abs(c.scale) * float(max(-c.x[0, -1], c.x[1, -1]))
    terms = (abs(c.sn) + c.mu * c.cs) * (c.g + up) + (c.cs + c.mu * abs(c.sn)) * along
    lasts = (c.ax.size - 1) * c.dt
    return 4.0 * sys.float_info.epsilon * terms * lasts * lasts


def _run(method: Method, parameters: Parameters, scene: Prepared, samples: Floats) -> SlideResult:
    """Run a scene; `samples` of shape (2, n) is filled with u and its rate, (2, 0) with nothing."""
    n_min_g, t_uplift = least_normal(scene)
    if n_min_g < 0.0:
        return _without_displacement(Status.UPLIFT, n_min_g, t_uplift)
    found = method.follow(scene, dict(method.parameters) | dict(parameters), samples)
    if not (found.followed and math.isfinite(found.s_max - found.s_min)):
        samples[:] = np.nan
        return _without_displacement(Status.DIVERGED, n_min_g, math.nan)
    samples *= scene.cs
    error_m = _rounding(scene) if method.name == "exact" else math.nan
    return _result(found, scene.cs, n_min_g, error_m)


def _events(scene: Prepared, result: SlideResult) -> tuple[Event, ...]:
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


def _result(found: Outcome, cs: float, n_min_g: float, error_m: float) -> SlideResult:
    return SlideResult(
        status=Status.OK if found.w_end == 0.0 else Status.SLIDING_AT_END,
        prd_m=cs * max(found.s_max, -found.s_min),
        residual_m=cs * found.s_end,
        down_m=cs * found.s_max,
        up_m=cs * abs(found.s_min),
        across_m=0.0,
        residual_across_m=0.0,
        t_prd_s=found.t_peak,
        n_stops=found.n_stops,
        n_min_g=n_min_g,
        t_uplift_s=math.nan,
        end_speed_mps=cs * found.w_end,
        error_m=error_m,
    )


def _without_displacement(status: Status, n_min_g: float, t_uplift: float) -> SlideResult:
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
        error_m=math.nan,
    )


def _plane_result(found: PlaneOutcome, n_min_g: float) -> SlideResult:
    if found.status is not Status.OK:
        return _without_displacement(found.status, n_min_g, math.nan)
    speed = math.hypot(*found.end_mps)
    return SlideResult(
        status=Status.OK if speed == 0.0 else Status.SLIDING_AT_END,
        prd_m=found.prd_m,
        residual_m=found.end_m[0],
        down_m=found.down_m,
        up_m=found.up_m,
        across_m=max(found.left_m, found.right_m),
        residual_across_m=found.end_m[1],
        t_prd_s=found.t_prd_s,
        n_stops=found.n_stops,
        n_min_g=n_min_g,
        t_uplift_s=math.nan,
        end_speed_mps=speed,
        error_m=found.error_m,
    )


def _history(method: Method, parameters: Parameters, scene: Scene) -> SlideHistory:
    samples = np.full((2, scene.ax_mps2.size), np.nan)
    prepared = _prepared(scene)
    result = _run(method, parameters, prepared, samples)
    return SlideHistory(
        t_s=_times(scene),
        u_m=samples[0],
        v_mps=samples[1],
        across_m=NO_RECORD,
        across_mps=NO_RECORD,
        events=_events(prepared, result) if method.name == "exact" else (),
        result=result,
    )


def _plane_history(scene: Scene, tolerance: float = plane.DEFAULT_TOLERANCE) -> SlideHistory:
    n_min_g, t_uplift = least_normal(_prepared(scene))
    samples = np.full((4, scene.ax_mps2.size), np.nan)
    events: tuple[Event, ...] = ()
    if n_min_g < 0.0:
        result = _without_displacement(Status.UPLIFT, n_min_g, t_uplift)
    else:
        found = plane.follow(_with_second_axis(scene), tolerance)
        result = _plane_result(found, n_min_g)
        if found.status is Status.OK:
            samples, seen = plane.history(_with_second_axis(scene), found)
            events = tuple(Event(t, kind, x, y) for t, kind, x, y in seen)
    return SlideHistory(
        t_s=_times(scene),
        u_m=samples[0],
        v_mps=samples[2],
        across_m=samples[1],
        across_mps=samples[3],
        events=events,
        result=result,
    )


def _times(scene: Scene) -> Floats:
    return np.arange(scene.ax_mps2.size, dtype=np.float64) * scene.dt_s


def _with_second_axis(scene: Scene) -> Scene:
    """Return the scene with a second component, zero where it has none."""
    if scene.ay_mps2.size:
        return scene
    zero = np.zeros_like(scene.ax_mps2)
    zero.setflags(write=False)
    return replace(scene, ay_mps2=zero)


def _prepared(scene: Scene) -> Prepared:
    """Return a scene in the letters of the kernels of one axis."""
    return Prepared(
        ax=scene.ax_mps2,
        x=kernels.bounds(scene.ax_mps2),
        az=scene.az_mps2,
        z=kernels.bounds(scene.az_mps2),
        dt=scene.dt_s,
        sn=math.sin(scene.slope_rad),
        cs=math.cos(scene.slope_rad),
        mu=scene.friction.mu_slow,
        g=scene.g_mps2,
        scale=scene.scale,
    )


def _is_followed_in_plane(scene: Scene) -> bool:
    """Whether two axes' method runs a scene: it alone knows friction by speed."""
    return bool(scene.ay_mps2.size) or not scene.friction.is_constant


def _checked(
    records: Mapping[str, ArrayLike | None],
    dt_s: float,
    slope_rad: float,
    mu: float | Friction,
    scale: float,
    g_mps2: float,
    method: str,
    parameters: Parameters,
) -> Scene:
    """Return the scene with read-only contiguous records, or raise with every fault."""
    problems: list[str] = []
    ax, ay, az = _checked_records(records, problems)
    friction = checked_friction("mu", mu, problems)
    numbers = {
        name: checked_number(name, value, wanted, fits, problems)
        for name, value, wanted, fits in (
            ("dt_s", dt_s, "a number of seconds above 0", lambda v: 0.0 < v < math.inf),
            ("slope_rad", slope_rad, "an angle between -pi/2 and pi/2", is_slope),
            ("scale", scale, "a finite factor", math.isfinite),
            ("g_mps2", g_mps2, "a number of m/s2 above 0", lambda v: 0.0 < v < math.inf),
        )
    }
    if records["ay_mps2"] is not None or not friction.is_constant:
        problems += _plane_faults(method, parameters)
    elif method not in METHODS:
        problems.append(f"method is {method!r}; give one of {', '.join(METHODS)}")
    else:
        problems += _faults(METHODS[method], parameters, records["az_mps2"] is not None)
    if problems:
        raise InputError(problems)
    found = Scene(ax_mps2=ax, ay_mps2=ay, az_mps2=az, friction=friction, **numbers)
    if overflow := _overflow(found):
        raise InputError(overflow)
    return found


def _overflow(scene: Scene) -> list[str]:
    """Return what is beyond floating point: squares of accelerations, their rates, and ways."""
    records = (scene.ax_mps2, scene.ay_mps2, scene.az_mps2)
    peak = scene.scale * max(float(np.abs(record).max()) for record in records if record.size)
    lasts = scene.dt_s * (scene.ax_mps2.size - 1)
    mus = scene.friction.mu_slow, scene.friction.mu_fast, scene.friction.mu_static
    push = (abs(peak) + scene.g_mps2) * (1.0 + max(mus))
    rate = scene.dt_s * _LARGEST
    if push < min(_LARGEST, rate) and push * lasts * lasts < _LARGEST:
        return []
    return [
        f"accelerations of {push:.2g} m/s2, scaled and with gravity and friction, over {lasts:.2g} "
        f"s in steps of {scene.dt_s:.2g} s are beyond floating point; give another scale, dt_s, mu "
        "or g_mps2"
    ]


def is_slope(value: float) -> bool:
    """Whether it is an angle of a roof [rad]."""
    return abs(value) < math.pi / 2


def checked_number(
    name: str, value: object, wanted: str, fits: Callable[[float], bool], problems: list[str]
) -> float:
    """Return a real number that fits, else NaN with a problem more; no text, no truth value."""
    if isinstance(value, Real | np.number) and not isinstance(value, bool | np.bool_):
        try:
            number = float(value)
        except (OverflowError, TypeError):
            number = math.nan
        if fits(number):
            return number
    problems.append(f"{name} is {_shown(value)}; give {wanted}")
    return math.nan


def checked_friction(name: str, mu: float | Friction, problems: list[str]) -> Friction:
    """Return the friction of a coefficient or a law, with a problem for every fault."""
    wanted = "a friction coefficient of 0 or more"
    if not isinstance(mu, Friction):
        return coulomb(checked_number(name, mu, wanted, _is_coefficient, problems))
    checked = Friction(
        mu_slow=checked_number("mu_slow", mu.mu_slow, wanted, _is_coefficient, problems),
        mu_fast=checked_number("mu_fast", mu.mu_fast, wanted, _is_coefficient, problems),
        rate_s_per_m=checked_number(
            "rate_s_per_m", mu.rate_s_per_m, "a number of s/m, 0 or more", _is_coefficient, problems
        ),
        mu_static=checked_number("mu_static", mu.mu_static, wanted, _is_coefficient, problems),
    )
    if checked.mu_static < checked.mu_slow:
        problems.append(
            f"mu_static is {checked.mu_static:g}; give mu_slow, {checked.mu_slow:g}, or more"
        )
    return checked


def _is_coefficient(value: float) -> bool:
    return 0.0 <= value < math.inf


def _shown(value: object) -> str:
    """Return what was given, in a line."""
    text = repr(value)
    return text if len(text) <= 60 else f"{text[:57]}..."


def _checked_records(records: Mapping[str, ArrayLike | None], problems: list[str]) -> list[Floats]:
    found = {
        name: NO_RECORD if values is None else checked_record(name, values, problems)
        for name, values in records.items()
    }
    shape = found["ax_mps2"].shape
    problems += [
        f"{name} has shape {found[name].shape}; give the shape of ax_mps2, {shape}"
        for name, values in records.items()
        if values is not None and found[name].shape != shape
    ]
    return list(found.values())


def _plane_faults(method: str, parameters: Parameters) -> list[str]:
    """Return what two axes, and friction by speed, do not take."""
    found: list[str] = []
    if method != "exact":
        found.append(
            f"method is {method!r}; two axes and friction by speed take 'exact' alone: leave "
            "ay_mps2 out and give one coefficient, or leave the method out"
        )
    low, high = plane.TOLERANCES
    wanted = f"a number from {low:g} to {high:g}"
    for name, value in parameters.items():
        if name != "tolerance":
            found.append(f"two axes have no parameter {name!r}; they have tolerance")
        else:
            checked_number(name, value, wanted, lambda v: low <= v <= high, found)
    return found


def _faults(method: Method, parameters: Parameters, with_vertical: bool) -> list[str]:
    """Return what a method does not take, and values that its parameters cannot have."""
    found: list[str] = []
    if with_vertical and not method.takes_vertical:
        found.append(f"method {method.name!r} takes horizontal shaking only; leave az_mps2 out")
    for name, value in parameters.items():
        if name not in method.parameters:
            known = ", ".join(method.parameters) or "none"
            found.append(f"method {method.name!r} has no parameter {name!r}; it has {known}")
        else:
            checked_number(name, value, *_WANTED[name], found)
    return found


def checked_record(name: str, values: ArrayLike, problems: list[str]) -> Floats:
    """Return a read-only float64 view: read-only arrays alone keep one compiled version."""
    wanted = f"{name} is not a row of real numbers; give a sequence of accelerations"
    try:
        given = np.asanyarray(values)
    except (TypeError, ValueError, OverflowError):
        problems.append(wanted)
        return NO_RECORD
    if given.dtype.kind not in "fiu" or (np.ma.isMaskedArray(given) and np.ma.is_masked(given)):
        what = "has masked samples" if given.dtype.kind in "fiu" else f"is of type {given.dtype}"
        problems.append(f"{name} {what}; give a sequence of accelerations, real numbers all")
        return NO_RECORD
    record = np.ascontiguousarray(given, dtype=np.float64)
    if record.ndim != 1 or record.size < 2:
        problems.append(f"{name} has shape {record.shape}; give one row of 2 samples or more")
        return NO_RECORD
    if not np.isfinite(record).all():
        first = int(np.flatnonzero(~np.isfinite(record))[0])
        problems.append(f"{name}[{first}] is {record[first]}; give finite accelerations")
    record = record.view()
    record.setflags(write=False)
    return record
