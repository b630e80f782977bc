"""Every method against closed forms, the exact one and SciPy: its order, limits, where it fails."""

import math
import sys
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import oracle
import solver
from fixtures.blocks import block, readonly, trapezoid
from fixtures.marks import by_day
from solver.errors import InputError
from solver.model import Status, coulomb
from solver.rivals import by_scipy
from solver.rivals.methods import METHODS
from solver.sliding import one_axis
from solver.sliding.checked import slide, slide_history
from solver.sliding.method import link_frequency
from solver.verification import reference
from solver.verification.model_checks import stopped_scene
from solver.verification.study_cases import Case, samples_of, scene_of
from solver.verification.verification_motions import cut, own_triples

G = 9.80665
STEPPED = ("paper", "linear", "adaptive")
LINKS = ("penalty-explicit", "penalty-implicit")
EVENTS = ("compiled-dop853", "compiled-rk45", "events-dop853", "events-rk45")
SCENES = [
    {"slope_rad": math.radians(degrees), "mu": mu}
    for degrees, mu in [(0, 0.2), (0, 0.4), (4, 0.3), (-4, 0.3), (7, 0.5), (2, 0.15)]
]


def errors(record, dt, method, **parameters):
    """Largest error of the PRD and the residual over the PRD, for each scene."""
    shares = []
    for scene in SCENES:
        exact = slide(record, dt, **scene)
        other = slide(record, dt, **scene, method=method, **parameters)
        off = other.prd_m - exact.prd_m, other.residual_m - exact.residual_m
        shares.append(max(map(abs, off)) / exact.prd_m)
    return np.array(shares)


def off_m(record, dt, scene, method, counts):
    """Errors of the residual over numbers of sub-steps."""
    runs = (slide(record, dt, **scene, method=method, substeps=p) for p in counts)
    exact_m = slide(record, dt, **scene).residual_m
    return np.array([abs(run.residual_m - exact_m) for run in runs])


def link_at(radians, dt, substeps):
    """Parameters of a link with omega h = radians."""
    return {"stiffness_per_m": (radians * substeps / dt) ** 2 / G, "substeps": substeps}


# The registry


@pytest.mark.parametrize("name", METHODS)
@pytest.mark.quick
def test_a_method_states_its_facts_and_gives_no_number_at_uplift(name):
    method = METHODS[name]
    assert method.name == name
    assert all(text.strip() for text in (method.title, method.invalid_when, method.source))
    assert method.invalid_when.endswith(".")
    assert (method.knob in method.parameters) is bool(method.sweep)
    assert solver.METHODS is METHODS
    result = slide([0.0, 0.0, -40.0, 0.0], 0.1, slope_rad=0.5, mu=0.5, g_mps2=10.0, method=name)
    assert result.status is Status.UPLIFT
    assert math.isnan(result.prd_m)


@pytest.mark.parametrize("name", METHODS)
def test_a_method_runs_with_its_defaults_and_over_its_sweep(name):
    method = METHODS[name]

    def run(**parameters):
        pulse = trapezoid(-0.5 * G, 5, 20)
        return slide(pulse, 0.02, slope_rad=0.0, mu=0.3, method=name, **parameters)

    assert run().prd_m > 0.0
    for value in method.sweep:
        some = method.settings(value, 0.02, G)
        assert some.keys() == method.parameters.keys()
        assert some[method.knob] == value
        assert run(**some).status is not Status.DIVERGED
    assert run() == run(**method.parameters)


# Closed forms

CEILINGS = {"exact": 1e-12, "frozen-normal": 1e-12, "linear": 1e-4}
CEILINGS |= dict.fromkeys(("paper", "adaptive", "regularized"), 0.01)
CEILINGS |= dict.fromkeys(LINKS, 0.005) | dict.fromkeys(EVENTS, 1e-12)
FINE = {
    "regularized": {"velocity_mps": 1e-4, "tolerance": 1e-6},
    **dict.fromkeys(LINKS, link_at(0.5, 0.01, 100)),
}


FLAT, SLOPED = (0, 0.1, 0.4), (5, 0.4, 0.6)
ON_SLOPES = [name for name in CEILINGS if METHODS[name].takes_vertical and name != "frozen-normal"]


