"""Checks the arguments of a run and builds a scene from them.

A step of -0.1 s with a friction coefficient of -1 is one error with two lines: all errors are
collected before raising. Runs nothing (`solver.sliding.checked` does). Read `scene_of`.
"""

from __future__ import annotations

import math
import warnings
from collections.abc import Callable, Mapping
from numbers import Real
from types import MappingProxyType
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from solver.errors import InputError, raise_any
from solver.formats.phrases import parse
from solver.model import Floats, Friction, Motion, Scene, coulomb
from solver.records.record import NO_RECORD, UNITS, Record, has_gravity, read_only
from solver.records.record import unit_size as records_unit
from solver.sliding import two_axes
from solver.sliding.method import ANY_NUMBER, EXACT, WANTED, Method, Parameters, methods

# Shaking as it is: a row of accelerations with a step beside it, a record, or a whole motion.
Given = ArrayLike | Record | Motion

_WEAK = 0.05  # of what slips a block: weaker shaking is more probably in another unit

# Largest accelerations [m/s2] and distances [m] accepted: their squares are finite.
_LARGEST = 1e120


class MotionArguments(NamedTuple):
    """The motion of a roof as passed by the caller, unchecked."""

    ax_mps2: Given
    ay_mps2: ArrayLike | Record | None
    az_mps2: ArrayLike | Record | None
    dt_s: float | None
    scale: float
    units: str | None


def scene_of(
    shaking: MotionArguments,
    slope_rad: float,
    mu: float | Friction,
    g_mps2: float,
    method: str | Method = "exact",
    parameters: Parameters = MappingProxyType({}),
) -> Scene:
    """Return the scene with read-only contiguous records, or raise all errors found.

    Warns if arrays are far too weak to cause slip and may therefore be in g.
    """
    problems: list[str] = []
    ax_mps2, ay_mps2, az_mps2, dt_s, scale, units = shaking
    components = {"ax_mps2": ax_mps2, "ay_mps2": ay_mps2, "az_mps2": az_mps2}
    # Every check below notes its errors in `problems` and goes on with NaN or no record; nothing is
    # computed with these, because `raise_any` comes first.
    records, dt_s, factor = unpacked(components, dt_s, problems)
    size = unit_size(components, units, problems)
    ax, ay, az = checked_records(records, problems, size)
    friction = checked_friction("mu", mu, problems)
    step = "a number of seconds above 0"
    dt_s = checked_number("dt_s", dt_s, step, _is_positive, problems)
    angle = "an angle between -pi/2 and pi/2"
    slope_rad = checked_number("slope_rad", slope_rad, angle, _is_slope, problems)
    scale = checked_number("scale", scale, "a finite factor", math.isfinite, problems)
    gravity = "a number of m/s2 above 0"
    g_mps2 = checked_number("g_mps2", g_mps2, gravity, _is_positive, problems)
    if not is_method(method):
        problems.append(f"method is {shortened(method)}; use one of {', '.join(methods())}")
    elif records["ay_mps2"] is not None or not friction.is_constant:
        problems += _plane_faults(method, parameters)
    else:
        problems += _faults(method_of(method), parameters, records["az_mps2"] is not None)
    raise_any(problems)
    run = Scene(
        dt_s=dt_s,
        ax_mps2=ax,
        ay_mps2=ay,
        az_mps2=az,
        # A motion has a factor of its own beside its arrays, which stay as they are.
        scale=scale * factor,
        slope_rad=slope_rad,
        friction=friction,
        g_mps2=g_mps2,
    )
    raise_any(overflow(run))
    # It would count twice: g is added to az.
    if az.size and has_gravity(az):
        raise InputError(
            f"az_mps2 has a mean of {az.mean():.3g} m/s2: it includes gravity; subtract the mean"
        )
    if units is None and not any(
        isinstance(component, Record | Motion) or is_series(component)
        for component in components.values()
    ):
        _warn_if_in_g(run)
    return run


