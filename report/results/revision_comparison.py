"""Changes since a previous revision: compares its results.json with an assessment.

Computes no result. Read `changes`, then `_RESULTS`: the results that are compared.
"""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import KW_ONLY, dataclass, replace
from typing import Any, TypeVar

from report.assessment.assessment import Assessment
from report.assessment.checks.check import condition
from report.assessment.revision_changes import Change, ChangeKind, Changes
from report.project.check.covered import COVERED
from report.project.model.choices import Direction, YesNo
from report.project.model.input_rows import Place
from report.project.model.values import Frozen
from report.project.workbook import SECTIONS
from report.project.workbook.entries import Entry, SheetSection
from report.results.array_results import ArrayResult
from report.results.clearance_results import ClearanceResult
from report.results.result_base import ResultModel
from report.results.results_json import GIVE
from report.results.results_model import Compared
from report.results.rows import check_results, compared
from report.text.unit_format import UnitFormat
from report.text.units import no_less, ratio, spaced, with_unit
from solver.errors import InputError

# Most changes that the package lists, and most letters of them all.
MOST_CHANGES, MOST_LETTERS = 2_000, 400_000


def check_listed(changes: Changes) -> None:
    """Reject more changes since a previous revision than can be laid out in minutes."""
    count = len(changes.items)
    letters = sum(len(item.title) + len(item.before) + len(item.now) for item in changes.items)
    if count > MOST_CHANGES or letters > MOST_LETTERS:
        raise InputError(
            f"--since: the list of changes has {count:,} rows of {letters:,} characters; at most"
            f" {MOST_CHANGES:,} of {MOST_LETTERS:,} are listed; {GIVE} of this project"
        )


# Relative difference up to which two results count as the same: rounding on another machine.
ALIKE = 1e-6

NOT_THERE = "—"

_Row = TypeVar("_Row")
_Pair = tuple[_Row | None, _Row | None]
"""A row of either revision; None where it has none."""


def changes(earlier: Compared, assessment: Assessment) -> Changes:
    """Return the changes from a previous revision to this assessment."""
    current = compared(assessment)
    arrays = _paired(current.arrays, earlier.arrays, lambda row: (row.id,)).values()
    gaps = _paired(current.clearances, earlier.clearances, _gap_key).values()
    items = [
        *_given(earlier, current, assessment),
        *_one(ChangeKind.SOFTWARE, "Roofslip", earlier.roofslip_version, current.roofslip_version),
        *_checks(earlier, assessment),
        *_one(ChangeKind.VERDICT, "Project", earlier.verdict, current.verdict),
        *_results((*arrays, *gaps), UnitFormat(us_first=assessment.project.us_first)),
    ]
    values = set[tuple[str, str]]()
    for row, earlier_row in arrays:
        if row:
            values |= {(row.id, name) for name in _numbers(row, earlier_row)}
    return Changes(
        revision=earlier.input.project.revision,
        date=earlier.input.project.date.isoformat(),
        # Causes before effects, in the order of the kinds: rule set and input stand above what
        # follows from them.
        items=tuple(sorted(items, key=lambda item: list(ChangeKind).index(item.kind))),
        arrays=frozenset(
            row.id
            for row, earlier_row in arrays
            if row and (any(_differing(row, earlier_row)) or any(_numbers(row, earlier_row)))
        ),
        values=frozenset(values),
        clearances=frozenset(
            number
            for number, (gap, earlier_row) in enumerate(gaps, start=1)
            if gap and any(_differing(gap, earlier_row))
        ),
    )


# What changed of them is listed with the clearances and the design displacements.
_LISTED = ("clearance", "design")


