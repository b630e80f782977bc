"""How fast the exact method is, as ratios measured side by side in one run.

Run from the top: .venv/bin/python tests/bench/solver_speed.py [RECORD.csv ...]
Over the grid of the paper (29 slopes x 15 frictions x 16 PPA) the mean time of a run, against
one streaming pass over the record (the sum of its samples, jitted) and against the paper's
algorithm at P = 64 on the same runs (every 97th of them, for it is slow). Medians of repeats, the
geometric mean over the records. Without arguments: the 18 records that the package pyslammer
carries, and the example's.
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

from solver import kernels, rivals
from solver.formats import read_record

ROOT = Path(__file__).resolve().parents[2]
G = 9.80665
SLOPES = [math.radians(0.5 * k) for k in range(-14, 15)]
FRICTIONS = [0.1 + 0.05 * k for k in range(15)]
PPAS = [0.1 * k for k in range(16)]
GRID = np.array(list(itertools.product(SLOPES, FRICTIONS, PPAS)))
NO_RECORD = np.empty(0)
NO_RECORD.setflags(write=False)
NO_HISTORY = np.empty((2, 0))


@njit
def total(a: np.ndarray) -> float:
    """Sum of the samples: one streaming pass."""
    found = 0.0
    for value in a:
        found += value
    return found


@njit
def run_exact(ax: np.ndarray, x: np.ndarray, dt: float, peak: float, grid: np.ndarray) -> float:
    """Run every row of the grid; the sum of the PRDs keeps the work from being optimised away."""
    found = 0.0
    for k in range(grid.shape[0]):
        sn, cs, scale = math.sin(grid[k, 0]), math.cos(grid[k, 0]), grid[k, 2] * G / peak
        n_min, _ = kernels.least_normal(ax, None, x, None, dt, sn, cs, G, scale)
        out = kernels.slide_exact(ax, None, x, None, dt, sn, cs, grid[k, 1], G, scale, None)
        found += max(out[0], -out[1]) + min(n_min, 0.0)
    return found


def run_paper(ax: np.ndarray, dt: float, peak: float, grid: np.ndarray) -> None:
    """Run every row of the grid by the paper's algorithm."""
    for slope, mu, ppa in grid:
        sn, cs, scale = math.sin(slope), math.cos(slope), ppa * G / peak
        rivals.slide_constant(ax, NO_RECORD, dt, sn, cs, mu, G, scale, 64, False, NO_HISTORY)


def seconds(call: Callable[[], object], repeats: int, loops: int = 1) -> float:
    """Median time of one call [s], after one that is not counted."""
    times = []
    call()
    for _ in range(repeats):
        started = time.perf_counter()
        for _ in range(loops):
            call()
        times.append((time.perf_counter() - started) / loops)
    return statistics.median(times)


def measure(path: Path) -> tuple[int, float, float, float]:
    """Return the samples of a record and the time of a run: exact, paper, one pass [s]."""
    record = read_record(path, units="g")
    ax, dt = record.a_mps2, record.dt_s
    x, peak, few = kernels.bounds(ax), float(np.abs(ax).max()), GRID[::97]
    exact = seconds(lambda: run_exact(ax, x, dt, peak, GRID), 5) / len(GRID)
    paper = seconds(lambda: run_paper(ax, dt, peak, few), 3) / len(few)
    exact_few = seconds(lambda: run_exact(ax, x, dt, peak, few), 15) / len(few)
    one = seconds(lambda: total(ax), 15, loops=500)
    return ax.size, exact, paper * exact / exact_few, one


def suites() -> dict[str, list[Path]]:
    """Return the records to run, by where they come from."""
    if sys.argv[1:]:
        return {"records": [Path(name) for name in sys.argv[1:]]}
    made = ROOT / "projects" / "example" / "records"
    found = {"example": sorted(made.glob("*-x.csv"))}
    spec = importlib.util.find_spec("pyslammer")
    if spec is not None and spec.origin is not None:
        real = Path(spec.origin).parent / "sample_ground_motions"
        found["pyslammer"] = sorted(real.glob("*.csv"))
    return found


def main() -> None:
    """Print a row for each record, and the geometric means of each suite."""
    print(f"{platform.machine()}, Python {platform.python_version()}, one core")
    headings = ("samples", "exact us", "pass us", "exact/pass", "paper/exact")
    print(f"{'record':32}" + "".join(f"{heading:>13}" for heading in headings))
    for name, paths in suites().items():
        logs = []
        for path in paths:
            size, exact, paper, one = measure(path)
            logs.append((math.log(exact / one), math.log(paper / exact)))
            figures = (size, exact * 1e6, one * 1e6, exact / one, paper / exact)
            print(f"{path.stem:32}" + "".join(f"{figure:13.2f}" for figure in figures))
        means = [math.exp(statistics.mean(column)) for column in zip(*logs, strict=True)]
        print(f"{name + ', geometric mean':71}" + "".join(f"{mean:13.2f}" for mean in means))


if __name__ == "__main__":
    main()
