"""The roof plan, to scale: what is on the roof, how far it may move, and every clearance.

Draws finished numbers; read `plan_figure` first. `report.drawing` writes the same plan as DXF.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from report.assessment.arrays import ArrayAssessment
from report.assessment.clearances import ClearanceCheck
from report.assessment.envelopes import closest, design_envelope, keep_clear_m, runs_envelope
from report.assessment.neighbors import bare_edges
from report.assessment.project import Assessment
from report.figures.base import GREY, INK, style, svg_text, tick_text
from report.figures.labels import LINE_IN, Frame, centered, width_in
from report.figures.paper_plan import PAD_IN, PlanPaper, Point, around, round_scale, text_size
from report.figures.plan_key import (
    ARRAY,
    BARE,
    DESIGN,
    EDGES,
    FAILED,
    FILLS,
    ROOF,
    RUNS,
    Key,
    Symbol,
    draw_key,
    gap_line,
    ng_box,
    ng_size,
)
from report.sheet.schema import ObjectKind, Rectangle, RoofObject
from report.words.units import Quantity, Show, compared, measured, number, pair
from solver.model import INCH_M

RADIUS_IN = 0.1
ARROW_IN = 0.3
MOST_NAMES = 6
LEADER_IN = 1.5  # farthest label


@dataclass(frozen=True, slots=True, kw_only=True)
class PlanSize:
    """Size of a plan on paper [in].

    Attributes
    ----------
    tall : float
        Greatest height.
    key_wide, key_tall : float
        Of the legend, to the right of the plan, or below it where it is as wide as the paper.
    is_full : bool
        Whether with envelopes, dimensions, legend, notes and coordinates.
    """

    wide: float
    tall: float
    key_wide: float
    key_tall: float
    is_full: bool

    @property
    def is_key_below(self) -> bool:
        """Whether the legend is below the plan."""
        return self.key_wide == self.wide

    @property
    def fringe(self) -> tuple[float, float, float, float]:
        """Margins [in] of the roof: left, right, bottom, top."""
        return (0.62, 0.26, 0.64, 0.26) if self.is_full else (0.24, 0.24, 0.24, 0.24)


SMALL = PlanSize(wide=6.7, tall=2.95, key_wide=2.05, key_tall=0.95, is_full=False)
LANDSCAPE = PlanSize(wide=9.2, tall=5.4, key_wide=2.15, key_tall=5.4, is_full=True)
PORTRAIT = PlanSize(wide=6.7, tall=8.05, key_wide=6.7, key_tall=2.1, is_full=True)


def is_wide(assessment: Assessment) -> bool:
    """Whether the large plan goes on a page in landscape: for a larger scale, or a wide roof."""
    extent, us_first = _extent(assessment), _us_first(assessment)
    flat, tall = (
        round_scale(_needed(extent, size), us_first).m_per_in for size in (LANDSCAPE, PORTRAIT)
    )
    if flat == tall:
        return extent.x_to_m - extent.x_from_m >= extent.y_to_m - extent.y_from_m
    return flat < tall


def roof_plan(assessment: Assessment, size: PlanSize) -> str:
    """Return the plan as SVG, at true scale where it is printed in its own size."""
    with style():
        return svg_text(plan_figure(assessment, size))


def plan_figure(assessment: Assessment, size: PlanSize) -> Figure:
    """Draw the plan at a round scale."""
    extent = _extent(assessment)
    us_first = _us_first(assessment)
    scale = round_scale(_needed(extent, size), us_first)
    left, right, bottom, top = size.fringe
    wide = (extent.x_to_m - extent.x_from_m) / scale.m_per_in
    tall = (extent.y_to_m - extent.y_from_m) / scale.m_per_in
    below = size.key_tall if size.is_key_below else 0.0
    height = max(tall + bottom + top + below, size.key_tall)
    room = size.wide - (0.0 if size.is_key_below else size.key_wide) - left - right
    origin = (
        left + max(room - wide, 0.0) / 2 - extent.x_from_m / scale.m_per_in,
        below + bottom + (height - below - bottom - top - tall) / 2
        - extent.y_from_m / scale.m_per_in,
    )  # fmt: skip
    paper = PlanPaper(size.wide, height, scale, origin)
    plan = _Plan(assessment, size, paper)
    key = Frame(size.wide - size.key_wide, 0.0, size.wide, size.key_tall if below else height)
    paper.placer.take(key)
    plan.draw(extent)
    draw_key(paper, key, _key(plan))
    return paper.figure


def _us_first(assessment: Assessment) -> bool:
    return assessment.project.project.units_first == "US"


def _extent(assessment: Assessment) -> Rectangle:
    """Return what the plan must show, in plan."""
    data = assessment.project
    shapes = [array.rectangle for array in data.arrays]
    shapes += [shape for item in data.objects if (shape := item.rectangle) is not None]
    shapes += [shape] if (shape := data.roof.outline) is not None else []
    return Rectangle(
        min(shape.x_from_m for shape in shapes),
        max(shape.x_to_m for shape in shapes),
        min(shape.y_from_m for shape in shapes),
        max(shape.y_to_m for shape in shapes),
    )


def _needed(extent: Rectangle, size: PlanSize) -> float:
    """Return the least plan length [m] per inch of paper that lets the plan fit."""
    left, right, bottom, top = size.fringe
    wide = size.wide - left - right - (0.0 if size.is_key_below else size.key_wide)
    tall = size.tall - bottom - top - (size.key_tall if size.is_key_below else 0.0)
    return max((extent.x_to_m - extent.x_from_m) / wide, (extent.y_to_m - extent.y_from_m) / tall)


@dataclass(frozen=True, slots=True)
class _Gap:
    """A clearance on the plan, by its number; the ends of its dimension line on paper."""

    number: int
    check: ClearanceCheck
    a: Point
    b: Point

    @property
    def middle(self) -> Point:
        return (self.a[0] + self.b[0]) / 2, (self.a[1] + self.b[1]) / 2


class _Plan:
    """A plan while it is drawn."""

    def __init__(self, assessment: Assessment, size: PlanSize, paper: PlanPaper) -> None:
        self.assessment, self.size, self.paper = assessment, size, paper
        self.us_first = _us_first(assessment)
        data = assessment.project
        self.shapes: dict[str, Rectangle] = {
            item.id: item.rectangle for item in data.objects if item.rectangle is not None
        } | {array.id: array.rectangle for array in data.arrays}
        self.gaps = tuple(self._gaps())
        self.unnamed: list[str] = []

    @property
    def _leader_in(self) -> float:
        """Farthest label: the small plan leaves out what it has no room for."""
        return LEADER_IN if self.size.is_full else 0.4 * LEADER_IN

    def _gaps(self) -> Iterator[_Gap]:
        for count, check in enumerate(self.assessment.clearances, start=1):
            near = self.shapes.get(check.clearance.array)
            far = self.shapes.get(check.clearance.object)
            if near is not None and far is not None:
                yield _Gap(count, check, *map(self.paper.at, closest(near, far)))

    def draw(self, extent: Rectangle) -> None:
        """Draw everything; labels last, the least movable first."""
        self._roof()
        self._arrays()
        self._objects()
        for gap in self.gaps:
            self._gap(gap)
        if self.size.is_full:
            self._coordinates(extent)
        self._edge_labels(extent)
        names = [self._reserve(array) for array in self.assessment.arrays]
        spots = [spot for item in self._placed() if (spot := self._spot(item)) is not None]
        for spot in spots:
            self.paper.placer.take(spot)
        for gap in sorted(self.gaps, key=lambda gap: gap.check.ok):
            self._callout(gap)
        for array, name in zip(self.assessment.arrays, names, strict=True):
            self.paper.placer.release(name)
            self._label_array(array, name)
        for spot in spots:
            self.paper.placer.release(spot)
        for item in self._placed():
            self._name(item)

    def _roof(self) -> None:
        data, paper = self.assessment.project, self.paper
        if data.roof.outline is not None:
            paper.box(paper.frame(data.roof.outline), **ROOF)
        for edge in bare_edges(data):
            frame = paper.frame(edge.line)
            paper.line((frame.x0, frame.y0), (frame.x1, frame.y1), **BARE)

    def _arrays(self) -> None:
        for array in self.assessment.arrays if self.size.is_full else ():
            for outline, look in ((runs_envelope(array), RUNS), (design_envelope(array), DESIGN)):
                if len(outline) > 2:
                    self.paper.polygon(outline, **look)
        for array in self.assessment.arrays:
            frame = self.paper.frame(array.array.rectangle)
            self.paper.box(frame, gid=array.id, **ARRAY)
            for side in around(frame):
                self.paper.placer.avoid(side)

    def _placed(self) -> list[RoofObject]:
        """Return the objects on the plan that are no edges."""
        data = self.assessment.project
        return [item for item in data.objects if item.id in self.shapes and item.kind in FILLS]

    def _objects(self) -> None:
        for item in self._placed():
            frame = self.paper.frame(self.shapes[item.id])
            self.paper.box(frame, gid=item.id, **FILLS[item.kind])
            self.paper.placer.avoid(frame)
        for item in self._edges():
            a, b = _spine(self.paper.frame(self.shapes[item.id]))
            self.paper.line(a, b, **EDGES[item.kind])
            self.paper.placer.take(Frame(min(a[0], b[0]), min(a[1], b[1]), max(a[0], b[0]),
                                         max(a[1], b[1])))  # fmt: skip

    def _edges(self) -> list[RoofObject]:
        data = self.assessment.project
        return [item for item in data.objects if item.id in self.shapes and item.kind in EDGES]

    def _gap(self, gap: _Gap) -> None:
        if not gap.check.ok:
            near, far = (self.shapes[name] for name in _pair(gap))
            self.paper.box(self.paper.frame(_between(near, far)), **FAILED)
        gap_line(self.paper, gap.a, gap.b)
        self.paper.placer.take_segment(gap.a, gap.b)

    def _coordinates(self, extent: Rectangle) -> None:
        """Draw coordinates of the plan to the left and below."""
        paper, unit = self.paper, Quantity.PLAN.us if self.us_first else Quantity.PLAN.si
        box = paper.frame(extent)
        for axis, low, high in (
            ("x", extent.x_from_m, extent.x_to_m),
            ("y", extent.y_from_m, extent.y_to_m),
        ):
            ticks = [
                tick
                for tick in MaxNLocator(6, steps=[1, 2, 5, 10]).tick_values(
                    low / unit.si, high / unit.si
                )
                if low <= tick * unit.si <= high
            ]
            for tick in ticks:
                x, y = paper.at((tick * unit.si, tick * unit.si))
                words = number(tick, 0)
                if axis == "x":
                    paper.line((x, box.y0 - 0.22), (x, box.y0 - 0.27), linewidth=0.6)
                    self._write(centered(x, box.y0 - 0.35, width_in(words), LINE_IN), words)
                else:
                    paper.line((box.x0 - 0.22, y), (box.x0 - 0.27, y), linewidth=0.6)
                    wide = width_in(words)
                    self._write(centered(box.x0 - 0.3 - wide / 2, y, wide, LINE_IN), words)
        words = f"x [{unit.symbol}]"
        self._write(centered(box.middle[0], box.y0 - 0.53, width_in(words), LINE_IN), words)
        words = f"y [{unit.symbol}]"
        self._write(
            centered(box.x0 - 0.62 + width_in(words) / 2, box.y1 + 0.12, width_in(words), LINE_IN),
            words,
        )

    def _write(self, frame: Frame, words: str) -> None:
        self.paper.lines(frame, [words])
        self.paper.placer.take(frame)

    def _edge_labels(self, extent: Rectangle) -> None:
        middle = self.paper.frame(extent).middle
        for item in self._edges():
            frame = self.paper.frame(self.shapes[item.id])
            words = self._edge_words(item)
            if width_in(words) > max(frame.wide, frame.tall) or not self.size.is_full:
                words = tick_text(item.id)
            (x, y), wide = frame.middle, width_in(words)
            is_upright = frame.tall > frame.wide
            aside = 0.05 + LINE_IN / 2
            if is_upright:
                x = frame.x1 + aside if x > middle[0] else frame.x0 - aside
                label = centered(x, y, LINE_IN, wide)
            else:
                y = frame.y1 + aside if y > middle[1] else frame.y0 - aside
                label = centered(x, y, wide, LINE_IN)
            self.paper.placer.take(label)
            self.paper.text(x, y, words, ha="center", va="center_baseline",
                            rotation=90 if is_upright else 0)  # fmt: skip

    def _edge_words(self, item: RoofObject) -> str:
        if item.kind is ObjectKind.EDGE_WITHOUT_PARAPET:
            return f"{tick_text(item.id)}: no parapet"
        height = math.nan if item.height_m is None else item.height_m
        return f"{tick_text(item.id)}: parapet {self._both(height)}"

    def _both(self, value_m: float) -> str:
        return pair(value_m, Quantity.SIZE, self.us_first)

    def _first(self, value_m: float, show: Show = measured) -> str:
        unit = Quantity.SIZE.us if self.us_first else Quantity.SIZE.si
        return f"{show(value_m, unit)} {unit.symbol}"

    def _array_labels(self, array: ArrayAssessment) -> Iterator[list[str]]:
        """Yield the lines of an array's label, then fewer where there is less room."""
        name, slope = tick_text(array.id), math.degrees(array.array.slope_rad)
        if math.isnan(array.design_m):
            yield [name, "no value"]
        elif self.size.is_full:
            moves = f"Δ {self._both(array.design_m)}"
            keep = keep_clear_words(keep_clear_m(self.assessment, array), self.us_first)
            yield [name, moves, keep, "no conduit", f"slope {number(slope, 2)}°"]
            yield [name, moves, keep]
        if not math.isnan(array.design_m):
            yield [name, f"Δ {self._first(array.design_m)}"]
        yield [name]

    def _reserve(self, array: ArrayAssessment) -> Frame:
        """Keep room for the name of an array, and where possible for all of its label."""
        middle = self.paper.frame(array.array.rectangle).middle
        shown = list(self._array_labels(array))
        whole, name = (text_size(lines, first_bold=True) for lines in (shown[0], shown[-1]))
        self.paper.placer.avoid(centered(*middle, whole[0], whole[1] + ARROW_IN))
        reserved = centered(*middle, *name)
        self.paper.placer.take(reserved)
        return reserved

    def _spot(self, item: RoofObject) -> Frame | None:
        """Return where the name of an object fits in the middle of it, if it does."""
        frame = self.paper.frame(self.shapes[item.id])
        wide, tall = text_size([tick_text(item.id)])
        is_room = wide < frame.wide and tall < frame.tall
        return centered(*frame.middle, wide, tall) if is_room else None

    def _label_array(self, array: ArrayAssessment, name: Frame) -> None:
        """Label an array inside of it with as many lines as there is room for, or outside."""
        frame = self.paper.frame(array.array.rectangle)
        shown = [(lines, ARROW_IN) for lines in self._array_labels(array)]
        for lines, arrow in (*shown, (shown[-1][0], 0.0)):
            wide, tall = text_size(lines, first_bold=True)
            label = self.paper.placer.place(wide, tall + arrow, frame.middle, _inner(frame))
            if label is not None:
                above = Frame(label.x0, label.y0 + arrow, label.x1, label.y1)
                self.paper.lines(above, lines, first_bold=True)
                if arrow:
                    self._slope_arrow(label.middle[0], label.y0 + arrow / 2, array)
                return
        if frame.wide < name.wide or frame.tall < name.tall:
            self._beside(frame, tick_text(array.id))
        else:
            self.paper.placer.take(name)
            self.paper.lines(name, [tick_text(array.id)], first_bold=True)

    def _slope_arrow(self, x: float, y: float, array: ArrayAssessment) -> None:
        turn = math.radians(array.array.downslope_deg)
        dx, dy = 0.45 * ARROW_IN * math.cos(turn), 0.45 * ARROW_IN * math.sin(turn)
        self.paper.arrow((x - dx, y - dy), (x + dx, y + dy), linewidth=1.0)

    def _name(self, item: RoofObject) -> None:
        frame = self.paper.frame(self.shapes[item.id])
        words = tick_text(item.id)
        wide, tall = text_size([words])
        label = self.paper.placer.place(wide, tall, frame.middle, _inner(frame))
        if label is None:
            self._beside(frame, words)
            return
        self.paper.box(label, facecolor="white", edgecolor="none", zorder=2)
        self.paper.lines(label, [words])

    def _beside(self, frame: Frame, words: str) -> None:
        """Name something outside of it, with a leader."""
        size = text_size([words])
        label = self.paper.placer.place(*size, frame.middle, most=self._leader_in)
        if label is None:
            self.unnamed.append(words)
            return
        self._leader(frame.middle, label)
        self.paper.box(label, facecolor="white", edgecolor=GREY, linewidth=0.4, zorder=2)
        self.paper.lines(label, [words])

    def _callout(self, gap: _Gap) -> None:
        """Label a clearance: number, provided and required separation; the number if tight."""
        provided, required = gap.check.clearance.provided_m, gap.check.required_m
        show_required, show_provided = compared(gap.check.ok)
        needed = "no value" if math.isnan(required) else self._first(required, show_required)
        lines = [f"provided {self._first(provided, show_provided)}", f"required {needed}"]
        for shown in (lines, []) if self.size.is_full else ([],):
            wide, tall = text_size(shown) if shown else (0.0, 2 * RADIUS_IN)
            mark = 0.0 if gap.check.ok else ng_size()[0] + PAD_IN
            label = self.paper.placer.place(
                wide + 2 * RADIUS_IN + mark,
                max(tall, 2 * RADIUS_IN),
                gap.middle,
                most=self._leader_in if shown or gap.check.ok else 4.0,
            )
            if label is not None:
                self._draw_callout(gap, label, shown, mark)
                return
        self.unnamed.append(f"clearance {gap.number}")

    def _draw_callout(self, gap: _Gap, label: Frame, shown: Sequence[str], mark: float) -> None:
        paper, y = self.paper, label.middle[1]
        self._leader(gap.middle, label)
        if shown:
            paper.box(label, facecolor="white", edgecolor=GREY, linewidth=0.4, zorder=2)
            paper.lines(Frame(label.x0 + 2 * RADIUS_IN, label.y0, label.x1 - mark, label.y1), shown)
        center = label.x0 + RADIUS_IN, y
        paper.circle(center, RADIUS_IN - 0.01, facecolor="white", edgecolor=INK, linewidth=0.7,
                     zorder=2)  # fmt: skip
        paper.text(center[0], y - 0.04, str(gap.number), ha="center")
        if mark:
            ng_box(paper, label.x1 - ng_size()[0] / 2 - 0.01, y)

    def _leader(self, start: Point, label: Frame) -> None:
        end = (min(max(start[0], label.x0), label.x1), min(max(start[1], label.y0), label.y1))
        if math.dist(start, end) > 0.0:
            self.paper.line(start, end, linewidth=0.6, color=GREY)
            self.paper.placer.take_segment(start, end)


