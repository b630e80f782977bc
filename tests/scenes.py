"""Assessments of the stand-in project that many tests read; each is run once in a process.

Only read them. A test that needs another state names its changes here, too: equal ones share runs.
"""

from __future__ import annotations

import datetime as dt
from collections import OrderedDict
from dataclasses import replace
from functools import cache
from pathlib import Path
from tempfile import TemporaryDirectory

import inputs
import sheets
import stand_in
from places import ROOT
from report.assessment.assess import assess
from report.assessment.evidence import Evidence, support
from report.assessment.project import Assessment, Changes
from report.motions.components import Components
from report.motions.history import shake
from report.pages.parts import PackageData
from report.pages.registry import package_data
from report.results.changes import changes
from report.results.results_json import former_from, results_json
from sheets import Book, read_workbook
from solver.records.record import Record

FOOT = stand_in.FOOT
REVIEW = inputs.REVIEW
CONFIRMED = {
    "site": inputs.SITE | {"building_code": "CBC", "building_code_year": 2022},
    "confirmation": {"by": "RG, SE", "date": dt.date(2026, 3, 1), "rule_set": "SEAOC PV1-2012",
                     "edition": "ASCE 7-16", "code": "2022 CBC"},
}  # fmt: skip
SHIPPED = sorted(
    {path.parent.name for path in (ROOT / "projects").glob("*/make.py")} - {"curves", "study"}
)
TESTS = {
    "laboratory": "Example Laboratories", "accreditation": "ISO/IEC 17025, no. 1234.01",
    "standard": "ASTM G115-10", "report": "FT-118", "date": dt.date(2025, 6, 12),
    "membrane": "TPO, 60 mil", "support": "EPDM pad",
}  # fmt: skip


@cache
def motions(count: int = 3, seconds: float = 8.0, **changes):
    """Return the stand-in's motions, the same ones each time."""
    return stand_in.motions(count, seconds=seconds, **changes)


@cache
def level():
    """Return three short motions without a vertical component."""
    return tuple(replace(motion, az_mps2=stand_in.NO_RECORD) for motion in motions())


def along(given):
    """Return motions with their first horizontal component alone."""
    none = stand_in.NO_RECORD
    return tuple(replace(motion, ay_mps2=none, az_mps2=none) for motion in given)


def package(shaking=None, **changes) -> PackageData:
    """Return the stand-in project with changed sections, run under three short motions."""
    shaking = shaking or motions()
    key = f"{id(shaking)} {sorted(changes.items())!r}"
    if key not in _made:
        done = stand_in.assess_input(stand_in.project(**changes), shaking)
        _made[key] = (shaking, package_data(done))
    _made.move_to_end(key)
    if len(_made) > MOST:
        _made.popitem(last=False)
    return _made[key][1]


def evidence(assessment: Assessment) -> Evidence:
    """Return what supports an assessment, computed once for each that is still known."""
    key = id(assessment)
    if key not in _supported:
        _supported[key] = (assessment, support(assessment))
    _supported.move_to_end(key)
    if len(_supported) > MOST:
        _supported.popitem(last=False)
    return _supported[key][1]


MOST = 60
_supported: OrderedDict[int, tuple[Assessment, Evidence]] = OrderedDict()
_made: OrderedDict[str, tuple[object, PackageData]] = OrderedDict()
"""The last packages with their motions, so that no others get the identity of those."""


@cache
def usual() -> Assessment:
    """Return the stand-in project as it is, under seven motions."""
    return stand_in.assess_input(stand_in.project(), motions(7))


def grounded(data, given, *, vertical: bool = True, transverse: bool = False) -> Book:
    """Return the book of motions that were recorded on the ground, carried through the building."""
    parts = []
    for motion, row in zip(given, data.motions, strict=True):
        components = {"record": motion.ax_mps2} | ({"vertical": motion.az_mps2} if vertical else {})
        components |= {"transverse": motion.ay_mps2} if transverse else {}
        records = {
            name: Record(name=name, dt_s=motion.dt_s, a_mps2=a) for name, a in components.items()
        }
        unfiltered = records if row.highpass_hz else {}
        parts.append(Components(files=(), records=records, unfiltered=unfiltered, whole={}))
    shaken = shake(data, parts)
    book = stand_in.book(data, tuple(motion for motion, _ in shaken))
    return book.having(prepared=tuple(prepared for _, prepared in shaken))


