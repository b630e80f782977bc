"""The bound of what cross-slope shaking changes: never below the true effect, and near it."""

import math

import numpy as np
import pytest

from fixtures.blocks import block, readonly, shaking
from solver.forces import components, forces
from solver.kernels.cross_slope import cross_slope_effect, first_slip
from solver.sliding import one_axis, two_axes

pytestmark = pytest.mark.quick

LENGTHS = ("prd_m", "down_m", "up_m", "across_m", "residual_m", "residual_across_m")


def at_most(run, matters=math.inf, share=0.0):
    """The bound of a scene [m]; inf if it is above what matters."""
    slope = math.sin(run.slope_rad), math.cos(run.slope_rad)
    forces = run.friction.mu_slow, run.g_mps2, run.scale
    return cross_slope_effect(*components(run), run.dt_s, *slope, *forces, matters, share, 0)


def effect(run):
    """The largest change of a displacement by the second axis [m], and its error."""
    both, along = two_axes.run(run, 1e-9), one_axis.run(run)
    change = max(abs(getattr(both, name) - getattr(along, name)) for name in LENGTHS)
    return change, both.error_m + along.error_m


def random_block(seed, across=None):
    """A block that slides for some samples or for most of them, or does not rest at all."""
    rng = np.random.default_rng([74, seed])
    mu, dt = rng.choice([0.0, 0.1, 0.3, 0.5, 0.8]), rng.choice([0.005, 0.02, 0.1])
    peak = 9.81 * (max(mu, 0.1) + 0.1) * rng.uniform(0.9, 3.0)
    ax, ay, az = (shaking(3 * seed + k, 1.0, 6.0, dt=dt) for k in range(3))
    share = 10.0 ** rng.uniform(-4.0, 0.0) if across is None else across
    up = rng.choice([0.0, 0.3]) * 9.81 * az
    side = share * peak * (ay if rng.random() < 0.7 else np.minimum(np.arange(ay.size) * dt, 1.0))
    slope = math.radians(rng.choice([-8.0, 0.0, 2.0]))
    # Rough or smooth: samples far apart change sign from one to the next.
    return block(
        peak * ax, side, up, dt=dt, slope=slope, friction=mu, scale=rng.choice([-1.0, 1.0])
    )


@pytest.mark.parametrize(
    "part", [0, *(pytest.param(k, marks=pytest.mark.nightly) for k in range(1, 20))]
)
def test_the_bound_is_never_below_the_true_effect(part):
    slid = 0
    for seed in range(20 * part, 20 * part + 20):
        run = random_block(seed)
        change, error = effect(run)
        assert change <= at_most(run) + error
        slid += change > 0.0
    assert slid > 5


@pytest.mark.parametrize(("mu", "least"), [(0.0, 1.0), (0.2, 0.25)])
@pytest.mark.parametrize("across", [1e-5, 0.01, 0.1])
def test_the_bound_of_a_lone_slip_is_its_effect_but_for_what_friction_takes_back(mu, least, across):
    push = 4.0 * np.minimum(np.arange(300) * 0.02, 1.0) * (np.arange(300) < 100)
    run = block(push, across * push, friction=mu, g=10.0)
    change, error = effect(run)
    assert least * at_most(run) - error <= change * (1.0 + 1e-12)
    assert change <= at_most(run) * (1.0 + 1e-12) + error


def test_nothing_is_changed_at_rest_and_what_is_not_small_is_not_told():
    quiet, push = np.zeros(20), np.array([0.0, 0.0, 4.0, 4.0, -3.0, 0.0, 0.0, 0.0])
    assert at_most(block(quiet, quiet)) == 0.0
    run = block(push, 1e-3 * push, friction=0.2, dt=0.1)
    bound = at_most(run)
    assert 0.0 < bound < 1e-3
    assert at_most(run, matters=bound) == at_most(run, share=1.0) == bound
    assert at_most(run, matters=0.9 * bound) == math.inf
    # Told after a few samples: what follows, even a sample that is no number, is not read.
    unread = readonly([*push, math.nan])
    assert at_most(block(unread, unread, friction=0.2, dt=0.1), matters=1e-6) == math.inf
    assert at_most(block(unread, 0.0 * unread, friction=0.2, dt=0.1), share=1.0) == math.inf


@pytest.mark.parametrize("seed", range(4))
def test_the_first_slip_is_at_the_first_sample_whose_ratio_exceeds_the_coefficient(seed):
    run = random_block(seed)
    made = forces(run)
    ratios = np.hypot(made.down_mps2, made.across_mps2) / made.normal_mps2
    slope, most = (math.sin(run.slope_rad), math.cos(run.slope_rad)), ratios.max()
    for hold in (
        0.0,
        *np.quantile(ratios, (0.3, 0.9)),
        math.nextafter(most, 0.0),
        most,
        2.0 * most,
    ):
        over = np.flatnonzero(~((ratios <= hold) & (made.normal_mps2 > 0.0)))
        found = first_slip(*components(run), *slope, hold, run.g_mps2, run.scale)
        assert found == (over[0] if over.size else ratios.size)


def test_a_block_slips_where_it_is_lifted_whatever_its_friction():
    quiet, lift = readonly(np.zeros(4)), readonly([0.0, -9.99, -10.0, 0.0])
    assert first_slip(quiet, quiet, lift, 0.0, 1.0, 5.0, 10.0, 1.0) == 2


def test_a_bound_from_the_first_slip_on_is_that_of_the_whole_record():
    for seed in range(10):
        run = random_block(seed)
        slope = math.sin(run.slope_rad), math.cos(run.slope_rad)
        about = run.friction.mu_slow, run.g_mps2, run.scale
        first = first_slip(*components(run), *slope, *about)
        later = cross_slope_effect(*components(run), run.dt_s, *slope, *about, math.inf, 0.0, first)
        assert later == at_most(run)
