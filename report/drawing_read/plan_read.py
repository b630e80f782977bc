"""Interprets a roof drawing as a plan: arrays, objects, edges and the roof, by layer and name.

Knows no file and no cells (`report.drawing_read.read_dxf`, `report.drawing_read.fill`). Read
`plan_of` first.
"""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace

import shapely

from report.assessment.plan.bare_edges import EDGE_STRIP_M, bare_sides
from report.drawing.layers import Layer
from report.drawing_read.geometry import ROUNDED_M, box_of, boxed, own_axes
from report.drawing_read.heights import ABOVE_ROOF, first_height, read_line
from report.drawing_read.modules import GAP_M, MOST_TEXTS, SIDES_M, joined
from report.drawing_read.plan_as_drawn import RoofPlan
from report.drawing_read.roof_drawing import DrawnOutline, RoofDrawing, Unread, Words
from report.project.check.finding_lines import listed
from report.project.check.plan_shapes import LEAST_VERTICES
from report.project.model.choices import LayerKind
from report.project.model.shapes import Point, Polygon, Rectangle, Shape, crossing, ring, solid
from report.text.units import LENGTHS, Quantity, pair
from solver.errors import InputError

_READ: Mapping[Layer, LayerKind] = {
    Layer.OUTLINE: LayerKind.ROOF,
    Layer.EDGE: LayerKind.EDGE_WITHOUT_PARAPET,
    Layer.PARAPET: LayerKind.EDGE_WITH_PARAPET,
    Layer.ARRAY: LayerKind.ARRAY,
    Layer.UNLIKE: LayerKind.UNLIKE_ARRAY,
    Layer.OBJECT: LayerKind.FIXED,
}
# Names of version 0.3, whose plans are read as they were.
_FORMER = (
    "ROOF-OUTLINE", "ROOF-EDGE", "ROOF-PARAPET", "ROOF-EDGE-NOT-GIVEN", "ARRAY", "ARRAY-UNLIKE",
    "OBJECT", "CLEARANCE", "CLEARANCE-NG", "CLEARANCE-NO-VERDICT", "ENVELOPE-DESIGN",
    "ENVELOPE-RUNS", "NOTES", "NORTH",
)  # fmt: skip
# What is drawn on the layers of the plan that `report` writes.
LAYERS: Mapping[str, LayerKind] = {
    **{layer.title: _READ.get(layer, LayerKind.NOT_READ) for layer in Layer if layer.title},
    **{
        former: _READ.get(layer, LayerKind.NOT_READ)
        for layer, former in zip(Layer, _FORMER, strict=False)
    },
}

# As an ID of the workbook, which a name becomes.
MAX_NAME = 40
LEAST_AREA_M2 = 1e-3

# Length of a side [m] beside which rounding is nothing.
LONG_M = 0.1
# Largest distance [m] between two outlines that are one drawn twice.
TWICE_M = 0.005
# Least and largest length [m] that most have: a roof; an array, which fire codes end at 150 ft; a
# unit on the roof. Least area of an array [m2]: of one module.
USUAL_M: Mapping[LayerKind, tuple[float, float]] = {
    LayerKind.ROOF: (20.0 * LENGTHS["ft"], 1_000.0),
    LayerKind.ARRAY: (LENGTHS["ft"], 100.0),
    LayerKind.UNLIKE_ARRAY: (LENGTHS["ft"], 100.0),
    LayerKind.FIXED: (LENGTHS["ft"], 60.0 * LENGTHS["ft"]),
}
LEAST_ARRAY_M2 = 2.0

_STEMS = {LayerKind.ARRAY: "A", LayerKind.FIXED: "OBJ-", LayerKind.UNLIKE_ARRAY: "PV-"}


