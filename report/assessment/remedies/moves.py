"""Moves of an array along an axis of the plan that widen a gap, or the gap alone.

If a clearance lacks 0.53 m, move the array 0.53 m away along one axis of the plan, if there is
room, or provide 0.53 m more if it has no location on the plan.

Assesses nothing: `report.assessment.remedies.remedy` does. Read `moves`.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping
from functools import partial
from operator import itemgetter

from report.assessment.assessment import Assessment
from report.assessment.design.clearances import ClearanceCheck
from report.assessment.design.separation import ComparedGap
from report.assessment.plan.bare_edges import compass
from report.assessment.plan.neighbors import PlanNeighbor
from report.project.model import ProjectInput
from report.project.model.roof import Clearance
from report.project.model.shapes import SIDES, Point, Polygon, Rectangle, Shape, gap_m
from report.text.units import Quantity, no_less, pair, round_up

_NOISE_M = 1e-8  # a length that is rounded up is no less than what it is rounded from
_NORTH_UP_DEG = 90.0  # counterclockwise from +x
_MOST_TRIES = 10  # of the length of a move: more only where it goes past the other shape

Change = Callable[[ProjectInput], ProjectInput]


def moves(assessment: Assessment, gap: ComparedGap, lack_m: float) -> Iterator[tuple[str, Change]]:
    """Yield ways to widen a gap by the deficit [m], as text and as a change; shortest first."""
    data = assessment.project
    unit = Quantity.SIZE.us if data.us_first else Quantity.SIZE.si
    lack_m = round_up(lack_m / unit.si, unit.decimals) * unit.si
    shapes = data.shapes
    if isinstance(gap, PlanNeighbor):  # a bare edge is no object
        shapes[gap.other] = gap.far
    if isinstance(gap, ClearanceCheck) and not shapes.keys() >= set(gap.between):
        # Not in plan: the clearance alone is entered.
        number = next(k for k, clearance in enumerate(assessment.clearances) if clearance is gap)
        length = pair(lack_m, Quantity.SIZE, data.us_first, no_less)
        words = f"Provide {length} more from {' to '.join(gap.between)}"
        yield words, partial(_widened, number=number, by_m=lack_m + _NOISE_M)
        return
    ids = [array.id for array in data.arrays]
    for length_m, name, (dx, dy) in sorted(_ways(shapes, gap.between, lack_m), key=itemgetter(0)):
        by = (dx * length_m, dy * length_m)
        # Most are refused by a neighbor in plan: only the others are worth an assessment.
        if name in ids and _has_room(assessment, name, shifted(shapes[name], by)):
            length = pair(length_m - _NOISE_M, Quantity.SIZE, data.us_first, no_less)
            words = f"Move {name} {length} {_toward(dx, dy, data.roof.north_deg)}"
            yield words, partial(_moved, name=name, by=by)


def _toward(dx: float, dy: float, north_deg: float) -> str:
    """Return a direction along an axis of the plan as text, by the compass if north is up."""
    if north_deg == _NORTH_UP_DEG:
        return compass(math.degrees(math.atan2(dy, dx)), north_deg)
    axis, along = ("x", dx) if dx else ("y", dy)
    return f"toward {'−' if along < 0.0 else '+'}{axis} of the plan"


def _has_room(assessment: Assessment, name: str, moved: Shape) -> bool:
    """Whether no pair of the plan comes nearer than is required, as far as that is known."""
    near = (pair for pair in assessment.pairs if pair.involves(name))
    neighbors = ((pair, pair.far if pair.array == name else pair.near) for pair in near)
    return not any(
        gap_m(moved, shape) < min(pair.required_m, pair.gap_m) - _NOISE_M
        for pair, shape in neighbors
    )


def _ways(
    shapes: Mapping[str, Shape], between: tuple[str, str], lack_m: float
) -> Iterator[tuple[float, str, Point]]:
    """Yield the length of each move along an axis of the plan that provides the deficit [m]."""
    for moving, fixed in (between, between[::-1]):
        for way in ((1.0, 0.0), (0.0, 1.0), (-1.0, 0.0), (0.0, -1.0)):
            length_m = _length_m(shapes[moving], shapes[fixed], way, lack_m)
            if not math.isnan(length_m):
                yield length_m, moving, way


def _length_m(near: Shape, far: Shape, way: Point, lack_m: float) -> float:
    """Return the move of a shape for a given increase of distance [m]; NaN if it comes closer."""
    wanted_m, length_m = gap_m(near, far) + lack_m, lack_m
    # Across a corner the distance grows by less than the move.
    for _ in range(_MOST_TRIES):
        still_m = wanted_m - gap_m(shifted(near, (way[0] * length_m, way[1] * length_m)), far)
        if still_m <= _NOISE_M:
            return length_m + _NOISE_M
        # It has come nearer: on its way it passes the other shape, or moves toward it.
        if still_m > lack_m + _NOISE_M:
            break
        length_m += still_m
    return math.nan


def shifted(shape: Shape, by: Point) -> Shape:
    """Return a shape moved in plan [m]."""
    dx, dy = by
    if isinstance(shape, Polygon):
        return Polygon(tuple((x + dx, y + dy) for x, y in shape.points))
    x0, x1, y0, y1 = shape.x_from_m, shape.x_to_m, shape.y_from_m, shape.y_to_m
    return Rectangle(x0 + dx, x1 + dx, y0 + dy, y1 + dy)


def _widened(data: ProjectInput, *, number: int, by_m: float) -> ProjectInput:
    """Return an input with one clearance larger."""
    rows = list(data.clearances)
    provided_m = rows[number].provided_m + by_m
    rows[number] = rows[number].model_copy(update={"provided_m": provided_m})
    return data.changed(clearances=tuple(rows))


def _moved(data: ProjectInput, *, name: str, by: Point) -> ProjectInput:
    """Return an input with an array moved and its clearances updated from the plan."""
    shapes = data.shapes
    before, after = shapes[name], shifted(shapes[name], by)

    def provided(row: Clearance) -> Clearance:
        opposite = row.object if row.array == name else row.array
        if name not in (row.array, row.object) or opposite not in shapes:
            return row
        # By as much as the gap of the plan changes: what is entered may differ from the plan.
        change_m = gap_m(after, shapes[opposite]) - gap_m(before, shapes[opposite])
        return row.model_copy(update={"provided_m": row.provided_m + change_m})

    # A polygon is moved by its outline below.
    sides = {side: getattr(after, side) for side in SIDES} if isinstance(after, Rectangle) else {}
    return data.changed(
        arrays=tuple(
            row.model_copy(update=sides) if row.id == name else row for row in data.arrays
        ),
        outlines=tuple(
            row.model_copy(update={"x_m": row.x_m + by[0], "y_m": row.y_m + by[1]})
            if row.name == name
            else row
            for row in data.outlines
        ),
        clearances=tuple(map(provided, data.clearances)),
    )
