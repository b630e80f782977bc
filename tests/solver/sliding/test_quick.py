"""A record with plain numbers takes the quick way through `slide`, to the same result."""

import math
from dataclasses import astuple, replace

import numpy as np
import pytest

import solver
from fixtures.blocks import block, shaking
from fixtures.paths import ROOT
from solver.errors import InputError
from solver.model import Status
from solver.sliding import one_axis

pytestmark = pytest.mark.quick

RECORD = "projects/example/records/RM1-x.csv"


@pytest.fixture(scope="module")
def record():
    return solver.read_record(ROOT / RECORD)


def in_full(record, slope, mu, scale):
    """The same run by way of a checked scene."""
    scene = solver.scene(record, slope_rad=slope, mu=mu, scale=scale)
    return one_axis.run(scene)


def test_a_record_slides_as_its_checked_scene_does_to_the_last_bit(record):
    rng = np.random.default_rng(5)
    for slope, mu, scale in zip(
        rng.uniform(-0.3, 0.3, 60), rng.uniform(0.0, 1.0, 60), rng.uniform(-3, 3, 60), strict=True
    ):
        short = solver.slide(record, slope_rad=slope, mu=mu, scale=scale)
        np.testing.assert_array_equal(astuple(short), astuple(in_full(record, slope, mu, scale)))


def test_uplift_and_a_scale_of_zero_are_as_in_full(record):
    # On a steep slope a large horizontal acceleration lifts the block.
    steep = solver.slide(record, slope_rad=1.2, mu=0.4, scale=20.0)
    assert steep.status is solver.Status.UPLIFT
    np.testing.assert_array_equal(astuple(steep), astuple(in_full(record, 1.2, 0.4, 20.0)))
    assert solver.slide(record, slope_rad=0.0, mu=0.4, scale=0).prd_m == 0.0


def test_an_array_that_is_changed_between_two_calls_is_run_as_it_is(record):
    ours = replace(record, a_mps2=np.array(record.a_mps2))
    first = solver.slide(ours, slope_rad=0.02, mu=0.4)
    ours.a_mps2[:] *= 1.5
    second = solver.slide(ours, slope_rad=0.02, mu=0.4)
    assert second.prd_m > first.prd_m
    assert second == in_full(ours, 0.02, 0.4, 1.0)


def test_a_record_that_was_read_cannot_be_written_to(record):
    with pytest.raises(ValueError, match="read-only"):
        record.a_mps2[0] = 1.0
    # Nor by way of an array that it is a part of.
    assert record.a_mps2.base is None


@pytest.mark.parametrize(
    ("changed", "message"),
    [
        ({"mu": -0.1}, "mu is -0.1; use a friction coefficient of 0 or more"),
        ({"mu": math.nan}, "mu is nan"),
        ({"mu": "0.4"}, "mu is '0.4'"),
        ({"mu": True}, "mu is True"),
        ({"slope_rad": 1.6}, "slope_rad is 1.6; use an angle between -pi/2 and pi/2"),
        ({"scale": math.inf}, "scale is inf; use a finite factor"),
        ({"g_mps2": 0.0}, "g_mps2 is 0.0; use a number of m/s2 above 0"),
        ({"scale": 1e200}, "exceed the floating-point range"),
    ],
)
def test_what_is_not_plain_is_refused_with_the_words_of_the_checks(record, changed, message):
    with pytest.raises(InputError, match=message):
        solver.slide(record, **({"slope_rad": 0.02, "mu": 0.4} | changed))


def test_samples_that_are_not_finite_are_named(record):
    a = np.array(record.a_mps2)
    a[7] = math.nan
    with pytest.raises(InputError, match=r"ax_mps2\[7\] is nan; use finite accelerations"):
        solver.slide(replace(record, a_mps2=a), slope_rad=0.02, mu=0.4)


@pytest.mark.parametrize("vertical", [False, True])
def test_a_run_whose_bounds_are_known_is_any_run_to_the_last_bit(vertical):
    rng, statuses = np.random.default_rng(6), set()
    for seed in range(40):
        ax, az = (shaking(2 * seed + k, rng.uniform(2.0, 30.0)) for k in range(2))
        slope, mu, scale = rng.uniform(-0.5, 0.5), rng.uniform(0.0, 0.8), rng.choice([-1.0, 0.7])
        scene = block(ax, ax, az if vertical else (), slope=slope, friction=mu, scale=scale)
        known = one_axis.run_bounded(scene, one_axis.bounds_of(scene))
        np.testing.assert_array_equal(astuple(known), astuple(one_axis.run(scene)))
        statuses.add(known.status)
    assert statuses >= {Status.OK, Status.SLIDING_AT_END, Status.UPLIFT}