def plan_of(
    drawing: RoofDrawing,
    unit_m: float,
    layers: Mapping[str, LayerKind],
    gap_m: float = GAP_M,
    us_first: bool = True,
) -> RoofPlan:
    """Return the plan of a drawing in a unit [m].

    What is drawn on layers is given in addition to `LAYERS`, without regard to capitals, and so is
    the largest gap between modules of one array [m]. Heights are noted in US units first or not.
    """
    kinds = known_layers(layers)
    passed = LayerKind.NOT_READ
    unread = [item for item in drawing.unread if kinds.get(item.layer.casefold()) is not passed]
    outlines: list[DrawnOutline] = []

    def take(line: DrawnOutline, unit_m: float) -> None:
        shape = _shape(line, unit_m)
        if isinstance(shape, Unread):
            unread.append(shape)
        else:
            outlines.append(replace(line, shape=shape))

    for line in drawing.lines:
        kind = kinds.get(line.layer.casefold())
        if kind is None:
            unread.append(
                _unread(line, "a closed line on a layer that is not on the Layers worksheet")
            )
        elif kind is not passed:
            take(replace(line, kind=kind), unit_m)
    outlines, arrays, overlapped = joined(outlines, gap_m, drawing.turned_deg)
    reason = "a closed line within or around an array of modules"
    unread += [_unread(line, reason) for line in overlapped]
    for array in arrays:
        take(array, 1.0)
    places = _named(_once(outlines, unread), drawing.texts, unit_m, unread, us_first)
    roofs = sorted((p for p in places if p.kind is LayerKind.ROOF), key=lambda p: -p.shape.area_m2)
    for extra in roofs[1:]:
        unread.append(Unread(handle=extra.handle, layer=extra.layer, reason="a second roof"))
    objects = [p for p in places if p.kind not in (LayerKind.ROOF, LayerKind.ARRAY)]
    is_ours = any(line.is_ours for line in outlines if line.kind is LayerKind.ROOF)
    # A plan of ours has its edges drawn: none is to be guessed.
    if roofs and not is_ours:
        objects += _edges(roofs[0].shape, objects)
    return RoofPlan(
        roof=tuple(roofs[:1]),
        arrays=tuple(p for p in places if p.kind is LayerKind.ARRAY),
        objects=tuple(objects),
        unread=tuple(unread),
    )


def _once(outlines: Sequence[DrawnOutline], unread: list[Unread]) -> list[DrawnOutline]:
    """Return outlines without those that are drawn over an equal one of their kind."""
    solids = [solid(outline.shape) for outline in outlines]
    twins: set[int] = set()
    near = shapely.STRtree(solids).query(solids, predicate="intersects").T if solids else ()
    # Both orders of a pair are found: the later drawn is the twin.
    for first, second in near:
        is_equal = outlines[first].kind is outlines[second].kind and first < second
        if is_equal and solids[first].hausdorff_distance(solids[second]) <= TWICE_M:
            twins.add(second)
    unread += [_unread(outlines[k], "drawn twice, counted once") for k in sorted(twins)]
    return [outline for k, outline in enumerate(outlines) if k not in twins]


def check_size(plan: RoofPlan, stated: str, us_first: bool = True) -> None:
    """Raise InputError for sizes that few roofs, arrays or units have, with units that would do.

    The drawing was read in the unit that it states.
    """
    places = (*plan.roof, *plan.arrays, *plan.objects)
    sizes = []
    for place in places:
        if not _is_usual(place, 1.0, LEAST_ARRAY_M2):
            wide, tall = (pair(m, Quantity.PLAN, us_first) for m in own_axes(place.shape)[:2])
            name = "the roof" if place.kind is LayerKind.ROOF else place.name
            sizes.append(f"{name} is {wide} by {tall}")
    if not sizes:
        return
    # In another unit the smallest may be modules, which are joined.
    would_do = [
        unit for unit, unit_m in LENGTHS.items()
        if unit != stated
        and all(_is_usual(place, unit_m / LENGTHS[stated], SIDES_M[0] ** 2) for place in places)
    ]  # fmt: skip
    raise InputError(f"{listed(sizes)}, an unusual size; {unit_asked(would_do, stated)}")


def unit_asked(would_do: Sequence[str], stated: str) -> str:
    """Return a question on the unit of a drawing: units that fit, or the stated one."""
    alternatives = f"{' or '.join(would_do)}, or " if would_do else ""
    return (
        f"enter the unit of the drawing (--units, or Unit on the page): {alternatives}{stated} if"
        " it is so, as it states"
    )


