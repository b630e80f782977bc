"""Input echo with cell addresses, record hashes, software versions."""

from __future__ import annotations

import platform
import textwrap
from collections.abc import Iterator, Mapping, Sequence
from importlib import metadata
from itertools import groupby

from report.motions.components import RecordFile
from report.pages.parts import PackageData, shortened
from report.sheet.read import EchoRow
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
_WIDTHS = (11, 27, 33, 7, 38)
_GAP = 2  # minimum number of blanks between columns
_RECORD_WIDTHS = (10, 12, 9, 10, 10, 64)
_SECOND_WIDTHS = (10, sum(_RECORD_WIDTHS[1:-1]), 64)
LEAST_BLANK = 3
"""Number of adjacent blank cells from which they share a line of the echo."""

_HEADS = ("Cell", "Field", "Entered", "Unit", "Used as")


def echo_page(package: PackageData) -> Mapping[str, object]:
    """Return the input echo."""
    sheet = package.assessment.sheet
    return {"workbook": sheet.path.name, "sha256": sheet.sha256, "sheets": echo(sheet.echo)}


def records_page(package: PackageData) -> Mapping[str, object]:
    """Return the records and the software versions."""
    files = records(package.assessment.shaking.records)
    return {"files": files, "method": METHOD, "software": software()}


def echo(rows: Sequence[EchoRow]) -> tuple[tuple[str, str], ...]:
    """Return the name of each sheet and its cells as lines of aligned columns."""
    return tuple(
        (sheet, "\n".join(_lines(tuple(group))))
        for sheet, group in groupby(rows, key=lambda row: row.sheet)
    )


def _lines(rows: Sequence[EchoRow]) -> Iterator[str]:
    yield _even(_HEADS, _WIDTHS)
    for row in _condensed(rows):
        cells = (row.cell, row.label, row.typed, row.unit, row.value)
        wrapped = [
            textwrap.wrap(str(text), width - _GAP) or [""]
            for text, width in zip(cells, _WIDTHS, strict=True)
        ]
        for index in range(max(map(len, wrapped))):
            texts = [part[index] if index < len(part) else "" for part in wrapped]
            yield _even(texts, _WIDTHS)


def _condensed(rows: Sequence[EchoRow]) -> Iterator[EchoRow]:
    """Yield the rows, adjacent blank cells merged into one."""
    blank: list[EchoRow] = []
    for row in rows:
        if blank and not (_is_blank(row) and _beside(blank[-1], row)):
            yield from _joined(blank)
            blank = []
        if _is_blank(row):
            blank.append(row)
        else:
            yield row
    yield from _joined(blank)


def _is_blank(row: EchoRow) -> bool:
    return not row.typed and (row.value == "—" or row.value.endswith("(default)"))


def _beside(row: EchoRow, other: EchoRow) -> bool:
    """Whether two cells share a row or a column."""
    return any(a == b for a, b in zip(_split(row.cell), _split(other.cell), strict=True))


def _split(cell: str) -> tuple[str, str]:
    letters = cell.rstrip("0123456789")
    return letters, cell[len(letters) :]


def _joined(rows: Sequence[EchoRow]) -> Sequence[EchoRow]:
    if len(rows) < LEAST_BLANK:
        return rows
    taken = (
        f"{row.label}: {row.value.removesuffix(' (default)')}" for row in rows if row.value != "—"
    )
    first, last = rows[0], rows[-1]
    whole = EchoRow(
        sheet=first.sheet,
        cell=f"{first.cell}:{last.cell}",
        label=f"{first.label} to {last.label}",
        typed=f"{len(rows)} cells left blank",
        unit="",
        value="; ".join(taken) or "—",
    )
    return [whole]


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
