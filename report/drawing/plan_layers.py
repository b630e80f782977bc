"""The roof plan as lines, texts and dimensions on layers, in the plan unit of the workbook.

Pure data from an assessment, with no file format (`report.drawing.plan_dxf`). Read `plan_drawing`.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace

from report.assessment.assessment import Assessment
from report.assessment.design.arrays import ArrayAssessment
from report.assessment.design.routes import NOT_PERMITTED
from report.assessment.design.verdict import Verdict
from report.assessment.plan.bare_edges import EDGES, bare_edges
from report.assessment.support.envelopes import Outline, design_envelope, runs_envelope
from report.assessment.support.plan_gaps import (
    PlanGap,
    keep_clear,
    keep_clear_m,
    keep_clear_mark,
    parapet_note,
    plan_gaps,
)
from report.drawing.dimensions import alongside, gap_texts, lane_of
from report.drawing.labels import along_strip
from report.drawing.layers import Layer
from report.drawing.paper_items import TYPE_PT, width_in
from report.drawing.placer import Frame, Placer
from report.drawing.plan_dxf import WINDOW_IN, PlanDimension, PlanDrawing, PlanLine, PlanText
from report.drawing.sheet import LINE_IN, PAD_IN, Gap, Paper, Scale, round_scale, unit_format
from report.project.model.choices import ObjectKind
from report.project.model.roof import ROOF
from report.project.model.shapes import Point, Polygon, Rectangle, Shape, around, room, sides
from report.provenance.package_sources import fingerprint
from report.text.amounts import capacity, compared_pairs, demand
from report.text.units import Quantity, no_less, number, pair

_CAP_IN = 0.66 * TYPE_PT / 72.0  # height of a capital
_WIDER = 1.2  # than in the font of the pictures: a CAD program may replace its own one
_PAGE = Frame(-math.inf, -math.inf, math.inf, math.inf)


@dataclass(slots=True)
class PlacedTexts:
    """The texts of a plan placed so far, on paper at print size."""

    height_m: float  # of the texts
    unit_m: float  # size of the unit of the drawing
    texts: list[PlanText] = field(default_factory=list)
    dimensions: list[PlanDimension] = field(default_factory=list)
    leaders: list[PlanLine] = field(default_factory=list)
    left: list[tuple[str, str]] = field(default_factory=list)  # ids, numbered names without room
    paper: Paper = field(init=False)

    def __post_init__(self) -> None:
        scale = Scale("", self.height_m / _CAP_IN)
        self.paper = Paper(math.inf, math.inf, scale, (0.0, 0.0), Placer(_PAGE))

    @property
    def right(self) -> float:
        """The right end of everything drawn."""
        return self._drawn((self.paper.placer.right, 0.0))[0]

    def keep_off(self, line: PlanLine) -> None:
        """Let no text touch a line [m], or touch an envelope only if there is no other room."""
        placer = self.paper.placer
        mark = placer.wall if line.layer is Layer.ARRAY else placer.avoid
        for frame in self.paper.sides(line.points):
            mark(frame)
        if line.layer not in (Layer.DESIGN, Layer.RUNS):
            for ends in sides(tuple(map(self.paper.at, line.points))):
                placer.take_segment(*ends)

    def name(self, layer: Layer, id: str, words: str, shape: Shape, further: str = "") -> None:
        """Name a shape inside or next to it with a leader, or else by a number in the list.

        The text of `further` is placed where it fits.
        """
        inner, key = self.paper.frame(room(shape)), f"({len(self.left) + 1})"
        for text in dict.fromkeys((words + further, words, key)):
            label = self.paper.placer.place(*_size(text), inner.middle, inner)
            if not label and further and text == words + further:
                continue
            label = label or self._beside(id, text, inner.middle)
            if label:
                self._write(layer, id, text, label)
                break
        if not label or text is key:
            # Listed below the drawing: every array and object is named, whatever the room.
            self.left.append((id, f"{key} {words}"))

    def _beside(self, id: str, words: str, start: Point) -> Frame | None:
        """Return a position near a point, with a leader to it; None if there is none."""
        label = self.paper.placer.place(*_size(words), start)
        if label:
            ends = start, label.nearest(start)
            self.paper.placer.take_segment(*ends)
            points = tuple(map(self._drawn, ends))
            leader = PlanLine(layer=Layer.NOTES, name=id, points=points, is_closed=False)
            self.leaders.append(leader)
        return label

    def name_edge(self, layer: Layer, id: str, words: str, shape: Shape, roof: Rectangle) -> None:
        """Name a roof edge along it, outside of the roof."""
        middle = self.paper.frame(roof).middle
        label, is_upright = along_strip(self.paper.frame(shape.bounds), middle, _size(words)[0])
        if isinstance(shape, Rectangle) and self.paper.placer.take_first([label]) is not None:
            self._write(layer, id, words, label, is_upright)
        else:
            self.name(layer, id, words, shape)

    def dimension(self, layer: Layer, name: str, words: str, gap: Gap) -> None:
        """Dimension a gap with its text next to the line, or else with a leader."""
        lane, tall = lane_of(self.paper, gap), 1.5 * _CAP_IN
        # As wide as the library takes it, which interrupts the line behind it.
        long = max(_CAP_IN * len(words) + PAD_IN, _size(words)[0])
        shifts = [*alongside(lane, long, 0.0), *alongside(lane, long, long)]
        frames = [lane.frame(shift, long, tall) for shift in shifts]
        within = [lane.frame(shift, long, min(lane.narrow, tall)) for shift in shifts]
        taken = self.paper.placer.take_first(frames, within)
        label = self.paper.placer.place(long, tall, gap.middle) if taken is None else frames[taken]
        self.dimensions.append(
            PlanDimension(
                layer=layer,
                name=name,
                ends=(self._drawn(gap.a), self._drawn(gap.b)),
                words=words if label else "",
                at=self._drawn(label.middle if label else gap.middle),
                is_upright=taken is not None and lane.is_upright,
                has_leader=taken is None and label is not None,
            )
        )

    def _write(
        self, layer: Layer, id: str, words: str, label: Frame, is_upright: bool = False
    ) -> None:
        center = self._drawn(label.middle)
        text = PlanText(layer=layer, words=words, at=center, of=id, is_upright=is_upright)
        self.texts.append(text)

    def _drawn(self, point: Point) -> Point:
        unit_in = self.unit_m / self.paper.scale.m_per_in
        return point[0] / unit_in, point[1] / unit_in


def _size(words: str) -> Point:
    return _WIDER * width_in(words) + 2 * PAD_IN, LINE_IN


# Height of texts, as a share of the larger side of the plan: a roof of any size is read alike.
TEXT_SHARE = 1.0 / 170.0
_LINE = 1.8  # from a line of a list to the next, in heights of texts


def plan_drawing(assessment: Assessment) -> PlanDrawing:
    """Return the plan of an assessment."""
    is_feet = assessment.project.us_first
    unit = Quantity.PLAN.us if is_feet else Quantity.PLAN.si
    # Texts are as tall as the plan asks for, so all lines come first.
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
    rules, tables, foot = _schedules(assessment, placed.left, below, height)
    lines = tuple(
        replace(line, points=tuple((x / unit.si, y / unit.si) for x, y in line.points))
        for line in drawn
    )
    texts = (*placed.texts, letter, *tables)
    ends = [text.at[0] + _wide(text.words, height) for text in tables if text.is_left]
    for line in (*lines, *rules):
        ends += [x for x, _ in line.points]
    fringe = 8.0 * height  # names of edges are outside of the roof
    low = extent.x_from_m / unit.si - fringe, min(foot, extent.y_from_m / unit.si - fringe)
    high = max(ends) + height, extent.y_to_m / unit.si + fringe
    long_in, tall_in = WINDOW_IN
    # The window of the layout shows all of it, and at a scale that is on a scale ruler.
    min_scale = max((high[0] - low[0]) / long_in, (high[1] - low[1]) / tall_in) * unit.si
    scale = round_scale(min_scale, is_feet)
    return PlanDrawing(
        is_feet=is_feet,
        height=height,
        lines=(*lines, *placed.leaders, *arrow, *rules),
        texts=texts,
        dimensions=tuple(placed.dimensions),
        title=(*title_block(assessment), ("SCALE", scale.name)),
        middle=((low[0] + high[0]) / 2, (low[1] + high[1]) / 2),
        per_in=scale.m_per_in / unit.si,
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
    """Yield the items on the plan and the requested envelopes of their displacement [m]."""
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
    fmt = unit_format(assessment)
    for array in assessment.arrays:
        moves = NOT_PERMITTED if array.has_unpermitted_value else "no value"
        if not math.isnan(array.permitted_m):
            moves = fmt.short(array.design_m, Quantity.SIZE, no_less)
        displacement = f": displacement {moves}"
        placed.name(Layer.ARRAY, array.id, array.id, array.array.shape, displacement)
    gaps = [Gap(gap, *map(placed.paper.at, gap.ends)) for gap in plan_gaps(assessment)]
    for gap in gaps:
        # All lines are reserved before the first text, which could lie over the next one.
        placed.paper.placer.take_segment(gap.a, gap.b)
    for gap in gaps:
        name = f"{gap.of.array} to {gap.of.other}"
        number = gap.of.number or "not entered"
        words = f"{number}: {gap_texts(gap.of, fmt)[0]}" + (" NG" if gap.of.is_ng else "")
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


def _table(
    heads: Sequence[str], rows: Sequence[tuple[Layer, Sequence[str]]], corner: Point, height: float
) -> tuple[list[PlanLine], list[PlanText], Point]:
    """Return a ruled table below a point as lines and texts, and the point below it."""
    cells = [(Layer.SCHEDULE, heads), *rows]
    columns = zip(*(texts for _, texts in cells), strict=True)
    wide = [max(_wide(text, height) for text in texts) for texts in columns]
    lefts = [corner[0] + sum(wide[:k]) for k in range(len(wide) + 1)]
    tops = [corner[1] - _LINE * height * k for k in range(len(cells) + 1)]
    rules = [((lefts[0], y), (lefts[-1], y)) for y in tops]
    rules += [((x, tops[0]), (x, tops[-1])) for x in lefts]
    lines = [
        PlanLine(layer=Layer.SCHEDULE, name="", points=ends, is_closed=False) for ends in rules
    ]
    texts = []
    for (layer, row), y in zip(cells, tops[:-1], strict=True):
        for text, x in zip(row, lefts[:-1], strict=True):
            start = (x + 0.5 * height, y - 0.9 * height)
            texts.append(PlanText(layer=layer, words=text, at=start, is_left=True))
    return lines, texts, (corner[0], tops[-1] - 2.0 * _LINE * height)


def _wide(text: str, height: float) -> float:
    """Return the width of a column with a text, in the unit of the height of its letters."""
    return (_WIDER * width_in(text) / _CAP_IN + 1.0) * height


def _schedules(
    assessment: Assessment, unplaced: Sequence[tuple[str, str]], corner: Point, height: float
) -> tuple[list[PlanLine], list[PlanText], float]:
    """Return the title of the drawing, and the arrays and gaps as tables; the lowest y."""
    us_first, (x, y), step = assessment.project.us_first, corner, _LINE * height
    notes = [*(("", f"{head}: {text}") for head, text in title_block(assessment)), *unplaced]
    texts = [
        PlanText(layer=Layer.NOTES, words=words, at=(x, y - k * step), of=id, is_left=True)
        for k, (id, words) in enumerate(notes)
    ]
    lines: list[PlanLine] = []
    corner_below = (x, y - step * (len(notes) + 1))
    arrays = [(Layer.SCHEDULE, array_cells(assessment, array)) for array in assessment.arrays]
    gaps = [(_LAYERS[gap.verdict], gap_cells(gap, us_first)) for gap in plan_gaps(assessment)]
    for heads, rows in ((_OF_ARRAYS, arrays), (_OF_GAPS, gaps)):
        ruled, words, corner_below = _table(heads, rows, corner_below, height)
        lines += ruled
        texts += words
    return lines, texts, corner_below[1]


_OF_ARRAYS = (
    "ARRAY", "DESIGN DISPLACEMENT", "KEEP CLEAR, NO CONDUIT", "SLOPE", "DOWNSLOPE", "VERDICT",
)  # fmt: skip
_OF_GAPS = ("CLEARANCE", "BETWEEN", "PROVIDED", "REQUIRED", "VERDICT")


def title_block(assessment: Assessment) -> Sequence[tuple[str, str]]:
    """Return the identification of the drawing, each item with its heading."""
    project = assessment.project.project
    return (
        ("PROJECT", f"{project.number} {project.name}"),
        ("REVISION", project.revision),
        ("DATE", str(project.date)),
        ("BY", project.prepared_by),
        ("HASH OF THE CALCULATION", fingerprint(assessment.source, assessment.shaking)),
        ("VERDICT", assessment.verdict.value),
    )


def gap_cells(gap: PlanGap, us_first: bool) -> Sequence[str]:
    """Return the row of a gap, numbered as in the workbook, in both systems of units."""
    provided, required = compared_pairs(
        capacity(gap.provided_m), demand(gap.required_m), Quantity.SIZE, us_first
    )
    required = "no value" if math.isnan(gap.required_m) else required + _by(gap.mark)
    number = str(gap.number) if gap.is_given else "not entered"
    verdict = "no verdict" if gap.verdict is Verdict.NONE else gap.verdict.value
    return number, f"{gap.array} to {gap.other}", provided, required, verdict


def array_cells(assessment: Assessment, array: ArrayAssessment) -> Sequence[str]:
    """Return the row of an array: displacement, keep-clear distance and slope."""
    us_first, verdict = assessment.project.us_first, assessment.array_verdict(array).value
    # The fonts of a CAD program may lack the true minus sign.
    slope = number(math.degrees(array.array.slope_rad), 2).replace("−", "-")
    turned = (f"{slope} deg", f"{array.array.downslope_deg:.0f} deg", verdict)
    if math.isnan(array.permitted_m):
        reason = NOT_PERMITTED if array.has_unpermitted_value else "no value"
        return array.id, reason, "no value", *turned
    design = pair(array.design_m, Quantity.SIZE, us_first, no_less) + _by(array.overridden.design)
    keep = keep_clear(keep_clear_m(assessment, array), us_first)
    return array.id, design, keep + _by(keep_clear_mark(assessment, array)), *turned


def _by(mark: str) -> str:
    # The fonts of a CAD program may lack the mark.
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
