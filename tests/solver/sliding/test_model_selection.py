"""The choice of a model, and sweeps: as single runs are, to the last bit."""

import math
import pickle
import re
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace
from itertools import product

import numpy as np
import pytest

from fixtures.blocks import block, shaking
from fixtures.spaces import spaced
from solver.errors import InputError
from solver.forces import friction_demand
from solver.model import Friction, Status, coulomb
from solver.sliding import one_axis, two_axes
from solver.sliding.checked import motion, slide
from solver.sliding.model_selection import Model, Settings, history, solve
from solver.studies.sweep import STATUSES, order_alike, sweep

pytestmark = pytest.mark.quick

G = 9.80665
DT = 0.01
LENGTHS = ("prd_m", "down_m", "up_m", "across_m", "residual_m", "residual_across_m")


def scene(ax, ay=(), az=(), *, slope_deg=2.0, mu=0.4):
    return block(ax, ay, az, dt=DT, slope=math.radians(slope_deg), friction=mu)


def off(result, other):
    """The largest difference of PRD, excursions and residuals."""
    return max(abs(getattr(result, name) - getattr(other, name)) for name in LENGTHS)


AX, AY, AZ = (shaking(k + 1, peak_g * G, 20.0) for k, peak_g in enumerate((1.0, 0.9, 0.4)))
FULL, LIFTED, FLAT = scene(AX, AY, AZ), scene(AX, az=AZ), scene(AX)


def test_a_block_that_friction_holds_is_not_run():
    held = scene(AX, AY, AZ, mu=1.5, slope_deg=0.0)
    solution = solve(held)
    assert solution.model is Model.NO_SLIP
    assert solution.friction_demand < 1.5
    assert (solution.result.prd_m, solution.next_effect_m) == (0.0, 0.0)
    assert two_axes.run(held).prd_m == 0.0


def test_a_component_that_changes_the_residual_alone_is_modelled():
    x = [0, 7, -1, 0, -2, -2, 0, 0, 0, 0, 0]
    y = [0, -0.12, 0.12, -0.22, 0.82, 0.24, 0, 0, 0, 0, 0]
    run = block(x, y, (), dt=0.1, slope=math.radians(1.0), friction=0.2)
    full, along = two_axes.run(run), one_axis.run(run)
    assert full.residual_m - along.residual_m == pytest.approx(1.2e-3, abs=0.05e-3)
    assert abs(along.prd_m - full.prd_m) < 0.5e-3
    solution = solve(run)
    assert solution.model is Model.TWO_AXES
    assert solve(run, Settings(forced=Model.ONE_AXIS)).next_effect_m > 1e-3


@pytest.mark.parametrize("factor", [0.999, 1.001])
def test_the_friction_demand_tells_slip_from_none(factor):
    near = replace(FULL, friction=coulomb(friction_demand(FULL) * factor))
    moved = two_axes.run(near).prd_m
    assert (solve(near).model is Model.NO_SLIP) == (moved == 0.0)
    assert (moved > 0.0) == (factor < 1.0)


@pytest.mark.parametrize(
    ("run", "model"), [(FLAT, Model.ONE_AXIS), (LIFTED, Model.ONE_AXIS_VERTICAL)], ids=["x", "xz"]
)
def test_in_one_axis_a_vertical_that_matters_is_modelled_and_the_rest_is_not_known(run, model):
    solution = solve(run)
    assert solution.model is model
    assert solution.result == one_axis.run(run)
    assert math.isnan(solution.next_effect_m)


def test_a_vertical_that_does_not_matter_is_left_out_and_a_transverse_that_does_modelled():
    faint = scene(AX, az=1e-4 * AZ)
    solution, with_it, without = solve(faint), one_axis.run(faint), one_axis.run(FLAT)
    assert solution.model is Model.ONE_AXIS
    assert solution.result == without
    assert solution.next_model is Model.ONE_AXIS_VERTICAL
    assert solution.next_effect_m == off(with_it, without) + with_it.error_m > with_it.error_m
    solution = solve(FULL)
    assert solution.model is Model.TWO_AXES
    assert solution.result.across_m > 0.01
    assert solution.result.error_m <= 1e-6 * solution.result.prd_m
    assert solution.result.prd_m > 1.1 * one_axis.run(LIFTED).prd_m


