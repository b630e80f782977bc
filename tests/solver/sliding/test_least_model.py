"""The choice of a model: each rung where it suffices, none where a fuller one matters."""

import math
from dataclasses import replace

import numpy as np
import pytest

from solver.forces import forces
from solver.model import Friction, InputError, Scene, Status, coulomb
from solver.sliding import least_model, one_axis, two_axes
from solver.sliding.least_model import Rung, Settings, history, solve
from solver.sliding.row import BlockRow, slide_row

G = 9.80665
DT = 0.01
EMPTY = np.empty(0)


def shaking(seed, peak_g, seconds=20.0):
    """Noise of periods from 0.2 to 3 s, from rest to rest."""
    rng = np.random.default_rng(seed)
    n = round(seconds / DT)
    freq = np.fft.rfftfreq(n, DT)
    wave = np.fft.irfft(((freq > 0.3) & (freq < 5.0)) * np.exp(2j * np.pi * rng.random(freq.size)))
    wave = wave[:n] * np.sin(np.pi * np.arange(n) / n)
    wave *= peak_g * G / np.abs(wave).max()
    wave[0] = wave[-1] = 0.0
    wave.setflags(write=False)
    return wave


def times(record, factor):
    scaled = record * factor
    scaled.setflags(write=False)
    return scaled


def scene(ax, ay=EMPTY, az=EMPTY, *, slope_deg=2.0, mu=0.4, friction=None):
    return Scene(
        ax_mps2=ax,
        ay_mps2=ay,
        az_mps2=az,
        dt_s=DT,
        slope_rad=math.radians(slope_deg),
        friction=friction or coulomb(mu),
        scale=1.0,
        g_mps2=G,
    )


AX, AY, AZ = shaking(1, 1.0), shaking(2, 0.9), shaking(3, 0.4)


def test_a_block_that_friction_holds_is_not_run():
    solution = solve(scene(AX, AY, AZ, mu=1.5, slope_deg=0.0))
    demand = np.max(np.hypot(AX, AY) / (G + AZ))
    assert solution.rung is Rung.NO_SLIP
    assert solution.friction_demand == pytest.approx(demand, rel=1e-14)
    assert demand < 1.5
    assert (solution.result.prd_m, solution.next_effect_m) == (0.0, 0.0)
    assert two_axes.run(scene(AX, AY, AZ, mu=1.5, slope_deg=0.0)).prd_m == 0.0


@pytest.mark.parametrize("factor", [0.999, 1.001])
def test_the_friction_demand_tells_slip_from_none(factor):
    still = scene(AX, AY, AZ)
    mu = forces(still).friction_demand * factor
    moved = two_axes.run(replace(still, friction=coulomb(mu))).prd_m
    assert (solve(replace(still, friction=coulomb(mu))).rung is Rung.NO_SLIP) == (moved == 0.0)
    assert (moved > 0.0) == (factor < 1.0)


def test_one_component_is_one_axis_and_says_that_the_rest_is_not_known():
    solution = solve(scene(AX))
    assert solution.rung is Rung.ONE_AXIS
    assert solution.result == one_axis.run(scene(AX))
    assert math.isnan(solution.next_effect_m)


def test_a_vertical_that_matters_is_modelled():
    solution = solve(scene(AX, az=AZ))
    assert solution.rung is Rung.ONE_AXIS_VERTICAL
    assert solution.result == one_axis.run(scene(AX, az=AZ))


def test_a_vertical_that_does_not_matter_is_left_out_and_its_effect_is_exact():
    faint = times(AZ, 1e-4)
    solution = solve(scene(AX, az=faint))
    with_it, without = one_axis.run(scene(AX, az=faint)), one_axis.run(scene(AX))
    assert solution.rung is Rung.ONE_AXIS
    assert solution.result == without
    assert solution.next_rung is Rung.ONE_AXIS_VERTICAL
    change = off(with_it, without)
    assert solution.next_effect_m == change + with_it.error_m > with_it.error_m


def test_a_second_component_that_matters_is_modelled():
    solution = solve(scene(AX, AY, AZ))
    assert solution.rung is Rung.TWO_AXES
    assert solution.result.across_m > 0.01
    assert solution.result.error_m <= 1e-6 * solution.result.prd_m
    assert solution.result.prd_m > 1.1 * one_axis.run(scene(AX, az=AZ)).prd_m


