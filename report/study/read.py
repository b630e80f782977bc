"""Reads a study workbook: its values, or every error with its cell.

Runs nothing and reads no records (`motions` does). Read `read_study`.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np

from report.sheet.reading.archive import OpenBook, open_book
from report.sheet.reading.calculated import not_calculated
from report.sheet.reading.locate import is_absent
from report.sheet.reading.read import Gathered, gather, models, refuse
from report.sheet.reading.unseen import Unseen, unseen, warnings
from report.sheet.schema import RecordedAt
from report.sheet.schema.fields import Draft, Finding, Place
from report.study.schema import (
    MOST_CASES,
    MOST_VALUES,
    SECTIONS,
    STUDY,
    Intensity,
    Mat,
    Sampling,
    Study,
    StudyArray,
    StudyBuilding,
    StudyMotion,
    values,
)
from solver.model import InputError
from solver.studies.uncertainty import Spread, spread_of_tests

HOW = (
    f"give numbers that increase, at most {MOST_VALUES}, with a blank after each comma, such as"
    " 0, 1, 2.5; or 0 to 7 by 0.5"
)


@dataclass(frozen=True, kw_only=True)
class StudyInput:
    """The complete input of a study workbook."""

    study: Study
    mats: tuple[Mat, ...] = ()
    study_arrays: tuple[StudyArray, ...] = ()
    motions: tuple[StudyMotion, ...] = ()
    buildings: tuple[StudyBuilding, ...] = ()

    @cached_property
    def slopes_deg(self) -> tuple[float, ...]:
        """Slopes of the grid [deg]."""
        return values(self.study.slopes_deg)

    @cached_property
    def intensities(self) -> tuple[float, ...]:
        """Intensities of the grid."""
        return values(self.study.intensities)

    @cached_property
    def mus(self) -> tuple[float, ...]:
        """Friction coefficients of the grid: those listed, and those of the mats."""
        listed = values(self.study.mus) if self.study.mus else ()
        return tuple(sorted({*listed, *(self.friction(mat.id).center for mat in self.mats)}))

    def friction(self, mat_id: str) -> Spread:
        """Return the distribution of the friction coefficient of a mat."""
        mat = self._mat(mat_id)
        tests = tested(mat.tested)
        if not tests:
            return Spread(center=float(mat.mu or 0.0))
        spread = spread_of_tests(tests)
        return Spread(center=mat.mu or float(f"{spread.center:.6g}"), beta=spread.beta)

    def tests(self, mat_id: str) -> tuple[float, ...]:
        """Return the tested values of a mat, or its coefficient alone."""
        mat = self._mat(mat_id)
        return tested(mat.tested) or (float(mat.mu or 0.0),)

    def _mat(self, mat_id: str) -> Mat:
        return next(row for row in self.mats if row.id.casefold() == mat_id.casefold())


def tested(text: str) -> tuple[float, ...]:
    """Return tested values in any order; empty if they are none."""
    parts = [part.strip() for part in text.replace(";", ", ").split(", ") if part.strip()]
    try:
        return tuple(float(part) for part in parts)
    except ValueError:
        return ()


@dataclass(frozen=True, kw_only=True)
class StudySheet:
    """A study workbook as read, without errors of its own.

    Attributes
    ----------
    gathered : Gathered
        For the addresses of the cells.
    unseen : tuple of Unseen
        What is read and kept from sight.
    """

    book: OpenBook
    gathered: Gathered
    unseen: tuple[Unseen, ...]

    @cached_property
    def input(self) -> StudyInput:
        """The input, validated."""
        return StudyInput(**models(self.gathered.draft, SECTIONS))

    def warnings(self, others: Iterable[Unseen] = ()) -> Iterator[tuple[str, str]]:
        """Yield cell and text of each warning, with those on what else is kept from sight."""
        found = [
            *warnings([*self.unseen, *others]),
            *not_calculated(self.book, self.gathered.used, Place(STUDY.key)),
        ]
        for finding in found:
            yield finding.cell or self.gathered.where(finding.place), finding.text

    def refuse(self, faults: Iterable[Finding]) -> None:
        """Raise the problems of single cells together with faults, if there are any."""
        located = [(one.place, one.problem(self.gathered.where(one.place))) for one in faults]
        refuse([*self.gathered.problems, *located], SECTIONS)


def read_study(path: Path) -> StudySheet:
    """Read the study workbook at a path, or `input.xlsx` in a folder.

    Raises
    ------
    InputError
        If it is not a study workbook, or with every problem by its cell.
    """
    book = open_book(path)
    if is_absent(book, STUDY):
        raise InputError(
            f"{book.path}: has no sheet {STUDY.sheet}; write a study workbook with: "
            "roofslip new DIR --study"
        )
    gathered = gather(book, SECTIONS)
    sheet = StudySheet(book=book, gathered=gathered, unseen=unseen(book, gathered.used))
    sheet.refuse(_faults(gathered.draft))
    return sheet


def _faults(draft: Draft) -> Iterator[Finding]:
    """Yield errors of the workbook that the cells alone do not show."""
    study = draft["study"][0] if draft["study"] else {}
    mats = draft["mats"]
    yield from _axis(study, "slopes_deg", "slopes", lambda v: 0.0 <= v <= 45.0, "from 0 to 45")
    yield from _axis(
        study, "intensities", "intensities", lambda v: 0.0 < v <= 100.0, "above 0, to 100"
    )
    if study.get("mus"):
        yield from _axis(
            study, "mus", "friction coefficients", lambda v: 0.0 < v <= 2.0, "above 0, to 2"
        )
    elif "mus" in study and not mats:
        yield _at("mus", "friction coefficients are missing and there is no mat", "give either")
    yield from _about_size(study, mats, draft["buildings"])
    yield from _about_intensity(study)
    yield from _about_dispersion(study)
    yield from _about_motions(study, draft)
    for section in ("mats", "study_arrays", "motions", "buildings"):
        yield from _repeated(draft, section)
    for row, mat in enumerate(mats):
        yield from _about_mat(row, mat)
    yield from _about_arrays(study, draft)


def _at(field: str, found: str, remedy: str = "") -> Finding:
    return Finding.error(Place("study", 0, field), found, remedy)


def _axis(
    study: Any, field: str, name: str, fits: Callable[[float], bool], allowed: str
) -> Iterator[Finding]:
    if field not in study:
        return
    text = str(study[field])
    found = values(text)
    if not found:
        yield _at(field, f"{name} are '{text[:60]}'", HOW)
    elif wrong := [v for v in found if not (np.isfinite(v) and fits(v))]:
        yield _at(field, f"{name} have {wrong[0]:g}", f"give numbers {allowed}")


def _about_size(study: Any, mats: Any, buildings: Any) -> Iterator[Finding]:
    counts = [len(values(str(study.get(f) or ""))) for f in ("slopes_deg", "intensities", "mus")]
    cases = max(counts[0], 1) * max(counts[1], 1) * (counts[2] + len(mats)) * max(len(buildings), 1)
    if cases > MOST_CASES:
        yield _at(
            "intensities", f"make {cases:,} cases with the other lists", f"at most {MOST_CASES:,}"
        )


def _about_intensity(study: Any) -> Iterator[Finding]:
    kind = study.get("intensity")
    if kind is Intensity.S_DS and "s_ds_g" in study and study["s_ds_g"] is None:
        yield _at("s_ds_g", "S_DS of the motions is missing", "the intensity measure needs it")
    if kind is Intensity.PGA and study.get("recorded_at") is RecordedAt.ROOF:
        yield _at("intensity", "is PGA, but the motions are roof motions", "choose PPA or PPV")


def _about_dispersion(study: Any) -> Iterator[Finding]:
    if "record_source" not in study or "record_beta" not in study:
        return
    if study["record_beta"] is not None and not study["record_source"]:
        yield _at("record_source", "the record-to-record dispersion needs its source", "give it")
    if study["record_source"] and study["record_beta"] is None:
        yield _at(
            "record_beta", "a source is given without the dispersion", "give it, or clear both"
        )


def _about_motions(study: Any, draft: Draft) -> Iterator[Finding]:
    if "folder" in study and bool(study["folder"]) == bool(draft["motions"]):
        if study["folder"]:
            yield _at("folder", "a folder is named and the sheet Motions has rows", "keep one")
        else:
            yield _at("folder", "no folder and no row on the sheet Motions")
    is_ground = study.get("recorded_at") is RecordedAt.GROUND
    if is_ground and not draft["buildings"]:
        wanted = "fill in a row"
        yield Finding.error(Place("buildings"), "ground motions need at least one building", wanted)
    if "recorded_at" in study and not is_ground and draft["buildings"]:
        yield Finding.error(
            Place("buildings", 0, "id"),
            "a building is given, but the motions are roof motions",
            "clear the row, or set Recorded at to ground",
        )


def _repeated(draft: Draft, section: str) -> Iterator[Finding]:
    seen: set[str] = set()
    for row, fields in enumerate(draft[section]):
        name = str(fields.get("id", "")).casefold()
        if name and name in seen:
            yield Finding.error(
                Place(section, row, "id"), f"ID '{fields['id']}' appears twice", "rename one"
            )
        seen.add(name)


def _about_mat(row: int, mat: Any) -> Iterator[Finding]:
    text = str(mat.get("tested") or "")
    found = tested(text)
    if text and (len(found) < 3 or not all(0.0 < v <= 2.0 for v in found)):
        yield Finding.error(
            Place("mats", row, "tested"),
            f"tested values are '{text[:60]}'",
            "give three or more numbers above 0, to 2, with a blank after each comma",
        )
    if "mu" in mat and mat["mu"] is None and not text:
        yield Finding.error(
            Place("mats", row, "mu"),
            "friction coefficient and tested values are missing",
            "give one",
        )


def _about_arrays(study: Any, draft: Draft) -> Iterator[Finding]:
    names = {str(mat.get("id", "")).casefold() for mat in draft["mats"]}
    for row, array in enumerate(draft["study_arrays"]):
        mat = str(array.get("mat", ""))
        if mat and mat.casefold() not in names:
            yield Finding.error(
                Place("study_arrays", row, "mat"), f"mat '{mat}' is not on the sheet Mats", "add it"
            )
    if study.get("site_intensity") and not draft["study_arrays"]:
        yield _at(
            "site_intensity", "is given, but no array is", "fill in a row of the sheet Arrays"
        )
    if (
        study.get("sampling") is Sampling.ALL_COMBINATIONS
        and study.get("site_intensity")
        and study.get("intensity_beta")
    ):
        yield _at(
            "intensity_beta",
            "all combinations take the median intensity",
            "choose Latin hypercube, or leave it blank",
        )
