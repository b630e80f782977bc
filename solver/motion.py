"""Acceleration records: makes them of values, writes them, takes their spectra.

Owns no file formats to read (`solver.formats`), no code rules (`solver.provisions`) and makes no
motions (`solver.synthesis`). Read `Record` first, then `response_spectrum`.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import ArrayLike, NDArray

from solver import kernels
from solver.model import STANDARD_GRAVITY_MPS2, Floats, InputError

UNITS = {"g": STANDARD_GRAVITY_MPS2, "m/s2": 1.0, "cm/s2": 0.01, "mm/s2": 0.001}
"""Acceleration units and their size in m/s2."""

DECIMALS = {"g": 5, "m/s2": 4, "cm/s2": 2, "mm/s2": 1}
"""Decimals that `write_record` prints, about 1e-5 g in every unit."""

MAX_PROBLEMS = 10
"""Problems of one file or column that are told; the others are counted."""

MAX_COUNTED = 10_000

BEYOND = 1e300
"""Larger numbers count as infinite, so that a change of unit cannot make them so."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Record:
    """One component of a motion, evenly sampled, straight lines between samples.

    Attributes
    ----------
    name : str
    dt_s : float
        Sampling interval [s], > 0.
    a_mps2 : array, shape (n,)
        Acceleration [m/s2], read-only, n >= 2.
    """

    name: str
    dt_s: float
    a_mps2: Floats


def record_from_values(
    name: str, values: Sequence[object] | Floats, *, units: str, dt_s: float
) -> Record:
    """Make a record of values that are at hand, such as a pasted column.

    Raises
    ------
    InputError
        With every value that is not a finite number, counted from 1.
    """
    _check_arguments(name, units, dt_s)
    values = values.tolist() if isinstance(values, np.ndarray) else values
    if len(values) < 2:
        raise InputError(f"{name}: a column of {len(values)}; give at least 2 values")
    problems = [
        f"{name}: value {i} is {shown(value)}; give a number"
        for i, value in enumerate(values, start=1)
        if not is_finite_number(value)
    ]
    raise_any(problems)
    return _record(name, np.asarray(values, dtype=np.float64), units, dt_s)


def write_record(path: Path, record: Record, units: str = "g", *, within: float = math.inf) -> None:
    """Write a record as csv of time [s] and acceleration, with a heading line.

    The acceleration is printed to `DECIMALS`, and to as many more as keep every sample `within`
    that part of the record's peak. A record that was rounded to `DECIMALS`, as those of
    `solver.synthesis` are in g, is read back bit for bit.
    """
    text = record_csv(record, units, within=within)
    path.write_text(text, encoding="utf-8", newline="\n")


def record_csv(record: Record, units: str = "g", *, within: float = math.inf) -> str:
    """Return the text that `write_record` writes."""
    _check_arguments(record.name, units, record.dt_s)
    values = record.a_mps2 / UNITS[units]
    places = next((k for k in range(1, 9) if fits(record.dt_s, 10.0**-k)), 9)
    decimals = _decimals(values, DECIMALS[units], within)
    row = f"{{:.{places}f}},{{:z.{decimals}f}}\n".format
    body = "".join(row(i * record.dt_s, value) for i, value in enumerate(values.tolist()))
    return f"time_s,acceleration_{units}\n{body}"


def _decimals(values: Floats, least: int, within: float) -> int:
    """Decimals that print the values to that part of the largest one, from `least` on."""
    peak = np.abs(values).max()
    # Beyond 300 decimals a power of ten is no longer a float.
    kept = (k for k in range(least, 300) if _off(values, k) <= within * peak)
    return least if math.isinf(within) or peak == 0.0 else next(kept, 300)


def _off(values: Floats, decimals: int) -> float:
    return float(np.abs(values - np.round(values, decimals)).max())


PEAK_FINENESS, PEAK_STEPS = 40, 16
"""Places of a period at which an oscillator's peak is looked for; at most so many of an interval.
"""


