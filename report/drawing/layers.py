"""A plan as lines, texts and dimensions on layers: what a drawing for CAD consists of.

Imports nothing of the solver, so that another process loads it quickly. Read `PlanDrawing` first.
"""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum

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
    """A text about a point, in the unit of the drawing.

    Attributes
    ----------
    of : str
        Id of what it tells the height of, wherever it is; empty for none.
    is_left : bool
        Whether it starts at its point.
    is_upright : bool
        Whether it reads from below.
    """

    layer: Layer
    words: str
    at: Point
    of: str = ""
    is_left: bool = False
    is_upright: bool = False


@dataclass(frozen=True, slots=True, kw_only=True)
class PlanDimension:
    """A dimension between two points; its text is about a point, empty where it has no room.

    Attributes
    ----------
    has_leader : bool
        Whether a line leads to its text.
    """

    layer: Layer
    name: str
    ends: tuple[Point, Point]
    words: str
    at: Point
    is_upright: bool = False
    has_leader: bool = False


@dataclass(frozen=True, slots=True, kw_only=True)
class PlanDrawing:
    """The plan in feet (US) or meters (SI), with the height of its texts."""

    is_feet: bool
    height: float
    lines: tuple[PlanLine, ...]
    texts: tuple[PlanText, ...]
    dimensions: tuple[PlanDimension, ...]