def _checks(earlier: Compared, assessment: Assessment) -> Iterator[Change]:
    # Version 0.3 wrote none.
    if "checks" not in earlier.model_fields_set:
        return
    # In its units: with others first a text says the same in another order.
    head = assessment.project.project.model_copy(
        update={"units_first": earlier.input.project.units_first}
    )
    project = assessment.project.model_copy(update={"project": head})
    current = check_results(replace(assessment, project=project))
    before, after = (
        [row for row in rows if row.id not in _LISTED] for rows in (earlier.checks, current)
    )
    text = "{row.found_text}: {row.verdict}"
    yield from _rows(ChangeKind.REQUIREMENT, before, after, "{row.subject}, {row.title}", text)


def with_reissue(assessment: Assessment, earlier: Compared) -> Assessment:
    """Return an assessment with a condition where the same revision had other inputs before."""
    issue, then = assessment.project.project, earlier.input.project
    # One revision with two contents: nobody can tell later which of them was sealed.
    is_same = issue.revision.casefold() == then.revision.casefold()
    # By what the results follow from, not by the results: another version of the program may round
    # otherwise.
    if not (is_same and any(_given(earlier, compared(assessment), assessment))):
        return assessment
    row = condition(
        id="revision",
        title=f"Revision {issue.revision}",
        found=f"issued with other inputs, {then.date}",
        limit="another revision for other inputs",
        clause="plan check",
        is_satisfied=False,
        remedy="Raise the revision on the Project worksheet, and add its row to Revisions: a "
        "seal on the previous package is not one on this.",
    )
    return replace(assessment, more=(row,))


def _given(earlier: Compared, current: Compared, assessment: Assessment) -> Iterator[Change]:
    """Yield the changes of the inputs of the results."""
    yield from _one(ChangeKind.RULES, "Rule set", earlier.rule_set, current.rule_set)
    yield from _inputs(earlier, assessment, assessment.project.us_first)
    records = earlier.records, current.records, "{row.motion} {row.component}"
    yield from _rows(ChangeKind.RECORD, *records, "{row.name}, SHA-256 {row.sha256}")
    # Earlier versions did not write theirs.
    if "documents" in earlier.model_fields_set:
        documents = earlier.documents, current.documents, "{row.label}"
        yield from _rows(ChangeKind.DOCUMENT, *documents, "{row.path}, SHA-256 {row.sha256}")


def _one(
    kind: ChangeKind, title: str, before: str, current: str, cell: str = ""
) -> Iterator[Change]:
    if before != current:
        # A verdict is an enum, and is listed as a text.
        yield Change(kind=kind, title=title, before=str(before), now=str(current), cell=cell)


def _paired(
    first: Iterable[_Row], second: Iterable[_Row], key: Callable[[_Row], tuple[str, ...]]
) -> Mapping[tuple[str, ...], _Pair[_Row]]:
    """Return the rows of two revisions by key; equal keys are numbered."""
    a, b = (_keyed(rows, key) for rows in (first, second))
    return {name: (a.get(name), b.get(name)) for name in a | b}


def _keyed(
    rows: Iterable[_Row], key: Callable[[_Row], tuple[str, ...]]
) -> dict[tuple[str, ...], _Row]:
    seen: Counter[tuple[str, ...]] = Counter()
    keyed = {}
    for row in rows:
        name = key(row)
        seen[name] += 1
        # Workbooks may have equal rows, as two clearances of one pair.
        keyed[*name, str(seen[name])] = row
    return keyed


def _gap_key(row: Any) -> tuple[str, ...]:
    return (row.array, row.object, str(row.direction))


def _inputs(earlier: Compared, assessment: Assessment, us_first: bool) -> Iterator[Change]:
    for section in SECTIONS:
        current, before = (
            getattr(data, section.key) for data in (assessment.project, earlier.input)
        )
        rows = _paired(current, before, _row_key) if section.is_table else {(): (current, before)}
        for index, (key, (row, earlier_row)) in enumerate(rows.items()):
            name, cells = _name(section, key), _cells(section, index, assessment)
            if row is None:
                yield _input(name, "given", "removed", "")
            elif earlier_row is None:
                yield _input(name, NOT_THERE, "added", next(filter(None, cells.values()), ""))
            else:
                yield from _fields(name, earlier_row, row, cells, us_first)


