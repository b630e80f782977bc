"""Which row of a workbook each outline of a drawing is, and which cells the plan as drawn fills.

Reads no drawing (`report.drawing_read.plan_read`) and writes no file.
"""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import NoReturn

from report.drawing_read.modules import GAP_M
from report.drawing_read.moved import SAME_M, Move, whole_move
from report.drawing_read.plan_read import (
    DrawnOutline,
    RoofPlan,
    check_size,
    free_name,
    known_layers,
    own_axes,
    plan_of,
    unit_asked,
)
from report.drawing_read.roof_drawing import RoofDrawing
from report.project.check.far_shapes import far_off
from report.project.check.plan_shapes import roof_of, shapes_of, us_first
from report.project.check.problem_lines import listed
from report.project.model.choices import LayerKind
from report.project.model.input_rows import InputRow, Inputs
from report.project.model.placed import SIDES
from report.project.model.roof import DRAWING, DRAWN_MODULES, ROOF
from report.project.model.shapes import Polygon, Rectangle, Shape, around, gap_m, mean, sides, solid
from report.project.read.archive import OpenBook
from report.project.read.changed_cells import Value
from report.project.read.growing_table import DIGITS, GrowingTable
from report.project.read.locate_cell import cell_as_column, find_cell, is_absent
from report.project.read.positions import CellPosition, found_at
from report.project.workbook import SECTION
from report.text.counts import grouped_by
from report.text.formats import aligned
from report.text.units import LENGTHS, Quantity, Unit
from solver.model import InputError

_MOVE = "Run roofslip new FOLDER and copy your cells into the new workbook"

# Common share of two outlines, of all that either covers, by which they may be the same.
_LEAST_SHARE = 0.05
_RENAMED_SHARE = 0.9  # the same, of an outline that the drawing calls by a name of its own
_PLAIN = 2.0  # a row is told from another by this times its share, or its part of the distance
_SAME_WAY = 0.9  # cosine between the outward directions of two edges of the same side
# Most outlines of a kind that cannot be told and are named.
MOST_TOLD = 20
_STILL_M = 1e-3  # what has moved by less has not
_ARRAY, _OBJECT, _EDGE = "array", "object", "edge"

Pairs = Mapping[tuple[int, str], float]  # how well an outline, by its number, is a row


@dataclass(frozen=True, slots=True, kw_only=True)
class MatchedPlan:
    """A plan with the names of the rows of a workbook."""

    plan: RoofPlan  # as drawn, but for its names
    gone: tuple[str, ...]  # rows with a place from a former drawing that is not in this one
    typed: tuple[str, ...]  # the same with a place that was typed
    move: Move | None  # of the plan as a whole; None where it cannot be told
    before: Mapping[str, Shape]  # where the rows were, moved with the whole
    rows_m: Mapping[str, Shape]  # where they were
    rows: Mapping[str, InputRow]  # as they were
    unit: Unit  # of places in what is said

    def lines(self, *, replace: bool) -> Iterator[str]:
        """Yield a table of what moved, is new or is gone with `replace`, and modules not drawn."""
        if self.move is None:
            yield (
                "the roof is another one, and how the plan has moved cannot be told: its edges are"
                " new; check the downslope directions, and that of north"
            )
        elif not self.move.is_none:
            check = "" if self.move.is_straight else "; check the direction of north"
            text = f"the plan as a whole is {self.move.words(self.unit)} since the workbook{check}"
            yield f"{text}; what was typed and is not drawn is moved with it"
        now = self.plan.shapes
        moves = []
        # At first, when nothing was in plan, there is no table.
        for name in {**self.before, **now} if self.before else ():
            was, shape = self.before.get(name), now.get(name)
            if was and shape and solid(was).hausdorff_distance(solid(shape)) < _STILL_M:
                continue
            stays = "stays as typed" if name in self.typed else "stays without --replace"
            gone = f"not in the drawing; {'taken out' if replace and name in self.gone else stays}"
            from_, to = (_place(each, self.unit) if each else "" for each in (was, shape))
            moves.append((name, from_ or "new", to or gone))
        yield from aligned([("name", "from", "to"), *moves]) if moves else ()
        for place in self.plan.arrays:
            row = self.rows.get(place.name, {})
            if not place.modules and (count := row.get("modules")):
                is_drawn = row.get("place_from") == DRAWN_MODULES
                what = "taken out, as they are not drawn" if is_drawn else "stay as typed"
                yield f"{place.name}: {count} modules {what}"


