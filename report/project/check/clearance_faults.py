"""Faults of clearances: given twice, to itself, or more than the plan shows."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from report.project.check.input_columns import repeated
from report.project.check.plan_shapes import places_of, shapes_of, us_first
from report.project.model.finding import Finding
from report.project.model.input_rows import InputRow, Inputs
from report.project.model.place import Place, Where
from report.project.model.shapes import Rectangle, Shape, gap_m
from report.text.units import Quantity, no_more, pair
from solver.model import INCH_M

GAP_TOLERANCE = 0.01
# Below the inch at which a package states that a clearance contradicts the plan
# (`report.assessment.plan.neighbors`): what passes here passes there.
GAP_TOLERANCES_M = (0.5 * INCH_M, 0.99 * INCH_M)


def gap_tolerance_m(gap_m: float) -> float:
    """Return how far a clearance may be from the gap of the plan [m]."""
    low, high = GAP_TOLERANCES_M
    return min(max(GAP_TOLERANCE * gap_m, low), high)


def clearance_faults(inputs: Inputs, where: Where) -> Iterator[Finding]:
    """Yield clearances that are given twice, to the array itself, or as more than in plan."""
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
        remedy = "give an object or another array"
        yield Finding.error(Place("clearances", index, "object"), text, remedy)
        return
    a, b = (shapes.get(str(name)) for name in (array, neighbor))
    if a is None or b is None or provided is None:
        return
    gap, place = gap_m(a, b), Place("clearances", index, "provided_m")
    # Shapes that touch are apart by rounding error, of either sign.
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
        text += f", but {array} and {neighbor} are {gap_text} apart in plan"
        yield Finding.error(place, text, f"reduce it, or correct the {noun} in {cells}")
