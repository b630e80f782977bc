"""What a workbook of 0.1 lacks, which is read as it is. Read `what_is_new`."""

from __future__ import annotations

from collections.abc import Iterator

from report.sheet.checking.findings import note
from report.sheet.reading.archive import OpenBook
from report.sheet.reading.locate import is_absent
from report.sheet.reading.locate_tables import find_table
from report.sheet.schema import SECTIONS
from report.sheet.schema.fields import Finding, Place
from report.sheet.writing.live import has_live_formulas

MOVE = "Run roofslip new FOLDER and copy your cells into the new workbook"


def what_is_new(book: OpenBook) -> Iterator[Finding]:
    """Yield one note on a workbook of 0.1: its missing parts, and how to gain them."""
    if has_live_formulas(book):
        return
    absent = [section for section in SECTIONS if is_absent(book, section)]
    titles = {title.casefold() for title in book.book.sheetnames}
    sheets = dict.fromkeys(s.sheet for s in absent if s.sheet.casefold() not in titles)
    columns = sum(
        len(find_table(book, section).absent)
        for section in SECTIONS
        if section.is_table and section not in absent
    )
    text = (
        "this workbook is of version 0.1 and is read as it is. It does not compute while it is"
        f" filled in, and lacks {columns} columns and the sheets {', '.join(sheets)}. {MOVE}"
    )
    yield note(Place(SECTIONS[0].key), text)
