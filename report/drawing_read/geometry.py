"""Outlines in plan: rotated, along their own axes, and as rectangles if they are rectangular.

A rectangle of 30 by 10 m, turned by 30 deg, has these sides along its own axes.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Sequence

from report.project.model.shapes import Point, Polygon, Rectangle, Shape, sides

# Sides within this of an axis [m] are parallel to it; vertices within this of a line are on it.
ROUNDED_M = 1e-5


def turned(points: Sequence[Point], degrees: float) -> tuple[Point, ...]:
    """Return points turned counterclockwise about the origin."""
    turn = cmath.rect(1.0, math.radians(degrees))
    turned_points = (complex(*point) * turn for point in points)
    return tuple((z.real, z.imag) for z in turned_points)


def own_axes(shape: Shape) -> tuple[float, float, float]:
    """Return the sizes [m] of a shape along its own axes, and their angle to x and y [deg]."""
    # One axis is parallel to its longest side; the first is the one within 45 deg of x.
    (x0, y0), (x1, y1) = max(sides(shape.points), key=lambda side: math.dist(*side))
    direction = math.degrees(math.atan2(y1 - y0, x1 - x0))
    # Within 45 deg: sides of a box are the same by quarter turns.
    angle = direction - 90.0 * round(direction / 90.0)
    box = Polygon(turned(shape.points, -angle)).bounds
    return box.x_to_m - box.x_from_m, box.y_to_m - box.y_from_m, angle


def boxed(shape: Polygon) -> Shape:
    """Return a polygon, as a rectangle if it is one that is parallel to the axes."""
    return box_of(shape) or shape


def box_of(shape: Polygon) -> Rectangle | None:
    """Return a polygon as a rectangle, if it is one that is parallel to the axes."""
    is_right = len(shape.points) == 4 and all(
        min(abs(x1 - x0), abs(y1 - y0)) <= ROUNDED_M for (x0, y0), (x1, y1) in sides(shape.points)
    )
    return shape.bounds if is_right else None
