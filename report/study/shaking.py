"""What shakes a study: its motions at the roof, and the hazard curve of its site.

Owns which files a folder gives, the factor that makes the intensity of a motion one, and the forms
of a hazard curve: typed, of two columns, or of the USGS hazard tool. `report.motions` reads the
records, `solver.studies.rates` computes the rates. Read `study_motions` and `hazard_curves`.
"""

from __future__ import annotations

import csv
import math
import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from report.motions.components import Components, RecordFile, read_components
from report.motions.history import SIGNS
from report.project.model.finding import Finding
from report.project.model.motion_input import MotionInput
from report.project.model.place import Place
from report.project.read.linked_files import path_beside
from report.project.read.typed_text import separator
from report.project.workbook import SECTION
from report.study.read import StudySheet
from report.study.schema import MOST_SAMPLES, Intensity, StudyBuilding, StudyInput
from report.text.counts import numbered
from report.text.units import G_MPS2
from solver.bounds import ANNUAL_RATE, INTENSITY
from solver.building.roof import shaking_to_roof
from solver.building.structure import building_of_periods
from solver.formats.phrases import is_of_another
from solver.formats.source import open_source
from solver.model import Floats, InputError, Motion
from solver.records.measures import measures
from solver.records.record import Record, raise_any, read_only
from solver.records.spectrum import response_spectrum
from solver.studies.rates import HazardCurve

# Name of the only building where the motions are roof motions.
ROOF = "roof"

_COMPONENT = re.compile(r"(.+)-([xyz])", re.IGNORECASE)
_FIELDS = {"x": "record", "y": "transverse", "z": "vertical"}
_FOLDER = Place("study", 0, "folder")
# What lies beside records, such as what `motion suite` writes.
_NO_RECORDS = {".json", ".png", ".svg", ".pdf", ".md", ".sha256"}
# Neglected modes of a building may change the peak roof acceleration by this fraction.
_TRUNCATION = 0.05


@dataclass(frozen=True, slots=True, kw_only=True)
class StudyMotions:
    """The motions of a study."""

    buildings: tuple[str, ...]  # names; `ROOF` alone for roof motions
    motions: tuple[tuple[Motion, ...], ...]  # by building, scaled to an intensity of one
    files: tuple[RecordFile, ...]


def study_motions(sheet: StudySheet) -> StudyMotions:
    """Read the records of a study and carry ground motions through its buildings.

    Raises `InputError` with every problem of the records, by cell.
    """
    read: list[tuple[MotionInput, Components]] = []
    faults: list[Finding] = []
    for index, row in enumerate(_rows(sheet)):
        match read_components(sheet.book, index, row):
            case Components() as components:
                read.append((MotionInput(**row), components))
            case wrong:
                # A file of the folder has no cell of its own.
                if not sheet.project.motions:
                    wrong = [
                        Finding.error(_FOLDER, problem.text, problem.remedy) for problem in wrong
                    ]
                faults += wrong
    sheet.refuse(faults)
    sheet.refuse(_unlike(sheet.project, read))
    buildings = sheet.project.buildings
    by_building = tuple(
        tuple(_motion(sheet, row, components, building) for row, components in read)
        for building in buildings or (None,)
    )
    return StudyMotions(
        buildings=tuple(building.id for building in buildings) or (ROOF,),
        motions=by_building,
        files=tuple(file for _, components in read for file in components.files),
    )


def _rows(sheet: StudySheet) -> list[dict[str, Any]]:
    study = sheet.project.study
    defaults = {e.name: e.default for e in SECTION["motions"].entries if not e.is_required}
    # What the sheet Study says of all motions: a row of the sheet Motions has no columns for it.
    common = {**defaults, "units": study.units, "dt_s": study.dt_s, "polarity": study.polarity}
    listed: Sequence[Mapping[str, Any]] = [row.model_dump() for row in sheet.project.motions]
    return [{**common, **row} for row in listed or _of_files(sheet)]


