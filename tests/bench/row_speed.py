"""How long a row of linked blocks takes, and what its links change, against one rigid block.

Run from the top: .venv/bin/python tests/bench/row_speed.py [REPEATS]
Times are medians of repeats; the yardstick, one rigid block with vertical shaking, is measured in
the same run. The record is noise of 30 s at 0.005 s.
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

from solver.sliding import checked, one_axis
from solver.sliding.row import BlockRow, slide_row

DT_S, SECONDS, MUS = 0.005, 30.0, (0.3, 0.5, 0.4, 0.35, 0.45)
STIFFNESSES = (0.0, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8)


def noise(seed: int, peak_g: float) -> np.ndarray:
    """Return noise of 0.3 to 10 Hz that grows and fades [m/s2]."""
    rng, n = np.random.default_rng(seed), round(SECONDS / DT_S)
    freq = np.fft.rfftfreq(n, DT_S)
    band = (freq > 0.3) & (freq < 10.0)
    wave = np.fft.irfft(band * np.exp(2j * np.pi * rng.random(freq.size)))[:n]
    wave *= np.sin(np.pi * np.arange(n) / n)
    return peak_g * 9.80665 * wave / np.abs(wave).max()


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
    """Print a row for each stiffness, then one for each number of blocks."""
    repeats = int(sys.argv[1]) if sys.argv[1:] else 5
    scene = checked.scene(
        noise(1, 1.0), DT_S, slope_rad=math.radians(2.0), mu=0.4, az_mps2=noise(2, 0.4)
    )
    rigid = seconds(lambda: one_axis.run(scene), 20 * repeats)
    print(f"{platform.machine()}, Python {platform.python_version()}, numba {numba.__version__}, "
          f"medians of {repeats}; one rigid block {rigid * 1e6:.0f} us")  # fmt: skip
    print(f"{'k/m 1/s2':>9}{'ms':>9}{'ratio':>9}{'steps':>9}{'stops':>7}{'PRD mm':>9}"
          f"{'rigid mm':>9}{'stretch mm':>11}{'force':>7}{'bound m':>9}{'defect':>9}")  # fmt: skip
    for k in STIFFNESSES:
        row = BlockRow(mus=MUS, stiffness_per_s2=k, damping_per_s=0.1 * math.sqrt(k))
        result = slide_row(scene, row)
        took = seconds(lambda r=row: slide_row(scene, r), repeats)
        defect = abs(result.energy.defect) / result.energy.work
        print(f"{k:9.0e}{took * 1e3:9.1f}{took / rigid:9.0f}{result.n_steps:9}{result.n_stops:7}"
              f"{max(result.prd_m) * 1e3:9.3f}{result.rigid.prd_m * 1e3:9.3f}"
              f"{result.stretch_m * 1e3:11.2g}{result.link_force:7.2f}{result.error_m:9.1g}"
              f"{defect:9.1g}")  # fmt: skip
    for count in (1, 2, 5, 10, 20):
        row = BlockRow(
            mus=tuple(np.linspace(0.3, 0.5, count)), stiffness_per_s2=1e3, damping_per_s=3.0
        )
        took = seconds(lambda r=row: slide_row(scene, r), repeats)
        print(f"{count} blocks, k/m 1e3 1/s2: {took * 1e3:.1f} ms")


if __name__ == "__main__":
    main()
