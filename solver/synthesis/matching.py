"""Brings a motion's response spectrum to a target: first in frequency, then in time.

Draws nothing at random and decides nothing: `solver.synthesis.suite` does.
Read `make_frame` first, then `shaped` and `matched`.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from solver.kernels import oscillator
from solver.model import Floats
from solver.records.record import DECIMALS, UNITS
from solver.synthesis.target import BAND_HZ, DAMPING, Target, target_sa_g

# A little above 1: a reader with another spectrum routine then still finds the mean above 1.
_AIM = 1.02
_CLOSE = 0.05
_SHAPINGS = 6
_MATCHINGS = 20
_PER_OCTAVE = 24
# Part of a correction taken at once, and how far neighbours may contradict one another.
_RELAXATION = 0.7
_RIDGE = 0.03

_Samples = NDArray[np.int64]

_G = UNITS["g"]
_QUANTUM_G = 10.0 ** -DECIMALS["g"]


@dataclass(frozen=True, slots=True, kw_only=True)
class Frame:
    """What all motions of one sampling, duration and band have in common.

    Attributes
    ----------
    dt_s : float
    envelope : array, shape (n,)
    quiet : array, shape (q, n)
        Shapes that a motion may not contain: what would leave a velocity or displacement at the
        end, and periods far beyond the target's longest.
    freq_hz : array, shape (m,)
        Oscillators to match; the last one is rigid and feels the peak acceleration.
    pulses : array, shape (m, n)
        Their responses to one sample, the pseudo-accelerations 0, 1, ... samples later.
    """

    dt_s: float
    envelope: Floats
    quiet: Floats
    freq_hz: Floats
    pulses: Floats


def make_frame(target: Target, dt_s: float, duration_s: float) -> Frame:
    """Return the frame of a target: its lowest frequency, or three cycles, is the lowest."""
    low_hz = max(min(target[0][0], BAND_HZ[0]), 3.0 / duration_s)
    n = round(duration_s / dt_s) + 1
    from_start = np.linspace(0.0, 1.0, n)
    envelope = np.minimum(1.0, 6.0 * np.minimum(from_start, from_start[::-1]))
    high_hz = min(50.0, 0.4 / dt_s)
    steps = round(_PER_OCTAVE * math.log2(high_hz / low_hz))
    freq_hz = np.append(np.geomspace(low_hz, high_hz, steps + 1), 5.0 / dt_s)
    return Frame(
        dt_s=dt_s,
        envelope=envelope,
        quiet=_quiet(from_start, low_hz * duration_s),
        freq_hz=freq_hz,
        pulses=_pulses(freq_hz * dt_s, n),
    )


def _quiet(from_start: Floats, lowest_cycles: float) -> Floats:
    """Shapes to keep out: a constant, a line, and waves up to 0.7 of the target's lowest.

    Without them a motion may wander for metres where the target asks for nothing.
    """
    waves = range(1, math.floor(0.7 * lowest_cycles) + 1)
    turns = [2.0 * math.pi * k * from_start for k in waves]
    shapes = [np.ones_like(from_start), 2.0 * from_start - 1.0]
    shapes += [shape for turn in turns for shape in (np.cos(turn), np.sin(turn))]
    return np.array(shapes) / math.sqrt(len(from_start))


def _pulses(cycles: Floats, n: int) -> Floats:
    """Responses to a hat of one sample's height and two samples' width, n samples on.

    The hat is the second difference of a ramp, and the ramp's response has a closed form.
    """
    p = 2.0 * math.pi * cycles[:, None]
    kappa = math.sqrt(1.0 - DAMPING**2)
    w = p * np.arange(n + 1)
    decay = np.exp(-DAMPING * w)
    h = decay * np.sin(kappa * w) / kappa
    once = 1.0 - decay * np.cos(kappa * w) - DAMPING * h
    ramp = np.hstack([np.zeros_like(p), w - h - 2.0 * DAMPING * once])
    return (2.0 * ramp[:, 1:-1] - ramp[:, 2:] - ramp[:, :-2]) / p


def goal_mps2(frame: Frame, target: Target) -> Floats:
    """Pseudo-accelerations to aim at [m/s2], one for each oscillator of the frame."""
    return _AIM * _G * target_sa_g(target, frame.freq_hz)


def shaped(frame: Frame, start: Floats, target: Target, goal: Floats) -> Floats:
    """Enveloped motion, its amplitudes corrected by the ratio of goal and spectrum some times."""
    n = len(frame.envelope)
    padded = 1 << (n - 1).bit_length() + 1
    spectrum = np.fft.rfft(frame.envelope * start, padded)
    freq_hz = np.maximum(np.fft.rfftfreq(padded, frame.dt_s), 1e-3)
    low, high = frame.freq_hz[0], frame.freq_hz[-2]
    gain = target_sa_g(target, freq_hz) / np.sqrt(freq_hz)
    gain /= (1.0 + (0.9 * low / freq_hz) ** 8) * (1.0 + (freq_hz / (1.2 * high)) ** 8)
    for _ in range(_SHAPINGS):
        a = _calmed(frame, frame.envelope * np.fft.irfft(spectrum * gain, padded)[:n])
        ratio = np.log(goal / np.abs(_peaks(frame, a)[0]))
        gain *= np.exp(np.interp(np.log(freq_hz), np.log(frame.freq_hz), ratio))
    return a


def _calmed(frame: Frame, a: Floats) -> Floats:
    """Motion without its quiet shapes, by the least change under the envelope."""
    shapes = frame.quiet * frame.envelope
    return a - frame.envelope * (shapes.T @ np.linalg.solve(shapes @ shapes.T, frame.quiet @ a))


def _peaks(frame: Frame, a: Floats) -> tuple[Floats, _Samples]:
    """Peak pseudo-accelerations [m/s2], with their signs, and the samples where they are."""
    seen = a.view()
    seen.setflags(write=False)
    peak, at = np.empty(len(frame.freq_hz)), np.empty(len(frame.freq_hz), dtype=np.int64)
    oscillator.peaks(seen, frame.dt_s, 2.0 * math.pi * frame.freq_hz, DAMPING, peak, at)
    return peak, at


def matched(frame: Frame, a: Floats, goal: Floats) -> Floats:
    """Best of some corrected motions: the one whose farthest ordinate is nearest to the goal."""
    best, least = a, math.inf
    for _ in range(_MATCHINGS):
        peak, at = _peaks(frame, a)
        farthest = float(np.abs(np.log(np.abs(peak) / goal)).max())
        if farthest < least:
            best, least = a, farthest
        if farthest < _CLOSE:
            break
        a = a + _correction(frame, a, (np.sign(peak) * goal - peak) / goal, at, goal)
    return best


def _correction(
    frame: Frame,
    a: Floats,
    off: Floats,
    at: _Samples,
    goal: Floats,
) -> Floats:
    """Least change under the envelope that moves every peak by part of what it is off.

    A peak is the sum of the samples before it, each times its pulse's response at that time: the
    pulse responses reversed. The quiet shapes stay at zero exactly.
    """
    m = len(goal)
    rows = np.zeros((m + len(frame.quiet), len(a)))
    for row, pulse, k, unit in zip(rows, frame.pulses, at, goal, strict=False):
        row[: k + 1] = pulse[k::-1] / unit
    rows[m:] = frame.quiet
    moves = np.append(_RELAXATION * off, -frame.quiet @ a)
    rows *= frame.envelope
    products = rows @ rows.T
    products[np.diag_indices(m)] *= 1.0 + _RIDGE
    return frame.envelope * (rows.T @ np.linalg.solve(products, moves))


def rounded(a: Floats) -> Floats:
    """Round to the quantum that is printed without moving the end of the motion.

    The twice summed record is rounded and differenced twice, so rounding leaves no drift.
    """
    counts = np.rint(np.cumsum(np.cumsum(a / (_G * _QUANTUM_G))))
    values: Floats = np.diff(counts, n=2, prepend=[0.0, 0.0]) / 10.0 ** DECIMALS["g"] * _G
    values.setflags(write=False)
    return values
