"""Where the plan has room for more separation: an array moved along an axis of the plan.

Read `moves`.
"""

from __future__ import annotations

import math
from collections.abc import Iterator

from report.assessment.assess import changed, entered
from report.assessment.clearances import ClearanceCheck
from report.assessment.neighbors import compass
from report.assessment.plan_gaps import shapes_of
from report.assessment.project import Assessment
from report.sheet.schema import ProjectInput
from report.sheet.schema.scene import SIDES, Array, Clearance
from report.sheet.schema.shapes import Point, Polygon, Rectangle, Shape, gap_m
from report.words.units import Quantity, no_less, pair, round_up

_NOISE_M = 1e-8  # a length that is rounded up is no less than what it is rounded from
_MOST_TRIES = 10  # of the length of a move: more only where it goes past the other shape


def moves(given: Assessment, number: int, gap: ClearanceCheck) -> tuple[Assessment | None, str]:
    """Return the project with a clearance as required, and how; or none, and why not.

    The shortest move of an array beside it with which nothing else becomes NG. Where the plan does
    not show both, the clearance alone is entered.
    """
    row, data = gap.clearance, given.project
    unit = Quantity.SIZE.us if data.us_first else Quantity.SIZE.si
    lack_m = round_up((gap.required_m - row.provided_m) / unit.si, unit.decimals) * unit.si
    more = pair(lack_m, Quantity.SIZE, data.us_first, no_less)
    shapes = shapes_of(given)
    if row.object not in shapes:
        rows = list(data.clearances)
        rows[number - 1] = row.model_copy(update={"provided_m": row.provided_m + lack_m + _NOISE_M})
        return entered(given, changed(data, clearances=tuple(rows))), f"{more} more"
    before, ways = _failed(given), sorted(_ways(data, shapes, row, lack_m), key=lambda way: way[0])
    for length_m, array, (dx, dy) in ways:
        by = (dx * length_m, dy * length_m)
        # Most are refused by a neighbor in plan: only the others are assessed.
        if not _has_room(given, array, shifted(shapes[array.id], by)):
            continue
        done = entered(given, _moved(data, shapes, array, by))
        if done is not None and done.clearances[number - 1].ok and _failed(done) <= before:
            toward = compass(math.degrees(math.atan2(dy, dx)), data.roof.north_deg)
            length = pair(length_m - _NOISE_M, Quantity.SIZE, data.us_first, no_less)
            return done, f"{array.id} moved {length} {toward}"
    return None, (
        f"{more} more is needed, and no move of one array along an axis of the plan gives it and "
        "leaves all else sufficient"
    )


def _has_room(given: Assessment, array: Array, moved: Shape) -> bool:
    """Whether no pair of the plan comes nearer than is required, as far as that is known."""
    near = (pair for pair in given.pairs if pair.involves(array.id))
    others = ((pair, pair.far if pair.array == array.id else pair.near) for pair in near)
    return not any(
        gap_m(moved, other) < min(pair.required_m, pair.gap_m) - _NOISE_M for pair, other in others
    )


def _ways(
    data: ProjectInput, shapes: dict[str, Shape], row: Clearance, lack_m: float
) -> Iterator[tuple[float, Array, Point]]:
    """Yield the length of each move along an axis of the plan that gives what lacks [m]."""
    sides = ((row.array, row.object), (row.object, row.array))
    for own, other in sides:
        for array in (each for each in data.arrays if each.id == own):
            for way in ((1.0, 0.0), (0.0, 1.0), (-1.0, 0.0), (0.0, -1.0)):
                length_m = _length_m(shapes[own], shapes[other], way, lack_m)
                if not math.isnan(length_m):
                    yield length_m, array, way


def _length_m(near: Shape, far: Shape, way: Point, lack_m: float) -> float:
    """Return how far a shape is to move for so much more distance [m]; NaN if it comes nearer."""
    wanted_m, length_m = gap_m(near, far) + lack_m, lack_m
    for _ in range(_MOST_TRIES):
        still_m = wanted_m - gap_m(shifted(near, (way[0] * length_m, way[1] * length_m)), far)
        if still_m <= _NOISE_M:
            return length_m + _NOISE_M
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


def _moved(data: ProjectInput, shapes: dict[str, Shape], array: Array, by: Point) -> ProjectInput:
    """Return an input with an array moved, and its clearances as the plan then shows them."""
    old, new = shapes[array.id], shifted(shapes[array.id], by)

    def provided(row: Clearance) -> Clearance:
        other = row.object if row.array == array.id else row.array
        if array.id not in (row.array, row.object) or other not in shapes:
            return row
        change_m = gap_m(new, shapes[other]) - gap_m(old, shapes[other])
        return row.model_copy(update={"provided_m": row.provided_m + change_m})

    sides = {name: getattr(new, name) for name in SIDES} if isinstance(new, Rectangle) else {}
    return changed(
        data,
        arrays=tuple(
            row.model_copy(update=sides) if row.id == array.id else row for row in data.arrays
        ),
        outlines=tuple(
            row.model_copy(update={"x_m": row.x_m + by[0], "y_m": row.y_m + by[1]})
            if row.name == array.id
            else row
            for row in data.outlines
        ),
        clearances=tuple(map(provided, data.clearances)),
    )


def _failed(given: Assessment) -> set[tuple[str, ...]]:
    """Return what is NG: clearances, pairs of the plan without one, requirements."""
    gaps = (*(gap for gap in given.clearances if not gap.ok), *given.missing_gaps)
    rows = (row for row in given.rows if not row.verdict.is_permitted)
    return {*(gap.between for gap in gaps), *((row.id, row.subject, row.title) for row in rows)}
