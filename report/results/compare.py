"""What changed since a former revision: inputs, records, results and verdicts.

Reads no file (`report.results.since`) and computes no result. Read `changes`.
"""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from report.assessment.changes import Change, ChangeKind, Changes
from report.assessment.project import Assessment
from report.entities.array import ArrayResult
from report.entities.clearance import ClearanceResult
from report.entities.columns import UnitFormat
from report.entities.results import Compared, compared
from report.sheet.fields import Entry, Frozen, Place, SheetSection, YesNo, entries
from report.sheet.schema import SECTIONS

ALIKE = 1e-6
"""Relative difference up to which two results count as the same: rounding on another machine."""

NOT_THERE = "—"


def changes(former: Compared, assessment: Assessment) -> Changes:
    """Return what changed from a former revision to this assessment."""
    now = compared(assessment)
    before = {array.id: array for array in former.arrays}
    values = frozenset(_changed_values(before, now.arrays))
    gaps, new_gaps = (_keyed(one.clearances, _gap_key) for one in (former, now))
    us_first = assessment.project.project.units_first.is_us
    return Changes(
        revision=former.input.project.revision,
        date=former.input.project.date.isoformat(),
        items=(
            *_one(ChangeKind.RULES, "Rule set", former.rule_set, now.rule_set),
            *_one(ChangeKind.SOFTWARE, "Roofslip", former.roofslip_version, now.roofslip_version),
            *_inputs(former, assessment, us_first),
            *_records(former, now),
            *_designs(before, now.arrays, us_first),
            *_gaps(gaps, new_gaps, us_first),
            *_requirements(former, now),
            *_verdicts(former, now),
        ),
        arrays=frozenset(
            item.id
            for item in now.arrays
            if any(name == item.id for name, _ in values) or before[item.id].verdict != item.verdict
        ),
        values=values,
        clearances=frozenset(
            number
            for number, (key, gap) in enumerate(new_gaps.items(), start=1)
            if key not in gaps or _gap_changed(gaps[key], gap)
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
        olds, news = (getattr(data, section.key) for data in (former.input, assessment.project))
        if not section.is_table:
            yield from _fields(section, 0, "", olds, news, assessment, us_first)
            continue
        old_rows, new_rows = (_keyed(rows, _row_key) for rows in (olds, news))
        for index, (key, row) in enumerate(new_rows.items()):
            name = _name(section, key)
            if key in old_rows:
                yield from _fields(section, index, name, old_rows[key], row, assessment, us_first)
            else:
                yield Change(
                    kind=ChangeKind.INPUT,
                    title=name,
                    before=NOT_THERE,
                    now="added",
                    cell=_first_cell(section, index, assessment),
                )
        for key in old_rows:
            if key not in new_rows:
                yield Change(
                    kind=ChangeKind.INPUT, title=_name(section, key), before="given", now="removed"
                )


def _row_key(row: Any) -> tuple[str, ...]:
    """Return what identifies a row of a table; rows of other tables count from the first."""
    if hasattr(row, "id"):
        return (row.id,)
    if hasattr(row, "object"):
        return _gap_key(row)
    names = (getattr(row, name, "") for name in ("array", "provision", "warning"))
    return (next(filter(None, names), ""),)


def _name(section: SheetSection, key: tuple[str, ...]) -> str:
    *parts, count = (part for part in key if part)
    number = f"row {count}" if not parts or count != "1" else ""
    return f"{section.title}, {' '.join([*parts, number]).rstrip()}"


def _first_cell(section: SheetSection, index: int, assessment: Assessment) -> str:
    addresses = assessment.sheet.addresses
    places = (Place(section.key, index, entry.name) for entry in entries(section.model))
    return next((addresses[place] for place in places if place in addresses), "")


def _fields(
    section: SheetSection,
    index: int,
    name: str,
    old: Frozen,
    new: Frozen,
    assessment: Assessment,
    us_first: bool,
) -> Iterator[Change]:
    for entry in entries(section.model):
        before, now = getattr(old, entry.name), getattr(new, entry.name)
        if not _same(before, now):
            label = entry.cell.label
            yield Change(
                kind=ChangeKind.INPUT,
                title=f"{name}: {label}" if name else label,
                before=_shown(entry, before, us_first),
                now=_shown(entry, now, us_first),
                cell=assessment.sheet.addresses.get(Place(section.key, index, entry.name), ""),
            )


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
            unit = entry.quantity.us if us_first else entry.quantity.si
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


_RESULTS = (
    "mean_prd_m", "largest_prd_m", "computed_m", "prescriptive_m", "floor_m", "design_m",
)  # fmt: skip


def _changed_values(
    before: Mapping[str, ArrayResult], arrays: Sequence[ArrayResult]
) -> Iterator[tuple[str, str]]:
    """Yield each array with the key, or the motion, whose number changed."""
    for item in arrays:
        old = before.get(item.id)
        for key in _RESULTS:
            if old is None or not _alike(getattr(old, key), getattr(item, key)):
                yield item.id, key
        peaks = {row.motion: row.any_m for row in old.peaks} if old else {}
        for row in item.peaks:
            if row.motion not in peaks or not _alike(peaks[row.motion], row.any_m):
                yield item.id, row.motion


def _alike(before: float, now: float) -> bool:
    """Whether two results are the same; NaN is no value."""
    if math.isnan(before) or math.isnan(now):
        return math.isnan(before) and math.isnan(now)
    return math.isclose(before, now, rel_tol=ALIKE)


def _lengths(before: float, now: float, us_first: bool) -> tuple[str, str]:
    """Return two lengths, with more digits where print alike."""
    fmt = UnitFormat(us_first=us_first)
    shown = fmt.both(before), fmt.both(now)
    return (f"{before:.7g} m", f"{now:.7g} m") if shown[0] == shown[1] else shown


def _designs(
    before: Mapping[str, ArrayResult], arrays: Sequence[ArrayResult], us_first: bool
) -> Iterator[Change]:
    for item in arrays:
        old = before[item.id].design_m if item.id in before else math.nan
        if item.id in before and _alike(old, item.design_m):
            continue
        shown = _lengths(old, item.design_m, us_first)
        yield Change(
            kind=ChangeKind.DESIGN,
            title=f"Array {item.id}",
            before=shown[0] if item.id in before else NOT_THERE,
            now=shown[1],
        )


def _gap_changed(before: ClearanceResult, now: ClearanceResult) -> bool:
    return before.verdict != now.verdict or not (
        _alike(before.required_m, now.required_m) and _alike(before.provided_m, now.provided_m)
    )


def _gaps(
    before: Mapping[tuple[str, ...], ClearanceResult],
    now: Mapping[tuple[str, ...], ClearanceResult],
    us_first: bool,
) -> Iterator[Change]:
    """Yield the required separations that changed; what is provided is an input."""
    for key, new in now.items():
        array, other, direction, _ = key
        if key in before and not _alike(before[key].required_m, new.required_m):
            toward = "" if direction == "any" else f", {direction}"
            shown = _lengths(before[key].required_m, new.required_m, us_first)
            yield from _one(ChangeKind.CLEARANCE, f"{array} to {other}{toward}, required", *shown)


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


def _verdicts(former: Compared, now: Compared) -> Iterator[Change]:
    yield from _one(ChangeKind.VERDICT, "Project", former.verdict, now.verdict)
    before = {item.id: item.verdict.word for item in former.arrays}
    after = {item.id: item.verdict.word for item in now.arrays}
    for name, verdict in after.items():
        old = before.get(name, NOT_THERE)
        yield from _one(ChangeKind.VERDICT, f"Array {name}", old, verdict)
    gaps, new_gaps = (_keyed(one.clearances, _gap_key) for one in (former, now))
    for key, gap in new_gaps.items():
        old = gaps[key].verdict if key in gaps else NOT_THERE
        yield from _one(ChangeKind.VERDICT, f"Clearance {key[0]} to {key[1]}", old, gap.verdict)
    for name in (name for name in before if name not in after):
        yield from _one(ChangeKind.VERDICT, f"Array {name}", before[name], NOT_THERE)