def test_a_faint_second_component_is_left_out_and_its_effect_is_known():
    solution = solve(scene(AX, times(AY, 0.001), AZ))
    fuller = two_axes.run(scene(AX, times(AY, 0.001), AZ))
    assert solution.rung is Rung.ONE_AXIS_VERTICAL
    assert solution.next_rung is Rung.TWO_AXES
    change = off(fuller, solution.result)
    assert 0.0 < change <= solution.next_effect_m <= change + 1.01 * fuller.error_m
    assert solution.next_effect_m <= Settings().bound_m(solution.result.prd_m)


def off(result, other):
    """The largest difference of PRD and excursions."""
    names = ("prd_m", "down_m", "up_m", "across_m")
    return max(abs(getattr(result, name) - getattr(other, name)) for name in names)


@pytest.mark.parametrize("share", [0.3, 0.1, 0.03, 0.01])
@pytest.mark.parametrize("mu", [0.2, 0.4, 0.6])
@pytest.mark.parametrize("slope_deg", [0.0, 7.0])
def test_what_is_left_out_changes_less_than_is_said_and_than_may_be(share, mu, slope_deg):
    ax, ay, az = shaking(11, 0.9), shaking(61, 0.9 * share), shaking(101, 0.3)
    block = scene(ax, ay, az, slope_deg=slope_deg, mu=mu)
    solution, true = solve(block), two_axes.run(block, 1e-9)
    allowed = Settings().bound_m(one_axis.run(block).prd_m)
    if solution.rung is Rung.TWO_AXES:
        assert off(true, one_axis.run(block)) > allowed - solution.result.error_m
    else:
        assert off(true, solution.result) <= solution.next_effect_m <= allowed


@pytest.mark.parametrize("seed", range(12))
def test_where_the_margin_is_positive_a_finer_tolerance_chooses_the_same_model(seed):
    """The faint component is tuned to the criterion itself, where coarse runs may choose wrong."""
    ax, ay = shaking(seed, 0.9, 8.0), shaking(seed + 100, 0.9, 8.0)
    coarse, fine = Settings(tolerance=1e-3), Settings(tolerance=1e-8)
    low, high = 0.0, 1.0
    for _ in range(30):
        middle = (low + high) / 2.0
        chosen = solve(scene(ax, times(ay, middle)), fine).rung
        low, high = (low, middle) if chosen is Rung.TWO_AXES else (middle, high)
    told = []
    for share in (low, low * (1.0 - 1e-5), low * (1.0 - 1e-2), low * 0.5, low * 2.0, 1.0):
        case = scene(ax, times(ay, share))
        rough = solve(case, coarse)
        told.append(rough.margin_m > 0.0)
        if told[-1]:
            assert rough.rung is solve(case, fine).rung
    assert not told[0]
    assert told[-1]


def one_sided(periods_hz, peak_g, push_g, rise_s, seconds=20.0):
    """Shaking along the slope that repeats, and a push across it that stays."""
    t = np.arange(round(seconds / DT) + 1) * DT
    ax = peak_g * G * np.sin(2.0 * np.pi * periods_hz * t) * np.minimum(t / 2.0, 1.0)
    return times(ax, 1.0), times(push_g * G * np.minimum(t / rise_s, 1.0), 1.0)


def test_a_faint_push_that_stays_is_carried_along_the_path_and_is_not_left_out():
    # 0.02 g across 0.8 g: 14 mm in one axis, 111 mm in two.
    pushed = scene(*one_sided(3.0, 0.8, 0.02, 1.0), slope_deg=0.0, mu=0.4)
    solution = solve(pushed)
    assert one_axis.run(pushed).prd_m == pytest.approx(0.0139, abs=1e-4)
    assert solution.rung is Rung.TWO_AXES
    assert solution.result.prd_m == pytest.approx(0.1108, abs=1e-4)


