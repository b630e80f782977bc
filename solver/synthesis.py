"""Makes roof motions, from seeded noise, whose response spectra follow a target.

Knows no code rules: targets come in as corner points, straight on log-log axes, flat beyond.
Read `make_suite` first, then `synthesise`.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from solver import kernels
from solver.model import Floats, InputError
from solver.motion import DECIMALS, UNITS, Record, response_spectrum

Target = tuple[Floats, Floats]
"""Corner points of a target spectrum: frequencies [Hz], rising, and accelerations [g]."""

DAMPING = 0.05
BAND_HZ = (0.3, 33.3)
"""Where a motion has to keep to its target; down to the first corner it follows roughly."""

LEAST, GREATEST, MEAN_OFF = 0.92, 1.25, 0.04
"""Accepted ratios to the target, at 1/48 octave over the band; the mean is off 1 by the last."""

CORRELATION = 0.3
"""Largest correlation coefficient of two components of one motion."""

DRAWS = 20

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
class SpectrumFit:
    """How a motion keeps to its target.

    Attributes
    ----------
    freq_hz, target_g, achieved_g : array, shape (m,)
        Frequencies [Hz], target and pseudo-spectral acceleration of the motion [g].
    """

    freq_hz: Floats
    target_g: Floats
    achieved_g: Floats

    @property
    def ratio(self) -> Floats:
        """Achieved over target."""
        return self.achieved_g / self.target_g


@dataclass(frozen=True, slots=True, kw_only=True)
class _Frame:
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


def make_suite(
    horizontal_target: Target,
    vertical_target: Target,
    *,
    count: int,
    seed: int,
    dt_s: float = 0.005,
    duration_s: float = 30.0,
) -> list[tuple[Record, Record]]:
    """Make motions of a horizontal and a vertical component each.

    Motion k of a seed is the same whatever the count. A component that misses its target or goes
    with the other one (`CORRELATION`) is drawn again.

    Parameters
    ----------
    horizontal_target, vertical_target : tuple of array
        Corner points: frequencies [Hz] and pseudo-spectral accelerations [g], 5 % damping.
    count : int
    seed : int
        >= 0.
    dt_s, duration_s : float
        Sampling interval and time of the last sample [s]; a sixth of the duration to rise and a
        sixth to decay: 5, 20 and 5 s of 30 s, as AC156 has it.

    Returns
    -------
    list of tuple of Record
        Horizontal and vertical, named ``motion-01-h``, ``motion-01-v`` and so on.

    Raises
    ------
    InputError
        Where an argument is impossible, or no motion is found that meets the target.
    """
    if count < 1 or seed < 0:
        raise InputError(f"suite: count {count} and seed {seed}; give at least 1 and at least 0")
    suite = []
    for k, sequence in enumerate(np.random.SeedSequence(seed).spawn(count), start=1):
        rng = np.random.Generator(np.random.PCG64(sequence))
        horizontal = synthesise(
            horizontal_target, rng=rng, dt_s=dt_s, duration_s=duration_s, name=f"motion-{k:02d}-h"
        )
        vertical = synthesise(
            vertical_target,
            rng=rng,
            dt_s=dt_s,
            duration_s=duration_s,
            name=f"motion-{k:02d}-v",
            unlike=(horizontal,),
        )
        suite.append((horizontal, vertical))
    return suite


def synthesise(
    target: Target,
    *,
    rng: np.random.Generator,
    dt_s: float,
    duration_s: float,
    name: str,
    unlike: Sequence[Record] = (),
) -> Record:
    """Make one component whose 5 % damped spectrum follows the target.

    Sinusoids of random phase under an envelope (Gasparini and Vanmarcke, SIMQKE, MIT R76-4,
    1976), shaped in frequency, then corrected in time by the reversed impulse responses of the
    oscillators (Lilhanand and Tseng, 9th World Conf. Earthquake Eng. II (1988) 819-824). Velocity
    and displacement are back at zero at the end, exactly for straight lines between samples. The
    record is rounded to what `solver.motion.write_record` prints in g before it is checked.

    Parameters
    ----------
    target : tuple of array
        Corner points: frequencies [Hz], rising, and pseudo-spectral accelerations [g].
    rng : Generator
        Source of the phases; the same state gives the same motion.
    dt_s, duration_s : float
        Sampling interval, 0.001 to 0.01, and time of the last sample, from 10 [s].
    name : str
    unlike : sequence of Record
        Components, sampled alike, that this one may not go with (`CORRELATION`).

    Raises
    ------
    InputError
        Where an argument is impossible, or `DRAWS` motions all miss the target.
    """
    _check(target, dt_s, duration_s)
    low_hz = max(min(target[0][0], BAND_HZ[0]), 3.0 / duration_s)
    frame = _frame(low_hz, dt_s, duration_s)
    goal = _AIM * _G * target_sa_g(target, frame.freq_hz)
    for _ in range(DRAWS):
        a = _matched(frame, _shaped(frame, rng, target, goal), goal)
        record = Record(name=name, dt_s=dt_s, a_mps2=_rounded(a))
        if _meets(target, record) and all(_differ(record, other) for other in unlike):
            return record
    raise InputError(
        f"{name}: {DRAWS} motions of {duration_s:g} s all miss the target spectrum; "
        "give a smoother target or a longer duration"
    )


def target_sa_g(target: Target, freq_hz: Floats) -> Floats:
    """Target acceleration [g] at frequencies [Hz]: log-log between the corners, flat beyond."""
    corners_hz, corners_g = (np.log(np.asarray(column)) for column in target)
    return np.exp(np.interp(np.log(freq_hz), corners_hz, corners_g))


def spectrum_fit(record: Record, target: Target, freq_hz: Floats | None = None) -> SpectrumFit:
    """Compare a record with its target, by default at 1/12 octave over `BAND_HZ`."""
    freq_hz = _band(12) if freq_hz is None else freq_hz
    achieved = response_spectrum(record.a_mps2, record.dt_s, 1.0 / freq_hz, DAMPING) / _G
    return SpectrumFit(freq_hz=freq_hz, target_g=target_sa_g(target, freq_hz), achieved_g=achieved)


def _check(target: Target, dt_s: float, duration_s: float) -> None:
    freq_hz, sa_g = (np.asarray(column, dtype=np.float64) for column in target)
    problems = []
    if freq_hz.ndim != 1 or freq_hz.shape != sa_g.shape or len(freq_hz) < 2:
        problems.append("target spectrum: give as many accelerations as frequencies, at least 2")
    elif not (freq_hz[0] > 0.0 and np.all(np.diff(freq_hz) > 0.0) and np.isfinite(freq_hz[-1])):
        problems.append("target spectrum: give rising frequencies above 0 [Hz]")
    if not np.all((sa_g > 0.0) & np.isfinite(sa_g)):
        problems.append("target spectrum: give accelerations above 0 [g]")
    if not 0.001 <= dt_s <= 0.01:
        problems.append(f"time step dt is {dt_s!r}; give 0.001 to 0.01 s")
    if not 10.0 <= duration_s <= 60_000 * dt_s:
        problems.append(f"duration is {duration_s!r}; give from 10 s to 60,000 time steps")
    if problems:
        raise InputError(problems)


def _band(per_octave: int) -> Floats:
    low, high = BAND_HZ
    steps = np.arange(math.floor(per_octave * math.log2(high / low)) + 1)
    return np.append(low * 2.0 ** (steps / per_octave), high)


def _frame(low_hz: float, dt_s: float, duration_s: float) -> _Frame:
    n = round(duration_s / dt_s) + 1
    from_start = np.linspace(0.0, 1.0, n)
    envelope = np.minimum(1.0, 6.0 * np.minimum(from_start, from_start[::-1]))
    high_hz = min(50.0, 0.4 / dt_s)
    steps = round(_PER_OCTAVE * math.log2(high_hz / low_hz))
    freq_hz = np.append(np.geomspace(low_hz, high_hz, steps + 1), 5.0 / dt_s)
    return _Frame(
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


def _shaped(frame: _Frame, rng: np.random.Generator, target: Target, goal: Floats) -> Floats:
    """Enveloped noise, its amplitudes corrected by the ratio of goal and spectrum some times."""
    n = len(frame.envelope)
    phases = np.exp(2j * math.pi * rng.random(n // 2 + 1))
    padded = 1 << (n - 1).bit_length() + 1
    noise = np.fft.rfft(frame.envelope * np.fft.irfft(phases, n), padded)
    freq_hz = np.maximum(np.fft.rfftfreq(padded, frame.dt_s), 1e-3)
    low, high = frame.freq_hz[0], frame.freq_hz[-2]
    gain = target_sa_g(target, freq_hz) / np.sqrt(freq_hz)
    gain /= (1.0 + (0.9 * low / freq_hz) ** 8) * (1.0 + (freq_hz / (1.2 * high)) ** 8)
    for _ in range(_SHAPINGS):
        a = _calmed(frame, frame.envelope * np.fft.irfft(noise * gain, padded)[:n])
        ratio = np.log(goal / np.abs(_peaks(frame, a)[0]))
        gain *= np.exp(np.interp(np.log(freq_hz), np.log(frame.freq_hz), ratio))
    return a


def _calmed(frame: _Frame, a: Floats) -> Floats:
    """Motion without its quiet shapes, by the least change under the envelope."""
    shapes = frame.quiet * frame.envelope
    return a - frame.envelope * (shapes.T @ np.linalg.solve(shapes @ shapes.T, frame.quiet @ a))


def _peaks(frame: _Frame, a: Floats) -> tuple[Floats, _Samples]:
    """Peak pseudo-accelerations [m/s2], with their signs, and the samples where they are."""
    seen = a.view()
    seen.setflags(write=False)
    peak, at = np.empty(len(frame.freq_hz)), np.empty(len(frame.freq_hz), dtype=np.int64)
    kernels.oscillator_peaks(seen, frame.dt_s, 2.0 * math.pi * frame.freq_hz, DAMPING, peak, at)
    return peak, at


def _matched(frame: _Frame, a: Floats, goal: Floats) -> Floats:
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
    frame: _Frame,
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


def _rounded(a: Floats) -> Floats:
    """Round to the quantum that is printed without moving the end of the motion.

    The twice summed record is rounded and differenced twice, so rounding leaves no drift.
    """
    counts = np.rint(np.cumsum(np.cumsum(a / (_G * _QUANTUM_G))))
    rounded = np.diff(counts, n=2, prepend=[0.0, 0.0])
    values: Floats = rounded / 10.0 ** DECIMALS["g"] * _G
    values.setflags(write=False)
    return values


def _meets(target: Target, record: Record) -> bool:
    ratio = spectrum_fit(record, target, _band(48)).ratio
    return bool(
        ratio.min() >= LEAST and ratio.max() <= GREATEST and abs(ratio.mean() - 1.0) <= MEAN_OFF
    )


def _differ(one: Record, other: Record) -> bool:
    return bool(abs(np.corrcoef(one.a_mps2, other.a_mps2)[0, 1]) <= CORRELATION)
