"""Processing of a record, in fixed steps from trimming to zeros at the end.

A barely visible offset of 0.01 g drifts 20 m in 20 s; `Processing(baseline=0)` removes it.

Reads no files and evaluates no results: `solver.records.measures` gives the remaining drift.
Read `Processing` first, then `process`.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from solver.errors import InputError, raise_any
from solver.model import Floats
from solver.records.record import Record, own
from solver.spaces import NO_BREAK

MAX_DEGREE = 8
MAX_ORDER = 12
MAX_SAMPLES = 4_000_000

# Description of a record without processing.
AS_RECORDED = "as recorded"

# Start of the transition band of the anti-alias filter / new Nyquist frequency.
_PASSED = 0.8
# Zeros added on either side for the filter transients, in new steps; removed afterwards.
_RINGING = 50
# If the new step is not a whole multiple of the old one, the filtered record is computed with this
# many points per old step before linear interpolation. The interpolation error is then at most 2e-4
# for the shortest period in the record.
_FINER = 64


@dataclass(frozen=True, slots=True, kw_only=True)
class Processing:
    """Processing steps for a record, in the order of the fields; the defaults change nothing.

    Attributes
    ----------
    from_s, to_s : float
        Part of the record to keep [s from its first sample], including samples at the limits.
    baseline : int
        Degree of the polynomial that is fitted to the acceleration by least squares and removed:
        0 the mean, 1 a straight line; -1 none.
    highpass_hz, lowpass_hz : float
        Corner frequencies [Hz]; 0 for none.
    order : int
        Order n of both filters. The high-pass multiplies the amplitude at the frequency f by
        1 / sqrt(1 + (corner / f)^(2 n)), the low-pass by 1 / sqrt(1 + (f / corner)^(2 n)). The
        filters are applied once and are zero-phase; the gain at the corner is 1 / sqrt(2). A
        Butterworth filter of order n / 2 applied forward and backward, as by ``filtfilt``, has
        the same roll-off.
    dt_s : float
        New sampling interval [s]; 0 keeps the interval.
    pad_s : float
        Duration of zeros added at the end [s], during which a sliding array can come to rest.
    """

    from_s: float = 0.0
    to_s: float = math.inf
    baseline: int = -1
    highpass_hz: float = 0.0
    lowpass_hz: float = 0.0
    order: int = 4
    dt_s: float = 0.0
    pad_s: float = 0.0

    def words(self) -> str:
        """Describe the processing in one line for a report."""
        names = {-1: "", 0: "mean removed", 1: "straight line removed"}
        baseline = names.get(self.baseline, f"polynomial of degree {self.baseline} removed")
        parts = [_trim_words(self), baseline, *_filter_words(self)]
        if self.dt_s > 0.0:
            parts.append(f"resampled at {self.dt_s:g}{NO_BREAK}s")
        if self.pad_s > 0.0:
            parts.append(f"{self.pad_s:g}{NO_BREAK}s of zeros added at the end")
        return "; ".join(part for part in parts if part) or AS_RECORDED

    def problems(self) -> tuple[str, ...]:
        """Errors that do not depend on the record, one sentence each."""
        return (*_range_problems(self), *_filter_problems(self))


def process(record: Record, processing: Processing) -> Record:
    """Process a record: trim, baseline, filters, resampling, zeros at the end.

    The steps are applied in this order.
    The filters are applied to the Fourier spectrum of the whole record with pads of zeros of
    1.5 n / corner [s] before and after it. Boore, Bull. Seism. Soc. Am. 95 (2005) 745-750,
    doi:10.1785/0120040160, requires that length in total. The filter transients in the pads belong
    to the motion: if they are removed, velocity and displacement no longer end at zero. The pads
    are therefore kept, and the result starts earlier than the record by one pad.

    A finer step is interpolated linearly between samples; if it divides the old step, the motion
    is exactly the same for the solver. For a coarser step all content above the new Nyquist
    frequency is removed first by a zero-phase filter, with a cosine transition over the last fifth
    below it.

    No taper is applied: a record that does not start and end near zero has a step there.

    Parameters
    ----------
    record : Record
    processing : Processing

    Returns
    -------
    Record
        With the same name. Its length depends only on the record's length and step and on the
        processing.

    Raises
    ------
    InputError
        If the processing is invalid, or invalid for this record.

    Examples
    --------
    >>> from solver import read_record
    >>> record = read_record("projects/example/records/RM1-x.csv")
    >>> process(record, Processing(baseline=0, pad_s=5.0))
    Record('RM1-x.csv', 7001 samples at 0.005 s)
    """
    problems = processing.problems() or _record_problems(record, processing)
    if problems:
        raise InputError([f"{record.name}: {problem}" for problem in problems])
    start, stop = _bounds(record, processing)
    a = _level(record.a_mps2[start:stop], processing.baseline)
    a = _resampled(_filtered(a, record.dt_s, processing), record.dt_s, processing.dt_s)
    dt_s = processing.dt_s or record.dt_s
    a = np.concatenate([a, np.zeros(_steps(processing.pad_s, dt_s))])
    return Record(name=record.name, dt_s=dt_s, a_mps2=own(a))


def process_together(records: Sequence[Record], processing: Processing) -> tuple[Record, ...]:
    """Process all components of one motion in the same way, with equal steps and lengths."""
    first = records[0]
    problems = [
        f"{later.name}: {len(later.a_mps2)} samples of {later.dt_s:g} s, but {first.name} has "
        f"{len(first.a_mps2)} of {first.dt_s:g} s; use components of one length and step"
        for later in records[1:]
        if (len(later.a_mps2), later.dt_s) != (len(first.a_mps2), first.dt_s)
    ]
    raise_any(problems)
    return tuple(process(record, processing) for record in records)


def _steps(seconds: float, dt_s: float) -> int:
    """Number of whole steps that cover a time, with an allowance for rounding of the quotient."""
    # 0.07 s / 0.01 s is 7.000000000000001.
    return math.ceil(seconds / dt_s - 1e-6)


def _bounds(record: Record, processing: Processing) -> tuple[int, int]:
    """Indices of the first sample kept and of the first sample after the part kept."""
    last = len(record.a_mps2) - 1
    # `to_s` may be infinite, which has no floor.
    end = min(processing.to_s / record.dt_s + 1e-6, float(last))
    return _steps(processing.from_s, record.dt_s), math.floor(end) + 1


def _level(a: Floats, degree: int) -> Floats:
    """Remove the polynomial fitted by least squares."""
    if degree < 0:
        return a
    # Legendre polynomials are nearly orthogonal on the samples, so the fit is well conditioned.
    basis = np.polynomial.legendre.legvander(np.linspace(-1.0, 1.0, len(a)), degree)
    fitted = np.linalg.lstsq(basis, a, rcond=None)[0]
    return np.asarray(a - basis @ fitted)


def _filtered(a: Floats, dt_s: float, processing: Processing) -> Floats:
    """Apply the high-pass and low-pass filters with pads of zeros, which are kept."""
    pad_s = _pad_s(processing)
    if pad_s == 0.0:
        return a
    # Without the pads the spectrum is that of a periodic record: its end would ring into its start.
    a = np.pad(a, _steps(pad_s, dt_s))
    gain = _gain(_frequencies(len(a), dt_s), processing)
    return np.fft.irfft(np.fft.rfft(a) * gain, len(a))


def _frequencies(count: int, dt_s: float) -> Floats:
    return np.asarray(np.fft.rfftfreq(count, dt_s), dtype=np.float64)


def _pad_s(processing: Processing) -> float:
    """Length of the pad of zeros on either side that the filters need [s]."""
    corners = [f for f in (processing.highpass_hz, processing.lowpass_hz) if f > 0.0]
    return max((1.5 * processing.order / f for f in corners), default=0.0)


def _gain(freq_hz: Floats, processing: Processing) -> Floats:
    """Gain of the high- and the low-pass at frequencies [Hz], 0 included."""
    gain = np.ones_like(freq_hz)
    power = 2 * processing.order
    with np.errstate(divide="ignore", over="ignore"):
        if processing.highpass_hz > 0.0:
            # Butterworth, one pass: 1 / sqrt(1 + (fc / f)^2n); at f = 0 it is 1 / inf.
            gain /= np.sqrt(1.0 + (processing.highpass_hz / freq_hz) ** power)
        if processing.lowpass_hz > 0.0:
            gain /= np.sqrt(1.0 + (freq_hz / processing.lowpass_hz) ** power)
    return gain


def _resampled(a: Floats, dt_s: float, new_s: float) -> Floats:
    """Resample the record at a new step, from its first sample to the last one covered."""
    ratio = new_s / dt_s
    if new_s == 0.0 or _is_near(ratio, 1.0):
        return a
    # Allows for a quotient that is just below a whole number because of rounding.
    count = math.floor((len(a) - 1) / ratio + 1e-6) + 1
    if ratio > 1.0:
        finer = _finer(ratio)
        a, ratio = _without_aliases(a, ratio, finer), ratio * finer
    if _is_whole(ratio):
        # Existing samples are used without interpolation.
        return a[:: round(ratio)][:count]
    # With a step that divides the old one, common samples stay the same to the last bit.
    parts = 1.0 / ratio
    places = np.arange(count) / (round(parts) if _is_whole(parts) else parts)
    return np.interp(places, np.arange(len(a)), a)


def _without_aliases(a: Floats, ratio: float, finer: int) -> Floats:
    """Remove content above the new Nyquist frequency; the result has `finer` points per step."""
    pad = math.ceil(_RINGING * ratio)
    wide = np.pad(a, pad)
    # In cycles per new step, of which the gain is zero at 1/2 and above.
    cycles = ratio * _frequencies(len(wide), 1.0)
    part = np.clip((2.0 * cycles - _PASSED) / (1.0 - _PASSED), 0.0, 1.0)
    spectrum = np.fft.rfft(wide) * (0.5 + 0.5 * np.cos(math.pi * part))
    # Zeros added above the spectrum give the same curve at more points. The factor compensates for
    # `irfft`, which divides by the number of points.
    drawn = finer * np.fft.irfft(spectrum, finer * len(wide))
    return np.asarray(drawn[finer * pad : finer * (pad + len(a) - 1) + 1])


def _finer(ratio: float) -> int:
    return 1 if _is_whole(ratio) else _FINER


def _is_whole(ratio: float) -> bool:
    return _is_near(ratio, round(ratio))


def _is_near(ratio: float, target: float) -> bool:
    return abs(ratio - target) <= 1e-9 * target


def _trim_words(processing: Processing) -> str:
    if processing.from_s <= 0.0 and math.isinf(processing.to_s):
        return ""
    end = "the end" if math.isinf(processing.to_s) else f"{processing.to_s:g}{NO_BREAK}s"
    return f"cut to {processing.from_s:g}{NO_BREAK}s to {end}"


def _filter_words(processing: Processing) -> list[str]:
    corners = {"high-pass": processing.highpass_hz, "low-pass": processing.lowpass_hz}
    parts = [
        f"{name} {corner:g}{NO_BREAK}Hz, order {processing.order}, zero phase"
        for name, corner in corners.items()
        if corner > 0.0
    ]
    if parts:
        parts.append(f"pads of {_pad_s(processing):g}{NO_BREAK}s before and after are kept")
    return parts


def _range_problems(processing: Processing) -> list[str]:
    """Errors for values that are out of range for any record."""
    problems = []
    # Negated, so that NaN is refused.
    if not (0.0 <= processing.from_s < processing.to_s):
        problems.append(
            f"cut from {processing.from_s:g} s to {processing.to_s:g} s; enter two times, the "
            f"first 0 or above, the second later"
        )
    if not -1 <= processing.baseline <= MAX_DEGREE:
        problems.append(
            f"degree of the baseline is {processing.baseline}; enter 0 (mean) to {MAX_DEGREE}, "
            f"or -1 for none"
        )
    for name, value in (("new time step", processing.dt_s), ("zeros at the end", processing.pad_s)):
        if not 0.0 <= value < math.inf:
            problems.append(f"{name}: {value:g} s; enter a number of seconds, 0 for none")
    return problems


def _filter_problems(processing: Processing) -> list[str]:
    problems = []
    high, low = processing.highpass_hz, processing.lowpass_hz
    for name, corner in (("high-pass", high), ("low-pass", low)):
        if not 0.0 <= corner < math.inf:
            problems.append(f"{name} corner is {corner:g} Hz; enter a frequency, 0 for none")
    if 0.0 < low <= high:
        problems.append(
            f"high-pass corner is {high:g} Hz, low-pass corner {low:g} Hz; enter a low-pass above "
            f"the high-pass"
        )
    # With a first-order high-pass the displacement drifts without limit.
    if not 2 <= processing.order <= MAX_ORDER:
        problems.append(f"filter order is {processing.order}; enter 2 to {MAX_ORDER}")
    return problems


def _record_problems(record: Record, processing: Processing) -> list[str]:
    """Errors of a processing for this record; the processing itself is valid."""
    problems = []
    length_s = (len(record.a_mps2) - 1) * record.dt_s
    start, stop = _bounds(record, processing)
    # A polynomial of degree n fits n + 1 samples exactly and would leave only zeros.
    if stop - start < max(2, processing.baseline + 2):
        problems.append(
            f"cut from {processing.from_s:g} s to {processing.to_s:g} s leaves "
            f"{max(stop - start, 0)} samples of a record of {length_s:g} s; use a longer part"
        )
    nyquist_hz = 0.5 / record.dt_s
    corners = {"high-pass": processing.highpass_hz, "low-pass": processing.lowpass_hz}
    problems += [
        f"{name} corner is {corner:g} Hz; enter less than {nyquist_hz:g} Hz, half the sampling rate"
        for name, corner in corners.items()
        if corner >= nyquist_hz
    ]
    return problems or _size_problems(record, processing, length_s)


def _size_problems(record: Record, processing: Processing, length_s: float) -> list[str]:
    new_s = processing.dt_s or record.dt_s
    if new_s > length_s:
        return [f"new time step is {new_s:g} s; enter less than the {length_s:g} s of the record"]
    ratio = new_s / record.dt_s
    filtered_s = length_s + 2.0 * _pad_s(processing)
    drawn = _finer(ratio) if ratio > 1.0 else 1
    # What is longest on the way: the filtered record at its finest, or the result.
    count = max(drawn * filtered_s / record.dt_s, (filtered_s + processing.pad_s) / new_s)
    if count > MAX_SAMPLES:
        return [f"gives {count:.2g} samples; use a larger step, higher corners or fewer zeros"]
    return []
