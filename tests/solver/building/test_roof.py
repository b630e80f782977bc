"""From ground to roof, against matrix exponentials, all floors at once and closed forms."""

import math
from itertools import pairwise

import numba
import numpy as np
import pytest
import scipy.linalg
from hypothesis import given, settings
from hypothesis import strategies as st

import solver
from fixtures.spaces import spaced
from solver.building.roof import (
    FINENESS,
    MOST_STEPS,
    RESTING_SHARE,
    absolute_accelerations,
    lengthened,
    roof_motion,
    shaking_to_roof,
    to_roof,
)
from solver.building.structure import (
    BEAM_MODES,
    building_of_modes,
    building_of_periods,
    floor_stiffness,
)
from solver.errors import InputError

pytestmark = pytest.mark.skipif(
    numba.config.DISABLE_JIT, reason="records take minutes without compiled kernels"
)


@pytest.fixture(scope="module")
def ground(noise):
    return noise[:1200].copy()


def stepped(system, load, a, dt, rows):
    """Answer of x' = A x + B a(t) to straight lines between samples, by one matrix exponential."""
    n = len(system)
    whole = np.zeros((n + 2, n + 2))
    whole[:n, :n], whole[:n, n] = system * dt, load * dt
    whole[n, n + 1] = 1.0
    move = scipy.linalg.expm(whole)
    x, steps = np.zeros(n), [np.zeros(len(rows))]
    for before, now in pairwise(a):
        x = move[:n, :n] @ x + move[:n, n] * before + move[:n, n + 1] * (now - before)
        steps.append(rows @ x)
    return np.array(steps)


@pytest.mark.parametrize("zeta", [0.0, 0.01, 0.05, 0.6])
@pytest.mark.parametrize("period_s", [0.004, 0.02, 0.3, 2.0, 60.0])
def test_an_oscillator_agrees_with_the_matrix_exponential(ground, period_s, zeta):
    w, dt = 2.0 * math.pi / period_s, 0.01
    system = np.array([[0.0, 1.0], [-(w**2), -2.0 * zeta * w]])
    rows = np.array([[-(w**2), -2.0 * zeta * w]])
    expected = stepped(system, np.array([0.0, -1.0]), ground, dt, rows)[:, 0]
    accelerations = absolute_accelerations(ground, dt, [period_s], [zeta])[:, 0]
    assert np.abs(accelerations - expected).max() < 1e-10 * np.abs(expected).max()


@pytest.mark.quick
def test_a_step_gives_the_closed_form_and_no_vertical_none(ground):
    dt, w, zeta = 0.01, 7.0, 0.03
    t = np.arange(800) * dt
    accelerations = absolute_accelerations(np.ones(800), dt, [2 * math.pi / w], [zeta])[:, 0]
    kappa = math.sqrt(1.0 - zeta**2)
    wave = np.cos(kappa * w * t) - zeta / kappa * np.sin(kappa * w * t)
    np.testing.assert_allclose(accelerations, 1.0 - np.exp(-zeta * w * t) * wave, atol=1e-13)
    roof = shaking_to_roof([ground], [], 0.01, [building_of_periods([0.5])])
    assert roof.vertical_mps2.size == 0


@pytest.mark.parametrize(("alpha0", "stories"), [(math.inf, 1), (math.inf, 4), (0.0, 3), (2.5, 6)])
def test_a_roof_agrees_with_the_equations_of_all_floors_at_once(ground, alpha0, stories):
    """K and M of the floors, damping of the same ratio in every mode, no modes superposed."""
    zeta, period_s, dt = 0.04, 0.7, 0.01
    stiff = floor_stiffness(alpha0, stories)
    squares = np.linalg.eigvalsh(stiff)
    stiff = stiff * (2.0 * math.pi / period_s) ** 2 / squares[0]
    damp = 2.0 * zeta * scipy.linalg.sqrtm(stiff).real
    none, identity = np.zeros((stories, stories)), np.eye(stories)
    system = np.block([[none, identity], [-stiff, -damp]])
    load = np.concatenate([np.zeros(stories), -np.ones(stories)])
    rows = np.hstack([-stiff, -damp])[-1:]
    expected = stepped(system, load, ground, dt, rows)[:, 0]
    building = building_of_periods([period_s], damping=[zeta], alpha0=alpha0, stories=stories)
    assert to_roof(ground, dt, building, share=0.0).n_modes == stories
    roof = roof_motion(ground, dt, building, share=0.0)[:1200]
    assert np.abs(roof - expected)[1:].max() < 1e-8 * np.abs(expected).max()


