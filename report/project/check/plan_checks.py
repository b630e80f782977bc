"""Checks of required cells, and of the roof plan: rectangles, outlines, and what is on the roof.

Read `report.project.check.checks` first, which runs them.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass
from itertools import islice

from report.project.check.findings import suggestion
from report.project.model.choices import ObjectKind, RecordedAt, Scaling, UnitsFirst
from report.project.model.finding import Finding
from report.project.model.input_rows import InputRow, Inputs
from report.project.model.place import Place, Where
from report.project.model.scene import ROOF, SIDES, WEIGHT_PARTS
from report.project.model.shapes import (
    NEAR_M,
    Point,
    Polygon,
    Rectangle,
    Shape,
    crossing,
    gap_m,
    outside,
    ring,
)
from report.project.workbook import SECTION
from report.text.units import Quantity, pair

# Whether a condition holds for a row as read; not where a cell could not be read.
Condition = Callable[[InputRow, Inputs], bool]


def _filled(*fields: str) -> Condition:
    return lambda row, _: any(row.get(field) not in (None, "") for field in fields)


def _chosen(field: str, *choices: str) -> Condition:
    return lambda row, _: row.get(field) in choices


def _has_no_outline(row: InputRow, inputs: Inputs) -> bool:
    return "id" in row and all(vertex.get("name") != row["id"] for vertex in inputs["outlines"])


_OR_NONE = "give all four sides of the rectangle, or none"
_OR_OUTLINE = "give all four sides of the rectangle, or an outline on the sheet Outlines"
_LAW = "give high-velocity friction and friction rate, or neither"
_CODE = "give building code and year, or neither"
_BOTH = "give latitude and longitude, or neither"
_CONFIRMED = "give who confirmed the drawing distances and when, or neither"
_ALL_FIVE = "give all five cells of the confirmation, or none"
_CONFIRMATION = ("by", "date", "rule_set", "edition", "code")

# Optional cells that are required where others say so: when, and what would do.
REQUIRED: Mapping[tuple[str, str], tuple[Condition, str]] = {
    ("site", "building_code"): (_filled("building_code_year"), _CODE),
    ("site", "building_code_year"): (_filled("building_code"), _CODE),
    ("site", "latitude_deg"): (_filled("longitude_deg"), _BOTH),
    ("site", "longitude_deg"): (_filled("latitude_deg"), _BOTH),
    ("project", "drawing_confirmed_by"): (_filled("drawing_confirmed_date"), _CONFIRMED),
    ("project", "drawing_confirmed_date"): (_filled("drawing_confirmed_by"), _CONFIRMED),
    **{("confirmation", field): (_filled(*_CONFIRMATION), _ALL_FIVE) for field in _CONFIRMATION},
    **{("roof", side): (_filled(*SIDES), _OR_NONE) for side in SIDES},
    **{("arrays", side): (_has_no_outline, _OR_OUTLINE) for side in SIDES},
    **{("objects", side): (_filled(*SIDES), _OR_NONE) for side in SIDES},
    ("objects", "height_m"): (
        _chosen("kind", ObjectKind.EDGE_WITH_PARAPET), "give the parapet's height above the roof"),
    ("arrays", "weight_n"): (
        # A part that could not be read is absent: then nothing is said of the weight.
        lambda row, _: row.keys() >= {*WEIGHT_PARTS} and None in map(row.get, WEIGHT_PARTS),
        "give it, or modules, module weight and ballast weight"),
    ("arrays", "mu_fast"): (_filled("mu_rate_s_per_m"), _LAW),
    ("arrays", "mu_rate_s_per_m"): (_filled("mu_fast"), _LAW),
    ("motions", "scale_value"): (
        _chosen("scaling", Scaling.FACTOR, Scaling.PPA), "give the factor, or the PPA in g"),
    ("building", "period_s"): (
        lambda row, inputs: row.get("structure", "") is None
        and any(motion.get("recorded_at") is RecordedAt.GROUND for motion in inputs["motions"]),
        "give it, or a structure type: a motion is recorded at the ground"),
}  # fmt: skip

# Tables whose ids differ from each other, without regard to capitals.
UNIQUE = (("arrays", "objects"), ("motions",))

# Fields that name a row of other tables; an outline may be that of the roof.
REFERENCES: Mapping[tuple[str, str], tuple[str, ...]] = {
    ("clearances", "array"): ("arrays",),
    ("clearances", "object"): ("objects", "arrays"),
    ("links", "array"): ("arrays",),
    ("outlines", "name"): ("arrays", "objects"),
}

# Slope of an array from which it is refused.
MAX_SLOPE_DEG = 45.0

# Distance [m] from which on a shape is far from a roof, if that is not longer; or from an array.
LEAST_FAR_M, FAR_M = 30.0, 500.0

# Fields of which the second is larger, where a table has them.
ORDERED = (("x_from_m", "x_to_m"), ("y_from_m", "y_to_m"))


def missing(inputs: Inputs, where: Where) -> Iterator[Finding]:
    """Yield the cells that are required by others, and blank."""
    for (section, field), (is_required, wanted) in REQUIRED.items():
        for index, row in enumerate(inputs[section]):
            # What could not be read is not blank, and has an error of its own.
            is_blank = field in row and row[field] in (None, "")
            if is_blank and is_required(row, inputs):
                fault = f"{SECTION[section].entry(field).spoken} is missing"
                yield Finding.error(Place(section, index, field), fault, wanted)


# 2,000 arrays at one place would be two million pairs.
LEAST_VERTICES, MOST_OVERLAPS = 3, 1_000
_EDGES = (ObjectKind.EDGE_WITH_PARAPET, ObjectKind.EDGE_WITHOUT_PARAPET)
_PLACED = ("arrays", "objects")


@dataclass(frozen=True, slots=True)
class _Outline:
    """The rows of an outline: the cell that names it first, and its vertices."""

    name: str
    place: Place
    vertices: tuple[Point, ...]  # none if a cell is unreadable


def us_first(inputs: Inputs) -> bool:
    """Whether US units come first."""
    return all(row.get("units_first") is not UnitsFirst.SI for row in inputs["project"])


def _rows(inputs: Inputs, sections: Iterable[str] = _PLACED) -> Iterator[tuple[Place, InputRow]]:
    for section in sections:
        yield from ((Place(section, index), row) for index, row in enumerate(inputs[section]))


def shapes_of(inputs: Inputs) -> dict[str, Shape]:
    """Return the shape of each array and object that has a valid one, by id."""
    outlines = _outlines(inputs)
    rows = {row["id"]: row for _, row in _rows(inputs) if "id" in row}
    shapes = {name: _shape(row, outlines.get(name)) for name, row in rows.items()}
    return {name: shape for name, shape in shapes.items() if shape is not None}


def roof_of(inputs: Inputs) -> Shape | None:
    """Return the shape of the roof, if it has a valid one."""
    outline = _outlines(inputs).get(ROOF)
    return next((_shape(row, outline) for row in inputs["roof"]), None)


def far_off(
    shapes: Mapping[str, Shape], roof: Shape | None, is_us: bool
) -> Iterator[tuple[str, str]]:
    """Yield what lies far from the roof, or else from the largest shape, with a question."""
    if not shapes:
        return
    largest = max(shapes, key=lambda name: shapes[name].area_m2)
    center = roof or shapes[largest]
    box = center.bounds
    long_m = max(box.x_to_m - box.x_from_m, box.y_to_m - box.y_from_m)
    far_m = max(long_m, LEAST_FAR_M) if roof else FAR_M
    for name, shape in shapes.items():
        away_m = gap_m(shape, center)
        if away_m > far_m:
            away = pair(away_m, Quantity.PLAN, is_us)
            text = f"{name} is {away} from {'the roof' if roof else largest}: is it a leftover?"
            yield name, f"{text} Delete it, or correct its place"


def places_of(inputs: Inputs, names: Iterable[str], where: Where) -> str:
    """Return the cells of the rectangles of arrays and objects, or of the first of an outline."""
    outlines = _outlines(inputs)
    rows = {row["id"]: place for place, row in _rows(inputs) if "id" in row}
    return " and ".join(
        where(outlines[name].place) if name in outlines else _sides(rows[name], where)
        for name in names
    )


def _sides(row: Place, where: Where) -> str:
    first, last = (where(row._replace(field=side)) for side in (SIDES[0], SIDES[-1]))
    return f"{first}:{last.partition('!')[2]}"


def plan_faults(inputs: Inputs, where: Where) -> Iterator[Finding]:
    """Yield what is wrong with the shapes in plan."""
    yield from _rectangles(inputs, where)
    yield from _outline_rows(inputs, where)
    yield from _doubled(inputs, where)
    yield from _on_the_roof(inputs, where)
    yield from islice(_overlaps(inputs, where), MOST_OVERLAPS)


def _shape(row: InputRow, outline: _Outline | None) -> Shape | None:
    """Return the rectangle of a row or the polygon of its outline; None for what is neither."""
    if outline is not None:
        points = ring(outline.vertices)
        is_ring = len(points) >= LEAST_VERTICES and crossing(points) is None
        return Polygon(points) if is_ring else None
    sides = [row[side] for side in SIDES if row.get(side) is not None]
    if len(sides) < len(SIDES):
        return None
    x_from, x_to, y_from, y_to = sides
    return Rectangle(*sides) if x_from < x_to and y_from < y_to else None


def _outlines(inputs: Inputs) -> dict[str, _Outline]:
    by_name: dict[str, list[tuple[Place, InputRow]]] = {}
    for place, row in _rows(inputs, ("outlines",)):
        if "name" in row:
            name = ROOF if row["name"].casefold() == ROOF else row["name"]
            by_name.setdefault(name, []).append((place._replace(field="name"), row))
    outlines = {}
    for name, rows in by_name.items():
        is_whole = all("x_m" in row and "y_m" in row for _, row in rows)
        vertices = tuple((row["x_m"], row["y_m"]) for _, row in rows) if is_whole else ()
        outlines[name] = _Outline(name, rows[0][0], vertices)
    return outlines


def _rectangles(inputs: Inputs, where: Where) -> Iterator[Finding]:
    for place, row in _rows(inputs, ("roof", *_PLACED)):
        for first, last in ORDERED:
            low, high = row.get(first), row.get(last)
            if low is None or high is None or low < high:
                continue
            shown, least = (pair(value, Quantity.PLAN, us_first(inputs)) for value in (high, low))
            at = where(place._replace(field=first))
            wanted = f"give more than {_label(first)} in {at}, {least}"
            fault = f"{_label(last)} is {shown}"
            yield Finding.error(place._replace(field=last), fault, wanted)


def _label(side: str) -> str:
    return side.removesuffix("_m").replace("_", " ")


def _outline_rows(inputs: Inputs, where: Where) -> Iterator[Finding]:
    ids = [row["id"] for _, row in _rows(inputs) if "id" in row]
    for outline in _outlines(inputs).values():
        if outline.name not in (ROOF, *ids):
            text = f"outline of '{outline.name}', which is not in Arrays or Objects"
            yield Finding.error(outline.place, text, suggestion(outline.name, [*ids, ROOF]))
        if outline.name == ROOF and ROOF in map(str.casefold, ids):
            text = "outline of 'roof', which is also the ID of an array or object"
            yield Finding.error(outline.place, text, "give that another ID")
        yield from _ring_faults(outline, us_first(inputs))
    yield from _scattered(inputs, where)


def _ring_faults(outline: _Outline, is_us: bool) -> Iterator[Finding]:
    if not outline.vertices:
        return
    points = ring(outline.vertices)
    # A vertex that is given again is no other corner.
    count = len(set(points))
    if count < LEAST_VERTICES:
        text = f"{outline.name} has {count} {'vertex' if count == 1 else 'vertices'}"
        yield Finding.error(outline.place, text, f"give at least {LEAST_VERTICES}, one to a row")
        return
    at = crossing(points)
    if at is not None:
        text = f"outline of {outline.name} touches or crosses itself near {spot(at, is_us)}"
        yield Finding.error(outline.place, text, "give its vertices in order, none of them twice")


def spot(at: Point, is_us: bool) -> str:
    """Return a point of the plan in words."""
    x, y = (pair(value, Quantity.PLAN, is_us) for value in at)
    return f"x {x}, y {y}"


def _scattered(inputs: Inputs, where: Where) -> Iterator[Finding]:
    """Yield the rows at which an outline goes on after rows of another one."""
    last: dict[str, int] = {}
    for index, row in enumerate(inputs["outlines"]):
        name = row.get("name")
        if name is None:
            continue
        before = last.get(name.casefold(), index - 1)
        if before != index - 1:
            at = where(Place("outlines", before, "name"))
            text = f"outline of '{name}' goes on here after {at}"
            wanted = "put all of its rows together"
            yield Finding.error(Place("outlines", index, "name"), text, wanted)
        last[name.casefold()] = index


def _doubled(inputs: Inputs, where: Where) -> Iterator[Finding]:
    outlines = _outlines(inputs)
    for place, row in _rows(inputs, (*_PLACED, "roof")):
        name = ROOF if place.section == "roof" else row.get("id", "")
        side = next((side for side in SIDES if row.get(side) is not None), None)
        if name in outlines and side is not None:
            at = where(outlines[name].place)
            text = f"{_label(side)} is given, and {name} has an outline at {at}"
            wanted = "leave the four sides blank, or delete the outline"
            yield Finding.error(place._replace(field=side), text, wanted)


def _on_the_roof(inputs: Inputs, where: Where) -> Iterator[Finding]:
    outlines = _outlines(inputs)
    for row in inputs["roof"]:
        roof = _shape(row, outlines.get(ROOF))
        if roof is None:
            continue
        at = outlines[ROOF].place if ROOF in outlines else Place("roof", 0, "x_from_m")
        for index, array in enumerate(inputs["arrays"]):
            own = outlines.get(array.get("id", ""))
            if isinstance(roof, Rectangle) and own is None:
                yield from _beyond(roof, index, array, inputs, where)
                continue
            shape = _shape(array, own)
            beyond = outside(shape, roof) if shape is not None else None
            if beyond is not None:
                text = (
                    f"{array.get('id')} is outside the roof near {spot(beyond, us_first(inputs))}"
                )
                place = Place("arrays", index, "x_from_m") if own is None else own.place
                wanted = f"correct it, or the outline of the roof at {where(at)}"
                yield Finding.error(place, text, wanted)


def _beyond(
    roof: Rectangle, index: int, array: InputRow, inputs: Inputs, where: Where
) -> Iterator[Finding]:
    for side in SIDES:
        value, edge, is_low = array.get(side), getattr(roof, side), "from" in side
        if value is None or (value >= edge if is_low else value <= edge):
            continue
        shown, limit = (pair(at, Quantity.PLAN, us_first(inputs)) for at in (value, edge))
        inside, at = "more" if is_low else "less", where(Place("roof", 0, side))
        text = f"{_label(side)} is {shown}, outside the roof"
        wanted = f"give {limit} or {inside}, or correct the outline at {at}"
        yield Finding.error(Place("arrays", index, side), text, wanted)


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
        for other in bodies[count + 1 :]:
            # They are sorted from the left: none of the following reaches back either.
            if other.bounds.x_from_m >= body.bounds.x_to_m:
                break
            first, second = sorted((body, other), key=lambda each: (not each.is_array, each.place))
            if not first.is_array or frozenset((body.name, other.name)) in cleared:
                continue
            # Boxes first: shapes that are no rectangles are measured by a library.
            if gap_m(body.bounds, other.bounds) < 0.0 and gap_m(body.shape, other.shape) < -NEAR_M:
                text = f"{first.name} and {second.name} at {where(second.place)} overlap in plan"
                yield Finding.error(first.place, text, "correct one of them")


def _bodies(inputs: Inputs) -> Iterator[_Body]:
    """Yield the arrays and objects that have a shape, without edges: an array may reach them."""
    outlines = _outlines(inputs)
    for place, row in _rows(inputs):
        own = outlines.get(row.get("id", ""))
        shape = _shape(row, own) if "id" in row else None
        if shape is not None and row.get("kind") not in _EDGES:
            at = place._replace(field="x_from_m") if own is None else own.place
            yield _Body(at, row["id"], place.section == "arrays", shape, shape.bounds)
