"""The solver against closed forms, high-precision arithmetic, its own symmetries and the paper."""

import itertools
import json
import math
import os
import re
import subprocess
import sys
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

import oracle
import solver
from fixtures.blocks import shaking, trapezoid
from fixtures.marks import by_day
from fixtures.paths import ROOT, TESTS
from solver.errors import InputError
from solver.formats import read_record
from solver.model import EventKind, Friction, Status
from solver.sliding.checked import slide, slide_history
from solver.verification import reference

G = 9.81
LENGTHS = ("prd", "residual", "down", "up")
SWAY = [0.0, 4.0, -4.0, 0.0]


def lengths_m(result):
    return [getattr(result, f"{name}_m") for name in LENGTHS]


def off_m(result, exact):
    """The largest error of a displacement; NaN if one is."""
    wanted = [float(getattr(exact, name)) for name in LENGTHS]
    return np.abs(np.subtract(lengths_m(result), wanted)).max()


def assert_agrees(result, exact, floor_m=1e-3):
    """Relative to the PRD, and to a millimeter below it."""
    assert off_m(result, exact) <= min(1e-12 * max(float(exact.prd), floor_m), result.error_m)
    fastest = float(exact.fastest)
    assert abs(result.peak_speed_mps - fastest) <= 1e-11 * max(fastest, floor_m)


@pytest.mark.parametrize(("degrees", "mu"), [(2.0, 0.4), (0.0, 0.2)])
@pytest.mark.parametrize("name", ["RM1-x", "RM1-y"])
def test_the_lines_of_the_docs_give_the_slip_of_the_example(name, degrees, mu):
    (code,) = re.findall(r"```python\n(.*?)```", (ROOT / "docs/method.md").read_text(), re.DOTALL)
    exec(code, namespace := {})
    record = read_record(ROOT / f"projects/example/records/{name}.csv")
    slope = math.radians(degrees)
    exact = slide(record.a_mps2, record.dt_s, slope_rad=slope, mu=mu)
    plain_m = namespace["slip_m"](record.a_mps2.tolist(), record.dt_s, slope, mu)
    assert plain_m == pytest.approx(exact.prd_m, rel=5e-4)


# Closed forms


@pytest.mark.parametrize("vertical", [0.0, -0.3, 0.3])
@pytest.mark.parametrize(("degrees", "mu", "amplitude"), [(5, 0.4, 0.6), (10, 0.5, 0.8)])
def test_a_ramped_pulse_on_a_slope_is_met_to_rounding(degrees, mu, amplitude, vertical):
    slope, dt, plateau = math.radians(degrees), 0.01, 30
    drive, resist = reference.slope_pulse(slope, mu, amplitude, vertical, G)
    ax, az = (trapezoid(a * G, plateau, 900) for a in (-amplitude, vertical))
    expected = reference.pulse_travel(drive, resist, plateau * dt, dt) * math.cos(slope)
    result = slide(ax, dt, slope_rad=slope, mu=mu, az_mps2=az, g_mps2=G)
    assert result.down_m == pytest.approx(expected, rel=1e-12)
    assert result.up_m == 0.0
    push = drive - resist  # rises in part of the first ramp, falls in part of the last
    fastest = push * plateau * dt + push**2 / (drive / dt)
    assert result.peak_speed_mps == pytest.approx(fastest, rel=1e-12)


@pytest.mark.parametrize(
    ("degrees", "mu"), [(0, 0.05), (0.5, 0.05), (-2, 0.05), (4, 0.4), (-7, 0.4), (30, 1.0)]
)
def test_slip_begins_just_beyond_the_yield_accelerations(degrees, mu):
    slope = math.radians(degrees)
    for limit in reference.yield_accelerations(slope, mu, G):
        for factor, moves in ((1 - 1e-12, False), (1 + 1e-9, True)):
            ax = np.array([0.0, limit * factor, 0.0])
            result = slide(ax, 0.5, slope_rad=slope, mu=mu, g_mps2=G)
            assert (result.n_stops > 0) is moves


# High precision

