"""The Provisions worksheet: every number of the rule sets, with its source and confidence."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence

from openpyxl import Workbook
from openpyxl.utils import get_column_letter
from openpyxl.worksheet.worksheet import Worksheet

from report.project.model.overrides import provision_name, provision_unit
from report.project.workbook import layout
from report.project.workbook.answer_columns import (
    BY_FORMULA,
    IN_DISPLACEMENT,
    IN_SEPARATION,
    ONE_VALUE,
)
from report.project.write import style
from solver.rules.provisions import SEPARATION_KEYS
from solver.rules.rulesets import ALLOWED, RULE_SETS, RuleSet, usual

PROVISIONS = "Provisions"
_HEADS = ("Rule", "Unit", "In use", "Override, allowed", "Override, typical")
_WIDTHS = (52, 6, 9, 12, 14)
_RULE_WIDTHS = (10, 16)
_FIRST = len(_HEADS) + 1
_FROM, _TO = map(get_column_letter, (_FIRST, _FIRST + 2 * len(RULE_SETS) - 1))
_PROVISIONS_HINT = (
    "Value and code section of each rule by rule set. Override a value on the Options worksheet,"
    " within the allowed range. No input cells on this worksheet."
)
_MARKS = "† not confirmed against a published calculation: verify against the adopted code."

# What of a rule set is no number: its name, words, and what a rule set says.
_FACTS: Sequence[tuple[str, str, Callable[[RuleSet], str]]] = (
    ("importance", "The importance factor is applied",
     lambda rules: IN_SEPARATION if rules.importance_in_separation else IN_DISPLACEMENT),
    ("low_sdc", "In SDC A, B, C the prescriptive displacement is",
     lambda rules: ONE_VALUE if rules.low_sdc_is_flat else BY_FORMULA),
    ("edition", "Edition of ASCE 7, if not entered on the Site worksheet",
     lambda rules: rules.edition),
    ("low_profile", "The height of the center of gravity is limited to a fraction of the",
     lambda rules: rules.low_profile_length.value),
)  # fmt: skip


def write_rules(book: Workbook, tables: layout.Tables) -> None:
    """Write the sheet, with a defined name for each number in use."""
    sheet = book.create_sheet(PROVISIONS)
    style.put_title(sheet, PROVISIONS, _PROVISIONS_HINT)
    style.put(sheet, 3, 1, _MARKS, color=style.GRAY, size=9, wrap=False)
    names: list[str] = []
    for rules in RULE_SETS.values():
        names += [rules.name, "Code section"]
    head = 5
    layout.name_range("rule_sets", sheet, f"${_FROM}${head}:${_TO}${head}")
    style.put_values(sheet, head, (*_HEADS, *names), are_heads=True)
    for column, width in enumerate((*_WIDTHS, *(_RULE_WIDTHS * len(RULE_SETS))), start=1):
        sheet.column_dimensions[get_column_letter(column)].width = width
    sheet.row_dimensions[head].height = 32
    first = head + 1
    for row, key in enumerate(ALLOWED, start=first):
        _write_rule(sheet, tables["overrides"], row, key)
    last = first + len(ALLOWED) - 1
    layout.name_range("rule_names", sheet, f"$A${first}:$A${last}")
    separations = [first + [*ALLOWED].index(key) for key in dict.fromkeys(SEPARATION_KEYS.values())]
    # Formulas index it by `SEPARATION_ROWS`, whose order is that of these keys.
    layout.name_range("rule_separations", sheet, f"$C${separations[0]}:$C${separations[-1]}")
    _write_facts(sheet, tables["overrides"], last + 2)
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
            _write_pair(sheet, row, count, "–", "not in this rule set")
        else:
            mark = "" if provision.verified else "†"
            _write_pair(sheet, row, count, provision.value, f"{provision.clause}{mark}")
    _write_in_use(sheet, overrides, row, key)
    sheet.cell(row, 3).number_format = "0.####"
    lines = math.ceil(len(provision_name(key)) / _WIDTHS[0])
    sheet.row_dimensions[row].height = 7 + 13 * lines


def _write_in_use(sheet: Worksheet, overrides: layout.TablePlace, row: int, key: str) -> None:
    """Write the governing value: an override, or else the value of the rule set."""
    override = f"INDEX({overrides.all('value')},MATCH($A{row},{overrides.all('provision')},0))"
    of_rules = f"INDEX(${_FROM}{row}:${_TO}{row},MATCH(site_rule_set,rule_sets,0))"
    style.put_answer(sheet.cell(row, 3), f'IFERROR({override},IFERROR({of_rules},""))')
    layout.name_cell(f"rule_{key}", sheet, row, 3)


def _write_pair(sheet: Worksheet, row: int, count: int, value: str | float, clause: str) -> None:
    column = _FIRST + 2 * count
    cell = style.put(sheet, row, column, "", color=style.INK)
    cell.value = value
    # `put` has made the cell one of text.
    if isinstance(value, float):
        cell.number_format = "0.####"
        cell.data_type = "n"
    cell.border = style.LINE
    style.put(sheet, row, column + 1, clause, color=style.GRAY, size=9).border = style.LINE


def _write_facts(sheet: Worksheet, overrides: layout.TablePlace, top: int) -> None:
    style.put(sheet, top, 1, "Differences between the rule sets", bold=True, wrap=False)
    for row, (key, words, fact) in enumerate(_FACTS, start=top + 1):
        style.put(sheet, row, 1, words).border = style.LINE
        for count, rules in enumerate(RULE_SETS.values()):
            _write_pair(sheet, row, count, fact(rules), "")
            # A text takes the width of a value and its clause.
            start = _FIRST + 2 * count
            sheet.merge_cells(start_row=row, end_row=row, start_column=start, end_column=start + 1)
        _write_in_use(sheet, overrides, row, key)
        sheet.merge_cells(start_row=row, end_row=row, start_column=3, end_column=_FIRST - 1)
        sheet.row_dimensions[row].height = 32
