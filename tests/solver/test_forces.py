"""What a plane hands to a block, against the equations of the paper written apart."""

import math

import numpy as np
import pytest

from blocks import block
from solver.forces import forces, friction_demand

pytestmark = pytest.mark.quick

RNG = np.random.default_rng(3)
AX, AY, AZ = RNG.normal(0.0, 3.0, (3, 50))


def scene(ax, ay=(), az=(), slope=0.1, scale=1.0):
    return block(ax, ay, az, slope=slope, scale=scale, g=9.81)


@pytest.mark.parametrize("slope", [0.0, 0.1, -0.3])
def test_gravity_less_the_acceleration_of_the_roof_is_turned_into_the_plane(slope):
    on_plane = forces(scene(AX, AY, AZ, slope=slope, scale=0.5))
    along = np.array([math.cos(slope), -math.sin(slope)])
    outward = np.array([math.sin(slope), math.cos(slope)])
    pull = np.array([-0.5 * AX, -9.81 - 0.5 * AZ])
    np.testing.assert_allclose(on_plane.down_mps2, along @ pull, rtol=0.0, atol=1e-14)
    np.testing.assert_allclose(on_plane.normal_mps2, -(outward @ pull), rtol=0.0, atol=1e-14)
    np.testing.assert_array_equal(on_plane.across_mps2, -0.5 * AY)


def test_absent_components_are_zero_and_the_demand_the_largest_between_samples():
    np.testing.assert_array_equal(forces(scene(AX)).across_mps2, np.zeros(50))
    np.testing.assert_array_equal(
        forces(scene(AX)).normal_mps2, forces(scene(AX, az=np.zeros(50))).normal_mps2
    )
    demand = friction_demand(scene(AX, AY, AZ))
    fine, at = np.linspace(0.0, 49.0, 49_001), np.arange(50.0)
    between = [np.interp(fine, at, a) for a in (AX, AY, AZ)]
    assert demand == pytest.approx(friction_demand(scene(*between)), rel=1e-14)
    assert friction_demand(scene(AX, AY, 10.0 * AZ)) == math.inf
    alone = forces(scene(AX))
    assert friction_demand(scene(AX)) == np.abs(alone.down_mps2 / alone.normal_mps2).max()


@pytest.mark.parametrize("size", [1e-200, 1.0, 1e100, 1e200])
@pytest.mark.parametrize("slope", [0.0, -0.2])
def test_the_friction_demand_is_to_the_last_bit_the_largest_ratio(size, slope):
    wave = np.random.default_rng(5).normal(0.0, 4.0, (3, 1000))
    sides, up = size * wave[:2], wave[2] / 9
    run = block(*sides, up, slope=slope if size <= 1.0 else 0.0, g=9.0)
    on_plane = forces(run)
    ratios = np.hypot(on_plane.down_mps2, on_plane.across_mps2) / on_plane.normal_mps2
    assert on_plane.normal_mps2.min() > 0.0
    assert friction_demand(run) == ratios.max()
