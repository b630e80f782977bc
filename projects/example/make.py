"""Makes the example: seven roof motions from seeded noise, and the completed input workbook.

Run from the repository root: .venv/bin/python projects/example/make.py
"""

from __future__ import annotations

import datetime as dt
from pathlib import Path

from report.sheet.schema import ProjectInput, UnitsFirst
from report.sheet.template import write_template
from solver.records.record import write_record
from solver.rules.hazard import EDITIONS
from solver.rules.provisions import RULE_SETS
from solver.rules.spectra import ac156_horizontal, ac156_vertical
from solver.synthesis import make_suite

HERE = Path(__file__).resolve().parent
FOOT, INCH, POUND = 0.3048, 0.0254, 4.4482216152605
S_DS_G = 1.566
COUNT, SEED = 7, 1566
ENGINEER = "Engineer of record"
SOURCE = f"AC156 spectrum at the roof, seed {SEED}"


def main() -> None:
    """Write records/ and input.xlsx beside this file."""
    records = HERE / "records"
    records.mkdir(exist_ok=True)
    rules = RULE_SETS["SEAOC PV1-2012"]
    across = ac156_horizontal(EDITIONS[rules.edition], s_ds_g=S_DS_G, z_over_h=1.0)
    upward = ac156_vertical(s_ds_g=S_DS_G)
    suite = make_suite(
        (across.freq_hz, across.sa_g), (upward.freq_hz, upward.sa_g), count=COUNT, seed=SEED
    )
    for number, motion in enumerate(suite, start=1):
        for record, letter in zip(motion.components, "xyz", strict=True):
            write_record(records / f"RM{number}-{letter}.csv", record, hold_s=motion.hold_s)
    write_template(HERE / "input.xlsx", units=UnitsFirst.US, example=project())


def project() -> ProjectInput:
    """Return the project: a 360 ft by 240 ft warehouse roof with three slopes and fire lanes."""
    return ProjectInput.model_validate(
        {
            "project": {
                "name": "Distribution Warehouse, Rooftop Solar",
                "number": "EX-1566",
                "client": "Example client",
                "address": "Los Angeles, California",
                "prepared_by": ENGINEER,
                "checked_by": "",
                "date": dt.date(2026, 11, 20),
                "revision": "0",
                "units_first": "US",
            },
            "revisions": [
                {
                    "revision": "0",
                    "date": dt.date(2026, 11, 20),
                    "description": "Issued for plan check",
                    "by": ENGINEER,
                }
            ],
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
                "hazard_date": dt.date(2026, 11, 2),
                "sdc": "D",
                "force_factor": 1.0,
                "force_divisor": 1.5,
                "stories": 1,
                "structure_height_m": 36 * FOOT,
                "roof_height_m": 36 * FOOT,
            },
            "roof": {
                "x_from_m": 0.0,
                "x_to_m": 360 * FOOT,
                "y_from_m": 0.0,
                "y_to_m": 240 * FOOT,
                "north_deg": 90.0,
            },
            "building": {"structure": "other"},
            "target": {"t_l_s": 8.0},
            "friction_tests": {
                "laboratory": "Example laboratory, not a test",
                "accreditation": "ISO/IEC 17025, example",
                "standard": "ASTM G115-10",
                "report": "EX-FT-1",
                "date": dt.date(2026, 9, 15),
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
                _clearance("A1", "NORTH", "up", 8),
                _clearance("A3", "RTU-2", "down", 5),
                _clearance("A3", "PV-OLD", "up", 6),
                _clearance("A3", "EAST", "across", 10),
            ],
            "motions": [
                {
                    "id": f"RM{number}",
                    "record": f"records/RM{number}-x.csv",
                    "transverse": f"records/RM{number}-y.csv",
                    "vertical": f"records/RM{number}-z.csv",
                    "source": SOURCE,
                }
                for number in range(1, COUNT + 1)
            ],
        }
    )


def _array(
    name: str,
    slope: float,
    mu: float,
    x: tuple[float, float],
    y: tuple[float, float],
    **more: object,
) -> dict[str, object]:
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
        "downslope_deg": 270.0,
        **_plan(x, y),
        **more,
    }


def _friction_runs() -> list[dict[str, object]]:
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


def _object(
    name: str,
    kind: str,
    x: tuple[float, float],
    y: tuple[float, float],
    height_in: float | None,
) -> dict[str, object]:
    height_m = None if height_in is None else height_in * INCH
    return {"id": name, "kind": kind, "height_m": height_m, **_plan(x, y)}


def _plan(x: tuple[float, float], y: tuple[float, float]) -> dict[str, float]:
    sides = ("x_from_m", "x_to_m", "y_from_m", "y_to_m")
    return {side: value * FOOT for side, value in zip(sides, (*x, *y), strict=True)}


def _clearance(array: str, other: str, direction: str, feet: float) -> dict[str, object]:
    return {"array": array, "object": other, "direction": direction, "provided_m": feet * FOOT}


if __name__ == "__main__":
    main()
