"""Faults of the roof plan: outlines, items off the roof or overlapping, wrong clearances."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from itertools import islice

from report.project.check.plan_shapes import (
    LEAST_VERTICES,
    MOST_OVERLAPS,
    PLACED,
    OutlineRows,
    outlines_of,
    places_of,
    rows_in,
    shape_of,
    shapes_of,
    us_first,
)
from report.project.model.choices import ObjectKind
from report.project.model.finding import Finding
from report.project.model.input_rows import InputRow, Inputs, Place, Where, repeated, suggestion
from report.project.model.roof import ROOF
from report.project.model.shapes import (
    NEAR_M,
    SIDES,
    Point,
    Rectangle,
    Shape,
    crossing,
    gap_m,
    outside,
    ring,
)
from report.text.units import Quantity, no_more, pair
from solver.model import INCH_M

# Fields of which the second is larger, where a table has them.
ORDERED = (("x_from_m", "x_to_m"), ("y_from_m", "y_to_m"))

_EDGES = (ObjectKind.EDGE_WITH_PARAPET, ObjectKind.EDGE_WITHOUT_PARAPET)


def plan_faults(inputs: Inputs, where: Where) -> Iterator[Finding]:
    """Yield the faults of the shapes in plan."""
    yield from _rectangles(inputs, where)
    yield from _outline_rows(inputs, where)
    yield from _doubled(inputs, where)
    yield from _on_the_roof(inputs, where)
    yield from islice(_overlaps(inputs, where), MOST_OVERLAPS)


def _rectangles(inputs: Inputs, where: Where) -> Iterator[Finding]:
    for place, row in rows_in(inputs, ("roof", *PLACED)):
        for first, last in ORDERED:
            low, high = row.get(first), row.get(last)
            if low is None or high is None or low < high:
                continue
            high_text, low_text = (
                pair(value, Quantity.PLAN, us_first(inputs)) for value in (high, low)
            )
            address = where(place._replace(field=first))
            remedy = f"enter more than {_label(first)} in {address}, {low_text}"
            fault = f"{_label(last)} is {high_text}"
            yield Finding.error(place._replace(field=last), fault, remedy)


def _label(side: str) -> str:
    return side.removesuffix("_m").replace("_", " ")


def _outline_rows(inputs: Inputs, where: Where) -> Iterator[Finding]:
    ids = [row["id"] for _, row in rows_in(inputs) if "id" in row]
    for outline in outlines_of(inputs).values():
        if outline.name not in (ROOF, *ids):
            text = f"outline of '{outline.name}', which is not in Arrays or Objects"
            yield Finding.error(outline.place, text, suggestion(outline.name, [*ids, ROOF]))
        if outline.name == ROOF and ROOF in map(str.casefold, ids):
            text = "outline of 'roof', which is also the ID of an array or object"
            yield Finding.error(outline.place, text, "enter another ID for it")
        yield from _ring_faults(outline, us_first(inputs))
    yield from _scattered(inputs, where)


def _ring_faults(outline: OutlineRows, is_us: bool) -> Iterator[Finding]:
    if not outline.vertices:
        return
    points = ring(outline.vertices)
    # A vertex that is given again is no other corner.
    count = len(set(points))
    if count < LEAST_VERTICES:
        text = f"{outline.name} has {count} {'vertex' if count == 1 else 'vertices'}"
        yield Finding.error(outline.place, text, f"enter at least {LEAST_VERTICES}, one per row")
        return
    point = crossing(points)
    if point is not None:
        text = f"outline of {outline.name} touches or crosses itself near {spot(point, is_us)}"
        yield Finding.error(outline.place, text, "enter its vertices in order, each only once")


def spot(point: Point, is_us: bool) -> str:
    """Return a point of the plan as text."""
    x, y = (pair(value, Quantity.PLAN, is_us) for value in point)
    return f"x {x}, y {y}"


def _scattered(inputs: Inputs, where: Where) -> Iterator[Finding]:
    """Yield the rows at which an outline continues after rows of another one."""
    last: dict[str, int] = {}
    for index, row in enumerate(inputs["outlines"]):
        name = row.get("name")
        if name is None:
            continue
        # Rows of one outline that were moved apart would join in another order, to a ring that may
        # be valid and wrong.
        before = last.get(name.casefold(), index - 1)
        if before != index - 1:
            address = where(Place("outlines", before, "name"))
            text = f"the outline of '{name}' continues here after {address}"
            remedy = "keep all its rows together"
            yield Finding.error(Place("outlines", index, "name"), text, remedy)
        last[name.casefold()] = index


def _doubled(inputs: Inputs, where: Where) -> Iterator[Finding]:
    outlines = outlines_of(inputs)
    for place, row in rows_in(inputs, (*PLACED, "roof")):
        name = ROOF if place.section == "roof" else row.get("id", "")
        side = next((side for side in SIDES if row.get(side) is not None), None)
        if name in outlines and side is not None:
            address = where(outlines[name].place)
            text = f"{_label(side)} is entered, and {name} has an outline at {address}"
            remedy = "leave the four sides blank, or delete the outline"
            yield Finding.error(place._replace(field=side), text, remedy)


def _on_the_roof(inputs: Inputs, where: Where) -> Iterator[Finding]:
    outlines = outlines_of(inputs)
    for row in inputs["roof"]:
        roof = shape_of(row, outlines.get(ROOF))
        if roof is None:
            continue
        roof_place = outlines[ROOF].place if ROOF in outlines else Place("roof", 0, "x_from_m")
        for index, array in enumerate(inputs["arrays"]):
            outline = outlines.get(array.get("id", ""))
            # Of two rectangles each side is a cell of its own, and is told there.
            if isinstance(roof, Rectangle) and outline is None:
                yield from _beyond(roof, index, array, inputs, where)
                continue
            shape = shape_of(array, outline)
            beyond = outside(shape, roof) if shape is not None else None
            if beyond is not None:
                text = (
                    f"{array.get('id')} is outside the roof near {spot(beyond, us_first(inputs))}"
                )
                place = Place("arrays", index, "x_from_m") if outline is None else outline.place
                remedy = f"correct it, or the outline of the roof at {where(roof_place)}"
                yield Finding.error(place, text, remedy)


def _beyond(
    roof: Rectangle, index: int, array: InputRow, inputs: Inputs, where: Where
) -> Iterator[Finding]:
    for side in SIDES:
        value, edge, is_low = array.get(side), getattr(roof, side), "from" in side
        if value is None or (value >= edge if is_low else value <= edge):
            continue
        entered, limit = (pair(m, Quantity.PLAN, us_first(inputs)) for m in (value, edge))
        inside, address = "more" if is_low else "less", where(Place("roof", 0, side))
        text = f"{_label(side)} is {entered}, outside the roof"
        remedy = f"enter {limit} or {inside}, or correct the outline at {address}"
        yield Finding.error(Place("arrays", index, side), text, remedy)


@dataclass(frozen=True, slots=True)
class _Body:
    """An array, or an object that no array can overlap, in plan."""

    place: Place
    name: str
    is_array: bool
    shape: Shape
    bounds: Rectangle


def _overlaps(inputs: Inputs, where: Where) -> Iterator[Finding]:
    """Yield arrays that overlap each other or an object; `checks` has those with a clearance."""
    cleared = {frozenset((row.get("array"), row.get("object"))) for row in inputs["clearances"]}
    bodies = sorted(_bodies(inputs), key=lambda body: body.bounds.x_from_m)
    for count, body in enumerate(bodies):
        for neighbor in bodies[count + 1 :]:
            # They are sorted from the left: none of the following reaches back either.
            if neighbor.bounds.x_from_m >= body.bounds.x_to_m:
                break
            first, second = sorted(
                (body, neighbor), key=lambda item: (not item.is_array, item.place)
            )
            # Two objects may overlap, as a pipe over a curb does: nothing is required between
            # them.
            if not first.is_array or frozenset((body.name, neighbor.name)) in cleared:
                continue
            # Boxes first: shapes that are no rectangles are measured by a library.
            if (
                gap_m(body.bounds, neighbor.bounds) < 0.0
                and gap_m(body.shape, neighbor.shape) < -NEAR_M
            ):
                text = f"{first.name} and {second.name} at {where(second.place)} overlap in plan"
                yield Finding.error(first.place, text, "correct one of them")


def _bodies(inputs: Inputs) -> Iterator[_Body]:
    """Yield the arrays and objects that have a shape, without edges: an array may reach them."""
    outlines = outlines_of(inputs)
    for place, row in rows_in(inputs):
        outline = outlines.get(row.get("id", ""))
        shape = shape_of(row, outline) if "id" in row else None
        if shape is not None and row.get("kind") not in _EDGES:
            shape_place = place._replace(field="x_from_m") if outline is None else outline.place
            yield _Body(shape_place, row["id"], place.section == "arrays", shape, shape.bounds)


GAP_TOLERANCE = 0.01
# Below the inch at which a package states that a clearance contradicts the plan
# (`report.assessment.plan.neighbors`): what passes here passes there.
GAP_TOLERANCES_M = (0.5 * INCH_M, 0.99 * INCH_M)


def gap_tolerance_m(gap_m: float) -> float:
    """Return the permitted difference of a clearance from the gap on the plan [m]."""
    low, high = GAP_TOLERANCES_M
    return min(max(GAP_TOLERANCE * gap_m, low), high)


def clearance_faults(inputs: Inputs, where: Where) -> Iterator[Finding]:
    """Yield clearances that are listed twice, to the array itself, or larger than on the plan."""
    fields = ("array", "object", "direction")
    rows = enumerate(inputs["clearances"])
    named = ((Place("clearances", i, "array"), tuple(map(row.get, fields))) for i, row in rows)
    for place, (array, *_), first in repeated(cell for cell in named if None not in cell[1]):
        text = f"array is '{array}', with the same object and direction as at {where(first)}"
        yield Finding.error(place, text, "delete one")
    shapes = shapes_of(inputs)
    for index, row in enumerate(inputs["clearances"]):
        yield from _room(index, row, shapes, inputs, where)


def _room(
    index: int, row: InputRow, shapes: Mapping[str, Shape], inputs: Inputs, where: Where
) -> Iterator[Finding]:
    array, neighbor, provided = row.get("array"), row.get("object"), row.get("provided_m")
    if array is not None and array == neighbor:
        text = f"object is '{neighbor}', the array itself"
        remedy = "enter an object or another array"
        yield Finding.error(Place("clearances", index, "object"), text, remedy)
        return
    a, b = (shapes.get(str(name)) for name in (array, neighbor))
    if a is None or b is None or provided is None:
        return
    gap, place = gap_m(a, b), Place("clearances", index, "provided_m")
    # Shapes that touch are apart by rounding error, of either sign.
    # Less than the plan shows is safe, and a question of `report.project.check.plausible`; more is
    # not.
    if gap >= -1e-9 and provided <= gap + gap_tolerance_m(gap):
        return
    boxes = isinstance(a, Rectangle) and isinstance(b, Rectangle)
    noun = "rectangles" if boxes else "outlines"
    stated, gap_text = (
        pair(max(m, 0.0), Quantity.SIZE, us_first(inputs), no_more) for m in (provided, gap)
    )
    cells, text = (
        places_of(inputs, (str(array), str(neighbor)), where),
        f"provided clearance is {stated}",
    )
    if gap < -1e-9:
        text += f", but {array} and {neighbor} overlap in plan"
        yield Finding.error(place, text, f"correct their {noun} in {cells}")
    else:
        text += f", but {array} and {neighbor} are {gap_text} apart on the plan"
        yield Finding.error(place, text, f"reduce it, or correct the {noun} in {cells}")
