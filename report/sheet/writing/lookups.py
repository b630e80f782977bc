"""The sheet Tables: what the formulas look up, each with source and confidence.

Site coefficients, limits of the seismic design category, separations in use, units in use, and the
ids that the sheet Clearances offers. Read `write_lookups`.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from openpyxl import Workbook
from openpyxl.worksheet.worksheet import Worksheet

from report.sheet.schema import SECTIONS
from report.sheet.schema.fields import entries
from report.sheet.schema.layout import LAST_ROW, Layout, name_cell, name_formula, name_range
from report.sheet.writing import style
from report.words.units import LENGTHS, PRESSURES, STIFFNESSES, VELOCITIES, WEIGHTS
from solver.rules import hazard
from solver.rules.provisions import SEPARATION_KEYS, Neighbor
from solver.rules.rulesets import Confidence
from solver.rules.site_coefficients import F_A, F_V, CoefficientTable

TABLES = "Tables"
MOST_NAMES = 120
"""Ids that the dropdown of the sheet Clearances can show."""

_HINT = "What the formulas of this workbook look up. This sheet has no input cells."
_STATUS = {
    Confidence.CONFIRMED: "confirmed against a published calculation",
    Confidence.KNOWN: "† verify against the adopted code",
    Confidence.LOW: "† low confidence: verify against the adopted code",
}


def write_lookups(book: Workbook, layout: Layout) -> None:
    """Write the sheet, with the defined names that other formulas use."""
    sheet = book.create_sheet(TABLES)
    style.put_title(sheet, TABLES, _HINT)
    sheet.column_dimensions["A"].width = 34
    for letter in "BCDEFGH":
        sheet.column_dimensions[letter].width = 14
    row = 4
    for table in (F_A, F_V):
        row = _write_coefficients(book, sheet, row, table)
    row = _write_sdc(book, sheet, row)
    row = _write_separations(book, sheet, row)
    row = _write_units(book, sheet, layout, row)
    _write_names(book, sheet, layout, row)
    sheet.print_area = f"A1:H{row - 1}"


def _write_heads(sheet: Worksheet, row: int, title: str, note: str, heads: Sequence[str]) -> int:
    style.put(sheet, row, 1, title, bold=True, size=12, wrap=False)
    style.put(sheet, row + 1, 1, note, color=style.GRAY, wrap=False)
    for column, head in enumerate(heads, start=1):
        style.put(sheet, row + 2, column, head, bold=True).border = style.LINE
    return row + 3


def _put_number(sheet: Worksheet, row: int, column: int, value: float) -> None:
    cell = style.put(sheet, row, column, "")
    cell.value, cell.data_type = value, "n"
    cell.border = style.LINE


def _write_coefficients(book: Workbook, sheet: Worksheet, row: int, table: CoefficientTable) -> int:
    mapped = {"F_a": "S_S", "F_v": "S_1"}[table.symbol]
    title = f"Site coefficient {table.symbol}, {table.clause}"
    note = f"{_STATUS[table.confidence]}; linear between columns; site-specific where blank"
    top = _write_heads(sheet, row, title, note, [f"Site class / {mapped} [g]"])
    name = f"table_{table.symbol.lower()}"
    for column, value in enumerate(table.mapped_g, start=2):
        _put_number(sheet, top - 1, column, value)
    for at, (site_class, values) in enumerate(table.rows.items(), start=top):
        style.put(sheet, at, 1, site_class).border = style.LINE
        for column, value in enumerate(values, start=2):
            if math.isnan(value):
                style.put(sheet, at, column, "site-specific", color=style.GRAY, size=9)
            else:
                _put_number(sheet, at, column, value)
    last = top + len(table.rows) - 1
    name_range(book, name, sheet, f"$B${top}:$G${last}")
    name_range(book, f"{name}_mapped", sheet, f"$B${top - 1}:$G${top - 1}")
    name_range(book, f"{name}_classes", sheet, f"$A${top}:$A${last}")
    style.put(sheet, last + 1, 1, table.edition, color=style.GRAY)
    name_cell(book, f"{name}_edition", sheet, last + 1, 1)
    return last + 3


def _write_sdc(book: Workbook, sheet: Worksheet, row: int) -> int:
    note = "Least value of categories B, C and D; in risk category IV of C, D and D; ASCE 7, 11.6"
    top = _write_heads(sheet, row, "Seismic design category", note, ["Value [g]", "", "", ""])
    for at, (symbol, name, limits) in enumerate(
        (
            ("S_DS", "sdc_limits_s_ds", hazard.LIMITS_SHORT_G),
            ("S_D1", "sdc_limits_s_d1", hazard.LIMITS_1S_G),
        ),
        start=top,
    ):
        style.put(sheet, at, 1, symbol).border = style.LINE
        for column, value in enumerate(limits, start=2):
            _put_number(sheet, at, column, value)
        name_range(book, name, sheet, f"$B${at}:$D${at}")
    style.put(sheet, top + 2, 1, "S_1, category E or F").border = style.LINE
    _put_number(sheet, top + 2, 2, hazard.NEAR_FAULT_S_1_G)
    name_cell(book, "sdc_limit_s_1", sheet, top + 2, 2)
    return top + 4


def _write_separations(book: Workbook, sheet: Worksheet, row: int) -> int:
    top = _write_heads(
        sheet,
        row,
        "Separations in use",
        "From the sheet Provisions, for the rule set on the sheet Site",
        ["Neighbor", "Factor", "Minimum [in]"],
    )
    for at, neighbor in enumerate(Neighbor, start=top):
        style.put(sheet, at, 1, neighbor.value).border = style.LINE
        style.put_answer(sheet.cell(at, 2), f"rule_{SEPARATION_KEYS[neighbor]}")
        least = "rule_separation_edge_min_in" if neighbor is Neighbor.EDGE else "0"
        style.put_answer(sheet.cell(at, 3), least)
    last = top + len(Neighbor) - 1
    for letter, name in zip(
        "ABC",
        ("live_neighbors", "live_separation_factors", "live_separation_minima_in"),
        strict=True,
    ):
        name_range(book, name, sheet, f"${letter}${top}:${letter}${last}")
    return last + 2


def _unit_sizes() -> Mapping[str, float]:
    return LENGTHS | WEIGHTS | STIFFNESSES | VELOCITIES | PRESSURES


def _write_units(book: Workbook, sheet: Worksheet, layout: Layout, row: int) -> int:
    sizes = _unit_sizes()
    top = _write_heads(sheet, row, "Units", "Size of each unit in SI", ["Unit", "In SI"])
    for at, (symbol, size) in enumerate(sizes.items(), start=top):
        style.put(sheet, at, 1, symbol).border = style.LINE
        _put_number(sheet, at, 2, size)
    last = top + len(sizes) - 1
    name_range(book, "unit_symbols", sheet, f"$A${top}:$A${last}")
    name_range(book, "unit_sizes", sheet, f"$B${top}:$B${last}")
    top = _write_heads(
        sheet,
        last + 2,
        "Units in use",
        "As written in headings and unit cells",
        ["Input", "Unit", "In SI"],
    )
    at = top
    for section, name, words, symbol in _units_in_use(layout):
        style.put(sheet, at, 1, words).border = style.LINE
        style.put_answer(sheet.cell(at, 2), f'IFERROR({symbol},"")')
        style.put_answer(
            sheet.cell(at, 3), f'IFERROR(INDEX(unit_sizes,MATCH($B{at},unit_symbols,0)),"")'
        )
        name_cell(book, f"unit_{section}_{name}", sheet, at, 3)
        at += 1
    name_range(book, "units_in_use", sheet, f"$B${top}:$B${at - 1}")
    return at + 1


def _units_in_use(layout: Layout) -> Iterator[tuple[str, str, str, str]]:
    """Yield section, field, words, and the formula of the unit's symbol."""
    for section in SECTIONS:
        for entry in entries(section.model):
            if entry.quantity is None:
                continue
            words = f"{section.title}: {entry.cell.label}"
            if section.is_table:
                head = layout.tables[section.key].heading_cell(entry.name)
                start = f'FIND("[",{head})+1'
                symbol = f'TRIM(MID({head},{start},FIND("]",{head})-({start})))'
            else:
                symbol = f"TRIM({section.unit_name(entry.name)})"
            yield section.key, entry.name, words, symbol


