"""The sheets Tables, what the formulas look up, and Provisions, every number of the rule sets.

Each has its source and confidence. Read `write_lookups`, then `write_rules`.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator, Sequence

from openpyxl import Workbook
from openpyxl.utils import get_column_letter, quote_sheetname
from openpyxl.worksheet.worksheet import Worksheet

from report.sheet.schema import SECTIONS, layout, provision_name, provision_unit
from report.sheet.schema.answers import BY_FORMULA, IN_DISPLACEMENT, IN_SEPARATION, ONE_VALUE
from report.sheet.schema.fields import entries
from report.sheet.writing import style
from report.sheet.writing.style import Answer
from report.text.units import LENGTHS, PRESSURES, STIFFNESSES, VELOCITIES, WEIGHTS
from solver.rules import hazard
from solver.rules.provisions import OVERRIDABLE, SEPARATION_KEYS, Neighbor
from solver.rules.rulesets import ALLOWED, RULE_SETS, Confidence, RuleSet, usual
from solver.rules.site_coefficients import F_A, F_V, CoefficientTable

TABLES = "Tables"
# Ids that the dropdown of the sheet Clearances can show.
MOST_NAMES = 120

_HINT = "What the formulas of this workbook look up. This sheet has no input cells."
_STATUS = {
    Confidence.CONFIRMED: "confirmed against a published calculation",
    Confidence.KNOWN: "† verify against the adopted code",
    Confidence.LOW: "† low confidence: verify against the adopted code",
}


def write_lookups(book: Workbook, tables: layout.Tables) -> None:
    """Write the sheet, with the defined names that other formulas use."""
    sheet = book.create_sheet(TABLES)
    sheet.sheet_state = "hidden"
    style.put_title(sheet, TABLES, _HINT)
    sheet.column_dimensions["A"].width = 34
    for letter in "BCDEFGH":
        sheet.column_dimensions[letter].width = 14
    row = 4
    for table in (F_A, F_V):
        row = _write_coefficients(sheet, row, table)
    row = _write_sdc(sheet, row)
    row = _write_separations(sheet, row)
    row = _write_units(sheet, tables, row)
    _write_names(book, sheet, tables, row)


def _write_table(
    sheet: Worksheet,
    row: int,
    words: tuple[str, str],
    heads: Sequence[style.Value],
    rows: Iterable[Sequence[style.Value]],
    names: Sequence[str] = (),
) -> int:
    """Write title and note, heads, and rows; name the columns; return the row after the last."""
    title, note = words
    style.put(sheet, row, 1, title, bold=True, size=12, wrap=False)
    style.put(sheet, row + 1, 1, note, color=style.GRAY, wrap=False)
    style.put_values(sheet, row + 2, heads, are_heads=True)
    top = at = row + 3
    for values in rows:
        style.put_values(sheet, at, values)
        at += 1
    for letter, name in zip("ABC", names, strict=False):
        if name:
            layout.name_range(name, sheet, f"${letter}${top}:${letter}${at - 1}")
    return at


def _write_coefficients(sheet: Worksheet, row: int, table: CoefficientTable) -> int:
    mapped = {"F_a": "S_S", "F_v": "S_1"}[table.symbol]
    title = f"Site coefficient {table.symbol}, {table.clause}"
    note = f"{_STATUS[table.confidence]}; linear between columns; site-specific where blank"
    heads: list[style.Value] = [f"Site class / {mapped} [g]", *table.mapped_g]
    rows: list[list[style.Value]] = [[name, *values] for name, values in table.rows.items()]
    name = f"table_{table.symbol.lower()}"
    after = _write_table(sheet, row, (title, note), heads, rows, [f"{name}_classes"])
    layout.name_range(name, sheet, f"$B${row + 3}:$G${after - 1}")
    layout.name_range(f"{name}_mapped", sheet, f"$B${row + 2}:$G${row + 2}")
    style.put(sheet, after, 1, table.edition, color=style.GRAY)
    layout.name_cell(f"{name}_edition", sheet, after, 1)
    return after + 2


def _write_sdc(sheet: Worksheet, row: int) -> int:
    note = "Least value of categories B, C and D; in risk category IV of C, D and D; ASCE 7, 11.6"
    rows = (
        ("S_DS", *hazard.LIMITS_SHORT_G),
        ("S_D1", *hazard.LIMITS_1S_G),
        ("S_1, category E or F", hazard.NEAR_FAULT_S_1_G),
    )
    words = ("Seismic design category", note)
    after = _write_table(sheet, row, words, ("Value [g]", "", "", ""), rows)
    for at, name in enumerate(("sdc_limits_s_ds", "sdc_limits_s_d1"), start=row + 3):
        layout.name_range(name, sheet, f"$B${at}:$D${at}")
    layout.name_cell("sdc_limit_s_1", sheet, after - 1, 2)
    return after + 1


def _write_separations(sheet: Worksheet, row: int) -> int:
    least = {Neighbor.EDGE: "rule_separation_edge_min_in"}
    factors = {each: Answer(f"rule_{SEPARATION_KEYS[each]}") for each in Neighbor}
    rows = ((each.value, factors[each], Answer(least.get(each, "0"))) for each in Neighbor)
    words = ("Separations in use", "From the sheet Provisions, for the rule set on the sheet Site")
    heads = ("Neighbor", "Factor", "Minimum [in]")
    names = ("live_neighbors", "live_separation_factors", "live_separation_minima_in")
    return _write_table(sheet, row, words, heads, rows, names) + 1


def _write_units(sheet: Worksheet, tables: layout.Tables, row: int) -> int:
    sizes = (LENGTHS | WEIGHTS | STIFFNESSES | VELOCITIES | PRESSURES).items()
    words = ("Units", "Size of each unit in SI")
    names = ("unit_symbols", "unit_sizes")
    row = _write_table(sheet, row, words, ("Unit", "In SI"), sizes, names) + 1
    in_use = list(_units_in_use(tables))
    rows = [
        (
            words,
            Answer(f'IFERROR({symbol},"")'),
            Answer(f'IFERROR(INDEX(unit_sizes,MATCH($B{at},unit_symbols,0)),"")'),
        )
        for at, (_, words, symbol) in enumerate(in_use, start=row + 3)
    ]
    for at, (name, _, _) in enumerate(in_use, start=row + 3):
        layout.name_cell(f"unit_{name}", sheet, at, 3)
    words = ("Units in use", "As written in headings and unit cells")
    return (
        _write_table(sheet, row, words, ("Input", "Unit", "In SI"), rows, ("", "units_in_use")) + 1
    )


def _units_in_use(tables: layout.Tables) -> Iterator[tuple[str, str, str]]:
    """Yield the name of each field with a choice of units, words, and the symbol's formula."""
    for section in SECTIONS:
        for entry in entries(section.model):
            if entry.quantity is None:
                continue
            words = f"{section.title}: {entry.cell.label}"
            if section.is_table:
                place = tables[section.key]
                head = f"{quote_sheetname(place.sheet)}!${place.letters[entry.name]}${place.header}"
                # The user may write another unit into the brackets of the heading.
                start = f'FIND("[",{head})+1'
                symbol = f'TRIM(MID({head},{start},FIND("]",{head})-({start})))'
            else:
                symbol = f"TRIM({section.unit_name(entry.name)})"
            yield section.cell_name(entry.name), words, symbol