def unit_size(values: Mapping[str, Given | None], units: str | None, problems: list[str]) -> float:
    """Return the size of the unit of arrays [m/s2]; records and motions have their own."""
    if units is None:
        return _size_of_series(values, problems)
    if any(isinstance(value, Record | Motion) for value in values.values()):
        problems.append("units are entered with a record or a motion, which is in m/s2; omit them")
    if units not in UNITS:
        problems.append(f"units is {shortened(units)}; use one of {', '.join(UNITS)}")
    return UNITS.get(units, 1.0)


def _size_of_series(values: Mapping[str, Given | None], problems: list[str]) -> float:
    """Return the size of the unit that the names of Series state; 1 without any Series."""
    # pandas keeps no unit of a Series: its name says it, as in `acceleration_g`.
    sizes = {
        name: records_unit(parse(str(value.name)).unit)  # type: ignore[union-attr]
        for name, value in values.items()
        if is_series(value)
    }
    if any(map(math.isnan, sizes.values())):
        unknown = next(name for name, size in sizes.items() if math.isnan(size))
        problems.append(
            f"{unknown} is a Series without a unit; use units, or a name such as acceleration_g"
        )
    elif len({*sizes.values()}) > 1 or 0 < len(sizes) < sum(e is not None for e in values.values()):
        problems.append("some components are Series, in other units than the rest; use units")
    return next(iter(sizes.values()), 1.0)


def is_series(value: object) -> bool:
    """Whether the argument is a Series of pandas: values with an index and a name."""
    # By its attributes: pandas is optional and is not imported here.
    return all(hasattr(value, name) for name in ("index", "name", "to_numpy"))


def _step_of_series(name: str, series: Any, problems: list[str]) -> float | None:
    """Return the step of the index [s], if it is of times; None if it counts samples."""
    times = np.asarray(series.index)
    if times.dtype.kind in "mM":
        # Dates become time deltas from the first one; a delta over one second is a number of
        # seconds.
        times = (times - times[:1]) / np.timedelta64(1, "s")
    # An index of whole numbers counts samples.
    if times.dtype.kind != "f" or len(times) < 2:
        return None
    steps = np.diff(times)
    # Times such as 0.01 k are each rounded: nine digits give back 0.01, by which a record and a
    # column of the same step agree.
    step = float(f"{(times[-1] - times[0]) / len(steps):.9g}")
    if not (step > 0.0 and np.abs(steps - step).max() <= 1e-3 * step):
        problems.append(f"{name} has an uneven index; use times at one step, in seconds")
        return 1.0  # which is of no account beside the problem
    return step


def _warn_if_in_g(run: Scene) -> None:
    peak = abs(run.scale) * max(
        float(np.abs(a).max()) for a in (run.ax_mps2, run.ay_mps2) if a.size
    )
    # A block slips where |G| > mu N: by about g (mu cos(theta) - sin(theta)) on a slope.
    yield_ratio = run.friction.mu_static * math.cos(run.slope_rad) - abs(math.sin(run.slope_rad))
    if 0.0 < peak < _WEAK * yield_ratio * run.g_mps2:
        warnings.warn(
            f"the accelerations reach {peak:.3g} m/s2, and {yield_ratio * run.g_mps2:.3g} m/s2"
            " slips: use units='g' if they are in g, or units='m/s2'",
            # At the line that called `slide`, `scene` or `motion`, behind `scene_of`.
            stacklevel=4,
        )


def is_method(method: object) -> bool:
    """Whether it is a method or the name of one."""
    is_name = isinstance(method, str) and (method == EXACT.name or method in methods())
    return is_name or isinstance(method, Method)


def method_of(method: str | Method) -> Method:
    """Return a method, from its name or unchanged."""
    if isinstance(method, Method):
        return method
    return EXACT if method == EXACT.name else methods()[method]


