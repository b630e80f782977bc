"""Runs one block under one motion: checks the input once, calls a kernel, packs the result.

Computes no physics itself (see `solver.kernels.one_axis`, and `solver.sliding.two_axes` for two
axes), knows no code rules (`solver.rules.provisions`) and chooses no model
(`solver.sliding.least_model`). Read `slide` first, then `scene`.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from numbers import Real

import numpy as np
from numpy.typing import ArrayLike

from solver.model import (
    STANDARD_GRAVITY_MPS2,
    Floats,
    Friction,
    InputError,
    Scene,
    SlideHistory,
    SlideResult,
    coulomb,
)
from solver.rivals.methods import (
    METHODS,
    NO_RECORD,
    Method,
    Parameters,
)
from solver.sliding import one_axis, two_axes

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
        return two_axes.run(run, **parameters)
    return one_axis.run_method(METHODS[method], parameters, run)


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
        return two_axes.run_history(run, **parameters)
    return one_axis.method_history(METHODS[method], parameters, run)


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
    low, high = two_axes.TOLERANCES
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
