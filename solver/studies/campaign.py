"""The runs of a study: every case under every motion at every heading, split into equal parts.

A case is a building, slope, friction coefficient and intensity. Rows are ordered by case, motion
and heading, so that a part is a range of cases. Runs nothing (`runs` does). Read `Campaign`.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise, product
from operator import itemgetter

import numpy as np
from numpy.typing import NDArray

from solver.model import STANDARD_GRAVITY_MPS2, Floats, Motion, Orientation

MOST_ROWS = 500_000
"""Rows of a part, so that the parts in memory stay small."""

PART_SECONDS = 5.0
"""Processor time of a part, so that a killed study repeats little."""

LEAST_PARTS, MOST_PARTS = 32, 4_000
"""Enough parts for the cores, and few enough for a scheduler and a file system."""

_SAMPLED_MOTIONS = 50
_SAMPLED_STEP = 8


@dataclass(frozen=True, slots=True)
class Cases:
    """Cases in the order of the rows.

    Attributes
    ----------
    building : array of int, shape (m,)
        Index of the motions at the roof of a building.
    slope_rad, mu, intensity : array, shape (m,)
    """

    building: NDArray[np.int64]
    slope_rad: Floats
    mu: Floats
    intensity: Floats

    def __len__(self) -> int:
        return self.mu.size

    def __getitem__(self, part: slice) -> Cases:
        return Cases(*map(itemgetter(part), self.columns))

    @property
    def columns(self) -> tuple[NDArray[np.int64], Floats, Floats, Floats]:
        """The arrays in the order of the fields."""
        return self.building, self.slope_rad, self.mu, self.intensity


def grid(
    buildings: int, slopes_rad: Iterable[float], mus: Iterable[float], intensities: Iterable[float]
) -> Cases:
    """Return all combinations, the intensity varying fastest."""
    return cases_of(list(product(range(buildings), slopes_rad, mus, intensities)))


def cases_of(rows: Sequence[tuple[int, float, float, float]]) -> Cases:
    """Return cases from tuples of building, slope [rad], friction coefficient and intensity."""
    columns = np.array(rows, dtype=float).reshape(-1, 4).T
    return Cases(columns[0].astype(np.int64), *(column.copy() for column in columns[1:]))


def joined(parts: Sequence[Cases]) -> Cases:
    """Return cases one after the other."""
    return Cases(*map(np.concatenate, zip(*(part.columns for part in parts), strict=True)))


@dataclass(frozen=True, kw_only=True)
class Campaign:
    """All runs of a study.

    Attributes
    ----------
    motions : tuple of tuple of Motion
        By building; `Motion.scale` is the factor for an intensity of 1. All buildings have the same
        motions with the same components and signs.
    cases : Cases
    """

    motions: tuple[tuple[Motion, ...], ...]
    cases: Cases

    @cached_property
    def columns(self) -> tuple[tuple[int, Orientation], ...]:
        """Motion and orientation of the rows of a case."""
        return tuple(
            (number, orientation)
            for number, motion in enumerate(self.motions[0])
            for orientation in motion.orientations
        )

    @property
    def rows(self) -> int:
        """Number of runs."""
        return len(self.cases) * len(self.columns)

    @cached_property
    def seconds(self) -> Floats:
        """Estimated processor time of each case [s]."""
        seconds = np.zeros(len(self.cases))
        for building, motions in enumerate(self.motions):
            chosen = np.flatnonzero(self.cases.building == building)
            step = -(-len(motions) // _SAMPLED_MOTIONS)
            sample = motions[::step]
            total = sum(_seconds(motion, self.cases, chosen) for motion in sample)
            seconds[chosen] = total * (len(motions) / len(sample))
        return seconds

    @cached_property
    def parts(self) -> tuple[slice, ...]:
        """Ranges of cases of about equal cost; they depend on nothing but the campaign."""
        total = float(self.seconds.sum())
        count = max(LEAST_PARTS, -(-self.rows // MOST_ROWS), round(total / PART_SECONDS))
        count = min(count, MOST_PARTS, len(self.cases))
        reached = np.cumsum(self.seconds) / total
        ends = np.searchsorted(reached, np.arange(1, count) / count) + 1
        most = max(1, MOST_ROWS // len(self.columns))
        return tuple(_ranges([*ends.tolist(), len(self.cases)], most))


def _ranges(ends: Sequence[int], maximum: int) -> list[slice]:
    """Return the ranges between ends, those of more than `maximum` cases divided."""
    ranges, start = [], 0
    for end in ends:
        pieces = -(-(end - start) // maximum)
        edges = [start + (end - start) * k // pieces for k in range(pieces + 1)] if pieces else []
        ranges += [slice(low, high) for low, high in pairwise(edges)]
        start = end
    return ranges


# Processor time [s], measured by tests/bench/solver_speed.py and study_cost.py: a run, a sample at
# rest, a sample that may slide; the same in two axes, where selecting the model also runs the
# simpler ones.
RUN_S, REST_S, SLIDE_S = 1e-7, 3.5e-12, 2.5e-9
PLANE_RUN_S, PLANE_REST_S, PLANE_SLIDE_S = 1.5e-4, 1e-8, 6e-7

PERSISTENCE = 3.0
"""Samples during which a block slides / samples at which the push alone exceeds friction."""


def _seconds(motion: Motion, cases: Cases, chosen: NDArray[np.intp]) -> Floats:
    """Return the estimated time of cases under one motion at all its orientations [s]."""
    slope, mu, intensity = cases.slope_rad[chosen], cases.mu[chosen], cases.intensity[chosen]
    peaks = np.sort(np.abs(motion.ax_mps2[::_SAMPLED_STEP]))
    yields = STANDARD_GRAVITY_MPS2 * np.tan(np.arctan(mu) - np.abs(slope))
    at = yields / (motion.scale * intensity)
    share = 1.0 - np.searchsorted(peaks, at) / peaks.size
    samples, slides = motion.ax_mps2.size, np.minimum(1.0, PERSISTENCE * share)
    run, rest, slide = RUN_S, REST_S, SLIDE_S
    if motion.has_transverse:
        run, rest, slide = PLANE_RUN_S, PLANE_REST_S, PLANE_SLIDE_S
    return np.asarray(len(motion.orientations) * (run + samples * (rest + slide * slides)))