@pytest.mark.parametrize(
    ("name", "scene", "vertical"),
    [
        *((name, FLAT, 0.0) for name in CEILINGS),
        *((n, SLOPED, a) for n in ON_SLOPES for a in (-0.3, 0.3)),
    ],
)
def test_a_ramped_pulse_is_met_within_the_ceiling(name, scene, vertical):
    (degrees, mu, amplitude), dt, plateau = scene, 0.01, 25
    slope, az = math.radians(degrees), trapezoid(vertical * G, plateau, 150) if vertical else None
    drive, resist = reference.slope_pulse(slope, mu, amplitude, vertical, G)
    expected = reference.pulse_travel(drive, resist, plateau * dt, dt) * math.cos(slope)
    ax, some = trapezoid(-amplitude * G, plateau, 150), {"method": name} | FINE.get(name, {})
    result = slide(ax, dt, slope_rad=slope, mu=mu, az_mps2=az, **some)
    assert (result.prd_m, result.down_m) == pytest.approx((expected,) * 2, rel=CEILINGS[name])
    assert result.status is Status.OK


@pytest.mark.parametrize("name", ["paper", "linear", "penalty-explicit", "penalty-implicit"])
def test_the_steady_harmonic_travels_as_far_each_half_cycle(name):
    ax = 0.5 * G * np.sin(2 * np.pi * np.arange(40 * 200 + 1) / 200)
    history = slide_history(ax, 1 / 200, slope_rad=0, mu=0.2, method=name, **FINE.get(name, {}))
    expected = reference.harmonic_travel(0.5, 0.2, 1.0, G)
    assert np.ptp(history.u_m[-201:]) == pytest.approx(expected, rel=0.005)


@pytest.mark.parametrize(
    ("degrees", "mu", "amplitude", "vertical", "off"),
    [
        (7, 0.2, 1.0, 0.0, -0.05),
        (5, 0.4, 0.6, 0.0, -0.10),
        (10, 0.5, 0.8, 0.0, -0.20),
        (5, 0.4, 0.6, -0.3, -0.48),
        (5, 0.4, 0.6, 0.3, 0.74),
    ],
)
def test_a_frozen_normal_force_is_off_by_its_closed_form(degrees, mu, amplitude, vertical, off):
    slope, dt, plateau = math.radians(degrees), 0.01, 30
    sn, cs = math.sin(slope), math.cos(slope)
    drive, resist = reference.slope_pulse(slope, mu, amplitude, vertical, G)
    true = reference.pulse_travel(drive, resist, plateau * dt, dt) * cs
    frozen_drive, frozen_resist = (amplitude * cs + vertical * sn) * G, (mu * cs - sn) * G
    frozen = reference.pulse_travel(frozen_drive, frozen_resist, plateau * dt, dt) * cs
    ax, az = (trapezoid(a * G, plateau, 3000) for a in (-amplitude, vertical))
    result = slide(ax, dt, slope_rad=slope, mu=mu, az_mps2=az, method="frozen-normal")
    assert result.down_m == pytest.approx(frozen, rel=1e-12)
    assert result.down_m / true - 1 == pytest.approx(off, abs=0.01)


# Events: stops within a sampling interval, against 40 digits

EXACT_BY_EVENTS = [name for name, m in METHODS.items() if m.invalid_when.startswith("Never")]


@pytest.mark.parametrize("name", EXACT_BY_EVENTS)
@pytest.mark.quick
def test_a_speed_that_dips_to_zero_between_two_samples_is_a_stop(name):
    ax = [1.2, -4.4, 1.3, -5.2, 0.6, -1.6]
    result = slide(ax, 0.01, slope_rad=0.0, mu=0.2, method=name)
    exact = oracle.slide(ax, 0.01, slope_rad=0.0, mu=0.2)
    assert result.n_stops == exact.n_stops == 2
    assert result.prd_m == pytest.approx(float(exact.prd), rel=1e-12)


