"""The shipped projects and over thirty altered copies, for properties that hold of every project.

A copy is a line of `COPIES`: the project that it is of, and what is changed in it. Only read what
`copies` gives: runs and assessments are shared.
"""

from __future__ import annotations

import datetime as dt
import shutil
from collections.abc import Callable, Mapping, Sequence
from functools import cache, partial
from pathlib import Path
from typing import Any

import scenes
from inputs import FT, INCH, LB
from places import ROOT
from report.assessment.assess import assess
from report.assessment.project import Assessment
from report.motions.prepare import prepare
from report.project.model import ProjectInput
from report.project.model.frozen import Frozen
from report.project.read.read import Sheet
from report.project.workbook import SECTION
from report.project.write.template import write_template

PSF = LB / FT**2
DAY = dt.date(2025, 11, 1)
LATER = dt.date(2027, 1, 1)
REVIEW = {
    "peer_reviewed": True, "peer_reviewer": "Reviewer of record", "peer_license": "CA S0000",
    "peer_date": DAY, "peer_letter": "peer-review.pdf",
}  # fmt: skip
CONFIRMED = {
    "by": "RG, SE", "date": DAY, "rule_set": "SEAOC PV1-2012", "edition": "ASCE 7-16",
    "code": "2022 CBC",
}  # fmt: skip


def _runs(mu: Mapping[str, float], *inches_per_s: float, count: int = 3) -> list[dict[str, object]]:
    """Return so many friction runs at each velocity and surface."""
    return [
        {"surface": surface, "number": number, "mu": mean, "velocity_mps": velocity * INCH}
        for surface, mean in mu.items()
        for velocity in inches_per_s
        for number in range(1, count + 1)
    ]


COMPLETE = _runs({"dry": 0.60, "wet": 0.52}, 1.0, 6.0)
"""Runs that show the friction of the example at its sliding velocities."""

ROWS, ALL = "rows", -1
"""Instead of changes to rows: all rows of a table. Instead of the number of a row: each row."""

Change = Mapping[Any, Any]

# In the example A1, A2 and A3 are on 0.5, 2 and 3 degrees; the clearances are A1-A2, A1-RTU-1,
# A1-NORTH with a fire pathway, A3-RTU-2, A3-PV-OLD and A3-EAST.
COPIES: Mapping[str, tuple[str, Mapping[str, Change]]] = {
    "20 stories": ("example", {"site": {"stories": 20}}),
    "high center of gravity": ("example", {"arrays": {1: {"cg_height_m": 44 * INCH}}}),
    "short clearance": ("example", {"clearances": {1: {"provided_m": 20 * INCH}}}),
    "much that is NG": (
        "example",
        {"site": {"stories": 20}, "arrays": {1: {"cg_height_m": 44 * INCH}},
         "clearances": {1: {"provided_m": 20 * INCH}}},
    ),
    "two causes": (
        "example",
        {"arrays": {ALL: {"roof_capacity_pa": 2 * PSF}},
         "clearances": {1: {"provided_m": 20 * INCH}}},
    ),
    "two causes and a slope": (
        "example",
        {"arrays": {1: {"slope_value": 8.0, "roof_capacity_pa": 2 * PSF}},
         "clearances": {1: {"provided_m": 20 * INCH}}},
    ),
    "short between arrays": ("example", {"clearances": {0: {"provided_m": 36 * INCH}}}),
    "short slack": ("example", {"arrays": {0: {"slack_m": 10 * INCH}}}),
    "small roof capacity": ("example", {"arrays": {1: {"roof_capacity_pa": 2 * PSF}}}),
    "other weight in wind design": ("example", {"arrays": {2: {"wind_weight_pa": 3 * PSF}}}),
    "weak interconnection": ("example", {"arrays": {0: {"interconnection_n": 100 * LB}}}),
    "wide fire pathway": ("example", {"clearances": {2: {"pathway_m": 90 * INCH}}}),
    "each stated value fails": (
        "example",
        {"arrays": {0: {"slack_m": 10 * INCH, "interconnection_n": 100 * LB},
                    1: {"roof_capacity_pa": 2 * PSF}, 2: {"wind_weight_pa": 3 * PSF}},
         "clearances": {2: {"pathway_m": 90 * INCH}}},
    ),
    "no stated values": (
        "example",
        {"arrays": {ALL: dict.fromkeys(
            ("slack_m", "interconnection_n", "roof_capacity_pa", "wind_weight_pa"))},
         "clearances": {2: {"pathway_m": None}}},
    ),
    "no motions": ("example", {"motions": {ROWS: []}}),
    "two motions": ("example", {"motions": {ROWS: slice(2)}}),
    "motions without vertical": ("example", {"motions": {ALL: {"vertical": None}}}),
    "friction tests deleted": ("example", {"friction_runs": {ROWS: []}}),
    "little evidence": (
        "example",
        {"site": {"hazard_printout": "", "acceptance_letter": ""},
         "friction_runs": {ROWS: [*_runs({"dry": 0.55, "wet": 0.46}, 0.1, count=1),
                                  *_runs({"dry": 0.60, "wet": 0.55}, 4.0, count=1)]}},
    ),
    "complete friction tests": ("example", {"friction_runs": {ROWS: COMPLETE}}),
    "slow friction tests": (
        "example", {"friction_runs": {ROWS: _runs({"dry": 0.60, "wet": 0.52}, 0.1)}}),
    "wet friction tests alone": ("example", {"friction_runs": {ROWS: _runs({"wet": 0.52}, 6.0)}}),
    "peer review": ("example", {"options": REVIEW}),
    "reviewer's name alone": (
        "example", {"options": {"peer_reviewed": True, "peer_reviewer": "J"}}),
    "dated later": (
        "example",
        {"site": {"hazard_date": LATER}, "friction_tests": {"date": LATER},
         "options": REVIEW | {"peer_date": LATER}},
    ),
    "overrides": (
        "example",
        {"overrides": {ROWS: [
            {"provision": "separation_fixed", "value": 0.5, "reason": "Agreed 2025-10-10"},
            {"provision": "low_profile_in", "value": 60.0, "reason": "Agreed 2025-10-10"}]},
         "options": {"statistic": "mean"}},
    ),
    "ASCE 7-16": ("example", {"site": {"rule_set": "ASCE 7-16"}}),
    "plainly OK": (
        "example",
        {"site": {"rule_set": "ASCE 7-16", "s_s_g": 0.9, "hazard_printout": "hazard.pdf"},
         "arrays": {2: {"slope_value": 2.0}}, "friction_runs": {ROWS: COMPLETE},
         "confirmation": CONFIRMED | {"rule_set": "ASCE 7-16"}},
    ),
    "too steep": ("example", {"arrays": {1: {"slope_value": 8.0}}}),
    "risk category IV": ("example", {"site": {"risk_category": "IV", "i_e": 1.5}}),
    "slides without end": ("example", {"arrays": {0: {"slope_value": 5.0, "mu": 0.08}}}),
    "linked rows": (
        "example",
        {"links": {ROWS: [{"array": "A1", "friction": "0.45, 0.50, 0.55",
                           "stiffness_n_per_m": 5000 * LB / INCH},
                          {"array": "A2", "friction": "0.20, 0.50, 0.70",
                           "stiffness_n_per_m": 5 * LB / INCH}]}},
    ),
    "clearances missing": ("example", {"clearances": {ROWS: slice(2)}}),
    "school without review": ("school", {"options": {"peer_reviewed": False}}),
    "school at half capacity": (
        "school",
        {"arrays": {ALL: {"roof_capacity_pa": 130.0, "wind_weight_pa": 260.0}},
         "friction_runs": {ROWS: slice(4)}},
    ),
    "prescriptive with more": (
        "conditions",
        {"site": {"s_1_g": 0.4, "f_v": 1.5, "fire_code_section": "2022 CFC", "jurisdiction": "X"},
         "clearances": {ALL: {"source": "drawing"}, 0: {"pathway_m": 40 * INCH}}},
    ),
    "prescriptive at the least friction": (
        "conditions", {"arrays": {ALL: {"mu": 0.41}}, "motions": {ROWS: []}}),
}  # fmt: skip


