"""Generates three-component roof motions that match a target, from noise or records.

A suite of seven motions has 21 records, motion-01-x to motion-07-z, each from its own seed.

Samples motions and accepts or rejects them; the matching is in `solver.synthesis.matching`. Knows
no code rules and no files. Read `make_suite` first, then `synthesize`.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor, as_completed
from dataclasses import dataclass
from itertools import chain, combinations

import numpy as np
from numpy.typing import NDArray

from solver.errors import InputError
from solver.kernels.compiler import THREADS
from solver.model import Floats
from solver.records.acceptance import MOST_CORRELATION
from solver.records.measures import correlation, strength
from solver.records.record import Record
from solver.rules.ac156 import Target
from solver.synthesis.matching import (
    MatchingFrame,
    SpectrumFit,
    keeps,
    make_frame,
    matched,
    rounded,
    shaped,
    shifted_grids,
    spectrum_fit,
)

# Averaging time of a record's level and window length for phase rotation / duration.
_LEVEL, _WINDOW = 1.0 / 7.5, 1.0 / 15.0
# Parts of a record whose level is below this fraction of the largest level are filled with noise.
_FAINT = 0.1
# Increase of the phase rotation each time a motion is rejected and drawn again.
_TURN_RAD = math.pi / 5.0


@dataclass(frozen=True, slots=True, kw_only=True)
class Seed:
    """Seed of one component: a record, or noise, which has no name and no values."""

    name: str
    a: Floats  # the part of the record that is used, at the step of the motion, dimensionless
    # Otherwise they are random, and only the distribution of energy over time and frequency stays.
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
        # A component that the group does not contain uses the first record, with random phases.
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
    # With cumulative sums, the energy of each window is one difference.
    energy = np.append(0.0, np.cumsum(a**2))
    first = int(np.argmax(energy[n:] - energy[:-n]))
    return a[first : first + n]


def _turned(a: Floats, rng: np.random.Generator, by_rad: float) -> Floats:
    """Rotate the phase in every time window and frequency by a random angle of at most by_rad."""
    half = round(0.5 * _WINDOW * len(a))
    window = np.sin(math.pi * (np.arange(2 * half) + 0.5) / (2 * half))
    # Sines squared of windows half a length apart add to 1, ends included where padded.
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
    # Without the zeros at the ends of the window.
    bell = np.hanning(width + 2)[1:-1]
    # A convolution may be below zero by rounding.
    level = np.sqrt(np.maximum(np.convolve(a**2, bell / bell.sum(), "same"), 0.0))
    faint = _FAINT * level.max()
    filler = _with_phases(np.abs(np.fft.rfft(a)), rng, len(a))
    # Powers add: level^2 / faint^2 of the record and the rest of noise make 1.
    lacking = np.sqrt(1.0 - np.minimum(level / faint, 1.0) ** 2)
    filled: Floats = a / np.maximum(level, faint)
    filled += lacking * filler / np.sqrt(np.mean(filler**2))
    return filled


DRAWS = 20

# Hold of the envelope / duration, and least D5-95 / duration; the envelope alone has 0.70.
HOLD_SHARE = 4.0 / 6.0

# Ratio to the target to which the lowest point is scaled: above 1 by more than rounding changes it,
# and by more than a spectrum falls between the points.
_ABOVE = 1.002
# The lowest point is looked for at every so many points, then around those this close to it.
_COARSE, _NEAR_LOWEST = 6, 1.02

# Minimum length of a seed record / duration: a shorter one says little about a motion.
_SHORTEST_SHARE = 1.0 / 6.0


@dataclass(frozen=True, slots=True, kw_only=True)
class SuiteMotion:
    """One synthetic motion.

    Attributes
    ----------
    x, y, z : Record
        Two horizontal components and the vertical component, with equal steps and lengths.
    seeds : tuple of str, length 3
        Seed of each: ``noise``, or the name of a record and how its phases were changed.
    hold_s : float
        Time at the full level of the envelope, its strong motion [s].
    """

    x: Record
    y: Record
    z: Record
    seeds: tuple[str, str, str]
    hold_s: float

    @property
    def components(self) -> tuple[Record, Record, Record]:
        """Return x, y and z."""
        return self.x, self.y, self.z

    @property
    def correlations(self) -> tuple[float, float, float]:
        """Return the correlation coefficients of x with y, x with z and y with z."""
        xy, xz, yz = (correlation(*pair) for pair in combinations(self.components, 2))
        return xy, xz, yz


def make_suite(
    horizontal_target: Target,
    vertical_target: Target,
    *,
    count: int,
    seed: int,
    records: Sequence[Sequence[Record]] = (),
    dt_s: float = 0.005,
    duration_s: float = 30.0,
    progress: Callable[[str], None] = lambda _: None,
) -> list[SuiteMotion]:
    """Generate motions of two horizontal components and a vertical component each.

    Sinusoids under an envelope, matched in frequency and then in time (Gasparini and Vanmarcke,
    MIT R76-4, 1976; Lilhanand and Tseng, 9th World Conf. Earthquake Eng. II (1988) 819-824).

    Motion k of a seed is the same for any count. Every component alone satisfies the limits on
    motions for analysis where its target is given and the duration has three cycles: it is scaled
    so that its spectrum touches the target at the lowest point of 100 grids of 1/6 octave. It is
    drawn again if it exceeds its target by more than 30% anywhere or 7% in the mean, correlates
    with another component by more than 0.3, or has a significant duration shorter than the hold of
    the envelope.

    Records, if given, replace the noise. The phases of a record's strongest part are preserved, and
    with them its pulses and the order of its frequencies. The envelope replaces its level over a
    few seconds, so that the strong phase is that of AC156, and the target replaces its spectrum.
    Weak parts, and the time beyond the ends of a short record, are filled with noise of the same
    spectrum as the record. If a group has no record for a component, or a group is used again, the
    phases are random and only the record's distribution of energy over time and frequency is
    preserved. Each new draw rotates the phases further.

    Parameters
    ----------
    horizontal_target, vertical_target : tuple of array
        Corner points: frequencies [Hz] and pseudo-spectral accelerations [g], 5% damping;
        `horizontal_target` is for x and y.
    count : int
    seed : int
        >= 0.
    records : sequence of sequence of Record
        Groups of one to three records (for x, y and z), which the motions use in turn; empty for
        noise.
    dt_s, duration_s : float
        Sampling interval and time of the last sample [s]. The envelope rises over one sixth of the
        duration and decays over one sixth: 5, 20 and 5 s of 30 s, as in AC156.
    progress : callable
        Called with how many motions are made, before the first and after each; they are made on all
        cores.

    Returns
    -------
    list of SuiteMotion
        Their records are named ``motion-01-x``, ``motion-01-y``, ``motion-01-z`` and so on.

    Raises
    ------
    InputError
        If an argument is invalid, or no motion is found that meets the target.

    Examples
    --------
    >>> from solver import EDITIONS, ac156_horizontal, ac156_vertical
    >>> horizontal = ac156_horizontal(EDITIONS["ASCE 7-16"], s_ds_g=1.2, z_over_h=1.0)
    >>> vertical = ac156_vertical(s_ds_g=1.2)
    >>> (made,) = make_suite(horizontal.corners, vertical.corners, count=1, seed=1)
    >>> made.x
    Record('motion-01-x', 6001 samples at 0.005 s)
    """
    if count < 1 or seed < 0:
        raise InputError(f"suite: count {count} and seed {seed}; use at least 1 and at least 0")
    horizontal, vertical = (
        make_frame(target, dt_s, duration_s) for target in (horizontal_target, vertical_target)
    )
    _check_records(records, dt_s, duration_s)

    def made(k: int, sequence: np.random.SeedSequence) -> SuiteMotion:
        # Named explicitly: the generator of `default_rng` may change with NumPy, which would change
        # every suite.
        rng = np.random.Generator(np.random.PCG64(sequence))
        # y is drawn last, so that x and z are the same as in a pair without y.
        seed_x, seed_y, seed_z = seeds_of(records, k - 1, dt_s, len(horizontal.envelope))
        x, from_x = synthesize(horizontal, seed_x, rng, f"motion-{k:02d}-x")
        z, from_z = synthesize(vertical, seed_z, rng, f"motion-{k:02d}-z", (x,))
        y, from_y = synthesize(horizontal, seed_y, rng, f"motion-{k:02d}-y", (x, z))
        seeds, hold_s = (from_x, from_y, from_z), HOLD_SHARE * duration_s
        return SuiteMotion(x=x, y=y, z=z, seeds=seeds, hold_s=hold_s)

    progress(f"0 of {count} motions generated")
    # A stream of its own for each motion: motion k is the same whatever the count.
    sequences = enumerate(np.random.SeedSequence(seed).spawn(count), start=1)
    # Threads, not processes: kernels and NumPy release Python's lock.
    with ThreadPoolExecutor(THREADS) as pool:
        motions = [pool.submit(made, k, sequence) for k, sequence in sequences]
        try:
            for done, motion in enumerate(as_completed(motions), start=1):
                # Raises the error of a failed motion; motions not yet started are canceled.
                motion.result()
                progress(f"{done} of {count} motions generated")
        finally:
            pool.shutdown(wait=False, cancel_futures=True)
    return [motion.result() for motion in motions]


def synthesize(
    frame: MatchingFrame,
    seed: Seed,
    rng: np.random.Generator,
    name: str,
    unlike: Sequence[Record] = (),
) -> tuple[Record, str]:
    """Generate one component whose 5% damped spectrum matches the target of a frame.

    Sinusoids of random phase under an envelope (SIMQKE), adjusted in frequency, then corrected in
    time by the reversed impulse responses of the oscillators: the sources are in `make_suite`.
    Velocity and displacement return to zero at the end, exactly for acceleration linear between
    samples. The record is rounded as `solver.records.record.write_record` prints it in g before it
    is checked.

    Returns the component, which must not correlate with those that it is to be unlike, and the
    description of its seed. Raises `InputError` if `DRAWS` motions all miss the target.
    """
    duration_s = frame.dt_s * (len(frame.envelope) - 1)
    nearest = math.inf, ""
    for draw in range(DRAWS):
        start = grown(seed, rng, len(frame.envelope), draw)
        a = matched(frame, shaped(frame, start))
        # Scaled and rounded before the checks: the accepted record is the one that is printed.
        a = rounded(a * _ABOVE / _lowest(frame, a))
        record = Record(name=name, dt_s=frame.dt_s, a_mps2=a)
        alike = any(abs(correlation(record, earlier)) > MOST_CORRELATION for earlier in unlike)
        is_strong = strength(record).d5_95_s >= HOLD_SHARE * duration_s
        fit = _fit(frame, a)
        if keeps(fit) and is_strong and not alike:
            return record, seed.words(draw)
        reached = f"{fit.minimum:.2f} to {fit.maximum:.2f}"
        # The closest is that whose worst point is least off, whichever side it is on.
        nearest = min(nearest, (max(1.0 / fit.minimum, fit.maximum), reached))
    raise InputError(
        f"{name}: {DRAWS} motions of {duration_s:g} s all miss the target spectrum; the closest "
        f"has {nearest[1]} times the target; use a smoother target or a longer duration"
    )


def _fit(
    frame: MatchingFrame, a: Floats, some: slice | NDArray[np.int64] = slice(None)
) -> SpectrumFit:
    """Compare a component with its target on grids of 1/6 octave that begin anywhere."""
    record = Record(name="", dt_s=frame.dt_s, a_mps2=a)
    return spectrum_fit(record, frame.target, shifted_grids(float(frame.freq_hz[0]))[some])


def _lowest(frame: MatchingFrame, a: Floats) -> float:
    """Smallest ratio on those grids: at some points, and at all points near the lowest of them."""
    count = len(shifted_grids(float(frame.freq_hz[0])))
    ratio = _fit(frame, a, slice(None, None, _COARSE)).ratio
    low = _COARSE * np.flatnonzero(ratio <= _NEAR_LOWEST * ratio.min())
    around = np.unique(low[:, None] + np.arange(-_COARSE, _COARSE + 1))
    return _fit(frame, a, around[(around >= 0) & (around < count)]).minimum


def _check_records(records: Sequence[Sequence[Record]], dt_s: float, duration_s: float) -> None:
    n = round(duration_s / dt_s) + 1
    problems = [
        f"records of motion {k}: found {len(group)}; use one, two or three"
        for k, group in enumerate(records, start=1)
        if not 1 <= len(group) <= 3
    ]
    for record in chain.from_iterable(records):
        found_s = record.dt_s * (len(record.a_mps2) - 1)
        if found_s < _SHORTEST_SHARE * duration_s:
            shortest = f"{_SHORTEST_SHARE * duration_s:g} s"
            problems.append(
                f"{record.name}: lasts {found_s:g} s; use a seed of at least {shortest}"
            )
        elif not strongest(record, dt_s, n).any():
            problems.append(f"{record.name}: is constant; use another record as a seed")
    if problems:
        raise InputError(problems)
