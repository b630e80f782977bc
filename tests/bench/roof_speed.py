"""How fast a ground motion goes through a building: histories of its modes, and the roof motion.

Run from the top: .venv/bin/python tests/bench/roof_speed.py [REPEATS]
Times are medians of repeats. The yardstick is measured in the same run: SciPy's lfilter with the
same exact recursion, once for each mode, which gives histories too.
"""

from __future__ import annotations

import math
import platform
import statistics
import sys
import time
from collections.abc import Callable

import numba
import numpy as np
from scipy.signal import cont2discrete, lfilter

from solver.building.roof import absolute_accelerations, building_of_periods, to_roof

SIZES = ((1, 13_000), (4, 13_000), (12, 13_000), (40, 13_000), (40, 100_000))
DT_S, DAMPING = 0.005, 0.05


def filters(periods_s: np.ndarray) -> list[tuple[np.ndarray, np.ndarray]]:
    """Recursions from ground to absolute acceleration, exact for straight lines."""
    recursions = []
    for w in 2.0 * math.pi / periods_s:
        system = ([2.0 * DAMPING * w, w * w], [1.0, 2.0 * DAMPING * w, w * w])
        top, below, _ = cont2discrete(system, DT_S, "foh")
        recursions.append((top.ravel(), below))
    return recursions


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
    """Print a row for each size, then what a roof motion takes."""
    repeats = int(sys.argv[1]) if sys.argv[1:] else 21
    rng = np.random.default_rng(1)
    print(f"{platform.machine()}, Python {platform.python_version()}, numba {numba.__version__}, "
          f"medians of {repeats}")  # fmt: skip
    print(f"{'modes':>6}{'samples':>9}{'ms':>9}{'ns/step':>9}{'lfilter ms':>12}{'ratio':>7}")
    for count, samples in SIZES:
        a, periods = rng.normal(size=samples), np.geomspace(4.0, 0.1, count)
        zeta, each = np.full(count, DAMPING), filters(periods)
        took_s = seconds(
            lambda a=a, p=periods, z=zeta: absolute_accelerations(a, DT_S, p, z), repeats
        )
        plain = seconds(lambda a=a, e=each: [lfilter(t, b, a) for t, b in e], repeats)
        print(f"{count:6}{samples:9}{took_s * 1e3:9.2f}{took_s / count / samples * 1e9:9.2f}"
              f"{plain * 1e3:12.2f}{plain / took_s:7.2f}")  # fmt: skip
    a = rng.normal(size=13_000)
    for stories in (1, 4, 12, 0):
        building = building_of_periods([1.0], stories=stories)
        took = seconds(lambda a=a, b=building: to_roof(a, DT_S, b), repeats)
        print(f"a roof motion, {building.words}: {took * 1e3:.2f} ms")


if __name__ == "__main__":
    main()
