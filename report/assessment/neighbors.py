"""What the plan shows near each array, and whether the workbook gives a clearance to it.

Measures from the plan alone; decides nothing (`report.assessment.project`). Read `neighbors` first.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from enum import StrEnum
from itertools import combinations

from report.assessment.arrays import ArrayAssessment
from report.sheet.checks import gap_m
from report.sheet.fields import Place
from report.sheet.schema import Clearance, ObjectKind, ProjectInput, Rectangle
from report.words.units import Quantity, pair
from solver.model import INCH_M

REACH_FACTOR = 2.0
"""An array's neighbors are within this many design displacements."""

AGREES_M = INCH_M
"""Largest difference [m] between a given clearance and the gap of the plan."""

EDGE_STRIP_M = 0.3048
"""Largest distance [m] from a side of the roof to the strip of the object that stands for it."""

_COMPASS = ("east", "northeast", "north", "northwest", "west", "southwest", "south", "southeast")
_EDGES = (ObjectKind.EDGE_WITH_PARAPET, ObjectKind.EDGE_WITHOUT_PARAPET)


class NearbyKind(StrEnum):
    """What lies near an array."""

    ARRAY = "array"
    OBJECT = "object"
    BARE_EDGE = "edge of the roof, not given"


@dataclass(frozen=True, slots=True)
class BareEdge:
    """A side of the roof outline, or a part of it, along which no object is an edge.

    Attributes
    ----------
    name : str
        As in `west edge of the roof`.
    line : Rectangle
        Of no width.
    """

    name: str
    line: Rectangle


@dataclass(frozen=True, slots=True, kw_only=True)
class GivenGap:
    """A clearance of the workbook between an array and its neighbor, with the cell of its value."""

    clearance: Clearance
    cell: str


@dataclass(frozen=True, slots=True, kw_only=True)
class PlanNeighbor:
    """An array, an object or a roof edge near an array, or to which a clearance is given.

    Attributes
    ----------
    array, other : str
        Ids, in the order of the workbook between arrays; `other` names a bare edge in words.
    gap_m : float
        Smallest distance in plan [m]; negative if the rectangles overlap.
    reach_m : float
        `REACH_FACTOR` times the larger design displacement of the two [m].
    given : tuple of GivenGap
        Clearances between them, from either side.
    to_add : str
        Cell of the table to which a missing row is to be added.
    """

    array: str
    other: str
    kind: NearbyKind
    gap_m: float
    reach_m: float
    given: tuple[GivenGap, ...]
    to_add: str

    @property
    def is_missing(self) -> bool:
        """Whether it is within reach and no clearance is given."""
        return not self.given and self.gap_m <= self.reach_m

    @property
    def contradictions(self) -> tuple[GivenGap, ...]:
        """The clearances that differ from the gap of the plan by more than `AGREES_M`."""
        return tuple(
            row for row in self.given if abs(row.clearance.provided_m - self.gap_m) > AGREES_M
        )

    def shortcomings(self, us_first: bool) -> tuple[str, ...]:
        """Return in words what is missing or contradicts the plan, with the cell to change."""
        gap, reach = (pair(v, Quantity.SIZE, us_first) for v in (self.gap_m, self.reach_m))
        apart = f"{self.array} and {self.other} are {gap} apart in plan"
        if self.is_missing:
            what = (
                "add the edge as an object, and a clearance to it"
                if self.kind is NearbyKind.BARE_EDGE
                else "add a row with their clearance"
            )
            near = f"{apart}, within twice the design displacement ({reach})"
            return (f"{self.to_add}: {near}, and no clearance is given; {what}",)
        return tuple(
            f"{row.cell}: provided clearance is "
            f"{pair(row.clearance.provided_m, Quantity.SIZE, us_first)}, but {apart}; correct "
            "the clearance or the rectangles"
            for row in self.contradictions
        )


def neighbors(
    data: ProjectInput, arrays: Sequence[ArrayAssessment], addresses: Mapping[Place, str]
) -> tuple[PlanNeighbor, ...]:
    """Return each pair of arrays, array and object, array and bare roof edge of the plan.

    Of those, the pairs within reach or with a clearance. An object without a rectangle is in none
    of them (`unplaced`). An array without a design displacement reaches twice the prescriptive one.
    """
    return tuple(
        neighbor
        for neighbor in _pairs(data, arrays, addresses)
        if neighbor.given or neighbor.gap_m <= neighbor.reach_m
    )


def unplaced(data: ProjectInput) -> tuple[str, ...]:
    """Return the ids of objects that have neither a rectangle in plan nor a clearance."""
    named = {row.object for row in data.clearances}
    return tuple(
        item.id for item in data.objects if item.rectangle is None and item.id not in named
    )


