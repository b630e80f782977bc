"""The words of a study, as they were read and taken over last: `./roofslip test --golden`."""

import re

import pytest

import printed
from report.study.run import planned, run_study
from report.study.schema import Intensity
from study_books import small, write

pytestmark = pytest.mark.quick

CHANGING = (
    (r"Program( \|)? Roofslip.*", "Program <versions>"),
    (r"Study( \|)? [0-9a-f]{16}", "Study <hash>"),
    (r"all parts ran on .*?: a repetition gives the same bits", "<machine>"),
)


def test_a_study_has_the_words_that_it_had(golden, tmp_path):
    """Of spectral demand with tests, a clearance, an allowed displacement and a tolerance."""
    study = small(intensity=Intensity.S_DS, s_ds_g=1.0, intensities="0.2 to 2 by 0.2")
    folder = write(tmp_path, study, motions=4)
    text = printed.study(run_study(planned(str(folder))[0], str(tmp_path / "out")))
    for pattern, placeholder in CHANGING:
        text = re.sub(pattern, placeholder, text)
    golden("study.txt", text)
