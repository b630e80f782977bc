"""How fast the exact method is, as ratios measured side by side in one run.

Run from the top: .venv/bin/python tests/bench/solver_speed.py [RECORD.csv ...]
Over the grid of the paper (29 slopes x 15 frictions x 16 PPA) the mean time of a run, against
one streaming pass over the record (the sum of its samples, jitted) and against the paper's
algorithm at P = 64 (the mean of every 97th of these runs, for it is slow), jitted too and written
twice: "listed", equation by equation as the paper has it, and "fast", as `method="paper"` runs it.
Medians of repeats in turns, processor time, the geometric mean over the records. Without
arguments: the 18 records that the package pyslammer carries, and the example's.
"""

from __future__ import annotations

import importlib.util
import itertools
import math
import platform
import statistics
import sys
import time
from collections.abc import Callable
from pathlib import Path

import numpy as np
from numba import njit

from solver.formats import read_record
from solver.kernels import one_axis, rivals
from solver.sliding.sweep import order_alike

ROOT = Path(__file__).resolve().parents[2]
G = 9.80665
SLOPES = [math.radians(0.5 * k) for k in range(-14, 15)]
FRICTIONS = [0.1 + 0.05 * k for k in range(15)]
PPAS = [0.1 * k for k in range(16)]
GRID = np.array(list(itertools.product(SLOPES, FRICTIONS, PPAS)))
GRID = GRID[order_alike(GRID)]  # as `sweep` runs them
NO_RECORD = np.empty(0)
NO_RECORD.setflags(write=False)
NO_HISTORY = np.empty((2, 0))
SUBSTEPS = 64
REPEATS = 5
PASSES = 500


@njit
def total(a: np.ndarray) -> float:
    """Sum of the samples: one streaming pass."""
    summed = 0.0
    for value in a:
        summed += value
    return summed


@njit
def run_exact(ax: np.ndarray, x: np.ndarray, dt: float, peak: float, grid: np.ndarray) -> float:
    """Run every row of the grid; the sum of the PRDs keeps the work from being optimized away."""
    sum_m = 0.0
    for k in range(grid.shape[0]):
        sn, cs, scale = math.sin(grid[k, 0]), math.cos(grid[k, 0]), grid[k, 2] * G / peak
        n_min, _ = one_axis.least_normal(ax, None, x, None, dt, sn, cs, G, scale)
        out = one_axis.slide_exact(ax, None, x, None, dt, sn, cs, grid[k, 1], G, scale, None)
        sum_m += max(out[0], -out[1]) + min(n_min, 0.0)
    return sum_m


@njit
def paper_as_listed(
    ax: np.ndarray, dt: float, theta: float, mu: float, g: float, scale: float, substeps: int
) -> float:
    """PRD [m] by Eqs. 1-19 of the paper, in their variables and their order."""
    sn, cs, tn = math.sin(theta), math.cos(theta), math.tan(theta)
    step = dt / substeps
    v_p = u_p = v_x = u_x = dv = dv_before = prd = 0.0  # Eq. 19
    for i in range(ax.size - 1):
        for j in range(substeps):
            a_p = scale * (ax[i] + (ax[i + 1] - ax[i]) * (j / substeps))
            normal, drive = g * cs + a_p * sn, abs(a_p * cs - g * sn)  # Eqs. 6, 8
            if (dv == 0.0 or dv * dv_before < 0.0) and drive < mu * abs(normal):  # Eq. 9
                v_x, a_x, dv = v_p, a_p, 0.0
            else:
                sign = np.sign(dv)
                a_k = sn - mu * sign * cs  # Eq. 13
                b_k = cs + mu * sign * sn  # Eq. 15
                c_k = g + a_p * tn  # Eq. 16
                a_x = c_k / (a_k * tn + b_k) * a_k  # Eqs. 17, 18
            u_p += v_p * step + 0.5 * a_p * step * step
            v_p += a_p * step
            u_x += v_x * step + 0.5 * a_x * step * step
            v_x += a_x * step
            dv_before, dv = dv, v_x - v_p
            prd = max(prd, abs(u_x - u_p))
    return prd