def matched(plan: RoofPlan, inputs: Inputs) -> MatchedPlan:
    """Return a plan with the names of the rows of a workbook.

    Raises `InputError` with the candidates, for what cannot be told.
    """
    # An outline with the name of a row in the drawing is that row. The others are told by place
    # among the rows that are left: by what they have in common, then by the nearest center of the
    # same size. What is left is new.
    known = [*inputs["arrays"], *inputs["objects"]]
    rows = {row["id"]: row for row in known if "id" in row}
    groups = {row["id"]: _group(row.get("kind", "")) for row in inputs["objects"] if "id" in row}
    was = shapes_of(inputs)
    unit = Quantity.PLAN.us if us_first(inputs) else Quantity.PLAN.si
    drawn = (*plan.arrays, *plan.objects)
    by_name = {(groups.get(name, _ARRAY), name.casefold()): name for name in was}
    by_row = {
        number: by_name[key]
        for number, place in enumerate(drawn)
        if (key := (_group(place.kind), place.name.casefold())) in by_name and not place.unnamed
    }
    # Of a row whose name is not in the drawing only its group is known. Edges follow the roof.
    keyed = [
        (name if name in by_row.values() else groups.get(name, _ARRAY), shape)
        for name, shape in was.items()
        if groups.get(name) != _EDGE
    ]
    now = [(by_row.get(k, _group(place.kind)), place.shape) for k, place in enumerate(drawn)]
    named = [(was[name], drawn[number].shape) for number, name in by_row.items()]
    roof = roof_of(inputs)
    move = whole_move((roof, plan.roof_shape), keyed, now, named)
    moved = move or Move()
    before = {name: moved.of(shape) for name, shape in was.items()}
    # An edge stays on its side of the roof, or of all that is in plan where no roof is.
    ways_before = {
        name: _outward(shape, moved.of(roof) if roof else around(before.values()))
        for name, shape in before.items()
        if groups.get(name) == _EDGE
    }
    ways = {
        k: _outward(place.shape, plan.roof_shape or around(plan.shapes.values()))
        for k, place in enumerate(drawn)
        if _group(place.kind) == _EDGE
    }
    unclear: list[str] = []
    for group in (_ARRAY, _OBJECT, _EDGE):
        numbers = [k for k, place in enumerate(drawn) if _group(place.kind) == group]
        names = [name for name in before if groups.get(name, _ARRAY) == group]
        is_edge = group == _EDGE
        # By what they cover together first: a center alone may be nearer to a neighbor.
        for score in (_common, _near if is_edge else _same_sized) if move else ():
            pairs = {
                (k, name): value
                for k in numbers
                for name in names
                if k not in by_row and name not in by_row.values()
                if (value := score(drawn[k], before[name])) > 0.0
                if not is_edge or (ways_before[name] * ways[k].conjugate()).real > _SAME_WAY
            }
            unclear += _tell(pairs, drawn, by_row, unit)
        left = [name for name in names if name not in by_row.values() and _is_drawn(rows[name])]
        new = [k for k in numbers if k not in by_row and drawn[k].unnamed and drawn[k].handle]
        if left and new and not unclear:
            unclear.append(_either([drawn[k] for k in new], left, unit) + ", or new")
    if unclear:
        raise InputError([f"{text}: write its name inside of it as a text" for text in unclear])
    # Read after all groups: a row may still be found by its size.
    lost = [name for name in before if name not in by_row.values()]
    return MatchedPlan(
        plan=_renamed(plan, by_row, before, rows),
        gone=tuple(name for name in lost if _is_drawn(rows[name])),
        typed=tuple(name for name in lost if not _is_drawn(rows[name])),
        move=move,
        before=before,
        rows_m=was,
        rows=rows,
        unit=unit,
    )


