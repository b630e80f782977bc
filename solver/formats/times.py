"""Columns of times: evenly spaced times give the step; with uneven times the record is resampled.

`0.00 0.01 0.02` has a step of 0.01 s; `0.00 0.01 0.03` is resampled; `0.0 0.0 0.0 0.1` is rounded.

Decides what counts as even. Changes nothing if times are even within the digits printed. Read
`sampled` first.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from itertools import product

import numpy as np

from solver.errors import InputError, Problem, raise_any
from solver.formats.source import Source, Stated
from solver.model import Floats
from solver.records.record import fits
from solver.spaces import NO_BREAK

# Largest total number of samples in the columns of a file after resampling.
MAX_SAMPLES = 2_000_000

# Target for the largest change of a sample by resampling / peak.
LOSS = 0.005

# A gap is an interval longer than this number of typical steps.
_GAP_STEPS = 10.0
_FINEST = 200.0
_MAX_GAPS = 3

# Fewer times, or a step nearer to the last digit of the times, show no rounding.
_MANY, _ROUNDED_WITHIN = 10, 0.9
# Of instruments and programs, the most usual first.
_RATES_HZ = (200, 100, 50, 250, 500, 1000, 400, 125, 128, 256, 512, 80, 120, 150, 75, 300, 5000)

# Step [s], columns of shape (k, n), and notes: one or more if they were resampled.
Even = tuple[float, Floats, tuple[str, ...]]


def sampled(
    source: Source, t_s: Floats, columns: Floats, line_of: Callable[[int], int], unit_s: float = 1.0
) -> Even:
    """Columns at an even step: unchanged if the times are even, otherwise resampled.

    The record is linear between its samples, so resampling is by linear interpolation. The step is
    the largest of 1, 2, 5 times a power of ten, at or below the typical step, that changes no
    sample by more than `LOSS` of the peak: a step chosen from the times alone would cut off peaks
    between its samples. If even the finest step allowed changes more, the note states how much.

    Times `t_s` [s], shape (n,), are printed in units of `unit_s` [s]; `columns` has shape (k, n).
    `line_of` gives the index of the line of a time, for those that a message mentions. Raises
    `InputError` if times do not increase, or a step given by the caller does not agree.
    """
    if rounded := _rounded(source, t_s, columns, unit_s):
        return rounded
    _check_rising(source, t_s, line_of)
    step, blur = _even_step(t_s, unit_s)
    if not math.isnan(step):
        stated = Stated(value=round_step(step, blur), rounding=blur, index=line_of(0))
        return source.step(stated), columns, ()
    if not math.isnan(source.dt_s):
        problem = (
            f"{source.name}: found uneven times but the entered time step is {source.dt_s:.6g} s"
        )
        raise InputError(Problem(problem, "omit it, and the record is resampled", about="dt_s"))
    return _resampled(source, t_s, columns, line_of)


def is_even(t_s: Floats, unit_s: float = 1.0) -> bool:
    """Whether times increase evenly, within the digits printed."""
    return bool((np.diff(t_s) > 0.0).all()) and not math.isnan(_even_step(t_s, unit_s)[0])


def _rounded(source: Source, t_s: Floats, columns: Floats, unit_s: float) -> Even | None:
    """Columns at the caller's step if even times repeat because of rounding; otherwise None."""
    n, resolution = len(t_s) - 1, _resolution(t_s, unit_s)
    step = (t_s[-1] - t_s[0]) / n
    # A time that is there twice by mistake leaves the others at steps of the resolution.
    is_finer = n >= _MANY and 0.0 < step < _ROUNDED_WITHIN * resolution
    off = np.ptp(t_s - step * np.arange(n + 1))
    if not is_finer or np.diff(t_s).min() != 0.0 or off > 2.001 * resolution:
        return None
    # The first and the last time may both be off by half of their last digit.
    blur = 1.001 * resolution / n
    note = f"the times are rounded to {resolution:g}{NO_BREAK}s"
    if abs(source.dt_s - step) <= blur:
        rounding_note = (
            f"{note}: the entered time step is used, and a missing sample would not be noticed"
        )
        return source.dt_s, columns, (rounding_note,)
    usual = (1.0 / rate for rate in _RATES_HZ if abs(1.0 / rate - step) <= blur)
    problem = f"{source.name}: {note}, {n} steps over {t_s[-1] - t_s[0]:.6g} s"
    remedy = f"enter the time step dt, such as {next(usual, step):.9g}"
    raise InputError(Problem(problem, remedy, about="dt_s"))


