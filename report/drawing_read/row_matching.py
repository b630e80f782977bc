"""Matches each outline of a drawing with a row of a workbook: by name, else by location.

An outline without a name that covers most of the previous location of A2 is A2.

Reads no drawing and changes no cell (`report.drawing_read.fill`). Read `matched` first.
"""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import replace
from itertools import product

import shapely

from report.drawing_read.moved import SAME_M, Move, whole_move
from report.drawing_read.plan_as_drawn import STILL_M, RoofPlan, placed
from report.drawing_read.plan_read import free_name
from report.drawing_read.roof_drawing import DrawnOutline
from report.project.check.finding_lines import listed
from report.project.check.plan_shapes import roof_of, shapes_of, us_first
from report.project.model.choices import LayerKind
from report.project.model.input_rows import InputRow, Inputs
from report.project.model.roof import DRAWING
from report.project.model.shapes import Shape, around, gap_m, mean, sides, solid
from report.text.units import Quantity, Unit
from solver.errors import InputError

# Common share of two outlines, of all that either covers, by which they may be the same.
_LEAST_SHARE = 0.05
_RENAMED_SHARE = 0.9  # the same, of an outline that the drawing calls by a name of its own
_PLAIN = 2.0  # a row is told from another by this times its share, or its part of the distance
_SAME_WAY = 0.9  # cosine between the outward directions of two edges of the same side
# Most outlines of a kind that cannot be told and are named.
MOST_TOLD = 20
_ARRAY, _OBJECT, _EDGE = "array", "object", "edge"

Pairs = Mapping[tuple[int, str], float]  # how well an outline, by its number, is a row


def matched(plan: RoofPlan, inputs: Inputs) -> RoofPlan:
    """Return a plan with the names of the rows of a workbook.

    Raises `InputError` with the candidates of each ambiguous outline.
    """
    known = [*inputs["arrays"], *inputs["objects"]]
    rows = {row["id"]: row for row in known if "id" in row}
    groups = {row["id"]: _group(row.get("kind", "")) for row in inputs["objects"] if "id" in row}
    was, roof = shapes_of(inputs), roof_of(inputs)
    unit = Quantity.PLAN.us if us_first(inputs) else Quantity.PLAN.si
    drawn = (*plan.arrays, *plan.objects)
    # An outline with the name of a row in the drawing is that row. The others are told by place
    # among the rows that remain: by what they have in common, then by the nearest center of the
    # same size. What remains is new.
    by_row = _by_name(drawn, was, groups)
    move = _move_of_plan(plan, roof, was, groups, by_row)
    moved = move or Move()
    before = {name: moved.of(shape) for name, shape in was.items()}
    same_side = _same_side(plan, moved.of(roof) if roof else None, before, groups)
    unclear: list[str] = []
    for group in (_ARRAY, _OBJECT, _EDGE):
        numbers = [k for k, place in enumerate(drawn) if _group(place.kind) == group]
        names = [name for name in before if groups.get(name, _ARRAY) == group]
        # By what they cover together first: a center alone may be nearer to a neighbor.
        for score in (_common, _near if group == _EDGE else _same_sized) if move else ():
            pairs = {
                (k, name): value
                for k, name in product(numbers, names)
                if k not in by_row and name not in by_row.values() and same_side(k, name)
                if (value := score(drawn[k], before[name])) > 0.0
            }
            unclear += _tell(pairs, drawn, by_row, unit)
        unmatched_rows = [n for n in names if n not in by_row.values() and _is_drawn(rows[n])]
        unmatched = [k for k in numbers if k not in by_row and drawn[k].unnamed and drawn[k].handle]
        if unmatched_rows and unmatched and not unclear:
            candidates = _either([drawn[k] for k in unmatched], unmatched_rows, unit)
            unclear.append(f"{candidates}, or new")
    if unclear:
        raise InputError([f"{text}: write its name inside it as a text" for text in unclear])
    # Read after all groups: a row may still be found by its size.
    lost = [name for name in before if name not in by_row.values()]
    return replace(
        _renamed(plan, by_row, before, rows),
        gone=tuple(name for name in lost if _is_drawn(rows[name])),
        typed=tuple(name for name in lost if not _is_drawn(rows[name])),
        move=move,
        before=before,
        rows=rows,
        row_shapes=was,
        unit=unit,
    )


def _by_name(
    drawn: Sequence[DrawnOutline], was: Mapping[str, Shape], groups: Mapping[str, str]
) -> dict[int, str]:
    """Return the rows of the outlines that the drawing names, by the number of the outline."""
    names = {(groups.get(name, _ARRAY), name.casefold()): name for name in was}
    keys = {k: (_group(line.kind), line.name.casefold()) for k, line in enumerate(drawn)}
    return {k: names[key] for k, key in keys.items() if key in names and not drawn[k].unnamed}


def _move_of_plan(
    plan: RoofPlan,
    roof: Shape | None,
    was: Mapping[str, Shape],
    groups: Mapping[str, str],
    by_row: Mapping[int, str],
) -> Move | None:
    """Return the movement of the plan as a whole; None if it cannot be determined."""
    drawn = (*plan.arrays, *plan.objects)
    # Of a row whose name is not in the drawing only its group is known. Edges follow the roof.
    keyed = [
        (name if name in by_row.values() else groups.get(name, _ARRAY), shape)
        for name, shape in was.items()
        if groups.get(name) != _EDGE
    ]
    drawn_keyed = [(by_row.get(k, _group(line.kind)), line.shape) for k, line in enumerate(drawn)]
    named = [(was[name], drawn[number].shape) for number, name in by_row.items()]
    return whole_move((roof, plan.roof_shape), keyed, drawn_keyed, named)


