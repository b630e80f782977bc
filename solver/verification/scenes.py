"""The records and scenes of a verification.

Generates the project's records, identical on every machine; runs nothing. Read
`solver.verification.run` first.
"""

from __future__ import annotations

import importlib.util
import itertools
import math
from dataclasses import replace
from functools import lru_cache
from pathlib import Path
from typing import NamedTuple

import numpy as np

from solver.formats import read_record
from solver.model import STANDARD_GRAVITY_MPS2, Floats
from solver.records.record import Record, read_only
from solver.rivals import by_scipy
from solver.rivals.methods import METHODS, Method
from solver.rules.spectra import Target
from solver.synthesis.suite import SuiteMotion, make_suite

SEED = 2003
"""Seed of the project's generated records."""

HORIZONTAL: Target = (np.array([0.1, 1.3, 8.3, 33.3]), np.array([0.16, 1.6, 1.6, 1.2]))
"""Corners of an AC156 spectrum at the roof, S_DS = 1 g: frequencies [Hz], accelerations [g]."""

VERTICAL: Target = (np.array([0.1, 1.3, 8.3, 33.3]), np.array([0.067, 0.67, 0.67, 0.27]))


class Case(NamedTuple):
    """A block on a slope and the peak acceleration of its record."""

    slope_deg: float
    mu: float
    ppa_g: float

    @property
    def slope_rad(self) -> float:
        """Slope in radians."""
        return math.radians(self.slope_deg)

    def __str__(self) -> str:
        return f"{self.slope_deg:g}°, μ = {self.mu:g}, PPA = {self.ppa_g:g} g"


CASES = (
    Case(0.0, 0.3, 1.0),
    Case(4.0, 0.4, 1.0),
    Case(-4.0, 0.2, 0.5),
    Case(7.0, 0.6, 1.5),
    Case(2.0, 0.1, 0.5),
    Case(-2.0, 0.5, 1.5),
)
"""From small to large slip, with both signs of the slope; quick runs take the first ones."""


def own_records(quick: bool) -> tuple[Record, ...]:
    """Return the project's records: motions matched to AC156, and a near-fault pulse."""
    return (*(motion.x for motion in own_suite(quick)), near_fault_pulse())


@lru_cache
def own_suite(quick: bool) -> tuple[SuiteMotion, ...]:
    """Return the motions whose first components are the records."""
    count = 1 if quick else 2
    return tuple(make_suite(HORIZONTAL, VERTICAL, count=count, seed=SEED, dt_s=0.01))


def near_fault_pulse() -> Record:
    """Return a 2 s pulse with a Gaussian envelope, after Mavroeidis and Papageorgiou (2003)."""
    dt = 0.01
    t = np.arange(801) * dt - 4.0
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
    sums = np.convolve(energy, np.ones(min(count, energy.size)), "valid")
    first = int(sums.argmax())
    return slice(first, first + count)


def runnable_methods() -> list[Method]:
    """Return the methods, without those of SciPy where it is not installed."""
    scipy = by_scipy.is_installed()
    return [m for m in METHODS.values() if scipy or not m.source.startswith("scipy")]


def real_records() -> tuple[Record, ...]:
    """Return the records that the package pyslammer carries, if installed; it is not imported."""
    spec = importlib.util.find_spec("pyslammer")
    places = spec.submodule_search_locations if spec else None
    paths = sorted(Path((places or [""])[0]).glob("sample_ground_motions/*.csv"))
    return tuple(replace(read_record(path, units="g"), name=path.stem) for path in paths)


def compared_runs(quick: bool) -> list[tuple[Record, Case]]:
    """Return the runs on which methods are compared: the real records, a case each in turn.

    Where these are not installed, and if quick, the project's records with every case.
    """
    real = () if quick else real_records()
    if real:
        return list(zip(real, itertools.cycle(CASES), strict=False))
    return list(itertools.product(own_records(quick), CASES[:3] if quick else CASES))
