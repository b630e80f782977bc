"""Makes the example that `roofslip new --example` copies: motions, documents and the workbook.

A warehouse roof with three arrays, and motions from seeded noise. Its evidence is complete; each
document says of itself that it is an example's.

Run from the repository root: .venv/bin/python projects/example/make.py
"""

from __future__ import annotations

import datetime as dt
from pathlib import Path

from projects.rows import (
    Range,
    Row,
    clearance,
    issued,
    motion,
    rectangle,
    roof_object,
    write_document,
    write_motions,
)
from report.project.model import ProjectInput
from report.project.model.choices import UnitsFirst
from report.project.write.template import write_template
from solver.rules.ac156 import ac156_horizontal, ac156_vertical
from solver.rules.hazard import EDITIONS
from solver.rules.rulesets import RULE_SETS
from solver.synthesis.suite import SuiteMotion, make_suite

HERE = Path(__file__).resolve().parent
FOOT, INCH, POUND = 0.3048, 0.0254, 4.4482216152605
PSF = POUND / FOOT**2
S_DS_G = 1.566
COUNT, SEED = 7, 1566
SOURCE = f"AC156 spectrum at the roof, seed {SEED}"
HAZARD, ACCEPTANCE, FRICTION = (
    f"documents/{name}.pdf" for name in ("hazard", "acceptance", "friction-report")
)
# Kinetic coefficients, three runs at each velocity [in/s].
TESTED = {
    "dry": {
        0.1: (0.548, 0.556, 0.551), 2.0: (0.589, 0.596, 0.592), 8.0: (0.611, 0.618, 0.607),
    },
    "wet": {
        0.1: (0.504, 0.512, 0.508), 2.0: (0.528, 0.533, 0.529), 8.0: (0.545, 0.551, 0.547),
    },
}  # fmt: skip


def main() -> None:
    """Write records/, documents/ and input.xlsx beside this file."""
    write_motions(HERE / "records", "RM", suite(COUNT))
    for name, lines in documents(data := project()).items():
        write_document(HERE / name, lines)
    write_template(HERE / "input.xlsx", units=UnitsFirst.US, example=data)


def suite(count: int) -> list[SuiteMotion]:
    """Return motions with spectra that match AC156 at the roof."""
    edition = EDITIONS[RULE_SETS["SEAOC PV1-2012"].edition]
    across = ac156_horizontal(edition, s_ds_g=S_DS_G, z_over_h=1.0)
    upward = ac156_vertical(s_ds_g=S_DS_G)
    return make_suite(
        (across.freq_hz, across.sa_g),
        (upward.freq_hz, upward.sa_g),
        count=count,
        seed=SEED,
    )


def project() -> ProjectInput:
    """Return the project: a 360 ft by 240 ft warehouse roof with three slopes and fire lanes."""
    return ProjectInput.model_validate(
        {
            **issued(
                "Distribution Warehouse, Rooftop Solar",
                "EX-1566",
                "Example client",
                "Los Angeles, California",
                "US",
                date=dt.date(2025, 11, 20),  # California adopts ASCE 7-22 from 2026
                firm_contact="Example street 1, Los Angeles",
                plan_number="S-101, example",
                plan_date=dt.date(2025, 11, 10),
            ),
            "site": {
                "rule_set": "SEAOC PV1-2012",
                "edition_name": "ASCE 7-16",
                "risk_category": "II",
                "i_e": 1.0,
                "s_s_g": 1.9575,
                "s_1_g": 0.70,
                "site_class": "C",
                "f_a": 1.2,
                "f_v": 1.4,
                "hazard_source": "ASCE 7 Hazard Tool, example values",
                "hazard_date": dt.date(2025, 11, 2),
                "hazard_covered": "2025-11-02: Site 1b1eb2",
                "hazard_printout": HAZARD,
                "sdc": "D",
                "force_factor": 1.0,
                "force_divisor": 1.5,
                "stories": 1,
                "structure_height_m": 36 * FOOT,
                "roof_height_m": 36 * FOOT,
                "building_code": "CBC",
                "building_code_year": 2022,
                "jurisdiction": "City of Los Angeles",
                "acceptance_letter": ACCEPTANCE,
                "fire_code_section": "2022 CFC, example section",
                "latitude_deg": 34.0362,
                "longitude_deg": -118.2334,
                "seismic_weight_n": 3.0e6 * POUND,
                "roof_evaluation": "Example engineer, 2025-10-20, not an evaluation",
            },
            "roof": {**rectangle((0.0, 360), (0.0, 240), FOOT), "north_deg": 90.0},
            "building": {"structure": "other"},
            "target": {"t_l_s": 8.0},
            "friction_tests": {
                "laboratory": "Example laboratory, not a test",
                "accreditation": "ISO/IEC 17025, example",
                "standard": "ASTM G115-10",
                "report": "EX-FT-1",
                "date": dt.date(2025, 9, 15),
                "tests_covered": "2025-09-15: Friction tests 205647",
                "membrane": "TPO, 60 mil",
                "support": "EPDM pad",
                "report_file": FRICTION,
                "contact_pressure_pa": 180.0 * PSF,
            },
            "friction_runs": _friction_runs(),
            "arrays": [
                _array("A1", 0.5, 0.50, (30, 150), (140, 232)),
                _array("A2", 2.0, 0.50, (30, 150), (30, 132)),
                # Friction by velocity, on the safe side of the tests: less at low velocity.
                _array("A3", 3.0, 0.40, (200, 350), (30, 180), mu_fast=0.50, mu_rate_s_per_m=20.0),
            ],
            "objects": [
                _object("RTU-1", "fixed object", (154, 164), (150, 162), 48),
                _object("RTU-2", "fixed object", (260, 272), (13, 25), 48),
                _object("PV-OLD", "array of different construction", (200, 340), (186, 214), None),
                _object("NORTH", "edge with parapet", (0, 360), (240, 241), 30),
                _object("EAST", "edge without parapet", (360, 361), (0, 240), None),
                _object("SOUTH", "edge without parapet", (0, 360), (-1, 0), None),
                _object("WEST", "edge without parapet", (-1, 0), (0, 240), None),
            ],
            "clearances": [
                _clearance("A1", "A2", "downslope", 8),
                _clearance("A1", "RTU-1", "cross-slope", 4),
                _clearance("A1", "NORTH", "upslope", 8, pathway_m=48 * INCH),
                _clearance("A3", "RTU-2", "downslope", 5),
                _clearance("A3", "PV-OLD", "upslope", 6),
                _clearance("A3", "EAST", "cross-slope", 10),
            ],
            "motions": [motion(f"RM{n}", "xyz", SOURCE) for n in range(1, COUNT + 1)],
        }
    )


