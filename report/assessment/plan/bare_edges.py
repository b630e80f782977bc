"""Sides of the roof outline along which no object is an edge.

+=== edge ===+........+    the dots are a bare edge: no object stands for this part of the side
|                     |
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from report.project.model import ProjectInput
from report.project.model.choices import ObjectKind
from report.project.model.shapes import Point, Polygon, Rectangle, Shape, gap_m, sides, spans_near

# Largest distance [m] from a side of the roof to the strip of the object that stands for it: one
# foot.
EDGE_STRIP_M = 0.3048

_COMPASS = ("east", "northeast", "north", "northwest", "west", "southwest", "south", "southeast")
EDGES = (ObjectKind.EDGE_WITH_PARAPET, ObjectKind.EDGE_WITHOUT_PARAPET)


@dataclass(frozen=True, slots=True)
class BareEdge:
    """A side of the roof outline, or a part of it, along which no object is an edge."""

    name: str  # as in `west edge of the roof`
    ends: tuple[Point, Point]

    @property
    def line(self) -> Shape:
        """The line between its ends."""
        return _line(*self.ends)


def bare_edges(data: ProjectInput) -> tuple[BareEdge, ...]:
    """Return the parts of the roof outline along which no object is an edge, if it is given."""
    outline = data.roof.placed
    strips = [item.placed for item in data.objects if item.kind in EDGES]
    placed = [strip for strip in strips if strip is not None]
    return () if outline is None else bare_sides(outline, placed, data.roof.north_deg)


def bare_sides(outline: Shape, strips: Sequence[Shape], north_deg: float) -> tuple[BareEdge, ...]:
    """Return the parts of an outline along which no strip lies."""
    bare = []
    for number, side in enumerate(sides(outline.points), start=1):
        (x0, y0), (x1, y1) = side
        # Outlines run counterclockwise (`shapes.ring`): outward is to the right of a side.
        outward_deg = math.degrees(math.atan2(x0 - x1, y1 - y0))
        # An L-shaped roof has two west edges: the number of the side tells them apart.
        name = f"{compass(outward_deg, north_deg)} edge of the roof"
        if isinstance(outline, Polygon):
            name += f" (side {number})"
        bare += [BareEdge(name, ends) for ends in _bare(side, strips)]
    return tuple(bare)


def compass(way_deg: float, north_deg: float) -> str:
    """Return the point of the compass of a direction in plan, counterclockwise from +x."""
    # East, first in the list, is a quarter turn clockwise of north.
    return _COMPASS[round((way_deg - north_deg + 90.0) / 45.0) % 8]


def _line(start: Point, end: Point) -> Shape:
    """Return a line as a shape: where it is parallel to an axis, a rectangle of no width."""
    (x0, y0), (x1, y1) = start, end
    if x0 == x1 or y0 == y1:
        return Rectangle(min(x0, x1), max(x0, x1), min(y0, y1), max(y0, y1))
    return Polygon((start, end))


def _bare(side: tuple[Point, Point], strips: Sequence[Shape]) -> Iterator[tuple[Point, Point]]:
    """Yield the parts of a side along which no strip lies; none shorter than `EDGE_STRIP_M`."""
    # It takes 0.09 s to load, which a check of a plan without the outline of a roof does not need.
    from shapely import LineString
    from shapely.ops import substring

    line, covered_to = LineString(side), 0.0
    # The end of the side bounds the last part as a strip does.
    for start, end in [*sorted(_covered(side, strips)), (line.length, line.length)]:
        if start - covered_to > EDGE_STRIP_M:
            first, last = substring(line, covered_to, start).coords
            yield first, last
        covered_to = max(covered_to, end)


def _covered(side: tuple[Point, Point], strips: Sequence[Shape]) -> Iterator[tuple[float, float]]:
    """Yield the ranges of a side near which strips lie [m], from its start."""
    import shapely

    line, path = _line(*side), shapely.LineString(side)
    for strip in strips:
        if isinstance(line, Rectangle) and isinstance(strip, Rectangle):
            parts = [strip.points] if gap_m(line, strip) <= EDGE_STRIP_M else []
        else:
            parts = spans_near(strip, *side, EDGE_STRIP_M)
        for points in parts:
            along = shapely.line_locate_point(path, shapely.points(points)).tolist()
            yield min(along), max(along)
