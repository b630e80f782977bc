"""results.json with units in its keys, read as that of a former revision, and what changed since.

Computes no result, and trusts nothing in the file of a former revision. Read `changes`.
"""

from __future__ import annotations

import json
import math
from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any, TypeVar

from pydantic import ValidationError
from pydantic_core import from_json

from report.assessment.checks.check import condition
from report.assessment.evidence import Evidence
from report.assessment.project import Assessment, Change, ChangeKind, Changes
from report.entities.array import ArrayResult
from report.entities.results import SCHEMA_VERSION, Compared, compared, results
from report.entities.shown import Entity, Told, UnitFormat, marks_of
from report.project.check.covered import COVERED
from report.project.model.fields import Frozen, Place, YesNo
from report.project.workbook import SECTIONS
from report.project.workbook.entries import Entry, SheetSection
from report.text.counts import UNPRINTABLE, cut
from report.text.formats import finite
from report.text.units import in_us_order
from report.typeset.letters import named, undrawable
from solver.files import read_file
from solver.model import InputError
from solver.suggestions import meant


def results_json(assessment: Assessment, evidence: Evidence) -> bytes:
    """Return everything as JSON in SI, with units in the keys and null for no value."""
    document = results(assessment, evidence).model_dump(mode="python")
    # As it is read from a workbook: `--since` compares it field by field.
    document["input"] = assessment.project.model_dump(mode="json")
    return json.dumps(finite(document), indent=1, ensure_ascii=False).encode() + b"\n"


# Version 0.3 wrote 2, without `checks`.
READ_VERSIONS = (2, SCHEMA_VERSION)

GIVE = "give the results.json of a former revision"
AGAIN = "write it again with `report` of this version, from the workbook of that revision"

# Largest file that is read [B], and most objects of one that is compared.
MOST_BYTES, MOST_OBJECTS = 25_000_000, 100_000

# Most changes that the package lists, and most letters of them all.
MOST_CHANGES, MOST_LETTERS = 2_000, 400_000


def read_former(path: Path) -> tuple[Compared, bytes]:
    """Read results.json of a former revision; return it as data, and the file.

    Raises `InputError` if it cannot be read, is damaged or incomplete, or has another schema
    version.
    """
    if not path.exists():
        raise InputError(f"{path}: no such file; {meant(path) or GIVE}")
    content = read_file(path, MOST_BYTES, str(path), too_large=GIVE)
    return former_from(content, path), content


def former_from(content: bytes, path: Path) -> Compared:
    """Return the content of results.json as data.

    Raises `InputError`.
    """
    # Before they are parsed: millions of empty rows take gigabytes.
    if (count := content.count(b"{")) > MOST_OBJECTS:
        raise InputError(
            f"{path}: has {count:,} objects; at most {MOST_OBJECTS:,} are compared; {GIVE}"
        )
    try:
        # It counts how deep it goes; the parser of the standard library ends in a traceback.
        document = from_json(content, allow_inf_nan=False)
    except ValueError as error:
        raise InputError(f"{path}: is no results.json or is damaged; {AGAIN}") from error
    if not isinstance(document, dict):
        raise InputError(f"{path}: is no results.json or is damaged (no object); {AGAIN}")
    version = document.get("schema_version")
    # True equals 1, and 2.0 equals 2: only a whole number is a version.
    if type(version) is not int or version not in READ_VERSIONS:
        stated = f"{version!r:.40}" if version is not None else "missing"
        known = " and ".join(map(str, READ_VERSIONS))
        raise InputError(f"{path}: schema_version is {stated}; this version reads {known}; {AGAIN}")
    try:
        # Strict: "1.0" is no number, and true is none either.
        former = Compared.model_validate_json(content, strict=True)
    except ValidationError as error:
        raise InputError(f"{path}: {_first(error)}; the file is damaged: {AGAIN}") from error
    for text in _texts(former.model_dump(mode="json")):
        if letter := UNPRINTABLE.search(text):
            raise InputError(
                f"{path}: '{cut(text)}' has the character U+{ord(letter[0]):04X}, which cannot be"
                f" printed; the file is damaged: {AGAIN}"
            )
        # Laid out, it would be a box, and the log of the renderer an error.
        if missing := undrawable(text):
            raise InputError(
                f"{path}: no font of this machine has {named(missing)} of '{cut(text)}'; install"
                " one that does"
            )
    return former


def check_listed(changes: Changes) -> None:
    """Refuse more changes since a former revision than can be laid out in minutes."""
    count = len(changes.items)
    letters = sum(len(item.title) + len(item.before) + len(item.now) for item in changes.items)
    if count > MOST_CHANGES or letters > MOST_LETTERS:
        raise InputError(
            f"--since: the list of changes has {count:,} rows of {letters:,} letters; at most"
            f" {MOST_CHANGES:,} of {MOST_LETTERS:,} are listed; {GIVE} of this project"
        )