def _is_usual(place: DrawnOutline, factor: float, least_array_m2: float) -> bool:
    """Whether a place has a usual size, taken times a factor."""
    long_m = factor * max(own_axes(place.shape)[:2])
    is_array = place.kind in (LayerKind.ARRAY, LayerKind.UNLIKE_ARRAY)
    if is_array and factor**2 * place.shape.area_m2 < least_array_m2:
        return False
    low_m, high_m = USUAL_M.get(place.kind, (0.0, math.inf))
    return low_m - ROUNDED_M <= long_m <= high_m + ROUNDED_M


def known_layers(layers: Mapping[str, LayerKind]) -> dict[str, LayerKind]:
    """Return the types of `LAYERS` and of others, which take precedence, by lowercase name."""
    return {name.casefold(): kind for name, kind in (*LAYERS.items(), *layers.items())}


def _unread(line: DrawnOutline, reason: str, detail: str = "") -> Unread:
    return Unread(handle=line.handle, layer=line.layer, reason=reason, detail=detail)


def _shape(line: DrawnOutline, unit_m: float) -> Shape | Unread:
    """Return the shape of a line [m], or why it has none."""
    scaled = [(x * unit_m, y * unit_m) for x, y in line.shape.points]
    # Most lines are modules, which need no search for vertices in line and for crossings.
    if (module := _clear_box(scaled)) is not None:
        return module
    # Vertices on a straight side are no corners: with them a rectangle is drawn and dimensioned as
    # a polygon.
    straight = shapely.LinearRing(scaled).simplify(ROUNDED_M, preserve_topology=False)
    points = ring([(x, y) for x, y in straight.coords])
    if len(points) < LEAST_VERTICES:
        return _unread(line, "a closed line without an area")
    crossed = crossing(points)
    if crossed is not None:
        x, y = (value / unit_m for value in crossed)
        reason = "a closed line that touches or crosses itself"
        return _unread(line, reason, f"near {x:.6g}, {y:.6g}")
    shape = Polygon(points)
    if shape.area_m2 < LEAST_AREA_M2:
        return _unread(line, "a closed line without an area")
    return boxed(shape)


def _clear_box(points: Sequence[Point]) -> Rectangle | None:
    """Return a closed line as a rectangle, if it is one of four corners with long sides."""
    shape = Polygon(tuple(points))
    box = box_of(shape)
    if box is None or min(box.x_to_m - box.x_from_m, box.y_to_m - box.y_from_m) < LONG_M:
        return None
    return box if shape.area_m2 > 0.99 * box.area_m2 else None  # else it is folded


def _named(
    outlines: Sequence[DrawnOutline],
    texts: Sequence[Words],
    unit_m: float,
    unread: list[Unread],
    us_first: bool,
) -> list[DrawnOutline]:
    """Return outlines with their names: written by `report`, of their block, inside, or new."""
    inside = _texts_inside(outlines, texts, unit_m)
    taken: dict[str, str] = {}
    counts: Counter[LayerKind] = Counter()
    places = []
    written = [_name(line, words, unit_m) for line, words in zip(outlines, inside, strict=True)]
    repeated = Counter(name.casefold() for name in written)
    names = set(repeated)
    for line, words, name in zip(outlines, inside, written, strict=True):
        kind = line.kind
        notes: list[str] = []
        if line.rounded_m:
            step = pair(line.rounded_m, Quantity.SIZE, us_first)
            notes.append(f"of modules whose corners are rounded to {step}")
        unnamed = ""
        if line.sizes and name and repeated[name.casefold()] > 1:
            name = ""  # as of a product
        if kind is LayerKind.ROOF:
            name = "roof"
        elif not name:
            name = free_name(kind, counts, names)
            unnamed = "named in reading order" if line.sizes else "no text inside"
        elif name.casefold() in taken:
            # The first stays: an ID names one row of the workbook.
            detail = f"'{name}' of {taken[name.casefold()]}"
            unread.append(_unread(line, "a second outline of the same name", detail))
            continue
        height_m = math.nan
        if kind is not LayerKind.ROOF:
            taken[name.casefold()] = line.handle
        if kind not in (LayerKind.ROOF, LayerKind.ARRAY):
            height_m = _height_m(line, words, unit_m, notes, unread, us_first)
        note = "; ".join(notes)
        places.append(replace(line, name=name, height_m=height_m, unnamed=unnamed, note=note))
    return places


