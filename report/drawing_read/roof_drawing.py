"""Contents of a roof drawing: outlines, texts, and entities that were not understood.

Knows no file (`report.drawing_read.read_dxf`) and no workbook.
"""

from __future__ import annotations

import math
from collections import Counter
from dataclasses import dataclass, field, replace

from report.drawing_read.geometry import turned
from report.project.model.choices import LayerKind
from report.project.model.shapes import Point, Polygon, Shape


@dataclass(frozen=True, slots=True, kw_only=True)
class DrawnOutline:
    """A closed line of a drawing; in a `RoofPlan` an array, an object, an edge or the roof."""

    handle: str  # of its line, or of the first of those that are joined; empty for a side of a roof
    layer: str
    # As `report` wrote it, or from the attributes of its block, or empty; in a plan never empty.
    name: str
    shape: Shape  # in the unit of the drawing; in a plan, and of modules, in m
    kind: LayerKind = LayerKind.NOT_READ
    is_ours: bool = False  # whether `report` wrote it
    heights: tuple[str, ...] = ()  # attributes of its block that give one, each as `HT 42`
    # of its modules, the most frequent first: their number, long side [m] and short side [m]
    sizes: tuple[tuple[int, float, float], ...] = ()
    rounded_m: float = 0.0  # step to which corners of turned modules are rounded; 0 for a fine one
    height_m: float = math.nan  # as written inside of it; NaN if it is not
    unnamed: str = ""  # whence its name is, if it is not in the drawing; empty if it is
    note: str = ""  # what was assumed; empty for nothing

    @property
    def modules(self) -> int:
        """Number of its modules; 0 where the drawing does not have them."""
        return sum(count for count, *_ in self.sizes)


@dataclass(frozen=True, slots=True, kw_only=True)
class Words:
    """A text of a drawing, or the first line of it, where it is, and its other lines."""

    layer: str
    text: str
    at: Point
    others: tuple[str, ...] = ()
    of: str = ""  # what `report` wrote it of, wherever it is; empty for none


@dataclass(frozen=True, slots=True, kw_only=True)
class Unread:
    """An entity of a drawing that was not understood, the reason, and details."""

    handle: str
    layer: str
    reason: str
    detail: str = ""


@dataclass(frozen=True, slots=True)
class RoofDrawing:
    """Contents of a drawing."""

    unit: str  # empty if it states none of `UNITS`
    other_unit: str = ""  # what to say of one of `OTHER_UNITS`; empty for none
    layouts: tuple[str, ...] = ()  # that have closed lines, which no plan is read from
    repairs: str = ""  # what to say of a damaged drawing; empty for a sound one
    lines: list[DrawnOutline] = field(default_factory=list)
    texts: list[Words] = field(default_factory=list)
    unread: list[Unread] = field(default_factory=list)
    counts: Counter[tuple[str, str]] = field(default_factory=Counter)  # by layer and kind of entity
    # By GEODATA, counterclockwise from +x; NaN for none. Not by `$NORTHDIRECTION`, "the angle
    # between the Y axis of WCS and the grid north" (AutoCAD help): its sense is not documented.
    north_deg: float = math.nan
    turned_deg: float = 0.0  # since it was read

    def turned(self, degrees: float) -> RoofDrawing:
        """Return the drawing turned counterclockwise about its origin, with its north."""
        places = turned([text.at for text in self.texts], degrees)
        return replace(
            self,
            lines=[
                replace(line, shape=Polygon(turned(line.shape.points, degrees)))
                for line in self.lines
            ],
            texts=[replace(text, at=place) for text, place in zip(self.texts, places, strict=True)],
            north_deg=(self.north_deg + degrees) % 360.0,
            turned_deg=self.turned_deg + degrees,
        )
