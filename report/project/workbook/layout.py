"""Locations of the fields and the answers in the template, and references to them."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass

from openpyxl import Workbook
from openpyxl.utils import get_column_letter, quote_sheetname
from openpyxl.workbook.defined_name import DefinedName
from openpyxl.worksheet.worksheet import Worksheet

from report.project.workbook.entries import SheetSection

# Last row that dropdowns and conditional formats reach.
LAST_ROW = 500

# Within brackets an apostrophe goes before these (Excel, structured references).
_SPECIAL, _ESCAPED = re.compile(r"(['#\[\]])"), r"'\1"


@dataclass(frozen=True, slots=True, kw_only=True)
class TablePlace:
    """A table as written; headings and letters of its columns by field or answer."""

    section: SheetSection
    sheet: str  # its title in the workbook, which a user may have changed
    header: int
    size: int  # rows below the headings
    headings: Mapping[str, str]
    letters: Mapping[str, str]

    def heading_cell(self, name: str, *, is_own: bool) -> str:
        """Return the reference to a heading, on its own sheet without the name of it."""
        cell = f"${self.letters[name]}${self.header}"
        return cell if is_own else f"{quote_sheetname(self.sheet)}!{cell}"

    def all(self, name: str) -> str:
        """Return the reference to a whole column."""
        column = _SPECIAL.sub(_ESCAPED, self.headings[name])
        # Files have this form of what Excel shows as table[column].
        return f"{self.section.table_name}[[{column}]]"

    def cells(self, name: str) -> str:
        """Return the range of a column, beyond the prepared rows."""
        letter = self.letters[name]
        return f"{letter}{self.header + 1}:{letter}{LAST_ROW}"

    def area(self, name: str) -> str:
        """Return the same range with absolute references."""
        letter = self.letters[name]
        return f"${letter}${self.header + 1}:${letter}${LAST_ROW}"


# The tables of a workbook by section.
Tables = Mapping[str, TablePlace]


def name_cell(name: str, sheet: Worksheet, row: int, column: int) -> None:
    """Give a cell a defined name."""
    name_range(name, sheet, f"${get_column_letter(column)}${row}")


def name_range(name: str, sheet: Worksheet, area: str) -> None:
    """Give a range, such as `$A$1:$B$2`, a defined name."""
    assert sheet.parent is not None
    name_formula(sheet.parent, name, f"{quote_sheetname(sheet.title)}!{area}")


def name_formula(book: Workbook, name: str, formula: str) -> None:
    """Give a formula a defined name."""
    book.defined_names[name] = DefinedName(name, attr_text=formula)
