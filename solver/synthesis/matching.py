"""Matches a motion's response spectrum to a target: first in frequency, then in the time domain.

A target from 0.1 Hz at steps of 0.01 s over 30 s is matched at 217 frequencies, 24 to an octave or
more, and what its peaks ask is solved as one set of linear equations.

Generates no random numbers and accepts or rejects no motion: `solver.synthesis.suite` does.
Read `make_frame` first, then `shaped` and `matched`; `spectrum_fit` says how closely one matches.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from solver.errors import raise_any
from solver.kernels import oscillator
from solver.model import Floats
from solver.records.acceptance import POINTS_HZ
from solver.records.record import DECIMALS, UNITS, Record, read_only
from solver.records.spectrum import response_spectrum
from solver.rules.ac156 import Target, target_sa_g

DAMPING = 0.05
# Band over which a target must be given.
BAND_HZ = (0.3, 33.3)

# Lowest frequency of the comparison with a target that is given to there.
LONGEST_HZ = 0.1

# Grids of 1/6 octave, shifted against each other, on all of which a component is accepted.
GRIDS = 100

_KNEE_HZ = 1.3

# Accepted ratios to the target on `shifted_grids` over the matched band: smallest, largest, and
# largest difference of the mean from 1.
LEAST, GREATEST, MEAN_OFF = 1.00, 1.30, 0.07


@dataclass(frozen=True, slots=True, kw_only=True)
class SpectrumFit:
    """How closely the pseudo-spectral acceleration of a motion matches its target."""

    freq_hz: Floats
    target_g: Floats
    achieved_g: Floats

    @property
    def ratio(self) -> Floats:
        """Achieved over target."""
        return self.achieved_g / self.target_g

    @property
    def minimum(self) -> float:
        """Smallest ratio."""
        return float(self.ratio.min())

    @property
    def maximum(self) -> float:
        """Largest ratio."""
        return float(self.ratio.max())

    @property
    def mean(self) -> float:
        """Mean ratio, with equal weight for every frequency."""
        return float(self.ratio.mean())


def band(per_octave: int, low_hz: float) -> Floats:
    """Frequencies [Hz] from the lowest to 33.3 Hz, `per_octave` to an octave, with both ends."""
    high_hz = BAND_HZ[1]
    steps = np.arange(math.floor(per_octave * math.log2(high_hz / low_hz)) + 1)
    return np.append(low_hz * 2.0 ** (steps / per_octave), high_hz)


def shifted_grids(low_hz: float) -> Floats:
    """Frequencies [Hz] of `GRIDS` grids of 1/6 octave, one through 1.3 Hz, up to 33.3 Hz.

    A laboratory may start its 1/6-octave grid anywhere.
    """
    first, last = (6 * GRIDS * math.log2(hz / _KNEE_HZ) for hz in (low_hz, BAND_HZ[1]))
    return _KNEE_HZ * 2.0 ** (np.arange(math.ceil(first), math.floor(last) + 1) / (6 * GRIDS))


def spectrum_fit(record: Record, target: Target, freq_hz: Floats | None = None) -> SpectrumFit:
    """Compare a record with its target, by default at 1/12 octave up to 33.3 Hz.

    That begins where the target does, but not below 0.1 Hz.
    """
    if freq_hz is None:
        freq_hz = band(12, max(min(float(target[0][0]), BAND_HZ[0]), LONGEST_HZ))
    achieved = response_spectrum(record.a_mps2, record.dt_s, 1.0 / freq_hz, DAMPING) / UNITS["g"]
    return SpectrumFit(freq_hz=freq_hz, target_g=target_sa_g(target, freq_hz), achieved_g=achieved)


def keeps(fit: SpectrumFit) -> bool:
    """Whether a fit is within `LEAST`, `GREATEST` and `MEAN_OFF`."""
    return fit.minimum >= LEAST and fit.maximum <= GREATEST and abs(fit.mean - 1.0) <= MEAN_OFF


# Accepted ratios to the target, and the one at which a low peak is aimed. An interval instead of
# one value, because corrections at neighboring frequencies conflict, most of all at long periods.
_LEAST, _AIM, _MOST = 1.0, 1.02, 1.05
# Mean ratio / smallest ratio at which matching stops: the mean excess of the motion when scaled so
# that no peak is below the target, wherever it is.
_CLOSE = 1.048
_SHAPINGS = 6
# As the points of the acceptance, which are at most 1/24 octave apart.
_PER_OCTAVE = 24
# Spectra have sharp minima between the matched frequencies: from the fourth correction on they are
# looked for after every second, at so many points of an octave, and matched as well.
_LOOKED_AT, _FIRST, _EVERY, _CORRECTIONS = 96, 4, 2, 48
# Regularization of the equations: small for peaks outside the interval, larger for those inside,
# which may move. The smaller it is at low frequencies, the less is left of a record's phases (mean
# cosine, 1 to 10 Hz, eight records: 0.82 with 0.004 below 0.3 Hz, 0.88 without).
_RIDGE_OUTSIDE, _RIDGE_INSIDE = 0.015, 0.2
# Above this frequency [Hz], of every third oscillator, so many more crests beyond the interval are
# lowered at once: one at a time, the next would come up as the peak.
_CRESTS_HZ, _CRESTS_OF_EVERY, _CRESTS = 2.0, 3, 60
# A pulse response ends where it has decayed to this; the equations are summed over so many samples
# at a time, of the responses that are not zero there.
_DECAYED, _BLOCK = 1e-3, 500

_Samples = NDArray[np.int64]

_G = UNITS["g"]
# The last decimal that `write_record` prints.
_QUANTUM_G = 10.0 ** -DECIMALS["g"]


@dataclass(frozen=True, slots=True, kw_only=True)
class MatchingFrame:
    """Data common to all motions of one target, sampling interval and duration."""

    target: Target
    dt_s: float
    envelope: Floats  # shape (n,)
    # Shapes that a motion must not contain: those that would leave a residual velocity or
    # displacement, and periods much longer than the longest of the target; shape (q, n).
    quiet: Floats
    freq_hz: Floats  # of the oscillators to match; the last one is rigid, for the peak acceleration


def make_frame(target: Target, dt_s: float, duration_s: float) -> MatchingFrame:
    """Return the frame of a target.

    The lowest frequency is that of the target or three cycles in the duration, whichever is higher.
    The duration is the time of the last sample.
    """
    _check(target, dt_s, duration_s)
    low_hz = max(min(target[0][0], BAND_HZ[0]), 3.0 / duration_s)
    n = round(duration_s / dt_s) + 1
    from_start = np.linspace(0.0, 1.0, n)
    # A sixth of the duration each for rise and decay: 5, 20 and 5 s of 30 s, as in AC156.
    envelope = np.minimum(1.0, 6.0 * np.minimum(from_start, from_start[::-1]))
    # The last oscillator has five cycles per step: it is rigid and matches the peak acceleration.
    freq_hz = np.append(_matched_hz(low_hz, min(50.0, 0.4 / dt_s)), 5.0 / dt_s)
    return MatchingFrame(
        target=target,
        dt_s=dt_s,
        envelope=envelope,
        quiet=_quiet(from_start, low_hz * duration_s),
        freq_hz=freq_hz,
    )


def _check(target: Target, dt_s: float, duration_s: float) -> None:
    freq_hz, sa_g = (np.asarray(column, dtype=np.float64) for column in target)
    problems = []
    if freq_hz.ndim != 1 or freq_hz.shape != sa_g.shape or len(freq_hz) < 2:
        problems.append("target spectrum: use as many accelerations as frequencies, at least 2")
    elif not (freq_hz[0] > 0.0 and np.all(np.diff(freq_hz) > 0.0) and np.isfinite(freq_hz[-1])):
        problems.append("target spectrum: use increasing frequencies above 0 [Hz]")
    if not np.all((sa_g > 0.0) & np.isfinite(sa_g)):
        problems.append("target spectrum: use accelerations above 0 [g]")
    if not 0.001 <= dt_s <= 0.01:
        problems.append(f"time step dt is {dt_s!r}; use 0.001 to 0.01 s")
    if not 10.0 <= duration_s <= 60_000 * dt_s:
        problems.append(f"duration is {duration_s!r}; use from 10 s to 60,000 time steps")
    raise_any(problems)


def _matched_hz(low_hz: float, high_hz: float) -> Floats:
    """Frequencies to match: those of the acceptance, and as close to each other beyond them."""
    inside = POINTS_HZ[(low_hz < POINTS_HZ) & (high_hz > POINTS_HZ)]
    knots = np.concatenate([[low_hz], inside, [high_hz]])
    counts = np.ceil(_PER_OCTAVE * np.diff(np.log2(knots)) - 1e-9).astype(int)
    parts = [
        np.geomspace(start, end, count, endpoint=False)
        for start, end, count in zip(knots[:-1], knots[1:], counts, strict=True)
    ]
    return np.append(np.concatenate(parts), high_hz)


def _quiet(from_start: Floats, lowest_cycles: float) -> Floats:
    """Shapes to exclude: a constant, a line, and waves up to 0.7 of the lowest target frequency."""
    # Otherwise a motion may drift by meters at periods for which there is no target.
    waves = range(1, math.floor(0.7 * lowest_cycles) + 1)
    turns = [2.0 * math.pi * k * from_start for k in waves]
    shapes = [np.ones_like(from_start), 2.0 * from_start - 1.0]
    for turn in turns:
        shapes += (np.cos(turn), np.sin(turn))
    return np.array(shapes) / math.sqrt(len(from_start))


def _goal_mps2(frame: MatchingFrame) -> Floats:
    """Target pseudo-accelerations [m/s2], one for each oscillator of the frame."""
    return _G * target_sa_g(frame.target, frame.freq_hz)


def shaped(frame: MatchingFrame, start: Floats) -> Floats:
    """Enveloped motion whose Fourier amplitudes are corrected iteratively by goal / spectrum."""
    n, goal = len(frame.envelope), _goal_mps2(frame)
    # Twice the length or more: a changed amplitude must not come round from the end.
    padded = 1 << (n - 1).bit_length() + 1
    spectrum = np.fft.rfft(start, padded)
    # The frequency 0 has no logarithm.
    freq_hz = np.maximum(np.fft.rfftfreq(padded, frame.dt_s), 1e-3)
    low, high = frame.freq_hz[0], frame.freq_hz[-2]
    # Random vibration: PSA ~ amplitude x sqrt(frequency) at light damping.
    gain = target_sa_g(frame.target, freq_hz) / np.sqrt(freq_hz)
    # The gain falls off outside the band that is matched.
    gain /= (1.0 + (0.9 * low / freq_hz) ** 8) * (1.0 + (freq_hz / (1.2 * high)) ** 8)
    for _ in range(_SHAPINGS):
        a = _calmed(frame, frame.envelope * np.fft.irfft(spectrum * gain, padded)[:n])
        ratio = np.log(_AIM * goal / np.abs(_peaks(frame, a)[0]))
        gain *= np.exp(np.interp(np.log(freq_hz), np.log(frame.freq_hz), ratio))
    return a


def _calmed(frame: MatchingFrame, a: Floats) -> Floats:
    """Remove the quiet shapes from a motion by the smallest change under the envelope."""
    shapes = frame.quiet * frame.envelope
    return a - frame.envelope * (shapes.T @ np.linalg.solve(shapes @ shapes.T, frame.quiet @ a))


def _peaks(frame: MatchingFrame, a: Floats) -> tuple[Floats, _Samples]:
    """Peak pseudo-accelerations [m/s2] with their signs, and the samples at which they occur."""
    peak, samples = np.empty(len(frame.freq_hz)), np.empty(len(frame.freq_hz), dtype=np.int64)
    oscillator.peaks(
        read_only(a), frame.dt_s, 2.0 * math.pi * frame.freq_hz, DAMPING, peak, samples
    )
    return peak, samples


def matched(frame: MatchingFrame, a: Floats) -> Floats:
    """Corrected motion with a small mean ratio / smallest ratio to the target, wherever it is.

    The spectrum is also evaluated between the matched frequencies, and its minima are added to
    them.
    """
    between = replace(frame, freq_hz=band(_LOOKED_AT, float(frame.freq_hz[0])))
    goal = _goal_mps2(between)
    best, smallest = a, math.inf
    for count in range(1, _CORRECTIONS + 1):
        a = _corrected(frame, a)
        if count >= _FIRST and count % _EVERY == 0:
            ratio = np.abs(_peaks(between, a)[0]) / goal
            excess = float(ratio.mean() / ratio.min())
            if excess < smallest:
                best, smallest = a, excess
            if excess <= _CLOSE:
                break
            # The rigid oscillator stays last.
            inner = ratio[1:-1]
            is_least = (inner <= ratio[:-2]) & (inner < ratio[2:]) & (inner < _LEAST)
            low_hz = between.freq_hz[np.flatnonzero(is_least) + 1]
            more_hz = np.union1d(frame.freq_hz[:-1], low_hz)
            frame = replace(frame, freq_hz=np.append(more_hz, frame.freq_hz[-1]))
    return best


def _corrected(frame: MatchingFrame, a: Floats) -> Floats:
    """Make the smallest change under the envelope's square that moves peaks into the interval."""
    # The square leaves the ends weak, where late peaks of long periods would add.
    rows = _asked(frame, a)
    blocks = _blocks(frame, rows)
    m, q = len(rows.radians), len(frame.quiet)
    products = np.zeros((m + q, m + q))
    for of_rows, block in blocks:
        products[np.ix_(of_rows, of_rows)] += block @ block.T
    # The quiet shapes have no ridge: they stay zero exactly, whatever the peaks ask.
    products[np.diag_indices(m)] *= 1.0 + rows.ridge
    # The right-hand side also removes what remains of the quiet shapes.
    factors = np.linalg.solve(products, np.append(rows.moves, -frame.quiet @ a))
    change = [factors[of_rows] @ block for of_rows, block in blocks]
    return a + frame.envelope**2 * np.concatenate(change)


