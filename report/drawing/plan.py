"""The roof plan as lines and texts on layers, in the plan unit of the workbook.

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
from report.assessment.neighbors import bare_edges
from report.assessment.plan_gaps import PlanGap, parapet_note, plan_gaps
from report.assessment.project import Assessment
from report.assessment.verdict import Verdict
from report.drawing.layers import Layer, PlanDrawing, PlanLine, PlanText
from report.sheet.schema.choices import ObjectKind
from report.sheet.schema.scene import ROOF
from report.sheet.schema.shapes import Point, label_point, mean
from report.words.units import Quantity, Unit, compared_pairs, no_less, number, pair

TEXT_SHARE = 1.0 / 120.0
"""Height of texts, as a share of the larger side of the plan."""


def plan_drawing(assessment: Assessment) -> PlanDrawing:
    """Return the plan of an assessment."""
    is_feet = assessment.project.us_first
    unit = Quantity.PLAN.us if is_feet else Quantity.PLAN.si
    lines = tuple(
        replace(line, points=tuple(_in(point, unit) for point in line.points))
        for line in (*outlines(assessment), *_gap_lines(assessment))
    )
    points = [point for line in lines for point in line.points]
    spans = [max(axis) - min(axis) for axis in zip(*points, strict=True)]
    height = max(spans) * TEXT_SHARE
    texts = tuple(_texts(assessment, unit, height, is_feet))
    arrow, letter = _north(assessment, points, height)
    return PlanDrawing(is_feet=is_feet, lines=lines + arrow, texts=(*texts, letter))


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


def _gap_lines(assessment: Assessment) -> Iterator[PlanLine]:
    for gap in plan_gaps(assessment):
        name = f"{gap.array} to {gap.other}"
        yield PlanLine(layer=_LAYERS[gap.verdict], name=name, points=gap.ends, is_closed=False)


def gap_words(gap: PlanGap, us_first: bool) -> str:
    """Return what a gap says, numbered as in the workbook, in both systems of units."""
    required, provided = compared_pairs(gap.required_m, gap.provided_m, Quantity.SIZE, us_first)
    required = "no value" if math.isnan(gap.required_m) else required + _by(gap.mark)
    verdict = "no verdict" if gap.verdict is Verdict.NONE else gap.verdict.value
    start = f"{gap.number}: provided {provided}"
    if not gap.is_given:
        start = f"no clearance given: {provided} in plan"
    return f"{start}, required {required}, {verdict}"


def _texts(assessment: Assessment, unit: Unit, height: float, us_first: bool) -> Iterator[PlanText]:
    for item in assessment.project.objects:
        if item.placed is not None:
            words = item.id
            if item.height_m is not None:
                words += f", height {pair(item.height_m, Quantity.SIZE, us_first)}"
            words += parapet_note(assessment, item)
            at = _in(label_point(item.placed), unit)
            yield PlanText(layer=_OBJECTS[item.kind], words=words, at=at, height=height)
    for array in assessment.arrays:
        x, y = _in(label_point(array.array.shape), unit)
        yield PlanText(layer=Layer.ARRAY, words=array.id, at=(x, y), height=height)
        for count, words in enumerate(_array_notes(assessment, array, us_first), start=1):
            at = (x, y - 1.6 * height * count)
            yield PlanText(layer=Layer.NOTES, words=words, at=at, height=height)
    for gap in plan_gaps(assessment):
        at, words = _in(mean(gap.ends), unit), gap_words(gap, us_first)
        yield PlanText(layer=_LAYERS[gap.verdict], words=words, at=at, height=0.7 * height)


def _array_notes(assessment: Assessment, array: ArrayAssessment, us_first: bool) -> Iterator[str]:
    if math.isnan(array.permitted_m):
        what = NOT_PERMITTED if array.has_unpermitted_value else "no value"
        yield f"design displacement: {what}"
        return
    design = pair(array.design_m, Quantity.SIZE, us_first, no_less)
    yield f"design displacement {design}{_by(array.design_mark)}"
    keep = keep_clear_words(keep_clear_m(assessment, array), us_first)
    yield f"{keep}{_by(keep_clear_mark(assessment, array))}; no conduit"
    slope = number(math.degrees(array.array.slope_rad), 2).replace("−", "-")
    yield f"slope {slope} deg, downslope {array.array.downslope_deg:.0f} deg"


def _by(mark: str) -> str:
    """Return the mark of an override in words: the fonts of a CAD program may lack it."""
    return " (overridden)" if mark else ""


def _in(point: Point, unit: Unit) -> Point:
    return point[0] / unit.si, point[1] / unit.si


def _north(
    assessment: Assessment, points: Sequence[Point], height: float
) -> tuple[tuple[PlanLine, ...], PlanText]:
    """Return the north arrow and its letter: to the right of the plan, at the top."""
    x, y = max(x for x, _ in points) + 12.0 * height, max(y for _, y in points) - 8.0 * height
    turn = math.radians(assessment.project.roof.north_deg)
    dx, dy = (8.0 * height * f(turn) for f in (math.cos, math.sin))
    tip = (x + dx, y + dy)
    barbs = [(x + 0.7 * dx - side * 0.15 * dy, y + 0.7 * dy + side * 0.15 * dx) for side in (1, -1)]
    arrow = tuple(
        PlanLine(layer=Layer.NORTH, name="north", points=ends, is_closed=False)
        for ends in (((x, y), tip), (barbs[0], tip, barbs[1]))
    )
    beyond = x + 10.0 * height * math.cos(turn), y + 10.0 * height * math.sin(turn)
    return arrow, PlanText(layer=Layer.NORTH, words="N", at=beyond, height=height)