PAIRS = itertools.product((-7.0, 0.0, 0.5, 4.0, 7.0), (0.0, 0.1, 0.5, 0.8))
GRID = [
    {"slope_rad": math.radians(degrees), "mu": mu, "scale": scale}
    for (degrees, mu), scale in zip(PAIRS, itertools.cycle((0.3, 1.0, 2.0)), strict=False)
]
"""Every slope with every friction coefficient, the scale cycling through."""


def test_noise_agrees_with_forty_digits(noise):
    for scene in GRID[::3]:
        assert_agrees(slide(noise, 0.01, **scene), oracle.slide(noise, 0.01, **scene))


# Whole and half multiples of the yield value on a flat roof: equal samples, samples at yield,
# zeros, double roots and several reversals come up all the time.
lattice = st.lists(st.integers(-6, 6).map(lambda k: 0.5 * k), min_size=2, max_size=12)
anything = st.lists(st.floats(-30.0, 30.0, allow_subnormal=False), min_size=2, max_size=12)
frictions = st.sampled_from([0.0, 0.25, 0.5, 1.0])
slopes = st.sampled_from([0.0, math.atan(0.25), 0.1])


@settings(max_examples=150)
@given(st.one_of(lattice, anything), frictions, slopes, st.sampled_from([0.01, 0.25, 1.0]))
@example([0.0, 1.5, 0.0, 0.0, 1e-38], 0.25, 0.0, 0.01)
@example([1.5, 3.0, 0.5, -2.0, 0.0], 1.0, 0.0, 0.25)  # touches the limit of friction at a sample
def test_any_short_record_agrees_with_forty_digits_to_the_allowance(values, mu, slope, dt):
    result = slide(values, dt, slope_rad=slope, mu=mu, g_mps2=2.0, units="m/s2")
    if result.status is not Status.UPLIFT:
        exact = oracle.slide(values, dt, slope_rad=slope, mu=mu, g=2.0)
        # A stop missed or found at a touching point changes nothing but by rounding.
        assert off_m(result, exact) <= result.error_m + 1e-30


@pytest.mark.nightly
def test_records_of_every_kind_agree_with_forty_digits():
    """Quiet stretches, equal and zero samples, steep slopes, no friction, any sign of the scale."""
    rng = np.random.default_rng(3)
    compared = 0
    for _ in range(120):
        size = rng.integers(2, 400)
        ax = rng.normal(size=size) * rng.choice([2.0, 8.0, 20.0])
        ax[rng.random(size) < rng.choice([0.0, 0.7, 0.97])] = 0.0
        az = rng.normal(size=size) * 2.0 if rng.random() < 0.4 else None
        scene = {
            "slope_rad": rng.choice([0.0, 0.05, -0.12, 0.3, -0.3, 1.2]),
            "mu": rng.choice([0.0, 0.1, 0.3, 0.8, 1.5]),
            "scale": rng.choice([1.0, -1.0, 0.3, -2.0, 0.0]),
        }
        dt = rng.choice([0.005, 0.02, 0.3])
        history = slide_history(ax, dt, az_mps2=az, units="m/s2", **scene)
        if history.result.status is not Status.UPLIFT:
            exact = oracle.slide(ax, dt, az=az, **scene)
            assert_agrees(history.result, exact, floor_m=1e-9)
            assert_same_history(history, exact)
            compared += 1
    assert compared > 60


def assert_same_history(history, exact):
    """Summed sample by sample; times to much less than a sample."""
    result, dt = history.result, history.t_s[1]
    u, v = np.array(exact.history, dtype=float).T
    assert np.abs(history.u_m - u).max() <= 1e-12 * max(float(exact.prd), 1e-9)
    assert np.abs(history.v_mps - v).max() <= 1e-11 * max(float(exact.fastest), 1e-9)
    assert result.n_stops == exact.n_stops
    assert result.t_prd_s == pytest.approx(float(exact.t_prd), abs=1e-7 * dt)
    kinds = [EventKind.SLIP, EventKind.STOP] * (exact.n_stops + 1)
    found = [(event.t_s, event.u_m) for event in history.events]
    assert [event.kind for event in history.events] == kinds[: len(exact.events)]
    wanted = np.array(exact.events, dtype=float).reshape(-1, 2)
    assert np.array(found).reshape(-1, 2) == pytest.approx(wanted, abs=1e-7 * dt)


