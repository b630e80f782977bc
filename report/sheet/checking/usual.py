"""Warnings on numbers outside the range that the sheet itself prints as usual.

Most of them are a wrong unit. Read `unusual`.
"""

from __future__ import annotations

from collections.abc import Iterator

from report.sheet.checking.findings import warning
from report.sheet.schema import SECTIONS, ProjectInput
from report.sheet.schema.choices import Direction, ObjectKind
from report.sheet.schema.fields import Entry, Finding, Frozen, Place, SheetSection, entries
from report.sheet.schema.friction import FrictionTestRow
from report.sheet.schema.motions import MotionInput
from report.sheet.schema.scene import Array, Clearance, RoofObject

ROUNDING = 1e-9
"""Difference from a limit / limit that is rounding error of a conversion of units."""


def unusual(data: ProjectInput) -> Iterator[Finding]:
    """Yield a warning for each number outside its usual range."""
    is_us = data.us_first
    for section in SECTIONS:
        found = getattr(data, section.key)
        for index, row in enumerate(found if section.is_table else (found,)):
            for entry in entries(section.model):
                value, span = getattr(row, entry.name), entry.expected
                if entry.cell.usual is None or value is None or _is_bare_edge(row, value):
                    continue
                if not span.low * (1.0 - ROUNDING) <= value <= span.high * (1.0 + ROUNDING):
                    yield _warning(section, index, entry, row, is_us)


def _warning(section: SheetSection, index: int, entry: Entry, row: Frozen, is_us: bool) -> Finding:
    unit = entry.unit(is_us=is_us)
    symbol, si = (unit.symbol, unit.si) if unit else (str(entry.cell.unit), 1.0)
    given, span = f"{getattr(row, entry.name) / si:.4g}", entry.expected.words(si)
    text = f"{entry.spoken} is {given} {symbol}".rstrip() + f"; {span} {symbol}".rstrip()
    name = " ".join(f"usual {entry.spoken} {_named(row)}".split())
    place = Place(section.key, index, entry.name)
    return warning(name, place, f"{text} is usual: correct the value or its unit")


def _is_bare_edge(row: Frozen, value: float) -> bool:
    """Whether a value is the height 0 of an edge without parapet."""
    return (
        isinstance(row, RoofObject) and row.kind is ObjectKind.EDGE_WITHOUT_PARAPET and value == 0.0
    )


def _named(row: Frozen) -> str:
    """Return by what a row of a table is known; nothing for single cells."""
    match row:
        case Array() | RoofObject() | MotionInput():
            return row.id
        case Clearance():
            return spoken(row)
        case FrictionTestRow():
            return f"{row.report or ''} {row.surface} {row.number}"
    return ""


def spoken(row: Clearance) -> str:
    """Return a clearance in words."""
    where = "" if row.direction is Direction.ANY else f" {row.direction}"
    return f"{row.array} to {row.object}{where}"
