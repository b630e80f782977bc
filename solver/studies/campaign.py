"""The runs of a study: every case under every motion in every orientation, in equal batches.

Two slopes, three friction coefficients and five intensities are 30 cases; under seven motions of
two components in two polarities they are 840 runs. Runs nothing. Read `Campaign`.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise, product
from operator import itemgetter

import numpy as np
from numpy.typing import NDArray

from solver.model import Floats, Motion, Orientation

# Rows of a part at most, in one axis and in two: some seconds, so that a killed study repeats
# little.
PART_ROWS, PLANE_PART_ROWS = 500_000, 5_000

# Enough parts for the cores, and few enough for a scheduler and a file system.
LEAST_PARTS, MOST_PARTS = 32, 4_000


@dataclass(frozen=True, slots=True)
class Cases:
    """Cases in the order of the rows, each field an array of shape (m,)."""

    building: NDArray[np.int64]  # index of the motions at its roof
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
    # Four columns, even if there are no rows.
    columns = np.array(rows, dtype=float).reshape(-1, 4).T
    return Cases(columns[0].astype(np.int64), *(column.copy() for column in columns[1:]))


def joined(parts: Sequence[Cases]) -> Cases:
    """Return cases one after the other."""
    return Cases(*map(np.concatenate, zip(*(part.columns for part in parts), strict=True)))


@dataclass(frozen=True, kw_only=True)
class Campaign:
    """All runs of a study. All buildings have the same motions, components and signs."""

    motions: tuple[tuple[Motion, ...], ...]  # by building, for an intensity of 1
    cases: Cases

    @cached_property
    def columns(self) -> tuple[tuple[int, Orientation], ...]:
        """Motion and orientation of the rows of a case."""
        columns: list[tuple[int, Orientation]] = []
        for number, motion in enumerate(self.motions[0]):
            columns += [(number, orientation) for orientation in motion.orientations]
        return tuple(columns)

    @property
    def rows(self) -> int:
        """Number of runs."""
        return len(self.cases) * len(self.columns)

    @cached_property
    def parts(self) -> tuple[slice, ...]:
        """Ranges of about as many cases; they depend on nothing but the campaign."""
        is_plane = any(motion.has_transverse for motion in self.motions[0])
        # Rounded up.
        count = -(-self.rows // (PLANE_PART_ROWS if is_plane else PART_ROWS))
        count = min(max(count, LEAST_PARTS), MOST_PARTS, len(self.cases))
        # Parts are divided between cases, so that each contains all runs of its cases.
        edges = [len(self.cases) * number // count for number in range(count + 1)]
        return tuple(slice(*ends) for ends in pairwise(edges))
