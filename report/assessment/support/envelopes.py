"""Envelopes of an array in plan: of its design displacement, and of its runs.

A rectangle of 10 by 5 m that may slide 0.5 m in any direction needs 11 by 6 m, with rounded
corners.

Geometry only; checks nothing. Points are in plan [m], counterclockwise.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from itertools import chain, product

from report.assessment.design.arrays import ArrayAssessment
from report.project.model.choices import Direction
from report.project.model.shapes import Point, Polygon, Shape, merged, ring, sides
from report.runs import OrientedRun

Outline = tuple[Point, ...]

# Chords in a quarter of a circle. They are tangents, so that the envelope is never too small.
ARC_STEPS = 6


def design_envelope(array: ArrayAssessment) -> Outline:
    """Return the outline of an array moved in any direction; empty without a permitted value."""
    if math.isnan(array.permitted_m):
        return ()
    return _swept(array.array.shape, _circle(array.permitted_m))


def runs_envelope(array: ArrayAssessment) -> Outline:
    """Return the outline of an array in all of its runs; empty if one has no displacement."""
    moves = list(chain.from_iterable(map(_region, array.runs)))
    # Without one of the runs the outline would look complete, and be too small.
    if not moves or any(math.isnan(along + across) for along, across in moves):
        return ()
    downslope = math.radians(array.array.downslope_deg)
    cos, sin = math.cos(downslope), math.sin(downslope)
    turned = [(along * cos - across * sin, along * sin + across * cos) for along, across in moves]
    return _swept(array.array.shape, hull(turned))


def _region(run: OrientedRun) -> Outline:
    """Return a region (downslope, cross-slope) that contains the path of a run."""
    # A circle about the PRD, cut at the largest excursions.
    down, up, across, prd = (run.excursion_m(direction) for direction in Direction)
    region = _circle(prd)
    for x, y, limit in ((1, 0, down), (-1, 0, up), (0, 1, across), (0, -1, across)):
        region = _cut(region, (x, y), limit)
    return region


def _circle(radius_m: float) -> Outline:
    # Circumscribed: the envelope is never less than the circle.
    step = 0.5 * math.pi / ARC_STEPS
    reach = radius_m / math.cos(0.5 * step)
    angles = [(k + 0.5) * step for k in range(4 * ARC_STEPS)]
    return tuple((reach * math.cos(a), reach * math.sin(a)) for a in angles)


def _cut(region: Outline, normal: Point, limit: float) -> Outline:
    """Return the part of a convex region up to a limit along a normal."""
    inside: list[Point] = []
    for (x0, y0), (x1, y1) in zip(region, (*region[1:], *region[:1]), strict=True):
        over0 = x0 * normal[0] + y0 * normal[1] - limit
        over1 = x1 * normal[0] + y1 * normal[1] - limit
        # Clipping at one edge, as by Sutherland and Hodgman (1974).
        if not over0 > 0.0:
            inside.append((x0, y0))
        if over0 * over1 < 0.0:
            share = over0 / (over0 - over1)
            inside.append((x0 + share * (x1 - x0), y0 + share * (y1 - y0)))
    return tuple(inside)


def _swept(shape: Shape, moves: Sequence[Point]) -> Outline:
    """Return the outline of a shape at all displacements within a convex region about 0."""
    if not isinstance(shape, Polygon):
        return _moved(shape.points, moves)
    return merged([shape.points, *(_moved(side, moves) for side in sides(shape.points))])


def _moved(points: Sequence[Point], moves: Sequence[Point]) -> Outline:
    """Return the convex hull of points at all displacements."""
    return hull((x + dx, y + dy) for (x, y), (dx, dy) in product(points, moves))


def hull(points: Iterable[Point]) -> Outline:
    """Return the convex hull of points, from the leftmost one on."""
    import shapely  # 0.09 s to load: only where a plan is drawn

    corners = shapely.get_coordinates(shapely.convex_hull(shapely.linestrings(list(points))))
    around = ring([(x, y) for x, y in corners.tolist()])
    first = around.index(min(around))
    return (*around[first:], *around[:first])
