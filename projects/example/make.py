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
    write_template(HERE / "input.xlsx", units=UnitsFirst.US, example=example())


def example() -> ProjectInput:
    """Return the project: a 360 ft by 240 ft warehouse roof with three slopes."""
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
                "risk_category": "II",
                "i_e": 1.0,
                "site_class": "D",
                "s_ds_g": S_DS_G,
                "sdc": "D",
                "stories": 1,
                "structure_height_m": 36 * FOOT,
                "roof_height_m": 36 * FOOT,
            },
            "arrays": [
                # One axis is requested, as in an earlier package. The page on the models shows
                # that two axes do not change its design displacement: the floor governs.
                _array("A1", 0.5, 0.50, (30, 150), (130, 232), model="one axis with vertical"),
                # The simplest adequate model is chosen: two axes.
                _array("A2", 2.0, 0.50, (30, 150), (30, 127)),
                # Velocity-dependent friction: less friction at low velocity than at high velocity.
                _array("A3", 3.0, 0.40, (190, 350), (30, 190), mu_fast=0.50, mu_rate_s_per_m=20.0),
            ],
            "objects": [
                _object("RTU-1", "fixed object", (154, 164), (150, 162), 48),
                _object("RTU-2", "fixed object", (260, 272), (14, 26), 48),
                _object("PV-OLD", "unlike array", (200, 340), (194, 222), None),
                _object("NORTH", "edge with parapet", (0, 360), (240, 241), 30),
                _object("EAST", "edge without parapet", (360, 361), (0, 240), None),
            ],
            "clearances": [
                _clearance("A1", "A2", "down", 3),
                _clearance("A1", "RTU-1", "across", 4),
                _clearance("A3", "RTU-2", "down", 4),
                _clearance("A3", "PV-OLD", "up", 4),
                _clearance("A1", "NORTH", "up", 8),
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
        "mu_report": "Example value, not a test",
        "construction": "Ballasted tray, 10 deg tilt",
        "weight_n": 5.5 * area_sqft * POUND,
        "cg_height_m": 9 * INCH,
        "support_spacing_m": 40 * INCH,
        "downslope_deg": 270.0,
        **_plan(x, y),
        **more,
    }


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
