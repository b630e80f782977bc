"""Cells of a workbook by what is printed on it: `Arrays/A1/Slope`, `Objects/2/Kind`, `Site/S_DS`.

A name has the sheet, the row and the heading. The row is the text of its first cell, its number in
the table, or `heading`. Without a heading it is the value beside a label; `Site/S_DS/Unit` is its
unit. Units and stars may be left out. Only openpyxl reads the workbook.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping
from functools import cache
from io import BytesIO
from pathlib import Path

from openpyxl import Workbook, load_workbook
from openpyxl.cell import Cell
from openpyxl.utils import range_boundaries
from openpyxl.worksheet.worksheet import Worksheet

Source = Workbook | Path | bytes

_NAMED = re.compile(r"<([A-Z][^<>/]*/[^<>]*)>")
_SLASH = re.compile(r"(?<! )/(?! )")


def cell(book: Workbook, name: str) -> Cell:
    """Return the cell of that name."""
    title, row, *heading = _SLASH.split(name, 2)
    if title not in book.sheetnames:
        raise _unknown(name, "sheet", book.sheetnames)
    sheet = book[title]
    tops = {range_boundaries(table.ref)[1] for table in sheet.tables.values()}
    lines = (line for line in sheet.iter_rows() if line[0].row not in tops)
    labels = _by_text(next(filter(_text, line), line[0]) for line in lines)
    if not heading:
        if row not in labels:
            raise _unknown(name, "label", labels)
        return labels[row].offset(column=1)
    found: dict[str, Cell] = {}
    for heads, rows in (*_tables(sheet), *_heads(sheet, row, labels)):
        found |= heads
        if heading[0] in heads:
            head = heads[heading[0]]
            if row.isdecimal() or row == "heading":
                return head.offset(row=int(row.replace("heading", "0")))
            if row not in rows:
                raise _unknown(name, "row", rows)
            return sheet.cell(rows[row].row, head.column)
    raise _unknown(name, "heading", found)


def address(book: Source, name: str) -> str:
    """Return the address of a cell, as `Arrays!C8`; `Arrays/A1/x from:x to` gives `Arrays!K8:L8`.

    What is no name is returned as it is.
    """
    if "/" not in name:
        return name
    if isinstance(book, Workbook):
        return _address(book, name)
    return _of_content(book if isinstance(book, bytes) else book.read_bytes(), name)


def addressed(book: Source, text: str) -> str:
    """Return a text with the addresses of the cells that it names as `<Arrays/A1/Slope>`."""
    return _NAMED.sub(lambda found: address(book, found[1]), text)


@cache
def _of_content(content: bytes, name: str) -> str:
    return _address(_opened(content), name)


@cache
def _opened(content: bytes) -> Workbook:
    return load_workbook(BytesIO(content))


def _address(book: Workbook, name: str) -> str:
    row, slash, headings = name.rpartition("/")
    found = [cell(book, row + slash + heading) for heading in re.split(r":(?! )", headings)]
    return f"{found[0].parent.title}!{':'.join(at.coordinate for at in found)}"


def _tables(sheet: Worksheet) -> Iterator[tuple[dict[str, Cell], dict[str, Cell]]]:
    """Yield the headings and the rows of each table by text."""
    for table in sheet.tables.values():
        left, top, right, bottom = range_boundaries(table.ref)
        (heads,) = sheet.iter_rows(top, top, left, right)
        first = left + (_text(heads[0]) == "Status")
        rows = sheet.iter_rows(top + 1, bottom, first, first)
        yield _by_text(heads), _by_text(named for (named,) in rows)


def _heads(
    sheet: Worksheet, row: str, labels: dict[str, Cell]
) -> Iterator[tuple[dict[str, Cell], dict[str, Cell]]]:
    """Yield the rows of headings where no table says which: those above a label, the nearest first.

    For the number of a row, the longest first.
    """
    last = labels[row].row - 1 if row in labels else sheet.max_row
    lines = list(sheet.iter_rows(1, last))[::-1]
    if row not in labels:
        lines.sort(key=lambda line: -sum(map(bool, map(_text, line))))
    for line in lines:
        yield _by_text(line), labels


def _text(at: Cell) -> str:
    return " ".join(at.value.split()).removesuffix(" *") if isinstance(at.value, str) else ""


def _by_text(cells: Iterable[Cell]) -> dict[str, Cell]:
    """Return cells by their texts, and by these without their units; not those of equal texts."""
    named = [(text, at) for at in cells for text in {_text(at), _text(at).partition(" [")[0]}]
    count = Counter(text for text, _ in named)
    return {text: at for text, at in named if text and count[text] == 1}


def _unknown(name: str, what: str, known: Iterable[str] | Mapping[str, object]) -> LookupError:
    return LookupError(f"no such {what}: {name}; there are {', '.join(known)}")
