"""What the cells of a workbook look like: its conditional formats, computed by LibreOffice.

Each rule is written beside its sheet as a formula of the same row. Read `marked`.
"""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

from openpyxl import load_workbook
from openpyxl.formula.translate import Translator
from openpyxl.utils import get_column_letter, range_boundaries
from openpyxl.worksheet.worksheet import Worksheet

from recalculated import recalculated_sheets
from report.sheet.writing.marks import AMBER, DRAWN, GREEN, RED, RED_INK, SEE_CHECK, VIOLET

BESIDE = 60
"""A column beside every table."""
ROWS = 8
"""Rows below its first that are computed of a range."""

_LOOKS = {
    RED: "red",
    AMBER: "amber",
    VIOLET: "violet",
    DRAWN: "drawn",
    GREEN: "green",
    RED_INK: "red",
}


def marked(paths: list[Path], folder: Path) -> list[dict[str, str]]:
    """Return the look of each cell that has one, by address, of workbooks that stay as they are.

    Red, amber, violet, green, or `see check`: of the first of its rules that holds.
    """
    copies, asked = [], []
    (folder / "asked").mkdir()
    for path in paths:
        book = load_workbook(path)
        asked.append([one for sheet in book for one in _ask(sheet)])
        copies.append(folder / "asked" / f"{path.parent.name}.xlsx")
        book.save(copies[-1])
    found = []
    for sheets, questions in zip(recalculated_sheets(copies, folder), asked, strict=True):
        looks: dict[str, str] = {}
        for address, look, (title, row, column) in questions:
            line = sheets[title][row - 1]
            said = line[column - 1] if column <= len(line) else None
            # A rule that gives an error does not hold.
            assert said in ("TRUE", "FALSE", 0.0, 1.0) or str(said)[:1] == "#", (address, said)
            if said in ("TRUE", 1.0):
                looks.setdefault(address, look)
        found.append(looks)
    return found


def _ask(sheet: Worksheet) -> Iterator[tuple[str, str, tuple[str, int, int]]]:
    """Write each rule beside its cells; yield a cell, a look, and where its rule is computed."""
    used: dict[int, int] = {}
    rules = [(area, rule) for area in sheet.conditional_formatting for rule in area.rules]
    for area, rule in sorted(rules, key=lambda pair: pair[1].priority):
        left, top, right, bottom = range_boundaries(str(area.sqref))
        assert left == right
        origin = f"{get_column_letter(left)}{top}"
        for row in range(top, min(bottom, top + ROWS) + 1):
            used[row] = column = used.get(row, BESIDE - 1) + 1
            place = f"{get_column_letter(left)}{row}"
            moved = Translator(f"={rule.formula[0]}", origin).translate_formula(place)
            sheet.cell(row, column).value = moved
            yield f"{sheet.title}!{place}", _look(rule), (sheet.title, row, column)


def _look(rule) -> str:
    if rule.dxf.numFmt is not None:
        return SEE_CHECK
    color = rule.dxf.fill.start_color if rule.dxf.fill else rule.dxf.font.color
    return _LOOKS[color.rgb[2:]]
