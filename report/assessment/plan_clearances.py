"""The clearances that a plan calls for, before any run or after it, and rows that a workbook lacks.

Writes nothing (`report.project.write.filled`). Read `pairs_before_runs`, then `missing_rows`.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

from report.assessment.clearances import ClearanceCheck, separation_m
from report.assessment.neighbors import REACH_FACTOR, NearbyKind, PlanNeighbor, plan_pairs
from report.assessment.routes import prescriptive_of
from report.assessment.verdict import Verdict, rule_set_of
from report.project.model import ProjectInput
from report.project.model.choices import ClearanceSource, Direction, ObjectKind
from report.project.model.place import Place
from report.project.model.scene import RoofObject
from report.project.model.shapes import Point, Shape, closest
from report.project.read.parts import DIGITS, GrowingTable, Value
from report.project.read.positions import CellPosition
from report.project.read.read import Sheet, without_motions
from report.text.counts import numbered
from report.text.units import Quantity, Show, no_less, no_more, pair, round_down
from solver.model import INCH_M
from solver.rules.provisions import Neighbor

if TYPE_CHECKING:
    from report.assessment.arrays import ArrayAssessment
    from report.assessment.project import Assessment

# Distances are rounded down to a multiple of this [m]: what is written is never more than is there.
US_STEP_M, SI_STEP_M = 0.1 * INCH_M, 0.001

_NOISE_M = 1e-9  # coordinates in feet are no round numbers of meters
_WAYS = (Direction.DOWN, Direction.ACROSS, Direction.UP, Direction.ACROSS)  # by quarter turns


def pairs_before_runs(
    data: ProjectInput, addresses: Mapping[Place, str], arrays: Sequence[ArrayAssessment] = ()
) -> tuple[PlanNeighbor, ...]:
    """Return the pairs of the plan as a package has them at the prescriptive displacement."""
    # Of arrays that have been run, larger design displacements count.
    rules, least_m = rule_set_of(data), design_before_runs_m(data)
    slides = {array.id: least_m for array in data.arrays} | _larger_m(arrays, least_m)
    known = {array.id: array for array in data.arrays}
    rows = {item.id: item for item in data.objects} | known

    def required(near: PlanNeighbor) -> tuple[float, str]:
        design_m = max(slides[near.array], slides.get(near.other, 0.0))
        other = None if near.kind is NearbyKind.BARE_EDGE else rows[near.other]
        return separation_m(data, rules, design_m, known[near.array], other), ""

    reaches = [(array, REACH_FACTOR * slides[array.id]) for array in data.arrays]
    return plan_pairs(data, reaches, addresses, required)


def design_before_runs_m(data: ProjectInput) -> float:
    """Return the design displacement that is taken before any run [m]: the prescriptive one."""
    # No floor on the displacement from analysis exceeds it, overridden or not.
    return prescriptive_of(data, rule_set_of(data)).value_m


def _larger_m(arrays: Sequence[ArrayAssessment], least_m: float) -> dict[str, float]:
    # NaN, of a displacement that is not permitted, is not larger.
    return {array.id: array.permitted_m for array in arrays if array.permitted_m > least_m}


def missing_rows(
    sheet: Sheet, arrays: Sequence[ArrayAssessment] = ()
) -> tuple[dict[CellPosition, Value], tuple[str, ...]]:
    """Return the cells of a row for each pair that a package would name as missing, and lines.

    Rows whose distance is from the drawing are renewed. A line for each row that is new, renewed or
    differs from the plan, and for each pair that still lacks one; at last their counts. `arrays`
    are as run, none where nothing is.

    Raises `InputError` for what is wrong elsewhere than in motions and clearances, or if the rows
    have no place.
    """
    data = without_motions(sheet)
    us_first = data.us_first
    pairs = pairs_before_runs(data, sheet.addresses, arrays)
    missing = [near for near in pairs if near.is_missing]
    new = [near for near in missing if _has_row(near)]
    table = GrowingTable.of(sheet.book, "clearances")
    cells, written = _written(table, data, new)
    newer, renewed = _renewed(table, data, pairs)
    design_m, basis = design_before_runs_m(data), "the prescriptive displacement"
    if larger := _larger_m(arrays, design_m):
        farthest = max(larger, key=larger.__getitem__)
        design_m, basis = larger[farthest], f"the design displacement of {farthest}"
    elif arrays:
        basis += ", which no design displacement exceeds"
    lines = [
        *written,
        *renewed,
        *_differing(pairs, us_first),
        *(f"not added: {near.names}, {_size(near.gap_m, us_first)}; correct the plan, or give the "
          "roof edge as an object" for near in missing if not _has_row(near)),
        f"{numbered(len(new), 'clearance')} added{f', {len(renewed)} renewed' if renewed else ''},"
        f" {len(data.clearances) - len(renewed)} kept; reach"
        f" {_size(REACH_FACTOR * design_m, us_first, no_less)}, twice {basis}",
    ]  # fmt: skip
    return cells | newer, tuple(lines)


def without_clearances(sheet: Sheet) -> Sheet:
    """Return a workbook without its clearances, on which no displacement depends, to be run."""
    problems = tuple(item for item in sheet.problems if item[0].section != "clearances")
    return replace(sheet, inputs={**sheet.inputs, "clearances": ()}, problems=problems)


def _has_row(near: PlanNeighbor) -> bool:
    """Whether a pair can have a row: not with a bare edge, nor where the two overlap."""
    return near.kind is not NearbyKind.BARE_EDGE and near.gap_m >= -_NOISE_M


def direction_of(near: PlanNeighbor, downslope_deg: float) -> Direction:
    """Return the direction in which the whole distance of a pair lies, from its array; else any."""
    # No displacement whose component in that direction is less than the distance closes the gap.
    for turns, direction in enumerate(_WAYS):
        angle = math.radians(downslope_deg + 90.0 * turns)
        far, own = (
            [x * math.cos(angle) + y * math.sin(angle) for x, y in shape.points]
            for shape in (near.far, near.near)
        )
        if min(far) - max(own) >= near.gap_m - _NOISE_M > 0.0:
            return direction
    return Direction.ANY


def _size(value_m: float, us_first: bool, show: Show = no_more) -> str:
    return pair(value_m, Quantity.SIZE, us_first, show)


def _written(
    table: GrowingTable, data: ProjectInput, new: Sequence[PlanNeighbor]
) -> tuple[dict[CellPosition, Value], list[str]]:
    """Return the cells of new rows, and a line for each row."""
    cells: dict[CellPosition, Value] = {}
    lines: list[str] = []
    downslope_deg = {array.id: array.downslope_deg for array in data.arrays}
    for near in new:
        row, drawn_m = table.added(), _drawn_m(near, data)
        direction = direction_of(near, downslope_deg[near.array])
        names: dict[str, Value] = {"array": near.array, "object": near.other}
        cells |= table.cells(row, names | _from_drawing(table, direction, drawn_m))
        at = table.position(row, "array").address
        lines.append(f"{at}: {near.names}, {direction}, {_size(drawn_m, data.us_first)}")
    return cells, lines


def _renewed(
    table: GrowingTable, data: ProjectInput, pairs: Sequence[PlanNeighbor]
) -> tuple[dict[CellPosition, Value], list[str]]:
    """Return the cells of rows from the drawing that differ from the plan, and a line for each."""
    rows = {table.position(row, "provided_m").address: row for row in table.found.rows}
    downslope_deg = {array.id: array.downslope_deg for array in data.arrays}
    cells: dict[CellPosition, Value] = {}
    lines: list[str] = []
    for near in pairs:
        for entered in near.given:
            was, drawn_m = entered.clearance, _drawn_m(near, data)
            if was.source is not ClearanceSource.DRAWING:
                continue
            turned = near
            if was.array != near.array:
                turned = replace(near, array=near.other, near=near.far, far=near.near)
            direction = was.direction
            if len(near.given) == 1:  # the directions of several rows of a pair differ
                direction = direction_of(turned, downslope_deg[turned.array])
            if abs(was.provided_m - drawn_m) > _NOISE_M or direction is not was.direction:
                cells |= table.cells(rows[entered.cell], _from_drawing(table, direction, drawn_m))
                before, now = (
                    _size(value_m, data.us_first) for value_m in (was.provided_m, drawn_m)
                )
                lines.append(f"{entered.cell}: {near.names}: {was.direction}, {before}; now"
                             f" {direction}, {now}")  # fmt: skip
    return cells, lines


def _drawn_m(near: PlanNeighbor, data: ProjectInput) -> float:
    step_m = US_STEP_M if data.us_first else SI_STEP_M
    return round_down(max(near.gap_m, 0.0) / step_m, 0) * step_m


def _from_drawing(table: GrowingTable, direction: Direction, drawn_m: float) -> dict[str, Value]:
    return {
        "direction": direction.value,
        # Down once more: 0.1 in is no round number of feet.
        "provided_m": round_down(drawn_m / table.found.columns["provided_m"].si, DIGITS),
        "source": ClearanceSource.DRAWING.value,
    }


def _differing(pairs: Sequence[PlanNeighbor], us_first: bool) -> Iterator[str]:
    """Yield the rows as entered or measured whose distance is not that of the plan."""
    for near in pairs:
        for row in near.given:
            if row.clearance.source is ClearanceSource.DRAWING:
                continue
            if abs(row.clearance.provided_m - near.gap_m) > US_STEP_M + _NOISE_M:
                values = (row.clearance.provided_m, near.gap_m)
                entered, drawn = (_size(value, us_first) for value in values)
                yield f"{row.cell}: {near.names}: {entered} entered, {drawn} in plan"


@dataclass(frozen=True, slots=True, kw_only=True)
class PlanGap:
    """A clearance between two shapes of the plan, or a gap without one that is NG."""

    number: int  # in the workbook, from 1; 0 where no clearance is given
    # what it is between; `other` names a bare roof edge in words
    array: str
    other: str
    near: Shape
    far: Shape
    provided_m: float  # as given [m]; where no clearance is, the gap of the plan
    required_m: float  # required separation [m]; NaN if it is not known
    mark: str  # of the required separation
    verdict: Verdict

    @property
    def is_given(self) -> bool:
        """Whether the workbook has the clearance."""
        return self.number > 0

    @property
    def is_ng(self) -> bool:
        """Whether it is not satisfied."""
        return self.verdict is Verdict.NG

    @property
    def ends(self) -> tuple[Point, Point]:
        """The points nearest to each other [m]."""
        return closest(self.near, self.far)


def plan_gaps(assessment: Assessment) -> Iterator[PlanGap]:
    """Yield the clearances between shapes in plan, and after them what is NG without one."""
    shapes = shapes_of(assessment.project)
    gaps: list[tuple[int, ClearanceCheck | PlanNeighbor]]
    gaps = [*enumerate(assessment.clearances, start=1)]
    for number, gap in (*gaps, *((0, missing) for missing in assessment.missing_gaps)):
        array, other = gap.between
        far = gap.far if isinstance(gap, PlanNeighbor) else shapes.get(other)
        if far is not None:  # an object may have no place in plan
            yield PlanGap(
                number=number,
                array=array,
                other=other,
                near=shapes[array],
                far=far,
                provided_m=gap.provided_m,
                required_m=gap.required_m,
                mark=gap.mark,
                verdict=gap.verdict,
            )


def shapes_of(data: ProjectInput) -> dict[str, Shape]:
    """Return the arrays and the objects that have a place in plan, by id."""
    shapes: dict[str, Shape] = {item.id: item.placed for item in data.objects if item.placed}
    return shapes | {array.id: array.shape for array in data.arrays}


def parapet_note(assessment: Assessment, item: RoofObject) -> str:
    """Return that a parapet does not qualify, and for which arrays where it does for others."""
    gaps = [gap for gap in assessment.clearances if gap.clearance.object == item.id]
    arrays = [gap.clearance.array for gap in gaps if gap.neighbor is Neighbor.EDGE]
    if item.kind is not ObjectKind.EDGE_WITH_PARAPET or not arrays:
        return ""
    return ", does not qualify" + (f" for {', '.join(arrays)}" if len(arrays) < len(gaps) else "")
