"""Input echo with cell addresses."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence, Set
from dataclasses import replace
from itertools import groupby, zip_longest
from string import ascii_uppercase, digits

from markupsafe import Markup

from report.document.columns import words
from report.document.tables import Column, Table, listed
from report.pages.parts import BAR, PackageData
from report.project.read.workbook_data import IGNORED, EchoRow
from report.text.units import with_unit

# Width of a table of the workbook, in letters: wide enough that a column holds its numbers.
WIDEST = 112.0

# Width of a column at most, in letters: a longer entry has several lines.
MOST_LETTERS = 24


def page(package: PackageData) -> Mapping[str, object]:
    """Return the workbook, and its sheets as tables."""
    source = package.assessment.source
    return {
        "workbook": source.path.name,
        "sha256": source.sha256,
        "sheets": echo(source.echo, package.changes.cells),
    }


_Echoed = tuple[Table, Sequence[str], Sequence[str]]
"""A table, what all of its rows have alike, and what is left blank."""


def echo(
    rows: Sequence[EchoRow], changed: Set[str] = frozenset()
) -> tuple[tuple[str, tuple[_Echoed, ...]], ...]:
    """Return the name of each sheet, and its cells as tables: entered values once.

    A table of the workbook stands as it is there; a column with one entry in all rows is in a note.
    Cells left blank share a note with the defaults that they stand for. Cells at the addresses that
    changed are bold, and their rows have a bar in the margin.
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


def _tables(rows: Sequence[EchoRow], changed: Set[str]) -> Iterator[_Echoed]:
    # A row of a table has several cells, a single field one: no sheet says which it is.
    in_row = Counter(_row_number(row) for row in rows)
    for is_table, group in groupby(rows, key=lambda row: in_row[_row_number(row)] > 1):
        cells = tuple(group)
        yield from _parts_of_table(cells, changed) if is_table else (_single_cells(cells, changed),)


def _single_cells(rows: Sequence[EchoRow], changed: Set[str]) -> _Echoed:
    filled = [row for row in rows if not _is_in_note(row, changed)]
    # In two columns of the page, read down and not across, as on the sheet.
    half = (len(filled) + 1) // 2
    pairs = zip_longest(filled[:half], filled[half:])
    columns = (*_single(0, changed), *_single(1, changed))
    table = listed(pairs, columns, kind="compact", style=lambda pair: _bar(pair, changed))
    return table, (), [_blank(row, row.cell) for row in rows if _is_in_note(row, changed)]


def _single(side: int, changed: Set[str]) -> Sequence[Column]:
    """Return the columns of one side of the pairs, of which the last may have no right one."""

    def entered(pair: Sequence[EchoRow | None]) -> str:
        row = pair[side]
        return _entered(row, row.unit, changed) if row else ""

    return (
        (words("Cell", 0.6), lambda pair: getattr(pair[side], "cell", "")),
        (words("Field", 2.2), lambda pair: getattr(pair[side], "label", "")),
        (words("Entered", 2.6), entered),
    )


def _parts_of_table(rows: Sequence[EchoRow], changed: Set[str]) -> Iterator[_Echoed]:
    """Yield a table of the workbook, a few of its columns at a time, as it stands there."""
    lines = {
        number: {_column_letters(row): row for row in cells}
        for number, cells in groupby(rows, key=_row_number)
    }
    letters = list(dict.fromkeys(_column_letters(row) for row in rows))
    columns = {name: [line[name] for line in lines.values() if name in line] for name in letters}
    blank = [cells[0] for cells in columns.values() if all(_is_in_note(r, changed) for r in cells)]
    filled = [cells for cells in columns.values() if cells[0] not in blank]
    equal = [cells[0] for cells in filled if _is_equal(cells, len(lines), changed)]
    printed = [cells for cells in filled if cells[0] not in equal]
    alike = [f"{_column_letters(row)} {row.label} {_as_entered(row, row.unit)}" for row in equal]
    # The notes stand below the last part. Where all columns are in them, one stands for the rows.
    *chunks, last = list(_chunks(printed)) or [[filled[0]]]
    for chunk in chunks:
        yield _columns(lines, chunk, changed), (), ()
    left_blank = [_blank(row, _column_letters(row)) for row in blank]
    yield _columns(lines, last, changed), alike, left_blank


def _is_equal(cells: Sequence[EchoRow], rows: int, changed: Set[str]) -> bool:
    """Whether several rows have one entry in a column, so that it is printed once."""
    entered = {_as_entered(row, row.unit) for row in cells}
    return (
        # A blank cell among them is not alike; of one row nothing is.
        1 < rows == len(cells)
        and len(entered) == 1
        and not any(_is_changed(row, changed) for row in cells)
    )


def _chunks(columns: Sequence[Sequence[EchoRow]]) -> Iterator[Sequence[Sequence[EchoRow]]]:
    """Yield columns that fit side by side, the first one repeated."""
    chunk: list[Sequence[EchoRow]] = []
    for cells in columns:
        # The id, which is first, is repeated: a row must be found in each part.
        if sum(map(_width, [*chunk, cells])) > WIDEST:
            yield chunk
            chunk = [columns[0]]
        chunk.append(cells)
    if chunk:
        yield chunk


def _width(cells: Sequence[EchoRow]) -> float:
    """Return the width of a column in letters: of its entries, and of the words above."""
    entries = max(min(len(_as_entered(row, "")), MOST_LETTERS) for row in cells)
    # Headings break between words, so the longest word counts; 3 letters are the padding.
    return 3.0 + max(entries, *map(len, (*cells[0].label.split(), cells[0].unit)))


def _columns(
    lines: Mapping[str, Mapping[str, EchoRow]],
    chunk: Sequence[Sequence[EchoRow]],
    changed: Set[str],
) -> Table:
    heads = {_column_letters(cells[0]): cells for cells in chunk}
    columns = (
        (words("Row", 5.0), lambda line: _row_number(next(iter(line.values())))),
        *(
            (
                replace(words(f"{name} {cells[0].label}", _width(cells)), unit=cells[0].unit),
                lambda line, name=name: _entered(line[name], "", changed) if name in line else "",
            )
            for name, cells in heads.items()
        ),
    )

    def style(line: Mapping[str, EchoRow]) -> str:
        return _bar(map(line.get, heads), changed)

    return listed(lines.values(), columns, kind="compact", style=style)


def _entered(row: EchoRow, unit: str, changed: Set[str]) -> str:
    """Return the entered value, bold if it changed."""
    text = _as_entered(row, unit)
    return Markup("<b>{}</b>").format(text or "—") if _is_changed(row, changed) else text


def _as_entered(row: EchoRow, unit: str) -> str:
    """Return the entered value; for a blank cell its default."""
    if _is_blank(row):
        return "" if row.value == "—" else row.value
    text = with_unit(row.typed, unit)
    # A formula, and what nothing reads, print with what became of them.
    if row.typed.startswith("=") or row.value == IGNORED:
        text = f"{text}: {row.value}"
    return f"{text} ({row.unseen})" if row.unseen else text


def _blank(row: EchoRow, place: str) -> str:
    """Return the blank cells, with their defaults."""
    default = "" if row.value == "—" else f" = {row.value.removesuffix(' (default)')}"
    return f"{place} {row.label}{default}"


def _is_blank(row: EchoRow) -> bool:
    return not row.typed and (row.value == "—" or row.value.endswith("(default)"))


def _row_number(row: EchoRow) -> str:
    return row.cell.lstrip(ascii_uppercase)


def _column_letters(row: EchoRow) -> str:
    return row.cell.rstrip(digits)