def free_name(kind: LayerKind, counts: Counter[LayerKind], taken: set[str]) -> str:
    """Return the next name of a kind that is not taken, in lower case."""
    while True:
        counts[kind] += 1
        name = f"{_STEMS.get(kind, 'EDGE-')}{counts[kind]}"
        if name.casefold() not in taken:
            return name


def _by_layer(line: DrawnOutline, words: Sequence[Words]) -> list[Words]:
    """Return the texts inside of a line from the top, those of its layer before the others."""
    return sorted(words, key=lambda text: (text.layer != line.layer, -text.at[1]))


def _name(line: DrawnOutline, words: Sequence[Words], unit_m: float) -> str:
    """Return the name of a line: its own, or the first text inside of it, without a height."""
    if (
        line.sizes
        and len([text for text in words if text.layer == line.layer] or words) > MOST_TEXTS
    ):
        words = []  # they are those of its modules
    names = (read_line(text.text, unit_m)[0] for text in _by_layer(line, words))
    return (line.name or next(filter(None, names), ""))[:MAX_NAME].strip()


def _height_m(
    line: DrawnOutline,
    words: Sequence[Words],
    unit_m: float,
    notes: list[str],
    unread: list[Unread],
    us_first: bool,
) -> float:
    """Return the height [m] that is written at an object, NaN for none, and note how it is read."""
    lines: list[str] = []
    for text in _by_layer(line, words):
        lines += (text.text, *text.others)
    height, unclear = first_height((*line.heights, *lines), unit_m)
    if unclear:
        unread.append(
            _unread(line, "a height that could not be interpreted", f"'{unclear[:MAX_NAME]}'")
        )
    if height is None:
        return math.nan
    notes.append(f"{height.word} {pair(height.value_m, Quantity.SIZE, us_first)}")
    if not height.has_unit:
        notes.append("no unit stated; read in the unit of the drawing")
    if height.word not in ABOVE_ROOF:
        notes.append("assumed to be above the roof")
    return height.value_m


def _texts_inside(
    outlines: Sequence[DrawnOutline], texts: Sequence[Words], unit_m: float
) -> list[list[Words]]:
    """Return the texts of each line: what `report` wrote of it, and what is inside of it."""
    inside: list[list[Words]] = [[] for _ in outlines]
    # A text belongs to the smallest line around it.
    order = sorted(range(len(outlines)), key=lambda k: outlines[k].shape.area_m2)
    tree = shapely.STRtree([solid(outlines[k].shape) for k in order])
    ours = {line.name: k for k, line in enumerate(outlines) if line.is_ours}
    for text in texts:
        if text.of:
            if text.of in ours:
                inside[ours[text.of]].append(text)
            continue
        place = shapely.Point(text.at[0] * unit_m, text.at[1] * unit_m)
        pairs = tree.query(place, predicate="intersects")
        if len(pairs):
            inside[order[min(pairs)]].append(text)
    return inside


def _edges(roof: Shape, objects: Sequence[DrawnOutline]) -> Iterator[DrawnOutline]:
    """Yield the sides of the roof along which no edge is drawn, as strips outside of it."""
    edges = (LayerKind.EDGE_WITH_PARAPET, LayerKind.EDGE_WITHOUT_PARAPET)
    strips = [item.shape for item in objects if item.kind in edges]
    taken = {item.name.casefold() for item in objects}
    counts: Counter[LayerKind] = Counter()
    # Without a parapet the separation is the larger one.
    kind = LayerKind.EDGE_WITHOUT_PARAPET
    for edge in bare_sides(Polygon(roof.points), strips, 90.0):
        name = free_name(kind, counts, taken)
        (x0, y0), (x1, y1) = edge.ends
        # To the right of a side is outside: the outline is counterclockwise.
        long = math.dist(*edge.ends)
        dx, dy = EDGE_STRIP_M * (y1 - y0) / long, EDGE_STRIP_M * (x0 - x1) / long
        strip = Polygon(ring([(x0, y0), (x1, y1), (x1 + dx, y1 + dy), (x0 + dx, y0 + dy)]))
        yield DrawnOutline(name=name, kind=kind, shape=boxed(strip), handle="", layer="",
                           unnamed=edge.name, note="assumed to have no parapet")  # fmt: skip
