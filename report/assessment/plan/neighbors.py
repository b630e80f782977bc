"""Items on the plan near each array, and whether the workbook lists a clearance to them.

    +----+          +-------+
    | A1 |<-- gap ->| RTU-1 |    near: gap <= reach, twice the larger design displacement
    +----+          +-------+    short: no row of Clearances, and gap < required separation

Measures from the plan alone; decides nothing. Read `plan_pairs` first.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from enum import StrEnum
from itertools import combinations
from typing import TYPE_CHECKING

from report.assessment.design.routes import prescriptive_of
from report.assessment.design.rule_set import rule_set_of
from report.assessment.design.separation import ComparedGap, separation_m
from report.assessment.design.verdict import Verdict
from report.assessment.plan.bare_edges import bare_edges
from report.project.model import ProjectInput
from report.project.model.array import Array
from report.project.model.choices import Direction, DistanceBasis
from report.project.model.input_rows import Place
from report.project.model.roof import Clearance
from report.project.model.shapes import Rectangle, Shape, gap_m
from solver.model import INCH_M

if TYPE_CHECKING:
    from report.assessment.design.arrays import ArrayAssessment


# An array's neighbors are within this many design displacements: either of two arrays may move.
REACH_FACTOR = 2.0

# Largest difference [m] between a given clearance and the gap of the plan: an inch, within which
# `check` (`GAP_TOLERANCES_M`) stays, so that what passes there passes here.
AGREES_M = INCH_M

NOISE_M = 1e-9  # coordinates in feet are no round numbers of meters

_WAYS = (Direction.DOWN, Direction.ACROSS, Direction.UP, Direction.ACROSS)  # by quarter turns


class NearbyKind(StrEnum):
    """Type of item near an array."""

    ARRAY = "array"
    OBJECT = "object"
    BARE_EDGE = "edge of the roof, not entered"


class Cover(StrEnum):
    """Coverage of a pair on the plan by the clearances of the workbook."""

    AS_IN_PLAN = "agrees with the plan"
    DIFFERS = "differs from the plan"
    BEYOND = "agrees with plan; more than 2Δ apart"
    DRAWN = "from plan; not confirmed"
    CONFIRMED = "from plan; confirmed"
    SUFFICIENT = "not entered; at least as required"
    SHORT = "not entered; NG"


@dataclass(frozen=True, slots=True, kw_only=True)
class GivenGap:
    """An entered clearance between an array and an adjacent item, with the cell of its value."""

    number: int  # of its row, from 1
    clearance: Clearance
    basis: DistanceBasis
    cell: str


@dataclass(frozen=True, slots=True, kw_only=True)
class PlanNeighbor(ComparedGap):
    """An array, an object or a roof edge that is near an array or has a clearance entered."""

    # ids, in the order of the workbook between arrays; `other` names a bare edge in words
    array: str
    other: str
    kind: NearbyKind
    what: str  # kind of the other, in words
    # of the array, and of the other
    near: Shape
    far: Shape
    gap_m: float  # smallest distance in plan [m]; negative if they overlap
    # `REACH_FACTOR` times the larger design displacement of the two [m], or the prescriptive one
    # where none is permitted
    reach_m: float
    given: tuple[GivenGap, ...]  # clearances between them, from either side
    to_add: str  # cell of the table to which a missing row is to be added
    # required separation between them [m]; NaN without a permitted displacement
    required_m: float = math.nan
    mark: str = ""  # of the required separation

    @property
    def names(self) -> str:
        """The names of both."""
        return f"{self.array} to {self.other}"

    @property
    def numbers(self) -> str:
        """The numbers of its clearances, such as `No. 1, 3`."""
        return f"No. {', '.join(str(gap.number) for gap in self.given)}" if self.given else "—"

    @property
    def between(self) -> tuple[str, str]:
        """The items on either side."""
        return self.array, self.other

    @property
    def provided_m(self) -> float:
        """Separation on the plan [m]."""
        return self.gap_m

    @property
    def is_near(self) -> bool:
        """Whether it is within reach, or closer than required."""
        return self.gap_m <= self.reach_m or self.gap_m < self.required_m

    @property
    def is_listed(self) -> bool:
        """Whether it is near, or a clearance is entered."""
        return bool(self.given) or self.is_near

    @property
    def cover(self) -> Cover:
        """Coverage by its clearances, if it is listed."""
        if not self.given:
            return Cover.SHORT if self.is_short else Cover.SUFFICIENT
        if self.contradictions:
            return Cover.DIFFERS
        if not self.is_near:
            return Cover.BEYOND
        # What is from the plan is compared with nothing.
        bases = {row.basis for row in self.given}
        if DistanceBasis.DRAWN in bases:
            return Cover.DRAWN
        if DistanceBasis.CONFIRMED in bases:
            return Cover.CONFIRMED
        return Cover.AS_IN_PLAN

    @property
    def is_missing(self) -> bool:
        """Whether it is near and no clearance is entered."""
        return not self.given and self.is_near

    @property
    def verdict(self) -> Verdict:
        """Of a pair whose clearance is missing."""
        return Verdict.NG if self.is_short else Verdict.CONDITION

    @property
    def is_short(self) -> bool:
        """Whether no clearance is entered and the gap on the plan is not known to be sufficient."""
        # Where the required separation is NaN, the gap is not known to be sufficient.
        return self.is_missing and not self.gap_m >= self.required_m

    @property
    def contradictions(self) -> tuple[GivenGap, ...]:
        """The clearances that differ from the gap of the plan by more than `AGREES_M`."""
        return tuple(
            row for row in self.given if abs(row.clearance.provided_m - self.gap_m) > AGREES_M
        )

    def shortcomings(self) -> tuple[tuple[str, str], ...]:
        """Return each cell where it is missing or contradicts the plan, with the action to take."""
        if self.is_missing:
            remedy = (
                "add the edge as an object, and a clearance to it"
                if self.kind is NearbyKind.BARE_EDGE
                else "add a row with their clearance, or run roofslip plan clearances"
            )
            return ((self.to_add, remedy),)
        are_boxes = isinstance(self.near, Rectangle) and isinstance(self.far, Rectangle)
        shortcomings = []
        for row in self.contradictions:
            provided_m = row.clearance.provided_m
            breaks = self.gap_m < self.required_m <= provided_m  # sufficient only as given
            shapes = "rectangles" if are_boxes else "outlines"
            outcome = "; with the distance on the plan, it would be NG" if breaks else ""
            shortcomings.append((row.cell, f"correct the clearance or the {shapes}{outcome}"))
        return tuple(shortcomings)


def plan_pairs(
    data: ProjectInput,
    reaches: Sequence[tuple[Array, float]],
    addresses: Mapping[Place, str],
    required: Callable[[PlanNeighbor], tuple[float, str]],
) -> tuple[PlanNeighbor, ...]:
    """Return each array with each other shape in plan, and the separation [m] required."""
    pairs = [(near, *required(near)) for near in _pairs(data, reaches, addresses)]
    return tuple(
        near if math.isnan(value_m) else replace(near, required_m=value_m, mark=mark)
        for near, value_m, mark in pairs
    )


def _pairs(
    data: ProjectInput, reaches: Sequence[tuple[Array, float]], addresses: Mapping[Place, str]
) -> Iterator[PlanNeighbor]:
    rows = _rows(data, addresses)
    kinds = {item.id: item.kind.value for item in data.objects}
    to_add = {
        table: addresses.get(Place(table), table.capitalize())
        for table in ("objects", "clearances")
    }
    for array, neighbor, kind, (near, far), reach_m in _candidates(data, reaches):
        is_bare = kind is NearbyKind.BARE_EDGE
        yield PlanNeighbor(
            array=array,
            other=neighbor,
            kind=kind,
            what=kinds.get(neighbor, kind.value),
            near=near,
            far=far,
            gap_m=gap_m(near, far),
            reach_m=reach_m,
            # A bare side of the roof is no object: no row can name it. Of two arrays either may
            # have the row.
            given=() if is_bare else rows.get(frozenset((array, neighbor)), ()),
            to_add=to_add["objects" if is_bare else "clearances"],
        )


def _candidates(
    data: ProjectInput, reaches: Sequence[tuple[Array, float]]
) -> Iterator[tuple[str, str, NearbyKind, tuple[Shape, Shape], float]]:
    """Yield each array with what may be near it: their names, its kind, their shapes, reach [m]."""
    arrays = [(array.id, array.shape, reach_m) for array, reach_m in reaches]
    candidates = [(row.id, NearbyKind.OBJECT, row.placed) for row in data.objects if row.placed]
    candidates += [(f"the {e.name}", NearbyKind.BARE_EDGE, e.line) for e in bare_edges(data)]
    for (a, near, reach_m), (b, far, other_m) in combinations(arrays, 2):
        yield a, b, NearbyKind.ARRAY, (near, far), max(reach_m, other_m)
    for a, near, reach_m in arrays:
        for name, kind, far in candidates:
            yield a, name, kind, (near, far), reach_m


def reaches_of(arrays: Sequence[ArrayAssessment]) -> Sequence[tuple[Array, float]]:
    """Return each array with its reach [m]."""
    # Where no displacement is permitted, the prescriptive one says what may be near.
    reaches = []
    for item in arrays:
        is_permitted = not math.isnan(item.permitted_m)
        slides_m = item.permitted_m if is_permitted else item.prescriptive.value_m
        reaches.append((item.array, REACH_FACTOR * slides_m))
    return reaches


def _rows(
    data: ProjectInput, addresses: Mapping[Place, str]
) -> Mapping[frozenset[str], tuple[GivenGap, ...]]:
    """Return the clearances of the workbook by the two ids that they are between."""
    rows: dict[frozenset[str], tuple[GivenGap, ...]] = {}
    for index, row in enumerate(data.clearances):
        cell = addresses.get(Place("clearances", index, "provided_m"), "Clearances")
        key = frozenset((row.array, row.object))
        clearance = GivenGap(number=index + 1, clearance=row, basis=data.basis_of(row), cell=cell)
        rows[key] = (*rows.get(key, ()), clearance)
    return rows


def direction_of(near: PlanNeighbor, downslope_deg: float) -> Direction:
    """Return the direction of the whole distance of a pair, from its array; else any."""
    # No displacement whose component in that direction is less than the distance closes the gap.
    for turns, direction in enumerate(_WAYS):
        angle = math.radians(downslope_deg + 90.0 * turns)
        far, near_end = (
            [x * math.cos(angle) + y * math.sin(angle) for x, y in shape.points]
            for shape in (near.far, near.near)
        )
        if min(far) - max(near_end) >= near.gap_m - NOISE_M > 0.0:
            return direction
    return Direction.ANY


def pairs_before_runs(
    data: ProjectInput, addresses: Mapping[Place, str], arrays: Sequence[ArrayAssessment] = ()
) -> tuple[PlanNeighbor, ...]:
    """Return the pairs on the plan as in a package with the prescriptive displacement."""
    # Of arrays that have been run, larger design displacements count.
    rules, least_m = rule_set_of(data), design_before_runs_m(data)
    slides = {array.id: least_m for array in data.arrays} | larger_m(arrays, least_m)
    known = {array.id: array for array in data.arrays}
    rows = {item.id: item for item in data.objects} | known

    def required(near: PlanNeighbor) -> tuple[float, str]:
        design_m = max(slides[near.array], slides.get(near.other, 0.0))
        across = None if near.kind is NearbyKind.BARE_EDGE else rows[near.other]
        return separation_m(data, rules, design_m, known[near.array], across), ""

    reaches = [(array, REACH_FACTOR * slides[array.id]) for array in data.arrays]
    return plan_pairs(data, reaches, addresses, required)


def design_before_runs_m(data: ProjectInput) -> float:
    """Return the design displacement used before any run [m]: the prescriptive one."""
    # No floor on the displacement from analysis exceeds it, overridden or not.
    return prescriptive_of(data, rule_set_of(data)).value_m


def larger_m(arrays: Sequence[ArrayAssessment], least_m: float) -> dict[str, float]:
    """Return the permitted displacements of arrays that are larger than one [m]."""
    # NaN, of a displacement that is not permitted, is not larger.
    return {array.id: array.permitted_m for array in arrays if array.permitted_m > least_m}