def apart(motion, other):
    """Largest difference over the time that both have."""
    n = min(motion.size, other.size)
    return np.abs(motion[:n] - other[:n]).max()


def slowest(building, count):
    """The first modes of a building, as those of another one."""
    every = (building.periods_s, building.damping, building.roof_factors)
    return building_of_modes(*(values[:count].tolist() for values in every))


def test_as_few_modes_as_keep_the_rest_under_the_share(ground):
    building = building_of_periods([1.2], alpha0=5.0)
    every = to_roof(ground, 0.01, building, share=0.0)
    whole = roof_motion(ground, 0.01, building, share=0.0)
    assert every.n_modes == BEAM_MODES
    assert every.left_out_share == every.next_share == 0.0
    counts = []
    for share in (0.3, 0.1, 0.05, 0.01):
        roof = to_roof(ground, 0.01, building, share=share)
        off = apart(roof_motion(ground, 0.01, building, share=share), whole)
        assert off <= 1.001 * roof.left_out_share * every.roof_peak_mps2
        assert roof.left_out_share <= share
        assert roof.next_share == roof.shares[roof.n_modes]
        counts.append(roof.n_modes)
        # One mode fewer would leave more out than that, seen at the ground's samples alone.
        fewer = slowest(building, roof.n_modes - 1)
        less = roof_motion(ground, 0.01, fewer, share=0.0)
        assert apart(less, whole) > 0.9 * share * every.roof_peak_mps2
    assert counts == sorted(counts)
    assert len(set(counts)) == len(counts)


@pytest.mark.parametrize(("period_s", "stories"), [(0.3, 3), (0.5, 5), (0.8, 8)])
def test_what_is_left_out_is_seen_between_the_samples_too(noise, period_s, stories):
    # The modes left out swing fastest: their peaks are missed at the samples.
    ground, building = noise[::3], building_of_periods([period_s], stories=stories)
    roof = to_roof(ground, 0.03, building, share=0.1)
    at = np.arange(16 * (ground.size - 1) + 1) / 16
    finer = to_roof(np.interp(at, np.arange(ground.size), ground), 0.03 / 16, building, share=0.1)
    assert roof.left_out_share == pytest.approx(finer.left_out_share, rel=0.012)


def test_stiff_buildings_take_the_ground_to_the_roof_and_still_ground_stays_still(ground):
    roof = to_roof(ground, 0.01, building_of_periods([0.002], stories=1))
    assert roof.n_modes == 0
    np.testing.assert_array_equal(roof.a_mps2[:1200], ground)
    assert 0.0 < roof.next_share == roof.left_out_share < 0.05
    roof = to_roof(np.zeros(50), 0.01, building_of_periods([1.0]))
    assert roof.a_mps2.tolist() == [0.0] * 50
    assert (roof.n_modes, roof.pad_s, roof.roof_peak_mps2) == (0, 0.0, 0.0)


def test_a_motion_goes_on_until_the_building_rests_and_no_longer(ground):
    building = building_of_periods([1.5], damping=[0.02], stories=5)
    roof = to_roof(ground, 0.01, building)
    longer = to_roof(lengthened(ground, 20000), 0.01, building)
    n = roof.a_mps2.size
    assert roof.pad_s == pytest.approx((n - 1200) * 0.01)
    np.testing.assert_allclose(longer.a_mps2[:n], roof.a_mps2, atol=1e-12)
    assert np.abs(longer.a_mps2[n:]).max() <= RESTING_SHARE * roof.roof_peak_mps2
    assert np.abs(roof.a_mps2[-2:]).max() <= 1.1 * RESTING_SHARE * roof.roof_peak_mps2
    assert roof.a_mps2.size > 2000  # 40 s at this period and damping
    roof = to_roof(lengthened(ground, 9000), 0.01, building_of_periods([0.5]))
    assert roof.a_mps2.size == 8999 * round(0.01 / roof.dt_s) + 1
    assert roof.pad_s == 0.0


