"""What changed since a former revision: inputs, records, results and verdicts.

Reads no file (`report.results.since`) and computes no result. Read `changes`.
"""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from importlib.metadata import version
from typing import Any

from report.assessment.arrays import ArrayAssessment
from report.assessment.changes import Change, ChangeKind, Changes
from report.assessment.clearances import ClearanceCheck
from report.assessment.project import Assessment
from report.results.since import Former, FormerArray, FormerClearance
from report.sheet.fields import Entry, Frozen, Place, Section, YesNo, entries
from report.sheet.schema import SECTIONS, Direction
from report.words.units import Quantity, pair

ALIKE = 1e-6
"""Relative difference up to which two results count as the same: rounding on another machine."""

NOT_THERE = "—"


def changes(former: Former, assessment: Assessment) -> Changes:
    """Return what changed from a former revision to this assessment."""
    values = frozenset(_changed_values(former, assessment))
    gaps = _keyed(former.clearances, _gap_key)
    now = _keyed(assessment.clearances, lambda item: _gap_key(item.clearance))
    numbers = frozenset(
        number
        for number, (key, gap) in enumerate(now.items(), start=1)
        if key not in gaps or _gap_changed(gaps[key], gap)
    )
    before = {array.id: array for array in former.arrays}
    return Changes(
        revision=former.input.project.revision,
        date=former.input.project.date.isoformat(),
        items=(
            *_one(ChangeKind.RULES, "Rule set", former.rule_set, assessment.rules.name),
            *_one(ChangeKind.SOFTWARE, "Roofslip", former.roofslip_version, version("roofslip")),
            *_inputs(former, assessment),
            *_records(former, assessment),
            *_designs(before, assessment),
            *_gaps(gaps, now, _us_first(assessment)),
            *_requirements(former, assessment),
            *_verdicts(former, before, assessment),
        ),
        arrays=frozenset(
            item.id
            for item in assessment.arrays
            if any(name == item.id for name, _ in values)
            or before[item.id].verdict != assessment.array_verdict(item)
        ),
        values=values,
        clearances=numbers,
    )


def _us_first(assessment: Assessment) -> bool:
    return assessment.project.project.units_first == "US"


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


def _inputs(former: Former, assessment: Assessment) -> Iterator[Change]:
    us_first = _us_first(assessment)
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


def _name(section: Section, key: tuple[str, ...]) -> str:
    *parts, count = (part for part in key if part)
    number = f"row {count}" if not parts or count != "1" else ""
    return f"{section.title}, {' '.join([*parts, number]).rstrip()}"


def _first_cell(section: Section, index: int, assessment: Assessment) -> str:
    addresses = assessment.sheet.addresses
    places = (Place(section.key, index, entry.name) for entry in entries(section.model))
    return next((addresses[place] for place in places if place in addresses), "")


