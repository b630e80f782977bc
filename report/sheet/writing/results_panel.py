"""The answers on the sheet Start, before any run: displacements, worst clearances, separations.

Read `write_panel`; `answers` has the formulas.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

from openpyxl.utils import get_column_letter
from openpyxl.worksheet.worksheet import Worksheet

from report.sheet.schema import answers
from report.sheet.schema.layout import Tables, name_cell
from report.sheet.writing import style
from report.words.units import Quantity
from solver.model import INCH_M
from solver.rules.provisions import SEPARATION_KEYS, Neighbor

_HINT = (
    "Computed from the other sheets. † verify against the adopted code, ‡ overridden: see the sheet"
    " Provisions."
)
_HEADS = ("", "", "Value", "", "Governs", "Clause", "Worst D/C", "From, to", "Note")
_SEPARATIONS = {
    Neighbor.LIKE: ("Separation, like arrays", "live_largest_i_p"),
    Neighbor.FIXED: ("Separation, fixed object or unlike array", "live_largest_i_p"),
    Neighbor.PARAPET: ("Separation, edge with qualifying parapet", "live_i_e"),
    Neighbor.EDGE: ("Separation, edge without qualifying parapet", "live_i_e"),
}


def write_panel(sheet: Worksheet, top: int, tables: Tables, *, is_us: bool) -> int:
    """Write the answers from a row on; return the row below them and one more."""
    style.put_heading(sheet, top, "Before any analysis", _HINT)
    style.put_values(sheet, top + 2, _HEADS, are_heads=True)
    row = top + 3
    style.put(sheet, row, 2, "Category used").border = style.LINE
    used = 'IF(TRIM(site_sdc)<>"",UPPER(TRIM(site_sdc)),live_sdc)'
    style.put_answer(sheet.cell(row, 3), used)
    name_cell("live_sdc_used", sheet, row, 3)
    _write_note(sheet, row, "", "As given; where blank, the least category by S_DS, S_D1 and S_1.")
    lines = _lines(row + 2)
    for at, line in enumerate(lines, start=row + 1):
        _write_line(sheet, at, line, tables, is_us=is_us)
    return row + len(lines) + 2


class _Line(NamedTuple):
    """A length of the panel: formulas, each without its equals sign, and words."""

    label: str
    inches: str
    clause: str
    note: str
    name: str = ""  # of the cell with inches
    governs: str = ""
    ratios: str = ""  # column of the clearances


def _lines(row: int) -> Sequence[_Line]:
    """Return the lengths of the panel; the prescriptive displacement is in a given row."""
    clause = (
        f'IF($E{row}="SDC A, B, C",rule_prescriptive_low_sdc_in_clause,IF($E{row}="minimum",'
        "rule_prescriptive_minimum_in_clause,rule_prescriptive_factor_in_clause))"
    )
    return (
        _Line(
            "Prescriptive displacement, formula",
            answers.PRESCRIPTIVE_FORMULA_IN,
            "rule_prescriptive_factor_in_clause",
            "Factor x (S_DS - 0.4)^2, before its minimum.",
            "live_prescriptive_formula_in",
        ),
        _Line(
            "Prescriptive displacement",
            answers.PRESCRIPTIVE_IN,
            clause,
            "The formula, or the minimum of the rule set.",
            "live_prescriptive_in",
            answers.PRESCRIPTIVE_BASIS,
            "demand_capacity",
        ),
        _Line(
            "Floor of the value from analysis",
            answers.FLOOR_IN,
            "rule_analysis_floor_clause",
            "Least design displacement by analysis without peer review.",
            "live_floor_in",
            ratios="floor_ratio",
        ),
        _Line(
            "Peer review of the analysis saves, at most",
            "live_floor_in",
            "rule_analysis_floor_clause",
            "With it there is no floor: the value from analysis is used.",
        ),
        *map(_separation, _SEPARATIONS),
    )


def _separation(neighbor: Neighbor) -> _Line:
    label, importance = _SEPARATIONS[neighbor]
    at = f'MATCH("{neighbor}",live_neighbors,0)'
    inside = f'IF(rule_importance="{answers.IN_SEPARATION}",{importance},1)'
    formula = (
        f"IFERROR(MAX(INDEX(live_separation_factors,{at})*{inside}*live_prescriptive_in,"
        f'INDEX(live_separation_minima_in,{at})),"")'
    )
    factor = "I_e of the building" if neighbor.is_edge else "the largest I_p of arrays and objects"
    clause = f"rule_{SEPARATION_KEYS[neighbor]}_clause"
    return _Line(label, formula, clause, f"With PV1-2012 times {factor}.")


def _write_line(sheet: Worksheet, row: int, line: _Line, tables: Tables, *, is_us: bool) -> None:
    """Write a length in both systems, the primary one first."""
    style.put(sheet, row, 2, line.label).border = style.LINE
    us, si = Quantity.DISPLACEMENT.value
    inches, other = (3, 4) if is_us else (4, 3)
    letter = get_column_letter(inches)
    in_si = f'IF(ISNUMBER({letter}{row}),{letter}{row}*{INCH_M!r}/{si.si!r},"")'
    for column, formula, unit in ((inches, line.inches, us), (other, in_si, si)):
        number_format = f'{answers.decimals_format(unit)}" {unit.symbol}"'
        style.put_answer(sheet.cell(row, column), formula, number_format)
    if line.name:
        name_cell(line.name, sheet, row, inches)
    if line.governs:
        style.put_answer(sheet.cell(row, 5), line.governs)
    for column, formula in enumerate(answers.worst(line.ratios) if line.ratios else (), start=7):
        found = answers.written(formula, tables, tables["clearances"].this)
        style.put_answer(sheet.cell(row, column), found, "0.00")
    _write_note(sheet, row, f"={line.clause}", line.note)


def _write_note(sheet: Worksheet, row: int, clause: str, note: str) -> None:
    style.put(sheet, row, 6, "", color=style.GRAY).border = style.LINE
    sheet.cell(row, 6).value = clause or None
    style.put(sheet, row, 9, note, color=style.GRAY)
    sheet.row_dimensions[row].height = 28