def _of_files(sheet: StudySheet) -> list[dict[str, str]]:
    """Return a row for each motion of the folder."""
    name = sheet.project.study.folder.replace("\\", "/").strip("/")
    top = sheet.book.path.parent
    folder = (top / name).resolve()
    if not folder.is_relative_to(top.resolve()) or not folder.is_dir():
        sheet.refuse(
            [Finding.error(_FOLDER, f"'{name}' is no folder beside this workbook", "give one")]
        )
    groups: dict[str, dict[str, str]] = {}
    for path in sorted(folder.iterdir()):
        if path.name.startswith(".") or not path.is_file() or path.suffix in _NO_RECORDS:
            continue
        part = _COMPONENT.fullmatch(path.stem)
        motion, field = (part[1], _FIELDS[part[2].lower()]) if part else (path.stem, "record")
        # 40 letters, as an ID of the sheet has at most.
        row = groups.setdefault(motion, {"id": motion[:40], "source": f"{name}/{path.name}"})
        row[field] = f"{name}/{path.name}"
    lost = [motion for motion, row in groups.items() if "record" not in row]
    if lost or not groups:
        wrong = f"'{name}' has no record" + (f" {lost[0]}-x" if lost else "")
        sheet.refuse(
            [Finding.error(_FOLDER, wrong, "add it, or list the motions on the sheet Motions")]
        )
    return list(groups.values())


def _unlike(
    study_input: StudyInput, read: Sequence[tuple[MotionInput, Components]]
) -> Iterator[Finding]:
    """Yield motions with other components than the first, and records beyond the memory."""
    wanted = read[0][1].records.keys()
    for index, (row, components) in enumerate(read):
        if components.records.keys() != wanted:
            place = Place("motions", index, "record") if study_input.motions else _FOLDER
            yield Finding.error(
                place,
                f"motion {row.id} has {len(components.records)} components, the first "
                f"has {len(wanted)}",
                "a study compares motions with the same components",
            )
    samples = sum(r.a_mps2.size for _, c in read for r in c.records.values())
    samples *= max(1, len(study_input.buildings))
    if samples > MOST_SAMPLES:
        place = Place("motions") if study_input.motions else _FOLDER
        yield Finding.error(
            place, f"the records have {samples:,} samples in all", f"give at most {MOST_SAMPLES:,}"
        )


def _motion(
    sheet: StudySheet, row: MotionInput, components: Components, building: StudyBuilding | None
) -> Motion:
    a = {field: record.a_mps2 for field, record in components.records.items()}
    dt_s = components.records["record"].dt_s
    if building is not None:
        horizontal = [field for field in a if field != "vertical"]
        shaking = shaking_to_roof(
            [a[field] for field in horizontal],
            a.get("vertical", np.empty(0)),
            dt_s,
            [_building(building)] * len(horizontal),
            share=_TRUNCATION,
        )
        dt_s, roof = shaking.dt_s, shaking.horizontal
        a = {field: component.a_mps2 for field, component in zip(horizontal, roof, strict=True)}
        a |= {"vertical": shaking.vertical_mps2}
    at_roof = Record(name=row.id, dt_s=dt_s, a_mps2=a["record"])
    unit = _intensity(sheet.project, components.records["record"], at_roof)
    if not (unit > 0.0 and math.isfinite(unit)):
        place = _FOLDER if not sheet.project.motions else Place("motions")
        sheet.refuse([Finding.error(place, f"motion {row.id} is all zeros and has no intensity")])
    return Motion(
        id=row.id,
        source=row.source,
        dt_s=dt_s,
        ax_mps2=read_only(a["record"]),
        ay_mps2=read_only(a.get("transverse", np.empty(0))),
        az_mps2=read_only(a.get("vertical", np.empty(0))),
        scale=1.0 / unit,
        signs=SIGNS[row.polarity],
    )


def _building(row: StudyBuilding) -> Any:
    return building_of_periods(
        [row.period_s],
        damping=(row.damping_percent / 100.0,),
        alpha0=math.inf if row.stiffness_ratio is None else row.stiffness_ratio,
        stories=row.stories,
    )


