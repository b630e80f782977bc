"""Input echo with cell addresses, record hashes, software versions."""

from __future__ import annotations

import platform
import textwrap
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence, Set
from importlib import metadata
from itertools import groupby, zip_longest
from string import ascii_uppercase, digits

from markupsafe import Markup

from report.motions.components import RecordFile
from report.pages.parts import BAR, PackageData, Table, TableColumn, TableRow, shortened
from report.sheet.read import IGNORED, EchoRow
from report.words.units import number

LIBRARIES = (
    "numpy",
    "numba",
    "pandas",
    "openpyxl",
    "pydantic",
    "matplotlib",
    "ziamath",
    "jinja2",
    "weasyprint",
)
METHOD = "exact in one axis, to a tolerance in two; linear acceleration between samples"
_RECORD_WIDTHS = (10, 12, 9, 10, 10, 64)
_SECOND_WIDTHS = (10, sum(_RECORD_WIDTHS[1:-1]), 64)
MOST_COLUMNS = 4
"""Rows of a table of the workbook that stand side by side."""


def echo_page(package: PackageData) -> Mapping[str, object]:
    """Return the input echo."""
    sheet = package.assessment.sheet
    sheets = echo(sheet.echo, package.changes.cells)
    return {"workbook": sheet.path.name, "sha256": sheet.sha256, "sheets": sheets}


def records_page(package: PackageData) -> Mapping[str, object]:
    """Return the records and the software versions."""
    files = records(package.assessment.shaking.records)
    return {"files": files, "method": METHOD, "software": software()}


def echo(
    rows: Sequence[EchoRow], changed: Set[str] = frozenset()
) -> tuple[tuple[str, tuple[Table, ...]], ...]:
    """Return the name of each sheet, and its cells as tables: entered values once.

    Single cells stand in two columns of the page. A table of the workbook stands with one column
    for each of its rows. Cells left blank share a note with the defaults that they stand for.
    Cells at the addresses that changed are bold, and their rows have a bar in the margin.
    """
    return tuple(
        (sheet, tuple(_tables(tuple(group), changed)))
        for sheet, group in groupby(rows, key=lambda row: row.sheet)
    )


def _is_changed(row: EchoRow | None, changed: Set[str]) -> bool:
    return row is not None and f"{row.sheet}!{row.cell}" in changed


def _is_in_note(row: EchoRow, changed: Set[str]) -> bool:
    return _is_blank(row) and not _is_changed(row, changed)


def _bar(cells: Iterable[EchoRow | None], changed: Set[str]) -> str:
    return BAR if any(_is_changed(row, changed) for row in cells) else ""


def _tables(rows: Sequence[EchoRow], changed: Set[str]) -> Iterator[Table]:
    in_row = Counter(_row_number(row) for row in rows)
    for is_table, group in groupby(rows, key=lambda row: in_row[_row_number(row)] > 1):
        cells = tuple(group)
        yield from _parts_of_table(cells, changed) if is_table else (_single_cells(cells, changed),)


def _single_cells(rows: Sequence[EchoRow], changed: Set[str]) -> Table:
    given = [row for row in rows if not _is_in_note(row, changed)]
    half = (len(given) + 1) // 2
    pairs = zip_longest(given[:half], given[half:])
    return Table(
        caption="",
        columns=(*_SINGLE_COLUMNS, *_SINGLE_COLUMNS),
        rows=tuple(
            TableRow(
                cells=(*_single(left, changed), *_single(right, changed)),
                kind=_bar((left, right), changed),
            )
            for left, right in pairs
        ),
        notes=tuple(_blanks([row for row in rows if _is_in_note(row, changed)])),
        kind="compact",
    )


_SINGLE_COLUMNS = (
    TableColumn(head="Cell", align="left", share=0.6),
    TableColumn(head="Field", align="left", share=2.2),
    TableColumn(head="Entered", align="left", share=2.6),
)


def _single(row: EchoRow | None, changed: Set[str]) -> tuple[str, str, str]:
    return ("", "", "") if row is None else (row.cell, row.label, _entered(row, row.unit, changed))


def _parts_of_table(rows: Sequence[EchoRow], changed: Set[str]) -> Iterator[Table]:
    """Yield a table of the workbook, a few of its rows at a time, with a line for each column."""
    by_number = [tuple(cells) for _, cells in groupby(rows, key=_row_number)]
    for start in range(0, len(by_number), MOST_COLUMNS):
        yield _columns_of_rows(by_number[start : start + MOST_COLUMNS], changed)