def unpacked(
    values: Mapping[str, Given | None], dt_s: float | None, problems: list[str]
) -> tuple[dict[str, ArrayLike | None], float | None, float]:
    """Return components as arrays, their step and their factor, from records or a motion.

    By the names of the arguments, that along the slope first, which alone may be a motion.
    """
    along, *transverse = values.values()
    steps = {value.dt_s for value in values.values() if isinstance(value, Record | Motion)}
    for name, value in values.items():
        if is_series(value) and (step := _step_of_series(name, value, problems)):
            steps.add(step)
    if steps and dt_s is not None:
        problems.append(
            "dt_s is entered with a record or a motion, which has its own, or a Series of times;"
            " omit it"
        )
    if len(steps) > 1:
        steps_text = " and ".join(f"{step:g} s" for step in sorted(steps))
        problems.append(f"the components have steps of {steps_text}; use components of one step")
    # Any of them, where they differ: the problem is noted above.
    dt_s = max(steps, default=dt_s)
    if any(isinstance(value, Motion) for value in transverse):
        problems.append("a motion is entered as one component; use it first and by itself")
    if not isinstance(along, Motion):
        return {name: _samples(value) for name, value in values.items()}, dt_s, 1.0
    if any(value is not None for value in transverse):
        problems.append("a motion is entered with further components; use only the motion")
    components = {name: getattr(along, name) for name in ("ax_mps2", "ay_mps2", "az_mps2")}
    return {n: a if a.size else None for n, a in components.items()}, dt_s, along.scale


def _samples(value: Given | None) -> ArrayLike | None:
    if isinstance(value, Record):
        return value.a_mps2
    return None if isinstance(value, Motion) else value


def overflow(scene: Scene) -> list[str]:
    """Return an error if squared accelerations, their rates or the distances would overflow."""
    records = (scene.ax_mps2, scene.ay_mps2, scene.az_mps2)
    peak = scene.scale * max(float(np.abs(record).max()) for record in records if record.size)
    lasts = scene.dt_s * (scene.ax_mps2.size - 1)
    mus = scene.friction.mu_slow, scene.friction.mu_fast, scene.friction.mu_static
    # Of the size of |G| + mu N, but for a small factor, for which `_LARGEST` leaves room.
    push = (abs(peak) + scene.g_mps2) * (1.0 + max(mus))
    if is_in_range(push, scene.dt_s, lasts):
        return []
    return [
        f"accelerations of {push:.2g} m/s2, scaled and with gravity and friction, over {lasts:.2g} "
        f"s in steps of {scene.dt_s:.2g} s exceed the floating-point range; change scale, dt_s, mu "
        "or g_mps2"
    ]


def is_in_range(push_mps2: float, dt_s: float, lasts_s: float) -> bool:
    """Whether kernels can square accelerations and rates, a / dt, and sum distances a t^2."""
    is_squared = push_mps2 < min(_LARGEST, dt_s * _LARGEST)
    return is_squared and push_mps2 * lasts_s * lasts_s < _LARGEST


def checked_number(
    name: str, value: object, accepted: str, fits: Callable[[float], bool], problems: list[str]
) -> float:
    """Return the value as a float, or NaN with a problem added; text and booleans are refused."""
    # A difference of dates is a number to numpy.
    wrong = isinstance(value, bool | np.bool_ | np.timedelta64)
    if isinstance(value, Real | np.number) and not wrong:
        try:
            number = float(value)
        except (OverflowError, TypeError):
            number = math.nan
        if fits(number):
            return number
    problems.append(f"{name} is {shortened(value)}; use {accepted}")
    return math.nan


def checked_friction(name: str, mu: float | Friction, problems: list[str]) -> Friction:
    """Return the friction law for a coefficient or a law, adding a problem for every error."""
    accepted = "a friction coefficient of 0 or more"
    if not isinstance(mu, Friction):
        return coulomb(checked_number(name, mu, accepted, is_zero_or_more, problems))
    checked = Friction(
        mu_slow=checked_number("mu_slow", mu.mu_slow, accepted, is_zero_or_more, problems),
        mu_fast=checked_number("mu_fast", mu.mu_fast, accepted, is_zero_or_more, problems),
        rate_s_per_m=checked_number(
            "rate_s_per_m", mu.rate_s_per_m, "a number of s/m, 0 or more", is_zero_or_more, problems
        ),
        mu_static=checked_number("mu_static", mu.mu_static, accepted, is_zero_or_more, problems),
    )
    if checked.mu_static < checked.mu_slow:
        problems.append(
            f"mu_static is {checked.mu_static:g}; use mu_slow, {checked.mu_slow:g}, or more"
        )
    return checked