def test_the_step_is_refined_where_the_roof_would_swing_between_samples(ground):
    """One story of 0.12 s under a record of 0.02 s: as if the record itself had more samples."""
    a, building = ground[::2], building_of_periods([0.12], stories=1)
    roof = to_roof(a, 0.02, building)
    assert roof.dt_s == pytest.approx(0.02 / 4)
    n = (a.size - 1) * 4 + 1
    fine = np.interp(np.arange(16 * (a.size - 1) + 1) / 16, np.arange(a.size), a)
    true = roof_motion(fine, 0.02 / 16, building)
    np.testing.assert_allclose(roof.a_mps2[:n], true[: fine.size : 4], atol=1e-12)
    # What straight lines between its samples miss, and what those of the record would.
    t, peak = np.arange(fine.size), np.abs(true).max()
    missed = np.abs(np.interp(t, t[::4], roof.a_mps2[:n]) - true[: t.size]).max()
    coarse = np.abs(np.interp(t, t[::16], true[: t.size : 16]) - true[: t.size]).max()
    assert missed < 0.015 * peak
    assert coarse > 0.04 * peak
    np.testing.assert_array_equal(roof_motion(a, 0.02, building), roof.a_mps2[::4])


@pytest.mark.parametrize(
    ("period_s", "dt_s", "steps"),
    [(0.5, 0.01, 1), (0.2, 0.01, 1), (0.19, 0.01, 2), (0.1, 0.08, 16)],
)
def test_a_period_has_twenty_samples_or_an_interval_sixteen_steps(ground, period_s, dt_s, steps):
    roof = to_roof(ground, dt_s, building_of_periods([period_s], stories=1), share=0.0)
    assert dt_s / roof.dt_s == pytest.approx(steps)
    assert roof.dt_s <= period_s / FINENESS * (1.0 + 1e-9)
    assert steps <= MOST_STEPS


def test_all_components_have_one_step_and_length_and_are_read_only(ground):
    vertical = 0.5 * ground[:1000]
    slow, fast = (building_of_periods([t], stories=1) for t in (2.0, 0.15))
    roof = shaking_to_roof([ground, ground[::-1]], vertical, 0.01, [slow, fast])
    assert roof.dt_s == pytest.approx(0.005)
    sizes = {roof.vertical_mps2.size, *(side.a_mps2.size for side in roof.horizontal)}
    assert len(sizes) == 1
    given = (ground, ground[::-1]), (slow, fast)
    for side, a, building in zip(roof.horizontal, *given, strict=True):
        assert side.dt_s == roof.dt_s
        assert side.pad_s == pytest.approx((side.a_mps2.size - 2399) * 0.005)
        alone = roof_motion(a, 0.01, building)
        np.testing.assert_allclose(side.a_mps2[::2][: alone.size - 1], alone[:-1], atol=1e-12)
    np.testing.assert_array_equal(roof.vertical_mps2[: 2 * 1000 : 2], vertical)
    assert not roof.vertical_mps2[2 * 1000 :].any()
    between = 0.5 * (vertical[1:] + vertical[:-1])
    np.testing.assert_allclose(roof.vertical_mps2[1:1999:2], between, atol=1e-15)
    before = ground.copy()
    roof = to_roof(ground, 0.01, building_of_periods([1.0]))
    np.testing.assert_array_equal(ground, before)
    given = building_of_modes(own := np.array([0.5]), [0.05], [1.0])
    own[0] = 2.0
    assert given.periods_s.tolist() == [0.5]
    for array in (roof.a_mps2, roof.shares, roof.building.periods_s):
        with pytest.raises(ValueError, match="read-only"):
            array[0] = 1.0
    assert roof.ground_peak_mps2 == np.abs(ground).max()
    assert roof.roof_peak_mps2 == np.abs(roof.a_mps2).max()


@settings(max_examples=20)
@given(
    period_s=st.floats(0.05, 6.0),
    factor=st.floats(0.01, 100.0),
    alpha0=st.sampled_from([0.0, 1.0, 8.0, math.inf]),
    stories=st.sampled_from([0, 1, 2, 12]),
)
def test_twice_the_ground_is_twice_the_roof(ground, period_s, factor, alpha0, stories):
    building = building_of_periods([period_s], alpha0=alpha0, stories=stories)
    roof, other = (roof_motion(f * ground, 0.01, building) for f in (1.0, -factor))
    np.testing.assert_allclose(other, -factor * roof, atol=1e-9 * factor)


