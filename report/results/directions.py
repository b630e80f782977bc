"""The sheets Peaks and Directions of results.xlsx: from runs to displacements in each direction.

Live formulas, each written with the value computed by `report.assessment.project`. Read `PeakRow`,
then `DirectionRow`.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Annotated, ClassVar

from report.assessment.arrays import ArrayAssessment, Route
from report.assessment.project import Assessment
from report.entities.array import DirectionResult, direction_result
from report.entities.cells import Column
from report.entities.run import PeakResult, peak_result
from report.entities.shown import Number
from report.results.lists import RunRow
from report.results.sheets import TOP, Cells, Pages, SheetRow, write_live
from report.sheet.schema.choices import Direction

PeakRanges = Mapping[tuple[str, Direction], str]
"""Cells of the peaks of an array in a direction, one for each motion."""


class PeakRow(SheetRow, PeakResult):
    """The peaks of an array under a motion."""

    sheet: ClassVar[str] = "Peaks"
    across: ClassVar[str] = "array"

    array: Annotated[str, Column("Array")]


class DirectionRow(SheetRow, DirectionResult):
    """The displacement of an array in a direction."""

    sheet: ClassVar[str] = "Directions"
    across: ClassVar[str] = (
        "array direction mean_m largest_m factor computed_m floor_m design_m by_roofslip_m"
    )

    array: Annotated[str, Column("Array")]
    direction: Annotated[Direction, Column("Direction")]
    factor: Annotated[float, Column("Analysis factor", 2, "={design.analysis_factor}")]
    floor_m: Annotated[float, Column("Floor [in]", 2, "={design.floor_m}")]
    by_roofslip_m: Annotated[Number, Column("By Roofslip [in]", 2)]
    difference: Annotated[float, Column("Difference [in]", 4, "={design_m}-{by_roofslip_m}")] = 0.0


def write_peaks(pages: Pages, assessment: Assessment) -> PeakRanges:
    """Write the largest excursion of all runs of each motion, by direction; return its cells."""
    rows: list[PeakRow] = []
    ranges: dict[tuple[str, Direction], str] = {}
    first_run = 2
    for item in assessment.arrays:
        first = TOP + len(rows)
        for motion in item.motions:
            runs = Cells(RunRow, first_run, first_run + len(motion.runs) - 1)
            first_run += len(motion.runs)
            rows.append(PeakRow.beside(peak_result(motion), array=item.id, refs={"runs": runs}))
        peaks = Cells(PeakRow, first, TOP + len(rows) - 1)
        ranges |= {(item.id, way): getattr(peaks, f"{way.value}_m") for way in Direction}
    note = "Largest of all runs of each motion, by direction, from the sheet Runs."
    write_live(pages, PeakRow, rows, "Peaks", note)
    return ranges


def write_directions(
    pages: Pages, assessment: Assessment, peaks: PeakRanges, designs: Mapping[str, Cells]
) -> None:
    """Write the displacement of each array in each direction."""
    use = (
        "Each clearance uses the displacement in its own direction, a departure from the rule set."
        if assessment.project.options.directional
        else "For information: each clearance uses the full design displacement."
    )
    rows = [
        _row(item, way, {"peaks": peaks[item.id, way], "design": designs[item.id]})
        for item in assessment.arrays
        for way in Direction
    ]
    note = f"{use} From the sheets Peaks and Design."
    write_live(pages, DirectionRow, rows, "Design displacement by direction", note)


def _row(item: ArrayAssessment, way: Direction, refs: Mapping[str, object]) -> DirectionRow:
    analysis, design_m = item.directions[way], item.directional_m(way)
    values: dict[str, float] = {"floor_m": item.floor_m, "by_roofslip_m": design_m}
    blanks = set()
    if math.isnan(analysis.value_m):
        values |= {"mean_m": math.nan, "largest_m": math.nan}
        blanks |= {"factor", "floor_m"}
    if math.isnan(design_m):
        blanks |= {"by_roofslip_m", "difference"}
    is_prescriptive = item.route is Route.PRESCRIPTIVE
    return DirectionRow.beside(
        direction_result(item, way),
        refs=refs,
        formulas={"design_m": "={design.design_m}"} if is_prescriptive else {},
        blanks=blanks,
        marks=dict.fromkeys(("design_m", "by_roofslip_m"), item.toward_mark(way)),
        array=item.id,
        direction=way,
        factor=analysis.factor,
        **values,
    )