def _write_names(book: Workbook, sheet: Worksheet, layout: Layout, row: int) -> None:
    """Write the ids of arrays and objects, one list, which the sheet Clearances offers."""
    arrays, objects = (layout.tables[key].all("id") for key in ("arrays", "objects"))
    grounds = layout.tables["motions"].all("recorded_at")
    count = f"COUNTA({arrays})"
    top = _write_heads(
        sheet, row, "Names for the sheet Clearances", "Arrays, then objects", ["Name"]
    )
    model: Any = None
    for at in range(top, top + MOST_NAMES):
        number = f"ROWS($A${top}:$A{at})"
        other = f'IF({number}<={count}+COUNTA({objects}),INDEX({objects},{number}-{count})&"","")'
        formula = f'IF({number}<={count},INDEX({arrays},{number})&"",{other})'
        cell = sheet.cell(at, 1)
        style.put_answer(cell, f'IFERROR({formula},"")', like=model)
        model = model or cell
    name_range(book, "name_list", sheet, f"$A${top}:$A${top + MOST_NAMES - 1}")
    outlines = layout.tables["outlines"]
    letter, first_row = outlines.letters["name"], outlines.header + 1
    area = f"${letter}${first_row}:${letter}${LAST_ROW}"
    name_range(book, "live_outlines", book[outlines.section.sheet], area)
    below = top + MOST_NAMES + 1
    for at, (words, formula, name) in enumerate(
        (
            ("Arrays", count, "live_array_count"),
            ("Arrays and objects", f"{count}+COUNTA({objects})", "live_name_count"),
            (
                "Largest I_p",
                f"MAX(1,{layout.tables['arrays'].all('i_p')},{layout.tables['objects'].all('i_p')})",
                "live_largest_i_p",
            ),
            ("Ground motions", f'COUNTIF({grounds},"ground")', "live_ground_motions"),
        ),
        start=below,
    ):
        style.put(sheet, at, 1, words)
        style.put_answer(sheet.cell(at, 2), formula)
        name_cell(book, name, sheet, at, 2)
    first = f"{TABLES}!$A${top},0,0"
    for name, length in (("names", "name_count"), ("array_names", "array_count")):
        reach = f"MIN({MOST_NAMES},MAX(1,live_{length}))"
        name_formula(book, f"live_{name}", f"OFFSET({first},{reach},1)")
