"""Texts and dimensions of the plan for CAD, each placed where it touches no other.

Knows no assessment (`report.drawing.plan`). Read `PlacedTexts`.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field

from report.drawing.dimensions import alongside, lane_of
from report.drawing.labels import along_strip
from report.drawing.layers import Layer, PlanDimension, PlanLine, PlanText
from report.drawing.paper import LINE_IN, PAD_IN, Paper, Scale
from report.drawing.placer import Frame, Placer
from report.drawing.sheet import Gap
from report.drawing.widths import TYPE_PT, width_in
from report.sheet.schema.shapes import Point, Rectangle, Shape, room, sides

_CAP_IN = 0.66 * TYPE_PT / 72.0  # height of a capital
_WIDER = 1.2  # than in the font of the pictures: a CAD program may replace its own one
_PAGE = Frame(-math.inf, -math.inf, math.inf, math.inf)


@dataclass(slots=True)
class PlacedTexts:
    """The texts of a plan as far as they are placed, on a paper on which they are as in print.

    Attributes
    ----------
    height_m, unit_m : float
        Height of the texts and size of the unit of the drawing [m].
    left : list of (str, str)
        Ids and names that found no room, each name after its number.
    """

    height_m: float
    unit_m: float
    texts: list[PlanText] = field(default_factory=list)
    dimensions: list[PlanDimension] = field(default_factory=list)
    leaders: list[PlanLine] = field(default_factory=list)
    left: list[tuple[str, str]] = field(default_factory=list)
    paper: Paper = field(init=False)

    def __post_init__(self) -> None:
        scale = Scale("", self.height_m / _CAP_IN)
        self.paper = Paper(math.inf, math.inf, scale, (0.0, 0.0), Placer(_PAGE))

    @property
    def right(self) -> float:
        """The right end of all that is drawn."""
        return self._drawn((self.paper.placer.right, 0.0))[0]

    def keep_off(self, line: PlanLine) -> None:
        """Let no text touch a line [m], or touch an envelope only where there is no other room."""
        placer = self.paper.placer
        mark = placer.wall if line.layer is Layer.ARRAY else placer.avoid
        for frame in self.paper.sides(line.points):
            mark(frame)
        if line.layer not in (Layer.DESIGN, Layer.RUNS):
            for ends in sides(tuple(map(self.paper.at, line.points))):
                placer.take_segment(*ends)

    def name(self, layer: Layer, of: str, words: str, shape: Shape) -> None:
        """Name a shape within it or beside it with a leader, or else by a number in the list."""
        inner, key = self.paper.frame(room(shape)), f"({len(self.left) + 1})"
        for shown in (words, key):
            label = self.paper.placer.place(*_size(shown), inner.middle, inner)
            label = label or self._beside(of, shown, inner.middle)
            if label:
                self._write(layer, of, shown, label)
                break
        if not label or shown is key:
            self.left.append((of, f"{key} {words}"))

    def _beside(self, of: str, words: str, start: Point) -> Frame | None:
        """Return a place near a point, with a leader to it; None if there is none."""
        label = self.paper.placer.place(*_size(words), start)
        if label:
            ends = start, label.nearest(start)
            self.paper.placer.take_segment(*ends)
            points = tuple(map(self._drawn, ends))
            leader = PlanLine(layer=Layer.NOTES, name=of, points=points, is_closed=False)
            self.leaders.append(leader)
        return label

    def name_edge(self, layer: Layer, of: str, words: str, shape: Shape, roof: Rectangle) -> None:
        """Name a roof edge along it, outside of the roof."""
        middle = self.paper.frame(roof).middle
        label, is_upright = along_strip(self.paper.frame(shape.bounds), middle, _size(words)[0])
        if isinstance(shape, Rectangle) and self.paper.placer.take_first([label]) is not None:
            self._write(layer, of, words, label, is_upright)
        else:
            self.name(layer, of, words, shape)

    def dimension(self, layer: Layer, name: str, words: str, gap: Gap) -> None:
        """Dimension a gap with its text beside the line, or else with a leader."""
        lane, tall = lane_of(self.paper, gap), 1.5 * _CAP_IN
        # As wide as the library takes it, which interrupts the line behind it.
        long = max(_CAP_IN * len(words) + PAD_IN, _size(words)[0])
        shifts = [s for over in (0.0, long) for s in alongside(lane, long, over)]
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
        self, layer: Layer, of: str, words: str, label: Frame, is_upright: bool = False
    ) -> None:
        at = self._drawn(label.middle)
        self.texts.append(PlanText(layer=layer, words=words, at=at, of=of, is_upright=is_upright))

    def _drawn(self, point: Point) -> Point:
        """Return a point of the paper in the drawing."""
        unit_in = self.unit_m / self.paper.scale.m_per_in
        return point[0] / unit_in, point[1] / unit_in


def _size(words: str) -> Point:
    return _WIDER * width_in(words) + 2 * PAD_IN, LINE_IN