def _intensity(study_input: StudyInput, recorded: Record, at_roof: Record) -> float:
    """Return the intensity of a motion as recorded, in the unit of its measure."""
    study = study_input.study
    match study.intensity:
        case Intensity.PPV:
            return float(measures(at_roof).pgv_mps)
        case Intensity.PGA:
            return float(np.abs(recorded.a_mps2).max() / G_MPS2)
        case Intensity.SA1:
            # Of the ground where the motions are carried to the roof: the hazard is of the ground.
            spectrum = response_spectrum(recorded.a_mps2, recorded.dt_s, [1.0])
            return float(spectrum[0] / G_MPS2)
        case Intensity.S_DS:
            return float(study.s_ds_g or math.nan)
    return float(np.abs(at_roof.a_mps2).max() / G_MPS2)


MAX_BYTES = 1_000_000

# By which a file of several curves names PGA and Sa(1 s).
_NAMES: Mapping[bool, re.Pattern[str]] = {
    False: re.compile(r"\bPGA\b|peak ground", re.IGNORECASE),
    True: re.compile(r"\bSA1P0\b|\b1(\.0{1,4})?[ -]?s(ec|econd)?\b", re.IGNORECASE),
}

# What the headings of the two columns may say: another word is of another quantity or unit.
_OF_ANY = "im iml imls imt intensity measure level levels ground motion acceleration g"
_OF_INTENSITY = {
    False: f"{_OF_ANY} pga peak horizontal",
    True: f"{_OF_ANY} sa sa1 sa1p0 spectral response 1 1.0 1.00 s sec second 1s 5% damped",
}
_OF_RATE = (
    "annual mean rate rates frequency of exceedance exceedence exceeding lambda λ per yr"
    " year 1/yr 1/year 1/a yr^-1 year^-1 yr-1"
)
_WORD = re.compile(r"[^\s_\[\](),;:]+")
# In a line of text above them.
_OF_OTHERS = re.compile(
    r"\bPG[VD]\b|\bprobabilit|\breturn period|\bSa ?\( ?(?!1(?:\.0+)? ?s?\))", re.IGNORECASE
)
_MEASURE = {False: "PGA [g]", True: "Sa(1 s) [g]"}
_RATE = "annual rate [1/year] (1 / T of a return period T, -ln(1 - p) / n of p in n years)"

_TWO = "give intensity and annual rate in two columns, or the CSV of the USGS hazard tool"


def hazard_curves(sheet: StudySheet) -> tuple[HazardCurve, ...]:
    """Return the curve for the intensity of the motions; empty if none is given.

    Raises `InputError` at the cell of the file, or at the row of the table.
    """
    study_input, hazard = sheet.project, sheet.project.hazard
    if not (hazard.file or study_input.hazard_points):
        return ()
    place = Place("hazard_points")
    points = [(point.intensity, point.annual_rate) for point in study_input.hazard_points]
    try:
        if hazard.file:
            place = Place("hazard", 0, "file")
            path = path_beside(sheet.path.parent, hazard.file, MAX_BYTES, "hazard-pga.csv")
            # As the records: Excel may save a CSV as UTF-16.
            lines = open_source(path, units="", dt_s=math.nan).lines
            points = points_of(lines, is_spectral=study_input.study.intensity is Intensity.SA1)
        x, rate = _checked(points)
    except InputError as error:
        sheet.refuse([Finding.error(place, p.found, p.remedy) for p in error.parts])
        raise
    beta = study_input.study.record_beta or 0.0
    return (HazardCurve(intensity=hazard.factor * x, rate=rate, beta=beta),)