def run_listed(ax: np.ndarray, dt: float, peak: float, grid: np.ndarray) -> np.ndarray:
    """PRD of every row of the grid by the paper's algorithm as it is listed."""
    return np.array(
        [paper_as_listed(ax, dt, slope, mu, G, ppa * G / peak, SUBSTEPS) for slope, mu, ppa in grid]
    )


def run_fast(ax: np.ndarray, dt: float, peak: float, grid: np.ndarray) -> np.ndarray:
    """PRD of every row of the grid by the paper's algorithm as fast as it goes."""
    prd_m = np.empty(len(grid))
    for k, (slope, mu, ppa) in enumerate(grid):
        sn, cs, scale = math.sin(slope), math.cos(slope), ppa * G / peak
        scene = ax, NO_RECORD, dt, sn, cs, mu, G, scale
        _, s_max, s_min, *_ = rivals.slide_constant(*scene, SUBSTEPS, False, NO_HISTORY)
        prd_m[k] = cs * max(s_max, -s_min)
    return prd_m


def seconds(*calls: Callable[[], object]) -> list[float]:
    """Median processor time of each call [s], taken in turns, after one that is not counted."""
    times: list[list[float]] = [[] for _ in calls]
    for _ in range(REPEATS + 1):
        for call, taken in zip(calls, times, strict=True):
            started = time.process_time()
            call()
            taken.append(time.process_time() - started)
    return [statistics.median(taken[1:]) for taken in times]


def measure(path: Path) -> tuple[int, float, float, float, float]:
    """Return the samples of a record and the time of a run: exact, one pass, both papers [s]."""
    record = read_record(path, units="g")
    ax, dt = record.a_mps2, record.dt_s
    x, peak, few = one_axis.bounds(ax), float(np.abs(ax).max()), GRID[::97]
    listed, fast = run_listed(ax, dt, peak, few), run_fast(ax, dt, peak, few)
    np.testing.assert_allclose(fast, listed, rtol=1e-9, atol=1e-9)
    exact, passes, listed_s, fast_s = seconds(
        lambda: run_exact(ax, x, dt, peak, GRID),
        lambda: [total(ax) for _ in range(PASSES)],
        lambda: run_listed(ax, dt, peak, few),
        lambda: run_fast(ax, dt, peak, few),
    )
    per_run = exact / len(GRID), passes / PASSES, listed_s / len(few), fast_s / len(few)
    return ax.size, *per_run


def suites() -> dict[str, list[Path]]:
    """Return the records to run, by where they come from."""
    if sys.argv[1:]:
        return {"records": [Path(name) for name in sys.argv[1:]]}
    made = ROOT / "projects" / "example" / "records"
    paths = {"example": sorted(made.glob("*-x.csv"))}
    spec = importlib.util.find_spec("pyslammer")
    if spec is not None and spec.origin is not None:
        real = Path(spec.origin).parent / "sample_ground_motions"
        paths["pyslammer"] = sorted(real.glob("*.csv"))
    return paths


def main() -> None:
    """Print a row for each record, and the geometric means of each suite."""
    print(f"{platform.machine()}, Python {platform.python_version()}, one core")
    headings = ("samples", "exact us", "pass us", "exact/pass", "listed/exact", "fast/exact")
    print(f"{'record':32}" + "".join(f"{heading:>13}" for heading in headings))
    for name, paths in suites().items():
        logs = []
        for path in paths:
            size, exact, streamed, listed, fast = measure(path)
            ratios = (exact / streamed, listed / exact, fast / exact)
            logs.append([math.log(ratio) for ratio in ratios])
            figures = (size, exact * 1e6, streamed * 1e6, *ratios)
            print(f"{path.stem:32}" + "".join(f"{figure:13.2f}" for figure in figures))
        means = [math.exp(statistics.mean(column)) for column in zip(*logs, strict=True)]
        print(f"{name + ', geometric mean':71}" + "".join(f"{mean:13.2f}" for mean in means))


if __name__ == "__main__":
    main()