def test_a_speed_that_dips_to_zero_stops_there_or_goes_on_without_friction():
    # The push falls from 3 to -1 about friction and rises again: zero inside, moving at the end.
    ax, scene = [-4.0, 0.5, -8.0], {"slope_rad": 0.0, "mu": 0.2}
    exact = oracle.slide(ax, 1.0, **scene, g=10.0)
    assert_agrees(slide(ax, 1.0, **scene, g_mps2=10.0), exact)
    dip = slide_history([-4.0, 2.0, 2.0, -8.0], 1.0, **scene, g_mps2=10.0)
    assert [event.kind for event in dip.events[:3]] == ["slip", "stop", "slip"]
    # The push falls to `low` and rises to `high`, and the speed comes down to zero between: within
    # rounding, the block stops there, is pushed back by nothing, and begins again.
    rng, dt = np.random.default_rng(4), 0.1
    for low, high in rng.uniform((-3.0, 0.2), (-0.1, 5.0), size=(300, 2)):
        begin = low * low / (high - low) - low
        ax = [-begin, -low, -high, -1.0, 0.0, 0.0]
        result = slide(ax, dt, slope_rad=0.0, mu=0.0, g_mps2=9.8)
        exact = oracle.slide(ax, dt, slope_rad=0.0, mu=0.0, g=9.8)
        assert abs(result.prd_m - float(exact.prd)) <= result.error_m


# Symmetries


@pytest.mark.parametrize("power", [-24, 24])
@pytest.mark.parametrize("dips", [False, True])
def test_units_of_a_power_of_two_change_no_bit(noise, power, dips):
    # The speed dips to zero within an interval and rises again.
    ax, dt, slope, mu = ([-3.1, -1.0, -8.0], 1.0, 0.0, 0.2) if dips else (noise, 0.01, 0.05, 0.3)
    unit, block = 2.0**power, {"slope_rad": slope, "mu": mu}
    result = slide(ax, dt, **block, g_mps2=10.0)
    longer = slide(unit * np.array(ax), dt, **block, g_mps2=unit * 10.0)
    slower = slide(ax, unit * dt, **block, g_mps2=10.0)
    assert result.n_stops == 1 if dips else result.n_stops > 9
    assert lengths_m(longer) == [unit * value for value in lengths_m(result)]
    assert lengths_m(slower) == [unit**2 * value for value in lengths_m(result)]
    assert (slower.t_prd_s, slower.n_stops) == (unit * result.t_prd_s, result.n_stops)


@pytest.mark.parametrize("scale", by_day([1.0, 0.03, -1.7], 1))
def test_a_vertical_record_of_zeros_changes_no_bit(scale):
    # At the yield acceleration itself, where a rounding decides.
    for slope, mu in itertools.product((-0.06, 0.0, 0.3), np.linspace(0.05, 0.95, 20)):
        given = {"slope_rad": slope, "mu": mu, "scale": scale, "g_mps2": G}
        for limit in reference.yield_accelerations(slope, mu, G):
            for ulps in range(-8, 9):
                ax = np.array([0.0, limit / scale * (1.0 + ulps * 2.0**-52), 0.0])
                without, still = slide(ax, 0.5, **given), slide(ax, 0.5, az_mps2=0.0 * ax, **given)
                assert (without.n_stops, without.prd_m) == (still.n_stops, still.prd_m)


@settings(max_examples=60)
@given(anything, frictions, slopes)
def test_the_mirrored_scene_gives_the_mirrored_motion_to_the_last_bit(values, mu, slope):
    result = slide(values, 0.1, slope_rad=slope, mu=mu, units="m/s2")
    other = slide([-v for v in values], 0.1, slope_rad=-slope, mu=mu, units="m/s2")
    assert result.status is other.status
    if result.status is not Status.UPLIFT:
        assert (result.prd_m, result.down_m, result.up_m) == (other.prd_m, other.up_m, other.down_m)
        assert result.residual_m == -other.residual_m