def _fields(
    section: Section,
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


def _records(former: Former, assessment: Assessment) -> Iterator[Change]:
    before = {(row.motion, row.component): row for row in former.records}
    now = {(row.motion_id, row.component): row for row in assessment.shaking.records}
    for key in dict.fromkeys((*before, *now)):
        old, new = (
            f"{rows[key].name}, SHA-256 {rows[key].sha256}" if key in rows else NOT_THERE
            for rows in (before, now)
        )
        yield from _one(ChangeKind.RECORD, " ".join(key), old, new)


_RESULTS = (
    "mean_prd_m", "largest_prd_m", "computed_m", "prescriptive_m", "floor_m", "design_m",
)  # fmt: skip


def _results(item: ArrayAssessment) -> Mapping[str, float]:
    return dict(
        zip(
            _RESULTS,
            (
                item.analysis.mean_m,
                item.analysis.largest_m,
                item.analysis.value_m,
                item.prescriptive.value_m,
                item.floor_m,
                item.design_m,
            ),
            strict=True,
        )
    )


def _changed_values(former: Former, assessment: Assessment) -> Iterator[tuple[str, str]]:
    """Yield each array with the key, or the motion, whose number changed."""
    arrays = {array.id: array for array in former.arrays}
    for item in assessment.arrays:
        old = arrays.get(item.id)
        for key, value in _results(item).items():
            if old is None or not _alike(getattr(old, key), value):
                yield item.id, key
        peaks = _old_peaks(old) if old else {}
        for run in item.motions:
            name = run.motion.id
            if name not in peaks or not _alike(peaks[name], run.peak_m(Direction.ANY)):
                yield item.id, name


def _old_peaks(array: FormerArray) -> Mapping[str, float | None]:
    key = f"{Direction.ANY.value}_m"
    return {
        str(row.get("motion")): value
        for row in array.peaks
        if not isinstance(value := row.get(key), str)
    }


def _alike(before: float | None, now: float) -> bool:
    """Whether two results are the same; None and NaN are no value."""
    if before is None or math.isnan(now):
        return before is None and math.isnan(now)
    return math.isclose(before, now, rel_tol=ALIKE)


def _lengths(before: float | None, now: float, us_first: bool) -> tuple[str, str]:
    """Return two lengths, with more digits where print alike."""
    values = [math.nan if before is None else before, now]
    shown = ["none" if math.isnan(v) else pair(v, Quantity.DISPLACEMENT, us_first) for v in values]
    if shown[0] == shown[1]:
        shown = [f"{value:.7g} m" for value in values]
    return shown[0], shown[1]


def _designs(before: Mapping[str, FormerArray], assessment: Assessment) -> Iterator[Change]:
    us_first = _us_first(assessment)
    for item in assessment.arrays:
        old = before[item.id].design_m if item.id in before else None
        if item.id in before and _alike(old, item.design_m):
            continue
        shown = _lengths(old, item.design_m, us_first)
        yield Change(
            kind=ChangeKind.DESIGN,
            title=f"Array {item.id}",
            before=shown[0] if item.id in before else NOT_THERE,
            now=shown[1],
        )


def _gap_changed(before: FormerClearance, now: ClearanceCheck) -> bool:
    return not (
        _alike(before.required_m, now.required_m)
        and _alike(before.provided_m, now.clearance.provided_m)
        and before.verdict == now.verdict
    )


def _gaps(
    before: Mapping[tuple[str, ...], FormerClearance],
    now: Mapping[tuple[str, ...], ClearanceCheck],
    us_first: bool,
) -> Iterator[Change]:
    """Yield the required separations that changed; what is provided is an input."""
    for key, new in now.items():
        array, other, direction, _ = key
        if key in before and not _alike(before[key].required_m, new.required_m):
            toward = "" if direction == "any" else f", {direction}"
            shown = _lengths(before[key].required_m, new.required_m, us_first)
            yield from _one(ChangeKind.CLEARANCE, f"{array} to {other}{toward}, required", *shown)


def _requirements(former: Former, assessment: Assessment) -> Iterator[Change]:
    """Yield the rows whose verdict changed; a row that is not there any more is satisfied."""

    def key(row: Any) -> tuple[str, ...]:
        return (row.subject, row.title)

    before, now = _keyed(former.requirements, key), _keyed(assessment.rows, key)
    for name in dict.fromkeys((*before, *now)):
        old, new = (
            f"{rows[name].found}: {rows[name].verdict}" if name in rows else NOT_THERE
            for rows in (before, now)
        )
        yield from _one(
            ChangeKind.REQUIREMENT, ", ".join(part for part in name[:2] if part), old, new
        )


def _verdicts(
    former: Former, before: Mapping[str, FormerArray], assessment: Assessment
) -> Iterator[Change]:
    yield from _one(ChangeKind.VERDICT, "Project", former.verdict, assessment.verdict.value)
    for item in assessment.arrays:
        old = before[item.id].verdict if item.id in before else NOT_THERE
        now = assessment.array_verdict(item).value
        yield from _one(ChangeKind.VERDICT, f"Array {item.id}", old, now)
    gaps = _keyed(former.clearances, _gap_key)
    for key, gap in _keyed(assessment.clearances, lambda item: _gap_key(item.clearance)).items():
        old = gaps[key].verdict if key in gaps else NOT_THERE
        title = f"Clearance {key[0]} to {key[1]}"
        yield from _one(ChangeKind.VERDICT, title, old, gap.verdict.value)
    now_ids = {item.id for item in assessment.arrays}
    for name, array in before.items():
        if name not in now_ids:
            yield from _one(ChangeKind.VERDICT, f"Array {name}", array.verdict, NOT_THERE)
