"""Statistics and values read off curves, against hand calculations and the paper's procedure."""

import math

import numpy as np
import pytest

from solver.studies.curves import first_allowed, statistics

pytestmark = pytest.mark.quick

NONE = math.nan


@pytest.mark.parametrize(
    ("values", "mean", "p84", "largest"),
    [
        (np.arange(101.0)[::-1], 50.0, 84.0, 100.0),
        # The place 0.84 x 6 = 5.04 lies between the sixth value and the one that is missing.
        ([1.0, 2.0, 3.0, 4.0, 5.0, 6.0, NONE], NONE, NONE, NONE),
        ([*map(float, range(1, 20)), NONE], NONE, 1 + 0.84 * 19, NONE),
    ],
)
def test_a_motion_without_a_value_is_larger_than_all_others(values, mean, p84, largest):
    found = statistics(np.array([values, values]))
    for each, wanted in ((found.mean_m, mean), (found.p84_m, p84), (found.largest_m, largest)):
        assert each == pytest.approx([wanted] * 2, rel=1e-14, nan_ok=True)
    assert found.without_value.tolist() == [int(math.isnan(mean))] * 2


@pytest.mark.parametrize(
    ("prds_m", "limit_m", "expected"),
    [
        ((0.9, 0.5, 0.1), 0.3, 0.45),  # between two runs
        ((0.9, 0.5, 0.1), 1.0, 0.3),
        ((0.9, 0.5, 0.1), 0.05, NONE),
        ((0.2, 0.4, 0.2), 0.3, 0.45),  # above every coefficient that exceeds the limit
        ((NONE, 0.2, 0.1), 0.3, 0.4),  # a run without a value exceeds every limit
        ((0.1, 0.2, NONE), 0.3, NONE),
    ],
)
def test_least_friction_is_above_what_exceeds_the_limit(prds_m, limit_m, expected):
    found = first_allowed(np.array([0.3, 0.4, 0.5]), np.array(prds_m), limit_m)
    assert found == pytest.approx(expected, rel=1e-14, nan_ok=True)


@pytest.mark.parametrize(
    ("prds_m", "expected"),
    [
        ((0.1, 0.2, 0.4, 0.3), 3.0),
        ((0.1, 0.2, 0.3, 0.3), 6.0),
        ((0.1, 0.2, NONE, 0.3), 2.0),
        ((0.4, 0.2, 0.2, 0.2), NONE),
    ],
)
def test_largest_slope_is_below_every_slope_that_exceeds_the_limit(prds_m, expected):
    found = first_allowed(np.array([6.0, 4.0, 2.0, 0.0]), np.array(prds_m[::-1]), 0.3)
    assert found == pytest.approx(expected, rel=1e-14, nan_ok=True)
