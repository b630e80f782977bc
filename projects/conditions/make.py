"""Makes a project with much missing: what is not there is named by its package, which is NG.

Run from the repository root: .venv/bin/python projects/conditions/make.py
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
from report.project.model import ProjectInput
from report.project.model.choices import UnitsFirst
from report.project.write.template import write_template
from report.suite.targets import ac156_targets
from solver.rules.ac156 import Tail
from solver.synthesis.suite import SuiteMotion, make_suite

HERE = Path(__file__).resolve().parent
FOOT, INCH, POUND = 0.3048, 0.0254, 4.4482216152605
S_DS_G = 1.0
COUNT, SEED, DT_S = 4, 1000, 0.01
SOURCE = f"AC156 spectrum at the roof, seed {SEED}; one component of each motion"


def main() -> None:
    """Write records/ and input.xlsx beside this file."""
    write_motions(HERE / "records", "RM", suite(COUNT), "x")
    write_template(HERE / "input.xlsx", units=UnitsFirst.US, example=project())


def suite(count: int) -> list[SuiteMotion]:
    """Return the roof motions, of which the project uses the first component alone."""
    roof = ac156_targets("pv1", s_ds_g=S_DS_G, z_over_h=1.0, tail=Tail.AC156)
    return make_suite(roof.horizontal, roof.vertical, count=count, seed=SEED, dt_s=DT_S)


def project() -> ProjectInput:
    """Return the project: a small warehouse whose calculation lacks much."""
    return ProjectInput.model_validate(
        {
            **issued(
                "Small Warehouse, Rooftop Solar",
                "CO-1000",
                "Example client",
                "Sacramento, California",
                "US",
                date=dt.date(2025, 11, 20),  # California adopts ASCE 7-22 from 2026
                revision="A",
                description="Draft, incomplete",
            ),
            "site": {
                "rule_set": "SEAOC PV1-2012",
                "risk_category": "II",
                "i_e": 1.0,
                "site_class": "C",
                "s_ds_g": S_DS_G,
                "sdc": "D",
                "stories": 1,
                "structure_height_m": 24 * FOOT,
                "roof_height_m": 24 * FOOT,
            },
            "roof": rectangle((0.0, 200), (0.0, 100), FOOT),
            "arrays": [
                # Longer than 150 ft between fire lanes.
                _array("A1", (10, 170), (54, 90)),
                _array("A2", (10, 120), (10, 50)),
            ],
            "objects": [
                _object("RTU-1", "fixed object", 48, (121, 129), (20, 28)),
                _object("NORTH", "edge with parapet", 36, (0, 200), (100, 101)),
                _object("SOUTH", "edge without parapet", None, (0, 200), (-1, 0)),
                _object("EAST", "edge with parapet", 36, (200, 201), (0, 100)),
                _object("WEST", "edge with parapet", 36, (-1, 0), (0, 100)),
            ],
            "clearances": [
                _clearance("A1", "A2", "downslope", 4),
                # Too narrow: the prescriptive displacement is 21.6 in.
                _clearance("A2", "RTU-1", "cross-slope", 1),
                _clearance("A2", "SOUTH", "downslope", 10),
                _clearance("A1", "NORTH", "upslope", 10),
                _clearance("A1", "WEST", "cross-slope", 10),
                _clearance("A2", "WEST", "cross-slope", 10),
            ],
            "motions": [motion(f"RM{n}", "x", SOURCE) for n in range(1, COUNT + 1)],
        }
    )


def _array(name: str, x: Range, y: Range) -> Row:
    """Return an array without friction test report, interconnection strength and slack."""
    area_sqft = (x[1] - x[0]) * (y[1] - y[0])
    return {
        "id": name,
        "slope_value": 0.25,
        "slope_unit": "in/12",
        "mu": 0.50,
        "construction": "Ballasted tray, 10 deg tilt",
        "weight_n": 5.5 * area_sqft * POUND,
        "cg_height_m": 9 * INCH,
        "support_spacing_m": 40 * INCH,
        "downslope_deg": 270.0,
        **rectangle(x, y, FOOT),
    }


def _object(name: str, kind: str, height_in: float | None, x: Range, y: Range) -> Row:
    height_m = None if height_in is None else height_in * INCH
    return roof_object(name, kind, height_m, x, y, FOOT)


def _clearance(array: str, other: str, direction: str, feet: float) -> Row:
    # Nobody said whether there is a fire pathway.
    return clearance(array, other, direction, feet * FOOT, pathway_m=None)


if __name__ == "__main__":
    main()
