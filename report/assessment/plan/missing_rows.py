"""The rows of clearances that a plan requires and a workbook lacks.

Writes nothing (`report.project.write.filled`). Read `missing_rows`.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

from report.assessment.plan.neighbors import (
    NOISE_M,
    REACH_FACTOR,
    NearbyKind,
    PlanNeighbor,
    design_before_runs_m,
    direction_of,
    larger_m,
    pairs_before_runs,
)
from report.project.model import ProjectInput
from report.project.model.choices import ClearanceSource, Direction
from report.project.read.changed_cells import Value
from report.project.read.positions import CellPosition
from report.project.read.read import without_motions
from report.project.read.workbook_data import Sheet
from report.project.write.filled import DIGITS, WorkbookChange
from report.text.counts import numbered
from report.text.units import Quantity, Show, no_less, no_more, pair, round_down
from solver.model import INCH_M

if TYPE_CHECKING:
    from report.assessment.design.arrays import ArrayAssessment


# Distances are rounded down to a multiple of this [m]: what is written is never more than is there.
US_STEP_M, SI_STEP_M = 0.1 * INCH_M, 0.001
_KEY = "clearances"  # the table that rows are added to


def missing_rows(
    sheet: Sheet, arrays: Sequence[ArrayAssessment] = ()
) -> tuple[dict[CellPosition, Value], tuple[str, ...]]:
    """Return the cells of a row for each pair that a package would list as missing, and lines.

    Rows whose distance is from the drawing are renewed. A line for each row that is new, renewed or
    differs from the plan, and for each pair that still lacks one; at last their counts. `arrays`
    are as run, none where nothing is.

    Raises `InputError` for what is wrong elsewhere than in motions and clearances, or if the rows
    have no place.
    """
    # Motions may be missing or wrong yet: the rows need the plan alone.
    data = without_motions(sheet)
    us_first = data.us_first
    pairs = pairs_before_runs(data, sheet.addresses, arrays)
    missing = [near for near in pairs if near.is_missing]
    gaps = [near for near in missing if _has_row(near)]
    change = WorkbookChange(sheet.book)
    written = _written(change, data, gaps)
    renewed = _renewed(change, data, pairs)
    design_m, basis = design_before_runs_m(data), "the prescriptive displacement"
    if larger := larger_m(arrays, design_m):
        farthest = max(larger, key=larger.__getitem__)
        design_m, basis = larger[farthest], f"the design displacement of {farthest}"
    elif arrays:
        basis += ", which no design displacement exceeds"
    lines = [
        *written,
        *renewed,
        *_differing(pairs, us_first),
        *(f"not added: {near.names}, {_size(near.gap_m, us_first)}; correct the plan, or enter the "
          "roof edge as an object" for near in missing if not _has_row(near)),
        f"{numbered(len(gaps), 'clearance')} added{f', {len(renewed)} renewed' if renewed else ''},"
        f" {len(data.clearances) - len(renewed)} kept; reach"
        f" {_size(REACH_FACTOR * design_m, us_first, no_less)}, twice {basis}",
    ]  # fmt: skip
    return change.cells, tuple(lines)


def without_clearances(sheet: Sheet) -> Sheet:
    """Return a workbook without its clearances, on which no displacement depends, to be run."""
    problems = tuple(item for item in sheet.problems if item[0].section != "clearances")
    return replace(sheet, inputs={**sheet.inputs, "clearances": ()}, problems=problems)


def _has_row(near: PlanNeighbor) -> bool:
    """Whether a pair can have a row: not with a bare edge, nor where the two overlap."""
    return near.kind is not NearbyKind.BARE_EDGE and near.gap_m >= -NOISE_M


def _size(value_m: float, us_first: bool, show: Show = no_more) -> str:
    return pair(value_m, Quantity.SIZE, us_first, show)


def _written(
    change: WorkbookChange, data: ProjectInput, added: Sequence[PlanNeighbor]
) -> list[str]:
    """Put the cells of new rows, and return a line for each row."""
    lines: list[str] = []
    downslope_deg = {array.id: array.downslope_deg for array in data.arrays}
    for near in added:
        row, drawn_m = change.added_row(_KEY), _drawn_m(near, data)
        direction = direction_of(near, downslope_deg[near.array])
        names: dict[str, Value] = {"array": near.array, "object": near.other}
        change.put(_KEY, row, names | _from_drawing(change, direction, drawn_m))
        address = change.position(_KEY, row, "array").address
        lines.append(f"{address}: {near.names}, {direction}, {_size(drawn_m, data.us_first)}")
    return lines


def _renewed(
    change: WorkbookChange, data: ProjectInput, pairs: Sequence[PlanNeighbor]
) -> list[str]:
    """Put the cells of rows from the drawing that differ from the plan; return a line for each."""
    numbers = change.table(_KEY).rows
    rows = {change.position(_KEY, row, "provided_m").address: row for row in numbers}
    downslope_deg = {array.id: array.downslope_deg for array in data.arrays}
    lines: list[str] = []
    for near in pairs:
        for entered in near.given:
            was, drawn_m = entered.clearance, _drawn_m(near, data)
            # Only rows that a command wrote are written again: what a person entered or measured
            # is theirs, and a difference from the plan is printed below.
            if was.source is not ClearanceSource.DRAWING:
                continue
            # A row may name the pair the other way round; its direction is seen from its own
            # array.
            turned = near
            if was.array != near.array:
                turned = replace(near, array=near.other, near=near.far, far=near.near)
            direction = was.direction
            if len(near.given) == 1:  # the directions of several rows of a pair differ
                direction = direction_of(turned, downslope_deg[turned.array])
            if abs(was.provided_m - drawn_m) > NOISE_M or direction is not was.direction:
                cells = _from_drawing(change, direction, drawn_m)
                change.put(_KEY, rows[entered.cell], cells)
                before, after = (
                    _size(value_m, data.us_first) for value_m in (was.provided_m, drawn_m)
                )
                lines.append(f"{entered.cell}: {near.names}: {was.direction}, {before}; now"
                             f" {direction}, {after}")  # fmt: skip
    return lines


def _drawn_m(near: PlanNeighbor, data: ProjectInput) -> float:
    step_m = US_STEP_M if data.us_first else SI_STEP_M
    # Shapes that overlap have a negative gap, and no distance.
    return round_down(max(near.gap_m, 0.0) / step_m, 0) * step_m


def _from_drawing(change: WorkbookChange, direction: Direction, drawn_m: float) -> dict[str, Value]:
    si = change.table(_KEY).columns["provided_m"].si
    return {
        "direction": direction.value,
        # Down once more: 0.1 in is no round number of feet.
        "provided_m": round_down(drawn_m / si, DIGITS),
        "source": ClearanceSource.DRAWING.value,
    }


def _differing(pairs: Sequence[PlanNeighbor], us_first: bool) -> Iterator[str]:
    """Yield the rows as entered or measured whose distance is not that of the plan."""
    for near in pairs:
        for row in near.given:
            if row.clearance.source is ClearanceSource.DRAWING:
                continue
            if abs(row.clearance.provided_m - near.gap_m) > US_STEP_M + NOISE_M:
                values = (row.clearance.provided_m, near.gap_m)
                entered, drawn = (_size(value, us_first) for value in values)
                yield f"{row.cell}: {near.names}: {entered} entered, {drawn} in plan"
