"""Makes roof motions of three components whose response spectra follow a target.

Draws and judges; the matching is in `solver.synthesis.matching`. Knows no code rules and no files.
Read `make_suite` first, then `synthesise`.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from solver.model import Floats, InputError
from solver.motion import Record
from solver.synthesis.matching import Frame, goal_mps2, make_frame, matched, rounded, shaped
from solver.synthesis.target import Target, meets, target_problems

CORRELATION = 0.3
"""Largest correlation coefficient of two components of one motion."""

DRAWS = 20


@dataclass(frozen=True, slots=True, kw_only=True)
class SuiteMotion:
    """One made motion.

    Attributes
    ----------
    x, y, z : Record
        Two horizontal components and the vertical one, sampled alike.
    """

    x: Record
    y: Record
    z: Record

    @property
    def components(self) -> tuple[Record, Record, Record]:
        """Return x, y and z."""
        return self.x, self.y, self.z

    @property
    def correlations(self) -> tuple[float, float, float]:
        """Return the correlation coefficients of x with y, x with z and y with z."""
        pairs = ((self.x, self.y), (self.x, self.z), (self.y, self.z))
        xy, xz, yz = (correlation(one, other) for one, other in pairs)
        return xy, xz, yz


def correlation(one: Record, other: Record) -> float:
    """Correlation coefficient of two records that are sampled alike."""
    return float(np.corrcoef(one.a_mps2, other.a_mps2)[0, 1])


def make_suite(
    horizontal_target: Target,
    vertical_target: Target,
    *,
    count: int,
    seed: int,
    dt_s: float = 0.005,
    duration_s: float = 30.0,
    progress: Callable[[str], None] = lambda _: None,
) -> list[SuiteMotion]:
    """Make motions of two horizontal components and a vertical one each.

    Motion k of a seed is the same whatever the count. A component that misses its target or goes
    with another one (`CORRELATION`) is drawn again.

    Parameters
    ----------
    horizontal_target, vertical_target : tuple of array
        Corner points: frequencies [Hz] and pseudo-spectral accelerations [g], 5 % damping; the
        first is for x and y.
    count : int
    seed : int
        >= 0.
    dt_s, duration_s : float
        Sampling interval and time of the last sample [s]; a sixth of the duration to rise and a
        sixth to decay: 5, 20 and 5 s of 30 s, as AC156 has it.
    progress : callable
        Told what is being made.

    Returns
    -------
    list of SuiteMotion
        Their records are named ``motion-01-x``, ``motion-01-y``, ``motion-01-z`` and so on.

    Raises
    ------
    InputError
        Where an argument is impossible, or no motion is found that meets the target.
    """
    if count < 1 or seed < 0:
        raise InputError(f"suite: count {count} and seed {seed}; give at least 1 and at least 0")
    for target in (horizontal_target, vertical_target):
        _check(target, dt_s, duration_s)
    across, upright = (
        _Wanted(target=target, frame=make_frame(target, dt_s, duration_s))
        for target in (horizontal_target, vertical_target)
    )
    suite = []
    for k, sequence in enumerate(np.random.SeedSequence(seed).spawn(count), start=1):
        progress(f"motion {k} of {count}")
        rng = np.random.Generator(np.random.PCG64(sequence))
        # y comes last, so that x and z are those of a pair without it.
        x = _component(across, rng, f"motion-{k:02d}-x", ())
        z = _component(upright, rng, f"motion-{k:02d}-z", (x,))
        y = _component(across, rng, f"motion-{k:02d}-y", (x, z))
        suite.append(SuiteMotion(x=x, y=y, z=z))
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
    wanted = _Wanted(target=target, frame=make_frame(target, dt_s, duration_s))
    return _component(wanted, rng, name, unlike)


@dataclass(frozen=True, slots=True, kw_only=True)
class _Wanted:
    """A target with the frame that its motions are matched in."""

    target: Target
    frame: Frame


def _component(
    wanted: _Wanted, rng: np.random.Generator, name: str, unlike: Sequence[Record]
) -> Record:
    target, frame = wanted.target, wanted.frame
    goal = goal_mps2(frame, target)
    for _ in range(DRAWS):
        start = _noise(len(frame.envelope), rng)
        a = rounded(matched(frame, shaped(frame, start, target, goal), goal))
        record = Record(name=name, dt_s=frame.dt_s, a_mps2=a)
        alike = any(abs(correlation(record, other)) > CORRELATION for other in unlike)
        if meets(target, record) and not alike:
            return record
    duration_s = frame.dt_s * (len(frame.envelope) - 1)
    raise InputError(
        f"{name}: {DRAWS} motions of {duration_s:g} s all miss the target spectrum; "
        "give a smoother target or a longer duration"
    )


def _noise(n: int, rng: np.random.Generator) -> Floats:
    """Return n samples of white noise: amplitudes alike, phases drawn."""
    return np.fft.irfft(np.exp(2j * np.pi * rng.random(n // 2 + 1)), n)


def _check(target: Target, dt_s: float, duration_s: float) -> None:
    problems = target_problems(target)
    if not 0.001 <= dt_s <= 0.01:
        problems.append(f"time step dt is {dt_s!r}; give 0.001 to 0.01 s")
    if not 10.0 <= duration_s <= 60_000 * dt_s:
        problems.append(f"duration is {duration_s!r}; give from 10 s to 60,000 time steps")
    if problems:
        raise InputError(problems)
