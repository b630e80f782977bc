"""Shapes in roof plan: rectangles and polygons, the gap between two, and the points where it is.

Knows no sheet and no workbook. Two rectangles take closed forms: shapely, which takes 0.09 s to
load, is imported only for other shapes.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from functools import lru_cache
from itertools import chain, combinations, product
from operator import attrgetter
from typing import Annotated, Any, Self

from pydantic import Field

from report.project.model.values import Frozen

Point = tuple[float, float]

# Differences in plan [m] that are rounding error.
NEAR_M = 1e-6
_MOST_COORDINATES = 12  # tried as sides of the room for a name


@dataclass(frozen=True, slots=True)
class Rectangle:
    """A rectangle in roof plan [m], parallel to the axes; of no width, a line."""

    x_from_m: float
    x_to_m: float
    y_from_m: float
    y_to_m: float

    @property
    def points(self) -> tuple[Point, ...]:
        """Its corners, counterclockwise."""
        x0, x1, y0, y1 = self.x_from_m, self.x_to_m, self.y_from_m, self.y_to_m
        return (x0, y0), (x1, y0), (x1, y1), (x0, y1)

    @property
    def bounds(self) -> Rectangle:
        """Itself."""
        return self

    @property
    def area_m2(self) -> float:
        """Its area."""
        return (self.x_to_m - self.x_from_m) * (self.y_to_m - self.y_from_m)


@dataclass(frozen=True, slots=True)
class Polygon:
    """A polygon in roof plan: its vertices [m] in order, the first not repeated."""

    points: tuple[Point, ...]

    @property
    def bounds(self) -> Rectangle:
        """The smallest rectangle around it."""
        return around([self])

    @property
    def area_m2(self) -> float:
        """Its area."""
        return abs(signed_area_m2(self.points))


Shape = Rectangle | Polygon


def signed_area_m2(points: tuple[Point, ...]) -> float:
    """Return the area [m2] within a ring; negative if its points are clockwise."""
    return 0.5 * sum(x0 * y1 - x1 * y0 for (x0, y0), (x1, y1) in sides(points))


def sides(points: tuple[Point, ...]) -> Iterator[tuple[Point, Point]]:
    """Yield the sides of a ring, each from a vertex to the next."""
    return zip(points, (*points[1:], *points[:1]), strict=True)


def ring(points: Sequence[Point]) -> tuple[Point, ...]:
    """Return vertices counterclockwise from the first, which is not repeated at the end."""
    open_points = tuple(points[:-1] if len(points) > 1 and points[0] == points[-1] else points)
    if signed_area_m2(open_points) >= 0.0:
        return open_points
    return open_points[0], *open_points[:0:-1]


def around(shapes: Iterable[Shape]) -> Rectangle:
    """Return the smallest rectangle around shapes."""
    x, y = zip(*chain.from_iterable(shape.points for shape in shapes), strict=True)
    return Rectangle(min(x), max(x), min(y), max(y))


def gap_m(a: Shape, b: Shape) -> float:
    """Return the smallest distance of two shapes in plan [m]; negative if they overlap."""
    # Then it is minus the smaller side of the rectangle around their common area.
    if isinstance(a, Rectangle) and isinstance(b, Rectangle):
        dx = max(a.x_from_m, b.x_from_m) - min(a.x_to_m, b.x_to_m)
        dy = max(a.y_from_m, b.y_from_m) - min(a.y_to_m, b.y_to_m)
        # Both negative: they overlap in both directions. One positive: side by side; both: across
        # a corner.
        return max(dx, dy) if max(dx, dy) < 0 else math.hypot(max(dx, 0.0), max(dy, 0.0))
    first, second = solid(a), solid(b)
    overlap = _depth_m(first.intersection(second))
    return -overlap if overlap > 0.0 else float(first.distance(second))


def _depth_m(area: Any) -> float:
    """Return the largest smaller side of the rectangles around the parts of an area [m]."""
    boxes = [part.bounds for part in _parts(area)]
    return max((min(x1 - x0, y1 - y0) for x0, y0, x1, y1 in boxes), default=0.0)


def _parts(area: Any) -> list[Any]:
    """Return the polygons of an area; none for points and lines, where shapes only touch."""
    parts = getattr(area, "geoms", (area,))
    return [part for part in parts if part.geom_type == "Polygon" and not part.is_empty]


def closest(a: Shape, b: Shape) -> tuple[Point, Point]:
    """Return a point of each shape at their smallest distance, midway along facing sides."""
    if isinstance(a, Rectangle) and isinstance(b, Rectangle):
        xa, xb = _nearest((a.x_from_m, a.x_to_m), (b.x_from_m, b.x_to_m))
        ya, yb = _nearest((a.y_from_m, a.y_to_m), (b.y_from_m, b.y_to_m))
        return (xa, ya), (xb, yb)
    common = _parts(solid(a).intersection(solid(b)))
    if common:
        inside = max(common, key=lambda part: part.area).representative_point()
        return (inside.x, inside.y), (inside.x, inside.y)
    return _facing_sides(a, b)[1:]


def _nearest(a: tuple[float, float], b: tuple[float, float]) -> tuple[float, float]:
    """Return the closest points of two ranges; the middle of the overlap if they overlap."""
    if a[1] <= b[0]:
        return a[1], b[0]
    if b[1] <= a[0]:
        return a[0], b[1]
    middle = (max(a[0], b[0]) + min(a[1], b[1])) / 2
    return middle, middle


def _facing_sides(a: Shape, b: Shape) -> tuple[float, Point, Point]:
    """Return the length [m] over which the closest sides face each other, and midway points."""
    import numpy as np
    import shapely

    # Of all sides at the smallest distance, those that face each other over the longest stretch.
    sides_a = [(start, end) for start, end in sides(a.points) if start != end]
    sides_b = [(start, end) for start, end in sides(b.points) if start != end]
    distances = shapely.distance(
        shapely.linestrings(sides_a)[:, None], shapely.linestrings(sides_b)
    )
    near = np.argwhere(distances <= distances.min() + NEAR_M)
    facing = [_facing(sides_a[i], sides_b[j]) for i, j in near]
    return max(facing, key=lambda side: side[0])


def _facing(a: tuple[Point, Point], b: tuple[Point, Point]) -> tuple[float, Point, Point]:
    """Return the length [m] over which two sides face each other, and their closest points."""
    import shapely

    (x, y), (x1, y1) = a
    long = math.hypot(x1 - x, y1 - y)
    ux, uy = (x1 - x) / long, (y1 - y) / long
    # Both ends of the other side in coordinates along and across the first one.
    along = sorted((px - x) * ux + (py - y) * uy for px, py in b)
    across = [(py - y) * ux - (px - x) * uy for px, py in b]
    low, high = max(along[0], 0.0), min(along[1], long)
    if high > low and abs(across[0] - across[1]) <= NEAR_M:
        middle, aside = (low + high) / 2, across[0]
        foot = (x + middle * ux, y + middle * uy)
        return high - low, foot, (foot[0] - aside * uy, foot[1] + aside * ux)
    line = shapely.shortest_line(shapely.LineString(a), shapely.LineString(b))
    start, end = line.coords
    return 0.0, (start[0], start[1]), (end[0], end[1])


def outside(shape: Shape, limit: Shape) -> Point | None:
    """Return a point of a shape that is outside another one; None if there is none."""
    parts = _parts(solid(shape).difference(solid(limit)))
    deep = [part for part in parts if _depth_m(part) > NEAR_M]
    if not deep:
        return None
    # Within the part: the centroid of a U-shaped one is not.
    inside = max(deep, key=lambda part: part.area).representative_point()
    return inside.x, inside.y


def crossing(points: tuple[Point, ...]) -> Point | None:
    """Return a point at which a ring touches or crosses itself; None if there is none."""
    from shapely import Polygon as Ring
    from shapely.validation import explain_validity

    reason = explain_validity(Ring(points))
    if reason == "Valid Geometry":
        return None
    # The library says the place in its sentence alone: `Self-intersection[1 2]`.
    x, y = reason.partition("[")[2].rstrip("]").split()
    return float(x), float(y)


def spans_near(shape: Shape, start: Point, end: Point, within_m: float) -> list[tuple[Point, ...]]:
    """Return the vertices of each part of a shape that lies within a distance of a line [m]."""
    import shapely

    band = shapely.LineString((start, end)).buffer(within_m, cap_style="flat")
    common = solid(shape).intersection(band)
    parts = [part for part in getattr(common, "geoms", (common,)) if not part.is_empty]
    return [tuple((x, y) for x, y in shapely.get_coordinates(part)) for part in parts]


def merged(rings: Sequence[Sequence[Point]]) -> tuple[Point, ...]:
    """Return the outline around rings that overlap; what they enclose is within it."""
    import shapely

    union = shapely.union_all([shapely.Polygon(points) for points in rings if len(points) > 2])
    return ring([(x, y) for x, y in union.exterior.coords])


def mean(points: Sequence[Point]) -> Point:
    """Return the mean of points."""
    x, y = (sum(axis) / len(axis) for axis in zip(*points, strict=True))
    return x, y


@lru_cache(maxsize=4096)
def room(shape: Shape) -> Rectangle:
    """Return a large rectangle within a shape: where its name has room."""
    if isinstance(shape, Rectangle):
        return shape
    import shapely

    (x, y), (on_x, on_y) = shapely.maximum_inscribed_circle(solid(shape)).coords
    # The square in the largest circle is always within; one between coordinates of vertices may be
    # larger, as each arm of an L is.
    half = math.dist((x, y), (on_x, on_y)) * math.sqrt(0.5)
    best = Rectangle(x - half, x + half, y - half, y + half)
    boxes = [Rectangle(*xs, *ys) for xs, ys in product(_ranges(shape, 0), _ranges(shape, 1))]
    solids = [shapely.box(box.x_from_m, box.y_from_m, box.x_to_m, box.y_to_m) for box in boxes]
    is_within = shapely.covers(solid(shape), solids)
    within = [box for box, is_inside in zip(boxes, is_within, strict=True) if is_inside]
    return max((best, *within), key=lambda box: box.area_m2)


def _ranges(shape: Polygon, axis: int) -> list[tuple[float, float]]:
    """Return the ranges between coordinates of vertices; of many vertices, of some."""
    values = sorted({point[axis] for point in shape.points})
    some = values[:: math.ceil(len(values) / _MOST_COORDINATES)]
    return list(combinations(some, 2))


def between(a: Shape, b: Shape) -> Shape | None:
    """Return the area between shapes along facing sides, or common to both; None for corners."""
    if isinstance(a, Rectangle) and isinstance(b, Rectangle):
        x = _span((a.x_from_m, a.x_to_m), (b.x_from_m, b.x_to_m))
        y = _span((a.y_from_m, a.y_to_m), (b.y_from_m, b.y_to_m))
        return Rectangle(*x, *y)
    common = _parts(solid(a).intersection(solid(b)))
    if common:
        largest = max(common, key=lambda part: part.area)
        return Polygon(ring([(x, y) for x, y in largest.exterior.coords]))
    long, start, end = _facing_sides(a, b)
    if long <= NEAR_M or math.dist(start, end) <= NEAR_M:
        return None
    share = 0.5 * long / math.dist(start, end)
    dx, dy = -share * (end[1] - start[1]), share * (end[0] - start[0])
    before, after = ([(x + k * dx, y + k * dy) for x, y in (start, end)] for k in (-1, 1))
    return Polygon(ring([*before, *after[::-1]]))


def _span(a: tuple[float, float], b: tuple[float, float]) -> tuple[float, float]:
    """Return the range between two ranges, or their overlap."""
    inner = sorted((max(a[0], b[0]), min(a[1], b[1])))
    return inner[0], inner[1]


@lru_cache(maxsize=4096)
def solid(shape: Shape) -> Any:
    """Return a shape as the library knows it; a line where it has no width."""
    import shapely

    # A rectangle of no width has each corner twice, and shapely refuses a polygon of two points.
    points = tuple(dict.fromkeys(shape.points))
    return shapely.Polygon(points) if len(points) > 2 else shapely.LineString(points)


class Placed(Frozen):
    """An item with a location in roof plan: by the four sides of a rectangle, or by an outline."""

    outline_m: Annotated[tuple[Point, ...], Field(exclude=True)] = ()
    """Vertices of an outline in place of the rectangle: rows of another table."""

    def outlined(self, points: tuple[Point, ...]) -> Self:
        """Return the same with an outline [m] in place of a rectangle; empty for none."""
        return self.model_copy(update={"outline_m": points})

    @property
    def placed(self) -> Shape | None:
        """Its shape in roof plan, if given."""
        if self.outline_m:
            return Polygon(self.outline_m)
        sides = _sides_of(self)
        return None if None in sides else Rectangle(*sides)


# Fields of a rectangle in roof plan.
SIDES = ("x_from_m", "x_to_m", "y_from_m", "y_to_m")
_sides_of = attrgetter(*SIDES)
