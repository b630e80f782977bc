"""A design displacement is one number wherever it stands: rounded up, on every sheet and screen."""

import math
import re

import numpy as np
import pytest

import scenes
from printed import IDS, printed
from report.assessment.assess import reassess
from report.pages.summary import summary
from report.web.answers import answer

pytestmark = pytest.mark.quick

INCH = 0.0254
# On the sheets of results a value in one direction, which is another one, may be the lower number.
PAGES = (
    "letter", "summary", "plan", "comparison", "method", "model",
    "accuracy",
)  # fmt: skip


@pytest.fixture(scope="module")
def example():
    """The example with a slope of A3 whose displacement would be less, rounded to the nearest."""
    given = scenes.shipped("example")
    for slope_deg in np.arange(3.0, 2.5, -0.03).tolist():
        arrays = (
            array.model_copy(update={"slope_value": slope_deg}) if array.id == "A3" else array
            for array in given.project.arrays
        )
        data = given.project.model_copy(update={"arrays": tuple(arrays)})
        other = reassess(given, data)
        if round(inches := other.governing.design_m / INCH, 1) < inches:
            return scenes.package_data(other)
    raise AssertionError


def test_no_page_rounds_the_design_displacement_down(example):
    item = example.assessment.governing
    inches = item.design_m / INCH
    up, down = (f"{to(10 * inches) / 10:.1f}" for to in (math.ceil, math.floor))
    assert up != down
    assert round(inches, 1) == float(down)  # rounded to the nearest it would be less
    assert set(PAGES) <= {"letter", *IDS}
    for page in PAGES:
        words = printed(example, page)
        assert not re.search(rf"(?<![\d.]){re.escape(down)}(?!\d)", words), page
    for page in ("letter", "summary", "comparison", "plan"):
        assert up in printed(example, page)
    said = "\n".join(summary(example.assessment))
    assert up in said
    assert f"{down} in" not in said
    shown = str(answer(example.assessment, is_provisional=False)["arrays"])
    assert up in shown
    assert f"{down} in" not in shown
