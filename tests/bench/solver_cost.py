"""How the cost of an exact run grows: with samples at rest, with sliding, with stops, with cases.

Run from the top: .venv/bin/python tests/bench/solver_cost.py
Each figure comes from scenes that differ in one thing alone; medians of repeats, one core, but the
sweep, which takes all cores.
"""

from __future__ import annotations

import math
import statistics
import time

import numpy as np
from numba import njit

from solver.kernels import one_axis
from solver.sliding.sweep import sweep

G = 9.80665


@njit
def repeat(
    ax: np.ndarray, x: np.ndarray, dt: float, sn: float, mu: float, times: int
) -> tuple[float, int]:
    """Run one scene many times; the sum keeps the work from being optimized away."""
    sum_m, stops = 0.0, 0
    for _ in range(times):
        out = one_axis.slide_exact(
            ax, None, x, None, dt, sn, math.sqrt(1.0 - sn * sn), mu, G, 1.0, None
        )
        sum_m += out[0] - out[1]
        stops = out[5]
    return sum_m, stops


def nanoseconds(ax: np.ndarray, dt: float, sn: float, mu: float) -> tuple[float, int]:
    """Median time of a run [ns] and its number of stops."""
    ax.setflags(write=False)
    x, times, durations_ns = one_axis.bounds(ax), 200, []
    _, stops = repeat(ax, x, dt, sn, mu, times)
    for _ in range(15):
        started = time.perf_counter()
        repeat(ax, x, dt, sn, mu, times)
        durations_ns.append((time.perf_counter() - started) / times * 1e9)
    return statistics.median(durations_ns), stops


def main() -> None:
    """Print the cost of each part."""
    short, long = (nanoseconds(np.zeros(n), 0.005, 0.05, 0.4)[0] for n in (2_000, 200_000))
    print(f"a run at rest, 2,000 samples   {short:10.0f} ns")
    print(f"a sample at rest               {(long - short) / 198_000:10.4f} ns")
    short, long = (nanoseconds(np.zeros(n), 0.005, 0.2, 0.1)[0] for n in (2_000, 20_000))
    print(f"a sample while sliding         {(long - short) / 18_000:10.3f} ns")
    noise = np.random.default_rng(1).normal(0.0, 6.0, 20_000)
    total, stops = nanoseconds(noise, 0.005, 0.0, 0.5)
    print(f"a slip with its stop           {total / stops:10.1f} ns ({stops} stops, white noise)")
    steps = {"slopes_rad": np.linspace(-0.1, 0.1, 29), "mus": np.linspace(0.1, 0.8, 15)}
    for n in (4, 16, 64):
        scales, times = np.linspace(0.0, 0.15, n), []
        for _ in range(6):
            started = time.perf_counter()
            sweep(noise, 0.005, scales=scales, **steps)
            times.append(time.perf_counter() - started)
        print(
            f"a sweep of {29 * 15 * n:6d} cases         {statistics.median(times) * 1e3:10.1f} ms"
        )


if __name__ == "__main__":
    main()
