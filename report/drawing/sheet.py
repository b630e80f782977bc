"""A roof plan while it is drawn: its paper, what is on the roof, and what found no room.

Read `report.drawing.on_paper` first.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property

from report.assessment.neighbors import EDGES
from report.assessment.plan_gaps import PlanGap, plan_gaps, shapes_of
from report.assessment.project import Assessment
from report.drawing.items import Mark
from report.drawing.layers import Layer
from report.drawing.paper import Paper, text_size
from report.drawing.placer import Frame
from report.drawing.widths import tick_text
from report.entities.columns import UnitFormat
from report.sheet.schema.scene import RoofObject
from report.sheet.schema.shapes import Point, Shape, room

LEADER_IN = 1.5  # farthest label


@dataclass(frozen=True, slots=True, kw_only=True)
class PlanSize:
    """Size of a plan on paper [in].

    Attributes
    ----------
    tall : float
        Greatest height.
    key_wide, key_tall : float
        Of the legend, to the right of the plan, or on a screen below it. That of a full plan is on
        a paper of its own.
    sheet : str
        Which of the large sheets a full plan is printed on, by its name in the package; none on
        the sheets of the other parts.
    columns : int
        Columns of tables beside a full plan.
    is_full : bool
        Whether with envelopes, dimensions and coordinates.
    is_screen : bool
        Whether as large as there is room, with dimensions, and arrays labeled before them.
    """

    wide: float
    tall: float
    key_wide: float = 0.0
    key_tall: float = 0.0
    sheet: str = ""
    columns: int = 0
    is_full: bool = False
    is_screen: bool = False

    @property
    def fringe(self) -> tuple[float, float, float, float]:
        """Margins [in] of the roof: left, right, bottom, top."""
        return (0.62, 0.26, 0.48, 0.26) if self.is_full else (0.24, 0.24, 0.24, 0.24)


COLUMN_IN = 2.8
"""Width of a column of tables beside a full plan, with its distance."""


def _large(sheet: str, wide: float, tall: float) -> tuple[PlanSize, ...]:
    """Return full plans beside one and two columns of tables on a sheet with this room [in]."""
    return tuple(
        PlanSize(wide=wide - n * COLUMN_IN, tall=tall, columns=n, sheet=sheet, is_full=True)
        for n in (1, 2)
    )


# A sheet less what a heading and the legend take, and on a large one notes and the title block.
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
        """What it is called where it has no label."""
        of = self.of
        return f"clearance {of.number}" if of.is_given else f"{of.array} to {of.other}"

    @property
    def middle(self) -> Point:
        """The middle of its dimension line."""
        return (self.a[0] + self.b[0]) / 2, (self.a[1] + self.b[1]) / 2


@dataclass(frozen=True, kw_only=True)
class PlanSheet:
    """A plan while it is drawn.

    Attributes
    ----------
    designs : mapping of str to str
        The design displacement of each array, where it is worded elsewhere.
    has_verdicts : bool
        Whether it says which gaps are NG.
    unnamed : list of str
        What found no room for its label so far, and has none.
    crowded : list of str
        What found no room for its label, or for all of it, near its place.
    """

    assessment: Assessment
    size: PlanSize
    paper: Paper
    designs: Mapping[str, str]
    has_verdicts: bool
    unnamed: list[str] = field(default_factory=list)
    crowded: list[str] = field(default_factory=list)

    @cached_property
    def shapes(self) -> Mapping[str, Shape]:
        """What is on the plan, by name [m]."""
        return shapes_of(self.assessment)

    @cached_property
    def gaps(self) -> Sequence[Gap]:
        """The clearances between shapes, and what is NG without one."""
        return [Gap(gap, *map(self.paper.at, gap.ends)) for gap in plan_gaps(self.assessment)]

    @property
    def fmt(self) -> UnitFormat:
        """The units of the plan."""
        return unit_format(self.assessment)

    @cached_property
    def printed(self) -> Callable[[str], str]:
        """How the names of arrays and objects are printed."""
        return tick_text if self.size.is_screen else self.assessment.project.names

    @property
    def envelopes(self) -> Collection[Layer]:
        """Which of the outlines that show how far an array may move are drawn."""
        if self.size.is_full:
            return (Layer.RUNS, Layer.DESIGN)
        return (Layer.DESIGN,) if self.size.is_screen else ()

    @property
    def leader_in(self) -> float:
        """Farthest label: a small plan leaves out what it has no room for."""
        return LEADER_IN if self.size.is_full or self.size.is_screen else 0.4 * LEADER_IN

    @property
    def placed(self) -> list[RoofObject]:
        """The objects on the plan that are no edges."""
        return [item for item in self._objects if item.kind not in EDGES]

    @property
    def edges(self) -> list[RoofObject]:
        """The roof edges on the plan."""
        return [item for item in self._objects if item.kind in EDGES]

    @property
    def _objects(self) -> list[RoofObject]:
        return [item for item in self.assessment.project.objects if item.id in self.shapes]

    def is_ng(self, gap: Gap) -> bool:
        """Whether the plan says that a gap is not satisfied."""
        return self.has_verdicts and gap.of.is_ng

    def room(self, name: str) -> Frame:
        """Return where there is room on paper within a shape."""
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

    def name_beside(self, frame: Frame, name: str) -> None:
        """Name an array or an object outside of it: on a full plan far from it rather than not."""
        if self.beside(frame, [name]):
            return
        self.crowded.append(name)
        if not self.size.is_full or not self.beside(frame, [name], is_last=True):
            self.unnamed.append(name)

    def beside(
        self,
        frame: Frame,
        lines: Sequence[str],
        radius: float = 0.0,
        *,
        is_last: bool = False,
    ) -> bool:
        """Write outside of something, with a leader from its middle or a circle about that.

        Return whether there is room for it; if it `is_last`, also far away and across others.
        """
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
