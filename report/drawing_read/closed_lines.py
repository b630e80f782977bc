"""Curves and areas of a drawing as closed lines: arcs become chords, open lines are joined.

A quarter of a circle of 1 m becomes 11 chords within 3 mm of it.

Points are in world coordinates and the unit of the drawing; heights are dropped.
"""

from __future__ import annotations

import cmath
import math
from collections import Counter, defaultdict
from collections.abc import Iterable, Iterator, Mapping, Sequence
from itertools import chain, islice, product
from typing import Any

import numpy as np
import shapely
from ezdxf import edgeminer
from ezdxf.disassemble import make_primitive
from ezdxf.entities.factory import new
from ezdxf.math import arc_angle_span_deg, arc_segment_count, arc_to_bulge, bulge_to_arc

from report.project.model.shapes import Point

MAX_POINTS = 2000
MAX_COORDINATE = 1e12
# Of a spline, as in AutoCAD: the work for a point of it grows with the square of the degree.
MAX_DEGREE = 10
CURVES = ("LINE", "ARC", "CIRCLE", "LWPOLYLINE", "POLYLINE", "ELLIPSE", "SPLINE")

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
        return f"a {kind} of a degree of more than {MAX_DEGREE}"
    no_number = f"a {kind} with a value that is no number up to {MAX_COORDINATE:g}"
    if not _are_numbers((*vertices, entity.knots if kind == "SPLINE" else ())):
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
    return (points, is_closed) if _are_numbers(points) else no_number


def is_parallel(entity: Any) -> bool:
    """Whether the plane of an entity is parallel to the plan."""
    x, y, z = entity.dxf.get("extrusion", (0.0, 0.0, 1.0))
    return bool(abs(x) <= _FLAT and abs(y) <= _FLAT and z != 0.0)


def _are_numbers(rows: Iterable[Sequence[float]]) -> bool:
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
        vertices = [(x - radius, y, 1.0), (x + radius, y, 1.0)]
    elif kind == "ARC":
        dxf = entity.dxf
        turn = math.radians(dxf.start_angle), math.radians(dxf.end_angle)
        start, end, bulge = arc_to_bulge(dxf.center, turn[0], turn[1], dxf.radius)
        vertices = [(*start, bulge), (*end, 0.0)]
    elif kind == "LWPOLYLINE":
        vertices = [(x, y, bulge) for x, y, _, _, bulge in entity]
    else:
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


OPEN = "an open line that closes no outline"
BRANCHED = "open lines of which three or more meet at a point"

Line = Sequence[Point]
# A closed line, and which open ones it consists of.
Closed = tuple[list[Point], list[int]]


def join(lines: Sequence[Line], tolerance: float) -> tuple[list[Closed], Mapping[int, str]]:
    """Return the closed lines of open ones whose ends meet within a tolerance, and why not all."""
    cells: dict[Point, list[Point]] = defaultdict(list)
    # Ends that meet are one point from here on, so that a chain is found by equality.
    ends: dict[int, tuple[Point, Point]] = {}
    drawn: dict[tuple[Point, ...], int] = {}
    loops: list[list[tuple[int, bool]]] = []
    for k, points in enumerate(lines):
        start, end = (_snapped(at, cells, tolerance) for at in (points[0], points[-1]))
        if start != end:
            ends[k] = (start, end)
            middle = points[1:-1] if start < end else points[-2:0:-1]
            drawn.setdefault((*sorted((start, end)), *middle), k)
        elif len(points) > 2:
            loops.append([(k, False)])
    meeting = Counter(chain.from_iterable(ends[k] for k in drawn.values()))
    # Where no more than two meet a chain has no choice, and all takes linear time.
    edges = [
        edgeminer.make_edge(*ends[k], payload=k)
        for k in drawn.values()
        if all(meeting[end] == 2 for end in ends[k])
    ]
    gap = 0.5 * tolerance
    deposit = edgeminer.Deposit(edges, gap_tol=gap) if edges else None
    for edges_of_chain in edgeminer.find_all_simple_chains(deposit) if deposit else ():
        if len(edges_of_chain) > 1 and edgeminer.is_loop(edges_of_chain, gap_tol=gap):
            loop = [(edge.payload, edge.is_reverse) for edge in edges_of_chain]
            first = loop.index(min(loop))
            loops.append([*loop[first:], *loop[:first]])
    # Lines that are drawn twice count once.
    unused = set(range(len(lines))) - {k for k, _ in chain.from_iterable(loops)}
    unused -= ends.keys() - set(drawn.values())
    reasons = {}
    for k in sorted(unused):
        is_branched = any(meeting[end] > 2 for end in ends.get(k, ()))
        reasons[k] = BRANCHED if is_branched else OPEN
    return [_closed(lines, loop) for loop in sorted(loops)], reasons


def _snapped(point: Point, cells: dict[Point, list[Point]], tolerance: float) -> Point:
    """Return the end that stands for another within the tolerance."""
    # Two that stand for others are farther apart: so ends that meet one meet each other, and a
    # chain cannot lead around without end.
    column, row = (math.floor(value / tolerance) for value in point)
    for i, j in product((-1, 0, 1), repeat=2):
        for end in cells.get((column + i, row + j), ()):
            if math.dist(point, end) <= tolerance:
                return end
    cells[column, row].append(point)
    return point