def _is_positive(value: float) -> bool:
    return 0.0 < value < math.inf


def _is_slope(value: float) -> bool:
    # At 90 deg cos(theta) is zero, and u = s cos(theta) tells nothing of s.
    return abs(value) < math.pi / 2


def is_zero_or_more(value: float) -> bool:
    """Whether a number is finite and not below zero."""
    return 0.0 <= value < math.inf


def shortened(value: object) -> str:
    """Return the value given, shortened to one line."""
    text = repr(value)
    return text if len(text) <= 60 else f"{text[:57]}..."


def checked_records(
    records: Mapping[str, ArrayLike | None], problems: list[str], size: float = 1.0
) -> list[Floats]:
    """Return read-only records of one shape, the one along the slope first; empty for none.

    They are multiplied by the size of their unit.
    """
    checked = {
        name: NO_RECORD
        if values is None and name != "ax_mps2"
        else checked_record(name, values, problems)
        for name, values in records.items()
    }
    shape = checked["ax_mps2"].shape
    problems += [
        f"{name} has shape {checked[name].shape}; use the shape of ax_mps2, {shape}"
        for name, values in records.items()
        if values is not None and checked[name].shape != shape
    ]
    values = list(checked.values())
    # In m/s2 the array of the caller is run as it is, without a copy.
    return values if size == 1.0 else [read_only(component * size) for component in values]


def _plane_faults(method: str | Method, parameters: Parameters) -> list[str]:
    """Return the arguments not accepted by the two-axes solver."""
    problems: list[str] = []
    if method_of(method) is not EXACT:
        problems.append(
            f"method is {shortened(method)}; two axes and velocity-dependent friction need 'exact'"
            ": omit ay_mps2 and use one coefficient, or omit the method"
        )
    low, high = two_axes.TOLERANCES
    accepted = f"a number from {low:g} to {high:g}"
    for name, value in parameters.items():
        if name != "tolerance":
            problems.append(f"two axes have no parameter {name!r}; the only one is tolerance")
        else:
            checked_number(name, value, accepted, lambda v: low <= v <= high, problems)
    return problems


def _faults(method: Method, parameters: Parameters, with_vertical: bool) -> list[str]:
    """Return the arguments not accepted by a method, and parameter values out of range."""
    problems: list[str] = []
    if with_vertical and not method.takes_vertical:
        problems.append(f"method {method.name!r} takes horizontal shaking only; omit az_mps2")
    for name, value in parameters.items():
        if name not in method.parameters:
            known = ", ".join(method.parameters) or "none"
            problems.append(f"method {method.name!r} has no parameter {name!r}; it has {known}")
        else:
            checked_number(name, value, *WANTED.get(name, ANY_NUMBER), problems)
    return problems


def checked_record(name: str, values: ArrayLike | None, problems: list[str]) -> Floats:
    """Return a read-only float64 view: numba would compile a second version for writable arrays."""
    remedy = f"{name} is not a row of real numbers; use a sequence of accelerations"
    try:
        # Not `asarray`, which would drop the mask of a masked array and take what is under it.
        samples = np.asanyarray(values)
    except (TypeError, ValueError, OverflowError):
        problems.append(remedy)
        return NO_RECORD
    # A conversion would take text, booleans and dates, and drop the imaginary part.
    if samples.dtype.kind not in "fiu" or (
        np.ma.isMaskedArray(samples) and np.ma.is_masked(samples)
    ):
        problem = (
            "has masked samples" if samples.dtype.kind in "fiu" else f"is of type {samples.dtype}"
        )
        problems.append(f"{name} {problem}; use a sequence of accelerations, all real numbers")
        return NO_RECORD
    # The one layout for which the kernels are compiled.
    record = np.ascontiguousarray(samples, dtype=np.float64)
    # One sample has no interval to slide in.
    if record.ndim != 1 or record.size < 2:
        problems.append(f"{name} has shape {record.shape}; use one row of 2 samples or more")
        return NO_RECORD
    if not np.isfinite(record).all():
        first = int(np.flatnonzero(~np.isfinite(record))[0])
        problems.append(f"{name}[{first}] is {record[first]}; use finite accelerations")
    return read_only(record)