class _Rows(NamedTuple):
    """Changes of oscillators at samples, as fractions of their goals, and their regularization."""

    radians: Floats
    goal: Floats
    at: _Samples
    moves: Floats
    ridge: Floats


def _asked(frame: MatchingFrame, a: Floats) -> _Rows:
    """Return the peaks of all oscillators, and the highest other crests outside the interval."""
    goal, omega = _goal_mps2(frame), 2.0 * math.pi * frame.freq_hz
    peak, samples = _peaks(frame, a)
    ratio = np.abs(peak) / goal
    moves = np.where(ratio < _LEAST, _AIM - ratio, np.minimum(_MOST - ratio, 0.0))
    some = np.flatnonzero(frame.freq_hz > _CRESTS_HZ)[::-_CRESTS_OF_EVERY]
    which, where, values = oscillator.crests(
        read_only(a), frame.dt_s, omega[some], DAMPING, _MOST * goal[some]
    )
    which = some[which]
    beyond = np.abs(values) / goal[which] - _MOST
    # A peak is at the end of its step.
    beyond[np.abs(where - samples[which]) <= 1] = 0.0
    # A stable sort: the order of equal crests is the same on every processor.
    farthest = np.argsort(-beyond, kind="stable")[:_CRESTS]
    farthest = farthest[beyond[farthest] > 0.0]
    every = np.append(np.arange(len(goal)), which[farthest])
    is_outside = np.append((ratio < _LEAST) | (ratio > _MOST), np.full(len(farthest), True))
    return _Rows(
        radians=omega[every] * frame.dt_s,
        goal=goal[every],
        at=np.append(samples, where[farthest]),
        moves=np.append(np.sign(peak) * moves, -np.sign(values[farthest]) * beyond[farthest]),
        ridge=np.where(is_outside, _RIDGE_OUTSIDE, _RIDGE_INSIDE),
    )


