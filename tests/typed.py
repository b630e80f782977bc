"""Which input cells of a workbook are filled, and where the first cell of a field is."""

from __future__ import annotations

from pathlib import Path

from openpyxl import Workbook, load_workbook
from openpyxl.utils import range_boundaries

from report.sheet.reading.read import read
from report.sheet.schema import SECTIONS
from report.sheet.schema.fields import Entry, Place, SheetSection, entries


def typed_cells(workbook: Path) -> dict[str, dict[str, str]]:
    """Return the filled input cells that say something else than a blank one, by sheet.

    Each by its address, with section and field: of a workbook before commands fill it, those that
    a person has typed; of one after that, less those, what the commands have.
    """
    sheet, book = read(workbook), load_workbook(workbook)
    found: dict[str, dict[str, str]] = {section.sheet: {} for section in SECTIONS}
    for section in SECTIONS:
        for row, values in enumerate(sheet.draft[section.key]):
            for entry in entries(section.model):
                if values.get(entry.name) not in (None, "", entry.default):
                    address = sheet.where(Place(section.key, row, entry.name))
                    title, _, at = address.rpartition("!")
                    if book[title.strip("'")][at].value is not None:  # a weight may be computed
                        found[section.sheet][address] = f"{section.key}.{entry.name}"
    return found


def address_of(book: Workbook, section: SheetSection, entry: Entry) -> tuple[str, str]:
    """Return sheet and coordinate of a field of a new workbook; of a table, in its first row."""
    if not section.is_table:
        area = book.defined_names[section.cell_name(entry.name)].attr_text
        title, _, place = area.rpartition("!")
        return title.strip("'"), place.replace("$", "")
    sheet = book[section.sheet]
    left, top, right, _ = range_boundaries(sheet.tables[section.table_name].ref)
    heads = (sheet.cell(top, column) for column in range(left, right + 1))
    head = next(h for h in heads if str(h.value).partition(" [")[0] == entry.cell.label)
    return section.sheet, head.offset(row=1).coordinate
