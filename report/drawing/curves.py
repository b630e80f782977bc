"""Curves of a drawing as points: lines, polylines, arcs, circles, ellipses and splines as chords.

Points are in world coordinates and the unit of the drawing; heights are dropped.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from itertools import islice, pairwise
from typing import Any

from report.sheet.schema.shapes import Point

MAX_POINTS = 2000
MAX_COORDINATE = 1e12
MAX_DEGREE = 10
"""Of a spline, as in AutoCAD: the work for a point of it grows with the square of the degree."""
CURVES = ("LINE", "ARC", "CIRCLE", "LWPOLYLINE", "POLYLINE", "ELLIPSE", "SPLINE")

_FLAT = 1e-6
_SPAN_PARTS = 4  # of a spline between two knots, at the least
_SPLINE_FRAME = 16  # of a vertex that controls a curve and is not on it


def curve(entity: Any, sagitta: float) -> tuple[list[Point], bool] | str:
    """Return a curve as points and whether it is closed, or why it cannot be read.

    There may be one point more than are allowed; the sagitta is the largest distance of an arc from
    its chords.
    """
    kind = entity.dxftype()
    # The other two are in world coordinates, whatever their direction of extrusion is.
    if kind not in ("LINE", "SPLINE") and not _is_flat(entity):
        return f"a {kind} that is not parallel to the plan"
    if kind == "POLYLINE" and not (entity.is_2d_polyline or entity.is_3d_polyline):
        return "a mesh"
    vertices = _vertices(entity, kind)
    # Of a spline without control points the library finds them, in a time that grows faster.
    if (
        len(vertices) * (10 if kind == "SPLINE" and not len(entity.control_points) else 1)
        > MAX_POINTS
    ):
        return f"a {kind} of more than {MAX_POINTS} points"
    if kind == "SPLINE" and entity.dxf.degree > MAX_DEGREE:
        return f"a {kind} of a degree of more than {MAX_DEGREE}"
    if not all(math.isfinite(value) for vertex in vertices for value in vertex):
        return f"a {kind} with a coordinate that is not a number"
    if not all(abs(value) <= MAX_COORDINATE for vertex in vertices for value in vertex):
        return f"a {kind} with a coordinate or bulge of more than {MAX_COORDINATE:g}"
    is_closed = kind == "CIRCLE" or (kind.endswith("POLYLINE") and bool(entity.is_closed))
    if kind not in ("ELLIPSE", "SPLINE"):
        return list(_chords(vertices, is_closed, sagitta)), is_closed
    exact = entity.flattening(sagitta) if kind == "ELLIPSE" else _spline(entity, sagitta)
    points = [(float(p.x), float(p.y)) for p in islice(exact, MAX_POINTS + 1)]
    if not all(math.isfinite(value) for point in points for value in point):
        return f"a {kind} with a coordinate that is not a number"
    return points, False


def _vertices(entity: Any, kind: str) -> list[tuple[float, float, float]]:
    """Return x, y and the bulge to the next vertex; of a curve that has none, what defines it."""
    if kind in ("LINE", "SPLINE", "ELLIPSE"):
        dxf = entity.dxf
        if kind == "LINE":
            at = (dxf.start, dxf.end)
        elif kind == "ELLIPSE":
            at = (dxf.center, dxf.major_axis)
        else:
            at = entity.control_points if len(entity.control_points) else entity.fit_points
        return [(float(p[0]), float(p[1]), 0.0) for p in at]
    if kind == "CIRCLE":
        (x, y, _), radius = entity.dxf.center, entity.dxf.radius
        found = [(x - radius, y, 1.0), (x + radius, y, 1.0)]
    elif kind == "ARC":
        from ezdxf.math import arc_to_bulge

        dxf = entity.dxf
        turn = math.radians(dxf.start_angle), math.radians(dxf.end_angle)
        start, end, bulge = arc_to_bulge(dxf.center, turn[0], turn[1], dxf.radius)
        found = [(*start, bulge), (*end, 0.0)]
    elif kind == "LWPOLYLINE":
        found = [(x, y, bulge) for x, y, bulge in entity.get_points("xyb")]
    else:
        shown = [v for v in entity.vertices if not v.dxf.flags & _SPLINE_FRAME]
        found = [(v.dxf.location.x, v.dxf.location.y, v.dxf.bulge) for v in shown]
        if entity.is_3d_polyline:
            return found
    # The plane of the curve may look down: then x and the turn of arcs are mirrored.
    way = 1.0 if entity.dxf.get("extrusion", (0.0, 0.0, 1.0))[2] > 0.0 else -1.0
    return [(way * float(x), float(y), way * float(bulge)) for x, y, bulge in found]


def _spline(entity: Any, sagitta: float) -> Iterator[Any]:
    """Yield points of a spline whose chords are within the sagitta of it.

    As the library would, which goes beyond the ends of a spline that is not clamped, such as a
    closed one of AutoCAD.
    """
    tool = entity.construction_tool()
    point = tool.evaluator.point
    knots = sorted(set(tool.knots()[tool.order - 1 : tool.count + 1]))
    yield point(knots[0])
    for low, high in pairwise(knots):
        marks = [low + (high - low) * k / _SPAN_PARTS for k in range(_SPAN_PARTS)] + [high]
        todo = [(t, point(t), u, point(u)) for t, u in pairwise(marks)][::-1]
        while todo:
            t, start, u, end = todo.pop()
            half, step = 0.5 * (t + u), end - start
            middle = point(half)
            off = middle - start
            aside = abs(step.x * off.y - step.y * off.x)
            far = aside / step.magnitude if step.magnitude else off.magnitude
            if t < half < u and not far < sagitta:
                todo += [(half, middle, u, end), (t, start, half, middle)]
            else:
                yield end


def _chords(
    vertices: Sequence[tuple[float, float, float]], is_closed: bool, sagitta: float
) -> Iterator[Point]:
    """Yield points with arcs as chords, up to one more than are allowed.

    A bulge is the tangent of a quarter of the angle of an arc, positive counterclockwise.
    """
    count = 0
    following = (*vertices[1:], *(vertices[:1] if is_closed else ()))
    for (x0, y0, bulge), (x1, y1, _) in zip(vertices, following, strict=False):
        for share in _shares(math.dist((x0, y0), (x1, y1)), bulge, sagitta):
            count += 1
            if count > MAX_POINTS + 1:
                return
            turn = 4.0 * math.atan(bulge)
            along, aside = _on_arc(turn, share) if turn else (0.0, 0.0)
            dx, dy = x1 - x0, y1 - y0
            yield x0 + along * dx + aside * dy, y0 + along * dy - aside * dx
    if vertices and not is_closed:
        yield vertices[-1][:2]


def _on_arc(turn: float, share: float) -> tuple[float, float]:
    """Return how far along its chord and to the right of it a point of an arc is, in chords."""
    sin, cos = math.sin(0.5 * turn), math.cos(0.5 * turn)
    rest = turn * (0.5 - share)
    return 0.5 * (1.0 - math.sin(rest) / sin), 0.5 * (math.cos(rest) - cos) / sin


def _shares(chord: float, bulge: float, sagitta: float) -> list[float]:
    """Return the shares of an arc at which its chords start; 0 alone for a line."""
    if 0.5 * abs(bulge) * chord <= sagitta:
        return [0.0]
    radius = chord * (1.0 + bulge**2) / (4.0 * abs(bulge))
    step = 4.0 * math.asin(math.sqrt(0.5 * min(sagitta / radius, 0.5)))
    count = min(math.ceil(4.0 * math.atan(abs(bulge)) / step), MAX_POINTS + 1)
    return [k / count for k in range(count)]


def _is_flat(entity: Any) -> bool:
    x, y, z = entity.dxf.get("extrusion", (0.0, 0.0, 1.0))
    return bool(abs(x) <= _FLAT and abs(y) <= _FLAT and z != 0.0)


def without_doubles(points: Sequence[Point]) -> list[Point]:
    """Return points without those at the place of the one before."""
    kept = list(points[:1])
    for point in points[1:]:
        if math.dist(point, kept[-1]) > _FLAT * max(1.0, *map(abs, point)):
            kept.append(point)
    if len(kept) > 1 and math.dist(kept[0], kept[-1]) <= _FLAT * max(1.0, *map(abs, kept[0])):
        kept.pop()
    return kept
