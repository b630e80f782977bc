"""Statistics and values read off curves, against hand calculations and the paper's procedure."""

import math

import numpy as np
import pytest

from solver.studies.curves import first_allowed, statistics

pytestmark = pytest.mark.quick

NONE = math.nan


def test_mean_percentile_and_largest_of_known_values():
    found = statistics(np.arange(101.0)[None, ::-1])
    assert (found.mean_m[0], found.largest_m[0], found.without_value[0]) == (50.0, 100.0, 0)
    assert found.p84_m[0] == pytest.approx(84.0, rel=1e-14)


def test_the_percentile_is_that_of_numpy():
    values = np.random.default_rng(3).lognormal(size=(5, 7))
    assert statistics(values).p84_m == pytest.approx(np.percentile(values, 84, axis=-1), rel=1e-14)


def test_a_motion_without_a_value_is_larger_than_all_others():
    found = statistics(np.array([[1.0, 2.0, 3.0, 4.0, 5.0, 6.0, NONE]]))
    # The place 0.84 x 6 = 5.04 lies between the sixth value and the one that is missing.
    assert np.isnan([found.mean_m[0], found.largest_m[0], found.p84_m[0]]).all()
    assert found.without_value[0] == 1


def test_the_percentile_does_not_depend_on_a_missing_value_above_it():
    values = np.array([*range(1, 20), NONE], dtype=float)[None, :]
    assert statistics(values).p84_m[0] == pytest.approx(1 + 0.84 * 19, rel=1e-14)


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
