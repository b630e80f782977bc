"""Uplift: when, for how long and how far the normal force of a block falls below zero.

A check independent of the model: with uplift no displacement is given. Integrates no motion.
Read `uplift`.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from solver.forces import normal_mps2
from solver.model import Floats, Scene


@dataclass(frozen=True, slots=True, kw_only=True)
class Uplift:
    """The normal force N of a block over a record.

    Attributes
    ----------
    n_min_g : float
        Minimum of N / (m g); negative with uplift.
    t_first_s : float
        Time when N first falls below zero [s]; NaN if it never does.
    duration_s : float
        Total time with N below zero [s].
    times : int
        Number of times that N falls below zero, including a record that begins there.
    """

    n_min_g: float
    t_first_s: float
    duration_s: float
    times: int

    @property
    def lifts(self) -> bool:
        """Whether the block would leave the roof."""
        return self.n_min_g < 0.0


def uplift(scene: Scene) -> Uplift:
    """Return when and how far N falls below zero, exactly for N linear between samples."""
    normal, dt = normal_mps2(scene), scene.dt_s
    n_min_g = float(normal.min()) / scene.g_mps2
    if n_min_g >= 0.0:
        return Uplift(n_min_g=n_min_g, t_first_s=math.nan, duration_s=0.0, times=0)
    below, starts = _below(normal), _starts(normal)
    return Uplift(
        n_min_g=n_min_g,
        t_first_s=float(starts[0]) * dt if starts.size else math.nan,
        duration_s=float(below.sum()) * dt,
        times=starts.size,
    )


def _below(normal: Floats) -> Floats:
    """Return the fraction of each interval in which N, linear between samples, is below zero."""
    first, last = normal[:-1], normal[1:]
    deep = np.maximum(-first, 0.0) + np.maximum(-last, 0.0)
    whole = np.abs(first) + np.abs(last)
    return deep / np.where(whole > 0.0, whole, 1.0)


def _starts(normal: Floats) -> Floats:
    """Return when N falls below zero, in samples, including at the beginning of the record."""
    first, last = normal[:-1], normal[1:]
    (at,) = np.nonzero((first >= 0.0) & (last < 0.0))
    begins = [0.0] if normal[0] < 0.0 else []
    return np.array([*begins, *(at + first[at] / (first[at] - last[at]))])
