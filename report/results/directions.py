"""The sheets Peaks and Directions of results.xlsx: from runs to displacements in each direction.

Live formulas, each written with the value computed by `report.assessment.project`. Read
`report.results.xlsx`.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping

import pandas as pd
from xlsxwriter.utility import xl_rowcol_to_cell
from xlsxwriter.worksheet import Worksheet

from report.assessment.arrays import ArrayAssessment, Route
from report.assessment.project import Assessment
from report.results.sheets import (
    DIRECTION_HEADINGS,
    STATISTIC_COLUMN,
    Pages,
    write_headings,
)
from report.sheet.schema import Direction
from solver.model import INCH_M
from solver.rules.provisions import AnalysisValue, Basis

PeakRanges = Mapping[tuple[str, Direction], str]
"""Cells of the peaks of an array in a direction, one for each motion."""

DirectionCells = Mapping[tuple[str, Direction], str]
"""Cell of the design displacement of an array (case-folded id) in a direction."""

_RUNS_COLUMNS = DIRECTION_HEADINGS | {Direction.ANY: "PRD [in]"}
_DIRECTIONS_HEADINGS = (
    "Array", "Direction", "Mean of peaks [in]", "Largest peak [in]", "Analysis factor",
    "Computed [in]", "Floor [in]", "In this direction [in]", "By Roofslip [in]", "Difference [in]",
)  # fmt: skip


def write_peaks(pages: Pages, assessment: Assessment, runs: pd.DataFrame) -> PeakRanges:
    """Write the largest excursion of all runs of each motion, by direction; return its cells."""
    sheet = pages.sheet(
        "Peaks", "Peaks", "Largest of all runs of each motion, by direction, from the sheet Runs."
    )
    write_headings(
        pages, sheet, 3, ("Array", "Motion", *(DIRECTION_HEADINGS[d] for d in Direction))
    )
    columns = {d: list(runs.columns).index(name) for d, name in _RUNS_COLUMNS.items()}
    row, first, ranges = 4, 1, {}
    for item in assessment.arrays:
        top = row
        for motion in item.motions:
            last = first + len(motion.runs) - 1
            sheet.write_string(row, 0, item.id)
            sheet.write_string(row, 1, motion.motion.id)
            for column, direction in enumerate(Direction, start=2):
                cells = _range("Runs", columns[direction], first, last)
                value = motion.peak_m(direction) / INCH_M
                if math.isnan(value):
                    sheet.write_string(row, column, "none")
                else:
                    sheet.write_formula(row, column, f"=MAX({cells})", pages.numbers[2], value)
            row, first = row + 1, last + 1
        for column, direction in enumerate(Direction, start=2):
            ranges[item.id, direction] = _range("Peaks", column, top, row - 1)
    return ranges


def _range(sheet: str, column: int, first: int, last: int) -> str:
    return f"{sheet}!{xl_rowcol_to_cell(first, column)}:{xl_rowcol_to_cell(last, column)}"


def write_directions(pages: Pages, assessment: Assessment, peaks: PeakRanges) -> DirectionCells:
    """Write the displacement of each array in each direction; return those of clearances."""
    by_direction = assessment.project.options.directional
    use = (
        "Each clearance uses the displacement in its own direction, a departure from the rule set."
        if by_direction
        else "For information: each clearance uses the full design displacement."
    )
    sheet = pages.sheet(
        "Directions",
        "Design displacement by direction",
        f"{use} From the sheets Peaks and Design.",
    )
    write_headings(pages, sheet, 3, _DIRECTIONS_HEADINGS)
    row, cells = 4, {}
    for design_row, item in enumerate(assessment.arrays, start=5):
        for direction in Direction:
            peak_range = peaks[item.id, direction]
            _write_row(pages, sheet, row, item, direction, peak_range, design_row)
            cells[item.id, direction] = (
                f"Directions!$H${row + 1}" if by_direction else f"Design!$N${design_row}"
            )
            row += 1
    return cells


def _write_row(
    pages: Pages,
    sheet: Worksheet,
    row: int,
    item: ArrayAssessment,
    direction: Direction,
    peaks: str,
    design_row: int,
) -> None:
    analysis, design = item.directions[direction], item.directional_m(direction)
    mark = item.toward_mark(direction)
    sheet.write_string(row, 0, item.id)
    sheet.write_string(row, 1, direction.value)
    formulas: list[_Formula] = []
    if math.isnan(analysis.value_m):
        for column in (2, 3, 5):
            sheet.write_string(row, column, "none")
    else:
        formulas += _of_analysis(analysis, item.floor_m, peaks, row + 1, design_row)
    if math.isnan(design):
        sheet.write_string(row, 7, "none")
    else:
        formulas += _of_design(item.route, design, row + 1, design_row)
        sheet.write_number(row, 8, design / INCH_M, pages.marked(pages.numbers[2], mark))
    for column, formula, value in formulas:
        plain = pages.numbers[4 if column == 9 else 2]
        shown = pages.marked(plain, mark if column == 7 else "")
        sheet.write_formula(row, column, formula, shown, value)


_Formula = tuple[int, str, float]
"""Column, formula and the value that it gives."""


def _of_analysis(
    analysis: AnalysisValue, floor_m: float, peaks: str, row: int, design_row: int
) -> Iterator[_Formula]:
    largest = f'Design!{STATISTIC_COLUMN}{design_row}="{Basis.LARGEST_FACTORED.value}"'
    yield 2, f"=AVERAGE({peaks})", analysis.mean_m / INCH_M
    yield 3, f"=MAX({peaks})", analysis.largest_m / INCH_M
    yield 4, f"=Design!J{design_row}", analysis.factor
    yield 5, f"=E{row}*IF({largest},D{row},C{row})", analysis.value_m / INCH_M
    yield 6, f"=Design!M{design_row}", floor_m / INCH_M


def _of_design(route: Route, design_m: float, row: int, design_row: int) -> Iterator[_Formula]:
    is_prescriptive = route is Route.PRESCRIPTIVE
    design = f"=Design!N{design_row}" if is_prescriptive else f"=MAX(F{row},G{row})"
    yield 7, design, design_m / INCH_M
    yield 9, f"=H{row}-I{row}", 0.0
