"""Areas of a drawing (hatches, faces and meshes) as polygons with their outlines.

Two faces that touch are one area; a hatch over a closed line is its fill, and no outline. Points
are in world coordinates and the unit of the drawing. Read `boundaries`, then `outlines`.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence
from itertools import chain
from typing import Any

import numpy as np
import shapely
from ezdxf.disassemble import make_primitive
from ezdxf.entities.factory import new

from report.drawing_read.closed_lines import join
from report.drawing_read.curves import MAX_COORDINATE, MAX_POINTS, are_numbers, curve, is_parallel
from report.project.model.shapes import Point

MAX_BOUNDARIES = 500
HATCHES = ("HATCH", "MPOLYGON")
# Neighbors that share a border have an area of rounding error in common.
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
    if not are_numbers(chain.from_iterable(rings)):
        return f"a {kind} with a value that is not a number up to {MAX_COORDINATE:g}"
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
        # Grown and shrunk again by half the tolerance: faces whose borders miss each other by
        # rounding become one.
        grown = shapely.union_all([area.buffer(half, join_style="mitre") for area in areas])
        shrunk = shapely.get_parts(grown.buffer(-half, join_style="mitre"))
    parts = [part for part in shrunk if part.geom_type == "Polygon" and not part.is_empty]
    rings = [[(float(x), float(y)) for x, y in part.exterior.coords[:-1]] for part in parts]
    return rings, any(part.interiors for part in parts)


def is_fill(area: Any, layer: str, lines: Sequence[tuple[Any, str]], tolerance: float) -> bool:
    """Whether an area fills closed lines, given with their layers, rather than is an outline."""
    # It is equal to one of any layer, or has an area in common with one of its own.
    for line, name in lines:
        # Boxes first: the distance of two outlines takes the product of their points.
        is_near = np.allclose(line.bounds, area.bounds, rtol=0.0, atol=tolerance)
        if is_near and line.hausdorff_distance(area) <= tolerance:
            return True
        if name == layer and line.intersection(area).area > _LEAST_SHARE * area.area:
            return True
    return False