def keep_clear_words(separation_m: float, us_first: bool) -> str:
    """Return the field note of an array, its distance rounded up to 1 in or 10 mm."""
    if math.isnan(separation_m):
        return "keep clear: no value"
    steps = math.ceil(separation_m / (INCH_M if us_first else 0.01) - 1e-9)
    return f"keep clear {steps} in" if us_first else f"keep clear {10 * steps} mm"


def _pair(gap: _Gap) -> tuple[str, str]:
    return gap.check.clearance.array, gap.check.clearance.object


def _inner(frame: Frame) -> Frame:
    return Frame(frame.x0 + 0.03, frame.y0 + 0.03, frame.x1 - 0.03, frame.y1 - 0.03)


def _spine(frame: Frame) -> tuple[Point, Point]:
    """Return the center line of a strip."""
    x, y = frame.middle
    if frame.tall > frame.wide:
        return (x, frame.y0), (x, frame.y1)
    return (frame.x0, y), (frame.x1, y)


def _between(a: Rectangle, b: Rectangle) -> Rectangle:
    """Return the area between two rectangles: the gap along their facing sides."""
    x = _span((a.x_from_m, a.x_to_m), (b.x_from_m, b.x_to_m))
    y = _span((a.y_from_m, a.y_to_m), (b.y_from_m, b.y_to_m))
    return Rectangle(*x, *y)


