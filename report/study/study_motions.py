"""The motions of a study at the roof.

A record with a peak of 0.40 g at the roof has the factor 1/0.40 = 2.5: at a PPA of 0.60 g it is run
at 1.5 times its size.

Owns which files a folder gives, and the factor that makes the intensity of a motion one;
`report.motions` reads the records. Read `study_motions`.
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import chain
from typing import Any

import numpy as np

from report.motions.components import Components, RecordFile, read_components
from report.motions.history import SIGNS
from report.project.model.finding import Finding
from report.project.model.input_rows import Place
from report.project.model.motion_input import MotionInput
from report.project.workbook import SECTION
from report.study.read_study import StudySheet
from report.study.study_input import MOST_SAMPLES, Intensity, StudyBuilding, StudyInput
from report.text.units import G_MPS2
from solver.building.roof import shaking_to_roof
from solver.building.structure import building_of_periods
from solver.model import Motion
from solver.records.measures import measures
from solver.records.record import Record, read_only
from solver.records.spectrum import response_spectrum

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
        files=tuple(chain.from_iterable(components.files for _, components in read)),
    )


def _rows(sheet: StudySheet) -> list[dict[str, Any]]:
    study = sheet.project.study
    defaults = {e.name: e.default for e in SECTION["motions"].entries if not e.is_required}
    # What the Study worksheet says of all motions: rows of Motions have no columns for it.
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
            [Finding.error(_FOLDER, f"'{name}' is not a folder next to this workbook", "enter one")]
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
        wrong = f"'{name}' contains no record" + (f" {lost[0]}-x" if lost else "")
        sheet.refuse(
            [Finding.error(_FOLDER, wrong, "add it, or list the motions on the Motions worksheet")]
        )
    return list(groups.values())


def _unlike(
    study_input: StudyInput, read: Sequence[tuple[MotionInput, Components]]
) -> Iterator[Finding]:
    """Yield motions with other components than the first, and records beyond the memory."""
    first_fields = read[0][1].records.keys()
    samples = 0
    for index, (row, components) in enumerate(read):
        samples += sum(record.a_mps2.size for record in components.records.values())
        if components.records.keys() != first_fields:
            place = Place("motions", index, "record") if study_input.motions else _FOLDER
            yield Finding.error(
                place,
                f"motion {row.id} has {len(components.records)} components, the first "
                f"has {len(first_fields)}",
                "a study compares motions with the same components",
            )
    # Each building has motions of its own, all in memory at once.
    samples *= max(1, len(study_input.buildings))
    if samples > MOST_SAMPLES:
        place = Place("motions") if study_input.motions else _FOLDER
        yield Finding.error(
            place,
            f"the records have {samples:,} samples in total",
            f"enter at most {MOST_SAMPLES:,}",
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
            # One period for both directions: a study has a family of buildings, not a building.
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
        # To an intensity of 1: a run takes its intensity as the factor.
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
