"""Columns of times: even ones give the step, uneven ones are resampled.

Owns what counts as even. Changes nothing where times are even as far as they are printed. Read
`sampled` first.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from solver.formats.source import Source
from solver.model import Floats, InputError
from solver.records.record import fits, raise_any

MAX_SAMPLES = 2_000_000
"""Samples that the columns of a file may have together once resampled."""

LOSS = 0.005
"""Of the peak: what resampling may move any sample by, where the step is free to be chosen."""

# Gaps of so many usual steps are told one by one.
_GAP_STEPS = 10.0
_FINEST = 200.0
_MAX_GAPS = 3


@dataclass(frozen=True, slots=True, kw_only=True)
class Sampled:
    """Columns at an even step.

    Attributes
    ----------
    dt_s : float
    columns : array, shape (k, n)
    notes : tuple of str
        One or more where the columns were resampled.
    """

    dt_s: float
    columns: Floats
    notes: tuple[str, ...]


def sampled(source: Source, t_s: Floats, columns: Floats, line_of: Callable[[int], int]) -> Sampled:
    """Columns at an even step: as they are where the times are even, else resampled.

    The record is straight between its samples, so resampling is linear. The step is the largest of
    1, 2, 5, 10, ... (of any power of ten) at or below the usual one that keeps every sample within
    `LOSS` of the peak: a step chosen by the times alone would cut off the peaks between its
    samples. Where even the finest step allowed does not, the note says what is lost.

    Parameters
    ----------
    source : Source
    t_s : array, shape (n,)
        Times [s], n >= 2.
    columns : array, shape (k, n)
    line_of : function of int
        Index of the line of a time; asked only for what is told.

    Raises
    ------
    InputError
        Where times do not rise, or a step that the caller gives does not agree.
    """
    _check_rising(source, t_s, line_of)
    step, blur = _even_step(t_s)
    if not math.isnan(step):
        return Sampled(dt_s=_agreed(source, step, blur), columns=columns, notes=())
    if not math.isnan(source.dt_s):
        raise InputError(
            f"{source.name}: found uneven times but dt is {source.dt_s:.6g} s; give no dt, the"
            " record is then resampled"
        )
    return _resampled(source, t_s, columns, line_of)


def is_even(t_s: Floats) -> bool:
    """Whether times rise evenly, as far as they are printed."""
    return bool((np.diff(t_s) > 0.0).all()) and not math.isnan(_even_step(t_s)[0])


def _check_rising(source: Source, t_s: Floats, line_of: Callable[[int], int]) -> None:
    steps = np.diff(t_s)
    usual = float(np.median(steps))
    raise_any(
        f"{source.at(line_of(i + 1))}: found time {t_s[i + 1]:.6g} s after {t_s[i]:.6g} s, "
        f"the usual step being {usual:.6g} s; give rising times"
        for i in np.flatnonzero(~(steps >= 1e-9)).tolist()
    )


def _even_step(t_s: Floats) -> tuple[float, float]:
    """Step of even times and how far their rounding may have moved it; nan where uneven."""
    n = len(t_s) - 1
    step = (t_s[-1] - t_s[0]) / n
    resolution = next((10.0**-k for k in range(10) if fits(t_s, 10.0**-k)), 0.0)
    # Two printed times are off by half the resolution each. A coarser one would hide a lost
    # sample, and steps of whole multiples need no allowance.
    rounding = resolution if resolution <= 0.5 * step else 0.0
    allowance = max(1.001 * rounding, 0.01 * step)
    off = t_s - (t_s[0] + step * np.arange(n + 1))
    if max(np.abs(off).max(), np.abs(np.diff(off)).max()) > allowance:
        return math.nan, 0.0
    return float(step), rounding / n


def _agreed(source: Source, step: float, blur: float) -> float:
    """Step of the times, or the caller's where that agrees."""
    if math.isnan(source.dt_s):
        return _round_step(step, blur)
    if abs(step - source.dt_s) > blur + 1e-4 * step:
        text = f"{_round_step(step, blur):.6g}"
        raise InputError(
            f"{source.name}: the times step by {text} s but dt is {source.dt_s:.6g} s;"
            " give one of them"
        )
    return source.dt_s


def _round_step(step: float, blur: float) -> float:
    """Step [s] freed of the rounding of printed times: a whole rate in Hz if one is that near."""
    whole = 1.0 / max(round(1.0 / step), 1)
    return whole if abs(whole - step) <= blur + 1e-9 * step else float(f"{step:.9g}")


def _resampled(
    source: Source, t_s: Floats, columns: Floats, line_of: Callable[[int], int]
) -> Sampled:
    steps = np.diff(t_s)
    # Differences of times are off by their last binary digits.
    usual, length = float(f"{np.median(steps):.9g}"), float(t_s[-1] - t_s[0])
    best = None
    for step in _candidates(usual):
        if len(columns) * length / step > MAX_SAMPLES:
            break
        even = _interpolated(t_s, columns, step)
        best = (step, even, _loss(t_s, columns, even, step))
        if best[2] <= LOSS:
            break
    if best is None:
        raise InputError(
            f"{source.name}: found times over {length:.6g} s with a usual step of {usual:.6g} s;"
            f" give a record of at most {MAX_SAMPLES:,} steps"
        )
    step, even, loss = best
    moved = f" by more than {100.0 * loss:.2g} % of the peak" if loss > 1e-9 else ""
    note = (
        f"times are uneven, steps of {steps.min():.4g} to {steps.max():.4g} s: resampled at"
        f" {step:g} s by straight lines, which moves no sample{moved}"
    )
    return Sampled(dt_s=step, columns=even, notes=(note, *_gaps(source, t_s, usual, line_of)))


def _candidates(usual: float) -> list[float]:
    """Steps of 1, 2, 5 times a power of ten, falling from the usual one to `_FINEST` of it."""
    power = math.floor(math.log10(usual))
    steps = [float(f"{m}e{k}") for k in range(power, power - 4, -1) for m in (5, 2, 1)]
    return [step for step in steps if usual / _FINEST <= step <= usual]


def _interpolated(t_s: Floats, columns: Floats, step: float) -> Floats:
    count = math.ceil((t_s[-1] - t_s[0]) / step - 1e-6) + 1
    even = t_s[0] + step * np.arange(count)
    return np.array([np.interp(even, t_s, column) for column in columns])


def _loss(t_s: Floats, columns: Floats, even: Floats, step: float) -> float:
    """Largest move of a sample, of the peak of its column.

    Both records are straight lines with corners at the old or the new samples, and they agree at
    the new ones: they differ most at an old one.
    """
    times = t_s[0] + step * np.arange(even.shape[1])
    moved = [
        np.abs(np.interp(t_s, times, new) - old).max()
        for new, old in zip(even, columns, strict=True)
    ]
    peaks = np.abs(columns).max(axis=1)
    return max(move / peak if peak > 0.0 else 0.0 for move, peak in zip(moved, peaks, strict=True))


def _gaps(source: Source, t_s: Floats, usual: float, line_of: Callable[[int], int]) -> list[str]:
    """Say where samples may be lost."""
    gaps = np.flatnonzero(np.diff(t_s) > _GAP_STEPS * usual)
    notes = [
        f"{source.at(line_of(i + 1))}: no samples between {t_s[i]:.6g} and {t_s[i + 1]:.6g} s: a"
        " straight line stands there"
        for i in gaps[:_MAX_GAPS].tolist()
    ]
    more = len(gaps) - _MAX_GAPS
    return [*notes, f"... and {more} more gaps"] if more > 0 else notes
