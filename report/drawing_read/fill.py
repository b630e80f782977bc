"""Writes the plan as drawn, and ballast, to the cells of a workbook that is being changed.

Reads no drawing and writes no file. Read `plan_as_rows`, then `fill_plan`.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from typing import NoReturn

from report.drawing_read.geometry import own_axes
from report.drawing_read.modules import GAP_M
from report.drawing_read.moved import SAME_M, Move
from report.drawing_read.plan_as_drawn import RoofPlan
from report.drawing_read.plan_read import check_size, known_layers, plan_of, unit_asked
from report.drawing_read.roof_drawing import DrawnOutline, RoofDrawing
from report.drawing_read.row_matching import matched
from report.project.check.finding_lines import listed
from report.project.check.plan_shapes import far_off, us_first
from report.project.model.choices import LayerKind
from report.project.model.input_rows import Inputs
from report.project.model.roof import DRAWING, DRAWN_MODULES, ROOF
from report.project.model.shapes import SIDES, Polygon, Rectangle, Shape
from report.project.read.changed_cells import Value
from report.project.read.locate import cell_as_column, find_cell, is_absent
from report.project.read.positions import found_at
from report.project.workbook import SECTION
from report.project.write.filled import DIGITS, WorkbookChange
from report.text.grouping import grouped_by
from report.text.units import LENGTHS, Quantity
from solver.errors import InputError

_MOVE = "Run roofslip new FOLDER and copy your cells into the new workbook"


def layers_of(inputs: Inputs) -> dict[str, LayerKind]:
    """Return the layer types on the Layers worksheet."""
    known = (row for row in inputs["layers"] if {"layer", "kind"} <= row.keys())
    return {row["layer"]: row["kind"] for row in known}


def plan_as_rows(
    drawn: RoofDrawing,
    unit_m: float,
    inputs: Inputs,
    layers: Mapping[str, LayerKind],
    joined_m: float = GAP_M,
    *,
    is_unit_given: bool,
) -> tuple[RoofPlan, dict[str, LayerKind]]:
    """Return the plan of a drawing, as rows of a workbook, and the types of its layers.

    `layers` add to the Layers worksheet; a layer that nobody says anything of is not read.
    `joined_m` is the largest gap between modules of one array.

    Raises `InputError` if there is nothing to fill in; for sizes that few have, unless somebody
    has given the unit.
    """
    is_us, kinds = us_first(inputs), {**layers_of(inputs), **layers}
    plan, known = plan_of(drawn, unit_m, kinds, joined_m, is_us), known_layers(kinds)
    if not (plan.roof or plan.arrays or plan.objects):
        _refuse(plan, drawn)
    if not is_unit_given:
        check_size(plan, drawn.unit, is_us)
    unknown = [line.layer for line in drawn.lines if line.layer.casefold() not in known]
    plan = matched(plan, inputs)
    # A plan that is 12 times as large as its workbook is one in inches that was read in feet.
    if plan.move and plan.move.factor != 1.0 and not is_unit_given:
        size_m = LENGTHS[drawn.unit] / plan.move.factor
        units = [unit for unit, m in LENGTHS.items() if math.isclose(m, size_m, rel_tol=1e-3)]
        raise InputError(
            f"the plan is {plan.move.factor:.4g} times as large as in the workbook;"
            f" {unit_asked(units, drawn.unit)}"
        )
    return plan, {**layers, **dict.fromkeys(unknown, LayerKind.NOT_READ)}


def _refuse(plan: RoofPlan, drawn: RoofDrawing) -> NoReturn:
    if not drawn.lines:
        if names := ", ".join(drawn.layouts):
            text = f"its closed lines are in the layout {names}, not in model space"
            raise InputError(f"{text}; move them there in CAD")
        text = (
            "the drawing has no closed lines; draw roof, arrays and objects as closed lines in CAD"
        )
        raise InputError([text, *unread(plan)])
    raise InputError(
        ["nothing to fill in: enter the types of the layers on the Layers worksheet", *unread(plan)]
    )


def unread(plan: RoofPlan) -> Iterator[str]:
    """Yield unreadable entities, once for each cause, with their layers and some handles."""
    for reason, items in grouped_by(plan.unread, lambda item: item.reason).items():
        layers = listed(item.layer for item in items)
        handles = listed(f"{item.handle} {item.detail}".strip() for item in items)
        yield f"not read: {reason}: {len(items)} on {layers} ({handles})"


# Tables with the name of an array or an object, and the columns that have it.
_NAMED: Mapping[str, Sequence[str]] = {
    "arrays": ("id",), "objects": ("id",), "outlines": ("name",), "links": ("array",),
    "clearances": ("array", "object"),
}  # fmt: skip


def fill_plan(
    change: WorkbookChange, plan: RoofPlan, layers: Mapping[str, LayerKind], *, replace: bool
) -> list[str]:
    """Fill in the plan and the types of its layers; return lines on it.

    The lines state what moved, which typed entries are lost, and what lies far away.

    Raises `InputError` for each location already entered, unless it may be replaced.
    """
    # Rows of the same ID get its place, and keep everything else; others are added below, and those
    # that are to be taken out are emptied wherever they are named.
    _check_outlines(change, plan, replace)
    lines = _fill_arrays(change, plan)
    lines += _fill_objects(change, plan, replace)
    if replace:
        for name in plan.gone:
            lines += _take_out(change, name)
        if plan.move and not plan.move.is_none:
            lines += _move_typed(change, plan, plan.move)
    for place in plan.roof:
        _fill_roof(change, place.shape)
    if not is_absent(change.book, SECTION["layers"]):
        for layer, kind in layers.items():
            for row in change.rows("layers", "layer", layer) or [change.added_row("layers")]:
                change.put("layers", row, {"layer": layer, "kind": kind.value})
    shapes = {name: plan.before[name] for name in plan.typed} | plan.shapes
    far = far_off(shapes, plan.roof_shape, is_us=plan.unit == Quantity.PLAN.us)
    change.fill_in(replace=replace)
    return [*plan.lines(replace=replace), *lines, *(text for _, text in far)]


def _check_outlines(change: WorkbookChange, plan: RoofPlan, replace: bool) -> None:
    """Refuse polygons for a workbook without the Outlines worksheet."""
    if not is_absent(change.book, SECTION["outlines"]):
        return
    places = {place.name: place.shape for place in (*plan.arrays, *plan.objects)}
    if replace and plan.move and not plan.move.is_none:
        places |= {name: plan.before[name] for name in plan.typed}
    if plan.roof_shape:
        places[ROOF] = plan.roof_shape
    polygons = [name for name, shape in places.items() if isinstance(shape, Polygon)]
    if polygons:
        names = ", ".join(polygons)
        missing = f"Outlines: the worksheet is missing, which {names} in the drawing need"
        raise InputError(f"{missing}. {_MOVE}, then read the drawing into that")


def _move_typed(change: WorkbookChange, plan: RoofPlan, move: Move) -> list[str]:
    """Move typed entries with the plan as a whole: locations, and directions as it is rotated."""
    for name in plan.typed:
        key = "arrays" if change.rows("arrays", "id", name) else "objects"
        _fill_place(change, key, change.rows(key, "id", name)[0], name, plan.before[name], "")
    lines = []
    for name, row in plan.rows.items():
        way_deg = row.get("downslope_deg")
        if way_deg is None or name in plan.gone:
            continue
        now_deg = move.way_deg(way_deg)
        if now_deg != way_deg % 360.0:
            change.put("arrays", change.rows("arrays", "id", name)[0], {"downslope_deg": now_deg})
            lines.append(f"{name}: downslope direction {way_deg:g}° is {now_deg:g}° now")
    return lines


def fill_ballast(
    change: WorkbookChange, weights_n: Mapping[str, float | None], *, replace: bool
) -> None:
    """Fill in ballast weights [N] of arrays, None for none; raises as `fill_plan`."""
    for name, weight_n in weights_n.items():
        row = change.rows("arrays", "id", name)[0]
        if not change.cell("arrays", row, "ballast_n").is_blank:
            change.refuse("arrays", row, "ballast_n", "ballast weight", name)
        weight = None if weight_n is None else change.number("arrays", "ballast_n", weight_n)
        change.put("arrays", row, {"ballast_n": weight})
    change.fill_in(replace=replace)


def _fill_arrays(change: WorkbookChange, plan: RoofPlan) -> list[str]:
    """Fill in arrays; report typed entries of an array whose size has changed."""
    lines = []
    for place in plan.arrays:
        row, values = _row_of(change, "arrays", place)
        before = plan.row_shapes.get(place.name)
        if before and not _is_same_size(before, place.shape):
            typed = _typed(change, "arrays", row, {"modules"} if place.modules else set())
            lines.append(f"{place.name} has another size; stays as typed: {typed}")
        if place.modules and "modules" in change.table("arrays").columns:
            if not change.cell("arrays", row, "modules").is_blank:
                change.refuse("arrays", row, "modules", "number of modules", place.name)
            values["modules"] = place.modules
        change.put("arrays", row, values)
    return lines


def _fill_objects(change: WorkbookChange, plan: RoofPlan, replace: bool) -> list[str]:
    """Fill in objects; report a type or a height that has changed."""
    lines = []
    for place in plan.objects:
        is_new = not change.rows("objects", "id", place.name)
        row, values = _row_of(change, "objects", place)
        if is_new or replace:
            values["kind"] = place.kind.value
            if math.isfinite(place.height_m):
                values["height_m"] = change.number("objects", "height_m", place.height_m)
            for name in () if is_new else ("kind", "height_m"):
                cell = change.cell("objects", row, name)
                if name in values and cell.value not in (None, values[name]):
                    change_of = f"{place.name}: {_entered(change, 'objects', row, name)}"
                    lines.append(f"{change_of} is {values[name]} now, as drawn")
        change.put("objects", row, values)
    return lines


def _row_of(change: WorkbookChange, key: str, place: DrawnOutline) -> tuple[int, dict[str, Value]]:
    """Return the row of an outline, filled with its location, and further cells."""
    rows = change.rows(key, "id", place.name)
    row = rows[0] if rows else change.added_row(key)
    _fill_place(change, key, row, place.name, place.shape, DRAWING)
    values: dict[str, Value] = {} if rows else {"id": place.name}
    values["place_from"] = DRAWN_MODULES if place.modules else DRAWING
    # The number was counted in an earlier drawing: of one without modules it says nothing.
    if not place.modules and change.cell(key, row, "place_from").shown == DRAWN_MODULES:
        values["modules"] = None
    return row, values


def _fill_place(
    change: WorkbookChange, key: str, row: int, name: str, shape: Shape, source: str
) -> None:
    """Fill in the sides of a rectangle or the outline of a polygon; clear the previous location."""
    taken = [side for side in SIDES if not change.cell(key, row, side).is_blank]
    if taken:
        change.refuse(key, row, taken[0], "location", name)
    _fill_outline(change, name, shape, source)
    for side, value in zip(SIDES, _sides(shape), strict=True):
        # A polygon has no sides: those of a rectangle that was there are cleared.
        if value is not None or side in taken:
            number = None if value is None else change.number(key, side, value)
            change.put(key, row, {side: number})


def _take_out(change: WorkbookChange, name: str) -> list[str]:
    """Clear the rows of an array or an object that is no longer drawn, and related rows."""
    lost = []
    for key, columns in _NAMED.items():
        if is_absent(change.book, SECTION[key]):
            continue
        rows: set[int] = set()
        for column in columns:
            rows.update(change.rows(key, column, name))
        for row in rows:
            is_drawn = key == "clearances" and change.cell(key, row, "source").shown == DRAWING
            # What a drawing gave goes with it: only what was typed is a loss, and is told.
            typed = "" if key == "outlines" or is_drawn else _typed(change, key, row, set())
            if typed:
                lost.append(f"{change.position(key, row, columns[0]).address}: {typed}")
            change.put(key, row, dict.fromkeys(change.table(key).columns))
    return [f"deleted with {name}: {'; '.join(lost)}"] if lost else []


def _typed(change: WorkbookChange, key: str, row: int, drawn: set[str]) -> str:
    """Return the typed entries of a row other than its name, its location and drawn values."""
    columns = change.table(key).columns
    names = [name for name in columns if not change.cell(key, row, name).is_blank]
    passed = {"id", "place_from", *SIDES, *drawn}
    return ", ".join(_entered(change, key, row, name) for name in names if name not in passed)


def _entered(change: WorkbookChange, key: str, row: int, name: str) -> str:
    """Return a cell as text, such as `height 36 in`."""
    label, unit = SECTION[key].entry(name).spoken, change.table(key).columns[name].unit
    return f"{label} {change.cell(key, row, name).shown} {unit}".strip()


def _is_same_size(before: Shape, after: Shape) -> bool:
    sizes = zip(sorted(own_axes(before)[:2]), sorted(own_axes(after)[:2]), strict=True)
    is_same_area = math.isclose(before.area_m2, after.area_m2, rel_tol=0.01)
    return is_same_area and all(abs(a - b) < SAME_M for a, b in sizes)


def _sides(shape: Shape) -> tuple[float | None, ...]:
    if isinstance(shape, Rectangle):
        return shape.x_from_m, shape.x_to_m, shape.y_from_m, shape.y_to_m
    return (None,) * len(SIDES)


def _fill_roof(change: WorkbookChange, shape: Shape) -> None:
    book, section = change.book, SECTION["roof"]
    _fill_outline(change, ROOF, shape, DRAWING)
    if isinstance(shape, Polygon) and is_absent(book, section):
        return
    for side, value in zip(SIDES, _sides(shape), strict=True):
        position = find_cell(book, section, section.entry(side))
        si = cell_as_column(book, section, section.entry(side), position).si
        is_blank = found_at(book, position).is_blank
        if not is_blank:
            change.refuse_cell(position, "location", "the roof")
        if value is not None or not is_blank:
            change.cells[position] = None if value is None else round(value / si, DIGITS)


def _fill_outline(change: WorkbookChange, name: str, shape: Shape, source: str) -> None:
    """Fill in an outline below the others, and clear the previous one."""
    if is_absent(change.book, SECTION["outlines"]):
        return
    rows = change.rows("outlines", "name", name)
    if rows:
        change.refuse("outlines", rows[0], "name", "location", name)
    for row in rows:
        change.put("outlines", row, dict.fromkeys(change.table("outlines").columns))
    for x, y in shape.points if isinstance(shape, Polygon) else ():
        place_m = {
            "x_m": change.number("outlines", "x_m", x),
            "y_m": change.number("outlines", "y_m", y),
        }
        row = change.added_row("outlines")
        change.put("outlines", row, {"name": name, **place_m, "source": source or None})