@pytest.mark.parametrize("name", EXACT_BY_EVENTS)
def test_random_records_of_few_samples_are_followed_to_rounding(name):
    rng, off = np.random.default_rng(7), []
    for k in range(200):
        ax, az = rng.normal(0.0, 5.0, 6).round(1), rng.normal(0.0, 1.0, 6).round(1) * (k % 2)
        scene = {"slope_rad": math.radians(rng.integers(-4, 8)), "mu": 0.1 * rng.integers(1, 6)}
        exact = oracle.slide(ax, 0.01, az=az, **scene)
        result = slide(ax, 0.01, az_mps2=az, method=name, units="m/s2", **scene)
        far = max(abs(result.prd_m - exact.prd), abs(result.residual_m - exact.residual))
        off.append(float(far / max(exact.prd, 1e-6)))
    assert np.median(off) < 1e-14
    assert max(off) < 1e-11


# Formal orders


@pytest.mark.parametrize("name", STEPPED)
def test_the_onset_of_a_slip_is_met_at_the_formal_order(name):
    # Friction is passed at a third of the first interval: a third of a sub-step for all powers of
    # four, so that the error is not changed by where the onset falls.
    ax = np.array([0.0, -0.9, -0.9, -0.9]) * G
    off = off_m(ax, 0.3, {"slope_rad": 0.0, "mu": 0.3}, name, (64, 256, 1024))
    orders = np.log(off[:-1] / off[1:]) / math.log(4)
    assert orders == pytest.approx([METHODS[name].order] * 2, abs=0.05)


T = np.arange(41) * 0.05
LASTING = -2 * np.sin(3 * T) - T, 0.05
STEEP = {"slope_rad": math.radians(30), "mu": 0.1}


@pytest.mark.parametrize("name", ["paper", "adaptive", *LINKS])
def test_a_lasting_slip_is_met_at_the_formal_order(name):
    off = off_m(*LASTING, STEEP, name, (8, 16, 32))
    orders = np.log2(off[:-1] / off[1:])
    assert orders == pytest.approx([METHODS[name].order] * 2, abs=0.05)


def test_linear_acceleration_follows_a_lasting_slip_to_rounding():
    exact = slide(*LASTING, **STEEP)
    result = slide(*LASTING, **STEEP, method="linear", substeps=1)
    assert result.prd_m == pytest.approx(exact.prd_m, rel=1e-13)


# Stick and slip: an envelope over scenes and neighboring numbers of sub-steps, and a ceiling.


