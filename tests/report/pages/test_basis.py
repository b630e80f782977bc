"""What the page on basis says of the components is so for the motions at hand."""

from dataclasses import replace

import numpy as np
import pytest

import scenes
import stand_in
from printed import printed

MOTIONS = scenes.motions(3, seconds=6.0)
ONE_POLARITY = tuple(replace(motion, signs=(1,)) for motion in MOTIONS)
ONE = {"arrays": [stand_in.array("A1", 1.0)], "objects": [], "clearances": []}


@pytest.mark.parametrize(
    ("motions", "components", "runs"),
    [
        (MOTIONS, "All components of a motion act together", "Each horizontal component in turn"),
        (
            scenes.along(MOTIONS),
            "Shaking and sliding along the slope only: 0 of 3",
            "The horizontal component is applied along the slope; 3 of 3",
        ),
        (ONE_POLARITY, "All components", "Each horizontal component in turn"),
    ],
)
def test_the_components_and_the_polarities_are_those_of_the_motions(motions, components, runs):
    page = printed(scenes.package(motions, **ONE), "basis")
    assert page.line(components)
    both = 0 if motions is ONE_POLARITY else 3
    assert f"{both} of 3 motions are run both as recorded and reversed" in page.line(runs)


def test_the_reason_of_a_motion_of_one_component_names_no_other():
    bare = replace(MOTIONS[0], ay_mps2=np.empty(0), az_mps2=np.empty(0))
    (array,) = stand_in.assess_input(stand_in.project(**ONE), [bare]).arrays
    reasons = {run.solution.reason for run in array.motions[0].runs}
    assert reasons == {"the motion has no other component"}
