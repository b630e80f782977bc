"""Rows of the sheets for the projects here, which are written in Python.

Lengths are given in a unit of the caller's choice, with its size in meters. Read
`projects.example.make` for their use.
"""

from __future__ import annotations

import datetime as dt
from collections.abc import Iterable, Mapping
from pathlib import Path

from solver.file_writing import write_whole
from solver.records.record import write_record
from solver.synthesis.suite import SuiteMotion

Row = Mapping[str, object]
Range = tuple[float, float]

ENGINEER, FIRM, LICENSE = "Engineer of record", "Example firm", "S0000"


def issued(
    name: str, number: str, client: str, address: str, units: str, *,
    date: dt.date, revision: str = "0", description: str = "Issued for plan check",
    **more: object,
) -> dict[str, object]:  # fmt: skip
    """Return the sheet Project: its block, and its one revision."""
    return {
        "project": {
            "name": name,
            "number": number,
            "client": client,
            "address": address,
            "prepared_by": ENGINEER,
            "checked_by": "",
            "firm": FIRM,
            "license": LICENSE,
            "date": date,
            "revision": revision,
            "units_first": units,
            **more,
        },
        "revisions": [
            {"revision": revision, "date": date, "description": description, "by": ENGINEER}
        ],
    }


def rectangle(x: Range, y: Range, unit_m: float) -> dict[str, float]:
    """Return the four sides of a rectangle in plan."""
    sides = ("x_from_m", "x_to_m", "y_from_m", "y_to_m")
    return {side: value * unit_m for side, value in zip(sides, (*x, *y), strict=True)}


def roof_object(
    name: str, kind: str, height_m: float | None, x: Range, y: Range, unit_m: float
) -> Row:
    """Return a row of the sheet Objects."""
    return {"id": name, "kind": kind, "height_m": height_m, **rectangle(x, y, unit_m)}


def clearance(array: str, other: str, direction: str, provided_m: float, **more: object) -> Row:
    """Return a row of the sheet Clearances; without a fire pathway, unless its width is given."""
    row = {"array": array, "object": other, "direction": direction, "provided_m": provided_m}
    return {**row, "pathway_m": 0.0, **more}


_COMPONENTS = {"x": "record", "y": "transverse", "z": "vertical"}


def motion(name: str, components: str, source: str, **more: object) -> Row:
    """Return a row of the sheet Motions, of the components among `xyz`, in files by their name."""
    files = {_COMPONENTS[letter]: f"records/{name}-{letter}.csv" for letter in components}
    return {"id": name, **files, "source": source, **more}


def write_motions(
    folder: Path, prefix: str, suite: Iterable[SuiteMotion], components: str = "xyz"
) -> None:
    """Write the records of motions to a folder, by the names that `motion` gives."""
    folder.mkdir(parents=True, exist_ok=True)
    for number, made in enumerate(suite, start=1):
        for letter in components:
            path = folder / f"{prefix}{number}-{letter}.csv"
            write_record(path, getattr(made, letter), hold_s=made.hold_s)


def write_document(path: Path, lines: Iterable[str]) -> None:
    """Write lines of ASCII text as a PDF of one page, in place of a document of others."""
    escaped = (line.translate({ord(c): f"\\{c}" for c in "\\()"}) for line in lines)
    text = "".join(f"({line}) Tj T* " for line in escaped)
    stream = f"BT /F1 10 Tf 54 738 Td 14 TL {text}ET".encode("ascii")
    objects = (
        b"<< /Type /Catalog /Pages 2 0 R >>",
        b"<< /Type /Pages /Kids [3 0 R] /Count 1 >>",
        b"<< /Type /Page /Parent 2 0 R /MediaBox [0 0 612 792] /Contents 4 0 R"
        b" /Resources << /Font << /F1 5 0 R >> >> >>",
        b"<< /Length %d >>\nstream\n%s\nendstream" % (len(stream), stream),
        b"<< /Type /Font /Subtype /Type1 /BaseFont /Courier >>",
    )
    pdf, starts = b"%PDF-1.4\n", []
    for number, content in enumerate(objects, start=1):
        starts.append(len(pdf))
        pdf += b"%d 0 obj\n%s\nendobj\n" % (number, content)
    table = b"".join(b"%010d 00000 n \n" % start for start in starts)
    count = len(objects) + 1
    trailer = b"trailer\n<< /Size %d /Root 1 0 R >>\nstartxref\n%d\n%%%%EOF\n" % (count, len(pdf))
    path.parent.mkdir(parents=True, exist_ok=True)
    write_whole(path, pdf + b"xref\n0 %d\n0000000000 65535 f \n%s%s" % (count, table, trailer))
