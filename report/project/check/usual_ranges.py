"""Numbers outside their usual range."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import cache

from report.project.model import ProjectInput
from report.project.model.array import Array
from report.project.model.choices import Direction, ObjectKind
from report.project.model.finding import Finding, warning
from report.project.model.friction_report import FrictionTestRow
from report.project.model.frozen import Frozen
from report.project.model.motion_input import MotionInput
from report.project.model.place import Place
from report.project.model.roof import Clearance, RoofObject
from report.project.workbook import SECTIONS
from report.project.workbook.entries import Entry
from report.project.workbook.sections import SheetSection

# Difference from a limit / limit that is rounding error of a conversion of units.
ROUNDING = 1e-9


@cache
def _ranged(section: SheetSection) -> Sequence[tuple[Entry, float, float]]:
    """Return the fields of a section with a usual range, and its ends."""
    return [
        (entry, entry.expected.low * (1.0 - ROUNDING), entry.expected.high * (1.0 + ROUNDING))
        for entry in section.entries
        if entry.usual is not None
    ]


def unusual(data: ProjectInput) -> Iterator[Finding]:
    """Yield a warning for each number outside its usual range."""
    is_us = data.us_first
    for section in SECTIONS:
        rows = getattr(data, section.key)
        for index, row in enumerate(rows if section.is_table else (rows,)):
            # An edge without parapet has height 0, which is no object too low.
            is_bare = getattr(row, "kind", None) is ObjectKind.EDGE_WITHOUT_PARAPET
            for entry, low, high in _ranged(section):
                value = getattr(row, entry.name)
                is_none = value == 0.0 and (is_bare or entry.zero)
                if value is None or low <= value <= high or is_none:
                    continue
                yield _warning(section, index, entry, row, is_us)


def _warning(section: SheetSection, index: int, entry: Entry, row: Frozen, is_us: bool) -> Finding:
    unit = entry.unit_in(is_us=is_us)
    symbol, si = (unit.symbol, unit.si) if unit else (str(entry.unit), 1.0)
    value, span = f"{getattr(row, entry.name) / si:.4g}", entry.expected.words(si)
    text = f"{entry.spoken} is {value} {symbol}".rstrip() + f"; {span} {symbol}".rstrip()
    # The sheet Acknowledged answers a warning by this name: reasons of former workbooks depend on
    # it.
    name = " ".join(f"usual {entry.spoken} {_named(row)}".split())
    place = Place(section.key, index, entry.name)
    return warning(name, place, f"{text} is usual: correct the value or its unit")


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
