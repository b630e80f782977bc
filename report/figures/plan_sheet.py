"""A roof plan while it is drawn: its paper, what is on the roof, and what found no room.

Read `report.figures.plan` first.
"""

from __future__ import annotations

import math
from collections.abc import Container
from dataclasses import dataclass, field

from report.assessment.plan_gaps import PlanGap, plan_gaps, shapes_of
from report.assessment.project import Assessment
from report.figures.base import GRAY
from report.figures.labels import Frame
from report.figures.paper_plan import PlanPaper, text_size
from report.figures.plan_key import EDGES, FILLS
from report.sheet.schema import ObjectKind, RoofObject, Shape
from report.sheet.schema.shapes import Point, room
from report.words.units import Quantity, measured, pair

LEADER_IN = 1.5  # farthest label


@dataclass(frozen=True, slots=True, kw_only=True)
class PlanSize:
    """Size of a plan on paper [in].

    Attributes
    ----------
    tall : float
        Greatest height.
    key_wide, key_tall : float
        Of the legend, to the right of the plan, or below it where it is as wide as the paper.
    is_full : bool
        Whether with envelopes, dimensions, legend, notes and coordinates.
    """

    wide: float
    tall: float
    key_wide: float
    key_tall: float
    is_full: bool

    @property
    def is_key_below(self) -> bool:
        """Whether the legend is below the plan."""
        return self.key_wide == self.wide

    @property
    def fringe(self) -> tuple[float, float, float, float]:
        """Margins [in] of the roof: left, right, bottom, top."""
        return (0.62, 0.26, 0.64, 0.26) if self.is_full else (0.24, 0.24, 0.24, 0.24)


SMALL = PlanSize(wide=6.7, tall=2.95, key_wide=2.05, key_tall=0.95, is_full=False)
LANDSCAPE = PlanSize(wide=9.2, tall=5.4, key_wide=2.15, key_tall=5.4, is_full=True)
PORTRAIT = PlanSize(wide=6.7, tall=8.05, key_wide=6.7, key_tall=2.1, is_full=True)


@dataclass(frozen=True, slots=True)
class Gap:
    """A gap of the plan; the ends of its dimension line on paper."""

    of: PlanGap
    a: Point
    b: Point

    @property
    def middle(self) -> Point:
        """The middle of its dimension line."""
        return (self.a[0] + self.b[0]) / 2, (self.a[1] + self.b[1]) / 2


@dataclass(frozen=True, slots=True)
class PlanSheet:
    """A plan while it is drawn.

    Attributes
    ----------
    shapes : dict of str to Shape
        What is on the plan, by name [m].
    gaps : tuple of Gap
        The clearances between shapes, and what is NG without one.
    unnamed : list of str
        What found no room for its label so far.
    """

    assessment: Assessment
    size: PlanSize
    paper: PlanPaper
    shapes: dict[str, Shape]
    gaps: tuple[Gap, ...]
    unnamed: list[str] = field(default_factory=list)

    @classmethod
    def of(cls, assessment: Assessment, size: PlanSize, paper: PlanPaper) -> PlanSheet:
        """Return the empty sheet of an assessment."""
        gaps = (Gap(gap, *map(paper.at, gap.ends)) for gap in plan_gaps(assessment))
        return cls(assessment, size, paper, shapes_of(assessment), tuple(gaps))

    @property
    def us_first(self) -> bool:
        """Whether US units come first."""
        return is_us_first(self.assessment)

    @property
    def leader_in(self) -> float:
        """Farthest label: the small plan leaves out what it has no room for."""
        return LEADER_IN if self.size.is_full else 0.4 * LEADER_IN

    @property
    def placed(self) -> list[RoofObject]:
        """The objects on the plan that are no edges."""
        return self._of_kinds(FILLS)

    @property
    def edges(self) -> list[RoofObject]:
        """The roof edges on the plan."""
        return self._of_kinds(EDGES)

    def room(self, name: str) -> Frame:
        """Return where there is room on paper within a shape."""
        return self.paper.frame(room(self.shapes[name]))

    def _of_kinds(self, kinds: Container[ObjectKind]) -> list[RoofObject]:
        data = self.assessment.project
        return [item for item in data.objects if item.id in self.shapes and item.kind in kinds]

    def both(self, value_m: float) -> str:
        """Return a length in both systems of units."""
        return pair(value_m, Quantity.SIZE, self.us_first)

    def first(self, value_m: float) -> str:
        """Return a length in the first system of units."""
        unit = Quantity.SIZE.us if self.us_first else Quantity.SIZE.si
        return f"{measured(value_m, unit)} {unit.symbol}"

    def leader(self, start: Point, label: Frame) -> None:
        """Draw a line from a point to the nearest point of a label."""
        end = (min(max(start[0], label.x0), label.x1), min(max(start[1], label.y0), label.y1))
        if math.dist(start, end) > 0.0:
            self.paper.line(start, end, linewidth=0.6, color=GRAY)
            self.paper.placer.take_segment(start, end)

    def beside(self, frame: Frame, words: str) -> None:
        """Name something outside of it, with a leader."""
        size = text_size([words])
        label = self.paper.placer.place(*size, frame.middle, maximum=self.leader_in)
        if label is None:
            self.unnamed.append(words)
            return
        self.leader(frame.middle, label)
        self.paper.box(label, facecolor="white", edgecolor=GRAY, linewidth=0.4, zorder=2)
        self.paper.lines(label, [words])


def is_us_first(assessment: Assessment) -> bool:
    """Whether US units come first in a project."""
    return assessment.project.project.units_first.is_us