def bare_edges(data: ProjectInput) -> tuple[BareEdge, ...]:
    """Return the parts of the roof outline along which no object is an edge, if it is given."""
    outline = data.roof.outline
    if outline is None:
        return ()
    strips = [item.rectangle for item in data.objects if item.kind in _EDGES]
    placed = [strip for strip in strips if strip is not None]
    return tuple(
        BareEdge(f"{_compass(outward_deg - data.roof.north_deg)} edge of the roof", line)
        for outward_deg, side in _sides(outline)
        for line in _bare(side, placed)
    )


def _compass(from_north_deg: float) -> str:
    """Return the point of the compass at an angle from north, counterclockwise."""
    return _COMPASS[round((from_north_deg + 90.0) / 45.0) % 8]


def _sides(outline: Rectangle) -> Iterator[tuple[float, Rectangle]]:
    """Yield the outward direction [deg] of each side, and the side."""
    x0, x1, y0, y1 = outline.x_from_m, outline.x_to_m, outline.y_from_m, outline.y_to_m
    yield 0.0, Rectangle(x1, x1, y0, y1)
    yield 90.0, Rectangle(x0, x1, y1, y1)
    yield 180.0, Rectangle(x0, x0, y0, y1)
    yield 270.0, Rectangle(x0, x1, y0, y0)


def _bare(side: Rectangle, strips: Sequence[Rectangle]) -> Iterator[Rectangle]:
    """Yield the parts of a side along which no strip lies; none shorter than `EDGE_STRIP_M`."""
    along_x = side.y_from_m == side.y_to_m
    low, high = (side.x_from_m, side.x_to_m) if along_x else (side.y_from_m, side.y_to_m)
    near = sorted(
        (strip.x_from_m, strip.x_to_m) if along_x else (strip.y_from_m, strip.y_to_m)
        for strip in strips
        if gap_m(side, strip) <= EDGE_STRIP_M
    )
    at = low
    for start, end in [*near, (high, high)]:
        if start - at > EDGE_STRIP_M:
            stop = min(start, high)
            yield (
                Rectangle(at, stop, side.y_from_m, side.y_to_m)
                if along_x
                else Rectangle(side.x_from_m, side.x_to_m, at, stop)
            )
        at = max(at, end)


Rows = Mapping[frozenset[str], tuple[GivenGap, ...]]
"""Clearances of the workbook by the two ids that they are between."""


def _pairs(
    data: ProjectInput, arrays: Sequence[ArrayAssessment], addresses: Mapping[Place, str]
) -> Iterator[PlanNeighbor]:
    rows = _rows(data, addresses)
    table = addresses.get(Place("clearances"), "Clearances")
    for a, b in combinations(arrays, 2):
        yield PlanNeighbor(
            array=a.id,
            other=b.id,
            kind=NearbyKind.ARRAY,
            gap_m=gap_m(a.array.rectangle, b.array.rectangle),
            reach_m=max(_reach_m(a), _reach_m(b)),
            given=rows.get(frozenset((a.id, b.id)), ()),
            to_add=table,
        )
    edges = bare_edges(data)
    for array in arrays:
        yield from _objects_of(array, data, rows, table)
        yield from _edges_of(array, edges, addresses.get(Place("objects"), "Objects"))


def _objects_of(
    array: ArrayAssessment, data: ProjectInput, rows: Rows, table: str
) -> Iterator[PlanNeighbor]:
    for item in data.objects:
        if item.rectangle is not None:
            yield PlanNeighbor(
                array=array.id,
                other=item.id,
                kind=NearbyKind.OBJECT,
                gap_m=gap_m(array.array.rectangle, item.rectangle),
                reach_m=_reach_m(array),
                given=rows.get(frozenset((array.id, item.id)), ()),
                to_add=table,
            )


def _edges_of(
    array: ArrayAssessment, edges: Sequence[BareEdge], table: str
) -> Iterator[PlanNeighbor]:
    for edge in edges:
        yield PlanNeighbor(
            array=array.id,
            other=f"the {edge.name}",
            kind=NearbyKind.BARE_EDGE,
            gap_m=gap_m(array.array.rectangle, edge.line),
            reach_m=_reach_m(array),
            given=(),
            to_add=table,
        )


def _reach_m(array: ArrayAssessment) -> float:
    moves = array.prescriptive.value_m if math.isnan(array.design_m) else array.design_m
    return REACH_FACTOR * moves


def _rows(data: ProjectInput, addresses: Mapping[Place, str]) -> Rows:
    rows: dict[frozenset[str], tuple[GivenGap, ...]] = {}
    for index, row in enumerate(data.clearances):
        cell = addresses.get(Place("clearances", index, "provided_m"), "Clearances")
        key = frozenset((row.array, row.object))
        rows[key] = (*rows.get(key, ()), GivenGap(clearance=row, cell=cell))
    return rows
