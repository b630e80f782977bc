"""Shared by the sheets of results.xlsx: formats, titles, headings.

Owns no content: see `report.results.xlsx`.
"""

from __future__ import annotations

from xlsxwriter.format import Format
from xlsxwriter.workbook import Workbook
from xlsxwriter.worksheet import Worksheet

from report.assessment.overrides import OVERRIDDEN
from report.sheet.schema import Direction

DIRECTION_HEADINGS = {
    Direction.DOWN: "Downslope [in]",
    Direction.UP: "Upslope [in]",
    Direction.ACROSS: "Cross-slope [in]",
    Direction.ANY: "Any direction [in]",
}
"""Headings of displacements by direction."""


STATISTIC_COLUMN = "T"
"""Column of the sheet Design that holds the statistic of the peaks of an array."""

_DECIMALS = (0, 1, 2, 3, 4)
_INPUT_FILL = "#FFF7CC"
_LETTER = 1


def typed(value: float) -> float:
    """Return a number as it was typed: without the rounding error of a conversion of units."""
    return float(f"{value:.12g}")


def print_on_letter(sheet: Worksheet, heading_row: int) -> None:
    """Print a sheet as wide as a landscape page, with its headings on each."""
    sheet.set_landscape()
    sheet.set_paper(_LETTER)
    sheet.set_margins(left=0.4, right=0.4, top=0.6, bottom=0.6)
    sheet.fit_to_pages(1, 0)
    sheet.repeat_rows(heading_row)
    sheet.set_footer("&L&F, &A&RPage &P of &N")


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
        self.typed_text = workbook.add_format({"bg_color": _INPUT_FILL, "border": 4})
        self.numbers = {d: workbook.add_format({"num_format": _format(d)}) for d in _DECIMALS}
        fill = {"bg_color": _INPUT_FILL, "border": 4}
        self.typed = {d: workbook.add_format({"num_format": _format(d)} | fill) for d in _DECIMALS}
        self._marked = {
            id(plain): workbook.add_format({"num_format": f'{_format(d)}"{OVERRIDDEN}"'} | more)
            for formats, more in ((self.numbers, {}), (self.typed, fill))
            for d, plain in formats.items()
        }

    def marked(self, plain: Format, mark: str) -> Format:
        """Return the format of a number with its mark, which leaves it a number."""
        return self._marked[id(plain)] if mark else plain

    def sheet(self, name: str, title: str, note: str) -> Worksheet:
        """Return a sheet with its heading written."""
        sheet: Worksheet = self.workbook.get_worksheet_by_name(name)
        sheet.write_string(0, 0, title, self.title)
        sheet.write_string(1, 0, note, self.note)
        return sheet


def _format(decimals: int) -> str:
    return f"0.{'0' * decimals}" if decimals else "0"


def write_headings(pages: Pages, sheet: Worksheet, row: int, headings: tuple[str, ...]) -> None:
    """Write a row of headings and freeze it."""
    for column, heading in enumerate(headings):
        sheet.write_string(row, column, heading, pages.head)
    sheet.set_row(row, 48)
    sheet.set_column(0, len(headings) - 1, 13)
    sheet.freeze_panes(row + 1, 1)
    print_on_letter(sheet, row)
