"""Sweeps give what single runs give, to the last bit."""

import math
from concurrent.futures import ThreadPoolExecutor
from itertools import product

import numpy as np
import pytest

from solver.kernels import one_axis
from solver.model import InputError, Status
from solver.sliding.checked import motion, slide
from solver.sliding.sweep import STATUSES, order_alike, sweep

pytestmark = pytest.mark.quick

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


def test_the_number_of_threads_changes_nothing(noise, monkeypatch):
    prds_m = []
    for threads in (1, 3):
        monkeypatch.setattr("solver.sliding.sweep.THREADS", threads)
        prds_m.append(sweep(noise, 0.01, **ALL).prd_m)
    np.testing.assert_array_equal(*prds_m)


def test_threads_change_nothing_and_progress_runs_up_to_one(noise):
    with ThreadPoolExecutor(3) as pool:
        first, *others = pool.map(lambda _: sweep(noise, 0.01, **ALL).prd_m, range(6))
    np.testing.assert_array_equal(others, [first] * 5)
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


def test_on_one_core_each_scene_has_its_row(noise):
    """As a part of a study runs them: more scenes than columns of a scene."""
    ax = noise[:300].copy()
    ax.setflags(write=False)
    scenes = np.array([(0.02, 0.1 * (1 + k), 1.0) for k in range(5)])
    out = np.full((5, 4), math.nan)
    one_axis.sweep_exact(ax, None, one_axis.bounds(ax), None, 0.01, 9.8, scenes, out)
    for (slope, mu, _), row in zip(scenes, out, strict=True):
        result = slide(ax, 0.01, slope_rad=slope, mu=mu, g_mps2=9.8)
        assert math.cos(slope) * row[2] == result.residual_m
