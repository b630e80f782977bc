"""How steep the section through an array is drawn: a text beside the picture says it too.

Draws nothing; `report.figures.section` does.
"""

from __future__ import annotations

import math

from report.sheet.schema.scene import Array

DRAWN_DEG = (8.0, 15.0)
"""Flatter roofs are drawn at the first slope, so that it shows; steeper ones at the second."""


def drawn_slope_deg(array: Array) -> float:
    """Return the slope at which the roof is drawn [deg]."""
    least, most = DRAWN_DEG
    return min(max(math.degrees(array.slope_rad), least), most)
