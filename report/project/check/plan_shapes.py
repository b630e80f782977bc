"""The shapes in plan of all readable inputs: rectangles and outlines."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass

from report.project.model.choices import UnitsFirst
from report.project.model.input_rows import InputRow, Inputs, Place, Where
from report.project.model.roof import ROOF
from report.project.model.shapes import (
    SIDES,
    Point,
    Polygon,
    Rectangle,
    Shape,
    crossing,
    gap_m,
    ring,
)
from report.text.units import Quantity, pair

# 2,000 arrays at one place would be two million pairs.
LEAST_VERTICES, MOST_OVERLAPS = 3, 1_000


PLACED = ("arrays", "objects")


@dataclass(frozen=True, slots=True)
class OutlineRows:
    """The rows of an outline: the cell that names it first, and its vertices."""

    name: str
    place: Place
    vertices: tuple[Point, ...]  # none if a cell is unreadable


def us_first(inputs: Inputs) -> bool:
    """Whether US units come first."""
    return all(row.get("units_first") is not UnitsFirst.SI for row in inputs["project"])


def rows_in(inputs: Inputs, sections: Iterable[str] = PLACED) -> Iterator[tuple[Place, InputRow]]:
    """Yield the rows of sections, each with its place."""
    for section in sections:
        yield from ((Place(section, index), row) for index, row in enumerate(inputs[section]))


def shapes_of(inputs: Inputs) -> dict[str, Shape]:
    """Return the shape of each array and object that has a valid one, by id."""
    outlines = outlines_of(inputs)
    rows = {row["id"]: row for _, row in rows_in(inputs) if "id" in row}
    shapes = {name: shape_of(row, outlines.get(name)) for name, row in rows.items()}
    return {name: shape for name, shape in shapes.items() if shape is not None}


def roof_of(inputs: Inputs) -> Shape | None:
    """Return the shape of the roof, if it has a valid one."""
    outline = outlines_of(inputs).get(ROOF)
    return next((shape_of(row, outline) for row in inputs["roof"]), None)


def places_of(inputs: Inputs, names: Iterable[str], where: Where) -> str:
    """Return the cells of the rectangles of arrays and objects, or of the first of an outline."""
    outlines = outlines_of(inputs)
    rows = {row["id"]: place for place, row in rows_in(inputs) if "id" in row}
    return " and ".join(
        where(outlines[name].place) if name in outlines else _sides(rows[name], where)
        for name in names
    )


def _sides(row: Place, where: Where) -> str:
    first, last = (where(row._replace(field=side)) for side in (SIDES[0], SIDES[-1]))
    return f"{first}:{last.partition('!')[2]}"


def shape_of(row: InputRow, outline: OutlineRows | None) -> Shape | None:
    """Return the rectangle of a row or the polygon of its outline; None if it is neither."""
    if outline is not None:
        points = ring(outline.vertices)
        is_ring = len(points) >= LEAST_VERTICES and crossing(points) is None
        return Polygon(points) if is_ring else None
    sides = [row[side] for side in SIDES if row.get(side) is not None]
    if len(sides) < len(SIDES):
        return None
    x_from, x_to, y_from, y_to = sides
    return Rectangle(*sides) if x_from < x_to and y_from < y_to else None


def outlines_of(inputs: Inputs) -> dict[str, OutlineRows]:
    """Return the outlines by the name of what each is of, that of the roof by `ROOF`."""
    by_name: dict[str, list[tuple[Place, InputRow]]] = {}
    for place, row in rows_in(inputs, ("outlines",)):
        if "name" in row:
            name = ROOF if row["name"].casefold() == ROOF else row["name"]
            by_name.setdefault(name, []).append((place._replace(field="name"), row))
    outlines = {}
    for name, rows in by_name.items():
        # Without one of its vertices an outline is another shape, about which errors would be
        # false.
        is_whole = all("x_m" in row and "y_m" in row for _, row in rows)
        vertices = tuple((row["x_m"], row["y_m"]) for _, row in rows) if is_whole else ()
        outlines[name] = OutlineRows(name, rows[0][0], vertices)
    return outlines


# Distance [m] from which on a shape is far from a roof, if that is not longer; or from an array.
LEAST_FAR_M, FAR_M = 30.0, 500.0


def far_off(
    shapes: Mapping[str, Shape], roof: Shape | None, is_us: bool
) -> Iterator[tuple[str, str]]:
    """Yield items far from the roof, or else from the largest shape, with a question."""
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
            text = f"{name} is {away} from {'the roof' if roof else largest}; was it left over?"
            yield name, f"{text} Delete it, or correct its location"