def points_of(lines: Sequence[str], *, is_spectral: bool) -> list[tuple[float, float]]:
    """Return the points of the lines of a file, intensity and annual rate.

    Raises `InputError` if it has neither, or no single curve of the measure.
    """
    mark = separator(lines)
    # Semicolons go with decimal commas, before an exponent too: 1,2E-5.
    point = "." if mark == ";" else ","
    read = [
        [cell.strip().replace(",", point) for cell in row]
        for row in csv.reader(lines, delimiter=mark)
    ]
    # A spreadsheet pads the shorter rows with blanks.
    rows = [row[: max(k for k, cell in enumerate(row) if cell) + 1] for row in read if any(row)]
    if curves := list(_saved_curves(rows)):
        names = [", ".join(name) for name, _, _ in curves]
        fits = [k for k, name in enumerate(names) if _NAMES[is_spectral].search(name)]
        if len(fits) != 1:
            found = f"has {len(fits)} curves of {_MEASURE[is_spectral]} ({'; '.join(names)})"
            raise InputError(f"{found}; keep one")
        _, x, y = curves[fits[0]]
        raise_any(_wrong_headings([x[0], y[0]], is_spectral))
        return list(zip(_numbers(x[1:]), _numbers(y[1:]), strict=True))
    columns = [_numbers(row) for row in rows]
    first = next((k for k, values in enumerate(columns) if values), len(rows))
    # What is above the first row of numbers are headings; below it nothing else may be.
    wrong = [k for k, values in enumerate(columns) if k >= first and len(values) != 2]
    if wrong or first == len(rows):
        shown = mark.join(rows[wrong[0]] if wrong else lines)[:60].strip()
        raise InputError(f"has '{shown}'; {_TWO}")
    raise_any(problem for row in rows[:first] for problem in _wrong_headings(row, is_spectral))
    return [(values[0], values[1]) for values in columns[first:]]


def _wrong_headings(row: Sequence[str], is_spectral: bool) -> Iterator[str]:
    """Yield the headings of a row, or its text, that say another quantity or unit."""
    measure = _MEASURE[is_spectral]
    if len(row) != 2 or row[0].startswith("#"):
        text = ", ".join(row)
        named = [name for name, pattern in _NAMES.items() if pattern.search(text)]
        if is_of_another(text) or _OF_OTHERS.search(text) or named == [not is_spectral]:
            yield f"has the heading '{text[:60]}'; give {measure} and {_RATE}, or delete it"
        return
    for heading, known, wanted in zip(
        row, (_OF_INTENSITY[is_spectral], _OF_RATE), (measure, _RATE), strict=True
    ):
        if not set(known.split()).issuperset(_WORD.findall(heading.casefold())):
            yield f"has the heading '{heading[:60]}'; give {wanted}"


def _saved_curves(rows: Sequence[list[str]]) -> Iterator[Sequence[list[str]]]:
    """Yield the three lines of each curve of the USGS hazard tool."""
    # It saves for each curve a line with its name, one that begins with a label and has the
    # intensities, and one with the rates (`D3SaveLineData` of nshmp-haz-ws).
    for k in range(1, len(rows) - 1):
        x, y = _numbers(rows[k][1:]), _numbers(rows[k + 1][1:])
        if len(x) > 1 and len(x) == len(y) and not (_numbers(rows[k][:1]) or _numbers(rows[k - 1])):
            yield rows[k - 1 : k + 2]


def _numbers(cells: Sequence[str]) -> list[float]:
    """Return the numbers of cells; empty unless all are."""
    try:
        return [float(cell) for cell in cells]
    except ValueError:
        return []


def _checked(points: Sequence[tuple[float, float]]) -> tuple[Floats, Floats]:
    """Return intensities and rates, without the points of rate 0 at the end."""
    x, rate = np.array(points, dtype=float).reshape(-1, 2).T
    known = int(np.count_nonzero(rate))
    if known < 2:
        raise InputError(
            f"the curve has {numbered(known, 'point')} with a rate above 0; give two or more"
        )
    fits = np.array([INTENSITY.has(each) for each in x])
    fits[:known] &= [ANNUAL_RATE.has(each) for each in rate[:known]]
    # Interpolated in logarithms, and the rates of displacements follow from its slope: both need
    # one direction.
    fits[1:] &= np.diff(x) > 0.0
    fits[1:known] &= np.diff(rate[:known]) < 0.0
    if not fits.all():
        at = int(np.flatnonzero(~fits)[0])
        raise InputError(
            f"point {at + 1} of the curve is {x[at]:g} at {rate[at]:g} a year; give intensities"
            f" that increase, {INTENSITY.words}, and rates that decrease, {ANNUAL_RATE.words} but"
            " for the last ones, which may be 0"
        )
    return x[:known], rate[:known]