def _texts(value: Any) -> Iterator[str]:
    """Yield all texts of a document, keys included."""
    if isinstance(value, str):
        yield value
    elif isinstance(value, dict):
        for key, item in value.items():
            yield from (key, *_texts(item))
    elif isinstance(value, list):
        for item in value:
            yield from _texts(item)


def _first(error: ValidationError) -> str:
    """Return the first problem with its place in the file."""
    first = error.errors(include_url=False, include_input=False, include_context=False)[0]
    place = ".".join(str(step) for step in first["loc"])
    more = f", and {error.error_count() - 1} more" if error.error_count() > 1 else ""
    return f"{place or 'the whole'} is not as `report` writes it{more}"


# Relative difference up to which two results count as the same: rounding on another machine.
ALIKE = 1e-6

NOT_THERE = "—"

_Row = TypeVar("_Row")
_Pair = tuple[_Row | None, _Row | None]
"""A row of either revision; None where it has none."""


def changes(former: Compared, assessment: Assessment) -> Changes:
    """Return what changed from a former revision to this assessment."""
    now = compared(assessment)
    arrays = _paired(now.arrays, former.arrays, lambda row: (row.id,)).values()
    gaps = _paired(now.clearances, former.clearances, _gap_key).values()
    items = [
        *_given(former, now, assessment),
        *_one(ChangeKind.SOFTWARE, "Roofslip", former.roofslip_version, now.roofslip_version),
        *_checks(former, now),
        *_one(ChangeKind.VERDICT, "Project", former.verdict, now.verdict),
        *_results((*arrays, *gaps), UnitFormat(us_first=assessment.project.us_first)),
    ]
    return Changes(
        revision=former.input.project.revision,
        date=former.input.project.date.isoformat(),
        items=tuple(sorted(items, key=lambda item: list(ChangeKind).index(item.kind))),
        arrays=frozenset(
            row.id
            for row, old in arrays
            if row and (any(_differing(row, old)) or any(_numbers(row, old)))
        ),
        values=frozenset(
            (row.id, name) for row, old in arrays if row for name in _numbers(row, old)
        ),
        clearances=frozenset(
            number
            for number, (gap, old) in enumerate(gaps, start=1)
            if gap and any(_differing(gap, old))
        ),
    )


# What changed of them is listed with the clearances and the design displacements.
_LISTED = ("clearance", "design")


def _checks(former: Compared, now: Compared) -> Iterator[Change]:
    # Version 0.3 wrote none.
    if "checks" not in former.model_fields_set:
        return
    before, after = ([row for row in of.checks if row.id not in _LISTED] for of in (former, now))
    text = "{row.found_text}: {row.verdict}"
    yield from _rows(ChangeKind.REQUIREMENT, before, after, "{row.subject}, {row.title}", text)


def with_reissue(assessment: Assessment, former: Compared) -> Assessment:
    """Return an assessment with a condition where the same revision had other inputs before."""
    issue, then = assessment.project.project, former.input.project
    # One revision with two contents: nobody can tell later which of them was sealed.
    is_same = issue.revision.casefold() == then.revision.casefold()
    if not (is_same and any(_given(former, compared(assessment), assessment))):
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


def _given(former: Compared, now: Compared, assessment: Assessment) -> Iterator[Change]:
    """Yield what changed of what the results follow from."""
    yield from _one(ChangeKind.RULES, "Rule set", former.rule_set, now.rule_set)
    yield from _inputs(former, assessment, assessment.project.us_first)
    records = former.records, now.records, "{row.motion} {row.component}"
    yield from _rows(ChangeKind.RECORD, *records, "{row.name}, SHA-256 {row.sha256}")
    # Earlier versions did not write theirs.
    if "documents" in former.model_fields_set:
        documents = former.documents, now.documents, "{row.label}"
        yield from _rows(ChangeKind.DOCUMENT, *documents, "{row.path}, SHA-256 {row.sha256}")


def _one(kind: ChangeKind, title: str, before: str, now: str, cell: str = "") -> Iterator[Change]:
    if before != now:
        yield Change(kind=kind, title=title, before=before, now=now, cell=cell)


def _paired(
    rows: Iterable[_Row], others: Iterable[_Row], key: Callable[[_Row], tuple[str, ...]]
) -> Mapping[tuple[str, ...], _Pair[_Row]]:
    """Return the rows of two revisions by key; equal keys are numbered."""
    mine, other = (_keyed(each, key) for each in (rows, others))
    return {name: (mine.get(name), other.get(name)) for name in mine | other}


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


