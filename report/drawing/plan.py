"""The roof plan as lines, texts and dimensions on layers, in the plan unit of the workbook.

Pure data from an assessment, with no file format (`report.drawing.dxf`). Read `plan_drawing` first.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from dataclasses import replace

from report.assessment.arrays import NOT_PERMITTED, ArrayAssessment
from report.assessment.envelopes import (
    Outline,
    design_envelope,
    keep_clear_m,
    keep_clear_mark,
    keep_clear_words,
    runs_envelope,
)
from report.assessment.neighbors import EDGES, bare_edges
from report.assessment.plan_gaps import PlanGap, parapet_note, plan_gaps
from report.assessment.project import Assessment
from report.assessment.verdict import Verdict
from report.drawing.dimensions import provided_words
from report.drawing.layers import Layer, PlanDrawing, PlanLine, PlanText
from report.drawing.placed import PlacedTexts
from report.drawing.sheet import Gap, unit_format
from report.sheet.schema.choices import ObjectKind
from report.sheet.schema.scene import ROOF
from report.sheet.schema.shapes import Point, Polygon, Rectangle, around
from report.words.units import Quantity, compared_pairs, no_less, number, pair

TEXT_SHARE = 1.0 / 170.0
"""Height of texts, as a share of the larger side of the plan."""
_LINE = 1.8  # from a line of a list to the next, in heights of texts


def plan_drawing(assessment: Assessment) -> PlanDrawing:
    """Return the plan of an assessment."""
    is_feet = assessment.project.us_first
    unit = Quantity.PLAN.us if is_feet else Quantity.PLAN.si
    drawn = tuple(outlines(assessment))
    extent = around(Polygon(line.points) for line in drawn)
    sides_m = (extent.x_to_m - extent.x_from_m, extent.y_to_m - extent.y_from_m)
    placed = PlacedTexts(height_m=max(sides_m) * TEXT_SHARE, unit_m=unit.si)
    for line in drawn:
        placed.keep_off(line)
    _place(assessment, placed, extent)
    height = placed.height_m / unit.si
    corner = (placed.right + 4.0 * height, extent.y_to_m / unit.si)
    arrow, letter = _north(assessment, corner, height)
    below = (corner[0], corner[1] - 24.0 * height)
    lines = tuple(
        replace(line, points=tuple((x / unit.si, y / unit.si) for x, y in line.points))
        for line in drawn
    )
    return PlanDrawing(
        is_feet=is_feet,
        height=height,
        lines=(*lines, *placed.leaders, *arrow),
        texts=(*placed.texts, letter, *_listed(assessment, placed.left, below, height)),
        dimensions=tuple(placed.dimensions),
    )


def _closed(layer: Layer, name: str, points: Outline) -> PlanLine:
    return PlanLine(layer=layer, name=name, points=points, is_closed=True)


_OBJECTS = dict.fromkeys(ObjectKind, Layer.OBJECT) | {
    ObjectKind.EDGE_WITH_PARAPET: Layer.PARAPET,
    ObjectKind.EDGE_WITHOUT_PARAPET: Layer.EDGE,
    ObjectKind.UNLIKE_ARRAY: Layer.UNLIKE,
}
_ENVELOPES: Mapping[Layer, Callable[[ArrayAssessment], Outline]] = {
    Layer.DESIGN: design_envelope,
    Layer.RUNS: runs_envelope,
}


def outlines(
    assessment: Assessment, envelopes: Collection[Layer] = tuple(_ENVELOPES)
) -> Iterator[PlanLine]:
    """Yield what is on the plan, and how far it may move, by the envelopes asked for [m]."""
    data = assessment.project
    if data.roof.placed is not None:
        yield _closed(Layer.OUTLINE, ROOF, data.roof.placed.points)
    for edge in bare_edges(data):
        yield PlanLine(layer=Layer.BARE_EDGE, name=edge.name, points=edge.ends, is_closed=False)
    for item in data.objects:
        if item.placed is not None:
            yield _closed(_OBJECTS[item.kind], item.id, item.placed.points)
    for array in assessment.arrays:
        yield _closed(Layer.ARRAY, array.id, array.array.shape.points)
        for layer in envelopes:
            if outline := _ENVELOPES[layer](array):
                yield _closed(layer, array.id, outline)


_LAYERS = {
    Verdict.OK: Layer.CLEARANCE,
    Verdict.NG: Layer.CLEARANCE_NG,
    Verdict.NONE: Layer.CLEARANCE_NONE,
}


def _place(assessment: Assessment, placed: PlacedTexts, extent: Rectangle) -> None:
    """Name the arrays, dimension the gaps, and name the edges and the other objects."""
    for array in assessment.arrays:
        placed.name(Layer.ARRAY, array.id, array.id, array.array.shape)
    gaps = [Gap(gap, *map(placed.paper.at, gap.ends)) for gap in plan_gaps(assessment)]
    for gap in gaps:
        placed.paper.placer.take_segment(gap.a, gap.b)
    fmt = unit_format(assessment)
    for gap in gaps:
        name = f"{gap.of.array} to {gap.of.other}"
        number = gap.of.number or "not given"
        words = f"{number}: {provided_words(gap.of, fmt)}" + (" NG" if gap.of.is_ng else "")
        placed.dimension(_LAYERS[gap.of.verdict], name, words, gap)
    for item in sorted(assessment.project.objects, key=lambda item: item.kind not in EDGES):
        if item.placed is None:
            continue
        words = item.id
        if item.height_m is not None:
            words += f", height {fmt.short(item.height_m, Quantity.SIZE)}"
        words += parapet_note(assessment, item)
        if item.kind in EDGES:
            placed.name_edge(_OBJECTS[item.kind], item.id, words, item.placed, extent)
        else:
            placed.name(_OBJECTS[item.kind], item.id, words, item.placed)


def _listed(
    assessment: Assessment, left: Sequence[tuple[str, str]], corner: Point, height: float
) -> Iterator[PlanText]:
    """Yield a list of the arrays and of the gaps beside the plan, and of what has no room in it."""
    us_first = assessment.project.us_first
    rows = [
        *((Layer.NOTES, *row) for row in left),
        (Layer.NOTES, "", "ARRAYS"),
        *((Layer.NOTES, "", array_words(assessment, array)) for array in assessment.arrays),
        (Layer.NOTES, "", "CLEARANCES"),
        *((_LAYERS[gap.verdict], "", gap_words(gap, us_first)) for gap in plan_gaps(assessment)),
    ]
    for count, (layer, of, words) in enumerate(rows):
        at = (corner[0], corner[1] - _LINE * height * count)
        yield PlanText(layer=layer, words=words, at=at, of=of, is_left=True)


def gap_words(gap: PlanGap, us_first: bool) -> str:
    """Return what a gap says, numbered as in the workbook, in both systems of units."""
    required, provided = compared_pairs(gap.required_m, gap.provided_m, Quantity.SIZE, us_first)
    required = "no value" if math.isnan(gap.required_m) else required + _by(gap.mark)
    verdict = "no verdict" if gap.verdict is Verdict.NONE else gap.verdict.value
    between = f"{gap.array} to {gap.other}"
    start = f"{gap.number}: {between}: provided {provided}"
    if not gap.is_given:
        start = f"{between}: no clearance given: {provided} in plan"
    return f"{start}, required {required}, {verdict}"


def array_words(assessment: Assessment, array: ArrayAssessment) -> str:
    """Return how far an array moves, what is kept clear of it, and how the roof slopes."""
    us_first = assessment.project.us_first
    if math.isnan(array.permitted_m):
        what = NOT_PERMITTED if array.has_unpermitted_value else "no value"
        return f"{array.id}: design displacement: {what}"
    design = pair(array.design_m, Quantity.SIZE, us_first, no_less)
    keep = keep_clear_words(keep_clear_m(assessment, array), us_first)
    slope = number(math.degrees(array.array.slope_rad), 2).replace("−", "-")
    return (
        f"{array.id}: design displacement {design}{_by(array.design_mark)}; "
        f"{keep}{_by(keep_clear_mark(assessment, array))}; no conduit; "
        f"slope {slope} deg, downslope {array.array.downslope_deg:.0f} deg"
    )


def _by(mark: str) -> str:
    """Return the mark of an override in words: the fonts of a CAD program may lack it."""
    return " (overridden)" if mark else ""


def _north(
    assessment: Assessment, corner: Point, height: float
) -> tuple[tuple[PlanLine, ...], PlanText]:
    """Return the north arrow and its letter, to the right of a point and below it."""
    x, y = corner[0] + 12.0 * height, corner[1] - 12.0 * height
    turn = math.radians(assessment.project.roof.north_deg)
    dx, dy = (8.0 * height * f(turn) for f in (math.cos, math.sin))
    tip = (x + dx, y + dy)
    barbs = [(x + 0.7 * dx - side * 0.15 * dy, y + 0.7 * dy + side * 0.15 * dx) for side in (1, -1)]
    arrow = tuple(
        PlanLine(layer=Layer.NORTH, name="north", points=ends, is_closed=False)
        for ends in (((x, y), tip), (barbs[0], tip, barbs[1]))
    )
    beyond = x + 10.0 * height * math.cos(turn), y + 10.0 * height * math.sin(turn)
    return arrow, PlanText(layer=Layer.NORTH, words="N", at=beyond)