def test_given_periods_and_modes_are_kept_up_to_the_stories():
    building = building_of_periods([1.0, 0.4], damping=[0.03, 0.05, 0.08])
    np.testing.assert_allclose(building.periods_s[:4], [1.0, 0.4, 0.4 * 3 / 5, 0.4 * 3 / 7])
    assert building.damping[:4].tolist() == [0.03, 0.05, 0.08, 0.08]
    assert building.periods_s.size == BEAM_MODES
    assert "period 1, 0.4 s; damping 3, 5, 8% of critical" in spaced(building.words)
    building = building_of_periods([1.0, 0.4, 0.2], damping=[0.03, 0.05, 0.06], stories=2)
    assert building.periods_s.tolist() == [1.0, 0.4]
    assert building.damping.tolist() == [0.03, 0.05]
    assert building.roof_factors.sum() == pytest.approx(1.0)
    building = building_of_modes([0.8, 0.3], [0.05, 0.05], [1.3, -0.4])
    assert building.roof_factors.tolist() == [1.3, -0.4]
    assert building.words == "2 modes as given, sum of roof factors 0.900"
    for factors in ([1.3], [1.3, math.nan]):
        with pytest.raises(InputError, match="a period, a damping and a roof factor for each"):
            building_of_modes([0.8, 0.3], [0.05, 0.05], factors)
    for (alpha0, stories), words in {
        (math.inf, 0): "uniform, in shear;",
        (0.0, 4): "4 equal stories, in bending;",
        (3.0, 0): "in shear and bending with a lateral stiffness ratio of 3;",
        (3.0, 1): "one story;",
    }.items():
        assert words in building_of_periods([1.0], alpha0=alpha0, stories=stories).words


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        ({"periods_s": [0.0]}, "period: found 0.0 s; use above 0 to 10 s"),
        ({"periods_s": [0.4, 1.0]}, "use the longest first"),
        ({"periods_s": []}, "at least one period"),
        ({"periods_s": [1.0], "damping": [5.0]}, "damping: found 5.0; use a fraction"),
        ({"periods_s": [1.0], "damping": []}, "one damping"),
        ({"periods_s": [1.0], "alpha0": -1.0}, "lateral stiffness ratio: found -1.0"),
        ({"periods_s": [1.0], "stories": 101}, "stories: found 101"),
        ({"periods_s": [1.0], "alpha0": math.nan}, "nan; use 0 to 1000, or infinity"),
        ({"periods_s": [1.0], "stories": -1}, "whole number from 1 to 100, 0 for a beam"),
    ],
)
def test_what_cannot_be_a_building_is_refused(arguments, said):
    with pytest.raises(InputError, match=said):
        building_of_periods(**arguments)


@pytest.mark.parametrize(
    ("a", "dt_s", "share", "said"),
    [
        ([1.0, math.inf], 0.01, 0.05, "two or more finite numbers"),
        ([1.0, 2.0], 0.0, 0.05, "time step"),
        ([1.0, 2.0], 0.01, 1.0, "limit on neglected modes"),
    ],
)
def test_what_cannot_be_a_motion_is_refused(a, dt_s, share, said):
    with pytest.raises(InputError, match=said):
        to_roof(a, dt_s, building_of_periods([1.0]), share=share)


def test_each_component_is_carried_by_its_building_and_the_vertical_is_kept(noise):
    along, across = (building_of_periods([period], stories=1) for period in (0.3, 0.6))
    ground = solver.motion(noise, 0.5 * noise[::-1], 0.2 * noise, dt_s=0.01, id="G", scale=1.5)
    roof = solver.at_roof(ground, along, across)
    assert (roof.id, roof.scale, roof.signs) == ("G", 1.5, ground.signs)
    assert roof.source == f"at the roof of: {along.words}"
    sides = (roof.ax_mps2, ground.ax_mps2, along), (roof.ay_mps2, ground.ay_mps2, across)
    for mine, theirs, building in sides:
        alone = to_roof(theirs, ground.dt_s, building)
        assert roof.dt_s == alone.dt_s
        np.testing.assert_array_equal(mine[: alone.a_mps2.size], alone.a_mps2)
        assert not mine[alone.a_mps2.size :].any()
    np.testing.assert_array_equal(roof.az_mps2[: noise.size], ground.az_mps2)
    both = solver.at_roof(solver.motion(noise, noise, dt_s=0.01), along)
    np.testing.assert_array_equal(both.ax_mps2, both.ay_mps2)
    assert not solver.at_roof(solver.motion(noise, dt_s=0.01), along).has_transverse
