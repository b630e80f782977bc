"""Areas of a drawing as closed lines: hatches by their boundaries, faces and meshes by outline.

Points are in world coordinates and the unit of the drawing; heights are dropped. Read `curves`
first: the boundary of a hatch consists of the same curves.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence
from typing import Any

import numpy as np

from report.drawing.curves import MAX_COORDINATE, MAX_POINTS, curve, is_parallel
from report.drawing.joined import join
from report.sheet.schema.shapes import Point

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
    """Return the boundaries of a hatch as polygons, or why it has none.

    Parameters
    ----------
    sagitta, tolerance : float
        Largest distance of an arc from its chords, and between ends that meet.
    """
    kind = hatch.dxftype()
    if not is_parallel(hatch):
        return f"a {kind} that is not parallel to the plan"
    if len(hatch.paths) > MAX_BOUNDARIES:
        return f"a {kind} of more than {MAX_BOUNDARIES} boundaries"
    way = math.copysign(1.0, hatch.dxf.get("extrusion", (0.0, 0.0, 1.0))[2])
    rings: list[list[Point]] = []
    for path in hatch.paths:
        opened: list[list[Point]] = []
        for part in _curves(path):
            found = curve(part, sagitta)
            if isinstance(found, str):
                return f"a {kind} whose boundary is not read: {found}"
            points, is_closed = found
            (rings if is_closed else opened).append(points)
        closed, rest = join(opened, tolerance)
        if rest:
            return f"a {kind} whose boundary is not closed"
        rings += [points for points, _ in closed]
    return polygons([(way * x, y) for x, y in points] for points in rings)


def _curves(path: Any) -> Iterator[Any]:
    """Yield the curves of a boundary, in the plane of the hatch."""
    from ezdxf.entities.factory import new

    if hasattr(path, "vertices"):
        line: Any = new("LWPOLYLINE")
        line.set_points(path.vertices, format="xyb")
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
    from ezdxf.render.mesh import MeshBuilder

    kind = entity.dxftype()
    match kind:
        case "3DFACE":
            rings = [entity.wcs_vertices()]
        case "MESH":
            rings = list(MeshBuilder.from_mesh(entity).faces_as_vertices())
        case _:
            rings = list(MeshBuilder.from_polyface(entity).faces_as_vertices())
    if sum(map(len, rings)) > 4 * MAX_POINTS:
        return f"a {kind} of more than {4 * MAX_POINTS} points"
    if any(not abs(value) <= MAX_COORDINATE for ring in rings for p in ring for value in p):
        return f"a {kind} with a value that is no number up to {MAX_COORDINATE:g}"
    return polygons([(float(p[0]), float(p[1])) for p in ring] for ring in rings)


def polygons(rings: Iterable[Sequence[Point]]) -> list[Any]:
    """Return closed lines as polygons, valid where they cross themselves; none without an area."""
    import shapely

    made = (shapely.make_valid(shapely.Polygon(ring)) for ring in rings if len(ring) > 2)
    return [area for area in made if area.area > 0.0]


def outlines(areas: Sequence[Any], tolerance: float) -> tuple[list[list[Point]], bool]:
    """Return the outlines of areas that touch within a tolerance, and whether they have holes."""
    import shapely

    half = 0.5 * tolerance
    # The library finds the corner of a spike by dividing by its width, and then does without it.
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        grown = shapely.union_all([area.buffer(half, join_style="mitre") for area in areas])
        shrunk = shapely.get_parts(grown.buffer(-half, join_style="mitre"))
    parts = [part for part in shrunk if part.geom_type == "Polygon" and not part.is_empty]
    rings = [[(float(x), float(y)) for x, y in part.exterior.coords[:-1]] for part in parts]
    return rings, any(part.interiors for part in parts)


def is_fill(area: Any, layer: str, lines: Sequence[tuple[Any, str]], tolerance: float) -> bool:
    """Whether an area fills closed lines, given with their layers, rather than is an outline.

    It is equal to one of any layer, or has an area in common with one of its own.
    """

    for other, name in lines:
        is_near = np.allclose(other.bounds, area.bounds, rtol=0.0, atol=tolerance)
        if is_near and other.hausdorff_distance(area) <= tolerance:
            return True
        if name == layer and other.intersection(area).area > _LEAST_SHARE * area.area:
            return True
    return False