def _input(title: str, before: str, current: str, cell: str) -> Change:
    return Change(kind=ChangeKind.INPUT, title=title, before=before, now=current, cell=cell)


def _cells(section: SheetSection, index: int, assessment: Assessment) -> Mapping[Entry, str]:
    """Return the cell of each field of a row; empty for one that is not on the sheet."""
    # What a confirmation covers is filled in by `report`: it is no input of an engineer.
    addresses = assessment.source.addresses
    return {
        entry: addresses.get(Place(section.key, index, entry.name), "")
        for entry in section.entries
        if entry.name not in COVERED
    }


def _row_key(row: Any) -> tuple[str, ...]:
    """Return the identifier of a row of a table."""
    if hasattr(row, "id"):
        return (row.id,)
    if hasattr(row, "object"):
        return _gap_key(row)
    # Rows of tables without any of them count from the first.
    names = (getattr(row, name, "") for name in ("array", "provision", "warning"))
    return (next(filter(None, names), ""),)


def _name(section: SheetSection, key: tuple[str, ...]) -> str:
    """Return the name of a row of a table; nothing for a section that is not a table."""
    if not key:
        return ""
    *parts, count = (part for part in key if part)
    number = f"row {count}" if not parts or count != "1" else ""
    return f"{section.title}, {' '.join([*parts, number]).rstrip()}"


def _fields(
    name: str, earlier_row: Frozen, current_row: Frozen, cells: Mapping[Entry, str], us_first: bool
) -> Iterator[Change]:
    for entry, cell in cells.items():
        before, current = getattr(earlier_row, entry.name), getattr(current_row, entry.name)
        if not _same(before, current):
            title = f"{name}: {entry.heading}" if name else entry.heading
            texts = [_shown(entry, value, us_first) for value in (before, current)]
            yield _input(title, texts[0], texts[1], cell)


def _same(before: object, current: object) -> bool:
    """Whether two inputs are equal."""
    if isinstance(before, float) and isinstance(current, float):
        # Feet and meters of one length differ in the last bit.
        return math.isclose(before, current, rel_tol=1e-12)
    return before == current


def _shown(entry: Entry, value: Any, us_first: bool) -> str:
    if value is None or value == "":
        return NOT_THERE
    if isinstance(value, bool):
        return str(YesNo.YES if value else YesNo.NO)
    if isinstance(value, (int, float)):
        if entry.quantity:
            unit = UnitFormat(us_first).units(entry.quantity)[0]
            return with_unit(f"{value / unit.si:.8g}", unit.symbol)
        return with_unit(f"{value:.8g}", str(entry.unit))
    return str(value)


def _rows(
    kind: ChangeKind, before: Iterable[_Row], current: Iterable[_Row], title: str, text: str
) -> Iterator[Change]:
    """Yield the rows whose text changed, by title; both are of a `row` in braces."""
    # Those of the former revision are read from a file, with ordinary spaces.
    pairs = _paired(before, current, lambda row: (spaced(title.format(row=row)),))
    for (name, _), pair in pairs.items():
        first, second = (text.format(row=row) if row else NOT_THERE for row in pair)
        if spaced(first) != spaced(second):
            yield from _one(kind, name.removeprefix(", "), first, second)


def _array(row: ArrayResult) -> str:
    return f"Array {row.id}"


def _gap(row: ClearanceResult) -> str:
    toward = "" if row.direction is Direction.ANY else f", {row.direction.value}"
    return f"{row.array} to {row.object}{toward}"


def _clearance(row: ClearanceResult) -> str:
    return f"Clearance {row.array} to {row.object}"