def _inputs(former: Compared, assessment: Assessment, us_first: bool) -> Iterator[Change]:
    for section in SECTIONS:
        now, before = (getattr(data, section.key) for data in (assessment.project, former.input))
        rows = _paired(now, before, _row_key) if section.is_table else {(): (now, before)}
        for index, (key, (row, old)) in enumerate(rows.items()):
            name, cells = _name(section, key), _cells(section, index, assessment)
            if row is None:
                yield _input(name, "given", "removed", "")
            elif old is None:
                yield _input(name, NOT_THERE, "added", next(filter(None, cells.values()), ""))
            else:
                yield from _fields(name, old, row, cells, us_first)


def _input(title: str, before: str, now: str, cell: str) -> Change:
    return Change(kind=ChangeKind.INPUT, title=title, before=before, now=now, cell=cell)


def _cells(section: SheetSection, index: int, assessment: Assessment) -> Mapping[Entry, str]:
    """Return the cell of each field of a row; empty for one that is not on the sheet."""
    # What a confirmation covers is filled in by `report`: it is no input of an engineer.
    addresses = assessment.sheet.addresses
    return {
        entry: addresses.get(Place(section.key, index, entry.name), "")
        for entry in section.entries
        if entry.name not in COVERED
    }


def _row_key(row: Any) -> tuple[str, ...]:
    """Return what identifies a row of a table."""
    if hasattr(row, "id"):
        return (row.id,)
    if hasattr(row, "object"):
        return _gap_key(row)
    # Rows of tables without any of them count from the first.
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
            title = f"{name}: {entry.heading}" if name else entry.heading
            shown = [_shown(entry, value, us_first) for value in (before, now)]
            yield _input(title, shown[0], shown[1], cell)


def _same(before: object, now: object) -> bool:
    """Whether two inputs are equal."""
    if isinstance(before, float) and isinstance(now, float):
        # Feet and meters of one length differ in the last bit.
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
        return f"{value:.8g} {entry.unit}".rstrip()
    return str(value)


def _rows(
    kind: ChangeKind, before: Iterable[_Row], now: Iterable[_Row], title: str, text: str
) -> Iterator[Change]:
    """Yield the rows whose text changed, by title; both are of a `row` in braces."""
    pairs = _paired(before, now, lambda row: (in_us_order(title.format(row=row)),))
    for (name, _), pair in pairs.items():
        first, second = (text.format(row=row) if row else NOT_THERE for row in pair)
        # With other primary units a text says the same in another order.
        if in_us_order(first) != in_us_order(second):
            yield from _one(kind, name.removeprefix(", "), first, second)


def _differing(row: Entity | None, old: Entity | None) -> Iterator[tuple[str, Told]]:
    """Yield the fields of a row, or of one that is new or gone, that changed."""
    either = row or old
    for name, told in marks_of(type(either), Told) if either else ():
        if not (old and row and _alike(getattr(old, name), getattr(row, name))):
            yield name, told


def _alike(before: Any, now: Any) -> bool:
    """Whether two results are the same; NaN is no value."""
    if not isinstance(now, float):
        return bool(before == now)
    # NaN is unequal to itself.
    if math.isnan(before) or math.isnan(now):
        return math.isnan(before) and math.isnan(now)
    return math.isclose(before, now, rel_tol=ALIKE)


def _numbers(row: ArrayResult, old: ArrayResult | None) -> Iterator[str]:
    """Yield the key, or the motion, of each number of an array that changed."""
    for name, _ in _differing(row, old):
        if isinstance(getattr(row, name), float):
            yield name
    peaks = {peak.motion: peak.any_m for peak in old.peaks} if old else {}
    for peak in row.peaks:
        if peak.motion not in peaks or not _alike(peaks[peak.motion], peak.any_m):
            yield peak.motion


def _results(pairs: Iterable[_Pair[Entity]], fmt: UnitFormat) -> Iterator[Change]:
    """Yield the changes that are listed of rows; those that are gone come last."""
    # The sort is stable: rows stay in the order of the workbook.
    for row, old in sorted(pairs, key=lambda pair: pair[0] is None):
        for name, told in _differing(row, old):
            if told.kind and (old or told.of_new) and (row or told.of_gone):
                title = told.title.format(row=row or old)
                yield from _one(told.kind, title, *_as_texts(old, row, name, fmt))


def _as_texts(old: Entity | None, row: Entity | None, name: str, fmt: UnitFormat) -> Sequence[str]:
    """Return a field before and now; numbers have more digits where they would print alike."""
    texts = [entity.both(name, fmt) if entity else NOT_THERE for entity in (old, row)]
    # Results that differ by more than rounding may still print alike.
    if texts[0] != texts[1]:
        return texts
    unit = " m" if name.endswith("_m") else ""
    return [f"{getattr(entity, name):.7g}{unit}" for entity in (old, row)]
