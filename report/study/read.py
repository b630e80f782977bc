"""Reads a study workbook: its values, or every error with its cell.

Runs nothing and reads no records (`motions` does). Read `read_study`.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np

from report.sheet.checking.drafts import column, repeated
from report.sheet.reading.archive import open_book
from report.sheet.reading.locate import is_absent
from report.sheet.reading.read import SheetOf, read_as
from report.sheet.schema import RecordedAt
from report.sheet.schema.fields import Draft, Finding, Place, Where, sections_of
from report.study.schema import (
    MOST_CASES,
    MOST_VALUES,
    Intensity,
    Sampling,
    StudyInput,
    tested,
    values,
)
from solver.model import InputError

HOW = (
    f"give numbers that increase, at most {MOST_VALUES}, with a blank after each comma, such as"
    " 0, 1, 2.5; or 0 to 7 by 0.5"
)


StudySheet = SheetOf[StudyInput]
"""A study workbook as data."""


def read_study(path: Path) -> StudySheet:
    """Read the study workbook at a path, or `input.xlsx` in a folder.

    Raises
    ------
    InputError
        If it is not a study workbook, or with every problem by its cell.
    """
    book = open_book(path)
    study = sections_of(StudyInput)[0]
    if is_absent(book, study):
        raise InputError(
            f"{book.path}: has no sheet {study.sheet}; write a study workbook with: "
            "roofslip new DIR --study"
        )
    sheet = read_as(StudyInput, book, _faults)
    sheet.refuse(())
    return sheet


def _faults(draft: Draft, where: Where) -> Iterator[Finding]:
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
        for place, name, _ in repeated(column(draft, (section,), "id"), str.casefold):
            yield Finding.error(place, f"ID '{name}' appears twice", "rename one")
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
    names = {name.casefold() for _, name in column(draft, ("mats",), "id")}
    for place, mat in column(draft, ("study_arrays",), "mat"):
        if mat.casefold() not in names:
            yield Finding.error(place, f"mat '{mat}' is not on the sheet Mats", "add it")
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
