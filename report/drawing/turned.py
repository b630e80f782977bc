"""A drawing turned about its origin, and the axes that an outline has of its own."""

from __future__ import annotations

import cmath
import math
from dataclasses import replace

from report.drawing.read_dxf import RoofDrawing
from report.sheet.schema.shapes import Point, Rectangle, Shape, sides, solid


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

    The axes are those of the smallest rectangle around it if half of its perimeter is parallel to
    them, otherwise x and y. The first is the one within 45 deg of x.
    """
    import shapely

    box = shape.bounds
    plain = (box.x_to_m - box.x_from_m, box.y_to_m - box.y_from_m, 0.0)
    if isinstance(shape, Rectangle):
        return plain
    a, b, c = (
        complex(*at) for at in shapely.minimum_rotated_rectangle(solid(shape)).exterior.coords[:3]
    )
    steps = [complex(*end) - complex(*start) for start, end in sides(shape.points)]
    # The square of a direction is real along either axis.
    along = [
        abs(z) for z in steps if abs(((z / (b - a)) ** 2).imag) <= 2e-3 * abs(z / (b - a)) ** 2
    ]
    if sum(along) < 0.5 * sum(map(abs, steps)):
        return plain
    angle = math.degrees(cmath.phase(b - a))
    quarter = round(angle / 90.0)
    wide, tall = (abs(b - a), abs(c - b))[:: -1 if quarter % 2 else 1]
    return wide, tall, angle - 90.0 * quarter