def _outward(edge: Shape, roof: Shape) -> complex:
    """Return the direction across an edge, as a number of length 1, that leads away from a roof."""
    import shapely

    start, end = max(sides(edge.points), key=lambda side: math.dist(*side))
    across = complex(end[1] - start[1], start[0] - end[0]) / math.dist(start, end)
    middle = complex(*mean(edge.bounds.points))
    far, near = (
        solid(roof).distance(shapely.Point(at.real, at.imag))
        for at in (middle + across, middle - across)
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
    area, other = solid(place.shape), solid(row)
    share: float = area.intersection(other).area / area.union(other).area
    return share if share >= (_LEAST_SHARE if place.unnamed else _RENAMED_SHARE) else 0.0


def _near(place: DrawnOutline, row: Shape) -> float:
    """Return how near the center of an outline without a name is to that of a row [1/m]."""
    far_m = math.dist(mean(place.shape.bounds.points), mean(row.bounds.points))
    return 1.0 / max(far_m, _STILL_M) if place.unnamed else 0.0


def _same_sized(place: DrawnOutline, row: Shape) -> float:
    """Return the same of an outline of the same size; 0 for another."""
    sizes = ((b.x_to_m - b.x_from_m, b.y_to_m - b.y_from_m)
             for b in (place.shape.bounds, row.bounds))  # fmt: skip
    is_same = all(abs(a - b) < SAME_M for a, b in zip(*sizes, strict=True))
    return _near(place, row) if is_same else 0.0


def _tell(
    pairs: Pairs, drawn: Sequence[DrawnOutline], matches: dict[int, str], unit: Unit
) -> Iterator[str]:
    """Add the rows that are plain, the best first, and yield what is not, as far as it is told."""
    told = 0
    while pairs and told < MOST_TOLD:
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
            told += 1
            numbers, names = ({*each} for each in zip(best, *rivals, strict=True))
            yield _either([drawn[k] for k in sorted(numbers)], sorted(names), unit)
        pairs = {p: value for p, value in pairs.items() if p[0] != number and p[1] != name}


def _either(places: Sequence[DrawnOutline], names: Sequence[str], unit: Unit) -> str:
    shown = (f"{place.handle or place.kind.value} ({_place(place.shape, unit)})"
             for place in places)  # fmt: skip
    return f"{listed(shown)} may be {listed(names).replace(', ', ' or ')}"


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
        other = f"'{place.name}' in the drawing" if not place.unnamed else "by its place"
        place = replace(place, name=name, unnamed="" if is_written else other)
        # A side of the roof has no parapet unless the row says so.
        is_assumed = not place.handle and "kind" in rows[name]
        kind = LayerKind(rows[name]["kind"].value) if is_assumed else place.kind
        named.append(replace(place, kind=kind, note="" if is_assumed else place.note))
    count = len(plan.arrays)
    return replace(plan, arrays=tuple(named[:count]), objects=tuple(named[count:]))


def _place(shape: Shape, unit: Unit) -> str:
    box = shape.bounds
    ends = ((box.x_from_m, box.x_to_m), (box.y_from_m, box.y_to_m))
    x, y = (" to ".join(f"{end / unit.si:.{unit.decimals}f}" for end in pair) for pair in ends)
    return f"x {x}, y {y} {unit.symbol}"


def layers_of(inputs: Inputs) -> dict[str, LayerKind]:
    """Return what the sheet Layers says of layers."""
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
) -> tuple[MatchedPlan, dict[str, LayerKind]]:
    """Return the plan of a drawing, as rows of a workbook, and what is said of its layers.

    `layers` add to the sheet Layers; a layer that nobody says anything of is not read. `joined_m`
    is the largest gap between modules of one array.

    Raises `InputError` if there is nothing to fill in; for sizes that few have, unless somebody
    has given the unit.
    """
    is_us, said = us_first(inputs), {**layers_of(inputs), **layers}
    plan, known = plan_of(drawn, unit_m, said, joined_m, is_us), known_layers(said)
    if not (plan.roof or plan.arrays or plan.objects):
        _refuse(plan, drawn)
    if not is_unit_given:
        check_size(plan, drawn.unit, is_us)
    unknown = [line.layer for line in drawn.lines if line.layer.casefold() not in known]
    told = matched(plan, inputs)
    if told.move and told.move.factor != 1.0 and not is_unit_given:
        size_m = LENGTHS[drawn.unit] / told.move.factor
        others = [u for u, m in LENGTHS.items() if math.isclose(m, size_m, rel_tol=1e-3)]
        raise InputError(
            f"the plan is {told.move.factor:.4g} times as large as in the workbook;"
            f" {unit_asked(others, drawn.unit)}"
        )
    return told, {**layers, **dict.fromkeys(unknown, LayerKind.NOT_READ)}