def _write_names(book: Workbook, sheet: Worksheet, tables: layout.Tables, row: int) -> None:
    """Write the ids of arrays and objects, one list, which the sheet Clearances offers."""
    arrays, objects = (tables[key].all("id") for key in ("arrays", "objects"))
    factors = ",".join(tables[key].all("i_p") for key in ("arrays", "objects"))
    count, top = f"COUNTA({arrays})", row + 3

    # INDEX gives 0 for an empty cell; with &"" it gives nothing.
    def name_of(number: str) -> Answer:
        other = f'IF({number}<={count}+COUNTA({objects}),INDEX({objects},{number}-{count})&"","")'
        return Answer(f'IFERROR(IF({number}<={count},INDEX({arrays},{number})&"",{other}),"")')

    rows = ((name_of(f"ROWS($A${top}:$A{top + k})"),) for k in range(MOST_NAMES))
    words = ("Names for the sheet Clearances", "Arrays, then objects")
    below = _write_table(sheet, row, words, ("Name",), rows, ("name_list",)) + 1
    outlines = tables["outlines"]
    letter, first_row = outlines.letters["name"], outlines.header + 1
    area = f"${letter}${first_row}:${letter}${layout.LAST_ROW}"
    layout.name_range("live_outlines", book[outlines.section.sheet], area)
    totals = (
        ("Arrays", count, "live_array_count"),
        ("Arrays and objects", f"{count}+COUNTA({objects})", "live_name_count"),
        ("Largest I_p", f"MAX(1,{factors})", "live_largest_i_p"),
    )
    for at, (said, formula, name) in enumerate(totals, start=below):
        style.put(sheet, at, 1, said)
        style.put_answer(sheet.cell(at, 2), formula)
        layout.name_cell(name, sheet, at, 2)
    # A dropdown shows the blanks of its range, too: the names are as many as are in use.
    first = f"{TABLES}!$A${top},0,0"
    for name, length in (("names", "name_count"), ("array_names", "array_count")):
        reach = f"MIN({MOST_NAMES},MAX(1,live_{length}))"
        layout.name_formula(book, f"live_{name}", f"OFFSET({first},{reach},1)")


