"""A drawing turned about its origin, and the axes that an outline has of its own."""

from __future__ import annotations

import cmath
import math
from dataclasses import replace

from report.drawing.read_dxf import RoofDrawing
from report.sheet.schema.shapes import Point, Shape, sides


def turned(drawing: RoofDrawing, degrees: float) -> RoofDrawing:
    """Return a drawing turned counterclockwise about the origin of its coordinates, with north."""
    turn = cmath.rect(1.0, math.radians(degrees))

    def at(point: Point) -> Point:
        found = complex(*point) * turn
        return found.real, found.imag

    return replace(
        drawing,
        lines=[replace(line, points=tuple(map(at, line.points))) for line in drawing.lines],
        texts=[replace(text, at=at(text.at)) for text in drawing.texts],
        north_deg=(drawing.north_deg + degrees) % 360.0,
    )


def own_axes(shape: Shape) -> tuple[float, float, float]:
    """Return the sizes [m] of a shape along its own axes, and their angle to x and y [deg].

    One is parallel to its longest side, the first the one within 45 deg of x.
    """
    (x0, y0), (x1, y1) = max(sides(shape.points), key=lambda side: math.dist(*side))
    direction = math.degrees(math.atan2(y1 - y0, x1 - x0))
    angle = direction - 90.0 * round(direction / 90.0)
    turn = cmath.rect(1.0, math.radians(-angle))
    own = [complex(*point) * turn for point in shape.points]
    wide, tall = (
        max(axis) - min(axis) for axis in zip(*((z.real, z.imag) for z in own), strict=True)
    )
    return wide, tall, angle