def _refuse(plan: RoofPlan, drawn: RoofDrawing) -> NoReturn:
    if not drawn.lines:
        if names := ", ".join(drawn.layouts):
            text = f"its closed lines are in the layout {names}, not in model space"
            raise InputError(f"{text}; move them there in CAD")
        text = "the drawing has no closed lines; draw roof, arrays and objects as such in CAD"
        raise InputError([text, *unread(plan)])
    raise InputError(["nothing to fill in: give the layers on the sheet Layers", *unread(plan)])


def unread(plan: RoofPlan) -> Iterator[str]:
    """Yield what was not understood, once for each cause, with its layers and some handles."""
    for reason, items in grouped_by(plan.unread, lambda item: item.reason).items():
        layers = listed(item.layer for item in items)
        handles = listed(f"{item.handle} {item.detail}".strip() for item in items)
        yield f"not read: {reason}: {len(items)} on {layers} ({handles})"


# Tables with the name of an array or an object, and the columns that have it.
_NAMED: Mapping[str, Sequence[str]] = {
    "arrays": ("id",), "objects": ("id",), "outlines": ("name",), "links": ("array",),
    "clearances": ("array", "object"),
}  # fmt: skip


@dataclass(slots=True)
class _Fill:
    """The changes of a workbook so far, and the cells that are filled already."""

    book: OpenBook
    replace: bool
    outlines: GrowingTable | None = None
    lacking: list[str] = field(default_factory=list)  # outlines without the sheet for them
    cells: dict[CellPosition, Value] = field(default_factory=dict)
    filled: list[str] = field(default_factory=list)
    said: list[str] = field(default_factory=list)  # of what was typed

    def refuse(self, position: CellPosition, name: str) -> None:
        """Note a place that is filled already."""
        if not self.replace:
            text = f"{name} is filled already; add --replace to overwrite it"
            self.filled.append(f"{position.address}: {text}")

    def put(self, position: CellPosition, value: Value, name: str) -> None:
        """Fill a cell, which is refused if it is filled already."""
        if not found_at(self.book, position).is_blank:
            self.refuse(position, name)
        self.cells[position] = value

    def done(self) -> dict[CellPosition, Value]:
        """Return the changes, if none was refused."""
        if self.filled:
            raise InputError(self.filled)
        return self.cells


def changes(
    book: OpenBook, told: MatchedPlan, layers: Mapping[str, LayerKind], *, replace: bool
) -> tuple[dict[CellPosition, Value], list[str]]:
    """Return the cells to change so that a workbook has the plan, and what its layers are.

    And what to say of what moved, what was typed and is lost, and what lies far off.

    Raises `InputError` for each place that is filled already, unless it may be replaced.
    """
    # Rows of the same ID get its place, and keep everything else; others are added below, and those
    # that are to be taken out are emptied wherever they are named.
    outlines = None if is_absent(book, SECTION["outlines"]) else GrowingTable.of(book, "outlines")
    fill = _Fill(book, replace, outlines)
    _fill_rows(fill, "arrays", told.plan.arrays, told.rows_m)
    _fill_rows(fill, "objects", told.plan.objects, {})
    for name in told.gone if replace else ():
        _take_out(fill, name)
    if replace and told.move and not told.move.is_none:
        _move_typed(fill, told, told.move)
    for place in told.plan.roof:
        _fill_roof(fill, place.shape)
    _fill_layers(fill, layers)
    if fill.lacking:
        names = ", ".join(fill.lacking)
        missing = f"Outlines: the sheet is missing, which {names} in the drawing need"
        raise InputError(f"{missing}. {_MOVE}, then read the drawing into that")
    shapes = {name: told.before[name] for name in told.typed} | told.plan.shapes
    far = far_off(shapes, told.plan.roof_shape, is_us=told.unit == Quantity.PLAN.us)
    return fill.done(), [*told.lines(replace=replace), *fill.said, *(text for _, text in far)]


