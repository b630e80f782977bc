"""Small campaigns for the tests of studies."""

import numpy as np

from solver.model import Motion
from solver.studies.campaign import Campaign, grid

SLOPES = np.radians([0.0, 2.0, 6.0])
MUS = (0.0, 0.05, 0.3, 0.5, 0.7)
INTENSITIES = (0.05, 0.4, 0.8, 1.2, 2.5, 12.0)


def frozen(values):
    array = np.array(values, dtype=float)
    array.setflags(write=False)
    return array


def wave(seed, samples=400, dt=0.02):
    """Noise of a few sinusoids with a peak of 1 g that begins and ends with zero."""
    rng = np.random.default_rng(seed)
    t = dt * np.arange(samples)
    freq, phase = rng.uniform(0.5, 6.0, (2, 12))
    a = np.sin(2.0 * np.pi * freq * t[:, None] + phase).sum(axis=1) * np.sin(np.pi * t / t[-1])
    return frozen(9.80665 * a / np.abs(a).max())


def motion(number, letters="x", *, samples=400, signs=(1, -1)):
    """A motion whose intensity 1 is a peak of 1 g."""
    none = frozen([])
    return Motion(
        id=f"M{number}",
        source="",
        dt_s=0.02,
        ax_mps2=wave(3 * number, samples),
        ay_mps2=wave(3 * number + 1, samples) if "y" in letters else none,
        az_mps2=frozen(0.4 * wave(3 * number + 2, samples)) if "z" in letters else none,
        scale=1.0,
        signs=signs,
    )


def campaign(letters="x", count=2, *, mus=MUS, intensities=INTENSITIES, buildings=1, samples=400):
    sets = tuple(
        tuple(motion(10 * b + k, letters, samples=samples) for k in range(count))
        for b in range(buildings)
    )
    return Campaign(motions=sets, cases=grid(buildings, SLOPES, mus, intensities))
