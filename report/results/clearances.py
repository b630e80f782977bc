"""The sheet Clearances of results.xlsx: required and provided separations, as live formulas.

Computes nothing: each formula is written with the value from `report.assessment.project`. Read
`GapRow`.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Annotated, ClassVar

from report.assessment.clearances import ClearanceCheck, beside
from report.assessment.project import Assessment
from report.assessment.verdict import MEANING, Verdict
from report.entities.clearance import ClearanceResult
from report.entities.shown import Column, Number, up_column
from report.results.design import DesignRow, InputCells
from report.results.sheets import TOP, Pages, SheetRow, fixed, write_live
from solver.rules.provisions import SEPARATION_KEYS

_DIFFERENCE = '=IF(ISTEXT({required_m}),"none",{required_m}-{by_roofslip_m})'


class GapRow(SheetRow, ClearanceResult):
    """A clearance: required and provided separation."""

    sheet: ClassVar[str] = "Clearances"
    across: ClassVar[str] = (
        "count array object direction neighbor governing design_m factor minimum_m required_m"
        " provided_m basis demand_capacity verdict by_roofslip_m difference rule_factor importance"
    )
    last_printed: ClassVar[str] = "importance"
    key_columns: ClassVar[int] = 3

    count: Annotated[int, Column("No.")]
    governing: Annotated[str, Column("Governing array")]
    minimum_m: Annotated[float, Column("Minimum [in]", is_input=True)]
    by_roofslip_m: Annotated[Number, up_column("Required by Roofslip [in]", 1)]
    difference: Annotated[float, Column("Difference [in]", 4, _DIFFERENCE)] = 0.0
    rule_factor: Annotated[float, Column("Separation / displacement", 2, is_input=True)]


def result_cells(assessment: Assessment, array_id: str) -> Sequence[str]:
    """Return the cells of the results of the clearances of an array, from either side."""
    return [
        fixed(GapRow, "verdict", row)
        for row, gap in enumerate(assessment.clearances, start=TOP)
        if gap.involves(array_id)
    ]


def write_clearances(pages: Pages, assessment: Assessment, inputs: InputCells) -> Sequence[GapRow]:
    """Write each clearance as formulas; return the rows."""
    gaps = enumerate(assessment.clearances, start=1)
    rows = [_row(assessment, gap, inputs, count) for count, gap in gaps]
    write_live(
        pages,
        GapRow,
        rows,
        "Clearances",
        f"{assessment.rules.name}. From the sheet Design; between two arrays the larger "
        "displacement governs. The factor includes I_e or I_p if the rule set applies it here."
        + (f" {MEANING}." if assessment.is_overridden else ""),
    )
    return rows


def _row(assessment: Assessment, gap: ClearanceCheck, inputs: InputCells, count: int) -> GapRow:
    rules = assessment.rules
    largest, governing = _sides(assessment, gap)
    # Which route is permitted is no formula.
    formulas = {"governing": f"={governing}" if gap.is_permitted else ""}
    if not (rules.importance_in_separation and gap.neighbor.is_edge):
        formulas["importance"] = ""
    factor = rules.values[SEPARATION_KEYS[gap.neighbor]]
    has_value = not math.isnan(gap.required_m)
    return GapRow.beside(
        ClearanceResult.of(gap),
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
        count=count,
        governing=gap.governing_array,
        minimum_m=gap.minimum_m,
        by_roofslip_m=gap.required_m,
        rule_factor=factor.value,
    )


def _sides(assessment: Assessment, gap: ClearanceCheck) -> tuple[str, str]:
    """Return the formulas of the larger displacement on either side, and of whose it is."""
    rows = {array.id: row for row, array in enumerate(assessment.arrays, start=TOP)}
    sides = [rows[array.id] for array in beside(assessment.arrays, gap.clearance)]
    cells = [fixed(DesignRow, "design_m", row) for row in sides]
    names = [fixed(DesignRow, "id", row) for row in sides]
    if len(cells) == 1:
        return cells[0], names[0]
    # Text, "none", is larger than any number: an array without a value governs.
    near, far = cells
    return (
        f'IF(OR(ISTEXT({near}),ISTEXT({far})),"none",MAX({near},{far}))',
        f"IF({far}>{near},{names[1]},{names[0]})",
    )
