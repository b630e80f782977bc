"""Makes the example that `roofslip new --example` copies: seven roof motions, and the workbook.

A warehouse roof with three arrays, and motions from seeded noise.

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
    write_motions,
)
from report.sheet.schema import ProjectInput
from report.sheet.schema.choices import UnitsFirst
from report.sheet.writing.template import write_template
from solver.rules.hazard import EDITIONS, ac156_horizontal, ac156_vertical
from solver.rules.provisions import RULE_SETS
from solver.synthesis.suite import SuiteMotion, make_suite

HERE = Path(__file__).resolve().parent
FOOT, INCH, POUND = 0.3048, 0.0254, 4.4482216152605
PSF = POUND / FOOT**2
S_DS_G = 1.566
COUNT, SEED = 7, 1566
SOURCE = f"AC156 spectrum at the roof, seed {SEED}"


def main() -> None:
    """Write records/ and input.xlsx beside this file."""
    write_motions(HERE / "records", "RM", suite(COUNT))
    write_template(HERE / "input.xlsx", units=UnitsFirst.US, example=project())


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
                "sdc": "D",
                "force_factor": 1.0,
                "force_divisor": 1.5,
                "stories": 1,
                "structure_height_m": 36 * FOOT,
                "roof_height_m": 36 * FOOT,
                "building_code": "CBC",
                "building_code_year": 2022,
                "jurisdiction": "City of Los Angeles",
                "fire_code_section": "2022 CFC, example section",
                "latitude_deg": 34.0362,
                "longitude_deg": -118.2334,
                "roof_load_pa": 32.0 * PSF,
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
                "tests_covered": "2025-09-15: Friction tests c82ab7",
                "membrane": "TPO, 60 mil",
                "support": "EPDM pad",
            },
            "friction_runs": _friction_runs(),
            "arrays": [
                _array("A1", 0.5, 0.50, (30, 150), (140, 232)),
                _array("A2", 2.0, 0.50, (30, 150), (30, 132)),
                # Velocity-dependent friction: less friction at low velocity than at high velocity.
                _array("A3", 3.0, 0.40, (200, 350), (30, 180), mu_fast=0.50, mu_rate_s_per_m=20.0),
            ],
            "objects": [
                _object("RTU-1", "fixed object", (154, 164), (150, 162), 48),
                _object("RTU-2", "fixed object", (260, 272), (13, 25), 48),
                _object("PV-OLD", "unlike array", (200, 340), (186, 214), None),
                _object("NORTH", "edge with parapet", (0, 360), (240, 241), 30),
                _object("EAST", "edge without parapet", (360, 361), (0, 240), None),
                _object("SOUTH", "edge without parapet", (0, 360), (-1, 0), None),
                _object("WEST", "edge without parapet", (-1, 0), (0, 240), None),
            ],
            "clearances": [
                _clearance("A1", "A2", "down", 8),
                _clearance("A1", "RTU-1", "across", 4),
                _clearance("A1", "NORTH", "up", 8, pathway_m=48 * INCH),
                _clearance("A3", "RTU-2", "down", 5),
                _clearance("A3", "PV-OLD", "up", 6),
                _clearance("A3", "EAST", "across", 10),
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
        "interconnection_n": 14_000 * POUND,
        "slack_m": 60 * INCH,
        "roof_capacity_pa": 6.0 * PSF,
        "wind_weight_pa": 5.5 * PSF,
        "downslope_deg": 270.0,
        **rectangle(x, y, FOOT),
        **more,
    }


def _friction_runs() -> list[Row]:
    """Return four runs on a dry and four on a wet surface: velocity [in/s], kinetic, static."""
    runs = {
        "dry": ((0.1, 0.535, 0.58), (1.0, 0.578, 0.60), (2.0, 0.603, 0.62), (4.0, 0.620, 0.64)),
        "wet": ((0.1, 0.457, 0.50), (1.0, 0.495, 0.53), (2.0, 0.525, 0.54), (4.0, 0.541, 0.56)),
    }
    return [
        {
            "surface": surface,
            "number": number,
            "velocity_mps": velocity * INCH,
            "mu": mu,
            "mu_static": static,
        }
        for surface, rows in runs.items()
        for number, (velocity, mu, static) in enumerate(rows, start=1)
    ]


def _object(name: str, kind: str, x: Range, y: Range, height_in: float | None) -> Row:
    height_m = None if height_in is None else height_in * INCH
    return roof_object(name, kind, height_m, x, y, FOOT)


def _clearance(array: str, other: str, direction: str, feet: float, **more: object) -> Row:
    return clearance(array, other, direction, feet * FOOT, **more)


if __name__ == "__main__":
    main()
