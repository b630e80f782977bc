"""Which input cells of a workbook are filled."""

from __future__ import annotations

from pathlib import Path

from openpyxl import load_workbook

from report.project.model.place import Place
from report.project.read.read import read
from report.project.workbook import SECTIONS


def typed_cells(workbook: Path) -> dict[str, dict[str, str]]:
    """Return the filled input cells that say something else than a blank one, by sheet.

    Each by its address, with section and field: of a workbook before commands fill it, those that
    a person has typed; of one after that, less those, what the commands have.
    """
    sheet, book = read(workbook), load_workbook(workbook)
    found: dict[str, dict[str, str]] = {section.sheet: {} for section in SECTIONS}
    for section in SECTIONS:
        for row, values in enumerate(sheet.inputs[section.key]):
            for entry in section.entries:
                if values.get(entry.name) not in (None, "", entry.default):
                    address = sheet.where(Place(section.key, row, entry.name))
                    title, _, at = address.rpartition("!")
                    if book[title.strip("'")][at].value is not None:  # a weight may be computed
                        found[section.sheet][address] = f"{section.key}.{entry.name}"
    return found
