"""The items of a plan on paper, painted in order.

Positions are in inches, y upward. The appearance of an item is defined by each painter: of the
package (`report.figures.plan_figure`) and of the page (`report.web.plan`). Read `Item`.
"""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum

from report.drawing.layers import Layer
from report.project.model.shapes import Point
from report.typeset.letters import width_em


class Mark(Enum):
    """Items on paper other than the plan itself."""

    FAILED = "area of a gap that is not satisfied"
    LEADER = "from what is named to its label"
    FRAME = "around a label"
    BACKING = "behind a label"
    NUMBER = "around the number of a clearance"
    NUMBER_SAMPLE = "the same in the legend"
    NG = "behind the word NG"
    SLOPE = "downslope direction"
    SLOPE_SAMPLE = "the same in the legend, thinner"
    TICK = "coordinate"
    DARK = "dark half of the scale bar"
    LIGHT = "light half of the scale bar"


Look = Layer | Mark


@dataclass(frozen=True, slots=True, kw_only=True)
class Outline:
    """A closed polygon, and the item that it outlines."""

    look: Look
    points: tuple[Point, ...]
    name: str = ""


@dataclass(frozen=True, slots=True, kw_only=True)
class Lines:
    """Lines that form one item, such as a dimension line with ticks, and its owner."""

    look: Look
    lines: tuple[tuple[Point, ...], ...]
    name: str = ""


@dataclass(frozen=True, slots=True, kw_only=True)
class Arrow:
    """An arrow."""

    look: Look
    tail: Point
    tip: Point


@dataclass(frozen=True, slots=True, kw_only=True)
class Circle:
    """A circle, and the item that it belongs to."""

    look: Look
    center: Point
    radius: float
    name: str = ""


@dataclass(frozen=True, slots=True, kw_only=True)
class Text:
    """A line of text."""

    at: Point  # start of its baseline; where it is centered, the middle of its baseline
    words: str
    is_centered: bool = False
    is_bold: bool = False
    is_upright: bool = False  # whether it reads from below
    is_light: bool = False  # whether on a dark ground


Item = Outline | Lines | Arrow | Circle | Text


def level(item: Item) -> int:
    """Return the layer of an item: shapes, then lines and labels, text, and last the mark NG."""
    if isinstance(item, Text):
        return 4 if item.is_light else 2
    if item.look is Mark.NG:
        return 3
    is_line = isinstance(item, Lines)
    return 1 if is_line or item.look in (Mark.FRAME, Mark.BACKING, Mark.NUMBER) else 0


TYPE_PT = 9.0  # the renderer clips letters of 8.5 pt


def width_in(text: str, *, is_bold: bool = False) -> float:
    """Return the width of a text [in] at `TYPE_PT`."""
    return width_em(text, is_bold=is_bold) * TYPE_PT / 72.0


def tick_text(name: str) -> str:
    """Return a name truncated to the width of a tick label."""
    return name if len(name) <= 14 else f"{name[:13]}…"