@pytest.mark.parametrize(
    ("name", "ceilings"), [("paper", (0.13, 0.03, 0.008)), ("linear", (0.012, 0.003, 0.0008))]
)
def test_errors_in_stick_and_slip_fall_at_first_order_below_a_ceiling(noise, name, ceilings):
    largest = []
    for p, ceiling in zip((16, 64, 256), ceilings, strict=True):
        near = [p - p // 8, p, p + p // 8]
        largest.append(np.max([errors(noise, 0.01, name, substeps=q) for q in near]))
        assert largest[-1] < ceiling
    # Reversals without a rest hold linear acceleration to first order too.
    assert math.log(largest[0] / largest[-1], 16) == pytest.approx(1.0, abs=0.25)


@settings(max_examples=60)
@given(
    st.lists(st.integers(-6, 6).map(lambda k: 0.5 * k), min_size=2, max_size=12),
    st.sampled_from([0.0, 0.25, 0.5]),
    st.sampled_from([0.0, math.atan(0.25), 0.1]),
)
def test_small_steps_only_in_slip_skip_nothing_that_moves(values, mu, slope):
    scene = {"slope_rad": slope, "mu": mu, "g_mps2": 2.0, "substeps": 4}
    paper, other = (slide(values, 0.5, **scene, method=name) for name in ("paper", "adaptive"))
    np.testing.assert_array_equal(
        [paper.prd_m, paper.residual_m, paper.t_prd_s, paper.n_stops],
        [other.prd_m, other.residual_m, other.t_prd_s, other.n_stops],
    )


# Links. 100 and 1000 N/mm on a weight of 1 N, and the limits of the paper.
@pytest.mark.parametrize(("stiffness", "limit_ms"), [(1e5, 2.02), (1e6, 0.64)])
def test_the_explicit_link_is_sound_below_its_limit_and_diverged_beyond(noise, stiffness, limit_ms):
    limit = 2 / link_frequency(stiffness, G)
    assert 1000 * limit == pytest.approx(limit_ms, abs=0.005)
    some = {"method": "penalty-explicit", "stiffness_per_m": stiffness, "substeps": 5}
    for scene in SCENES:
        assert slide(noise, 5 * 0.95 * limit, **scene, **some).status is not Status.DIVERGED
        assert slide(noise, 5 * 1.05 * limit, **scene, **some).status is Status.DIVERGED


def test_a_diverged_run_gives_no_number(noise):
    some = link_at(2.5, 0.01, 10)
    history = slide_history(noise, 0.01, slope_rad=0.0, mu=0.4, method="penalty-explicit", **some)
    result = history.result
    assert result.status is Status.DIVERGED
    assert "no displacement" in result.status.sentence
    lengths = result.prd_m, result.residual_m, result.down_m, result.up_m
    assert np.isnan([*lengths, result.t_prd_s, result.end_speed_mps]).all()
    assert not math.isnan(result.n_min_g)
    assert np.isnan([history.u_m, history.v_mps]).all()
    for name in LINKS:
        some = {"method": name, "stiffness_per_m": 1e308}
        pulse = trapezoid(-4.0, 5, 20)
        assert slide(pulse, 0.01, slope_rad=0.0, mu=0.2, **some).status is Status.DIVERGED


def test_a_ratchet_on_a_steep_roof_is_told_from_slip(noise):
    # Beyond its limit the link creeps down, slip by slip, without ever slipping to and fro.
    record, scene = 0.02 * noise, {"slope_rad": math.radians(30), "mu": 0.8}
    assert slide(record, 0.01, **scene).prd_m == 0.0
    for radians in (2.1, 3.0, 40.0):
        some = {"method": "penalty-explicit"} | link_at(radians, 0.01, 4)
        assert slide(record, 0.01, **scene, **some).status is Status.DIVERGED


@pytest.mark.parametrize("radians", [0.4, 1.0, 1.6, 3.1])
@pytest.mark.parametrize("substeps", [1, 8])
def test_the_implicit_link_converges_up_to_1_6_radians_a_step(noise, radians, substeps):
    """At 3.1 it goes to and fro between stick and slip."""
    some = {"method": "penalty-implicit"} | link_at(radians, 0.01, substeps)
    for scene in SCENES:
        diverges = slide(noise, 0.01, **scene, **some).status is Status.DIVERGED
        assert diverges == (radians > 2.0)


@pytest.mark.parametrize("name", LINKS)
def test_a_link_in_balance_with_gravity_stays_where_it_is(name):
    result = slide(np.zeros(200), 0.01, slope_rad=0.1, mu=0.4, method=name)
    assert result.prd_m < 1e-15
    assert (result.status, result.n_stops) == (Status.OK, 0)
    slope = math.radians(7)
    expected = reference.free_slide_travel(slope, 0.1, 2.0, G) * math.cos(slope)
    result = slide(np.zeros(201), 0.01, slope_rad=slope, mu=0.1, method=name)
    assert result.down_m == pytest.approx(expected, rel=1e-10)
    assert result.status is Status.SLIDING_AT_END


# Regularized friction


def test_regularized_friction_creeps_where_the_block_should_stick(monkeypatch, noise):
    slope, mu, velocity, still = math.radians(4), 0.3, 0.001, np.zeros(400)
    assert slide(still, 0.01, slope_rad=slope, mu=mu).prd_m == 0.0
    creep = velocity * math.atanh(math.tan(slope) / mu) * 3.99 * math.cos(slope)
    some = {"method": "regularized", "velocity_mps": velocity}
    for tolerance in (1e-4, 1e-6):
        result = slide(still, 0.01, slope_rad=slope, mu=mu, tolerance=tolerance, **some)
        assert result.down_m == pytest.approx(creep, rel=0.01)
        assert result.status is Status.OK
    # In two axes it creeps as its closed form says.
    scene, v0 = stopped_scene(), 1e-3
    _, _, vx, vy = by_scipy.regularized(samples_of(scene), scene.dt_s, v0, 1e-6)[:, -1]
    share = 2.0 / (0.4 * scene.g_mps2)
    assert math.hypot(vx, vy) == pytest.approx(v0 * math.atanh(share), rel=1e-4)
    # A stalled run is given up.
    monkeypatch.setattr(by_scipy, "STEPS", 2)
    result = slide(noise, 0.01, slope_rad=0.0, mu=0.3, method="regularized")
    assert result.status is Status.DIVERGED


# One signature


@pytest.mark.parametrize("name", METHODS)
def test_a_history_ends_where_the_result_says_and_follows_the_exact_one(noise, name):
    record = noise[600:1000]
    scene, some = {"slope_rad": 0.0, "mu": 0.2}, FINE.get(name, {})
    exact = slide_history(record, 0.01, **scene)
    history = slide_history(record, 0.01, **scene, method=name, **some)
    assert history.result == slide(record, 0.01, **scene, method=name, **some)
    assert history.u_m[-1] == pytest.approx(history.result.residual_m, rel=1e-9)
    near = 0.05 * exact.result.prd_m
    assert np.abs(history.u_m - exact.u_m).max() < near
    sides, wanted = ((r.down_m, r.up_m) for r in (history.result, exact.result))
    assert min(wanted) > 2.0 * near
    assert sides == pytest.approx(wanted, abs=near)
    assert bool(history.events) is (name == "exact")


@pytest.mark.parametrize("name", METHODS)
def test_vertical_shaking_is_taken_or_refused_as_the_method_says(noise, name):
    about = {"slope_rad": 0.03, "mu": 0.3, "az_mps2": 0.3 * noise[900:1200], "method": name}
    if METHODS[name].takes_vertical:
        assert slide(noise[600:900], 0.01, **about).prd_m > 0.0
    else:
        with pytest.raises(InputError, match=f"'{name}' takes horizontal shaking only"):
            slide(noise[600:900], 0.01, **about)


@pytest.mark.parametrize(
    ("name", "parameters", "message"),
    [
        ("exact", {"substeps": 4}, "'exact' has no parameter 'substeps'; it has none"),
        ("penalty-explicit", {"stiffness": 1e4}, "'stiffness'; it has stiffness_per_m, substeps"),
        ("linear", {"substeps": 1.5}, "substeps is 1.5; use a whole number of 1 or more"),
        ("linear", {"substeps": "8"}, "substeps is '8'; use a whole number"),
        ("penalty-implicit", {"stiffness_per_m": 0.0}, "stiffness_per_m is 0.0; use a finite"),
        ("regularized", {"tolerance": 1.0}, "tolerance is 1.0; use a number from 1e-13 to 0.1"),
    ],
)
def test_parameters_at_fault_raise_the_input_error(name, parameters, message):
    with pytest.raises(InputError, match=message):
        slide([0.0, 1.0, 0.0], 0.1, slope_rad=0.0, mu=0.5, method=name, **parameters)


def assert_followed(scene):
    """As the exact motion in one axis."""
    exact = one_axis.run_history(scene)
    rows = samples_of(replace(scene, ay_mps2=readonly(0.0 * scene.ax_mps2)))
    x, y, *_ = by_scipy.plane(rows, scene.dt_s)
    x *= math.cos(scene.slope_rad)
    np.testing.assert_allclose(x, exact.u_m, rtol=0.0, atol=1e-11 * exact.result.prd_m)
    np.testing.assert_allclose(y, 0.0, atol=1e-20)
    return exact.result


@pytest.mark.parametrize("slope_deg", by_day([0.0, 4.0], 1))
def test_two_axes_follow_the_exact_motion_where_there_is_one_axis(slope_deg):
    part = cut(own_triples(True)[0], 41)
    scene = scene_of(part, Case(slope_deg, 0.5, 1.0), coulomb(0.5), second=False)
    assert assert_followed(scene).n_stops > 0


def test_two_axes_follow_a_slip_whose_drive_ends_within_its_first_interval():
    dt = own_triples(True)[0].dt_s
    assert assert_followed(block([5.0, 0.0, 0.0, 0.0, 0.0], az=np.zeros(5), dt=dt)).prd_m > 0.0


@pytest.mark.parametrize("name", ["regularized", "events-rk45"])
def test_without_scipy_its_methods_say_what_to_install(monkeypatch, noise, name):
    monkeypatch.setitem(sys.modules, "scipy.integrate", None)
    with pytest.raises(InputError, match="install the extra verify"):
        slide(noise, 0.01, slope_rad=0.0, mu=0.3, method=name)
