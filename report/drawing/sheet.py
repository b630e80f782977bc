"""A roof plan while it is drawn: paper and scale, items on the roof, items without room.

Read `report.drawing.on_paper` first.
"""

from __future__ import annotations

import math
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from itertools import product

from report.assessment.assessment import Assessment
from report.assessment.plan.bare_edges import EDGES
from report.assessment.support.plan_gaps import PlanGap, plan_gaps
from report.drawing import paper_items
from report.drawing.layers import Layer
from report.drawing.paper_items import TYPE_PT, Item, Look, Mark, tick_text, width_in
from report.drawing.placer import Frame, Placer, centered
from report.project.model.roof import RoofObject
from report.project.model.shapes import Point, Rectangle, Shape, room, sides
from report.text.names import name_lines
from report.text.unit_format import UnitFormat
from report.text.units import LENGTHS
from solver.model import INCH_M

# Distance between lines of a label.
LINE_IN = 1.33 * TYPE_PT / 72.0
# Margin of the text in a frame.
PAD_IN = 0.045
# From the middle of a line down to its baseline.
BASE_IN = 0.04
_STEP_IN = 0.05  # along an oblique line


@dataclass(frozen=True, slots=True)
class Scale:
    """A drawing scale: its name if it is a round one, and plan length [m] per inch of paper."""

    name: str
    m_per_in: float


def round_scale(least_m_per_in: float, us_first: bool) -> Scale:
    """Return the largest engineering (US) or metric scale that is not larger than needed."""
    # US: 10, 20, 30, 40, 50, 60, 80, 100, 150, 200 ft and so on to the inch. SI: 1:100, 1:125,
    # 1:150, 1:200, 1:250, 1:300, 1:400, 1:500, 1:600, 1:750 and so on.
    us, si = (1, 1.5, 2, 3, 4, 5, 6, 8), (1, 1.25, 1.5, 2, 2.5, 3, 4, 5, 6, 7.5)
    unit = LENGTHS["ft"] if us_first else INCH_M
    rounds = (
        round(step * 10**decade)
        for decade, step in product(
            range(1, 7) if us_first else range(2, 8), us if us_first else si
        )
        if step * 10**decade != 15  # on no scale
    )
    chosen = next(n for n in rounds if n * unit >= least_m_per_in * (1.0 - 1e-9))
    return Scale(f"1 in = {chosen} ft" if us_first else f"1:{chosen}", chosen * unit)


@dataclass(frozen=True, slots=True)
class Paper:
    """A sheet of paper with a plan at a scale."""

    wide: float
    tall: float
    scale: Scale
    origin: Point  # where the origin of the plan is
    placer: Placer  # what is taken on the paper
    items: list[Item] = field(default_factory=list)  # what is drawn so far, in order

    def at(self, point: Point) -> Point:
        """Return the position of a point of the plan [m] on paper."""
        (x, y), m_per_in = self.origin, self.scale.m_per_in
        return x + point[0] / m_per_in, y + point[1] / m_per_in

    def frame(self, shape: Rectangle) -> Frame:
        """Return the position of a rectangle of the plan on paper."""
        low, _, high, _ = map(self.at, shape.points)
        return Frame(*low, *high)

    def sides(self, points: Iterable[Point]) -> Iterator[Frame]:
        """Yield thin frames along the sides of a ring of the plan [m], where they are on paper."""
        for start, end in sides(tuple(map(self.at, points))):
            yield from along(start, end)

    def shape(self, look: Look, points: Iterable[Point], name: str = "") -> None:
        """Draw an outline of the plan [m]."""
        self.items.append(
            paper_items.Outline(look=look, points=tuple(map(self.at, points)), name=name)
        )

    def box(self, look: Look, frame: Frame) -> None:
        """Draw a rectangle."""
        self.items.append(paper_items.Outline(look=look, points=frame.corners))

    def lines(self, look: Look, *lines: Sequence[Point], name: str = "") -> None:
        """Draw lines as one thing."""
        self.items.append(paper_items.Lines(look=look, lines=tuple(map(tuple, lines)), name=name))

    def circle(self, look: Look, center: Point, radius: float, name: str = "") -> None:
        """Draw a circle."""
        self.items.append(paper_items.Circle(look=look, center=center, radius=radius, name=name))

    def arrow(self, look: Look, middle: Point, turn_rad: float, half: float) -> None:
        """Draw an arrow about a point."""
        (x, y), dx, dy = middle, half * math.cos(turn_rad), half * math.sin(turn_rad)
        self.items.append(paper_items.Arrow(look=look, tail=(x - dx, y - dy), tip=(x + dx, y + dy)))

    def dimension(self, look: Look, a: Point, b: Point) -> None:
        """Draw a dimension line with a tick at each end."""
        # Outlines that touch have a gap of no length: its ticks lie in one point.
        long = math.dist(a, b) or 1.0
        dx, dy = (0.05 * (b[0] - a[0]) / long, 0.05 * (b[1] - a[1]) / long)
        self.lines(look, (a, b), *(((x - dy, y + dx), (x + dy, y - dx)) for x, y in (a, b)))

    def text(self, x: float, y: float, words: str, **look: bool) -> None:
        """Write a line from the start of its baseline, unless it is centered."""
        self.items.append(paper_items.Text(at=(x, y), words=words, **look))

    def label(self, frame: Frame, lines: Sequence[str], *, first_bold: bool = False) -> None:
        """Write lines in the middle of a frame, one below the other."""
        x, y = frame.middle
        top = y + LINE_IN * ((len(lines) - 1) / 2 - 0.26)
        for count, words in enumerate(lines):
            is_bold = first_bold and count == 0
            self.text(x, top - LINE_IN * count, words, is_centered=True, is_bold=is_bold)