def _array(name: str, slope: float, mu: float, x: Range, y: Range, **more: object) -> Row:
    """Return an array of the same product with its rectangle in feet; south is downslope."""
    area_sqft = (x[1] - x[0]) * (y[1] - y[0])
    return {
        "id": name,
        "slope_value": slope,
        "slope_unit": "degrees",
        "mu": mu,
        "mu_report": "EX-FT-1, example values",
        "construction": "Ballasted tray, 10 deg tilt",
        "weight_n": 5.5 * area_sqft * POUND,
        "cg_height_m": 9 * INCH,
        "support_spacing_m": 40 * INCH,
        "base_m": 60 * INCH,
        "contact_pressure_pa": 180.0 * PSF,
        "interconnection_n": 14_000 * POUND,
        "slack_m": 60 * INCH,
        "roof_capacity_pa": 6.0 * PSF,
        "wind_weight_pa": 5.5 * PSF,
        "downslope_deg": 270.0,
        **rectangle(x, y, FOOT),
        **more,
    }


def _friction_runs() -> list[Row]:
    """Return the runs on a dry and on a wet surface, three at each velocity."""
    return [
        {
            "surface": surface,
            "number": number,
            "velocity_mps": velocity * INCH,
            "mu": mu,
            "mu_static": round(mu + 0.025, 3),
        }
        for surface, by_velocity in TESTED.items()
        for number, (velocity, mu) in enumerate(
            ((velocity, mu) for velocity, mus in by_velocity.items() for mu in mus), start=1
        )
    ]


def documents(data: ProjectInput) -> dict[str, list[str]]:
    """Return the lines of each document that the workbook attaches, by its name."""
    issue, site, tests = data.project, data.site, data.friction_tests
    head = [f"Project {issue.number}, {issue.name}", issue.address, ""]
    hazard = site.parameters
    values = {
        "S_S": site.s_s_g, "S_1": site.s_1_g, "F_a": site.f_a, "F_v": site.f_v,
        "S_MS": hazard.s_ms, "S_M1": hazard.s_m1, "S_DS": hazard.s_ds, "S_D1": hazard.s_d1,
    }  # fmt: skip
    return {
        HAZARD: [
            "EXAMPLE, IN PLACE OF THE PRINTOUT OF A HAZARD TOOL. NOT FOR ANY SITE.",
            "",
            *head,
            f"{site.edition.name}, {site.hazard_date}",
            f"Risk category {site.risk_category}, site class {site.site_class}",
            "",
            *(f"{symbol:5} {value:7.4f}" for symbol, value in values.items()),
            f"T_L   {data.target.t_l_s:4.1f} s",
        ],
        ACCEPTANCE: [
            "EXAMPLE, IN PLACE OF A LETTER OF THE JURISDICTION. NOBODY ACCEPTED ANYTHING.",
            "",
            *head,
            f"{site.jurisdiction}, {site.code_text}",
            "",
            f"{site.rule_set} is accepted as an alternative to {site.edition.name} 13.6.12",
            "for the ballasted arrays of this project.",
        ],
        FRICTION: [
            "EXAMPLE, IN PLACE OF A TEST REPORT. NOTHING WAS TESTED.",
            "",
            f"{tests.report}, {tests.date}: {tests.laboratory}",
            f"{tests.standard}; {tests.support} on {tests.membrane}",
            "",
            "surface  run  velocity [in/s]  kinetic  static",
            *(
                f"{run.surface:7}  {run.number:3}  {run.velocity_mps / INCH:15.1f}"
                f"  {run.mu:7.3f}  {run.mu_static:6.3f}"
                for run in data.friction_runs
            ),
        ],
    }


def _object(name: str, kind: str, x: Range, y: Range, height_in: float | None) -> Row:
    height_m = None if height_in is None else height_in * INCH
    return roof_object(name, kind, height_m, x, y, FOOT)


def _clearance(array: str, other: str, direction: str, feet: float, **more: object) -> Row:
    return clearance(array, other, direction, feet * FOOT, **more)


if __name__ == "__main__":
    main()
