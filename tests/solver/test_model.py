"""Motions, forces and friction: the paper's equations written apart, and laws fitted to runs."""

import math
from dataclasses import replace

import numpy as np
import pytest

from fixtures.blocks import block
from solver import friction_tests
from solver.forces import forces, friction_demand
from solver.friction_tests import FrictionRun, Surface, fit_law, governing, series
from solver.model import Friction, Motion, coulomb
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


def law_of(mu_fast, rate, mu_slow=0.40):
    return Friction(mu_slow=mu_slow, mu_fast=mu_fast, rate_s_per_m=rate, mu_static=mu_slow)


LAW = law_of(0.52, 20.0)
VELOCITIES = (0.002, 0.01, 0.03, 0.06, 0.1, 0.2)


def run(mu, *, surface=Surface.DRY, report="R1", velocity=math.nan, static=math.nan):
    about = {"report": report, "surface": surface, "velocity_mps": velocity}
    return FrictionRun(mu=mu, mu_static=static, **about)


def test_a_law_is_averaged_at_tested_velocities_and_the_smallest_mean_governs():
    assert LAW.at(0.0) == 0.40
    assert LAW.at(1e3) == 0.52
    assert LAW.at(math.log(2.0) / 20.0) == pytest.approx(0.46, abs=1e-15)
    assert coulomb(0.45).at(0.3) == 0.45
    wet, other, none = run(0.46, surface=Surface.WET), run(0.40, report="R10"), run(0.1, report="")
    groups = series([run(0.50), wet, other, none])
    wanted = {"": 0.1, "ASTM G115, r1, 2025": 0.46, "R10": 0.4, "R1 and R10": 0.4, "R100": 0.1}
    assert {named: governing(groups, named).mean for named in wanted} == wanted
    (tested,) = series([run(0.4, velocity=0.0), run(0.5, velocity=math.log(2.0) / 20.0)])
    assert tested.mean_of(LAW) == pytest.approx((0.40 + 0.46) / 2, abs=1e-15)
    assert tested.mean_of(coulomb(0.45)) == 0.45
    (unknown,) = series([run(0.5)])
    assert unknown.mean_of(LAW) == 0.52
    assert unknown.mean_of(law_of(0.3, 20.0, mu_slow=0.5)) == 0.5


def test_runs_are_averaged_by_report_surface_and_velocity():
    wet = [run(mu, surface=Surface.WET) for mu in (0.45, 0.46, 0.50)]
    dry = [run(0.60, static=0.66), run(0.62, static=0.70), run(0.58)]
    other = [run(0.30, report="R2")]
    groups = series([dry[0], *wet, *dry[1:], *other])
    assert [(group.report, group.surface, len(group.runs)) for group in groups] == [
        ("R1", Surface.DRY, 3), ("R1", Surface.WET, 3), ("R2", Surface.DRY, 1),
    ]  # fmt: skip
    assert [group.mean for group in groups] == pytest.approx([0.60, 0.47, 0.30], abs=1e-15)
    assert groups[0].static_mean == pytest.approx(0.68)
    assert math.isnan(groups[1].static_mean)
    runs = [run(0.50, velocity=0.1), run(0.40), run(0.44, velocity=0.02), run(0.42)]
    more = [run(0.48, velocity=0.1049), run(0.46, velocity=0.0205), run(0.49, velocity=0.1051)]
    (tested,) = series([*runs, *more])
    found = [[one.mu for one in group.runs] for group in tested.repeats]
    assert found == [[0.44, 0.46], [0.50, 0.48], [0.49], [0.40, 0.42]]
    assert tested.repeats[0].velocity_mps == 0.0205
    assert math.isnan(tested.repeats[-1].velocity_mps)
    assert tested.velocity_mps == 0.1051
    assert tested.minimum_mu == pytest.approx(0.41, abs=1e-15)
    (still,) = series([run(0.5, velocity=0.0), run(0.6, velocity=0.0)])
    assert (len(still.repeats), still.minimum_mu) == (1, pytest.approx(0.55, abs=1e-15))


@pytest.mark.parametrize("mu_fast", [0.52, 0.31])
@pytest.mark.parametrize("rate", [3.0, 20.0, 400.0])
def test_runs_on_a_law_give_that_law(mu_fast, rate):
    law = law_of(mu_fast, rate)
    fit = fit_law(VELOCITIES, [law.at(v) for v in VELOCITIES])
    assert fit.is_determined
    assert fit.law.rate_s_per_m == pytest.approx(rate, rel=1e-9)
    assert (fit.law.mu_slow, fit.law.mu_fast) == pytest.approx((0.40, mu_fast), abs=1e-11)
    assert fit.law.mu_static == fit.law.mu_slow
    assert fit.rms < 1e-12


def test_scattered_runs_give_the_law_at_which_the_sum_of_squares_is_stationary():
    rng = np.random.default_rng(5)
    v = np.repeat(VELOCITIES, 3)
    mu = np.array([LAW.at(speed) for speed in v]) + rng.normal(0.0, 0.01, v.size)
    fit = fit_law(tuple(v), tuple(mu))
    law = fit.law
    residual = mu - [law.at(speed) for speed in v]
    assert fit.rms == pytest.approx(math.sqrt(np.mean(residual**2)), rel=1e-12)
    decay = np.exp(-law.rate_s_per_m * v)
    drop = law.mu_fast - law.mu_slow
    # Derivatives of the law by mu_slow, mu_fast and the logarithm of the rate.
    for slope in (decay, 1.0 - decay, drop * law.rate_s_per_m * v * decay):
        cosine = residual @ slope / (np.linalg.norm(residual) * np.linalg.norm(slope))
        assert abs(cosine) < 1e-6
    for rate in np.geomspace(0.5, friction_tests.MOST_RATE_S_PER_M, 5000):
        columns = np.stack([np.exp(-rate * v), np.ones_like(v)], axis=1)
        squares = np.linalg.lstsq(columns, mu)[1][0]
        assert v.size * fit.rms**2 <= squares * (1.0 + 1e-12)


def test_few_or_low_velocities_and_laws_out_of_range_give_none():
    few = VELOCITIES[: friction_tests.LEAST_VELOCITIES - 1]
    assert fit_law(few * 3, [0.4, 0.42, 0.43] * 3) is None
    assert fit_law((*few, math.nan), [0.4, 0.42, 0.43, 0.44]) is None
    assert fit_law((*few, 0.05), [0.4, 0.42, 0.43, 0.44]) is not None
    law = law_of(friction_tests.MOST_MU + 0.2, 4.0)
    fit = fit_law(VELOCITIES, [law.at(v) for v in VELOCITIES])
    assert fit.law.mu_fast == pytest.approx(law.mu_fast)
    assert not fit.is_determined
    assert fit_law((0.0, 1e-6, 2e-6, 3e-6), (0.4, 0.41, 0.42, 0.43)) is None


@pytest.mark.parametrize(
    "mus",
    [
        (0.46,) * 6,
        tuple(0.46 + 1e-16 * k for k in range(6)),
        tuple(0.4 + 0.5 * v for v in VELOCITIES),  # a straight line: no high-velocity value
        (0.40, 0.50, 0.50, 0.50, 0.50, 0.50),  # the transition lies below the second velocity
    ],
)
def test_runs_that_do_not_show_a_transition_determine_no_law(mus):
    assert not fit_law(VELOCITIES, mus).is_determined
