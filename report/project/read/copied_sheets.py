"""Sheets that are copies of one that is read."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Set

from openpyxl.worksheet.worksheet import Worksheet

from report.project.model.finding import Finding, warning
from report.project.model.place import Place
from report.project.read.archive import OpenBook
from report.project.read.positions import fields_by_label, labels
from report.project.workbook.sections import SheetSection

# Labels in each row of a sheet, in the form that is compared.
Rows = tuple[frozenset[str], ...]


def copies(
    book: OpenBook, sections: Iterable[SheetSection], addresses: Mapping[Place, str]
) -> Iterator[Finding]:
    """Yield a warning for each sheet with all labels of one that is read."""
    rows = {sheet.title: _rows(book, sheet) for sheet in book.book.worksheets}
    warned: set[str] = set()
    for section in sections:
        addresses_of = (
            address for place, address in addresses.items() if place.section == section.key
        )
        read = next(addresses_of, "").rpartition("!")[0]
        labels = _labels(section, rows[read]) if read in rows else frozenset()
        for title in rows:
            if labels and title not in (read, *warned) and labels <= _labels(section, rows[title]):
                warned.add(title)
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
    labels = ({fields[label].name for label in place & fields.keys()} for place in places)
    return max(labels, key=len, default=set())
