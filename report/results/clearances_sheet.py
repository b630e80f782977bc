"""The Clearances worksheet of results.xlsx: required and provided separations, live formulas.

Computes nothing: each formula is written with the value from `report.assessment.assessment`. Read
`GAPS`.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

from report.assessment.assessment import Assessment
from report.assessment.design.clearances import ClearanceCheck, beside
from report.assessment.design.rule_set import MEANING
from report.assessment.design.verdict import Verdict
from report.results.design_sheet import DESIGN, InputCells
from report.results.sheet_columns import SheetColumn, SheetLayout, SheetRow, up_column, write_live
from report.results.sheet_pages import TOP, Pages
from report.text.units import round_up
from solver.rules.provisions import SEPARATION_KEYS

# A missing value is the text "none", and every formula asks for it first: in Excel text times a
# number is an error, and MAX passes over text.
_REQUIRED = '=IF(ISTEXT({design_m}),"none",MAX({design_m}*{factor},{minimum_m}))'
# Rounded up as `ratio` does, so that 1.00 never hides a failure.
_UP = "MAX(0,ROUNDUP({required_m}/{provided_m}-0.000000001,2))"
_RATIO = f'=IF(ISTEXT({{required_m}}),"none",IF({{provided_m}}>0,{_UP},"none"))'
_OK = '=IF(ISTEXT({required_m}),"{unknown}",IF({required_m}<={provided_m},"OK","NG"))'
_DIFFERENCE = '=IF(ISTEXT({required_m}),"none",{required_m}-{by_roofslip_m})'


@dataclass(frozen=True, slots=True, kw_only=True)
class GapRow:
    """A clearance with its number, and the factor of the rule set."""

    count: int
    gap: ClearanceCheck
    rule_factor: float


# The value beside the formula is rounded as the formula is, and as the page.
def _ratio(row: GapRow) -> float:
    value = row.gap.demand_capacity
    return round_up(value, 2) if math.isfinite(value) else math.nan


GAPS = SheetLayout(
    "Clearances",
    (
        SheetColumn("count", "No.", lambda row: row.count),
        SheetColumn("array", "Array", lambda row: row.gap.clearance.array),
        SheetColumn("object", "Object", lambda row: row.gap.clearance.object),
        SheetColumn("direction", "Direction", lambda row: row.gap.clearance.direction),
        SheetColumn("neighbor", "Type", lambda row: row.gap.neighbor),
        SheetColumn("governing", "Governing array", lambda row: row.gap.governing_array),
        up_column("design_m", "Design [in]", lambda row: row.gap.design_m, 1, "={largest}",
            is_always=True),
        SheetColumn("factor", "Factor", lambda row: row.gap.factor, 2,
            "={rule_factor}*{importance}"),
        SheetColumn("minimum_m", "Minimum [in]", lambda row: row.gap.minimum_m, is_input=True),
        up_column("required_m", "Required [in]", lambda row: row.gap.required_m, 1, _REQUIRED,
            is_always=True),
        up_column("required_m", "Required [mm]", lambda row: row.gap.required_m, 0, is_always=True),
        SheetColumn("provided_m", "Provided [in]", lambda row: row.gap.provided_m, is_input=True),
        SheetColumn("basis", "Clearance source", lambda row: row.gap.basis),
        SheetColumn("demand_capacity", "D/C", _ratio, 2, _RATIO, is_always=True),
        SheetColumn("verdict", "Verdict", lambda row: row.gap.verdict, formula=_OK, is_always=True),
        up_column("by_roofslip_m", "Required, as reported [in]", lambda row: row.gap.required_m, 1),
        SheetColumn("difference", "Difference [in]", lambda _: 0.0, 4, _DIFFERENCE),
        SheetColumn("rule_factor", "Separation / displacement", lambda row: row.rule_factor, 2,
            is_input=True),
        SheetColumn("importance", "Importance factor", lambda row: row.gap.importance, 2,
            "={inputs[i_e]}", is_input=True),
    ),
    key_columns=3,
    last_printed="importance",
)  # fmt: skip


def result_cells(assessment: Assessment, array_id: str) -> Sequence[str]:
    """Return the cells of the results of the clearances of an array, from either side."""
    return [
        GAPS.fixed("verdict", row)
        for row, gap in enumerate(assessment.clearances, start=TOP)
        if gap.involves(array_id)
    ]


def write_clearances(pages: Pages, assessment: Assessment, inputs: InputCells) -> Sequence[GapRow]:
    """Write each clearance as formulas; return what its rows hold."""
    gaps = enumerate(assessment.clearances, start=1)
    rows = [_row(assessment, gap, inputs, count) for count, gap in gaps]
    write_live(
        pages,
        GAPS,
        rows,
        "Clearances",
        f"{assessment.rules.name}. Calculated from the Design worksheet; between two arrays the "
        "larger displacement governs. The factor includes I_e or I_p if the rule set applies it "
        "here." + (f" {MEANING}." if assessment.is_overridden else ""),
    )
    return [row.item for row in rows]


def _row(assessment: Assessment, gap: ClearanceCheck, inputs: InputCells, count: int) -> SheetRow:
    rules = assessment.rules
    largest, governing = _sides(assessment, gap)
    # Which route is permitted is no formula.
    formulas = {"governing": f"={governing}" if gap.is_permitted else ""}
    # I_e is an input of the project, I_p is one of an array: only the former has a cell to follow.
    if not (rules.importance_in_separation and gap.neighbor.is_edge):
        formulas["importance"] = ""
    factor = rules.values[SEPARATION_KEYS[gap.neighbor]]
    has_value = not math.isnan(gap.required_m)
    return SheetRow(
        item=GapRow(count=count, gap=gap, rule_factor=factor.value),
        refs={
            "inputs": inputs,
            "largest": largest if gap.is_permitted else '"none"',
            "unknown": Verdict.NG if gap.is_permitted else Verdict.NONE,
        },
        formulas=formulas,
        blanks=() if has_value else {"by_roofslip_m", "difference"},
        marks={
            "design_m": gap.design_mark,
            "rule_factor": factor.reason,
            **dict.fromkeys(("required_m", "demand_capacity", "by_roofslip_m"), gap.mark),
        },
    )


def _sides(assessment: Assessment, gap: ClearanceCheck) -> tuple[str, str]:
    """Return the formulas of the larger displacement on either side, and of whose it is."""
    rows = {array.id: row for row, array in enumerate(assessment.arrays, start=TOP)}
    sides = [rows[array.id] for array in beside(assessment.arrays, gap.clearance)]
    cells = [DESIGN.fixed("design_m", row) for row in sides]
    names = [DESIGN.fixed("id", row) for row in sides]
    if len(cells) == 1:
        return cells[0], names[0]
    # Text, "none", is larger than any number: an array without a value governs.
    near, far = cells
    return (
        f'IF(OR(ISTEXT({near}),ISTEXT({far})),"none",MAX({near},{far}))',
        f"IF({far}>{near},{names[1]},{names[0]})",
    )