def _columns_of_rows(parts: Sequence[Sequence[EchoRow]], changed: Set[str]) -> Table:
    numbers = [_row_number(cells[0]) for cells in parts]
    lines: dict[str, dict[str, EchoRow]] = {}
    for cells in parts:
        for row in cells:
            lines.setdefault(_column_letters(row), {})[_row_number(row)] = row
    given = {
        letters: line
        for letters, line in lines.items()
        if not all(_is_in_note(row, changed) for row in line.values())
    }
    blank = [next(iter(line.values())) for key, line in lines.items() if key not in given]
    return Table(
        caption="",
        columns=(
            TableColumn(head="Column", align="left", share=0.7),
            TableColumn(head="Field", align="left", share=2.2),
            TableColumn(head="Unit", align="left", share=0.6),
            *(TableColumn(head=f"Row {number}", align="left", share=1.6) for number in numbers),
        ),
        rows=tuple(
            TableRow(
                cells=(
                    letters,
                    next(iter(line.values())).label,
                    next(iter(line.values())).unit,
                    *(_entered(line[n], "", changed) if n in line else "" for n in numbers),
                ),
                kind=_bar(line.values(), changed),
            )
            for letters, line in given.items()
        ),
        notes=tuple(_blanks(blank, whole_column=True)),
        kind="compact",
    )


def _entered(row: EchoRow, unit: str, changed: Set[str]) -> str:
    """Return what was entered, bold where it changed."""
    text = _as_entered(row, unit)
    return Markup("<b>{}</b>").format(text or "—") if _is_changed(row, changed) else text


def _as_entered(row: EchoRow, unit: str) -> str:
    """Return what was entered; for a formula its result, for a blank cell its default."""
    if _is_blank(row):
        return "" if row.value == "—" else row.value
    text = f"{row.typed} {unit}".rstrip()
    is_plain = not row.typed.startswith("=") and row.value != IGNORED
    return text if is_plain else f"{text}: {row.value}"


def _blanks(rows: Sequence[EchoRow], *, whole_column: bool = False) -> Iterator[str]:
    """Yield what is left blank in one line, with the defaults."""
    if rows:
        names = (
            f"{_column_letters(row) if whole_column else row.cell} {row.label}{_default(row)}"
            for row in rows
        )
        yield f"Left blank: {'; '.join(names)}."


def _default(row: EchoRow) -> str:
    return "" if row.value == "—" else f" = {row.value.removesuffix(' (default)')}"


def _is_blank(row: EchoRow) -> bool:
    return not row.typed and (row.value == "—" or row.value.endswith("(default)"))


def _row_number(row: EchoRow) -> str:
    return row.cell.lstrip(ascii_uppercase)


def _column_letters(row: EchoRow) -> str:
    return row.cell.rstrip(digits)


def _even(texts: Sequence[str], widths: Sequence[int]) -> str:
    return "".join(text.ljust(width) for text, width in zip(texts, widths, strict=True)).rstrip()


def records(rows: Sequence[RecordFile]) -> str:
    """Return the record files with their hashes as lines of aligned columns."""
    heads = ("Motion", "Component", "Samples", "Step [s]", "Peak [g]", "File, SHA-256")
    lines = [_even(heads, _RECORD_WIDTHS)]
    for row in rows:
        texts = (
            shortened(row.motion_id, _RECORD_WIDTHS[0] - 1),
            row.component,
            str(row.npts),
            f"{row.dt_s:g}",
            number(row.peak_g, 4),
            row.name,
        )
        lines.append(_even(texts, _RECORD_WIDTHS))
        lines.append(_even(("", row.format, row.sha256), _SECOND_WIDTHS))
        lines += [f"{'':10}note: {part}" for part in _notes(row)]
    return "\n".join(lines)


def _notes(row: RecordFile) -> Iterator[str]:
    for note in row.notes:
        yield from textwrap.wrap(note, 104)


def software() -> Mapping[str, str]:
    """Return the software with its versions."""
    return {
        "roofslip": metadata.version("roofslip"),
        "python": platform.python_version(),
    } | {name: metadata.version(name) for name in LIBRARIES}