def _same_side(
    plan: RoofPlan,
    roof_before: Shape | None,
    before: Mapping[str, Shape],
    groups: Mapping[str, str],
) -> Callable[[int, str], bool]:
    """Return what tells whether an outline, by its number, may be a row: an edge keeps its side."""
    # The side of the roof, or of all that is in plan where no roof is.
    rows = {
        name: _outward(shape, roof_before or around(before.values()))
        for name, shape in before.items()
        if groups.get(name) == _EDGE
    }
    drawn = {
        number: _outward(place.shape, plan.roof_shape or around(plan.shapes.values()))
        for number, place in enumerate((*plan.arrays, *plan.objects))
        if _group(place.kind) == _EDGE
    }

    def may_be(number: int, name: str) -> bool:
        # The product of one direction and the conjugate of the other has the cosine between them
        # as its real part.
        return number not in drawn or (rows[name] * drawn[number].conjugate()).real > _SAME_WAY

    return may_be


def _outward(edge: Shape, roof: Shape) -> complex:
    """Return the direction across an edge, as a number of length 1, that leads away from a roof."""
    start, end = max(sides(edge.points), key=lambda side: math.dist(*side))
    across = complex(end[1] - start[1], start[0] - end[0]) / math.dist(start, end)
    middle = complex(*mean(edge.bounds.points))
    far, near = (
        solid(roof).distance(shapely.Point(point.real, point.imag))
        for point in (middle + across, middle - across)
    )
    return across if far >= near else -across


def _group(kind: str) -> str:
    return _ARRAY if kind == LayerKind.ARRAY else _EDGE if kind.startswith("edge") else _OBJECT


def _is_drawn(row: InputRow) -> bool:
    return str(row.get("place_from", "")).startswith(DRAWING)


def _common(place: DrawnOutline, row: Shape) -> float:
    """Return the share that an outline has in common with a row; 0 if too small to be it."""
    if gap_m(place.shape.bounds, row.bounds) >= 0.0:
        return 0.0
    area, row_area = solid(place.shape), solid(row)
    share: float = area.intersection(row_area).area / area.union(row_area).area
    return share if share >= (_LEAST_SHARE if place.unnamed else _RENAMED_SHARE) else 0.0


def _near(place: DrawnOutline, row: Shape) -> float:
    """Return the closeness of the center of an outline without a name to that of a row [1/m]."""
    far_m = math.dist(mean(place.shape.bounds.points), mean(row.bounds.points))
    return 1.0 / max(far_m, STILL_M) if place.unnamed else 0.0


def _same_sized(place: DrawnOutline, row: Shape) -> float:
    """Return the same of an outline of the same size; 0 for another."""
    sizes = ((b.x_to_m - b.x_from_m, b.y_to_m - b.y_from_m)
             for b in (place.shape.bounds, row.bounds))  # fmt: skip
    is_same = all(abs(a - b) < SAME_M for a, b in zip(*sizes, strict=True))
    return _near(place, row) if is_same else 0.0


def _tell(
    pairs: Pairs, drawn: Sequence[DrawnOutline], matches: dict[int, str], unit: Unit
) -> Iterator[str]:
    """Add the unambiguous rows, the best first, and yield the others, as far as determined."""
    count = 0
    while pairs and count < MOST_TOLD:
        number, name = best = max(pairs, key=pairs.__getitem__)
        rivals = [
            (k, row)
            for (k, row), value in pairs.items()
            if (k == number) != (row == name) and value * _PLAIN > pairs[best]
        ]
        # A side of the roof that cannot be told is new: its name cannot be drawn.
        if not rivals or drawn[number].handle:
            matches[number] = name
        if rivals and drawn[number].handle:
            count += 1
            numbers, names = ({*choice} for choice in zip(best, *rivals, strict=True))
            yield _either([drawn[k] for k in sorted(numbers)], sorted(names), unit)
        pairs = {p: value for p, value in pairs.items() if p[0] != number and p[1] != name}


def _either(places: Sequence[DrawnOutline], names: Sequence[str], unit: Unit) -> str:
    outlines = (f"{place.handle or place.kind.value} ({placed(place.shape, unit)})"
             for place in places)  # fmt: skip
    return f"{listed(outlines)} may be {listed(names).replace(', ', ' or ')}"


def _renamed(
    plan: RoofPlan,
    matches: Mapping[int, str],
    before: Mapping[str, Shape],
    rows: Mapping[str, InputRow],
) -> RoofPlan:
    drawn = (*plan.arrays, *plan.objects)
    taken = {name.casefold() for name in before}
    taken |= {place.name.casefold() for place in drawn if not place.unnamed}
    counts: Counter[LayerKind] = Counter()
    named = []
    for number, place in enumerate(drawn):
        if number not in matches:
            name = free_name(place.kind, counts, taken) if place.unnamed else place.name
            named.append(replace(place, name=name))
            continue
        name = matches[number]
        is_written = not place.unnamed and place.name.casefold() == name.casefold()
        origin = f"'{place.name}' in the drawing" if not place.unnamed else "by its place"
        place = replace(place, name=name, unnamed="" if is_written else origin)
        # A side of the roof has no parapet unless the row says so.
        is_assumed = not place.handle and "kind" in rows[name]
        kind = LayerKind(rows[name]["kind"].value) if is_assumed else place.kind
        named.append(replace(place, kind=kind, note="" if is_assumed else place.note))
    count = len(plan.arrays)
    return replace(plan, arrays=tuple(named[:count]), objects=tuple(named[count:]))
