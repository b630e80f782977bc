"""What suite.json says of the records beside it, and motions of which a workbook says otherwise.

Read `other_sources`.
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path

from pydantic_core import from_json

from report.results.publish import content
from report.sheet.checking.findings import limit, lines
from report.sheet.checking.motion_checks import GENERATED
from report.sheet.reading.read import Sheet, read
from report.sheet.schema.fields import Finding, Place
from report.sheet.writing.filled import BEFORE
from solver.model import InputError

_STATED = re.compile(r"\b(seed|S_DS|z/h)\W+(\d+(?:\.\d+)?)")


def other_sources(sheet: Sheet) -> Iterator[Finding]:
    """Yield a warning for each motion whose source is not that of the suite beside its records.

    A package does not have suite.json inside, and so not the warning.
    """
    for index, row in enumerate(sheet.draft["motions"]):
        source = row.get("source") or ""
        said = _source(sheet.path.parent / str(row.get("record") or "").replace("\\", "/"))
        if said and _differs(source, said):
            text = f"source is '{source}', and suite.json beside the records says '{said}'"
            renew = "renew it by motion suite with --into, or correct it"
            yield limit(f"{text}; {renew}", Place("motions", index, "source"))


def said_near(folder: Path) -> Iterator[str]:
    """Yield in words the sources of `other_sources` in the workbooks of a folder and above it."""
    whole = folder.resolve()
    for path in sorted(book for up in (whole, *whole.parents[:2]) for book in up.glob("*.xlsx")):
        with suppress(InputError):
            sheet = read(path)
            found = () if path.name.endswith(BEFORE) else other_sources(sheet)
            for line in lines(found, sheet.addresses):
                yield f"{path}: {line.cells}: {line.finding.text}"


def _source(record: Path) -> str:
    """Return what the suite beside a record is the source of it by; empty if it is of none."""
    try:
        suite = from_json(content(record.with_name("suite.json")))
        names = {part["file"] for motion in suite["motions"] for part in motion["components"]}
        return str(suite["source"]) if record.name in names else ""
    except (ValueError, KeyError, TypeError):
        return ""


def _differs(source: str, said: str) -> bool:
    """Whether a source is a former one, or states another number."""
    typed, made = dict(_STATED.findall(source)), dict(_STATED.findall(said))
    return (source.startswith(GENERATED) and source != said) or any(
        not math.isclose(float(typed[name]), float(made[name]), rel_tol=0.005)
        for name in typed.keys() & made
    )
