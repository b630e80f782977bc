"""What a workbook has that may be deleted from it, and what a verdict comes to without it.

A deletion clears cells of the workbook, which is then read, and assessed, as a file would be.
Geometry, arrays and objects are no evidence, nor is a choice: a rule set, an override, a statistic,
whether there is a peer review, a model of linked blocks that is asked about. Read `improved`.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from openpyxl.utils import coordinate_to_tuple

from report.assessment.assess import assess
from report.assessment.checks.check import Check
from report.assessment.project import Assessment
from report.assessment.verdict import PLAN_ROW, Verdict
from report.motions.prepare import Shaking, prepare
from report.project.model.place import Place
from report.project.read.archive import OpenBook, open_book
from report.project.read.read import Sheet, read_book
from report.project.workbook import SECTION
from report.text.counts import grouped_by
from solver.model import InputError

_NO_EVIDENCE = {
    "arrays": {"modules", "module_weight_n", "ballast_n", "weight_n", "base_m", "i_p", "mu_fast",
               "mu_rate_s_per_m", "place_from", "x_from_m", "x_to_m", "y_from_m", "y_to_m"},
    "site": {"rule_set", "edition_name", "hazard", "building_code", "building_code_year"},
    "options": {"statistic", "peer_reviewed"},
}  # fmt: skip
_APART = {"objects", "outlines", "layers", "roof", "overrides", "links"}
_WITH_MOTIONS = {"motions", "spectrum", "site", "building", "target"}


@dataclass(frozen=True)
class Deletion:
    """Cells that are cleared together, each by its place; `what` they are."""

    what: str
    places: Sequence[Place]


@dataclass(frozen=True)
class Deletable:
    """A workbook in memory, as read, and its assessment."""

    book: OpenBook
    sheet: Sheet
    shaking: Shaking
    done: Assessment

    @classmethod
    def of(cls, path: Path) -> Deletable:
        """Return the workbook at a path."""
        book = open_book(path)
        sheet = read_book(book)
        shaking = prepare(sheet)
        return cls(book, sheet, shaking, assess(sheet, shaking))

    def deletions(self) -> Sequence[Deletion]:
        """Return each optional cell, each row, and runs of friction tests by what they share."""
        filled = [place for place in self.sheet.addresses if self._is_evidence(place)]
        cells = [
            Deletion(f"{place.section} {place.row + 1} {place.field}", [place])
            for place in filled
            if not SECTION[place.section].entry(place.field).is_required
        ]
        tables = [place for place in filled if SECTION[place.section].is_table]
        tables = [place for place in tables if place.section != "arrays"]
        rows = [
            Deletion(f"{key[0]} {key[1] + 1}", places)
            for key, places in grouped_by(tables, lambda place: place[:2]).items()
        ]
        return [*cells, *rows, *self._runs([each for each in tables if each[0] == "friction_runs"])]

    def _runs(self, places: Sequence[Place]) -> Iterator[Deletion]:
        runs = self.sheet.project.friction_runs
        for field in ("surface", "velocity_mps"):
            groups = grouped_by(places, lambda place, by=field: getattr(runs[place.row], by))
            for value, same in groups.items():
                yield Deletion(f"runs of {field} {value}", same)
                if others := [place for place in places if place not in same]:
                    yield Deletion(f"runs but of {field} {value}", others)
        if places:
            yield Deletion("all runs", places)

    def _is_evidence(self, place: Place) -> bool:
        if not place.field or place.section in _APART:
            return False
        if place.field in _NO_EVIDENCE.get(place.section, ()):
            return False
        title, row, column = self._at(place)
        at = self.book.sheets[title].cell(row, column)
        return at.value is not None and not self.book.formula(title, at.coordinate)

    def _at(self, place: Place) -> tuple[str, int, int]:
        title, coordinate = self.sheet.addresses[place].rsplit("!", 1)
        return title.strip("'"), *coordinate_to_tuple(coordinate)

    def without(self, deletion: Deletion) -> Assessment | None:
        """Return the assessment of the workbook without some cells; None where it is refused."""
        cells = [
            self.book.sheets[title].cell(row, column)
            for title, row, column in map(self._at, deletion.places)
        ]
        values = [cell.value for cell in cells]
        try:
            for cell in cells:
                cell.value = None
            sheet = read_book(replace(self.book, labels={}))
            if {place.section for place in deletion.places} & _WITH_MOTIONS:
                return assess(sheet, prepare(sheet))
            known = self.done.acceptance
            return assess(sheet, self.shaking, self.done.runs, acceptance=known)
        except InputError:
            return None
        finally:
            for cell, value in zip(cells, values, strict=True):
                cell.value = value


_BADNESS = {Verdict.CONDITION: 1, Verdict.CONDITIONS: 1, Verdict.NONE: 2, Verdict.NG: 2}


def improved(before: Assessment, after: Assessment, deletion: Deletion) -> Iterator[str]:
    """Yield each verdict that is milder after a deletion, and each failing row that is gone.

    A value that failed is a condition where it is not given any more, and so is what it was part
    of. Rows of a route that is not taken any more are notes.
    """
    deleted = set(deletion.places)
    failed = any(row.verdict is Verdict.NG and deleted & set(row.places) for row in before.checks)
    new, old = _verdicts(after), _verdicts(before)
    for key, was in old.items():
        if key in new and _is_milder(was, new[key], failed):
            yield f"{' '.join(key)}: {was} to {new[key]}"
    taken = [[(item.id, item.route) for item in done.arrays] for done in (before, after)]
    for row in (check for check in before.checks if check.is_open):
        left = [
            each
            for each in after.checks
            if _kind(each) == _kind(row) and _subject(each) == _subject(row)
        ]
        left = [each for each in left if each.title == row.title] or left
        now = max((each.verdict for each in left), key=_badness, default=Verdict.OK)
        is_note = now is Verdict.NOTE and taken[0] != taken[1]
        if not is_note and _is_milder(row.verdict, now, bool(deleted & set(row.places))):
            name = f"{row.id} {row.subject} {row.title}"
            yield f"{name}: {row.verdict} to {now.value if left else 'gone'}"


def _kind(row: Check) -> str:
    # A width of a fire pathway, and whether there is one; a clearance, and a gap without one.
    return {"fire_pathways": "fire_pathway", "clearance": PLAN_ROW}.get(row.id, row.id)


def _subject(row: Check) -> str:
    # Whether there is one is asked of an array, for all its clearances.
    return row.arrays[0] if _kind(row) == "fire_pathway" else row.subject


def _is_milder(was: Verdict, now: Verdict, is_given_no_more: bool) -> bool:
    if is_given_no_more and (_badness(was), _badness(now)) == (2, 1):
        return False
    return _badness(now) < _badness(was)


def _badness(verdict: Verdict) -> int:
    return _BADNESS.get(verdict, 0)


def _verdicts(done: Assessment) -> dict[tuple[str, ...], Verdict]:
    """Return the verdicts on the project, its arrays and its clearances."""
    return {
        ("project",): done.verdict,
        **{("array", item.id): done.array_verdict(item) for item in done.arrays},
        **{("clearance", *gap.between, gap.clearance.direction): gap.verdict
           for gap in done.clearances},
    }  # fmt: skip
