"""Shared by the sheets of results.xlsx: formats, titles, headings.

Owns no content: see `report.results.xlsx`.
"""

from __future__ import annotations

from xlsxwriter.workbook import Workbook
from xlsxwriter.worksheet import Worksheet

from report.sheet.schema import Direction

DIRECTION_HEADINGS = {
    Direction.DOWN: "Downslope [in]",
    Direction.UP: "Upslope [in]",
    Direction.ACROSS: "Cross-slope [in]",
    Direction.ANY: "Any direction [in]",
}
"""Headings of displacements by direction."""


class Pages:
    """The formats that all sheets share."""

    def __init__(self, workbook: Workbook):
        self.workbook = workbook
        self.title = workbook.add_format({"bold": True, "font_size": 14})
        self.head = workbook.add_format(
            {"bold": True, "bottom": 1, "text_wrap": True, "valign": "top"}
        )
        self.note = workbook.add_format({"italic": True, "font_color": "#555555"})
        self.plain = workbook.add_format({})
        self.numbers = {
            decimals: workbook.add_format({"num_format": f"0.{'0' * decimals}"})
            for decimals in (1, 2, 3, 4)
        }

    def sheet(self, name: str, title: str, note: str) -> Worksheet:
        """Return a sheet with its heading written."""
        sheet: Worksheet = self.workbook.get_worksheet_by_name(name)
        sheet.write_string(0, 0, title, self.title)
        sheet.write_string(1, 0, note, self.note)
        return sheet


def write_headings(pages: Pages, sheet: Worksheet, row: int, headings: tuple[str, ...]) -> None:
    """Write a row of headings and freeze it."""
    for column, heading in enumerate(headings):
        sheet.write_string(row, column, heading, pages.head)
    sheet.set_row(row, 48)
    sheet.set_column(0, len(headings) - 1, 13)
    sheet.freeze_panes(row + 1, 1)