@pytest.mark.parametrize("peaks_g", [(1.2,), (1.2, 0.3)], ids=["horizontal", "vertical"])
@pytest.mark.parametrize("seed", range(20))
def test_samples_put_between_samples_change_nothing(peaks_g, seed):
    waves = [shaking(seed + k, peak_g * G) for k, peak_g in enumerate(peaks_g)]
    at, parts = np.arange(waves[0].size), 2 + seed % 6
    fine = np.linspace(0.0, at[-1], at[-1] * parts + 1)
    about = {"slope_rad": math.radians(seed % 11 - 5.0), "mu": 0.15 + 0.02 * seed}
    result, other = (
        slide(ax, 0.01 / n, az_mps2=az[0] if az else None, **about)
        for n, (ax, *az) in ((1, waves), (parts, [np.interp(fine, at, wave) for wave in waves]))
    )
    assert other.prd_m == pytest.approx(result.prd_m, rel=1e-10, abs=1e-13)
    assert other.residual_m == pytest.approx(result.residual_m, abs=1e-10)


def test_work_balances_and_the_history_ends_where_the_result_says(noise):
    slope, mu = 0.05, 0.3
    history = slide_history(noise, 0.01, slope_rad=slope, mu=mu)
    # Fine sums on the cubic motion: a second way to the same numbers, at the order of the sum.
    t = np.arange(0, history.t_s[-1], 1e-4)
    a = np.interp(t, history.t_s, noise)
    v = np.interp(t, history.t_s, history.v_mps) / math.cos(slope)
    normal = 9.80665 * math.cos(slope) + a * math.sin(slope)
    drive = 9.80665 * math.sin(slope) - a * math.cos(slope)
    power = drive * v - mu * normal * np.abs(v)
    assert power.sum() * 1e-4 == pytest.approx(0.0, abs=0.01 * (mu * normal * abs(v)).sum() * 1e-4)
    history = slide_history(noise, 0.01, slope_rad=0.03, mu=0.25)
    result = history.result
    assert result == slide(noise, 0.01, slope_rad=0.03, mu=0.25)
    assert history.u_m[-1] == result.residual_m
    stops = [event for event in history.events if event.kind is EventKind.STOP]
    assert len(stops) == result.n_stops
    assert max(abs(event.u_m) for event in stops) == result.prd_m
    assert any(event.t_s == result.t_prd_s for event in stops)
    kinds = [event.kind for event in history.events]
    assert all(kind is not other for kind, other in itertools.pairwise(kinds))
    assert np.abs(history.u_m).max() <= result.prd_m


# History


@pytest.mark.quick
def test_histories_at_rest_and_of_solved_scenes():
    history = slide_history([0.0, 1.0, 0.0], 0.1, slope_rad=0.0, mu=0.5)
    assert history.events == ()
    assert not history.u_m.any()
    assert not history.v_mps.any()
    scene = solver.scene(SWAY, 0.1, slope_rad=0.0, mu=0.1)
    solution = solver.solve(scene)
    assert solver.history(scene, solution).result == solution.result
    # Results of the same run are equal though one time is NaN.
    first, again = (slide(SWAY, 0.1, slope_rad=0.02, mu=0.5) for _ in range(2))
    copied = replace(again, t_uplift_s=-float("nan"))  # another object
    assert math.isnan(first.t_uplift_s)
    assert (first, hash(first)) == (copied, hash(copied))
    assert first != replace(again, n_stops=again.n_stops + 1)
    assert first != "a result"


# Uplift and bad input


