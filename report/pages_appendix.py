"""Input echo naming each cell, record hashes, software."""

from __future__ import annotations

import platform
import textwrap
from collections.abc import Iterator, Mapping, Sequence
from importlib import metadata
from itertools import groupby

from report.motionfiles import RecordFile
from report.pages_parts import Column, Row, Table
from report.units import number
from report.workbook import EchoRow

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
_WIDTHS = (8, 24, 24, 10, 26)
_HEADS = ("Cell", "Asked for", "Typed", "Unit", "Taken as")


def echo(rows: Sequence[EchoRow]) -> tuple[tuple[str, str], ...]:
    """Return each sheet's name and its cells as lines of even columns."""
    return tuple(
        (sheet, "\n".join(_lines(tuple(found))))
        for sheet, found in groupby(rows, key=lambda row: row.sheet)
    )


def _lines(rows: Sequence[EchoRow]) -> Iterator[str]:
    yield _line(_HEADS)
    for row in rows:
        texts = (row.cell, row.label, row.typed, row.unit, row.value)
        wrapped = [
            textwrap.wrap(str(text), width - 1) or [""]
            for text, width in zip(texts, _WIDTHS, strict=True)
        ]
        for index in range(max(map(len, wrapped))):
            yield _line([part[index] if index < len(part) else "" for part in wrapped])


def _line(texts: Sequence[str]) -> str:
    return "".join(text.ljust(width) for text, width in zip(texts, _WIDTHS, strict=True)).rstrip()


def records(rows: Sequence[RecordFile]) -> Table:
    """Return the record files with their hashes."""
    return Table(
        caption="Records as read",
        columns=(
            Column(head="Motion", align="left", share=0.7),
            Column(head="Component", align="left", share=0.9),
            Column(head="File", align="left", share=1.5),
            Column(head="Samples", share=0.8),
            Column(head="Step", unit="s", share=0.6),
            Column(head="Peak", unit="g", share=0.7),
            Column(head="SHA-256", align="left", share=3.2),
        ),
        rows=tuple(
            Row(
                cells=(
                    row.motion_id,
                    row.component,
                    row.name,
                    str(row.npts),
                    f"{row.dt_s:g}",
                    number(row.peak_g, 4),
                    row.sha256,
                )
            )
            for row in rows
        ),
        kind="compact hashes",
    )


def software() -> Mapping[str, str]:
    """Return what made this, with versions."""
    return {
        "roofslip": metadata.version("roofslip"),
        "python": platform.python_version(),
    } | {name: metadata.version(name) for name in LIBRARIES}
