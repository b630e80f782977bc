"""The parts of a workbook: blocks of single cells, and tables."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import partial

from report.project.model.frozen import Frozen
from report.project.workbook.entries import Entry, of_model


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class SheetSection:
    """A part of the workbook: a block of single cells, or a table."""

    key: str  # its field of the whole input, and the prefix of its names in the workbook
    sheet: str
    title: str
    model: type[Frozen]  # of the block, or of one row
    note: str  # one line of instruction
    entries: tuple[Entry, ...]
    is_table: bool
    may_be_absent: bool = False  # as in workbooks of earlier versions
    needs_rows: bool = False

    @property
    def is_needed(self) -> bool:
        """Whether every project fills it: a table with rows, or a block with required cells."""
        is_required = any(entry.is_required for entry in self.entries)
        return self.needs_rows if self.is_table else is_required

    def sheet_of(self, field: str) -> str:
        """Return the sheet of a field."""
        return self.entry(field).sheet or self.sheet

    @property
    def table_name(self) -> str:
        """Name of its Excel table."""
        return f"{self.key}_table"

    def entry(self, field: str) -> Entry:
        """Return one of its fields."""
        return next(entry for entry in self.entries if entry.name == field)

    def cell_name(self, field: str) -> str:
        """Return the defined name of a single cell."""
        return f"{self.key}_{field}"

    def unit_name(self, field: str) -> str:
        """Return the defined name of the cell that holds a single cell's unit."""
        return f"{self.cell_name(field)}_unit"


def section(
    key: str,
    sheet: str,
    title: str,
    model: type[Frozen],
    note: str,
    *entries: Entry,
    **traits: bool,
) -> SheetSection:
    """Return a part of the workbook, its entries with what the model says of their fields."""
    return SheetSection(
        key=key,
        sheet=sheet,
        title=title,
        model=model,
        note=note,
        entries=tuple(of_model(entry, model) for entry in entries),
        **traits,
    )


block, table = partial(section, is_table=False), partial(section, is_table=True)


def rows_of(
    section: SheetSection, sections: Sequence[SheetSection]
) -> list[tuple[SheetSection, Entry]]:
    """Return the inputs in the order of a block's rows, with the section that each is of."""
    rows = []
    for entry in section.entries:
        if entry.below:
            continue
        rows.append((section, entry))
        place = (section.key, entry.name)
        for other in sections:
            rows += [(other, below) for below in other.entries if below.below == place]
    return rows
