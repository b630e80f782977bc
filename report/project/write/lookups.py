"""The Tables worksheet: lookup tables for the formulas of a workbook."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence

from openpyxl import Workbook
from openpyxl.utils import get_column_letter, quote_sheetname
from openpyxl.worksheet.worksheet import Worksheet

from report.project.workbook import SECTION, layout
from report.project.workbook.answer_columns import COLUMNS, KINDS, SEPARATION_ROWS
from report.project.write import style
from report.text.units import LENGTHS
from solver.model import INCH_M
from solver.rules import hazard
from solver.rules.rulesets import Confidence
from solver.rules.site_coefficients import F_A, F_V, CoefficientTable

TABLES = "Tables"
# Above every mapped acceleration that is accepted.
_ABOVE_ALL_G = 100.0
_HINT = "Lookup tables for the formulas in this workbook. No input cells on this worksheet."
_STATUS = {
    Confidence.CONFIRMED: "confirmed against a published calculation",
    Confidence.KNOWN: "† verify against the adopted code",
    Confidence.LOW: "† low confidence: verify against the adopted code",
}


def write_lookups(book: Workbook, tables: layout.Tables) -> None:
    """Write the sheet, with the defined names that formulas use."""
    sheet = book.create_sheet(TABLES)
    sheet.sheet_state = "hidden"
    style.put_title(sheet, TABLES, _HINT)
    sheet.column_dimensions["A"].width = 34
    for letter in "BC":
        sheet.column_dimensions[letter].width = 32
    for letter in "DEFGHIJKL":
        sheet.column_dimensions[letter].width = 14
    row = 4
    for table in (F_A, F_V):
        row = _write_coefficients(sheet, row, table)
    row = _write_sdc(sheet, row)
    row = _write_neighbors(sheet, row)
    _write_units(sheet, row)
    for name, (key, column) in COLUMNS.items():
        place = tables[key]
        layout.name_range(name, book[place.sheet], place.area(column))
    # A dropdown shows the blanks of its range, too: it has as many cells as are filled.
    for name, key in (("array_names", "arrays"), ("object_names", "objects")):
        place = tables[key]
        first = f"{quote_sheetname(place.sheet)}!${place.letters['id']}${place.header + 1}"
        filled = f"MAX(1,COUNTA({place.all('id')}))"
        layout.name_formula(book, name, f"OFFSET({first},0,0,{filled},1)")


def _write_table(
    sheet: Worksheet,
    row: int,
    words: tuple[str, str],
    heads: Sequence[style.Value],
    rows: Iterable[Sequence[style.Value]],
    names: Mapping[str, str],
) -> int:
    """Write title and note, heads, and rows; name columns, as `B:C`; return the next free row."""
    title, note = words
    style.put(sheet, row, 1, title, bold=True, size=12, wrap=False)
    style.put(sheet, row + 1, 1, note, color=style.GRAY, wrap=False)
    style.put_values(sheet, row + 2, heads, are_heads=True)
    top = next_row = row + 3
    for values in rows:
        style.put_values(sheet, next_row, values)
        next_row += 1
    for name, columns in names.items():
        first, _, last = columns.partition(":")
        layout.name_range(name, sheet, f"${first}${top}:${last}${next_row - 1}")
    return next_row + 1


def _write_coefficients(sheet: Worksheet, row: int, table: CoefficientTable) -> int:
    mapped = {"F_a": "S_S", "F_v": "S_1"}[table.symbol]
    title = f"Site coefficient {table.symbol}, {table.clause}"
    note = f"{_STATUS[table.confidence]}; linear between columns; site-specific where blank"
    # Beyond the table its first and last columns hold.
    # From the largest down, as the formulas need for MATCH with -1.
    heads: list[style.Value] = [
        f"Site class / {mapped} [g]",
        _ABOVE_ALL_G,
        *reversed(table.mapped_g),
        0.0,
    ]
    rows: list[list[style.Value]] = [
        [site_class, values[-1], *reversed(values), values[0]]
        for site_class, values in table.rows.items()
    ]
    symbol = table.symbol.lower()
    names = {f"{symbol}_class": "A:A"}
    after = _write_table(sheet, row, (title, note), heads, rows, names)
    last = get_column_letter(len(heads))
    layout.name_range(f"{symbol}_at", sheet, f"$B${row + 2}:${last}${row + 2}")
    return after


def _write_sdc(sheet: Worksheet, row: int) -> int:
    limits: list[list[style.Value]] = [
        ["S_DS", 0.0, *hazard.LIMITS_SHORT_G],
        ["S_D1", 0.0, *hazard.LIMITS_1S_G],
    ]
    note = "Lower limit of each step; ASCE 7, 11.6"
    words = ("Steps of the seismic design category", note)
    after = _write_table(sheet, row, words, ("Value [g]", "1", "2", "3", "4"), limits, {})
    for step_row, name in enumerate(("sdc_s_ds", "sdc_s_d1"), start=row + 3):
        layout.name_range(name, sheet, f"$B${step_row}:$E${step_row}")
    note = f"By step; step 5 is S_1 of {hazard.NEAR_FAULT_S_1_G} g or more. Then, if certain,"
    rows = []
    for category, i_e in hazard.LEAST_I_E.items():
        letters = "ACDDF" if category == "IV" else "ABCDE"
        # Without S_D1 a category below that of the tables' last step may be another.
        without = ["" if letter < hazard.MOST_BY_TABLES else letter for letter in letters]
        rows.append([category, i_e, *letters, *without])
    steps = ["1", "2", "3", "4", "5"]
    heads = ["Risk category", "I_e", *steps, *(f"{step}, no S_D1" for step in steps)]
    names = {"risk_categories": "A:B", "sdc_categories": "A:A", "sdc_letters": "C:L"}
    words = ("Seismic design category", f"{note} without S_D1")
    return _write_table(sheet, after, words, heads, rows, names)


def _write_neighbors(sheet: Worksheet, row: int) -> int:
    words = ("Object types", "Clearance type of each next to an array")
    heads = ("Type", "No qualifying parapet", "Qualifying parapet")
    kinds = [(kind.value, *neighbors) for kind, neighbors in KINDS.items()]
    row = _write_table(sheet, row, words, heads, kinds, {"kinds": "A:C"})
    words = ("Clearance types", "Separation of each, by its row on the Provisions worksheet")
    rows = [(neighbor.value, float(number)) for neighbor, number in SEPARATION_ROWS.items()]
    return _write_table(
        sheet, row, words, ("Clearance type", "Separation"), rows, {"neighbors": "A:B"}
    )


def _write_units(sheet: Worksheet, row: int) -> None:
    words = ("Units in headings", "In inches")
    lengths = (("arrays", "cg_height_m"), ("objects", "height_m"), ("clearances", "provided_m"))
    rows = []
    for key, field in lengths:
        label = SECTION[key].entry(field).heading
        rows += [(f"{label} [{unit}]", size_m / INCH_M) for unit, size_m in LENGTHS.items()]
    _write_table(sheet, row, words, ("Heading", "In inches"), rows, {"inches": "A:B"})
