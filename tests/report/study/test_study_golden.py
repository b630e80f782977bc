"""The words of a study, as they were read and taken over last: `./roofslip test --golden`."""

import re

from test_study_read import given, write

import printed
from report.study.run import planned, run_study
from report.study.schema import Intensity, StudyArray

CHANGING = (
    (r"Program( \|)? Roofslip.*", "Program <versions>"),
    (r"Study( \|)? [0-9a-f]{16}", "Study <hash>"),
    (r"all parts ran on .*?: a repetition gives the same bits", "<machine>"),
)


def test_a_study_has_the_words_that_it_had(golden, tmp_path):
    """Of spectral demand with tests, a clearance, an allowed displacement and a tolerance."""
    study = given(
        slopes_deg="0, 2, 4",
        mus="0.3, 0.5",
        intensity=Intensity.S_DS,
        s_ds_g=1.0,
        intensities="0.2 to 2 by 0.2",
        allowed_m=0.1,
        site_intensity=1.0,
        intensity_beta=0.2,
        slope_tolerance_deg=0.25,
        samples=20,
        study_arrays=(
            StudyArray(id="S1", mat="A", slope_deg=2.0, clearance_m=0.1, reaches="RTU & co"),
            StudyArray(id="S 2", mat="B", slope_deg=0.0, clearance_m=0.02),
        ),
    )
    folder = write(tmp_path, study, motions=4)
    text = printed.study(run_study(planned(folder)[0], tmp_path / "out"))
    for pattern, placeholder in CHANGING:
        text = re.sub(pattern, placeholder, text)
    golden("study.txt", text)
