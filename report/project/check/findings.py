"""Findings on an input: equal ones of several cells are one, and a reason may answer a warning.

Owns ids and acknowledgments. Read `report.project.check.plausible` next.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Hashable, Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from functools import cache
from typing import Any

from report.project.model import ProjectInput
from report.project.model.choices import Direction, ObjectKind
from report.project.model.finding import Finding, Level
from report.project.model.frozen import Frozen
from report.project.model.input_rows import Inputs
from report.project.model.motions import MotionInput
from report.project.model.place import Place
from report.project.model.scene import Array, Clearance, RoofObject
from report.project.model.site import FrictionTestRow
from report.project.workbook import SECTIONS
from report.project.workbook.entries import Entry, SheetSection
from report.text.counts import foreign_letters, looks
from solver.model import Problem
from solver.suggestions import nearest

# Cells and ids named of equal errors and findings.
MOST_LISTED = 3


def grouped(problems: Iterable[Problem]) -> Iterable[Sequence[Problem]]:
    """Return problems in order; equal ones of a sheet together, where the first is."""
    alike: dict[tuple[str, str, int], list[Problem]] = {}
    for number, problem in enumerate(problems):
        sheet, has_cell, _ = problem.where.rpartition("!")
        # Without a cell nothing but its own line tells a problem: none is left out.
        alike.setdefault((sheet, problem.text, 0 if has_cell else number), []).append(problem)
    return alike.values()


def line_of(equal: Sequence[Problem]) -> str:
    """Return equal problems as one line, with their cells."""
    return str(replace(equal[0], where=listed(each.where for each in equal)))


def listed(names: Iterable[str], most: int = MOST_LISTED) -> str:
    """Return the first few of the names, with the count of the others."""
    unique = list(dict.fromkeys(names))
    more = len(unique) - most
    return ", ".join(unique[:most]) + (f" and {more:,} more" if more > 0 else "")


def column(inputs: Inputs, sections: Iterable[str], field: str) -> Iterator[tuple[Place, Any]]:
    """Yield the readable cells of a field in the tables that have it, each with its place."""
    for section in sections:
        for index, row in enumerate(inputs[section]):
            if field in row:
                yield Place(section, index, field), row[field]


def repeated(
    cells: Iterable[tuple[Place, Any]], key: Callable[[Any], Hashable] = lambda value: value
) -> Iterator[tuple[Place, Any, Place]]:
    """Yield place and value of what is given again, and the place at which it was given first."""
    places: dict[Hashable, Place] = {}
    for place, value in cells:
        first = places.setdefault(key(value), place)
        if first is not place:
            yield place, value, first


def suggestion(value: str, ids: Collection[str]) -> str:
    """Return in words which id may have been meant, or which there are."""
    same = next((name for name in ids if looks(name) == looks(value)), "")
    # Letters of two alphabets may look alike, so that the list would show the same name again.
    if said := same and (foreign_letters(value) or foreign_letters(same)):
        return f"it looks like '{same}', but {said}: retype it"
    if close := nearest(value, ids):
        return f"did you mean '{close}'?"
    names = ", ".join(list(ids)[:8])
    return f"give one of {names}" if names else "add it there first"


def warning(name: str, place: Place, text: str) -> Finding:
    """Return a warning that may be acknowledged."""
    return Finding(level=Level.WARNING, id=name, place=place, text=text)


def limit(text: str, place: Place, *others: Place) -> Finding:
    """Return a warning that cannot be acknowledged, with the cells to look at."""
    return Finding(level=Level.WARNING, place=place, others=others, text=text)


def note(place: Place, text: str) -> Finding:
    """Return a note."""
    return Finding(level=Level.NOTE, place=place, text=text)


def acknowledged(data: ProjectInput, findings: Iterable[Finding]) -> tuple[Finding, ...]:
    """Return findings in the order of the template, each with the reason that the sheet gives."""
    all_findings = tuple(findings)
    reasons = {_key(row.warning): row.reason for row in data.acknowledged}
    answered = [
        replace(f, reason=reasons.get(_key(f.id), "") if f.id else "") for f in all_findings
    ]
    # An acknowledgment of no warning is a note.
    return in_order([*answered, *_idle(data, all_findings)])


def in_order(findings: Iterable[Finding]) -> tuple[Finding, ...]:
    """Return findings in the order of the template."""
    return tuple(
        sorted(findings, key=lambda finding: (_ORDER[finding.place.section], finding.place.row))
    )


def located(findings: Iterable[Finding], addresses: Mapping[Place, str]) -> Iterator[str]:
    """Yield the address of each finding: its cells, or else its table or sheet."""
    for finding in findings:
        place = finding.place
        table = addresses.get(Place(place.section), _SHEETS[place.section])
        cells = (addresses.get(each, table) for each in (place, *finding.others))
        yield finding.cell or listed(cells, _MOST_CELLS)


def lines(findings: Iterable[Finding], addresses: Mapping[Place, str]) -> Iterator[Finding]:
    """Yield findings in order; equal ones once, with the first few of their cells and ids."""
    all_findings = tuple(findings)
    alike: dict[tuple[str, ...], list[tuple[Finding, str]]] = {}
    for finding, cell in zip(all_findings, located(all_findings, addresses), strict=True):
        has_id = "id" if finding.id else ""
        key = (finding.level, finding.place.section, finding.text, finding.reason, has_id)
        alike.setdefault(key, []).append((finding, cell))
    for group in alike.values():
        cells, names = listed(cell for _, cell in group), listed(each.id for each, _ in group)
        yield replace(group[0][0], cell=cells, id=names)


_MOST_CELLS = 4  # of one finding
_SHEETS = {section.key: section.sheet for section in SECTIONS}
_ORDER = {section.key: count for count, section in enumerate(SECTIONS)}


def _key(name: str) -> str:
    return " ".join(name.split()).casefold()


def _idle(data: ProjectInput, findings: Iterable[Finding]) -> Iterator[Finding]:
    ids = [finding.id for finding in findings if finding.id]
    known = {_key(name) for name in ids}
    for index, row in enumerate(data.acknowledged):
        if _key(row.warning) not in known:
            text = f"warning is '{row.warning}', which is not given; "
            text += suggestion(row.warning, ids) if ids else "delete the row"
            yield note(Place("acknowledged", index, "warning"), text)


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
