"""Finds sheets that have the labels of another one, as a sheet copied in Excel has.

One of the two is read, and what is typed into the other has no effect. Read `copies`.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Set

from openpyxl.worksheet.worksheet import Worksheet

from report.sheet.checking.findings import warning
from report.sheet.reading.archive import OpenBook
from report.sheet.reading.positions import fields_by_label, labels
from report.sheet.schema.fields import Finding, Place, SheetSection

Rows = tuple[frozenset[str], ...]
"""Labels in each row of a sheet, in the form that is compared."""


def copies(
    book: OpenBook, sections: Iterable[SheetSection], addresses: Mapping[Place, str]
) -> Iterator[Finding]:
    """Yield a warning for each sheet with all labels of one that is read."""
    rows = {sheet.title: _rows(book, sheet) for sheet in book.book.worksheets}
    told: set[str] = set()
    for section in sections:
        found = (address for place, address in addresses.items() if place.section == section.key)
        read = next(found, "").rpartition("!")[0]
        labels = _labels(section, rows[read]) if read in rows else frozenset()
        for title in rows:
            if labels and title not in (read, *told) and labels <= _labels(section, rows[title]):
                told.add(title)
                text = (
                    f"sheets '{read}' and '{title}' both have the labels of {section.title};"
                    f" '{read}' is read, and '{title}' is ignored: delete the one that is not meant"
                )
                yield warning(f"copy {title}", Place(section.key), text)


def _rows(book: OpenBook, sheet: Worksheet) -> Rows:
    rows: dict[int, set[str]] = {}
    for position, label in labels(book, sheet):
        rows.setdefault(position.row, set()).add(label)
    return tuple(map(frozenset, rows.values()))


def _labels(section: SheetSection, rows: Rows) -> Set[str]:
    """Return the labels of a section on a sheet: of a table, those in one row."""
    fields = fields_by_label(section)
    places = rows if section.is_table else (frozenset().union(*rows),)
    found = ({fields[label].name for label in place & fields.keys()} for place in places)
    return max(found, key=len, default=set())
