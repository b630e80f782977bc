"""Makes a project with the seismic parameters of a permit of the City of Santa Ana.

The parameters are those of its calculation sheet (document 370815, sheet 20). The arrays are not:
the sheet states a separation for each kind of neighbor, and the project has one of each kind.

Run from the repository root: .venv/bin/python projects/permit/make.py
"""

from __future__ import annotations

import datetime as dt
from pathlib import Path

from projects.rows import clearance, issued, rectangle, roof_object
from report.project.model import ProjectInput
from report.project.model.choices import UnitsFirst
from report.project.write.template import write_template

HERE = Path(__file__).resolve().parent
FOOT, INCH, POUND = 0.3048, 0.0254, 4.4482216152605


def main() -> None:
    """Write input.xlsx beside this file."""
    write_template(HERE / "input.xlsx", units=UnitsFirst.US, example=project())


def project() -> ProjectInput:
    """Return the project: two arrays of similar construction, an object and two roof edges."""
    array = {
        "slope_value": 1.0,
        "slope_unit": "deg",
        "mu": 0.50,
        "construction": "Ballasted tray",
        "weight_n": 10_000 * POUND,
        "cg_height_m": 9 * INCH,
        "support_spacing_m": 40 * INCH,
        "downslope_deg": 270.0,
    }
    return ProjectInput.model_validate(
        {
            **issued(
                "Seismic parameters of a permit",
                "SA-370815",
                "Example client",
                "Santa Ana, California",
                "US",
                date=dt.date(2025, 11, 20),  # California adopts ASCE 7-22 from 2026
            ),
            "site": {
                "rule_set": "ASCE 7-16",
                "risk_category": "II",
                "site_class": "D (default)",
                "s_s_g": 1.313,
                "s_1_g": 0.471,
                "f_v": 1.829,
                "i_e": 1.0,
                "sdc": "D",
                "hazard": "exception of 11.4.8",
                "hazard_source": "City of Santa Ana, document 370815, sheet 20",
                "force_factor": 1.0,
                "force_divisor": 1.5,
                "stories": 2,
                "structure_height_m": 35 * FOOT,
                "roof_height_m": 35 * FOOT,
            },
            "building": {"structure": "other"},
            "arrays": [
                {"id": "A1", **array, **rectangle((5, 25), (30, 55), FOOT)},
                {"id": "A2", **array, **rectangle((5, 25), (5, 27), FOOT)},
            ],
            "objects": [
                roof_object("RTU-1", "fixed object", 48 * INCH, (28, 36), (40, 48), FOOT),
                roof_object("NORTH", "edge with parapet", 36 * INCH, (0, 80), (60, 61), FOOT),
                roof_object("SOUTH", "edge without parapet", None, (0, 80), (-1, 0), FOOT),
            ],
            "clearances": [
                clearance("A1", "A2", "any", 3 * FOOT),
                clearance("A1", "RTU-1", "any", 3 * FOOT),
                clearance("A1", "NORTH", "any", 5 * FOOT),
                clearance("A2", "SOUTH", "any", 5 * FOOT),
            ],
        }
    )


if __name__ == "__main__":
    main()