def _move_typed(fill: _Fill, told: MatchedPlan, move: Move) -> None:
    """Move what was typed with the plan as a whole: places, and directions as it is turned."""
    arrays = GrowingTable.of(fill.book, "arrays")
    for name in told.typed:
        table = arrays if arrays.rows("id", name) else GrowingTable.of(fill.book, "objects")
        _fill_place(fill, table, table.rows("id", name)[0], name, told.before[name], "")
    for name, row in told.rows.items():
        way_deg = row.get("downslope_deg")
        if way_deg is None or name in told.gone:
            continue
        now_deg = move.way_deg(way_deg)
        if now_deg == way_deg % 360.0:
            continue
        at = arrays.position(arrays.rows("id", name)[0], "downslope_deg")
        fill.cells[at] = now_deg
        fill.said.append(f"{name}: downslope direction {way_deg:g}° is {now_deg:g}° now")


def ballast_changes(
    book: OpenBook, weights_n: Mapping[str, float | None], *, replace: bool
) -> dict[CellPosition, Value]:
    """Return the cells for ballast weights [N] of arrays, None for none; raises as `changes`."""
    fill, table = _Fill(book, replace), GrowingTable.of(book, "arrays")
    for name, weight_n in weights_n.items():
        position = table.position(table.rows("id", name)[0], "ballast_n")
        weight = None if weight_n is None else table.number("ballast_n", weight_n)
        fill.put(position, weight, f"the ballast weight of {name}")
    return fill.done()


def _fill_rows(
    fill: _Fill, key: str, places: Sequence[DrawnOutline], before: Mapping[str, Shape]
) -> None:
    """Fill in rows; what is typed of one whose size, given as it was, is another is said."""
    if not places:
        return
    table = GrowingTable.of(fill.book, key)
    for place in places:
        rows = table.rows("id", place.name)
        row = rows[0] if rows else table.added()
        _fill_place(fill, table, row, place.name, place.shape, DRAWING)
        values: dict[str, Value] = {} if rows else {"id": place.name}
        if place.name in before and not _is_same_size(before[place.name], place.shape):
            typed = _typed(table, row, {"modules"} if place.modules else set())
            fill.said.append(f"{place.name} has another size; stays as typed: {typed}")
        values["place_from"] = DRAWN_MODULES if place.modules else DRAWING
        if not place.modules and table.cell(row, "place_from").shown == DRAWN_MODULES:
            values["modules"] = None
        if key == "arrays" and place.modules:
            count = f"the number of modules of {place.name}"
            fill.put(table.position(row, "modules"), place.modules, count)
        if key == "objects" and (not rows or fill.replace):
            values["kind"] = place.kind.value
            if math.isfinite(place.height_m):
                values["height_m"] = table.number("height_m", place.height_m)
            for name in ("kind", "height_m") if rows else ():
                found = table.cell(row, name)
                if name in values and found.value not in (None, values[name]):
                    what = f"{place.name}: {_entered(table, row, name)}"
                    fill.said.append(f"{what} is {values[name]} now, as drawn")
        fill.cells |= table.cells(row, values)


def _fill_place(
    fill: _Fill, table: GrowingTable, row: int, name: str, shape: Shape, source: str
) -> None:
    """Fill in the sides of a rectangle or the outline of a polygon, and clear a former place."""
    taken = [side for side in SIDES if not table.cell(row, side).is_blank]
    if taken:
        fill.refuse(table.position(row, taken[0]), f"the place of {name}")
    _fill_outline(fill, name, shape, source)
    for side, value in zip(SIDES, _sides(shape), strict=True):
        if value is not None or side in taken:
            shown = None if value is None else table.number(side, value)
            fill.cells |= table.cells(row, {side: shown})