def text_size(lines: Sequence[str], *, first_bold: bool = False) -> Point:
    """Return width and height of lines with their margin."""
    widths = [
        width_in(words, is_bold=first_bold and count == 0) for count, words in enumerate(lines)
    ]
    return max(widths) + 2 * PAD_IN, LINE_IN * len(lines) + PAD_IN


def along(a: Point, b: Point) -> Iterator[Frame]:
    """Yield thin frames along a line: one, or small ones where the line is oblique."""
    line = 0.01
    wide, tall = abs(b[0] - a[0]), abs(b[1] - a[1])
    if min(wide, tall) < line:
        yield centered((a[0] + b[0]) / 2, (a[1] + b[1]) / 2, max(wide, line), max(tall, line))
        return
    count = math.ceil(math.dist(a, b) / _STEP_IN)
    for k in range(count + 1):
        share = k / count
        yield centered(a[0] + share * (b[0] - a[0]), a[1] + share * (b[1] - a[1]), line, line)


LEADER_IN = 1.5  # farthest label


@dataclass(frozen=True, slots=True, kw_only=True)
class PlanSize:
    """Size of a plan on paper [in]."""

    wide: float
    tall: float  # greatest height
    # The legend is to the right of the plan, or on a screen below it; that of a full plan is on a
    # paper of its own.
    key_wide: float = 0.0
    key_tall: float = 0.0
    sheet: str = ""  # the large one of a full plan in the package; none of those of other parts
    columns: int = 0  # of tables beside a full plan
    is_full: bool = False  # whether with envelopes, dimensions and coordinates
    is_screen: bool = False  # as large as there is room, arrays labeled before dimensions

    @property
    def fringe(self) -> tuple[float, float, float, float]:
        """Margins [in] of the roof: left, right, bottom, top."""
        return (0.62, 0.26, 0.48, 0.26) if self.is_full else (0.24, 0.24, 0.24, 0.24)


# Width of a column of tables beside a full plan, with its distance.
COLUMN_IN = 2.8


def _large(sheet: str, wide: float, tall: float) -> tuple[PlanSize, ...]:
    """Return full plans next to one and two columns of tables on a sheet of this size [in]."""
    return tuple(
        PlanSize(wide=wide - n * COLUMN_IN, tall=tall, columns=n, sheet=sheet, is_full=True)
        for n in (1, 2)
    )


# A sheet less what a heading and the legend take, and on a large one notes and the title block.
# The widths are those within the margins of `package.css`: 8.5 in less 2 x 0.75 in.
LETTER = PlanSize(wide=7.0, tall=7.9, is_full=True)
A4 = PlanSize(wide=7.0, tall=8.5, is_full=True)
TABLOID, A3 = _large("tabloid", 15.8, 7.1), _large("a3", 15.3, 7.8)