def copies() -> Sequence[tuple[str, Callable[[], Assessment]]]:
    """Return the name of each shipped project and altered copy, and what assesses it, once."""
    return [(name, partial(assessed, name)) for name in (*scenes.SHIPPED, *COPIES)]


@cache
def assessed(name: str) -> Assessment:
    """Return a project or a copy of it, assessed as its workbook would be."""
    if name not in COPIES:
        return scenes.shipped(name)
    project, changes = COPIES[name]
    former, sheet = scenes.shipped(project), _sheet(project, changes)
    if not changes.keys() & _OF_MOTIONS:
        return assess(sheet, former.shaking, former.runs, acceptance=former.acceptance)
    return assess(sheet, prepare(sheet))


def _sheet(project: str, changes: Mapping[str, Change]) -> Sheet:
    former = scenes.shipped(project)
    return former.sheet.with_(**_parts(former.project, changes))


# What the motions at the roof or their targets follow from, or runs of another kind.
_OF_MOTIONS = {"motions", "site", "building", "spectrum", "target", "links"}


def _parts(data: ProjectInput, changes: Mapping[str, Change]) -> dict[str, Any]:
    """Return the changed sections, and without the records of what a confirmation covered."""
    own = {"site": "hazard_covered", "friction_tests": "tests_covered", "options": "peer_covered"}
    cleared = {key: {covered: ""} | changes.get(key, {}) for key, covered in own.items()}
    return {
        key: _section(getattr(data, key), SECTION[key].model, change)
        for key, change in {**changes, **cleared}.items()
    }


def _section(given: Any, model: type[Frozen], change: Change) -> Any:
    if isinstance(given, Frozen):
        return model.model_validate(dict(given) | change)
    rows = [dict(row) for row in given]
    if ROWS in change:
        kept = change[ROWS]
        return [
            model.model_validate(dict(row))
            for row in (rows[kept] if isinstance(kept, slice) else kept)
        ]
    changed = (change.get(ALL, {}) | change.get(number, {}) for number in range(len(rows)))
    return [model.model_validate(row | other) for row, other in zip(rows, changed, strict=True)]


def workbook(name: str, folder: Path) -> Path:
    """Write the workbook of a project or a copy, with what lies beside it, into a new folder."""
    project, changes = COPIES.get(name, (name, {}))
    source = ROOT / "projects" / project
    shutil.copytree(source, folder, ignore=shutil.ignore_patterns("out", "make.py", "__pycache__"))
    shutil.copy(ROOT / "projects" / "school" / "peer-review.pdf", folder / "hazard.pdf")
    shutil.copy(folder / "hazard.pdf", folder / "peer-review.pdf")
    if changes:
        data = _sheet(project, changes).project
        write_template(folder / "input.xlsx", units=data.project.units_first, example=data)
    return folder / "input.xlsx"