def test_friction_by_speed_is_modelled_where_it_is_given():
    law = Friction(mu_slow=0.3, mu_fast=0.5, rate_s_per_m=20.0, mu_static=0.3)
    solution = solve(scene(AX, AY, AZ, friction=law))
    plain = solve(scene(AX, AY, AZ, mu=0.3))
    assert solution.rung is Rung.SPEED_FRICTION
    assert solution.result.prd_m < plain.result.prd_m


def test_a_forced_rung_is_run_and_tells_what_the_next_would_change():
    full = scene(AX, AY, AZ)
    solution = solve(full, Settings(forced=Rung.ONE_AXIS))
    lifted = solve(full, Settings(forced=Rung.ONE_AXIS_VERTICAL))
    two = solve(full, Settings(forced=Rung.TWO_AXES))
    assert solution.result == one_axis.run(scene(AX))
    # What the next one and all fuller ones would change.
    both = off(two.result, solution.result), off(lifted.result, solution.result)
    assert solution.next_rung is Rung.ONE_AXIS_VERTICAL
    assert solution.next_effect_m == pytest.approx(max(both), abs=2.0 * two.result.error_m)
    assert lifted.next_rung is Rung.TWO_AXES
    assert lifted.next_effect_m >= abs(two.result.prd_m - lifted.result.prd_m)
    assert {solution.reason, lifted.reason, two.reason} == {"requested"}


def test_two_axes_forced_with_one_component_give_one_axis():
    solution = solve(scene(AX, az=AZ), Settings(forced=Rung.TWO_AXES, tolerance=1e-10))
    along = one_axis.run(scene(AX, az=AZ))
    assert solution.result.prd_m == pytest.approx(along.prd_m, rel=1e-9)
    assert solution.result.across_m == 0.0


def test_no_slip_forced_on_a_block_that_slips_is_refused():
    with pytest.raises(InputError, match="friction demand"):
        solve(scene(AX), Settings(forced=Rung.NO_SLIP))


@pytest.mark.parametrize("ay", [EMPTY, AY])
@pytest.mark.parametrize("forced", [None, *list(Rung)[:-1]])
def test_where_the_normal_force_vanishes_no_rung_gives_a_number(ay, forced):
    solution = solve(scene(AX, ay, times(AZ, 4.0)), Settings(forced=forced))
    assert solution.result.status is Status.UPLIFT
    assert math.isnan(solution.result.prd_m)
    assert math.isnan(solution.result.error_m)
    assert solution.friction_demand == math.inf


def test_a_row_is_run_where_it_is_asked_for():
    row = BlockRow(mus=(0.3, 0.4, 0.5), stiffness_per_s2=1e3)
    solution = solve(scene(AX, az=AZ), Settings(forced=Rung.ROW, row=row))
    direct = slide_row(scene(AX, az=AZ), row)
    assert solution.result.prd_m == max(direct.prd_m) > direct.rigid.prd_m
    assert solution.result.error_m == direct.error_m
    with pytest.raises(InputError, match="row_history"):
        history(scene(AX, az=AZ), solution)
    with pytest.raises(InputError, match="not given"):
        solve(scene(AX), Settings(forced=Rung.ROW))


@pytest.mark.parametrize("forced", [None, Rung.NO_SLIP, Rung.ONE_AXIS, Rung.ONE_AXIS_VERTICAL])
def test_the_history_is_of_the_rung_that_was_chosen(forced):
    run = scene(AX, az=AZ, mu=2.0 if forced is Rung.NO_SLIP else 0.4)
    settings = Settings(forced=forced)
    solution = solve(run, settings)
    seen = history(run, solution, settings)
    assert seen.result == solution.result
    assert np.abs(seen.u_m).max() == pytest.approx(solution.result.prd_m, rel=0.02, abs=1e-12)


def test_the_history_in_two_axes_has_both():
    run = scene(AX, AY, AZ)
    solution = solve(run)
    seen = history(run, solution)
    assert seen.result == solution.result
    far = np.hypot(seen.u_m, seen.across_m).max()
    assert far == pytest.approx(solution.result.prd_m, rel=0.01)


def test_every_rung_has_a_name():
    assert len({rung.title for rung in Rung}) == len(Rung)


def test_choosing_is_timed():
    assert 0.0 < solve(scene(AX)).seconds < 60.0
    assert least_model.DEFAULT.forced is None
