"""What a roof drawing consists of, as data: closed lines, texts, and what was not understood.

`report.drawing.read_dxf` fills it, and `report.drawing.plan_read` says what of it is the plan.
"""

from __future__ import annotations

import cmath
import math
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass, field, replace

from report.sheet.schema.shapes import Point


@dataclass(frozen=True, slots=True, kw_only=True)
class Drawn:
    """A closed line of a drawing.

    Attributes
    ----------
    handle : str
        Of the line, or of the first of those that are joined.
    name : str
        As `report` wrote it, or from the attributes of its block; empty if neither.
    points : tuple of Point
        A ring, not repeated, in the unit of the drawing.
    is_ours : bool
        Whether `report` wrote it.
    heights : tuple of str
        Attributes of its block that give a height, each as `HT 42`.
    sizes : tuple of (int, float, float)
        Number, long side [m] and short side [m] of each size of the modules that it is the outline
        of, the most frequent first; then its points are in m.
    """

    handle: str
    layer: str
    name: str
    points: tuple[Point, ...]
    is_ours: bool
    heights: tuple[str, ...] = ()
    sizes: tuple[tuple[int, float, float], ...] = ()


@dataclass(frozen=True, slots=True, kw_only=True)
class Words:
    """A text of a drawing, or the first line of it, where it is, and its other lines.

    Attributes
    ----------
    of : str
        What `report` wrote it of, wherever it is; empty for none.
    """

    layer: str
    text: str
    at: Point
    others: tuple[str, ...] = ()
    of: str = ""


@dataclass(frozen=True, slots=True, kw_only=True)
class Unread:
    """Something of a drawing that was not understood, why, and what of it."""

    handle: str
    layer: str
    reason: str
    detail: str = ""


@dataclass(frozen=True, slots=True)
class RoofDrawing:
    """What a drawing consists of.

    Attributes
    ----------
    unit : str
        Empty if it states none of `UNITS`.
    other_unit : str
        What it states of `OTHER_UNITS`, as a sentence goes on after its name; empty for none.
    layouts : tuple of str
        Those that have closed lines, which no plan is read from.
    repairs : str
        What to say of a damaged drawing; empty for a sound one.
    counts : Counter of tuple of str
        How many of each layer and kind of entity there are.
    north_deg : float
        Direction of north by GEODATA, counterclockwise from +x; NaN for none. Not by
        `$NORTHDIRECTION`, "the angle between the Y axis of WCS and the grid north" (AutoCAD help)
        in a sense that is not documented.
    """

    unit: str
    other_unit: str = ""
    layouts: tuple[str, ...] = ()
    repairs: str = ""
    lines: list[Drawn] = field(default_factory=list)
    texts: list[Words] = field(default_factory=list)
    unread: list[Unread] = field(default_factory=list)
    counts: Counter[tuple[str, str]] = field(default_factory=Counter)
    north_deg: float = math.nan

    def turned(self, degrees: float) -> RoofDrawing:
        """Return the drawing turned counterclockwise about its origin, with its north."""
        places = turned([text.at for text in self.texts], degrees)
        return replace(
            self,
            lines=[replace(line, points=turned(line.points, degrees)) for line in self.lines],
            texts=[replace(text, at=at) for text, at in zip(self.texts, places, strict=True)],
            north_deg=(self.north_deg + degrees) % 360.0,
        )


def turned(points: Sequence[Point], degrees: float) -> tuple[Point, ...]:
    """Return points turned counterclockwise about the origin."""
    turn = cmath.rect(1.0, math.radians(degrees))
    found = (complex(*point) * turn for point in points)
    return tuple((z.real, z.imag) for z in found)
