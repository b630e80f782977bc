"""Random runs of the exact solver, with samples put between and by the kernel of two axes."""

import math

import numpy as np
import pytest

from solver import Model, Settings, scene, slide, solve

pytestmark = pytest.mark.quick

RUNS = range(60)
G = 9.80665


def noise(rng, n, dt_s, peak_g):
    t = np.arange(n) * dt_s
    freq_hz, phase = rng.uniform(0.3, 10.0, 30), rng.uniform(0.0, 2.0 * np.pi, 30)
    wave = np.sin(2.0 * np.pi * freq_hz * t[:, None] + phase).sum(axis=1)
    wave *= np.sin(np.pi * np.arange(n) / (n - 1))
    return peak_g * G * wave / np.abs(wave).max()


def run(seed, *, vertical=False):
    """Return a record of 1 s to 30 s, on a roof of at most 5 degrees."""
    rng = np.random.default_rng(seed)
    n, dt_s = int(rng.integers(200, 1500)), float(rng.choice([0.005, 0.01, 0.02]))
    return {
        "ax_mps2": noise(rng, n, dt_s, rng.uniform(0.4, 1.5)),
        "az_mps2": noise(rng, n, dt_s, rng.uniform(0.05, 0.4)) if vertical else None,
        "dt_s": dt_s,
        "slope_rad": math.radians(rng.uniform(-5.0, 5.0)),
        "mu": float(rng.uniform(0.15, 0.6)),
    }


def far(prd_m, exact_m):
    """Error relative to the exact value, or to one millimeter where that is larger."""
    return abs(prd_m - exact_m) / max(exact_m, 1e-3)


@pytest.mark.parametrize("vertical", [False, True])
def test_samples_put_between_samples_change_nothing(vertical):
    for seed in RUNS:
        given = run(seed, vertical=vertical)
        n, parts = len(given["ax_mps2"]), 2 + seed % 6
        at = np.arange((n - 1) * parts + 1) / parts
        records = ("ax_mps2", "az_mps2")[: 1 + vertical]
        denser = {name: np.interp(at, np.arange(n), given[name]) for name in records}
        result = slide(**given | denser | {"dt_s": given["dt_s"] / parts})
        exact = slide(**given)
        assert far(result.prd_m, exact.prd_m) < 1e-10, seed
        assert result.residual_m == pytest.approx(exact.residual_m, abs=1e-10), seed


@pytest.mark.parametrize("vertical", [False, True])
def test_the_solver_in_two_axes_finds_the_motion_in_one(vertical):
    forced = Settings(forced=Model.TWO_AXES)
    for seed in RUNS:
        given = run(seed, vertical=vertical)
        plane = solve(scene(**given, ay_mps2=np.zeros(len(given["ax_mps2"]))), forced)
        assert plane.model == Model.TWO_AXES
        assert far(plane.result.prd_m, slide(**given).prd_m) < 1e-10, seed