def _check_rising(source: Source, t_s: Floats, line_of: Callable[[int], int]) -> None:
    steps = np.diff(t_s)
    usual = float(np.median(steps))
    raise_any(
        f"{source.at(line_of(i + 1))}: found time {t_s[i + 1]:.6g} s after {t_s[i]:.6g} s, "
        f"with a typical step of {usual:.6g} s; enter increasing times"
        # Negated: a NaN is no increase either.
        for i in np.flatnonzero(~(steps >= 1e-9)).tolist()
    )


def _even_step(t_s: Floats, unit_s: float) -> tuple[float, float]:
    """Step of even times and the error in it from their rounding; NaN if uneven."""
    n = len(t_s) - 1
    step = (t_s[-1] - t_s[0]) / n
    resolution = _resolution(t_s, unit_s)
    # Each printed time has an error of up to half the resolution. If the resolution is coarser than
    # half a step, no allowance is made: it could hide a missing sample, and times printed in whole
    # steps need none.
    rounding = resolution if resolution <= 0.5 * step else 0.0
    allowance = max(1.001 * rounding, 0.01 * step)
    off = t_s - (t_s[0] + step * np.arange(n + 1))
    if max(np.abs(off).max(), np.abs(np.diff(off)).max()) > allowance:
        return math.nan, 0.0
    return float(step), rounding / n


def _resolution(t_s: Floats, unit_s: float) -> float:
    """Value [s] of the last digit of printed times."""
    printed = t_s / unit_s
    return next((unit_s * 10.0**-k for k in range(10) if fits(printed, 10.0**-k)), 0.0)


def round_step(step: float, blur: float) -> float:
    """Step [s] without the rounding of printed times: that of a whole rate in Hz if within it."""
    whole_rate_s = 1.0 / max(round(1.0 / step), 1)
    return whole_rate_s if abs(whole_rate_s - step) <= blur + 1e-9 * step else float(f"{step:.9g}")


def _resampled(source: Source, t_s: Floats, columns: Floats, line_of: Callable[[int], int]) -> Even:
    steps = np.diff(t_s)
    # Rounded, because differences of times have errors in their last binary digits.
    usual, length = float(f"{np.median(steps):.9g}"), float(t_s[-1] - t_s[0])
    best = None
    power = math.floor(math.log10(usual))
    # Round steps, the largest first: 0.005 s rather than 0.0047 s.
    for k, m in product(range(power, power - 4, -1), (5, 2, 1)):
        step = float(f"{m}e{k}")
        if not usual / _FINEST <= step <= usual:
            continue
        # A short typical step over a long time would ask for more samples than memory holds.
        if len(columns) * length / step > MAX_SAMPLES:
            break
        times = t_s[0] + step * np.arange(math.ceil(length / step - 1e-6) + 1)
        even = np.array([np.interp(times, t_s, column) for column in columns])
        best = (step, even, _loss(t_s, columns, even, step))
        if best[2] <= LOSS:
            break
    if best is None:
        raise InputError(
            f"{source.name}: found times over {length:.6g} s with a typical step of {usual:.6g} s;"
            f" use a record of at most {MAX_SAMPLES:,} steps"
        )
    step, even, loss = best
    moved = f" by more than {100.0 * loss:.2g}% of the peak" if loss > 1e-9 else ""
    note = (
        f"times are uneven, steps of {steps.min():.4g} to {steps.max():.4g}{NO_BREAK}s: resampled"
        f" at {step:g}{NO_BREAK}s by linear interpolation, which changes no sample{moved}"
    )
    return step, even, (note, *_gaps(source, t_s, usual, line_of))


def _loss(t_s: Floats, columns: Floats, even: Floats, step: float) -> float:
    """Largest change of a sample / peak of its column."""
    # Both records are piecewise linear, with corners at the old and the new samples, and agree at
    # the new samples. The largest difference is therefore at an old sample.
    times = t_s[0] + step * np.arange(even.shape[1])
    moved = [
        np.abs(np.interp(t_s, times, even_values) - values).max()
        for even_values, values in zip(even, columns, strict=True)
    ]
    peaks = np.abs(columns).max(axis=1)
    return max(move / peak if peak > 0.0 else 0.0 for move, peak in zip(moved, peaks, strict=True))


def _gaps(source: Source, t_s: Floats, usual: float, line_of: Callable[[int], int]) -> list[str]:
    """Note where samples may be missing."""
    gaps = np.flatnonzero(np.diff(t_s) > _GAP_STEPS * usual)
    notes = [
        f"{source.at(line_of(i + 1))}: no samples between {t_s[i]:.6g} and {t_s[i + 1]:.6g} s:"
        " interpolated linearly"
        for i in gaps[:_MAX_GAPS].tolist()
    ]
    unlisted = len(gaps) - _MAX_GAPS
    return [*notes, f"... and {unlisted} more gaps"] if unlisted > 0 else notes