def _take_out(fill: _Fill, name: str) -> None:
    """Empty the rows of an array or an object that is not drawn any more, and those beside it."""
    lost = []
    for key, columns in _NAMED.items():
        if is_absent(fill.book, SECTION[key]):
            continue
        table = GrowingTable.of(fill.book, key)
        for row in {row for column in columns for row in table.rows(column, name)}:
            is_drawn = key == "clearances" and table.cell(row, "source").shown == DRAWING
            typed = "" if key == "outlines" or is_drawn else _typed(table, row, set())
            if typed:
                lost.append(f"{table.position(row, columns[0]).address}: {typed}")
            fill.cells |= table.cells(row, dict.fromkeys(table.found.columns))
    if lost:
        fill.said.append(f"taken out with {name}: {'; '.join(lost)}")


def _typed(table: GrowingTable, row: int, drawn: set[str]) -> str:
    """Return what the cells of a row say but for its name, its place and what is drawn."""
    names = [name for name in table.found.columns if not table.cell(row, name).is_blank]
    passed = {"id", "place_from", *SIDES, *drawn}
    return ", ".join(_entered(table, row, name) for name in names if name not in passed)


def _entered(table: GrowingTable, row: int, name: str) -> str:
    """Return a cell in words, such as `height 36 in`."""
    label, unit = table.section.entry(name).spoken, table.found.columns[name].unit
    return f"{label} {table.cell(row, name).shown} {unit}".strip()


def _is_same_size(was: Shape, now: Shape) -> bool:
    sizes = zip(sorted(own_axes(was)[:2]), sorted(own_axes(now)[:2]), strict=True)
    is_same_area = math.isclose(was.area_m2, now.area_m2, rel_tol=0.01)
    return is_same_area and all(abs(a - b) < SAME_M for a, b in sizes)


def _sides(shape: Shape) -> tuple[float | None, ...]:
    if isinstance(shape, Rectangle):
        return shape.x_from_m, shape.x_to_m, shape.y_from_m, shape.y_to_m
    return (None,) * len(SIDES)


def _fill_roof(fill: _Fill, shape: Shape) -> None:
    section = SECTION["roof"]
    _fill_outline(fill, ROOF, shape, DRAWING)
    if isinstance(shape, Polygon) and is_absent(fill.book, section):
        return
    for side, value in zip(SIDES, _sides(shape), strict=True):
        position = find_cell(fill.book, section, section.entry(side))
        si = cell_as_column(fill.book, section, section.entry(side), position).si
        is_blank = found_at(fill.book, position).is_blank
        if not is_blank:
            fill.refuse(position, "the place of the roof")
        if value is not None or not is_blank:
            fill.cells[position] = None if value is None else round(value / si, DIGITS)


def _fill_layers(fill: _Fill, layers: Mapping[str, LayerKind]) -> None:
    if not layers or is_absent(fill.book, SECTION["layers"]):
        return
    table = GrowingTable.of(fill.book, "layers")
    for layer, kind in layers.items():
        for row in table.rows("layer", layer) or [table.added()]:
            fill.cells |= table.cells(row, {"layer": layer, "kind": kind.value})


def _fill_outline(fill: _Fill, name: str, shape: Shape, source: str) -> None:
    """Fill in the outline of a place below the others, and clear a former one."""
    points = shape.points if isinstance(shape, Polygon) else ()
    table = fill.outlines
    if table is None:
        fill.lacking += [name] if points else []
        return
    rows = table.rows("name", name)
    if rows:
        fill.refuse(table.position(rows[0], "name"), f"the place of {name}")
    for row in rows:
        fill.cells |= table.cells(row, dict.fromkeys(table.found.columns))
    for x, y in points:
        place_m = {"x_m": table.number("x_m", x), "y_m": table.number("y_m", y)}
        values = {"name": name, **place_m, "source": source or None}
        fill.cells |= table.cells(table.added(), values)
