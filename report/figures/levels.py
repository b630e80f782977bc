"""Round levels of contours, and the dots of the arrays. Loads no plotting library."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence

import numpy as np

from report.assessment.arrays import ArrayAssessment
from report.assessment.uncertainty import ResponseSurface
from report.text.counts import cut, ids_by, ranged

LEAST_M = 1e-4
"""Displacement below which no contour is drawn [m]."""

MOST_LEVELS = 9


def levels(mean: Sequence[float]) -> list[float]:
    """Return round values within a range of positive ones, at most `MOST_LEVELS`."""
    low, high = min(mean), max(mean)
    for steps in ((1, 1.5, 2, 3, 5, 7), (1, 2, 3, 5), (1, 2, 5), (1, 3), (1,)):
        decades = range(math.floor(math.log10(low)), math.ceil(math.log10(high)) + 1)
        values = [step * 10.0**exponent for exponent in decades for step in steps]
        inside = [value for value in values if 1.1 * low < value < high / 1.1]
        if len(inside) <= MOST_LEVELS:
            break
    return inside


def drawn_levels(surface: ResponseSurface, unit_m: float) -> list[float]:
    """Return the levels that are drawn of a grid, in a unit; none where nothing slides."""
    if not (surface.mean_m > 0.0).any():
        return []
    mean = np.maximum(surface.mean_m, LEAST_M) / unit_m
    return levels(mean[~np.isnan(mean)].tolist())


def dots(
    surface: ResponseSurface, arrays: Sequence[ArrayAssessment]
) -> Mapping[tuple[float, float], Sequence[str]]:
    """Return the arrays at each friction and slope [deg] of a grid: equal ones share a dot."""
    drawn = (array for array in arrays if array.id not in surface.others)
    return ids_by(
        drawn, lambda item: (round(item.array.mu, 3), round(math.degrees(item.array.slope_rad), 2))
    )


def dot_name(ids: Sequence[str]) -> str:
    """Return the name of a dot or a line that arrays share."""
    return cut(ranged(ids), 24)


def is_decade(level: float) -> bool:
    """Whether a level is a power of ten."""
    return math.isclose(math.log10(level), round(math.log10(level)), abs_tol=1e-9)
