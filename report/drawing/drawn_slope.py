"""The slope at which a section through an array is drawn, so that it is visible.

A roof of 2 deg is drawn at 8, one of 10 deg at 10, and one of 20 deg at 15.
"""

from __future__ import annotations

import math

from report.project.model.array import Array

# Flatter roofs are drawn at the first slope, so that it shows; steeper ones at the second.
DRAWN_DEG = (8.0, 15.0)


def drawn_slope_deg(array: Array) -> float:
    """Return the slope at which the roof is drawn [deg]."""
    low, high = DRAWN_DEG
    return min(max(math.degrees(array.slope_rad), low), high)