PROVISIONS = "Provisions"
_HEADS = ("Rule", "Unit", "In use", "Clause in use", "Override, allowed", "Override, usual")
_WIDTHS = (52, 6, 9, 18, 12, 14)
_RULE_WIDTHS = (10, 16)
_FIRST = len(_HEADS) + 1
_FROM, _TO = map(get_column_letter, (_FIRST, _FIRST + 2 * len(RULE_SETS) - 1))
_PROVISIONS_HINT = (
    "Value and clause of each rule by rule set. Override a number on the sheet Options, within the"
    " range allowed. This sheet has no input cells."
)
_MARKS = (
    "† not confirmed against a published calculation: verify against the adopted code."
    "  ‡ overridden on the sheet Options."
)


# What of a rule set is no number: its name, words, and what a rule set says.
_FACTS: Sequence[tuple[str, str, Callable[[RuleSet], str]]] = (
    ("importance", "The importance factor is applied",
     lambda rules: IN_SEPARATION if rules.importance_in_separation else IN_DISPLACEMENT),
    ("low_sdc", "In SDC A, B, C the prescriptive displacement is",
     lambda rules: ONE_VALUE if rules.low_sdc_is_flat else BY_FORMULA),
    ("edition", "Edition of ASCE 7, unless Site names one", lambda rules: rules.edition),
    ("low_profile", "The height of the center of gravity is limited by a fraction of the",
     lambda rules: rules.low_profile_length.value),
)  # fmt: skip


def write_rules(book: Workbook, tables: layout.Tables) -> None:
    """Write the sheet, with a defined name for each number in use."""
    sheet = book.create_sheet(PROVISIONS)
    style.put_title(sheet, PROVISIONS, _PROVISIONS_HINT)
    style.put(sheet, 3, 1, _MARKS, color=style.GRAY, size=9, wrap=False)
    names = (head for rules in RULE_SETS.values() for head in (rules.name, "Clause"))
    head = 5
    layout.name_range("rule_sets", sheet, f"${_FROM}${head}:${_TO}${head}")
    style.put_values(sheet, head, (*_HEADS, *names), are_heads=True)
    for column, width in enumerate((*_WIDTHS, *(_RULE_WIDTHS * len(RULE_SETS))), start=1):
        sheet.column_dimensions[get_column_letter(column)].width = width
    sheet.row_dimensions[head].height = 32
    first = head + 1
    for row, key in enumerate(OVERRIDABLE, start=first):
        _write_rule(sheet, tables["overrides"], row, key)
    last = first + len(OVERRIDABLE) - 1
    layout.name_range("rule_names", sheet, f"$A${first}:$A${last}")
    _write_facts(sheet, last + 2)
    sheet.freeze_panes = f"B{first}"
    sheet.print_title_rows = f"{head}:{head}"


