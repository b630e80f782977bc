"""The paper that a plan is drawn on: its scale, what is drawn, and where labels still have room.

Sizes and positions are in inches on paper. Read `Paper` first.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from itertools import product

from report.drawing.items import Arrow, Circle, Item, Lines, Look, Outline, Text
from report.drawing.placer import Frame, Placer, centered
from report.drawing.widths import TYPE_PT, width_in
from report.sheet.schema.shapes import Point, Rectangle, sides
from solver.model import INCH_M

FOOT_M = 12.0 * INCH_M

LINE_IN = 1.33 * TYPE_PT / 72.0
"""Distance between lines of a label."""
PAD_IN = 0.045
"""Margin of the text in a frame."""
BASE_IN = 0.04
"""From the middle of a line down to its baseline."""
_STEP_IN = 0.05  # along an oblique line


@dataclass(frozen=True, slots=True)
class Scale:
    """A drawing scale: its name if it is a round one, and plan length [m] per inch of paper."""

    name: str
    m_per_in: float


def round_scale(least_m_per_in: float, us_first: bool) -> Scale:
    """Return the largest engineering (US) or metric scale that is not larger than needed.

    US: 10, 20, 30, 40, 50, 60, 80, 100, 150, 200 ft and so on to the inch. SI: 1:100, 1:125,
    1:150, 1:200, 1:250, 1:300, 1:400, 1:500, 1:600, 1:750 and so on.
    """
    us, si = (1, 1.5, 2, 3, 4, 5, 6, 8), (1, 1.25, 1.5, 2, 2.5, 3, 4, 5, 6, 7.5)
    unit = FOOT_M if us_first else INCH_M
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
    """A sheet of paper with a plan at a scale.

    Attributes
    ----------
    origin : tuple of float
        Where the origin of the plan is.
    items : list of Item
        What is drawn so far, in order.
    placer : Placer
        What is taken on the paper.
    """

    wide: float
    tall: float
    scale: Scale
    origin: Point
    placer: Placer
    items: list[Item] = field(default_factory=list)

    def at(self, point: Point) -> Point:
        """Return where a point of the plan [m] is on paper."""
        (x, y), m_per_in = self.origin, self.scale.m_per_in
        return x + point[0] / m_per_in, y + point[1] / m_per_in

    def frame(self, shape: Rectangle) -> Frame:
        """Return where a rectangle of the plan is on paper."""
        low, _, high, _ = map(self.at, shape.points)
        return Frame(*low, *high)

    def sides(self, points: Iterable[Point]) -> Iterator[Frame]:
        """Yield thin frames along the sides of a ring of the plan [m], where they are on paper."""
        for start, end in sides(tuple(map(self.at, points))):
            yield from along(start, end)

    def shape(self, look: Look, points: Iterable[Point], name: str = "") -> None:
        """Draw an outline of the plan [m]."""
        self.items.append(Outline(look=look, points=tuple(map(self.at, points)), name=name))

    def box(self, look: Look, frame: Frame) -> None:
        """Draw a rectangle."""
        self.items.append(Outline(look=look, points=frame.corners))

    def lines(self, look: Look, *lines: Sequence[Point], name: str = "") -> None:
        """Draw lines as one thing."""
        self.items.append(Lines(look=look, lines=tuple(map(tuple, lines)), name=name))

    def circle(self, look: Look, center: Point, radius: float, name: str = "") -> None:
        """Draw a circle."""
        self.items.append(Circle(look=look, center=center, radius=radius, name=name))

    def arrow(self, look: Look, middle: Point, turn_rad: float, half: float) -> None:
        """Draw an arrow about a point."""
        (x, y), dx, dy = middle, half * math.cos(turn_rad), half * math.sin(turn_rad)
        self.items.append(Arrow(look=look, tail=(x - dx, y - dy), tip=(x + dx, y + dy)))

    def dimension(self, look: Look, a: Point, b: Point) -> None:
        """Draw a dimension line with a tick at each end."""
        long = math.dist(a, b) or 1.0
        dx, dy = (0.05 * (b[0] - a[0]) / long, 0.05 * (b[1] - a[1]) / long)
        self.lines(look, (a, b), *(((x - dy, y + dx), (x + dy, y - dx)) for x, y in (a, b)))

    def text(self, x: float, y: float, words: str, **look: bool) -> None:
        """Write a line from the start of its baseline, unless it is centered."""
        self.items.append(Text(at=(x, y), words=words, **look))

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