@cache
def twelve(*, is_long: bool) -> PackageData:
    """Return twelve arrays in three columns, each with a unit beside it, and 29 clearances.

    The names of arrays, units and motions have 40 characters, or a few.
    """

    def name(start: str, words: str, number: int) -> str:
        return f"{words} {number:02}" if is_long else f"{start}{number}"

    arrays = [name("A", "NORTHWEST CORNER OF UPPER ROOF, ARRAY", k) for k in range(1, 13)]
    units = [name("RTU-", "Make-up air unit of the kitchens, no.", k) for k in range(1, 13)]
    ids = [name("M", "Loma Prieta 1989, Gilroy, scaled, no.", k) for k in range(1, 8)]
    places = [(15 + 90 * (k // 4), 15 + 66 * (k % 4)) for k in range(12)]
    clearances = [
        *(stand_in.clearance(arrays[k], units[k], 2 * FOOT) for k in range(12)),
        *(stand_in.clearance(arrays[k], arrays[k - 1], 4 * FOOT) for k in range(12) if k % 4),
        *(stand_in.clearance(arrays[k], arrays[k - 4], 8 * FOOT) for k in range(4, 12)),
    ]
    return package(
        tuple(replace(motion, id=id) for motion, id in zip(motions(7), ids, strict=True)),
        arrays=[stand_in.array(arrays[k], 2.0, x=x, y=y) for k, (x, y) in enumerate(places)],
        objects=[
            stand_in.roof_object(units[k], "fixed object", x + 82, x + 86, y + 20, y + 25)
            for k, (x, y) in enumerate(places)
        ],
        clearances=clearances,
        motions=[inputs.motion(id) for id in ids],
        roof=inputs.sides(0, 300, 0, 290),
        options={"package_edition": "plan check", "letter": False},
    )


@cache
def shipped(name: str) -> Assessment:
    """Return a project that comes with the program."""
    book = read_workbook(ROOT / "projects" / name)
    return assess(book.sheet, book.shaking)


@cache
def without_motions() -> Assessment:
    """Return the example with no rows on its sheet Motions."""
    with TemporaryDirectory() as folder:
        book = read_workbook(sheets.without_motions(Path(folder)))
    return assess(book.sheet, book.shaking)


@cache
def unpermitted() -> Assessment:
    """Return a project in SI whose motions lack components: one array has no permitted route.

    Ground motions of one component, a building, linked blocks, a clearance that is not listed, a
    parapet that is too low, a record with events and notes, and an outline of the roof.
    """
    base = stand_in.project()
    data = stand_in.project(
        project=base.project.model_dump() | {"units_first": "SI", "checked_by": "Checker"},
        site=base.site.model_dump() | {"rule_set": "ASCE 7-16", "force_factor": 1.0,
                                       "force_divisor": 1.5, "hazard_source": "Hazard Tool",
                                       "hazard_date": "2026-02-20"},
        arrays=[stand_in.array("A1", 0.5, mu=0.3, slack_m=0.1),
                stand_in.array("A2", 0.5, mu=0.41, x=120, interconnection_n=1.0)],
        objects=[stand_in.roof_object("RTU-1", "fixed object", 107, 112, 35, 42, height=1.0),
                 stand_in.roof_object("N", "edge with parapet", 0, 220, 170, 171, height=0.5)],
        clearances=[stand_in.clearance("A1", "RTU-1", 7 * FOOT),
                    stand_in.clearance("A1", "A2", 2 * FOOT),
                    stand_in.clearance("A2", "N", 20 * FOOT, "up")],
        links=[stand_in.links("A1", "0.28, 0.3, 0.32", 50)],
        motions=[{"id": f"M{k}", "record": "x", "recorded_at": "ground", "event": event}
                 for k, event in enumerate(("Kobe 1995", "", ""), start=1)],
        building={"period_s": 0.5},
        spectrum=[],
        target={"t_l_s": 8.0},
        roof={"x_from_m": 0.0, "x_to_m": 220 * FOOT, "y_from_m": 0.0, "y_to_m": 171 * FOOT},
    )  # fmt: skip
    book = grounded(data, motions(3, peak_g=0.5), vertical=False)
    noted = (replace(book.records[0], notes=("uneven times resampled",)), *book.records[1:])
    return stand_in.assessed(book.having(records=noted))


@cache
def departing() -> PackageData:
    """Return a project with every departure, and with what changed since its first revision.

    Peer review, overrides, friction by velocity with its tests, smaller events, and clearances that
    are NG.
    """
    law = stand_in.array("A3", 3.0, mu=0.30, mu_fast=0.46, mu_rate_s_per_m=20.0, mu_static=0.48,
                         y=90)  # fmt: skip
    runs = [
        {"surface": surface, "number": k, "mu": mu, "velocity_mps": 0.0254}
        for surface, mus in (("dry", (0.60, 0.61, 0.62)), ("wet", (0.46, 0.45, 0.47)))
        for k, mu in enumerate(mus, start=1)
    ]
    low = {"surface": "wet", "number": 4, "mu": 0.40, "velocity_mps": 0.0025}

    def project(**given):
        return stand_in.project(
            arrays=[stand_in.array("A1", 2.0), stand_in.array("A2", 2.0, mu=0.40, x=120), law],
            clearances=[stand_in.clearance("A1", "A3", 15 * FOOT),
                        stand_in.clearance("A1", "RTU-1", 0.1 * FOOT, "across"),
                        stand_in.clearance("A3", "T-1", 7 * FOOT),
                        stand_in.clearance("A2", "S edge", 0.4 * FOOT, "down")],
            links=[stand_in.links("A1", "0.40, 0.45, 0.50", 50, damping_ratio=0.05)],
            friction_tests=TESTS, friction_runs=[*runs, low], **given,
        )  # fmt: skip

    first = stand_in.assess_input(project(options=REVIEW), motions())
    second = stand_in.assess_input(
        project(
            options=REVIEW | {"smaller_events": "0.50, 0.25"},
            overrides=[
                {"provision": "separation_fixed", "value": 0.5, "reason": "Agreed on 2026-02-10"},
                {"provision": "analysis_factor", "value": 1.0, "reason": "Agreed on 2026-02-11"},
            ],
        ),
        motions(),
    )
    return package_data(second, since(first, second))


def since(first: Assessment, second: Assessment) -> Changes:
    """Return what changed from an assessment to another, as `--since` finds it."""
    return changes(former_from(results_json(first, evidence(first)), "former"), second)