def _write_rule(sheet: Worksheet, overrides: layout.TablePlace, row: int, key: str) -> None:
    style.put(sheet, row, 1, provision_name(key)).border = style.LINE
    style.put(sheet, row, 2, provision_unit(key), color=style.GRAY).border = style.LINE
    for column, span in enumerate((ALLOWED[key].span, usual(key).span), start=_FIRST - 2):
        style.put(sheet, row, column, span, color=style.GRAY, size=9).border = style.LINE
    for count, rules in enumerate(RULE_SETS.values()):
        provision = rules.values.get(key)
        if provision is None:
            _write_pair(sheet, row, count, "–", "no such rule")
        else:
            mark = "" if provision.verified else "†"
            _write_pair(sheet, row, count, provision.value, f"{provision.clause}{mark}")
    value, clause = _chosen(row, 0), _chosen(row, 1)
    # A book may name a rule by the key of earlier versions, or in words.
    for name in (f'"{key}"', f"$A{row}"):
        at = f"MATCH({name},{overrides.all('provision')},0)"
        value = f"IFERROR(INDEX({overrides.all('value')},{at}),{value})"
        clause = f'IF(ISNUMBER({at}),"override‡",{clause})'
    style.put_answer(sheet.cell(row, 3), value, "0.####")
    style.put_answer(sheet.cell(row, 4), clause)
    layout.name_cell(f"rule_{key}", sheet, row, 3)
    layout.name_cell(f"rule_{key}_clause", sheet, row, 4)
    lines = math.ceil(len(provision_name(key)) / _WIDTHS[0])
    sheet.row_dimensions[row].height = 7 + 13 * lines


def _chosen(row: int, offset: int) -> str:
    """Return the value or the clause of the rule set that governs."""
    cells = f"${_FROM}{row}:${_TO}{row}"
    return f'IFERROR(INDEX({cells},1,MATCH(site_rule_set,rule_sets,0)+{offset}),"")'


def _write_pair(sheet: Worksheet, row: int, count: int, value: str | float, clause: str) -> None:
    column = _FIRST + 2 * count
    cell = style.put(sheet, row, column, "", color=style.INK)
    cell.value = value
    if isinstance(value, float):
        cell.number_format = "0.####"
        cell.data_type = "n"
    cell.border = style.LINE
    style.put(sheet, row, column + 1, clause, color=style.GRAY, size=9).border = style.LINE


def _write_facts(sheet: Worksheet, top: int) -> None:
    style.put(sheet, top, 1, "How each rule set works", bold=True, wrap=False)
    for row, (key, words, fact) in enumerate(_FACTS, start=top + 1):
        style.put(sheet, row, 1, words).border = style.LINE
        for count, rules in enumerate(RULE_SETS.values()):
            _write_pair(sheet, row, count, fact(rules), "")
            _merge(sheet, row, _FIRST + 2 * count)
        style.put_answer(sheet.cell(row, 3), _chosen(row, 0))
        layout.name_cell(f"rule_{key}", sheet, row, 3)
        _merge(sheet, row, 3)
        sheet.row_dimensions[row].height = 32


def _merge(sheet: Worksheet, row: int, column: int) -> None:
    # A text takes the width of a value and its clause.
    sheet.merge_cells(start_row=row, end_row=row, start_column=column, end_column=column + 1)
