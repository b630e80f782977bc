"""Reads a study workbook: its values, or every error with its cell.

Runs nothing and reads no records (`motions` does). Read `read_study`.

Writes the study workbook from its schema, blank or filled in. Read `write_study`.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from pathlib import Path

from report.project.model.choices import RecordedAt, UnitsFirst
from report.project.model.finding import Finding
from report.project.model.input_rows import InputRow, Inputs, Place, Where, column, repeated
from report.project.read.archive import open_book
from report.project.read.locate import is_absent
from report.project.read.read import read_as
from report.project.read.workbook_data import SheetOf
from report.project.write.template import book_of, saved
from report.study.study_input import (
    MOST_CASES,
    MOST_VALUES,
    Intensity,
    Sampling,
    StudyInput,
    tested,
    values,
)
from report.study.workbook import HAZARD, STUDY, STUDY_SECTIONS
from solver.errors import InputError
from solver.file_writing import write_whole

HOW = (
    f"enter numbers that increase, at most {MOST_VALUES}, with a blank after each comma, such as"
    " 0, 1, 2.5; or 0 to 7 by 0.5"
)

# A study workbook as data.
StudySheet = SheetOf[StudyInput]


def read_study(path: Path) -> StudySheet:
    """Read the study workbook at a path, or `input.xlsx` in a folder.

    Raises `InputError` if it is not a study workbook, or with every problem by its cell.
    """
    book = open_book(path)
    if is_absent(book, STUDY):
        raise InputError(
            f"{book.path}: has no worksheet {STUDY.sheet}; write a study workbook with: "
            "roofslip new DIR --study"
        )
    sheet = read_as(StudyInput, STUDY_SECTIONS, book, _faults)
    sheet.refuse(())
    return sheet


# Lists of the Study worksheet: in words, and what their numbers may be. NaN fits none.
_AXES: Mapping[str, tuple[str, Callable[[float], bool], str]] = {
    "slopes_deg": ("slopes", lambda v: 0.0 <= v <= 45.0, "from 0 to 45"),
    "intensities": ("intensities", lambda v: 0.0 < v <= 100.0, "above 0, to 100"),
    "mus": ("friction coefficients", lambda v: 0.0 < v <= 2.0, "above 0, to 2"),
}


def _faults(inputs: Inputs, where: Where) -> Iterator[Finding]:
    """Yield errors of the workbook that the cells alone do not show."""
    # A cell at fault is no key of its row: it is told already, and nothing more is said of it.
    study = inputs["study"][0] if inputs["study"] else {}
    for field, (name, fits, allowed) in _AXES.items():
        if text := study.get(field):
            numbers = values(text)
            if not numbers:
                yield _at(field, f"{name} are '{text[:60]}'", HOW)
            elif wrong := [value for value in numbers if not fits(value)]:
                yield _at(field, f"{name} have {wrong[0]:g}", f"enter numbers {allowed}")
    # Each mat has a coefficient, by which the curves can be drawn as well.
    if study.get("mus") == "" and not inputs["mats"]:
        yield _at("mus", "friction coefficients are missing, and no mat is listed", "enter either")
    yield from _about_study(study, inputs)
    yield from _about_motions(study, inputs)
    for section in ("mats", "study_arrays", "motions", "buildings"):
        for place, name, first in repeated(column(inputs, (section,), "id"), str.casefold):
            yield Finding.error(
                place, f"ID is '{name}', already used at {where(first)}", "enter a unique ID"
            )
    for row, mat in enumerate(inputs["mats"]):
        yield from _about_mat(row, mat)
    yield from _about_arrays(study, inputs)
    yield from _about_hazard(study, inputs)


def _at(field: str, problem: str, remedy: str = "") -> Finding:
    return Finding.error(Place("study", 0, field), problem, remedy)


def _about_study(study: InputRow, inputs: Inputs) -> Iterator[Finding]:
    """Yield too many cases, and what the intensity and the dispersion lack."""
    slopes, levels, mus = (len(values(study.get(field) or "")) for field in _AXES)
    # Before anything is made of it: the grid is in memory whole.
    of_grid = max(slopes, 1) * max(levels, 1) * (mus + len(inputs["mats"]))
    cases = of_grid * max(len(inputs["buildings"]), 1)
    if cases > MOST_CASES:
        text = f"make {cases:,} cases with the other lists"
        yield _at("intensities", text, f"at most {MOST_CASES:,}")
    kind = study.get("intensity")
    if kind is Intensity.S_DS and "s_ds_g" in study and study["s_ds_g"] is None:
        yield _at("s_ds_g", "S_DS of the motions is missing", "the intensity measure needs it")
    # A roof record has no peak of the ground.
    if kind is Intensity.PGA and study.get("recorded_at") is RecordedAt.ROOF:
        yield _at("intensity", "is PGA, but the motions are roof motions", "choose PPA or PPV")
    if study.keys() >= {"record_source", "record_beta"}:
        source, beta = study["record_source"], study["record_beta"]
        if beta is not None and not source:
            text = "the record-to-record dispersion needs its source"
            yield _at("record_source", text, "enter it")
        if source and beta is None:
            text = "a source is entered without the dispersion"
            yield _at("record_beta", text, "enter it, or clear both")


def _about_motions(study: InputRow, inputs: Inputs) -> Iterator[Finding]:
    if "folder" in study and bool(study["folder"]) == bool(inputs["motions"]):
        if study["folder"]:
            yield _at("folder", "a folder is named and the Motions worksheet has rows", "keep one")
        else:
            yield _at("folder", "no motions are entered", "enter a folder, or rows on Motions")
    is_ground = study.get("recorded_at") is RecordedAt.GROUND
    if is_ground and not inputs["buildings"]:
        text = "ground motions need at least one building"
        yield Finding.error(Place("buildings"), text, "fill in a row")
    if "recorded_at" in study and not is_ground and inputs["buildings"]:
        text = "a building is entered, but the motions are roof motions"
        accepted = "clear the row, or set Recorded at to ground"
        yield Finding.error(Place("buildings", 0, "id"), text, accepted)


def _about_mat(row: int, mat: InputRow) -> Iterator[Finding]:
    text = mat.get("tested") or ""
    series = tested(text)
    if text and (len(series) < 3 or not all(0.0 < v <= 2.0 for v in series)):
        accepted = "enter three or more numbers above 0, to 2, with a blank after each comma"
        place = Place("mats", row, "tested")
        yield Finding.error(place, f"tested values are '{text[:60]}'", accepted)
    if "mu" in mat and mat["mu"] is None and not text:
        missing = "friction coefficient and tested values are missing"
        yield Finding.error(Place("mats", row, "mu"), missing, "enter one")


def _about_arrays(study: InputRow, inputs: Inputs) -> Iterator[Finding]:
    names = {name.casefold() for _, name in column(inputs, ("mats",), "id")}
    for place, mat in column(inputs, ("study_arrays", "friction_runs"), "mat"):
        if mat.casefold() not in names:
            yield Finding.error(place, f"mat '{mat}' is not on the Mats worksheet", "add it")
    if study.get("site_intensity") and not inputs["study_arrays"]:
        accepted = "fill in a row of the Arrays worksheet"
        yield _at("site_intensity", "is entered, but no array is", accepted)
    # Combinations are of tested values, and an intensity has none.
    is_combined = study.get("sampling") is Sampling.ALL_COMBINATIONS
    if is_combined and study.get("site_intensity") and study.get("intensity_beta"):
        text = "all combinations use the median intensity"
        yield _at("intensity_beta", text, "choose Latin hypercube, or leave it blank")


_OF_CURVE = ("site", "source", "edition", "vs30_mps", "site_vs30_mps")


def _about_hazard(study: InputRow, inputs: Inputs) -> Iterator[Finding]:
    """Yield what a hazard curve lacks, and what is given without one."""
    hazard = inputs["hazard"][0] if inputs["hazard"] else {}
    labels = {entry.name: entry.spoken for entry in HAZARD.entries}

    def at(field: str, problem: str, remedy: str) -> Finding:
        return Finding.error(Place("hazard", 0, field), f"{labels[field]} {problem}", remedy)

    has_points = bool(inputs["hazard_points"])
    if not (hazard.get("file") or has_points):
        if alone := [name for name, value in hazard.items() if value not in ("", None)]:
            yield at(alone[0], "is entered without a hazard curve", "enter a curve, or clear it")
        return
    if hazard.get("file") and has_points:
        yield at("file", "is named and the table of the curve has rows", "keep one")
    for field in _OF_CURVE:
        if field in hazard and hazard[field] in ("", None):
            yield at(field, "is missing", "a hazard curve needs it")
    is_ground = study.get("recorded_at") is RecordedAt.GROUND
    # Of another Vs30 the curve needs a factor: none is assumed, since soils raise and lower.
    is_elsewhere = hazard.get("vs30_mps") != hazard.get("site_vs30_mps")
    for where, is_needed in (("site", is_elsewhere), ("roof", not is_ground)):
        factor, basis = f"{where}_factor", f"{where}_basis"
        has_factor, has_basis = (hazard.get(name) not in ("", None) for name in (factor, basis))
        if is_needed and not has_factor and factor in hazard:
            yield at(factor, "is missing", f"{_NEEDED[where]}; there is no default")
        elif has_factor and not is_needed:
            yield at(factor, "is entered", f"clear it: {_NEEDLESS[where]}")
        if has_factor and not has_basis and basis in hazard:
            yield at(basis, "is missing", "the factor needs it")
    measures = (Intensity.PGA, Intensity.SA1) if is_ground else (Intensity.PPA, Intensity.SA1)
    if study.get("intensity") not in (*measures, None):
        accepted = " or ".join(measure.letters for measure in measures)
        yield _at("intensity", "has no hazard curve", f"choose {accepted}, or clear the hazard")
    if not inputs["study_arrays"]:
        yield at("file", "is entered, but no array is", "fill in a row of the Arrays worksheet")


_NEEDED = {
    "site": "the Vs30 of the curve differs from that of the site",
    "roof": "the motions are roof motions",
}
_NEEDLESS = {
    "site": "the curve is for the Vs30 of the site",
    "roof": "the ground motions are transferred through the buildings",
}


def write_study(path: Path, *, units: UnitsFirst, example: StudyInput | None = None) -> None:
    """Write or replace a study workbook, with the values of a study or blank but for defaults."""
    book, _ = book_of(STUDY_SECTIONS, STUDY.sheet, units, example)
    write_whole(path, saved(book, units))