def response_spectrum(
    a_mps2: ArrayLike, dt_s: float, periods_s: ArrayLike, damping: float = 0.05
) -> Floats:
    """Pseudo-spectral acceleration of a record, omega^2 times the largest |displacement|.

    The oscillators follow the linearly interpolated record exactly (Nigam and Jennings, Bull.
    Seism. Soc. Am. 59 (1969) 909-922), from rest to the end of the record. Short periods are looked
    at between the samples as well: at `PEAK_FINENESS` places of a period, which miss a peak by
    0.3 % at most, 1 - cos(pi / PEAK_FINENESS); below 2.5 dt at `PEAK_STEPS` places of each
    interval. Free vibration after the record's end is not looked at: pad a record with zeros to
    have it.

    Parameters
    ----------
    a_mps2 : array_like, shape (n,)
        Acceleration [m/s2].
    dt_s : float
        Sampling interval [s], > 0.
    periods_s : array_like, shape (m,)
        Natural periods [s], >= 0; 0 gives the peak acceleration of the record.
    damping : float
        Fraction of critical damping, in [0, 1).

    Returns
    -------
    array, shape (m,)
        Pseudo-spectral acceleration [m/s2].

    Raises
    ------
    InputError
    """
    a, periods = read_only(a_mps2), np.asarray(periods_s, dtype=np.float64)
    _check_spectrum(a, dt_s, periods, damping)
    with np.errstate(divide="ignore", over="ignore"):
        omega = 2.0 * math.pi / periods
    rigid = ~np.isfinite(omega)
    found = np.full(omega.shape, np.abs(a).max())
    steps = _peak_steps(float(dt_s), np.where(rigid, 0.0, omega))
    for each in np.unique(steps[~rigid]).tolist():
        some = ~rigid & (steps == each)
        peak, at = np.empty(some.sum()), np.empty(some.sum(), dtype=np.int64)
        fine = read_only(refined(a, each))
        kernels.oscillator_peaks(fine, dt_s / each, omega[some], float(damping), peak, at)
        found[some] = np.abs(peak)
    return found


def _peak_steps(dt_s: float, omega: Floats) -> NDArray[np.int64]:
    """Steps for each interval at which the peak of an oscillator is looked for: powers of two."""
    needed = np.clip(PEAK_FINENESS * dt_s * omega / (2.0 * math.pi), 1.0, PEAK_STEPS)
    return (2.0 ** np.ceil(np.log2(needed))).astype(np.int64)


def refined(a: Floats, steps: int) -> Floats:
    """Return a record with so many steps in each interval, on its straight lines."""
    if steps == 1:
        return a
    at = np.arange((a.size - 1) * steps + 1)
    return np.interp(at, np.arange(a.size) * steps, a)


def read_only(values: ArrayLike) -> Floats:
    """The values as a contiguous array of doubles that cannot be written to."""
    # numba compiles a second version for writable arrays, so kernels see read-only ones only.
    array = np.ascontiguousarray(values, dtype=np.float64).view()
    array.setflags(write=False)
    return array


def _record(name: str, values: Floats, units: str, dt_s: float) -> Record:
    return Record(name=name, dt_s=float(dt_s), a_mps2=read_only(values * UNITS[units]))


def is_finite_number(value: object) -> bool:
    """Whether the value is a number, not a truth value, of a size below `BEYOND`."""
    if isinstance(value, int | float | np.integer | np.floating) and not isinstance(value, bool):
        return bool(-BEYOND < value < BEYOND)
    return False


def shown(value: object) -> str:
    """The value as a message shows it: quoted, and cut where it is long."""
    text = repr(value)
    return text if len(text) <= 32 else f"{text[:28]}...{text[-1]}"


def raise_any(problems: Iterable[str]) -> None:
    """Raise the first problems with a count of the others, if there are any."""
    left = iter(problems)
    told = list(itertools.islice(left, MAX_PROBLEMS))
    if told:
        # The others are counted without being kept, and not to the end: a file may have millions.
        more = sum(1 for _ in itertools.islice(left, MAX_COUNTED + 1))
        words = f"{more} more" if more <= MAX_COUNTED else f"more than {MAX_COUNTED} more"
        raise InputError([*told, f"... and {words}"] if more else told)


def _check_arguments(name: str, units: str, dt_s: float) -> None:
    problems = []
    if units not in UNITS:
        problems.append(f"{name}: unit is {units!r}; give one of {', '.join(UNITS)}")
    if not (is_finite_number(dt_s) and dt_s > 0.0):
        problems.append(f"{name}: time step dt is {dt_s!r}; give a number of seconds above 0")
    raise_any(problems)


def _check_spectrum(a: Floats, dt_s: float, periods: Floats, damping: float) -> None:
    problems = []
    if a.ndim != 1 or len(a) < 1 or not np.isfinite(a).all():
        problems.append("acceleration: give one column of finite numbers")
    if not (math.isfinite(dt_s) and dt_s > 0.0):
        problems.append(f"time step dt is {dt_s!r}; give a number of seconds above 0")
    if periods.ndim != 1 or not (np.isfinite(periods).all() and (periods >= 0.0).all()):
        problems.append("periods: give one column of numbers of seconds, 0 or above")
    if not 0.0 <= damping < 1.0:
        problems.append(f"damping is {damping!r}; give a fraction from 0 to below 1")
    raise_any(problems)


def fits(values: float | Floats, resolution: float) -> bool:
    """Whether the values are whole multiples of the resolution, to float precision."""
    with np.errstate(over="ignore", invalid="ignore"):
        counts = np.asarray(values) / resolution
        return bool(np.all(np.abs(counts - np.rint(counts)) < 1e-6))