@dataclass(frozen=True, slots=True)
class _Result:
    """A result that is compared with that of the previous revision."""

    key: str  # of results.json
    kind: ChangeKind | None = None  # None if its change marks the row, and is not listed
    title: Callable[[Any], str] = str  # of a row: what changed
    more: str = ""  # after the title
    _: KW_ONLY
    # whether it is listed of a row that the former revision did not have, or that is gone
    of_new: bool = True
    of_gone: bool = False


_RESULTS: Mapping[type[ResultModel], Sequence[_Result]] = {
    ArrayResult: (
        _Result("computed_m", ChangeKind.ANALYSIS, _array, of_new=False),
        _Result("mean_prd_m"),
        _Result("largest_prd_m"),
        _Result("prescriptive_m"),
        _Result("floor_m"),
        _Result("design_m", ChangeKind.DESIGN, _array),
        _Result("verdict", ChangeKind.VERDICT, _array, of_gone=True),
    ),
    # Of a new clearance the verdict is listed, which says as much.
    ClearanceResult: (
        _Result("required_m", ChangeKind.CLEARANCE, _gap, ", required", of_new=False),
        # Its input is listed as an input already.
        _Result("provided_m"),
        _Result("demand_capacity", ChangeKind.CLEARANCE, _gap, ", D/C", of_new=False),
        _Result("verdict", ChangeKind.VERDICT, _clearance),
    ),
}


def _differing(row: ResultModel | None, earlier_row: ResultModel | None) -> Iterator[_Result]:
    """Yield the results of a row, or of one that is new or gone, that changed."""
    either = row or earlier_row
    for result in _RESULTS[type(either)] if either else ():
        if not (
            earlier_row
            and row
            and _alike(getattr(earlier_row, result.key), getattr(row, result.key))
        ):
            yield result


def _alike(before: Any, current: Any) -> bool:
    """Whether two results are the same; NaN is no value."""
    if not isinstance(current, float):
        return bool(before == current)
    # NaN is unequal to itself.
    if math.isnan(before) or math.isnan(current):
        return math.isnan(before) and math.isnan(current)
    return math.isclose(before, current, rel_tol=ALIKE)


def _numbers(row: ArrayResult, earlier_row: ArrayResult | None) -> Iterator[str]:
    """Yield the key, or the motion, of each number of an array that changed."""
    for result in _differing(row, earlier_row):
        if isinstance(getattr(row, result.key), float):
            yield result.key
    peaks = {peak.motion: peak.any_m for peak in earlier_row.peaks} if earlier_row else {}
    for peak in row.peaks:
        if peak.motion not in peaks or not _alike(peaks[peak.motion], peak.any_m):
            yield peak.motion


def _results(pairs: Iterable[_Pair[ResultModel]], fmt: UnitFormat) -> Iterator[Change]:
    """Yield the changes that are listed of rows; those that are gone come last."""
    # The sort is stable: rows stay in the order of the workbook.
    for row, earlier_row in sorted(pairs, key=lambda pair: pair[0] is None):
        for result in _differing(row, earlier_row):
            if result.kind and (earlier_row or result.of_new) and (row or result.of_gone):
                title = result.title(row or earlier_row) + result.more
                yield from _one(result.kind, title, *_as_texts(result.key, earlier_row, row, fmt))


def _as_texts(
    key: str, earlier_row: ResultModel | None, row: ResultModel | None, fmt: UnitFormat
) -> Sequence[str]:
    """Return a result before and now; numbers have more digits where they would print alike."""
    values = [getattr(result, key) if result else NOT_THERE for result in (earlier_row, row)]
    texts = [_text(key, value, fmt) for value in values]
    # Results that differ by more than rounding may still print alike.
    if texts[0] != texts[1]:
        return texts
    unit = "m" if key.endswith("_m") else ""
    return [with_unit(f"{value:.7g}", unit) for value in values]


def _text(key: str, value: float | str, fmt: UnitFormat) -> str:
    if isinstance(value, str):
        return value
    return fmt.both(value, show=no_less) if key.endswith("_m") else ratio(value)
