"""The sheet Clearances of results.xlsx: required and provided separations.

Live formulas, each written with the value from `report.assessment.project`. Read
`report.results.xlsx`.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence

from xlsxwriter.worksheet import Worksheet

from report.assessment.clearances import ClearanceCheck, facing
from report.assessment.overrides import MEANING
from report.assessment.project import Assessment
from report.assessment.verdict import Verdict
from report.results.directions import DirectionCells
from report.results.inputs import InputCells
from report.results.sheets import Pages, typed, write_headings
from report.words.units import ratio
from solver.model import INCH_M
from solver.rules.provisions import SEPARATION_KEYS

_HEADINGS = (
    "Array", "Object", "Direction", "Condition", "Governing array, direction", "Design [in]",
    "Factor", "Minimum [in]", "Required [in]", "Required [mm]", "Provided [in]", "D/C", "Result",
    "Required by Roofslip [in]", "Difference [in]", "Separation / displacement",
    "Importance factor",
)  # fmt: skip


def result_cells(assessment: Assessment) -> Mapping[str, Sequence[str]]:
    """Return for each array the cells of the results of its clearances, from either side."""
    return {
        item.id: [
            f"Clearances!$M${5 + count}"
            for count, gap in enumerate(assessment.clearances)
            if item.id in (gap.clearance.array, gap.clearance.object)
        ]
        for item in assessment.arrays
    }


def write_clearances(
    pages: Pages, assessment: Assessment, design_cells: DirectionCells, inputs: InputCells
) -> None:
    """Write each clearance as formulas."""
    sheet = pages.sheet(
        "Clearances",
        "Clearances",
        f"{assessment.rules.name}. From the sheet Design; between two arrays the larger "
        "displacement governs. The factor includes I_e or I_p if the rule set applies it here."
        + (f" {MEANING}." if assessment.is_overridden else ""),
    )
    write_headings(pages, sheet, 3, _HEADINGS)
    for row, item in enumerate(assessment.clearances, start=4):
        _write_row(pages, sheet, row, assessment, item, design_cells)
        _write_factor(pages, sheet, row, assessment, item, inputs)


def _write_row(
    pages: Pages,
    sheet: Worksheet,
    row: int,
    assessment: Assessment,
    item: ClearanceCheck,
    design_cells: DirectionCells,
) -> None:
    clearance, r, has_value = item.clearance, row + 1, not math.isnan(item.required_m)
    texts = (clearance.array, clearance.object, clearance.direction, item.neighbor)
    for column, text in enumerate(texts):
        sheet.write_string(row, column, text)
    sides = facing(assessment.project, assessment.arrays, clearance)
    cells = [design_cells[array.id, direction] for array, direction in sides]
    rows = {array.id: 5 + count for count, array in enumerate(assessment.arrays)}
    names = [f'Design!$A${rows[array.id]}&", {toward.value}"' for array, toward in sides]
    governing = f"{item.governing_array}, {item.governing_direction.value}"
    largest, name = cells[0], names[0]
    if len(cells) > 1:
        # Text, "none", is larger than any number: an array without a value governs.
        largest = f'IF(OR(ISTEXT({cells[0]}),ISTEXT({cells[1]})),"none",MAX({",".join(cells)}))'
        name = f"IF({cells[1]}>{cells[0]},{names[1]},{names[0]})"
    if item.is_permitted:
        sheet.write_formula(row, 4, f"={name}", pages.plain, governing)
    else:  # which route is permitted is no formula
        largest = '"none"'
        sheet.write_string(row, 4, governing)
    sheet.write_number(row, 7, typed(item.minimum_m / INCH_M), pages.typed[1])
    sheet.write_number(row, 10, typed(clearance.provided_m / INCH_M), pages.typed[1])
    inch = INCH_M
    required = f'=IF(ISTEXT(F{r}),"none",MAX(F{r}*G{r},H{r}))'
    for column, formula, value, decimals, mark in (
        (5, f"={largest}", item.design_m / inch, 2, item.design_mark),
        (8, required, item.required_m / inch, 2, item.mark),
        (9, f'=IF(ISTEXT(I{r}),"none",I{r}*25.4)', item.required_m * 1e3, 1, item.mark),
    ):
        shown = pages.marked(pages.numbers[decimals], mark)
        sheet.write_formula(row, column, formula, shown, value if has_value else "none")
    found = float(ratio(item.demand_capacity)) if math.isfinite(item.demand_capacity) else "none"
    up = f"MAX(0,ROUNDUP(I{r}/K{r}-0.000000001,2))"  # as `report.words.units.ratio`
    dc = f'=IF(ISTEXT(I{r}),"none",IF(K{r}>0,{up},"none"))'
    sheet.write_formula(row, 11, dc, pages.marked(pages.numbers[2], item.mark), found)
    unknown = Verdict.NG if item.is_permitted else Verdict.NONE
    result = f'=IF(ISTEXT(I{r}),"{unknown}",IF(I{r}<=K{r},"OK","NG"))'
    sheet.write_formula(row, 12, result, pages.plain, item.verdict.value)
    if has_value:
        shown = pages.marked(pages.numbers[2], item.mark)
        sheet.write_number(row, 13, item.required_m / inch, shown)
        difference = f'=IF(ISTEXT(I{r}),"none",I{r}-N{r})'
        sheet.write_formula(row, 14, difference, pages.numbers[4], 0.0)


def _write_factor(
    pages: Pages,
    sheet: Worksheet,
    row: int,
    assessment: Assessment,
    item: ClearanceCheck,
    inputs: InputCells,
) -> None:
    """Write the factor: that of the rule set times I_e at edges, the larger I_p elsewhere."""
    rules, r = assessment.rules, row + 1
    sheet.write_formula(row, 6, f"=P{r}*Q{r}", pages.numbers[2], item.factor)
    given = rules.values[SEPARATION_KEYS[item.neighbor]]
    shown = pages.marked(pages.typed[2], given.reason)
    sheet.write_number(row, 15, typed(given.value), shown)
    if rules.importance_in_separation and item.neighbor.is_edge:
        sheet.write_formula(row, 16, f"={inputs['i_e']}", pages.numbers[2], item.importance)
    else:
        sheet.write_number(row, 16, typed(item.importance), pages.typed[2])
