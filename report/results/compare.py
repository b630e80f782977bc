"""What changed since a former revision: inputs, records, results and verdicts.

Reads no file (`report.results.since`) and computes no result. Read `changes`.
"""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from typing import Any, TypeVar

from report.assessment.changes import Change, ChangeKind, Changes
from report.assessment.project import Assessment
from report.assessment.verdict import Verdict
from report.entities.array import ArrayResult
from report.entities.cells import Told
from report.entities.columns import UnitFormat
from report.entities.results import Compared, compared
from report.entities.shown import Entity, marks_of
from report.sheet.schema import SECTIONS
from report.sheet.schema.fields import Entry, Frozen, Place, SheetSection, YesNo, entries

ALIKE = 1e-6
"""Relative difference up to which two results count as the same: rounding on another machine."""

NOT_THERE = "—"
_NO_TABLE: tuple[str, ...] = ()
"""Key of what a section holds that is no table."""

_Row = TypeVar("_Row", bound=Entity)
_Pair = tuple[Entity | None, Entity | None]
"""A row before and now; None where it is new, or gone."""


def changes(former: Compared, assessment: Assessment) -> Changes:
    """Return what changed from a former revision to this assessment."""
    now = compared(assessment)
    us_first = assessment.project.project.units_first.is_us
    arrays, gone = _pairs(former.arrays, now.arrays, lambda row: (row.id,))
    gaps, _ = _pairs(former.clearances, now.clearances, _gap_key)
    items = [
        *_one(ChangeKind.RULES, "Rule set", former.rule_set, now.rule_set),
        *_one(ChangeKind.SOFTWARE, "Roofslip", former.roofslip_version, now.roofslip_version),
        *_inputs(former, assessment, us_first),
        *_records(former, now),
        *_requirements(former, now),
        *_one(ChangeKind.VERDICT, "Project", former.verdict, now.verdict),
        *_results((*arrays, *gaps, *gone), UnitFormat(us_first=us_first)),
    ]
    return Changes(
        revision=former.input.project.revision,
        date=former.input.project.date.isoformat(),
        items=tuple(sorted(items, key=lambda item: list(ChangeKind).index(item.kind))),
        arrays=frozenset(
            row.id for old, row in arrays if any(_differing(old, row)) or any(_numbers(old, row))
        ),
        values=frozenset((row.id, name) for old, row in arrays for name in _numbers(old, row)),
        clearances=frozenset(
            number for number, (old, gap) in enumerate(gaps, start=1) if any(_differing(old, gap))
        ),
    )


def _one(kind: ChangeKind, title: str, before: str, now: str, cell: str = "") -> Iterator[Change]:
    if before != now:
        yield Change(kind=kind, title=title, before=before, now=now, cell=cell)


def _keyed(rows: Sequence[Any], key: Any) -> dict[tuple[str, ...], Any]:
    """Return rows by key; equal keys are numbered."""
    seen: Counter[tuple[str, ...]] = Counter()
    keyed = {}
    for row in rows:
        name = key(row)
        seen[name] += 1
        keyed[*name, str(seen[name])] = row
    return keyed


def _gap_key(row: Any) -> tuple[str, ...]:
    return (row.array, row.object, str(row.direction))


def _inputs(former: Compared, assessment: Assessment, us_first: bool) -> Iterator[Change]:
    for section in SECTIONS:
        data = (getattr(one, section.key) for one in (former.input, assessment.project))
        if section.is_table:
            olds, news = (_keyed(rows, _row_key) for rows in data)
        else:
            olds, news = ({_NO_TABLE: row} for row in data)
        for index, (key, row) in enumerate(news.items()):
            cells = _cells(section, index, assessment)
            if key in olds:
                yield from _fields(_name(section, key), olds[key], row, cells, us_first)
            else:
                first = next(filter(None, cells.values()), "")
                yield _input(_name(section, key), NOT_THERE, "added", first)
        for key in olds:
            if key not in news:
                yield _input(_name(section, key), "given", "removed", "")


def _input(title: str, before: str, now: str, cell: str) -> Change:
    return Change(kind=ChangeKind.INPUT, title=title, before=before, now=now, cell=cell)


def _cells(section: SheetSection, index: int, assessment: Assessment) -> Mapping[Entry, str]:
    """Return the cell of each field of a row; empty for one that is not on the sheet."""
    addresses = assessment.sheet.addresses
    return {
        entry: addresses.get(Place(section.key, index, entry.name), "")
        for entry in entries(section.model)
    }


def _row_key(row: Any) -> tuple[str, ...]:
    """Return what identifies a row of a table; rows of other tables count from the first."""
    if hasattr(row, "id"):
        return (row.id,)
    if hasattr(row, "object"):
        return _gap_key(row)
    names = (getattr(row, name, "") for name in ("array", "provision", "warning"))
    return (next(filter(None, names), ""),)


def _name(section: SheetSection, key: tuple[str, ...]) -> str:
    """Return what a row of a table is called; nothing for a section that is none."""
    if not key:
        return ""
    *parts, count = (part for part in key if part)
    number = f"row {count}" if not parts or count != "1" else ""
    return f"{section.title}, {' '.join([*parts, number]).rstrip()}"