def _span(a: tuple[float, float], b: tuple[float, float]) -> tuple[float, float]:
    """Return the range between two ranges, or their overlap."""
    inner = sorted((max(a[0], b[0]), min(a[1], b[1])))
    return inner[0], inner[1]


def _key(plan: _Plan) -> Key:
    """Return the legend of what is on the plan."""
    assessment, full = plan.assessment, plan.size.is_full
    kinds = {item.kind for item in assessment.project.objects if item.id in plan.shapes}
    shown = {
        Symbol.ARRAY: True,
        Symbol.FIXED: ObjectKind.FIXED in kinds,
        Symbol.UNLIKE: ObjectKind.UNLIKE_ARRAY in kinds,
        Symbol.PARAPET: ObjectKind.EDGE_WITH_PARAPET in kinds,
        Symbol.EDGE: ObjectKind.EDGE_WITHOUT_PARAPET in kinds,
        Symbol.BARE: bool(bare_edges(assessment.project)),
        Symbol.DESIGN: any(map(design_envelope, assessment.arrays)),
        Symbol.RUNS: any(map(runs_envelope, assessment.arrays)),
        Symbol.GAP: bool(plan.gaps),
        Symbol.FAILED: any(not gap.check.ok for gap in plan.gaps),
    }
    return Key(
        north_deg=assessment.project.roof.north_deg,
        us_first=plan.us_first,
        symbols=tuple(symbol for symbol, is_shown in shown.items() if is_shown and full),
        notes=tuple(_notes(plan)) if full else (),
    )


