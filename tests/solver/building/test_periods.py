"""Approximate periods of ASCE 7, worked by hand, and where they do not hold."""

import pytest

from refused import refused
from solver.building.structure import FOOT_M, approximate_period_s

pytestmark = pytest.mark.quick


@pytest.mark.parametrize(
    ("system", "height_ft", "period_s"),
    [
        ("steel moment frame", 65.0, 0.790),
        ("steel moment frame", 573.0, 4.505),
        ("concrete moment frame", 100.0, 1.010),
        ("concrete moment frame", 30.0, 0.342),
        ("steel eccentric or buckling-restrained braces", 16.0, 0.240),
        ("steel eccentric or buckling-restrained braces", 81.0, 0.810),
        ("other", 16.0, 0.160),
        ("other", 30.0, 0.256),
    ],
)
def test_the_approximate_period_is_that_of_the_table(system, height_ft, period_s):
    assert approximate_period_s(system, height_ft * FOOT_M) == pytest.approx(period_s, abs=5e-4)


def test_an_unknown_structure_and_a_height_of_nothing_are_both_named():
    unknown, _ = refused(approximate_period_s, "timber", 0.0)
    assert "'timber'" in unknown
