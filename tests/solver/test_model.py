"""The records of the solver: a motion and its scenes."""

import math
from dataclasses import replace

import numpy as np
import pytest

from solver.forces import friction_demand
from solver.model import Motion, coulomb
from solver.records.record import read_only
from solver.sliding import one_axis, two_axes

pytestmark = pytest.mark.quick


@pytest.fixture
def motion():
    sides = {f"a{axis}_mps2": read_only([0.0, k, -k]) for k, axis in enumerate("xyz", start=1)}
    return Motion(id="M1", source="", dt_s=0.01, **sides, scale=2.0, signs=(1, -1))


def scenes(motion):
    about = {"slope_rad": math.radians(2.0), "friction": coulomb(0.4)}
    return [motion.scene(orientation, **about) for orientation in motion.orientations]


def test_components_of_a_motion_are_in_every_heading_and_shared(motion):
    x, y, z = motion.ax_mps2, motion.ay_mps2, motion.az_mps2
    along = [scene.ax_mps2 for scene in scenes(motion)]
    for found, wanted in zip(along, (x, -x, y, -y), strict=True):
        assert np.array_equal(found, wanted)
        assert not found.flags.writeable
    across = zip(scenes(motion), (y, y, x, x), strict=True)
    assert all(scene.ay_mps2 is wanted for scene, wanted in across)
    assert all(scene.az_mps2 is z and scene.scale == 2.0 for scene in scenes(motion))
    for one, other in zip(scenes(motion), scenes(motion), strict=True):
        assert one.ax_mps2 is other.ax_mps2


@pytest.mark.parametrize("solve", [one_axis.run, two_axes.run, friction_demand])
def test_a_kernel_takes_the_scale_as_scaled_applies_it(motion, solve):
    scaled = {f"a{axis}_mps2": read_only(motion.scaled(a)) for axis, a in motion.components.items()}
    for scene, alike in zip(
        scenes(motion), scenes(replace(motion, **scaled, scale=1.0)), strict=True
    ):
        assert solve(scene) == solve(alike) != solve(replace(scene, scale=1.0))
