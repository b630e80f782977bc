"""What the page on basis says of the components is so for the motions at hand."""

from dataclasses import replace

import numpy as np

import stand_in
from report.assessment.certainty import certainty
from report.pages.front import basis
from report.pages.registry import package_data
from report.words.validation import explained
from solver.verification.shake_table import SHIPPED

MOTIONS = stand_in.motions(3, seconds=6.0)


def said(motions):
    data = stand_in.project(arrays=[stand_in.array("A1", 1.0)], objects=[], clearances=[])
    assessment = stand_in.assess_input(data, motions)
    return basis(package_data(assessment), certainty(assessment))


def test_motions_of_three_components_act_together():
    page = said(MOTIONS)
    assert page["components"].startswith("All components of a motion act together")
    assert "3 of 3 motions have a second horizontal component, 3 of 3 a" in page["components"]
    assert page["runs"].startswith("Each horizontal component in turn")


def test_motions_of_one_component_shake_along_the_slope_alone():
    page = said([replace(m, ay_mps2=np.empty(0), az_mps2=np.empty(0)) for m in MOTIONS])
    assert page["components"].startswith("Shaking and sliding along the slope only: 0 of 3")
    assert page["runs"].startswith("The horizontal component is applied along the slope; 3 of 3")


def test_one_polarity_is_not_called_two():
    page = said([replace(m, signs=(1,)) for m in MOTIONS])
    assert "0 of 3 motions are run both as recorded and reversed" in page["runs"]


def test_the_reason_of_a_motion_of_one_component_names_no_other():
    bare = replace(MOTIONS[0], ay_mps2=np.empty(0), az_mps2=np.empty(0))
    data = stand_in.project(arrays=[stand_in.array("A1", 1.0)], objects=[], clearances=[])
    (array,) = stand_in.assess_input(data, [bare]).arrays
    reasons = {run.solution.reason for run in array.motions[0].runs}
    assert reasons == {"the motion has no other component"}


def test_the_page_states_the_validation_of_the_tests_that_come_with_the_program():
    page = said(MOTIONS)
    assert page["validation"] == explained(SHIPPED)
    assert (
        "has not been validated against shake-table tests of ballasted arrays"
        in (page["validation"])
    )
