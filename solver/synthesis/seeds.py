"""Seeds of synthetic motions: noise, or the phases of a real record.

Matches no spectrum: `solver.synthesis.matching` does. Read `Seed` first, then `grown`.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from solver.model import Floats
from solver.records.record import Record

# Averaging time of a record's level and window length for phase rotation / duration.
_LEVEL, _WINDOW = 1.0 / 7.5, 1.0 / 15.0
# Parts of a record whose level is below this fraction of the largest level are filled with noise.
_FAINT = 0.1
# Increase of the phase rotation each time a motion is rejected and drawn again.
_TURN_RAD = math.pi / 5.0


@dataclass(frozen=True, slots=True, kw_only=True)
class Seed:
    """Seed of one component.

    Attributes
    ----------
    name : str
        Name of the record; empty for noise.
    a : array, shape (n,)
        The part of the record that is used, at the step of the motion, dimensionless; shape (0,)
        for noise.
    own_phases : bool
        Whether the phases of the record are preserved. Otherwise they are random, and only the
        distribution of energy over time and frequency is preserved.
    """

    name: str
    a: Floats
    own_phases: bool

    def turn_rad(self, draw: int) -> float:
        """Largest phase rotation of a draw [rad]; draws are numbered from 0."""
        return min(_TURN_RAD * draw, math.pi) if self.own_phases else math.pi

    def words(self, draw: int) -> str:
        """Describe the seed of a motion of that draw."""
        turn = self.turn_rad(draw)
        if not self.name:
            return "noise"
        if turn == 0.0:
            return self.name
        if turn == math.pi:
            return f"{self.name}, random phases"
        return f"{self.name}, phases rotated by up to {math.degrees(turn):.0f} deg"


NOISE = Seed(name="", a=np.empty(0), own_phases=False)


def seeds_of(
    records: Sequence[Sequence[Record]], motion: int, dt_s: float, n: int
) -> tuple[Seed, Seed, Seed]:
    """Return the seeds of x, y and z of a motion; motions are numbered from 0.

    The motions use the groups of records in turn. A record's phases are preserved only in the first
    use of a group, and only for the components that the group contains.
    """
    if not records:
        return NOISE, NOISE, NOISE
    group = records[motion % len(records)]
    x, y, z = (
        Seed(
            name=record.name,
            a=strongest(record, dt_s, n),
            own_phases=motion < len(records) and axis < len(group),
        )
        for axis, record in enumerate((*group, *(group[0],) * 3)[:3])
    )
    return x, y, z


def grown(seed: Seed, rng: np.random.Generator, n: int, draw: int) -> Floats:
    """Return n samples of uniform level, to be multiplied by the envelope."""
    if not seed.name:
        return _with_phases(np.ones(n // 2 + 1), rng, n)
    a = seed.a
    if (turn := seed.turn_rad(draw)) > 0.0:
        a = _turned(a, rng, turn)
    return _leveled(a, rng)


def _with_phases(amplitudes: Floats, rng: np.random.Generator, n: int) -> Floats:
    return np.fft.irfft(amplitudes * np.exp(2j * math.pi * rng.random(n // 2 + 1)), n)


def strongest(record: Record, dt_s: float, n: int) -> Floats:
    """Return the n samples with the most energy, or the whole record with zeros if it is shorter.

    Dimensionless and with zero mean; all zero if the record is constant at this step.
    """
    end_s = record.dt_s * (len(record.a_mps2) - 1)
    t = dt_s * np.arange(math.floor(end_s / dt_s + 1e-9) + 1)
    a = np.interp(t, record.dt_s * np.arange(len(record.a_mps2)), record.a_mps2)
    # Scaled before squaring, because a record may have values near the limits of floats.
    a = a / max(float(np.abs(a).max()), np.finfo(float).tiny)
    a = np.where(np.ptp(a) > 0.0, a - a.mean(), 0.0)
    if len(a) <= n:
        before = (n - len(a)) // 2
        return np.pad(a, (before, n - len(a) - before))
    energy = np.append(0.0, np.cumsum(a**2))
    first = int(np.argmax(energy[n:] - energy[:-n]))
    return a[first : first + n]


def _turned(a: Floats, rng: np.random.Generator, by_rad: float) -> Floats:
    """Rotate the phase in every time window and frequency by a random angle of at most by_rad."""
    half = round(0.5 * _WINDOW * len(a))
    window = np.sin(math.pi * (np.arange(2 * half) + 0.5) / (2 * half))
    padded = np.pad(a, 2 * half)
    turned = np.zeros_like(padded)
    for first in range(0, len(padded) - 2 * half, half):
        part = np.s_[first : first + 2 * half]
        spectrum = np.fft.rfft(window * padded[part])
        spectrum *= np.exp(1j * by_rad * rng.uniform(-1.0, 1.0, len(spectrum)))
        turned[part] += window * np.fft.irfft(spectrum, 2 * half)
    return turned[2 * half : -2 * half]


def _leveled(a: Floats, rng: np.random.Generator) -> Floats:
    """Divide by the level over a few seconds; fill weak parts with noise of the same spectrum."""
    width = round(_LEVEL * len(a))
    bell = np.hanning(width + 2)[1:-1]
    level = np.sqrt(np.maximum(np.convolve(a**2, bell / bell.sum(), "same"), 0.0))
    faint = _FAINT * level.max()
    filler = _with_phases(np.abs(np.fft.rfft(a)), rng, len(a))
    lacking = np.sqrt(1.0 - np.minimum(level / faint, 1.0) ** 2)
    filled: Floats = a / np.maximum(level, faint)
    filled += lacking * filler / np.sqrt(np.mean(filler**2))
    return filled