@dataclass(frozen=True, slots=True)
class Gap:
    """A gap of the plan; the ends of its dimension line on paper."""

    of: PlanGap
    a: Point
    b: Point

    @property
    def name(self) -> str:
        """Its name if it has no label."""
        gap = self.of
        return f"clearance {gap.number}" if gap.is_given else f"{gap.array} to {gap.other}"

    @property
    def middle(self) -> Point:
        """The middle of its dimension line."""
        return (self.a[0] + self.b[0]) / 2, (self.a[1] + self.b[1]) / 2


@dataclass(frozen=True, kw_only=True)
class PlanSheet:
    """A plan while it is drawn."""

    assessment: Assessment
    size: PlanSize
    paper: Paper
    designs: Mapping[str, str]  # design displacement of each array, where it is worded elsewhere
    has_verdicts: bool  # whether it says which gaps are NG
    # What found no room for its label, and has none.
    unnamed: list[str] = field(default_factory=list)
    # What found none near its place, or not for all.
    crowded: list[str] = field(default_factory=list)

    @cached_property
    def shapes(self) -> Mapping[str, Shape]:
        """Items on the plan, by name [m]."""
        return self.assessment.project.shapes

    @cached_property
    def gaps(self) -> Sequence[Gap]:
        """The clearances between shapes, and NG pairs without one."""
        return [Gap(gap, *map(self.paper.at, gap.ends)) for gap in plan_gaps(self.assessment)]

    @property
    def fmt(self) -> UnitFormat:
        """The units of the plan."""
        return unit_format(self.assessment)

    def name_lines(self, name: str) -> Sequence[str]:
        """Return the lines of the name of an array or an object."""
        return [tick_text(name)] if self.size.is_screen else name_lines(name)

    @property
    def envelopes(self) -> Collection[Layer]:
        """The displacement envelopes of arrays that are drawn."""
        if self.size.is_full:
            return (Layer.RUNS, Layer.DESIGN)
        return (Layer.DESIGN,) if self.size.is_screen else ()

    @property
    def leader_in(self) -> float:
        """Farthest label: a small plan leaves out what it has no room for."""
        return LEADER_IN if self.size.is_full or self.size.is_screen else 0.4 * LEADER_IN

    @property
    def placed(self) -> list[RoofObject]:
        """The objects on the plan other than edges."""
        return [item for item in self._objects if item.kind not in EDGES]

    @property
    def edges(self) -> list[RoofObject]:
        """The roof edges on the plan."""
        return [item for item in self._objects if item.kind in EDGES]

    @property
    def _objects(self) -> list[RoofObject]:
        return [item for item in self.assessment.project.objects if item.id in self.shapes]

    def is_ng(self, gap: Gap) -> bool:
        """Whether the plan marks a gap as not satisfied."""
        return self.has_verdicts and gap.of.is_ng

    def room(self, name: str) -> Frame:
        """Return the free area on paper within a shape."""
        return self.paper.frame(room(self.shapes[name]))

    def leader(self, start: Point, label: Frame, radius: float = 0.0) -> None:
        """Draw a line from a point, or a circle about it, to the nearest point of a label."""
        end = label.nearest(start)
        long = math.dist(start, end)
        if long > radius:
            x, y = (
                (1.0 - radius / long) * a + radius / long * b
                for a, b in zip(start, end, strict=True)
            )
            start = x, y
            self.paper.lines(Mark.LEADER, (start, end))
            self.paper.placer.take_segment(start, end)

    def name_beside(self, frame: Frame, lines: Sequence[str]) -> None:
        """Name an array or an object outside of it: on a full plan far from it rather than not."""
        if self.beside(frame, lines):
            return
        self.crowded.append(" ".join(lines))
        if not self.size.is_full or not self.beside(frame, lines, is_last=True):
            self.unnamed.append(" ".join(lines))

    def beside(
        self, frame: Frame, lines: Sequence[str], radius: float = 0.0, *, is_last: bool = False
    ) -> bool:
        """Write outside of something with a leader if it has room; `is_last`, across others too."""
        maximum = math.inf if is_last else self.leader_in
        label = self.paper.placer.place(
            *text_size(lines), frame.middle, maximum=maximum, may_cross=is_last
        )
        if label is None:
            return False
        self.leader(frame.middle, label, radius)
        self.paper.box(Mark.FRAME, label)
        self.paper.label(label, lines)
        return True


def unit_format(assessment: Assessment) -> UnitFormat:
    """Return the units of a plan."""
    # Not none: nothing is required only where a length is zero.
    return UnitFormat(us_first=assessment.project.us_first, none="no value")
