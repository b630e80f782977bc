"""A plan as lines and texts on layers: what a drawing for CAD consists of.

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
    """A text about a point; position and height in the unit of the drawing."""

    layer: Layer
    words: str
    at: Point
    height: float


@dataclass(frozen=True, slots=True, kw_only=True)
class PlanDrawing:
    """The plan in feet (US) or meters (SI)."""

    is_feet: bool
    lines: tuple[PlanLine, ...]
    texts: tuple[PlanText, ...]
