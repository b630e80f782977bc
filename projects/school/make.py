"""Makes the school: ground motions from seeded noise, and the completed input workbook.

The letter of review beside it is an example as well, and is not made here.

Run from the repository root: .venv/bin/python projects/school/make.py
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
S_S_G, F_A, S_1_G, F_V, T_L_S = 0.55, 1.28, 0.16, 1.5, 6.0
S_DS_G = 2.0 / 3.0 * F_A * S_S_G
COUNT, SEED = 7, 716
# 24 s at full level: the building may shorten the strong motion, and 20 s are required at the roof.
DT_S, DURATION_S = 0.01, 36.0
# A_FLX at the roof / at grade: below its first frequency the building amplifies nothing.
FACTOR = 1.6
SOURCE = (
    f"Generated: AC156 at grade, vertical AC156 / {FACTOR}, seed {SEED}."
    f" Factor {FACTOR}: A_FLX at the roof / at grade"
)


def main() -> None:
    """Write records/ and input.xlsx beside this file."""
    write_motions(HERE / "records", "GM", suite(COUNT))
    write_template(HERE / "input.xlsx", units=UnitsFirst.SI, example=project())


def suite(count: int) -> list[SuiteMotion]:
    """Return the ground motions: horizontal components to AC156 at grade."""
    grade = ac156_targets("asce7-16", s_ds_g=S_DS_G, z_over_h=0.0, tail=Tail.AC156)
    freq_hz, sa_g = grade.vertical
    return make_suite(
        grade.horizontal,
        # The factor acts on all components, and the building does not amplify the vertical one.
        (freq_hz, sa_g / FACTOR),
        count=count,
        seed=SEED,
        dt_s=DT_S,
        duration_s=DURATION_S,
    )


def project() -> ProjectInput:
    """Return the project: a two-story school, its roof steeper than 1 in 20, with peer review."""
    return ProjectInput.model_validate(
        {
            **issued(
                "Two-Story School, Rooftop Solar",
                "SC-716",
                "Example school district",
                "Albuquerque, New Mexico",
                "SI",
                date=dt.date(2026, 11, 20),
            ),
            "site": {
                "rule_set": "ASCE 7-16",
                "risk_category": "III",
                "i_e": 1.25,
                "s_s_g": S_S_G,
                "s_1_g": S_1_G,
                "site_class": "C",
                "f_a": F_A,
                "f_v": F_V,
                "sdc": "C",
                "stories": 2,
                "structure_height_m": 8.5,
                "roof_height_m": 8.5,
                "hazard_source": "Example values, not from the ASCE 7 Hazard Tool",
                "hazard_date": dt.date(2026, 11, 2),
                "hazard_covered": "2026-11-02: Site 53516c",
                "force_factor": 1.0,
                "force_divisor": 1.5,
                "building_code": "IBC",
                "building_code_year": 2021,
                "jurisdiction": "City of Albuquerque",
                "fire_code_section": "2021 IFC, example section",
                "latitude_deg": 35.0844,
                "longitude_deg": -106.6504,
                "roof_evaluation": "New building; example, not an evaluation",
            },
            "roof": rectangle((0.0, 60.0), (0.0, 34.0), 1.0),
            "arrays": [
                _array("A1", (3.0, 28.0), (3.0, 31.0)),
                _array("A2", (32.0, 57.0), (3.0, 26.0)),
            ],
            "friction_tests": {
                "laboratory": "Example Laboratories",
                "accreditation": "ISO/IEC 17025, no. 1234.01",
                "standard": "ASTM G115-10",
                "report": "FT-2026-031",
                "date": dt.date(2026, 6, 12),
                "tests_covered": "2026-06-12: Friction tests 6aae5b",
                "membrane": "TPO, 60 mil",
                "support": "EPDM pad",
            },
            "friction_runs": [
                {
                    "surface": surface,
                    "number": number,
                    "mu": mu,
                    "velocity_mps": 0.5,
                    "mu_static": mu + 0.04,
                }
                for surface, tested in (("dry", (0.55, 0.56, 0.54)), ("wet", (0.50, 0.51, 0.49)))
                for number, mu in enumerate(tested, start=1)
            ],
            "objects": [
                roof_object("AHU-1", "fixed object", 1.4, (40.0, 46.0), (28.0, 31.0), 1.0),
                roof_object("NORTH", "edge with parapet", 0.9, (0.0, 60.0), (34.0, 34.3), 1.0),
                roof_object("SOUTH", "edge with parapet", 0.9, (0.0, 60.0), (-0.3, 0.0), 1.0),
                roof_object("EAST", "edge with parapet", 0.9, (60.0, 60.3), (0.0, 34.0), 1.0),
                roof_object("WEST", "edge with parapet", 0.9, (-0.3, 0.0), (0.0, 34.0), 1.0),
            ],
            "clearances": [
                clearance("A1", "A2", "cross-slope", 4.0),
                clearance("A2", "AHU-1", "upslope", 2.0),
                clearance("A1", "NORTH", "upslope", 3.0),
                clearance("A1", "SOUTH", "downslope", 3.0),
                clearance("A1", "WEST", "cross-slope", 3.0),
                clearance("A2", "SOUTH", "downslope", 3.0),
                clearance("A2", "EAST", "cross-slope", 3.0),
            ],
            "motions": [
                motion(
                    f"GM{number}",
                    "xyz",
                    SOURCE,
                    scaling="factor",
                    scale_value=FACTOR,
                    recorded_at="ground",
                )
                for number in range(1, COUNT + 1)
            ],
            "building": {"structure": "other"},
            "options": {
                "peer_reviewed": True,
                "peer_reviewer": "Reviewer of record",
                "peer_license": "NM S0000",
                "peer_date": dt.date(2026, 11, 16),
                # As `roofslip report` fills it in; so the other two.
                "peer_covered": "2026-11-16: Site c8e60b, Arrays 01b03f, Friction tests 5c1207,"
                " Motions ace4a8, Building 065d3c",
                "peer_letter": "peer-review.pdf",
                "smaller_events": "0.50, 0.50",
            },
            "target": {"t_l_s": T_L_S},
        }
    )


def _array(name: str, x: Range, y: Range) -> Row:
    """Return an array of the same product; south is downslope, 0.75 in 12, which is 1 in 16."""
    area_m2 = (x[1] - x[0]) * (y[1] - y[0])
    return {
        "id": name,
        "slope_value": 0.75,
        "slope_unit": "in/12",
        "mu": 0.50,
        "mu_report": "FT-2026-031",
        "construction": "Ballasted tray, 10 deg tilt",
        "weight_n": 260.0 * area_m2,
        "cg_height_m": 0.23,
        "support_spacing_m": 1.0,
        "downslope_deg": 270.0,
        "i_p": 1.0,
        "interconnection_n": 15.0e3,
        "slack_m": 1.2,
        "roof_capacity_pa": 300.0,
        "wind_weight_pa": 260.0,
        **rectangle(x, y, 1.0),
    }


if __name__ == "__main__":
    main()