def _fields(
    name: str, old: Frozen, new: Frozen, cells: Mapping[Entry, str], us_first: bool
) -> Iterator[Change]:
    for entry, cell in cells.items():
        before, now = getattr(old, entry.name), getattr(new, entry.name)
        if not _same(before, now):
            title = f"{name}: {entry.cell.label}" if name else entry.cell.label
            shown = [_shown(entry, value, us_first) for value in (before, now)]
            yield _input(title, shown[0], shown[1], cell)


def _same(before: object, now: object) -> bool:
    """Whether two inputs are equal; a length in another unit may differ by rounding."""
    if isinstance(before, float) and isinstance(now, float):
        return math.isclose(before, now, rel_tol=1e-12)
    return before == now


def _shown(entry: Entry, value: Any, us_first: bool) -> str:
    if value is None or value == "":
        return NOT_THERE
    if isinstance(value, bool):
        return str(YesNo.YES if value else YesNo.NO)
    if isinstance(value, (int, float)):
        if entry.quantity:
            unit = UnitFormat(us_first).units(entry.quantity)[0]
            return f"{value / unit.si:.8g} {unit.symbol}"
        return f"{value:.8g} {entry.cell.unit}".rstrip()
    return str(value)


def _records(former: Compared, now: Compared) -> Iterator[Change]:
    olds, news = (
        {(row.motion, row.component): f"{row.name}, SHA-256 {row.sha256}" for row in one.records}
        for one in (former, now)
    )
    for key in dict.fromkeys((*olds, *news)):
        shown = (rows.get(key, NOT_THERE) for rows in (olds, news))
        yield from _one(ChangeKind.RECORD, " ".join(key), *shown)


def _pairs(
    olds: Sequence[_Row], news: Sequence[_Row], key: Callable[[_Row], tuple[str, ...]]
) -> tuple[Sequence[tuple[_Row | None, _Row]], Sequence[tuple[_Row, None]]]:
    """Return the rows of now, each with that before, and those that are gone."""
    before, now = _keyed(olds, key), _keyed(news, key)
    return (
        [(before.get(name), row) for name, row in now.items()],
        [(row, None) for name, row in before.items() if name not in now],
    )


def _requirements(former: Compared, now: Compared) -> Iterator[Change]:
    """Yield the rows whose verdict changed; a row that is not there any more is satisfied."""

    def key(row: Any) -> tuple[str, ...]:
        return (row.subject, row.title)

    olds, news = (_keyed(one.requirements, key) for one in (former, now))
    for name in dict.fromkeys((*olds, *news)):
        shown = (
            f"{rows[name].found}: {rows[name].verdict.word}" if name in rows else NOT_THERE
            for rows in (olds, news)
        )
        title = ", ".join(part for part in name[:2] if part)
        yield from _one(ChangeKind.REQUIREMENT, title, *shown)


def _differing(old: Entity | None, row: Entity | None) -> Iterator[tuple[str, Told]]:
    """Yield the fields of a row, or of one that is new or gone, that changed."""
    either = row or old
    for name, told in marks_of(type(either), Told) if either else ():
        if not (old and row and _alike(getattr(old, name), getattr(row, name))):
            yield name, told


def _alike(before: Any, now: Any) -> bool:
    """Whether two results are the same; NaN is no value."""
    if not isinstance(now, float):
        return bool(before == now)
    if math.isnan(before) or math.isnan(now):
        return math.isnan(before) and math.isnan(now)
    return math.isclose(before, now, rel_tol=ALIKE)


def _numbers(old: ArrayResult | None, row: ArrayResult) -> Iterator[str]:
    """Yield the key, or the motion, of each number of an array that changed."""
    for name, _ in _differing(old, row):
        if isinstance(getattr(row, name), float):
            yield name
    peaks = {peak.motion: peak.any_m for peak in old.peaks} if old else {}
    for peak in row.peaks:
        if peak.motion not in peaks or not _alike(peaks[peak.motion], peak.any_m):
            yield peak.motion


def _results(pairs: Iterable[_Pair], fmt: UnitFormat) -> Iterator[Change]:
    """Yield the changes that are listed of rows."""
    for old, row in pairs:
        for name, told in _differing(old, row):
            if told.kind and (old or told.of_new) and (row or told.of_gone):
                title = told.title.format(row=row or old)
                yield from _one(told.kind, title, *_texts(old, row, name, fmt))


def _texts(old: Entity | None, row: Entity | None, name: str, fmt: UnitFormat) -> Sequence[str]:
    """Return a field before and now; numbers have more digits where they would print alike."""
    texts = [_text(one, name, fmt) if one else NOT_THERE for one in (old, row)]
    if texts[0] != texts[1]:
        return texts
    unit = name.rpartition("_")[2]
    return [f"{getattr(one, name):.7g} {unit}" for one in (old, row)]


def _text(row: Entity, name: str, fmt: UnitFormat) -> str:
    value = getattr(row, name)
    return value.word if isinstance(value, Verdict) else row.both(name, fmt)
