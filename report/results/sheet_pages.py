"""Appearance and print setup of results.xlsx: formats, widths, heads and paper.

Owns no content: see `report.results.xlsx`. Read `Pages`, then `lay_out`.
"""

from __future__ import annotations

import datetime as dt
from collections.abc import Sequence
from io import BytesIO
from textwrap import wrap

from xlsxwriter.format import Format
from xlsxwriter.workbook import Workbook
from xlsxwriter.worksheet import Worksheet

from report.assessment.design.rule_set import OVERRIDDEN
from report.assessment.design.verdict import Verdict

# First row below the headings of a sheet with a title.
TOP = 5

# Height of a line of text.
LINE_PT = 15

# Format of a cell that may be changed: yellow, as in the workbook.
_INPUT = {"bg_color": "#FFF7CC", "border": 4}

_WRAPPED = {"text_wrap": True, "valign": "top", "align": "left"}
# Off the number in the column before.
_TEXT = _WRAPPED | {"indent": 1}
# By the numbers of Excel.
_LETTER, _A4 = 1, 9
# Of a column whose texts wrap, in letters; of long texts, twice that.
_WIDEST, _WIDEST_DATA = 30, 120
# In the header of a sheet of data, beside what package it is of.
NOT_PRINTED = "   Data, not printed: to print, Page Layout, Print Area, Clear Print Area"
# A row of Excel is at most 409 points tall.
_MOST_LINES = 27
# Width of a landscape page, and the least scale on it [%].
_PAGE_PX, _LEAST_SCALE = 970, 60


def text_workbook(buffer: BytesIO, date: dt.date, title: str = "") -> Workbook:
    """Return a workbook to write, in which untrusted text is never a formula or link."""
    # xlsxwriter would make a formula of a name that begins with =, and a link of one that begins
    # with http://.
    as_text = ("strings_to_formulas", "strings_to_urls", "strings_to_numbers")
    # The library refuses NaN and infinity otherwise.
    workbook = Workbook(buffer, dict.fromkeys(as_text, False) | {"nan_inf_to_errors": True})
    # Two runs give the same bytes: the date is that of the project, not the current date.
    workbook.set_properties({"title": title, "created": dt.datetime.combine(date, dt.time())})
    return workbook


class Pages:
    """The formats that all sheets share, and the paper that they are printed on."""

    def __init__(self, workbook: Workbook, head: str, *, is_a4: bool = False):
        self.workbook, self.head_line = workbook, head
        self.paper = _A4 if is_a4 else _LETTER
        self.title = workbook.add_format({"bold": True, "font_size": 14})
        self.head = workbook.add_format(_WRAPPED | {"bold": True, "bottom": 1})
        self.note = workbook.add_format(_WRAPPED | {"italic": True, "font_color": "#555555"})
        self.text = workbook.add_format(_TEXT)
        self.typed_text = workbook.add_format(_TEXT | _INPUT)
        # Among texts: aligned as they are.
        self.lengths = workbook.add_format(_TEXT | {"num_format": "0.0"})
        self.ratios = workbook.add_format(_TEXT | {"num_format": "0.00"})
        self.failed = workbook.add_format({"bold": True, "font_color": "#C00000"})
        self.open = workbook.add_format({"bold": True, "font_color": "#7F6000"})
        self._numbers: dict[tuple[int | None, bool, bool], Format] = {}

    def mark_verdicts(self, sheet: Worksheet, last: int, columns: int) -> None:
        """Format cells up to a row: NG in bold red and conditions in bold, as they change."""
        looks = {Verdict.NG: self.failed}
        looks |= dict.fromkeys((Verdict.CONDITION, Verdict.CONDITIONS), self.open)
        for verdict, look in looks.items():
            rule = {"type": "cell", "criteria": "==", "value": f'"{verdict}"', "format": look}
            sheet.conditional_format(0, 0, last, columns - 1, rule)

    def on_paper(self, sheet: Worksheet, extra: str = "") -> None:
        """Make the pages of a sheet landscape, each with the name of its package."""
        sheet.set_landscape()
        sheet.set_paper(self.paper)
        sheet.set_margins(left=0.4, right=0.4, top=0.75, bottom=0.6)
        sheet.set_header(f"&L{self.head_line}{extra}")
        sheet.set_footer("&L&F, &A&RPage &P of &N")

    def number(self, decimals: int | None, mark: str = "", *, is_input: bool = False) -> Format:
        """Return the format of a number, with its mark, which leaves it a number."""
        key = (decimals, bool(mark), is_input)
        if key not in self._numbers:
            code = "General" if decimals is None else f"{0:.{decimals}f}"
            # In the format, not in the cell: with a mark behind it the number would be a text, and
            # no formula could use it.
            code += f'"{OVERRIDDEN}"' if mark else ""
            look = {"num_format": code, "valign": "top"} | (_INPUT if is_input else {})
            self._numbers[key] = self.workbook.add_format(look)
        return self._numbers[key]

    def sheet(
        self,
        name: str,
        title: str,
        note: str,
        headings: Sequence[str],
        rows: Sequence[Sequence[str]],
        keys: int = 1,
        printed: int | None = None,
    ) -> Worksheet:
        """Return a sheet with its title and headings, laid out for rows of texts as shown.

        The columns that are `printed` come first; None for all.
        """
        sheet: Worksheet = self.workbook.get_worksheet_by_name(name)
        widths = lay_out(self, sheet, TOP - 2, headings, rows, keys, printed)
        # Beside columns that stand on every page, on which it would be truncated.
        start = keys if _is_wide(widths[:printed]) else 0
        end = max(k for k in range(len(widths) + 1) if not _is_wide(widths[:k]))
        sheet.write_string(0, start, title, self.title)
        sheet.merge_range(1, start, 1, end - 1, note, self.note)
        sheet.set_row(1, LINE_PT * lines_of(note, sum(widths[start:end])))
        self.mark_verdicts(sheet, TOP + len(rows), len(widths))
        return sheet