@pytest.mark.parametrize("method", ["exact", "paper"])
def test_a_negative_normal_force_gives_the_time_and_no_displacement(method):
    slope, ax = math.radians(30), [0.0, 0.0, -40.0, 0.0]
    result = slide(ax, 0.1, slope_rad=slope, mu=0.5, g_mps2=10.0, method=method)
    assert result.status is Status.UPLIFT
    assert np.isnan(lengths_m(result)).all()
    # N = 10 cos 30 - 400 (t - 0.1) sin 30 = 0
    assert result.t_uplift_s == pytest.approx(0.1 + math.cos(slope) / 20, rel=1e-12)
    assert result.n_min_g == pytest.approx(math.cos(slope) - 2.0, rel=1e-12)
    # Vertical shaking alone can lift the block.
    history = slide_history([0.0, 0.0], 0.1, slope_rad=0.0, mu=0.5, az_mps2=[-10.0, 0.0])
    assert history.result.t_uplift_s == 0.0
    assert history.result.n_min_g == pytest.approx(1.0 - 10.0 / 9.80665, rel=1e-12)
    assert np.isnan(history.u_m).all()


LAW = Friction(mu_slow=0.2, mu_fast=0.3, rate_s_per_m=20.0, mu_static=0.2)


def law(**changes):
    return replace(LAW, **changes)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"ax_mps2": [0.0, math.nan]}, r"ax_mps2\[1\] is nan"),
        ({"ax_mps2": [0.0]}, r"ax_mps2 has shape \(1,\)"),
        ({"ax_mps2": [[0.0], [1.0, 2.0]]}, "ax_mps2 is not a row of real numbers"),
        ({"ax_mps2": np.ma.array([0.0, 1.0, 2.0], mask=[0, 1, 0])}, "ax_mps2 has masked samples"),
        ({"dt_s": 10**400}, r"dt_s is 10+\.\.\.; use"),
        ({"mu": "0.3"}, "mu is '0.3'; use a friction coefficient of 0 or more"),
        ({"scale": 1e308}, "exceed the floating-point range; change scale"),
        ({"dt_s": 5e-324}, "exceed the floating-point range"),
        ({"mu": law(mu_slow=-0.1)}, "mu_slow is -0.1; use a friction coefficient of 0 or more"),
        ({"mu": law(rate_s_per_m=math.nan)}, "rate_s_per_m is nan; use a number of s/m"),
        ({"mu": law(mu_static=0.1)}, "mu_static is 0.1; use mu_slow, 0.2, or more"),
        ({"mu": LAW, "method": "paper"}, "method is 'paper'; two axes and velocity-dependent"),
        ({"mu": LAW, "tolerance": 1.0}, "tolerance is 1.0; use a number from 1e-10 to 0.01"),
        ({"az_mps2": [0.0, 0.0]}, r"az_mps2 has shape \(2,\)"),
        ({"dt_s": 0.0}, "dt_s is 0.0"),
        ({"mu": -0.1}, "mu is -0.1"),
        ({"slope_rad": math.pi / 2}, "slope_rad is 1.57"),
        ({"g_mps2": 0.0}, "g_mps2 is 0.0"),
        ({"az_mps2": [0.0, 0.0, 0.0], "method": "paper"}, "horizontal shaking only"),
    ],
)
def test_arguments_at_fault_raise_the_input_error(change, message):
    arguments = {"ax_mps2": [0.0, 1.0, 0.0], "dt_s": 0.1, "slope_rad": 0.0, "mu": 0.5} | change
    with pytest.raises(InputError, match=message):
        slide(arguments.pop("ax_mps2"), arguments.pop("dt_s"), **arguments)


# Friction by speed, and the public scene


def test_slide_takes_a_law_of_friction_or_one_that_is_constant(noise):
    scene = {"slope_rad": 0.03, "mu": LAW}
    result = slide(noise, 0.01, **scene, tolerance=1e-8)
    slow, fast = (slide(noise, 0.01, slope_rad=0.03, mu=mu).prd_m for mu in (0.2, 0.3))
    assert slow > result.prd_m > fast
    assert result.across_m == 0.0
    assert result.error_m <= 1e-8 * result.prd_m
    assert slide_history(noise, 0.01, **scene, tolerance=1e-8).result == result
    solved = solver.solve(solver.scene(noise, 0.01, **scene)).result
    assert solved.prd_m == pytest.approx(result.prd_m, rel=1e-6)
    same = law(mu_fast=0.2)
    assert slide(noise, 0.01, slope_rad=0.03, mu=same) == slide(noise, 0.01, slope_rad=0.03, mu=0.2)
    assert slide(noise, 0.01, slope_rad=0.0, mu=same, method="paper").prd_m > 0.0


