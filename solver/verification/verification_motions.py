"""The records and motions of the studies: generated, or recorded in a folder, and cut to a length.

A triple is a motion of three components, for the comparison of models. Read `own_records`.
"""

from __future__ import annotations

import math
from dataclasses import replace
from functools import lru_cache
from pathlib import Path

import numpy as np

from solver.errors import InputError
from solver.formats import read_motion_file
from solver.model import STANDARD_GRAVITY_MPS2, Floats, Motion
from solver.records.record import Record, read_only
from solver.rules.ac156 import Target
from solver.sliding.checked import motion
from solver.synthesis.suite import SuiteMotion, make_suite

SEED = 2003
"""Seed of the project's generated records."""

# A_FLX = 1.6 S_DS, its cap, and A_RIG = 0.4 S_DS (1 + 2), of ASCE 7-16 at z/h = 1.
HORIZONTAL: Target = (np.array([0.1, 1.3, 8.3, 33.3]), np.array([0.16, 1.6, 1.6, 1.2]))
"""Corners of an AC156 spectrum at the roof, S_DS = 1 g: frequencies [Hz], accelerations [g]."""
VERTICAL: Target = (np.array([0.1, 1.3, 8.3, 33.3]), np.array([0.067, 0.67, 0.67, 0.27]))


def own_records(quick: bool) -> tuple[Record, ...]:
    """Return the project's records: motions matched to AC156, and a near-fault pulse."""
    return (*(motion.x for motion in own_suite(quick)), near_fault_pulse())


# Generated once for the records, the motions and the timed runs.
@lru_cache
def own_suite(quick: bool) -> tuple[SuiteMotion, ...]:
    """Return the motions whose first components are the records."""
    count = 1 if quick else 2
    return tuple(make_suite(HORIZONTAL, VERTICAL, count=count, seed=SEED, dt_s=0.01))


def near_fault_pulse() -> Record:
    """Return a 2 s pulse with a Gaussian envelope, after Mavroeidis and Papageorgiou (2003)."""
    dt = 0.01
    t = np.arange(801) * dt - 4.0
    # sin(pi t) has a period of 2 s.
    a = np.exp(-((t / 1.2) ** 2)) * np.sin(math.pi * t) * STANDARD_GRAVITY_MPS2
    return Record(name="near-fault-pulse", dt_s=dt, a_mps2=read_only(a))


def scale_to(record: Record, ppa_g: float) -> float:
    """Return the factor that scales the peak of the record to `ppa_g` [g]."""
    return ppa_g * STANDARD_GRAVITY_MPS2 / float(np.abs(record.a_mps2).max())


def shortened(record: Record, duration_s: float) -> Record:
    """Return the part of the record of that length with the most energy."""
    count = round(duration_s / record.dt_s) + 1
    a = read_only(record.a_mps2[strongest(record.a_mps2**2, count)])
    return Record(name=f"{record.name}, strongest {duration_s:g} s", dt_s=record.dt_s, a_mps2=a)


def strongest(energy: Floats, count: int) -> slice:
    """Return the consecutive samples, at most `count`, with the most energy."""
    # Energy of each window of that length.
    sums = np.convolve(energy, np.ones(min(count, energy.size)), "valid")
    first = int(sums.argmax())
    return slice(first, first + count)


RECORDED = "recorded"
"""Source of the motions recorded in earthquakes; the others are generated."""

_UP = ("up", "v", "ud", "vertical", "vert", "z")
"""Words in a channel's name that mark the vertical component."""


def triple_scale(triple: Motion, ppa_g: float) -> float:
    """Return the factor that scales the larger horizontal peak to `ppa_g` [g]."""
    peak = max(float(np.abs(a).max()) for a in (triple.ax_mps2, triple.ay_mps2))
    return ppa_g * STANDARD_GRAVITY_MPS2 / peak


def cut(triple: Motion, samples: int) -> Motion:
    """Return the `samples` consecutive samples with the most horizontal energy."""
    part = strongest(triple.ax_mps2**2 + triple.ay_mps2**2, samples)
    x, y, z = (read_only(a[part]) for a in triple.components.values())
    name = f"{triple.id}, strongest {(samples - 1) * triple.dt_s:g} s"
    return replace(triple, id=name, ax_mps2=x, ay_mps2=y, az_mps2=z)


def own_triples(quick: bool) -> tuple[Motion, ...]:
    """Return the project's generated motions, whose components match AC156 spectra."""
    return tuple(
        motion(*made.components, id=made.x.name.removesuffix("-x"), source="generated")
        for made in own_suite(quick)
    )


def recorded_triples(folder: Path) -> tuple[Motion, ...]:
    """Return the motions of all files below a folder that hold three components.

    Two horizontal components and one named up or vertical; files that cannot be read or have
    other channels are skipped.
    """
    triples = (_triple(path) for path in sorted(folder.rglob("*")) if path.is_file())
    return tuple(triple for triple in triples if triple is not None)


def _triple(path: Path) -> Motion | None:
    try:
        channels = read_motion_file(path).channels
        up = [channel for channel in channels if _is_vertical(channel)]
        level = [channel for channel in channels if not _is_vertical(channel)]
        if len(up) != 1 or len(level) != 2:
            return None
        return motion(*level, *up, id=path.stem, source=RECORDED)
    except InputError:
        return None


def _is_vertical(channel: Record) -> bool:
    words = channel.name.lower().replace(":", " ").replace("(", " ").split()
    return any(word in _UP for word in words)
