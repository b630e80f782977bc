"""Round levels of contours. Loads no plotting library."""

from __future__ import annotations

import math
from collections.abc import Sequence

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


def is_decade(level: float) -> bool:
    """Whether a level is a power of ten."""
    return math.isclose(math.log10(level), round(math.log10(level)), abs_tol=1e-9)
