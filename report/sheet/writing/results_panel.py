"""The answers on the sheet Site that belong to no input: prescriptive displacement, separations.

Read `write_panel`; `answers` has the formulas.
"""

from __future__ import annotations

from openpyxl import Workbook
from openpyxl.worksheet.pagebreak import Break
from openpyxl.worksheet.worksheet import Worksheet

from report.sheet.schema.answers import (
    IN_SEPARATION,
    prescriptive_basis,
    prescriptive_formula_in,
    prescriptive_in,
)
from report.sheet.schema.layout import name_cell, name_range
from report.sheet.writing import style
from report.words.units import Quantity, Unit
from solver.model import INCH_M
from solver.rules.provisions import SEPARATION_KEYS, Neighbor

_HINT = (
    "Computed from the cells above, before any analysis. † verify against the adopted code, ‡"
    " overridden: see the sheet Provisions."
)
_ROWS = {
    Neighbor.LIKE: ("Separation, like arrays", "live_largest_i_p"),
    Neighbor.FIXED: ("Separation, fixed object or unlike array", "live_largest_i_p"),
    Neighbor.PARAPET: ("Separation, edge with qualifying parapet", "live_i_e"),
    Neighbor.EDGE: ("Separation, edge without qualifying parapet", "live_i_e"),
}


def write_panel(book: Workbook, *, is_us: bool) -> None:
    """Write the panel below the blocks of the sheet Site."""
    sheet = book["Site"]
    top = sheet.max_row + 3
    sheet.row_breaks.append(Break(id=top - 1))
    style.put(sheet, top, 1, "Prescriptive values", bold=True, size=13, wrap=False)
    style.put(sheet, top + 1, 1, _HINT, color=style.GRAY, wrap=False)
    sheet.row_dimensions[top].height = 28
    heads = ("", "Value", "", "Governs", "Clause", "", "Note")
    for column, head in enumerate(heads, start=1):
        style.put(sheet, top + 3, column, head, bold=True).border = style.LINE
    row = top + 4
    _write_inputs(book, sheet, row, is_us=is_us)
    for at, (neighbor, (label, importance)) in enumerate(_ROWS.items(), start=row + 3):
        _write_separation(book, sheet, at, neighbor, label, importance, is_us=is_us)
    last = row + 2 + len(_ROWS)
    for at in range(row, last + 1):
        sheet.row_dimensions[at].height = 32
    name_range("live_panel", sheet, f"$B${row}:$E${last}")


def _write_inputs(book: Workbook, sheet: Worksheet, row: int, *, is_us: bool) -> None:
    style.put(sheet, row, 1, "Category used").border = style.LINE
    used = 'IF(TRIM(site_sdc)<>"",UPPER(TRIM(site_sdc)),live_sdc)'
    style.put_answer(sheet.cell(row, 2), used)
    name_cell("live_sdc_used", sheet, row, 2)
    _write_note(sheet, row, "", "As given; where blank, the least category by S_DS, S_D1 and S_1.")
    label = "Prescriptive displacement, formula"
    _write_lengths(book, sheet, row + 1, label, prescriptive_formula_in(), is_us=is_us)
    name_cell("live_prescriptive_formula_in", sheet, row + 1, _inches(is_us))
    clause = "=rule_prescriptive_factor_in_clause"
    _write_note(sheet, row + 1, clause, "Factor x (S_DS - 0.4)^2, before its minimum.")
    label = "Prescriptive displacement"
    _write_lengths(book, sheet, row + 2, label, prescriptive_in(), is_us=is_us)
    name_cell("live_prescriptive_in", sheet, row + 2, _inches(is_us))
    _write_note(sheet, row + 2, "", "")
    style.put_answer(sheet.cell(row + 2, 4), prescriptive_basis())
    sheet.cell(row + 2, 5).value = (
        '=IF($D{0}="SDC A, B, C",rule_prescriptive_low_sdc_in_clause,IF($D{0}="minimum",'
        "rule_prescriptive_minimum_in_clause,rule_prescriptive_factor_in_clause))"
    ).format(row + 2)
    sheet.cell(row + 2, 7).value = "The formula, or the minimum of the rule set."


def _inches(is_us: bool) -> int:
    """Return the column that holds inches: the first of the two for US units."""
    return 2 if is_us else 3


def _write_lengths(
    book: Workbook, sheet: Worksheet, row: int, label: str, inches: str, *, is_us: bool
) -> None:
    """Write a length in both systems, the primary one first."""
    style.put(sheet, row, 1, label).border = style.LINE
    us, si = Quantity.DISPLACEMENT.value
    letter = "BC"[_inches(is_us) - 2]
    other = f'IF(ISNUMBER({letter}{row}),{letter}{row}*{INCH_M!r}/{si.si!r},"")'
    for column in (2, 3):
        is_inches = column == _inches(is_us)
        formula, unit = (inches, us) if is_inches else (other, si)
        style.put_answer(sheet.cell(row, column), formula, _format(unit))


def _format(unit: Unit) -> str:
    digits = f"0.{'0' * unit.decimals}" if unit.decimals else "0"
    return f'{digits}" {unit.symbol}"'


def _write_separation(
    book: Workbook,
    sheet: Worksheet,
    row: int,
    neighbor: Neighbor,
    label: str,
    importance: str,
    *,
    is_us: bool,
) -> None:
    at = f'MATCH("{neighbor}",live_neighbors,0)'
    inside = f'IF(rule_importance="{IN_SEPARATION}",{importance},1)'
    formula = (
        f"IFERROR(MAX(INDEX(live_separation_factors,{at})*{inside}*live_prescriptive_in,"
        f'INDEX(live_separation_minima_in,{at})),"")'
    )
    _write_lengths(book, sheet, row, label, formula, is_us=is_us)
    clause = f"=rule_{SEPARATION_KEYS[neighbor]}_clause"
    factor = "I_e of the building" if neighbor.is_edge else "the largest I_p of arrays and objects"
    _write_note(sheet, row, clause, f"With PV1-2012 times {factor}.")


def _write_note(sheet: Worksheet, row: int, clause: str, note: str) -> None:
    style.put(sheet, row, 5, "", color=style.GRAY).border = style.LINE
    sheet.cell(row, 5).value = clause or None
    style.put(sheet, row, 7, note, color=style.GRAY)
