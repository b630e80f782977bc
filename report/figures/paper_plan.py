"""The sheet that a plan is drawn on: its scale, its axes in inches, and its pen.

Read `report.figures.plan` first.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import product
from typing import Any

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Circle, FancyArrowPatch, Polygon
from matplotlib.patches import Rectangle as Box

from report.figures.base import INK, Broken
from report.figures.labels import LINE_IN, TYPE_PT, Frame, Placer, centered, width_in
from report.sheet.schema import Rectangle, Shape
from report.sheet.schema.shapes import Point, sides
from solver.model import INCH_M

FOOT_M = 12.0 * INCH_M

PAD_IN = 0.045
"""Margin of the text in a frame."""
_STEP_IN = 0.05  # along an oblique line


@dataclass(frozen=True, slots=True)
class Scale:
    """A round drawing scale: its name, and plan length [m] per inch of paper."""

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


class PlanPaper:
    """A figure whose axes are inches of paper, and the plan on it at a scale.

    Attributes
    ----------
    placer : Placer
        What is taken on the paper.
    """

    def __init__(self, wide: float, tall: float, scale: Scale, origin: Point) -> None:
        self.figure = Figure(figsize=(wide, tall))
        self.axes: Axes = self.figure.add_axes((0.0, 0.0, 1.0, 1.0))
        self.axes.set_xlim(0.0, wide)
        self.axes.set_ylim(0.0, tall)
        self.axes.set_axis_off()
        self.scale = scale
        self.page = Frame(0.01, 0.01, wide - 0.01, tall - 0.01)
        self.placer = Placer(self.page)
        self._origin = origin

    def at(self, point: Point) -> Point:
        """Return where a point of the plan [m] is on paper [in]."""
        return (
            self._origin[0] + point[0] / self.scale.m_per_in,
            self._origin[1] + point[1] / self.scale.m_per_in,
        )

    def frame(self, shape: Rectangle) -> Frame:
        """Return where a rectangle of the plan is on paper."""
        return Frame(
            *self.at((shape.x_from_m, shape.y_from_m)), *self.at((shape.x_to_m, shape.y_to_m))
        )

    def shape(self, shape: Shape, **look: Any) -> None:
        """Draw a shape of the plan [m]."""
        if isinstance(shape, Rectangle):
            self.box(self.frame(shape), **look)
        else:
            self.polygon(shape.points, **look)

    def sides(self, shape: Shape) -> Iterator[Frame]:
        """Yield thin frames along the sides of a shape, where they are on paper."""
        if isinstance(shape, Rectangle):
            yield from around(self.frame(shape))
            return
        for start, end in sides(tuple(map(self.at, shape.points))):
            yield from along(start, end)

    def box(self, frame: Frame, **look: Any) -> None:
        """Draw a rectangle on paper."""
        self.axes.add_patch(Box((frame.x0, frame.y0), frame.wide, frame.tall, **look))

    def polygon(self, points: Sequence[Point], **look: Any) -> None:
        """Draw a polygon of plan points [m]."""
        self.axes.add_patch(Polygon([self.at(point) for point in points], closed=True, **look))

    def line(self, a: Point, b: Point, **look: Any) -> None:
        """Draw a line on paper."""
        self.axes.add_line(Line2D((a[0], b[0]), (a[1], b[1]), **({"color": INK} | look)))

    def segments(self, segments: Sequence[Sequence[Point]], **look: Any) -> None:
        """Draw several lines on paper as one path."""
        path = Broken()
        for points in segments:
            path.add(*zip(*points, strict=True))
        self.axes.add_line(Line2D(path.x, path.y, **({"color": INK} | look)))

    def circle(self, center: Point, radius: float, **look: Any) -> None:
        """Draw a circle on paper."""
        self.axes.add_patch(Circle(center, radius, **look))

    def arrow(self, a: Point, b: Point, **look: Any) -> None:
        """Draw an arrow on paper."""
        arrow = FancyArrowPatch(
            a, b, arrowstyle="-|>", mutation_scale=8, color=INK, shrinkA=0, shrinkB=0, **look
        )
        self.axes.add_patch(arrow)

    def text(self, x: float, y: float, words: str, **look: Any) -> None:
        """Write a line at its baseline, or turned about its center."""
        usual: dict[str, Any] = {"fontsize": TYPE_PT, "ha": "left", "va": "baseline", "color": INK}
        self.axes.text(x, y, words, **(usual | look))

    def lines(self, frame: Frame, lines: Sequence[str], *, first_bold: bool = False) -> None:
        """Write lines in the middle of a frame, one below the other."""
        x, y = frame.middle
        top = y + LINE_IN * len(lines) / 2
        for count, words in enumerate(lines):
            weight = "semibold" if first_bold and count == 0 else "regular"
            base = top - LINE_IN * (count + 0.76)
            self.text(x, base, words, ha="center", weight=weight)


def text_size(lines: Sequence[str], first_bold: bool = False) -> Point:
    """Return width and height of lines with their margin [in]."""
    widths = [
        width_in(words, "semibold" if first_bold and count == 0 else "regular")
        for count, words in enumerate(lines)
    ]
    return max(widths) + 2 * PAD_IN, LINE_IN * len(lines) + PAD_IN


def wrapped(words: str, wide: float) -> list[str]:
    """Return a text as lines no wider than a width [in]."""
    lines: list[str] = []
    for word in words.split():
        longer = f"{lines[-1]} {word}" if lines else word
        if lines and width_in(longer) <= wide:
            lines[-1] = longer
        else:
            lines.append(word)
    return lines


def nice_length(maximum: float) -> float:
    """Return 1, 2 or 5 times a power of ten, the largest up to a length."""
    power = 10.0 ** math.floor(math.log10(maximum))
    return max(step * power for step in (1.0, 2.0, 5.0) if step * power <= maximum * (1 + 1e-9))


def around(frame: Frame) -> tuple[Frame, ...]:
    """Return the four sides of a frame, as thin frames."""
    (x, y), line = frame.middle, 0.01
    return (
        centered(x, frame.y0, frame.wide, line),
        centered(x, frame.y1, frame.wide, line),
        centered(frame.x0, y, line, frame.tall),
        centered(frame.x1, y, line, frame.tall),
    )


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
