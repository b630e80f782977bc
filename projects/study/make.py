"""Makes the study: seven roof motions for S_DS = 1 g, and the completed study workbook.

Run from the repository root: .venv/bin/python projects/study/make.py
"""

from __future__ import annotations

import datetime as dt
from pathlib import Path

from projects.rows import write_motions
from report.project.model.choices import UnitsFirst
from report.study.read_study import write_study
from report.study.study_input import (
    Hazard,
    Intensity,
    Mat,
    Study,
    StudyArray,
    StudyFrictionRun,
    StudyInput,
)
from report.suite.targets import ac156_targets
from solver.friction_tests import Surface
from solver.rules.ac156 import Tail
from solver.synthesis.suite import make_suite

HERE = Path(__file__).resolve().parent
INCH = 0.0254
S_DS_G = 1.0
COUNT, SEED = 7, 15
RUNS = {Surface.DRY: (0.55, 0.57, 0.54), Surface.WET: (0.49, 0.50, 0.51)}


def main() -> None:
    """Write records/ and input.xlsx beside this file."""
    roof = ac156_targets("pv1", s_ds_g=S_DS_G, z_over_h=1.0, tail=Tail.AC156)
    suite = make_suite(roof.horizontal, roof.vertical, count=COUNT, seed=SEED)
    write_motions(HERE / "records", "RM", suite)
    write_study(HERE / "input.xlsx", units=UnitsFirst.US, example=study())


def study() -> StudyInput:
    """Return the study: catalog curves of three mats on eight slopes at twenty intensities."""
    return StudyInput(
        study=Study(
            title="Catalog curves for three mats",
            prepared_by="Example, not a product",
            date=dt.date(2026, 11, 20),
            slopes_deg="0 to 7 by 1",
            intensity=Intensity.PPA,
            intensities="0.1 to 2 by 0.1",
            allowed_m=24 * INCH,
            folder="records",
            site_intensity=1.2,
            intensity_beta=0.15,
            slope_tolerance_deg=0.25,
            samples=50,
            seed=SEED,
            record_beta=0.40,
            record_source="Example: FEMA P695 for the collapse of buildings, not sliding",
        ),
        mats=(
            Mat(id="Foam", mu=0.40, tested="0.37, 0.40, 0.42, 0.41", report="Example values"),
            Mat(id="EPDM", mu=0.50, tested="0.47, 0.50, 0.53, 0.51, 0.49", report="Example values"),
            Mat(id="Rubber", mu=0.6, report="Example values"),
        ),
        study_arrays=(
            StudyArray(id="A1", mat="EPDM", slope_deg=2.0, clearance_m=24 * INCH, reaches="RTU-1"),
        ),
        hazard=Hazard(
            file="hazard-pga.csv",
            site="Los Angeles, 34.05, -118.25",
            source="U.S. Geological Survey, test outputs of nshmp-haz; public domain, provisional",
            edition="National Seismic Hazard Model 2018, western US",
            vs30_mps=760.0,
            site_vs30_mps=530.0,
            site_factor=1.2,
            site_basis="Example: F_PGA of ASCE 7-16 Table 11.8-1, site class C",
            roof_factor=3.0,
            roof_basis="Example: 1 + 2 z/h of ASCE 7-16 13.3.1 at z/h = 1",
            recenter_m=6 * INCH,
        ),
        friction_runs=tuple(
            StudyFrictionRun(mat="EPDM", surface=surface, number=number, mu=mu)
            for surface, values in RUNS.items()
            for number, mu in enumerate(values, start=1)
        ),
    )


if __name__ == "__main__":
    main()