def _notes(plan: _Plan) -> Iterator[str]:
    yield "Δ: design displacement. It may occur in any direction."
    distances: dict[str, list[str]] = {}
    for array in plan.assessment.arrays:
        words = keep_clear_words(keep_clear_m(plan.assessment, array), plan.us_first)
        distances.setdefault(words, []).append(array.id)
    if len(distances) > 3:
        yield "Keep clear: no conduit or equipment within the distance stated, on all sides."
    for words, ids in distances.items() if len(distances) <= 3 else ():
        of = ", ".join(ids) if len(distances) > 1 else "all arrays"
        yield f"{words.capitalize()} of {of}, on all sides: no conduit or equipment."
    missing = [pair for pair in plan.assessment.neighbors if pair.is_missing]
    if missing:
        names = _some([f"{pair.array} to {pair.other}" for pair in missing])
        yield f"No clearance is given: {names}."
    numbers = {gap.number for gap in plan.gaps}
    rows = enumerate(plan.assessment.clearances, start=1)
    unplaced = [str(count) for count, _ in rows if count not in numbers]
    if unplaced:
        yield f"Not drawn, because a rectangle is not given: clearance {_some(unplaced)}."
    if plan.unnamed:
        yield f"Not labeled, for lack of space: {_some(plan.unnamed)}."


def _some(names: Sequence[str]) -> str:
    """Return a list of names, cut where it gets long: the legend has a fixed size."""
    more = len(names) - MOST_NAMES
    return ", ".join(names[:MOST_NAMES]) + (f" and {more} more" if more > 0 else "")