@pytest.mark.parametrize("share", [0.3, 0.1, 0.03, 0.01])
@pytest.mark.parametrize("mu", [0.2, 0.4, 0.6])
@pytest.mark.parametrize("slope_deg", [0.0, 7.0])
def test_what_is_left_out_changes_less_than_is_said_and_than_may_be(share, mu, slope_deg):
    peaks = zip((11, 61, 101), (0.9, 0.9 * share, 0.3), strict=True)
    records = (shaking(seed, peak_g * G, 20.0) for seed, peak_g in peaks)
    run = scene(*records, slope_deg=slope_deg, mu=mu)
    solution, true, along = solve(run), two_axes.run(run, 1e-9), one_axis.run(run)
    allowed = Settings().bound_m(along.prd_m)
    if solution.model is Model.TWO_AXES:
        assert off(true, along) > allowed - solution.result.error_m
    else:
        assert off(true, solution.result) <= solution.next_effect_m <= allowed
        fuller = {Model.ONE_AXIS: Model.ONE_AXIS_VERTICAL, Model.ONE_AXIS_VERTICAL: Model.TWO_AXES}
        assert solution.next_model is fuller[solution.model]


@pytest.mark.parametrize(
    ("ay", "az", "model"),
    [
        (1e-5, 1e-3, Model.ONE_AXIS),
        (1e-5, 1.0, Model.ONE_AXIS_VERTICAL),
        (0.05, 1.0, Model.TWO_AXES),
    ],
)
def test_runs_that_are_not_needed_are_made_once_and_only_to_be_told(monkeypatch, ay, az, model):
    needed, runs = scene(AX, ay * AY, az * AZ), []

    def counted(run):
        def run_counted(*about):
            runs.append(run)
            return run(*about)

        return run_counted

    for module in (one_axis, two_axes):
        for name in ("run", "run_bounded"):
            monkeypatch.setattr(module, name, counted(getattr(module, name)))
    solution = solve(needed)
    assert solution.model is model
    assert {run.__module__ for run in runs} == {
        (two_axes if model is Model.TWO_AXES else one_axis).__name__
    }
    told, again = (pickle.loads(pickle.dumps(solution)) for _ in range(2))
    for copy in (told, again):
        for component in copy.explanation.args[0].components.values():
            component.setflags(write=False)  # for others the kernels are compiled once more
    tolerance_mm = 1e3 * Settings().bound_m(one_axis.run(needed).prd_m)
    assert re.search(rf"(tolerance|more than) {tolerance_mm:.2g} mm", spaced(told.reason))
    made = len(runs)
    assert (told.reason, str(told.next_effect_m)) == (again.reason, str(again.next_effect_m))
    assert len(runs) > made
    made = len(runs)
    assert repr(told) == repr(again)
    assert len(runs) == made
    if model is not Model.TWO_AXES:
        true = off(two_axes.run(needed, 1e-9), solution.result)
        assert true <= told.next_effect_m <= Settings().bound_m(solution.result.prd_m)


def test_a_faint_push_that_stays_is_carried_along_the_path_and_is_not_left_out():
    """0.02 g across 0.8 g that repeats: 14 mm in one axis, 111 mm in two."""
    t = np.arange(round(20.0 / DT) + 1) * DT
    ax = 0.8 * G * np.sin(6.0 * np.pi * t) * np.minimum(t / 2.0, 1.0)
    pushed = scene(ax, 0.02 * G * np.minimum(t, 1.0), slope_deg=0.0)
    solution = solve(pushed)
    assert one_axis.run(pushed).prd_m == pytest.approx(0.0139, abs=1e-4)
    assert solution.model is Model.TWO_AXES
    assert solution.result.prd_m == pytest.approx(0.1108, abs=1e-4)


def test_friction_by_speed_and_forced_models_are_run():
    law = Friction(mu_slow=0.3, mu_fast=0.5, rate_s_per_m=20.0, mu_static=0.3)
    solution = solve(scene(AX, AY, AZ, mu=law))
    assert solution.model is Model.SPEED_FRICTION
    assert solution.result.prd_m < solve(scene(AX, AY, AZ, mu=0.3)).result.prd_m
    models = Model.ONE_AXIS, Model.ONE_AXIS_VERTICAL, Model.TWO_AXES
    solution, lifted, two = (solve(FULL, Settings(forced=model)) for model in models)
    assert solution.result == one_axis.run(FLAT)
    # What the next one and all fuller ones would change.
    both = off(two.result, solution.result), off(lifted.result, solution.result)
    assert solution.next_model is Model.ONE_AXIS_VERTICAL
    assert solution.next_effect_m == pytest.approx(max(both), abs=2.0 * two.result.error_m)
    assert lifted.next_model is Model.TWO_AXES
    assert lifted.next_effect_m >= abs(two.result.prd_m - lifted.result.prd_m)
    assert {solution.reason, lifted.reason, two.reason} == {"requested"}
    with pytest.raises(InputError, match="required friction coefficient"):
        solve(FLAT, Settings(forced=Model.NO_SLIP))


