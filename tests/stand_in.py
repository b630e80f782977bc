"""A project as a workbook would give it, for tests of the package alone."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from openpyxl.utils import get_column_letter

import inputs
from inputs import FT as FOOT
from inputs import INCH, array, clearance, links, roof_object
from report.assessment.assess import assess
from report.assessment.evidence import support
from report.assessment.project import Assessment
from report.motions.components import RecordFile
from report.motions.history import PreparedMotion
from report.motions.prepare import Shaking
from report.package.html import pages
from report.project import workbook
from report.project.model import ProjectInput
from report.project.model.choices import RecordedAt
from report.project.read.read import EchoRow, Sheet
from report.typeset.pdf import lay_out
from sheets import Book
from solver.model import Motion
from solver.records.measures import measures
from solver.records.record import Record

__all__ = ("FOOT", "INCH", "array", "clearance", "links", "roof_object")  # of `inputs`

G = 9.80665
DT_S = 0.005


def motions(count=7, *, seconds=30.0, peak_g=1.7, vertical_peak_g=0.4, seed=11):
    """Seeded noise with the envelope of a shake-table test, in three components."""
    rng, other = np.random.default_rng(seed), np.random.default_rng(seed + 1000)
    return tuple(
        motion(
            f"M{k}",
            _noise(rng, seconds, peak_g * G),
            ay=_noise(other, seconds, peak_g * G),
            az=_noise(rng, seconds, vertical_peak_g * G),
            dt_s=DT_S,
            source=f"Seeded noise, number {k}",
        )
        for k in range(1, count + 1)
    )


NO_RECORD = np.empty(0)


def motion(name, ax, az=NO_RECORD, *, ay=NO_RECORD, dt_s=0.01, signs=(1, -1), source=""):
    """One motion of given accelerations, as recorded."""
    sides = {"ax_mps2": ax, "ay_mps2": ay, "az_mps2": az}
    return Motion(id=name, source=source, dt_s=dt_s, **sides, scale=1.0, signs=signs)


def lifting(name="UP", **changes):
    """One motion whose vertical component lifts every array off, with a horizontal one of zeros."""
    flat, up = np.zeros(400), np.zeros(400)
    up[100:200] = -1.4 * G
    for record in (flat, up):
        record.setflags(write=False)
    return motion(name, flat, up, **changes)


def _noise(rng, seconds, peak):
    n = round(seconds / DT_S)
    freq = np.fft.rfftfreq(n, DT_S)
    shape = np.interp(freq, [0.0, 0.15, 1.3, 8.3, 33.3, 100.0], [0.0, 0.3, 1.0, 0.6, 0.1, 0.0])
    wave = np.fft.irfft(shape * np.exp(2j * np.pi * rng.random(freq.size)), n)
    t = np.arange(n) * DT_S
    wave *= np.clip(np.minimum(t / 5.0, (seconds - t) / 5.0), 0.0, 1.0)
    wave -= wave.mean()
    record = peak * wave / np.abs(wave).max()
    record[0] = record[-1] = 0.0
    record.setflags(write=False)
    return record


# A target that seeded noise reaches at every period: its analysis is then accepted.
LOW_SPECTRUM = [
    {"period_s": period_s, "horizontal_g": 1e-5, "vertical_g": 1e-5} for period_s in (0.01, 20.0)
]
SHORT_SPECTRUM = [
    {"period_s": period_s, "horizontal_g": 1.0, "vertical_g": 0.5} for period_s in (0.01, 0.9)
]


def project(**changes) -> ProjectInput:
    """Three arrays, five kinds of clearance; `changes` replace whole sections.

    Its package has every page, unless the options say otherwise.
    """
    options = {"package_edition": "complete", "letter": True} | changes.get("options", {})
    return inputs.project(**SECTIONS | changes | {"options": options})


SECTIONS = {
    "revisions": [{"revision": inputs.HEAD["revision"], "date": inputs.HEAD["date"],
                   "description": "Issued for permit", "by": inputs.HEAD["prepared_by"]}],
    "site": inputs.SITE | {"s_s_g": 1.97, "f_a": 1.2, "f_v": 1.7,
                           "fire_code_section": "2022 CFC, example section"},
    "arrays": [array("A1", 0.5), array("A2", 2.0, x=120), array("A3", 3.0, mu=0.55, y=90)],
    "objects": [
        roof_object("RTU-1", "fixed object", 107, 112, 35, 42, height=42 * INCH),
        roof_object("T-1", "unlike array", 107, 160, 90, 120),
        roof_object("N edge", "edge with parapet", 0, 220, 170, 171, height=30 * INCH),
        roof_object("S edge", "edge without parapet", 0, 220, -1, 0),
    ],
    "clearances": [
        clearance("A1", "A3", 15 * FOOT),
        clearance("A1", "RTU-1", 7 * FOOT),
        clearance("A3", "T-1", 7 * FOOT),
        clearance("A3", "N edge", 20 * FOOT, "up"),
        clearance("A2", "S edge", 5 * FOOT, "down"),
    ],
    "motions": [{"id": "M1", "record": "records/m1-x.csv", "units": "g"}],
    "spectrum": LOW_SPECTRUM,
}  # fmt: skip


def site(**changes):
    """The site of the project with changes."""
    return project().site.model_dump() | changes


def steep(**changes):
    """The project with roofs too steep for the prescriptive route of PV1-2012."""
    return project(arrays=[row | {"slope_value": 4.0} for row in SECTIONS["arrays"]], **changes)


def unpermitted(**changes):
    """A1 has no permitted route and does not slide; A2 takes the prescriptive displacement.

    The motions are weak and have no vertical component; peer review removes the floor. The third
    clearance is that of A2 alone.
    """
    given = {
        "options": inputs.REVIEW,
        "arrays": [array("A1", 0.5, mu=0.3, slack_m=1.0), array("A2", 0.5, x=120)],
        "clearances": [
            clearance("A1", "RTU-1", 7 * FOOT),
            clearance("A2", "A1", 20 * FOOT),
            clearance("A2", "S edge", 15 * FOOT),
        ],
    }
    weak = motions(3, seconds=8.0, peak_g=0.1)
    alone = tuple(replace(motion, az_mps2=NO_RECORD) for motion in weak)
    return assess_input(project(**given | changes), alone)


def sheet(data):
    """What the workbook reader gives for an input."""
    return Made(
        path=Path("input.xlsx"), sha256="5f" * 32, book=None, whole=ProjectInput,
        sections=workbook.SECTIONS, inputs={}, echo=tuple(_echo(data)), problems=(), addresses={},
        unfound=frozenset(), unseen=(), warnings=(), made=data,
    )  # fmt: skip


@dataclass(frozen=True, kw_only=True)
class Made(Sheet):
    """A workbook of a given input."""

    made: ProjectInput

    @property
    def project(self):
        return self.made


def book(data=None, shaking=None):
    """What the reader and the preparation of motions give."""
    shaking = shaking or motions()
    records = tuple(
        record_file(motion, component, values)
        for motion in shaking
        for component, values in components(motion).items()
    )
    parts = tuple(prepared(motion) for motion in shaking)
    return Book(sheet(data or project()), Shaking(motions=shaking, prepared=parts, records=records))


def record_file(motion, component, values):
    """What the reader says of the file of a component."""
    peak_g = float(np.abs(values).max() / G)
    return RecordFile(
        motion_id=motion.id, component=component, sha256="ab" * 32, format="text", notes=(),
        name=f"records/{motion.id.lower()}-{component[0]}.csv", npts=len(motion.ax_mps2),
        dt_s=motion.dt_s, npts_trimmed=0, hold_s=math.nan, size=100_000, spikes=(),
        peak_g=peak_g, others_g=peak_g,
    )  # fmt: skip


def components(motion):
    """The components that a motion has, by name."""
    given = (motion.ax_mps2, motion.ay_mps2, motion.az_mps2)
    every = zip(("horizontal", "transverse", "vertical"), given, strict=True)
    return {name: values for name, values in every if len(values)}


def prepared(given, **changes):
    """What became of a roof motion that was run as recorded."""
    scaled = {
        name: Record(name=given.id, dt_s=given.dt_s, a_mps2=values * given.scale)
        for name, values in components(given).items()
    }
    usual = {
        "motion_id": given.id, "recorded_at": RecordedAt.ROOF, "done": "as recorded",
        "scaling": "as recorded", "scaled": scaled, "roof": {}, "unfiltered": (),
        "measures": {name: measures(record) for name, record in scaled.items()},
        # Noise ends where it ends.
        "drift_basis": "a test, seeded noise",
    }  # fmt: skip
    return PreparedMotion(**(usual | changes))


def _echo(data):
    for section, values in data.model_dump(mode="json").items():
        rows = values if isinstance(values, list) else [values]
        for index, row in enumerate(rows):
            for column, (key, value) in enumerate(row.items()):
                cell = f"{get_column_letter(2 + column)}{7 + index}"
                typed = "" if value is None else str(value)
                said = {"label": key, "typed": typed, "unit": "", "value": typed}
                yield EchoRow(sheet=section.title(), cell=cell, **said)


def assess_input(data, shaking) -> Assessment:
    """Assess an input under motions."""
    return assessed(book(data, tuple(shaking)))


def assessed(made) -> Assessment:
    """Run the book."""
    return assess(made.sheet, made.shaking)


def html(made) -> str:
    """Run the book and return the pages of its calculation package."""
    assessment = assessed(made)
    return pages(assessment, support(assessment))


def package(made) -> bytes:
    """Run the book and return its calculation package."""
    return lay_out(html(made))
