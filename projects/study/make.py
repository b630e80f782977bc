"""Makes the study: seven roof motions for S_DS = 1 g, and the completed study workbook.

Run from the repository root: .venv/bin/python projects/study/make.py
"""

from __future__ import annotations

import datetime as dt
from pathlib import Path

from projects.rows import write_motions
from report.sheet.schema.choices import UnitsFirst
from report.study.schema import Intensity, Mat, Study, StudyArray, StudyInput
from report.study.template import write_study
from report.suite.inputs import ac156_targets
from solver.rules.spectra import Tail
from solver.synthesis.suite import make_suite

HERE = Path(__file__).resolve().parent
INCH = 0.0254
S_DS_G = 1.0
COUNT, SEED = 7, 15


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
    )


if __name__ == "__main__":
    main()
