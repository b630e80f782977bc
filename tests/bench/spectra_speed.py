"""How fast response spectra are: 200 periods of a record of 13,000 samples, and other sizes.

Run from the top: .venv/bin/python tests/bench/spectra_speed.py [REPEATS]
Times are medians of repeats. The yardstick is measured in the same run: the recursion of one
oscillator over the record, jitted, without looking for its peak, times the number of periods.
"""

from __future__ import annotations

import platform
import statistics
import sys
import time
from collections.abc import Callable

import numba
import numpy as np
from numba import njit

from solver.records.spectrum import response_spectrum

SIZES = ((200, 13_000), (200, 1_500), (50, 13_000), (1, 13_000), (200, 100_000))


@njit
def one_by_one(a: np.ndarray, periods: int) -> float:
    """Follow oscillators, one after the other: two multiply-adds from the state, two from a."""
    summed = 0.0
    for k in range(periods):
        y = z = 0.0
        c = 0.9 + 1e-9 * k
        for i in range(1, a.size):
            y, z = (
                c * y + 0.1 * z - 0.05 * a[i - 1] - 0.04 * a[i],
                c * z - 0.1 * y - 0.05 * a[i - 1] - 0.04 * a[i],
            )
        summed += y
    return summed


def seconds(call: Callable[[], object], repeats: int) -> float:
    """Median time of one call [s], after one that is not counted."""
    times = []
    call()
    for _ in range(repeats):
        started = time.perf_counter()
        call()
        times.append(time.perf_counter() - started)
    return statistics.median(times)


def main() -> None:
    """Print a row for each size."""
    repeats = int(sys.argv[1]) if sys.argv[1:] else 21
    rng = np.random.default_rng(1)
    print(f"{platform.machine()}, Python {platform.python_version()}, {numba.get_num_threads()} "
          f"threads, medians of {repeats}")  # fmt: skip
    print(f"{'periods':>8}{'samples':>9}{'ms':>9}{'ns/step':>9}{'yardstick ms':>14}{'ratio':>7}")
    for count, samples in SIZES:
        a, periods = rng.normal(size=samples), np.geomspace(0.02, 10.0, count)
        took_s = seconds(lambda a=a, periods=periods: response_spectrum(a, 0.01, periods), repeats)
        plain = seconds(lambda a=a, count=count: one_by_one(a, count), repeats)
        step_ns = took_s / count / samples * 1e9
        print(f"{count:8}{samples:9}{took_s * 1e3:9.2f}{step_ns:9.2f}{plain * 1e3:14.2f}"
              f"{plain / took_s:7.2f}")  # fmt: skip


if __name__ == "__main__":
    main()
