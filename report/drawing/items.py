"""What a plan consists of: for CAD on layers, and on paper as items that are painted in order.

On paper positions are in inches, y upward. How an item looks stands with each painter: of the
package (`report.figures.plan`) and of the page (`report.web.plan`).
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from enum import Enum
from functools import cache
from typing import TYPE_CHECKING

from report.sheet.schema.scene import Array
from report.typeset.pdf import TEMPLATES

if TYPE_CHECKING:
    from matplotlib.ft2font import FT2Font


Point = tuple[float, float]


class Layer(Enum):
    """A layer: its name, its color by AutoCAD's index, and whether its lines are dashed."""

    OUTLINE = ("ROOF-OUTLINE", 8, False)
    EDGE = ("ROOF-EDGE", 7, True)
    PARAPET = ("ROOF-PARAPET", 7, False)
    BARE_EDGE = ("ROOF-EDGE-NOT-GIVEN", 1, True)
    ARRAY = ("ARRAY", 5, False)
    UNLIKE = ("ARRAY-UNLIKE", 9, False)
    OBJECT = ("OBJECT", 8, False)
    CLEARANCE = ("CLEARANCE", 3, False)
    CLEARANCE_NG = ("CLEARANCE-NG", 1, False)
    CLEARANCE_NONE = ("CLEARANCE-NO-VERDICT", 2, False)
    DESIGN = ("ENVELOPE-DESIGN", 6, True)
    RUNS = ("ENVELOPE-RUNS", 30, False)
    NOTES = ("NOTES", 7, False)
    NORTH = ("NORTH", 7, False)

    @property
    def title(self) -> str:
        """Its name."""
        return self.value[0]


@dataclass(frozen=True, slots=True, kw_only=True)
class PlanLine:
    """A line or, if closed, an outline; points in the unit of the drawing, and the id it is of."""

    layer: Layer
    name: str
    points: tuple[Point, ...]
    is_closed: bool


@dataclass(frozen=True, slots=True, kw_only=True)
class PlanText:
    """A text about a point, in the unit of the drawing."""

    layer: Layer
    words: str
    at: Point
    of: str = ""  # id of what it tells the height of, wherever it is; empty for none
    is_left: bool = False  # whether it starts at its point
    is_upright: bool = False  # whether it reads from below


@dataclass(frozen=True, slots=True, kw_only=True)
class PlanDimension:
    """A dimension between two points; its text is about a point, empty where it has no room."""

    layer: Layer
    name: str
    ends: tuple[Point, Point]
    words: str
    at: Point
    is_upright: bool = False
    has_leader: bool = False  # whether a line leads to its text


@dataclass(frozen=True, slots=True, kw_only=True)
class PlanDrawing:
    """The plan in feet (US) or meters (SI), with the height of its texts."""

    is_feet: bool
    height: float
    lines: tuple[PlanLine, ...]
    texts: tuple[PlanText, ...]
    dimensions: tuple[PlanDimension, ...]


class Mark(Enum):
    """What is on paper beside the plan itself."""

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
    """A closed polygon, and what it is of."""

    look: Look
    points: tuple[Point, ...]
    name: str = ""


@dataclass(frozen=True, slots=True, kw_only=True)
class Lines:
    """Lines that are one thing, such as a dimension line with its ticks, and what they are of."""

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
    """A circle, and what it is of."""

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
    """Return what an item lies over: shapes, then lines and labels, words, and last the word NG."""
    if isinstance(item, Text):
        return 4 if item.is_light else 2
    if item.look is Mark.NG:
        return 3
    is_line = isinstance(item, Lines)
    return 1 if is_line or item.look in (Mark.FRAME, Mark.BACKING, Mark.NUMBER) else 0


TYPE_PT = 9.0  # the renderer clips letters of 8.5 pt
_FINER = 16.0  # than a point: widths are rounded to pixels


@cache
def width_in(text: str, *, is_bold: bool = False) -> float:
    """Return the width of a text [in] at `TYPE_PT`."""
    font = _font("Semibold" if is_bold else "Regular")
    font.set_text(text, 0.0)
    wide: float = font.get_width_height()[0] / 64.0
    return wide / _FINER / 72.0


@cache
def _font(weight: str) -> FT2Font:
    from matplotlib.ft2font import FT2Font

    font = FT2Font(TEMPLATES / "fonts" / f"SourceSans3-{weight}.ttf")
    font.set_size(TYPE_PT, 72.0 * _FINER)
    return font


def tick_text(name: str) -> str:
    """Return a name truncated to the width of a tick label."""
    return name if len(name) <= 14 else f"{name[:13]}…"


DRAWN_DEG = (8.0, 15.0)
"""Flatter roofs are drawn at the first slope, so that it shows; steeper ones at the second."""


def drawn_slope_deg(array: Array) -> float:
    """Return the slope at which the roof is drawn [deg]."""
    least, most = DRAWN_DEG
    return min(max(math.degrees(array.slope_rad), least), most)
