"""The clearances that a plan calls for before any run, and the rows that a workbook lacks.

Writes nothing (`report.sheet.writing.filled`). Read `pairs_before_runs`, then `missing_rows`.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from typing import Any

from report.assessment.clearances import separation_m
from report.assessment.neighbors import (
    REACH_FACTOR,
    GivenGap,
    NearbyKind,
    PlanNeighbor,
    pairs_within,
)
from report.assessment.overrides import rule_set_of
from report.sheet.reading.growing import DIGITS, GrowingTable
from report.sheet.reading.locate_tables import FieldColumn
from report.sheet.reading.parts import Value
from report.sheet.reading.positions import CellPosition, found_at
from report.sheet.reading.read import Sheet
from report.sheet.schema import (
    SECTION,
    SIDES,
    Array,
    ClearanceSource,
    Direction,
    ProjectInput,
    RoofObject,
)
from report.sheet.schema.fields import Place, entries
from solver.model import INCH_M, InputError
from solver.rules import provisions
from solver.rules.provisions import RuleSet

US_STEP_M, SI_STEP_M = 0.1 * INCH_M, 0.001
"""Distances are rounded down to a multiple of this [m]."""

_PER_UNIT = 10.0**DIGITS  # smallest parts of a cell
_NOISE_M = 1e-9  # coordinates in feet are no round numbers of meters
_TURNS = (
    (Direction.DOWN, 0.0),
    (Direction.UP, 180.0),
    (Direction.ACROSS, 90.0),
    (Direction.ACROSS, 270.0),
)

_NEEDED: Mapping[str, tuple[str, ...]] = {
    "project": ("units_first",),
    "arrays": ("id", *SIDES, "i_p"),
    "objects": ("id", "kind", *SIDES, "i_p"),
    "clearances": (),
    **{key: tuple(e.name for e in entries(SECTION[key].model))
       for key in ("site", "roof", "outlines", "overrides")},
}  # fmt: skip
"""Fields without which it is not known which clearances a plan calls for."""


def pairs_before_runs(
    data: ProjectInput,
    rules: RuleSet,
    addresses: Mapping[Place, str],
    designs_m: Mapping[str, float] | None = None,
) -> tuple[PlanNeighbor, ...]:
    """Return the pairs of the plan as a package has them at the prescriptive displacement.

    Parameters
    ----------
    designs_m : mapping of str to float, optional
        Design displacements [m] by array, where runs have given larger ones.
    """
    least_m, known = design_before_runs_m(data, rules), designs_m or {}
    # NaN is no larger one.
    slides = {array.id: max(least_m, known.get(array.id, 0.0)) for array in data.arrays}
    arrays = {array.id: array for array in data.arrays}
    others: dict[str, Array | RoofObject] = {item.id: item for item in data.objects}
    others |= arrays

    def required(near: PlanNeighbor) -> tuple[float, str]:
        design_m = max(slides[near.array], slides.get(near.other, 0.0))
        other = None if near.kind is NearbyKind.BARE_EDGE else others[near.other]
        return separation_m(data, rules, design_m, arrays[near.array], other), ""

    reaches = [(array, REACH_FACTOR * slides[array.id]) for array in data.arrays]
    return pairs_within(data, reaches, addresses, required)


def design_before_runs_m(data: ProjectInput, rules: RuleSet) -> float:
    """Return the design displacement that is taken before any run [m]: the prescriptive one."""
    site = data.site
    prescriptive = provisions.prescriptive_displacement(
        rules, s_ds_g=site.s_ds, sdc=site.sdc, importance=site.i_e
    )
    return max(prescriptive.value_m, provisions.analysis_floor_m(rules, prescriptive))


@dataclass(frozen=True, slots=True, kw_only=True)
class NewRow:
    """A row that the sheet Clearances lacks."""

    cell: str  # of its array
    pair: PlanNeighbor
    direction: Direction
    provided_m: float  # rounded down


@dataclass(frozen=True, slots=True, kw_only=True)
class MissingRows:
    """The rows that a workbook lacks, and what is to be said of those that it has."""

    rows: tuple[NewRow, ...]
    cells: Mapping[CellPosition, Value]  # to be written
    us_first: bool
    design_m: float  # displacement whose double is the reach
    n_kept: int  # rows that stand
    differing: tuple[tuple[PlanNeighbor, GivenGap], ...]  # by more than the rounding
    stale: tuple[tuple[str, str], ...]  # cells that name what is gone, with the name
    bare_edges: tuple[PlanNeighbor, ...]  # roof edges that are no object yet
    overlapping: tuple[PlanNeighbor, ...]  # in plan, so that they have no distance
    unplaced: tuple[str, ...]  # objects without a place in plan and without a row


def missing_rows(sheet: Sheet, designs_m: Mapping[str, float] | None = None) -> MissingRows:
    """Return a row for each pair that a package would name as missing.

    Raises
    ------
    InputError
        For every cell that is wrong and needed for it, or if the rows have no place.
    """
    data = _as_far_as_known(sheet)
    rules = rule_set_of(data)
    pairs = pairs_before_runs(data, rules, sheet.addresses, designs_m)
    missing = [pair for pair in pairs if pair.is_missing]
    new = [pair for pair in missing if pair.kind is not NearbyKind.BARE_EDGE]
    apart = [pair for pair in new if pair.gap_m >= -_NOISE_M]
    step_m = US_STEP_M if data.project.units_first.is_us else SI_STEP_M
    cells, rows = _written(sheet, data, apart, step_m)
    return MissingRows(
        rows=rows,
        cells=cells,
        us_first=data.project.units_first.is_us,
        design_m=design_before_runs_m(data, rules),
        n_kept=len(data.clearances),
        differing=tuple(
            (pair, row)
            for pair in pairs
            for row in pair.given
            if abs(row.clearance.provided_m - pair.gap_m) > step_m + _NOISE_M
        ),
        stale=tuple(_stale(sheet, data)),
        bare_edges=tuple(pair for pair in missing if pair.kind is NearbyKind.BARE_EDGE),
        overlapping=tuple(pair for pair in new if pair.gap_m < -_NOISE_M),
        unplaced=tuple(_unplaced(data)),
    )


def direction_of(pair: PlanNeighbor, downslope_deg: float) -> Direction:
    """Return the direction in which the whole distance of a pair lies, from its array; else any.

    No displacement whose component in that direction is less than the distance closes the gap.
    """
    for direction, turn_deg in _TURNS:
        angle = math.radians(downslope_deg + turn_deg)
        ahead = [
            [x * math.cos(angle) + y * math.sin(angle) for x, y in shape.points]
            for shape in (pair.far, pair.near)
        ]
        if min(ahead[0]) - max(ahead[1]) >= pair.gap_m - _NOISE_M > 0.0:
            return direction
    return Direction.ANY


def _as_far_as_known(sheet: Sheet) -> ProjectInput:
    """Return the plan and the site of a workbook, whatever else is missing or wrong in it."""
    wrong = [
        problem
        for (section, _, field), problem in sheet.problems
        if section in _NEEDED and field in ("", *_NEEDED[section])
    ]
    if wrong:
        raise InputError(wrong)
    draft = sheet.draft

    def rows(key: str, **unknown: Any) -> tuple[Any, ...]:
        return tuple(SECTION[key].model.model_construct(**{**unknown, **row}) for row in draft[key])

    arrays = rows("arrays")
    whole = len(entries(SECTION["arrays"].model))
    for index, row in enumerate(draft["arrays"]):
        if len(row) < whole:
            # On the safe side: an array unlike every other, beside parapets that do not qualify.
            object.__setattr__(arrays[index], "construction", f"\0{index}")
            object.__setattr__(arrays[index], "cg_height_m", math.inf)
    return ProjectInput(
        project=rows("project")[0],
        site=rows("site")[0],
        roof=rows("roof")[0],
        arrays=arrays,
        objects=rows("objects", height_m=None),
        clearances=rows(
            "clearances", array="", object="", direction=Direction.ANY, provided_m=math.nan
        ),
        motions=(),
        overrides=rows("overrides"),
        outlines=rows("outlines"),
    )


def _written(
    sheet: Sheet, data: ProjectInput, pairs: list[PlanNeighbor], step_m: float
) -> tuple[dict[CellPosition, Value], tuple[NewRow, ...]]:
    """Return the cells of new rows, and the rows."""
    cells: dict[CellPosition, Value] = {}
    new = []
    downslope = {array.id: getattr(array, "downslope_deg", math.nan) for array in data.arrays}
    table = GrowingTable.of(sheet.book, "clearances")
    for pair in pairs:
        if "source" not in table.found.columns:
            raise InputError(_no_column(sheet, table))
        row, direction = table.added(), direction_of(pair, downslope[pair.array])
        column = table.found.columns["provided_m"]
        value = _rounded_down(pair.gap_m, step_m, column)
        for name, content in (
            ("array", pair.array),
            ("object", pair.other),
            ("direction", direction.value),
            ("provided_m", value),
            ("source", ClearanceSource.DRAWING.value),
        ):
            cells[table.position(row, name)] = content
        cell = table.position(row, "array").address
        new.append(NewRow(cell=cell, pair=pair, direction=direction, provided_m=value * column.si))
    return cells, tuple(new)


def _rounded_down(gap_m: float, step_m: float, column: FieldColumn) -> float:
    """Return a distance in the unit of its column."""
    steps = math.floor((max(gap_m, 0.0) + _NOISE_M) / step_m)
    # Down once more: 0.1 in is no round number of feet.
    return math.floor(steps * step_m / column.si * _PER_UNIT + 0.001) / _PER_UNIT


def _no_column(sheet: Sheet, table: GrowingTable) -> str:
    """Return where to type the heading that a workbook of an earlier version lacks."""
    at, label = table.found.heading, table.section.entry("source").cell.label
    while not found_at(sheet.book, at).is_blank:
        at = replace(at, column=at.column + 1)
    return (
        f"{at.address}: heading '{label}' is missing, without which a distance from the drawing"
        " would pass as entered; type it there, then run this again"
    )


def _stale(sheet: Sheet, data: ProjectInput) -> Iterator[tuple[str, str]]:
    """Yield the cells of rows that name what is in no table, each with the name."""
    arrays = {array.id for array in data.arrays}
    known = {"array": arrays, "object": arrays | {item.id for item in data.objects}}
    for index, row in enumerate(data.clearances):
        for field, ids in known.items():
            name = getattr(row, field)
            if name and name not in ids:
                yield sheet.addresses[Place("clearances", index, field)], name


def _unplaced(data: ProjectInput) -> Iterator[str]:
    named = {row.object for row in data.clearances}
    yield from (row.id for row in data.objects if row.placed is None and row.id not in named)