def lay_out(
    pages: Pages,
    sheet: Worksheet,
    top: int,
    headings: Sequence[str],
    rows: Sequence[Sequence[str]],
    keys: int = 1,
    printed: int | None = None,
) -> Sequence[int]:
    """Write headings, fit columns and rows to texts as shown, and make landscape pages legible.

    Return the widths of the columns [letters]. The first `keys` identify a row: they stay in view
    and are repeated on every page. Only the first columns are `printed`; for data, none.
    """
    sheet.write_row(top, 0, headings, pages.head)
    widest = _WIDEST if printed != 0 else _WIDEST_DATA
    widths = [_width(head, cells, widest) for head, *cells in zip(headings, *rows, strict=True)]
    for place, width in enumerate(widths):
        sheet.set_column(place, place, width)
    for number, texts in enumerate((headings, *rows), start=top):
        sheet.set_row(number, LINE_PT * max(map(lines_of, texts, widths)))
    sheet.freeze_panes(top + 1, keys)
    pages.on_paper(sheet, NOT_PRINTED if printed == 0 else "")
    sheet.repeat_rows(top)
    if printed == 0:
        # A sheet has no switch for that: it prints a blank cell beside its data, with its header.
        sheet.print_area(top, len(widths), top, len(widths))
    elif printed is not None:
        sheet.print_area(0, 0, top + len(rows), printed - 1)
    if _is_wide(widths[:printed]):
        sheet.set_print_scale(_LEAST_SCALE)
        sheet.repeat_columns(0, keys - 1)
        sheet.print_across()
    else:
        # One page wide, and as many as it takes.
        sheet.fit_to_pages(1, 0)
    return widths


def _is_wide(widths: Sequence[int]) -> bool:
    """Whether columns are wider than a page at the least scale."""
    # Excel gives a letter 7 pixels, and a column 5 beside its letters.
    return sum(7 * width + 5 for width in widths) * _LEAST_SCALE > 100 * _PAGE_PX


def _width(heading: str, cells: Sequence[str], widest: int) -> int:
    """Return the width of a column, in which no word is broken."""
    longest = max(map(len, cells), default=0)
    words = [len(word) for word in " ".join(cells).split()]
    of_text = min(longest, max(widest, min(longest // 4, 2 * _WIDEST)))
    return max(*(len(word) - 1 for word in heading.split()), *words, of_text) + 2


def lines_of(text: str, width: int) -> int:
    """Return the number of lines of a text, limited to the maximum of a row."""
    return max(1, min(len(wrap(text, width)), _MOST_LINES))