def _closed(lines: Sequence[Line], loop: Sequence[tuple[int, bool]]) -> Closed:
    """Return a chain as a closed line; of the two ends at a corner, the one that begins a line."""
    points: list[Point] = []
    for k, is_reversed in loop:
        line = lines[k][::-1] if is_reversed else lines[k]
        points += line[:-1]
    return points, [k for k, _ in loop]


MAX_BOUNDARIES = 500
HATCHES = ("HATCH", "MPOLYGON")

_LEAST_SHARE = 1e-3
_EDGES = {
    "LineEdge": ("LINE", ("start", "end")),
    "ArcEdge": ("ARC", ("center", "radius", "start_angle", "end_angle")),
    "EllipseEdge": ("ELLIPSE", ("center", "major_axis", "ratio", "start_param", "end_param")),
    "SplineEdge": ("SPLINE", ("degree",)),
}


def is_mesh(entity: Any) -> bool:
    """Whether an entity consists of faces."""
    if entity.dxftype() == "POLYLINE":
        return bool(entity.is_poly_face_mesh or entity.is_polygon_mesh)
    return entity.dxftype() in ("3DFACE", "MESH")


def boundaries(hatch: Any, sagitta: float, tolerance: float) -> list[Any] | str:
    """Return the boundaries of a hatch as polygons, chords within a sagitta, or why it has none."""
    kind = hatch.dxftype()
    if not is_parallel(hatch):
        return f"a {kind} that is not parallel to the plan"
    if len(hatch.paths) > MAX_BOUNDARIES:
        return f"a {kind} of more than {MAX_BOUNDARIES} boundaries"
    # A hatch that looks down is mirrored in x, as a polyline is.
    way = math.copysign(1.0, hatch.dxf.get("extrusion", (0.0, 0.0, 1.0))[2])
    rings: list[list[Point]] = []
    for path in hatch.paths:
        opened: list[list[Point]] = []
        for part in _curves(path):
            outline = curve(part, sagitta)
            if isinstance(outline, str):
                return f"a {kind} whose boundary is not read: {outline}"
            points, is_closed = outline
            (rings if is_closed else opened).append(points)
        closed, unclosed = join(opened, tolerance)
        if unclosed:
            return f"a {kind} whose boundary is not closed"
        rings += [points for points, _ in closed]
    return polygons([(way * x, y) for x, y in points] for points in rings)


def _curves(path: Any) -> Iterator[Any]:
    """Yield the curves of a boundary, in the plane of the hatch."""
    if hasattr(path, "vertices"):
        line: Any = new("LWPOLYLINE")
        line.set_points(path.vertices, format="xyb")
        # A boundary is closed by what it is, whatever its flag.
        line.closed = True
        yield line
        return
    for edge in path.edges:
        kind, names = _EDGES[edge.EDGE_TYPE]
        part: Any = new(kind, {name: getattr(edge, name) for name in names})
        if kind == "SPLINE":
            part.control_points, part.fit_points = edge.control_points, edge.fit_points
            part.knots, part.weights = edge.knot_values, edge.weights
        yield part


def faces(entity: Any) -> list[Any] | str:
    """Return the faces of a 3DFACE or a mesh as polygons, without vertical ones; or why none."""
    kind = entity.dxftype()
    if kind == "3DFACE":
        rings = [entity.wcs_vertices()]
    else:
        primitive: Any = make_primitive(entity)
        rings = list(primitive.mesh.faces_as_vertices())
    if sum(map(len, rings)) > 4 * MAX_POINTS:
        return f"a {kind} of more than {4 * MAX_POINTS} points"
    if not _are_numbers(chain.from_iterable(rings)):
        return f"a {kind} with a value that is no number up to {MAX_COORDINATE:g}"
    return polygons([(float(p[0]), float(p[1])) for p in ring] for ring in rings)


def polygons(rings: Iterable[Sequence[Point]]) -> list[Any]:
    """Return closed lines as polygons, valid where they cross themselves; none without an area."""
    made = (shapely.make_valid(shapely.Polygon(ring)) for ring in rings if len(ring) > 2)
    return [area for area in made if area.area > 0.0]


def outlines(areas: Sequence[Any], tolerance: float) -> tuple[list[list[Point]], bool]:
    """Return the outlines of areas that touch within a tolerance, and whether they have holes."""
    half = 0.5 * tolerance
    # The library finds the corner of a spike by dividing by its width, and then does without it.
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        grown = shapely.union_all([area.buffer(half, join_style="mitre") for area in areas])
        shrunk = shapely.get_parts(grown.buffer(-half, join_style="mitre"))
    parts = [part for part in shrunk if part.geom_type == "Polygon" and not part.is_empty]
    rings = [[(float(x), float(y)) for x, y in part.exterior.coords[:-1]] for part in parts]
    return rings, any(part.interiors for part in parts)


def is_fill(area: Any, layer: str, lines: Sequence[tuple[Any, str]], tolerance: float) -> bool:
    """Whether an area fills closed lines, given with their layers, rather than is an outline."""
    # It is equal to one of any layer, or has an area in common with one of its own.
    for line, name in lines:
        is_near = np.allclose(line.bounds, area.bounds, rtol=0.0, atol=tolerance)
        if is_near and line.hausdorff_distance(area) <= tolerance:
            return True
        if name == layer and line.intersection(area).area > _LEAST_SHARE * area.area:
            return True
    return False
