"""What a motion grows from: noise, or a record's own phases and order of arrivals.

Matches nothing: `solver.synthesis.matching` does. Read `Seed` first, then `grown`.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from solver.model import Floats
from solver.records.record import Record

# Of the duration: over what time a record's level is taken, and the window of turned phases.
_LEVEL, _WINDOW = 1.0 / 7.5, 1.0 / 15.0
# Of the largest level: what is below it is filled with noise.
_FAINT = 0.1
# A record whose motion is refused has its phases turned by this much more at every draw.
_TURN_RAD = math.pi / 5.0


@dataclass(frozen=True, slots=True, kw_only=True)
class Seed:
    """What one component grows from.

    Attributes
    ----------
    name : str
        Of the record; empty for noise.
    a : array, shape (n,)
        The record's part that is used, sampled as the motion, without unit; shape (0,) for noise.
    own_phases : bool
        Whether the record's phases are kept; else drawn, and only its energy over time and
        frequency is kept.
    """

    name: str
    a: Floats
    own_phases: bool

    def turn_rad(self, draw: int) -> float:
        """How far phases are turned at most in a draw, counted from 0."""
        return min(_TURN_RAD * draw, math.pi) if self.own_phases else math.pi

    def words(self, draw: int) -> str:
        """What a motion of that draw grew from."""
        turn = self.turn_rad(draw)
        if not self.name:
            return "noise"
        if turn == 0.0:
            return self.name
        if turn == math.pi:
            return f"{self.name}, phases drawn"
        return f"{self.name}, phases turned by up to {math.degrees(turn):.0f} deg"


def noise_seed() -> Seed:
    """Return the seed of a motion that grows from noise."""
    return Seed(name="", a=np.empty(0), own_phases=False)


def seeds_of(
    records: Sequence[Sequence[Record]], motion: int, dt_s: float, n: int
) -> tuple[Seed, Seed, Seed]:
    """Return the seeds of x, y and z of a motion, counted from 0.

    The motions take the groups of records in turn. Phases are the record's own for the components
    that a group has, the first time round.
    """
    if not records:
        return noise_seed(), noise_seed(), noise_seed()
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
    """Return n samples to put under the envelope, of one level throughout."""
    if not seed.name:
        return _with_phases(np.ones(n // 2 + 1), rng, n)
    a = seed.a
    if (turn := seed.turn_rad(draw)) > 0.0:
        a = _turned(a, rng, turn)
    return _levelled(a, rng)


def _with_phases(amplitudes: Floats, rng: np.random.Generator, n: int) -> Floats:
    return np.fft.irfft(amplitudes * np.exp(2j * math.pi * rng.random(n // 2 + 1)), n)


def strongest(record: Record, dt_s: float, n: int) -> Floats:
    """Return the n samples of most energy, or the whole record amid zeros where it is shorter.

    Without unit and mean; zero throughout where the record, so sampled, never moves.
    """
    end_s = record.dt_s * (len(record.a_mps2) - 1)
    t = dt_s * np.arange(math.floor(end_s / dt_s + 1e-9) + 1)
    a = np.interp(t, record.dt_s * np.arange(len(record.a_mps2)), record.a_mps2)
    # Before anything is squared: records may be as large or small as floats go.
    a = a / max(float(np.abs(a).max()), np.finfo(float).tiny)
    a = np.where(np.ptp(a) > 0.0, a - a.mean(), 0.0)
    if len(a) <= n:
        before = (n - len(a)) // 2
        return np.pad(a, (before, n - len(a) - before))
    energy = np.append(0.0, np.cumsum(a**2))
    first = int(np.argmax(energy[n:] - energy[:-n]))
    return a[first : first + n]


def _turned(a: Floats, rng: np.random.Generator, by_rad: float) -> Floats:
    """Turn the phase of every patch of time and frequency by a random angle, at most that far."""
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


def _levelled(a: Floats, rng: np.random.Generator) -> Floats:
    """Divide by the level over a few seconds, and fill what is faint with noise of its colour."""
    width = round(_LEVEL * len(a))
    bell = np.hanning(width + 2)[1:-1]
    level = np.sqrt(np.maximum(np.convolve(a**2, bell / bell.sum(), "same"), 0.0))
    faint = _FAINT * level.max()
    filler = _with_phases(np.abs(np.fft.rfft(a)), rng, len(a))
    lacking = np.sqrt(1.0 - np.minimum(level / faint, 1.0) ** 2)
    filled: Floats = a / np.maximum(level, faint)
    filled += lacking * filler / np.sqrt(np.mean(filler**2))
    return filled