@pytest.mark.parametrize("ay", [(), AY], ids=["alone", "both"])
@pytest.mark.parametrize("forced", [None, *Model])
def test_where_the_normal_force_vanishes_no_model_gives_a_number(ay, forced):
    solution = solve(scene(AX, ay, 4.0 * AZ), Settings(forced=forced))
    assert solution.result.status is Status.UPLIFT
    assert np.isnan([solution.result.prd_m, solution.result.error_m]).all()
    assert solution.friction_demand == math.inf


@pytest.mark.parametrize(
    ("run", "forced"),
    [
        (scene(AX, az=AZ, mu=2.0), Model.NO_SLIP),
        *((LIFTED, forced) for forced in (None, Model.ONE_AXIS, Model.ONE_AXIS_VERTICAL)),
        (FULL, None),
    ],
)
def test_the_history_is_of_the_model_that_was_chosen(run, forced):
    solution = solve(run, Settings(forced=forced))
    seen = history(run, solution, Settings(forced=forced))
    assert seen.result == solution.result
    far = np.hypot(seen.u_m, seen.across_m if seen.across_m.size else 0.0).max()
    assert far == pytest.approx(solution.result.prd_m, rel=0.01, abs=1e-12)


SLOPES = [-0.5, -0.05, 0.0, 0.07]
FRICTIONS = [0.0, 0.02, 0.3]
SCALES = [0.0, 0.7, 2.0]
ALL = {"slopes_rad": SLOPES, "mus": FRICTIONS, "scales": SCALES}


FEW = {"slopes_rad": [0.0, 0.05], "mus": [0.1, 0.3], "scales": [0.0, 1.0]}


@pytest.mark.parametrize("vertical", [{}, {"az_mps2": 0.3}])
@pytest.mark.parametrize(("across", "axes"), [({}, ALL), ({"ay_mps2": 0.8}, FEW)])
def test_a_sweep_is_every_single_run(noise, across, axes, vertical):
    more = {name: share * noise[::-1] for name, share in (across | vertical).items()}
    swept = sweep(noise, 0.01, **axes, **more)
    seen = set()
    for (i, slope), (j, mu), (k, scale) in product(*map(enumerate, axes.values())):
        result = slide(noise, 0.01, slope_rad=slope, mu=mu, scale=scale, **more)
        np.testing.assert_array_equal(swept.prd_m[i, j, k], result.prd_m)
        np.testing.assert_array_equal(swept.residual_m[i, j, k], result.residual_m)
        assert STATUSES[swept.status[i, j, k]] is result.status
        seen.add(result.status)
    assert Status.OK in seen
    assert Status.SLIDING_AT_END in seen or axes is FEW
    assert swept.prd_m.shape == swept.status.shape == tuple(map(len, axes.values()))
    whole = motion(noise, more.get("ay_mps2"), more.get("az_mps2"), dt_s=0.01)
    np.testing.assert_array_equal(sweep(whole, **axes).prd_m, swept.prd_m)


def test_uplift_is_a_hole_and_every_value_at_fault_named():
    swept = sweep([0.0, -40.0, 0.0], 0.1, slopes_rad=[0.5, 0.0], mus=[0.4], scales=[1.0])
    assert np.isnan(swept.prd_m[0, 0, 0])
    assert STATUSES[swept.status[0, 0, 0]] is Status.UPLIFT
    assert np.isfinite(swept.prd_m[1, 0, 0])
    with pytest.raises(InputError) as raised:
        sweep([0.0, math.nan], 0.0, slopes_rad=[2.0], mus=[-0.1], scales=[])
    text = str(raised.value)
    for name in ("ax_mps2[1]", "dt_s", "slopes_rad has 2.0", "mus has -0.1", "scales has shape"):
        assert name in text


def test_threads_change_nothing_and_progress_runs_up_to_one(noise, monkeypatch):
    monkeypatch.setattr("solver.studies.sweep.THREADS", 1)
    alone = sweep(noise, 0.01, **ALL).prd_m
    monkeypatch.setattr("solver.studies.sweep.THREADS", 3)
    with ThreadPoolExecutor(3) as pool:
        found = list(pool.map(lambda _: sweep(noise, 0.01, **ALL).prd_m, range(6)))
    np.testing.assert_array_equal(found, [alone] * 6)
    shares = []
    sweep(noise, 0.01, slopes_rad=SLOPES, mus=0.3, scales=1.0, progress=shares.append)
    assert shares == [0.25, 0.5, 0.75, 1.0]


def test_scenes_that_yield_alike_are_neighbors():
    scenes = np.array(list(product(*ALL.values())))
    order = order_alike(scenes)
    assert sorted(order) == list(range(len(scenes)))
    down = [(s, m, k) for s, m, k in scenes[order] if s * k > 0.0]
    yields_at = [math.tan(math.atan(mu) - slope) / scale for slope, mu, scale in down]
    assert len(down) > 4
    assert yields_at == sorted(yields_at)
