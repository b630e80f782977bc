"""Curves of a drawing as points: arcs, ellipses and splines become chords.

A quarter of a circle of 1 m becomes 11 chords within 3 mm of it. Points are in world coordinates
and the unit of the drawing; heights are dropped. Read `curve`.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Iterable, Iterator, Sequence
from itertools import chain, islice
from typing import Any

import numpy as np
import shapely
from ezdxf.math import arc_angle_span_deg, arc_segment_count, arc_to_bulge, bulge_to_arc

from report.project.model.shapes import Point

MAX_POINTS = 2000
MAX_COORDINATE = 1e12
# Of a spline, as in AutoCAD: the work for a point of it grows with the square of the degree.
MAX_DEGREE = 10
CURVES = ("LINE", "ARC", "CIRCLE", "LWPOLYLINE", "POLYLINE", "ELLIPSE", "SPLINE")
# Of the direction of extrusion, a unit vector; (0, 0, -1) is an entity that was mirrored.
_FLAT = 1e-6
_SPAN_PARTS = 4  # chords of a spline between two knots, at the least
_SPLINE_FRAME = 16  # of a vertex that controls a curve and is not on it


def curve(entity: Any, sagitta: float) -> tuple[list[Point], bool] | str:
    """Return a curve as points, chords within a sagitta, and if it is closed; or why it is none."""
    kind = entity.dxftype()
    # The other two are in world coordinates, whatever their direction of extrusion is.
    if kind not in ("LINE", "SPLINE") and not is_parallel(entity):
        return f"a {kind} that is not parallel to the plan"
    vertices = _vertices(entity, kind)
    # Of a spline without control points the library finds them, in a time that grows faster.
    has_fit_points = kind == "SPLINE" and not len(entity.control_points)
    if len(vertices) * (10 if has_fit_points else 1) > MAX_POINTS:
        return f"a {kind} of more than {MAX_POINTS} points"
    if kind == "SPLINE" and entity.dxf.degree > MAX_DEGREE:
        return f"a {kind} of a degree above {MAX_DEGREE}"
    no_number = f"a {kind} with a value that is not a number up to {MAX_COORDINATE:g}"
    if not are_numbers((*vertices, entity.knots if kind == "SPLINE" else ())):
        return no_number
    is_closed = bool(entity.is_closed) if kind.endswith("POLYLINE") else _is_circle(entity, kind)
    if kind == "ELLIPSE":
        exact = entity.flattening(sagitta)
    elif kind == "SPLINE":
        exact = _spline(entity, sagitta)
    elif any(bulge for *_, bulge in vertices):
        exact = _chords(vertices, is_closed, sagitta)
    else:  # most lines are modules
        return [(x, y) for x, y, _ in vertices], is_closed
    # One point more than are allowed tells the caller that there are too many.
    points = [(float(p[0]), float(p[1])) for p in islice(exact, MAX_POINTS + 1)]
    return (points, is_closed) if are_numbers(points) else no_number


def is_parallel(entity: Any) -> bool:
    """Whether the plane of an entity is parallel to the plan."""
    x, y, z = entity.dxf.get("extrusion", (0.0, 0.0, 1.0))
    return bool(abs(x) <= _FLAT and abs(y) <= _FLAT and z != 0.0)


def are_numbers(rows: Iterable[Sequence[float]]) -> bool:
    """Whether all values are finite and of a size that a drawing has."""
    return all(abs(value) <= MAX_COORDINATE for value in chain.from_iterable(rows))


def _vertices(entity: Any, kind: str) -> list[tuple[float, float, float]]:
    """Return x, y and the bulge to the next vertex; of a curve that has none, what defines it."""
    if kind in ("LINE", "SPLINE", "ELLIPSE"):
        dxf = entity.dxf
        if kind == "LINE":
            points = (dxf.start, dxf.end)
        elif kind == "ELLIPSE":
            points = (dxf.center, dxf.major_axis)
        else:
            points = entity.control_points if len(entity.control_points) else entity.fit_points
        return [(float(p[0]), float(p[1]), 0.0) for p in points]
    if _is_circle(entity, kind):
        (x, y, _), radius = entity.dxf.center, entity.dxf.radius
        # A circle is two half circles: the bulge of a half circle is tan(180/4 deg) = 1.
        vertices = [(x - radius, y, 1.0), (x + radius, y, 1.0)]
    elif kind == "ARC":
        dxf = entity.dxf
        turn = math.radians(dxf.start_angle), math.radians(dxf.end_angle)
        start, end, bulge = arc_to_bulge(dxf.center, turn[0], turn[1], dxf.radius)
        vertices = [(*start, bulge), (*end, 0.0)]
    elif kind == "LWPOLYLINE":
        vertices = [(x, y, bulge) for x, y, _, _, bulge in entity]
    else:
        # A polyline that was fitted to a spline keeps the vertices of its frame, off the curve
        # (DXF reference, VERTEX, flag 16).
        corners = [v for v in entity.vertices if not v.dxf.flags & _SPLINE_FRAME]
        vertices = [(v.dxf.location.x, v.dxf.location.y, v.dxf.bulge) for v in corners]
        if entity.is_3d_polyline:
            return vertices
    # The plane of the curve may look down: then x and the turn of arcs are mirrored.
    way = 1.0 if entity.dxf.get("extrusion", (0.0, 0.0, 1.0))[2] > 0.0 else -1.0
    return [(way * float(x), float(y), way * float(bulge)) for x, y, bulge in vertices]


def _is_circle(entity: Any, kind: str) -> bool:
    """Whether a curve is a circle, also one that is drawn as an arc of a whole turn."""
    if kind != "ARC":
        return kind == "CIRCLE"
    return bool(arc_angle_span_deg(entity.dxf.start_angle, entity.dxf.end_angle) == 360.0)


def _spline(entity: Any, sagitta: float) -> Iterable[Any]:
    """Return points of a spline whose chords are within the sagitta of it."""
    # The library's own points go beyond the ends of a spline that is not clamped, such as a closed
    # one of AutoCAD.
    tool = entity.construction_tool()
    knots = np.unique(tool.knots()[tool.order - 1 : tool.count + 1])
    spans, parts = len(knots) - 1, _SPAN_PARTS
    while True:
        marks = np.linspace(0, spans, 2 * parts * spans + 1)  # each second one is a middle
        points_3d = tool.points(np.interp(marks, range(spans + 1), knots).tolist())
        points = np.array([(p.x, p.y) for p in points_3d])
        chords = shapely.linestrings(np.stack((points[:-1:2], points[2::2]), axis=1))
        off = shapely.distance(shapely.points(points[1::2]), chords)
        if len(points) > 2 * MAX_POINTS or (off <= sagitta).all():
            return points[::2]
        parts *= 2


def _chords(
    vertices: Sequence[tuple[float, float, float]], is_closed: bool, sagitta: float
) -> Iterator[Point]:
    # A bulge is the tangent of a quarter of the angle of an arc, positive counterclockwise.
    following = (*vertices[1:], *(vertices[:1] if is_closed else ()))
    for (x0, y0, bulge), (x1, y1, _) in zip(vertices, following, strict=False):
        yield x0, y0
        if 0.5 * abs(bulge) * math.dist((x0, y0), (x1, y1)) > sagitta:
            center, _, _, radius = bulge_to_arc((x0, y0), (x1, y1), bulge)
            turn, middle = 4.0 * math.atan(bulge), complex(*center)
            count = arc_segment_count(radius, abs(turn), sagitta)
            for k in range(1, count):
                point = middle + (complex(x0, y0) - middle) * cmath.rect(1.0, turn * k / count)
                yield point.real, point.imag
    if vertices and not is_closed:
        yield vertices[-1][:2]