def test_made_scenes_are_checked_by_every_call_and_solved(noise):
    about = {"slope_rad": 0.03, "mu": 0.3, "scale": 1.2, "ay_mps2": -noise}
    solved = solver.solve(solver.scene(noise, 0.01, **about)).result
    assert solved.prd_m == pytest.approx(slide(noise, 0.01, **about).prd_m, rel=1e-12)
    with pytest.raises(InputError) as raised:
        solver.scene(noise, "0.01", slope_rad=0.03, mu=law(mu_static=0.0), ay_mps2=[True])
    assert len(raised.value.problems) == 4
    good = solver.scene(SWAY, 0.1, slope_rad=0.0, mu=0.1)
    bad = replace(good, dt_s=-0.1, scale=math.nan)
    for call in (solver.solve, lambda scene: solver.history(scene, solver.solve(good))):
        with pytest.raises(InputError) as error:
            call(bad)
        assert len(error.value.problems) == 2


def test_a_result_that_is_not_finite_is_a_status(noise, monkeypatch):
    # The border lets nothing pass that could do it: so the border is taken away.
    monkeypatch.setattr("solver.sliding.arguments.overflow", lambda scene: [])
    result = slide(noise, 1e200, slope_rad=0.0, mu=0.2)
    assert result.status is Status.DIVERGED
    assert math.isnan(result.prd_m)
    both = slide([0.0, 5.0, -5.0], 1e-320, slope_rad=0.0, mu=0.2, ay_mps2=[0.0, 1.0, 0.0])
    assert both.status is Status.DIVERGED
    assert math.isnan(both.error_m)


@pytest.mark.nightly
def test_results_are_short_to_read_and_tables_where_they_are_rows():
    history = solver.slide_history(SWAY, 0.1, slope_rad=0.0, mu=0.1)
    both = solver.slide_history(SWAY, 0.1, slope_rad=0.0, mu=0.1, ay_mps2=SWAY)
    sweep = solver.sweep([0.0, 4.0, 0.0], 0.1, slopes_rad=[0.0, 0.1], mus=[0.2], scales=[1.0, 2.0])
    assert repr(sweep) == "Sweep(2 slopes, 1 friction coefficients, 2 scales)"
    frame = history.to_frame()
    assert frame["u_m"].tolist() == history.u_m.tolist()
    assert frame.index.tolist() == history.t_s.tolist()
    assert "across_m" in both.to_frame()
    table = sweep.to_frame()
    assert table.loc[(0.1, 0.2, 2.0), "slope_deg"] == pytest.approx(math.degrees(0.1))
    assert table.loc[(0.1, 0.2, 2.0), "prd_m"] == sweep.prd_m[1, 0, 1]
    assert set(table["status"]) <= {"ok", "sliding_at_end", "uplift"}


# What set-up compiles is all that a report with three components runs


CODE = """
import json
from solver.kernels import one_axis, oscillator, rivals, row, two_axes
from numba.core.dispatcher import Dispatcher
from solver.sliding.warm import PARTS

def compiled():
    return {
        f"{module.__name__}.{name} {signature}"
        for module in (one_axis, oscillator, rivals, row, two_axes)
        for name, kernel in vars(module).items()
        if isinstance(kernel, Dispatcher)
        for signature in kernel.signatures
    }

for name in PARTS:
    PARTS[name]()
before = compiled()
from fixtures import projects
from report.assessment.support.evidence import support
support(projects.assess_input(projects.project(), projects.motions(2, seconds=8.0)))
print(json.dumps([sorted(compiled() - before), sorted(before)]))
"""


@pytest.mark.nightly
def test_a_report_compiles_nothing_that_set_up_has_not():
    paths = {"PYTHONPATH": f"{ROOT}{os.pathsep}{TESTS}"}
    command = [sys.executable, "-c", CODE]
    told = subprocess.check_output(command, cwd=ROOT, env=os.environ | paths, timeout=300)
    new, former = json.loads(told)
    assert new == []
    assert sum("slide_plane" in name for name in former) == 2  # both friction laws
