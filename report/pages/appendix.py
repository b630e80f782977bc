"""Input echo naming each cell, record hashes, software."""

from __future__ import annotations

import platform
import textwrap
from collections.abc import Iterator, Mapping, Sequence
from importlib import metadata
from itertools import groupby

from report.pages.parts import shortened
from report.sheet.records import RecordFile
from report.sheet.workbook import EchoRow
from report.units import number

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
METHOD = "exact, event by event, on straight lines between samples"
_WIDTHS = (7, 27, 34, 8, 40)
_RECORD_WIDTHS = (10, 12, 9, 10, 10, 64)
_HEADS = ("Cell", "Asked for", "Typed", "Unit", "Taken as")


def echo(rows: Sequence[EchoRow]) -> tuple[tuple[str, str], ...]:
    """Return each sheet's name and its cells as lines of even columns."""
    return tuple(
        (sheet, "\n".join(_lines(tuple(found))))
        for sheet, found in groupby(rows, key=lambda row: row.sheet)
    )


def _lines(rows: Sequence[EchoRow]) -> Iterator[str]:
    yield _even(_HEADS, _WIDTHS)
    for row in rows:
        asked = (row.cell, row.label, row.typed, row.unit, row.value)
        wrapped = [
            textwrap.wrap(str(text), width - 1) or [""]
            for text, width in zip(asked, _WIDTHS, strict=True)
        ]
        for index in range(max(map(len, wrapped))):
            texts = [part[index] if index < len(part) else "" for part in wrapped]
            yield _even(texts, _WIDTHS)


def _even(texts: Sequence[str], widths: Sequence[int]) -> str:
    return "".join(text.ljust(width) for text, width in zip(texts, widths, strict=True)).rstrip()


def records(rows: Sequence[RecordFile]) -> str:
    """Return the record files with their hashes as lines of even columns."""
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
        lines += [_even(texts, _RECORD_WIDTHS), " " * sum(_RECORD_WIDTHS[:-1]) + row.sha256]
    return "\n".join(lines)


def software() -> Mapping[str, str]:
    """Return what made this, with versions."""
    return {
        "roofslip": metadata.version("roofslip"),
        "python": platform.python_version(),
    } | {name: metadata.version(name) for name in LIBRARIES}