def _blocks(frame: MatchingFrame, asked: _Rows) -> list[tuple[_Samples, Floats]]:
    """Rows of the equations under the envelope's square, by block of samples: which, and values."""
    # A peak is the sum of the samples before it, each multiplied by the pulse response after the
    # time between them, which is the pulse response reversed in time. The quiet shapes are the last
    # rows; they stay exactly zero.
    m, n, q = len(asked.radians), len(frame.envelope), len(frame.quiet)
    rows, begin = np.zeros((m + q, n)), np.zeros(m + q)
    begin[:m] = oscillator.reversed_pulses(asked.radians, DAMPING, asked.at, _DECAYED, rows[:m])
    rows[m:] = frame.quiet
    end = np.append(asked.at, np.full(q, n))
    unit, allowed = np.append(asked.goal, np.ones(q)), frame.envelope**2
    blocks = []
    for first in range(0, n, _BLOCK):
        part = slice(first, first + _BLOCK)
        of_rows = np.flatnonzero((begin < first + _BLOCK) & (end >= first))
        blocks.append((of_rows, rows[of_rows, part] * (allowed[part] / unit[of_rows, None])))
    return blocks


def rounded(a: Floats) -> Floats:
    """Round to the decimals printed, without changing the velocity and displacement at the end.

    The record is summed twice, rounded and differenced twice, so rounding causes no drift.
    """
    counts = np.rint(np.cumsum(np.cumsum(a / (_G * _QUANTUM_G))))
    return read_only(np.diff(counts, n=2, prepend=[0.0, 0.0]) / 10.0 ** DECIMALS["g"] * _G)
