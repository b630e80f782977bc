"""How fast the exact method is, as ratios measured side by side in one run.

Run from the top: .venv/bin/python tests/bench/solver_speed.py [RECORD.csv ...]
Against one streaming pass over the record (the sum of its samples, jitted) and against the paper's
algorithm at P = 64; medians of repeats, the geometric mean over the records. Without arguments it
runs the example's records.
"""

from __future__ import annotations

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
from solver.motion import read_record

ROOT = Path(__file__).resolve().parents[2]
G = 9.80665
SCENES = [
    (d, mu, ppa) for d in (0.0, 2.0, 4.0, 7.0) for mu in (0.2, 0.4, 0.6) for ppa in (0.5, 1.5)
]
NO_EVENTS, NO_HISTORY = np.empty((0, 3)), np.empty((2, 0))
NO_RECORD = np.empty(0)
NO_RECORD.setflags(write=False)


@njit
def total(a: np.ndarray) -> float:
    """Sum of the samples: one streaming pass."""
    found = 0.0
    for value in a:
        found += value
    return found


def seconds(call: Callable[[], object], repeats: int, loops: int) -> float:
    """Median time of one call [s]."""
    times = []
    for _ in range(repeats):
        started = time.perf_counter()
        for _ in range(loops):
            call()
        times.append((time.perf_counter() - started) / loops)
    return statistics.median(times)


def measure(path: Path) -> tuple[int, float, float, float]:
    """Return the samples of a record and the mean time per run: exact, paper, one pass [s]."""
    record = read_record(path, units="g")
    ax, dt = record.a_mps2, record.dt_s
    peak = float(np.abs(ax).max())
    exact = paper = 0.0
    for degrees, mu, ppa in SCENES:
        sn, cs = math.sin(math.radians(degrees)), math.cos(math.radians(degrees))
        scale = ppa * G / peak

        def run_exact(sn: float = sn, cs: float = cs, mu: float = mu, k: float = scale) -> None:
            kernels.least_normal(ax, NO_RECORD, dt, sn, cs, G, k)
            kernels.slide_exact(ax, NO_RECORD, dt, sn, cs, mu, G, k, NO_EVENTS, NO_HISTORY)

        def run_paper(sn: float = sn, cs: float = cs, mu: float = mu, k: float = scale) -> None:
            rivals.slide_paper(ax, dt, sn, cs, mu, G, k, 64, NO_HISTORY)

        run_exact(), run_paper()
        exact += seconds(run_exact, 7, 50) / len(SCENES)
        paper += seconds(run_paper, 3, 1) / len(SCENES)
    total(ax)
    return ax.size, exact, paper, seconds(lambda: total(ax), 15, 200)


def main() -> None:
    """Print a row for each record and the geometric means."""
    paths = [Path(name) for name in sys.argv[1:]]
    paths = paths or sorted((ROOT / "projects" / "example" / "records").glob("*-h.csv"))
    print(f"{platform.processor() or platform.machine()}, Python {platform.python_version()}")
    headings = ("samples", "exact us", "pass us", "exact/pass", "paper/exact")
    print(f"{'record':24}" + "".join(f"{heading:>13}" for heading in headings))
    logs = []
    for path in paths:
        size, exact, paper, one = measure(path)
        logs.append((math.log(exact / one), math.log(paper / exact)))
        figures = (size, exact * 1e6, one * 1e6, exact / one, paper / exact)
        print(f"{path.stem:24}" + "".join(f"{figure:13.2f}" for figure in figures))
    means = [math.exp(statistics.mean(column)) for column in zip(*logs, strict=True)]
    print(f"{'geometric mean':63}" + "".join(f"{mean:13.2f}" for mean in means))


if __name__ == "__main__":
    main()
