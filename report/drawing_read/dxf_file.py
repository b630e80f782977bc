"""The file of a roof drawing: rejected if not a text DXF or too large, otherwise loaded by ezdxf.

Knows no entity (`report.drawing_read.read_dxf`). Read `loaded` first.
"""

from __future__ import annotations

import io
import logging
import re
from collections.abc import Mapping
from pathlib import Path

from ezdxf import recover
from ezdxf.document import Drawing as Document
from ezdxf.filemanagement import dxf_stream_info, read

from solver.errors import InputError
from solver.file_checks import read_file
from solver.suggestions import meant

MB = 1_000_000
MAX_BYTES = 25 * MB
MAX_ENTITIES = 20_000
MAX_VALUES = 1_000_000
MAX_LINE = 10_000

# Units of drawings by $INSUNITS.
UNITS: Mapping[int, str] = {1: "in", 2: "ft", 4: "mm", 5: "cm", 6: "m"}
# Units that drawings state and roofs are not drawn in, and in which such a drawing mostly is.
OTHER_UNITS: Mapping[int, tuple[str, str]] = {
    3: ("miles", "ft"), 7: ("kilometers", "m"), 8: ("microinches", "in"), 9: ("mils", "in"),
    10: ("yards", "ft"), 14: ("decimeters", "m"), 15: ("decameters", "m"),
    16: ("hectometers", "m"), 21: ("US survey feet", "ft"), 22: ("US survey inches", "in"),
    23: ("US survey yards", "ft"), 24: ("US survey miles", "ft"),
}  # fmt: skip

DAMAGED = "not a DXF drawing, or damaged; open it in CAD and save it again"
# What else is given as one, by how it begins, and what would do.
_OTHER_FILES = [(re.compile(begin, re.IGNORECASE), advice) for begin, advice in (
    (rb"AC10", "a DWG drawing; save it as DXF (R12 to R2018)"),
    (rb"AutoCAD Binary DXF", "a binary DXF; save it as DXF in text"),
    (rb"%PDF", "a PDF; use the DXF from which it was plotted"),
    (rb"PK\x03\x04", "a zip; unpack it and use the DXF in it"),
    (rb"\x89PNG|\xff\xd8\xff|II\*\x00|MM\x00\*|GIF8|BM", "a picture; use the drawing as DXF"),
    (rb"ISO-10303-21", "an IFC or STEP model; export its roof plan as DXF"),
    (rb"\xd0\xcf\x11\xe0", "a model of Revit, or an old Office file; export its roof plan as DXF"),
    (rb"(?:<[?!][^>]*>\s*){0,9}<svg", "an SVG; save it as DXF"),
    (rb"<", "XML or a web page; export the roof plan as DXF"),
    (rb"[{\[]", "JSON, such as GeoJSON; export the roof plan as DXF in ft or m"),
)]  # fmt: skip
_ENDED = re.compile(rb"\n[ \t]*0[ \t]*\r?\n[ \t]*EOF\s*\Z")
_ENTITY = re.compile(rb"^[ \t]*0[ \t]*\r?\n[ \t]*[A-Z3_]", re.MULTILINE)


def other_unit(code: int) -> str:
    """Return the message for a unit of `OTHER_UNITS`, by $INSUNITS; empty for others."""
    if code not in OTHER_UNITS:
        return ""
    stated, unit = OTHER_UNITS[code]
    is_same = stated == f"US survey {'feet' if unit == 'ft' else 'inches'}"  # within 2 in a million
    condition = "" if is_same else ", if it is drawn in that unit, or scale it in CAD"
    return f"states {stated}; use --units {unit}{condition}"


def _read(path: Path) -> bytes:
    """Return a drawing; reject a file that is not a text DXF or is too large."""
    if not path.exists():
        raise InputError(f"no such file; {meant(path) or 'use a DXF drawing'}")
    data = read_file(path, MAX_BYTES, too_large="save only the roof plan")
    begin = data[:1000].removeprefix(b"\xef\xbb\xbf").lstrip()
    for pattern, advice in _OTHER_FILES:
        if pattern.match(begin):
            raise InputError(advice)
    # By counting bytes: the library builds all entities before anything can be refused.
    values = data.count(b"\n") // 2  # each after a line with its code
    limit(values, MAX_VALUES, "values")
    limit(sum(1 for _ in _ENTITY.finditer(data)), MAX_ENTITIES, "entities")
    # Names are read once for each entity that has them; formats allow lines of 2,049 letters.
    limit(max(map(len, data.splitlines()), default=0), MAX_LINE, "characters in a line")
    return data


def limit(count: int, allowed: int, noun: str) -> None:
    """Reject a drawing that exceeds a limit."""
    if count > allowed:
        raise InputError(
            f"{count:,} {noun}, more than {allowed:,}; save only the layers of the roof plan"
        )


def loaded(path: Path) -> tuple[Document, str]:
    """Return a drawing, and a note on its repair if strict reading rejects it.

    Raises `InputError` if it is not a DXF, damaged, or too large.
    """
    data = _read(path)
    logging.getLogger("ezdxf").addHandler(logging.NullHandler())
    try:
        info = dxf_stream_info(io.TextIOWrapper(io.BytesIO(data), "utf-8", "ignore"))
        # Letters that the stated code page lacks stay, and are taken out where they are printed:
        # one wrong letter in a note is no reason to refuse a plan.
        text = io.TextIOWrapper(io.BytesIO(data), info.encoding, "surrogateescape")
        return read(text), ""
    except Exception as refused:  # a damaged drawing makes the library raise almost anything
        # What is missing at the end of a drawing that was cut off, no repair would tell.
        if not _ENDED.search(data):
            raise InputError(DAMAGED) from refused
    try:
        # Slower, and lenient: it is asked only after the strict reader.
        document, audit = recover.read(io.BytesIO(data))
    except Exception as error:
        raise InputError(DAMAGED) from error
    if audit.has_errors:  # such as a coordinate that it has guessed
        raise InputError(DAMAGED)
    count = len(audit.fixes)
    fixes = f", {count} faults repaired" if count > 1 else ", a fault repaired" if count else ""
    return document, f"a damaged drawing, read as far as possible{fixes}: compare the plan"
