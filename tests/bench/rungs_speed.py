"""What two axes and friction by speed cost, as ratios to one axis, side by side in one run.

Run from the top: .venv/bin/python tests/bench/rungs_speed.py
The example's motions: 30 s at 0.005 s in three components, each way of following them warm, least
time of repeats, one core. One axis is exact, with vertical shaking; two axes are to 1e-6.
"""

from __future__ import annotations

import math
import statistics
import time
from collections.abc import Callable
from pathlib import Path

import numpy as np

from solver import kernels
from solver.formats.reader import read_record
from solver.model import Friction, Scene, coulomb
from solver.plane import follow

RECORDS = Path(__file__).resolve().parents[2] / "projects" / "example" / "records"
G = 9.80665
# Slope [deg], friction coefficient, factor of the motion.
CASES = [(0.0, 0.4, 0.5), (2.0, 0.5, 0.7), (4.0, 0.5, 1.0), (7.0, 0.4, 1.0), (0.0, 0.2, 1.0)]


def motions() -> list[tuple[str, list[np.ndarray], float]]:
    """Return name, components x, y, z and time step of each motion of the example."""
    found = []
    for path in sorted(RECORDS.glob("*-x.csv")):
        sides = [
            read_record(path.with_name(path.name.replace("-x", s))) for s in ("-x", "-y", "-z")
        ]
        found.append((path.stem[:-2], [side.a_mps2 for side in sides], sides[0].dt_s))
    return found


def least(call: Callable[[], object], repeats: int = 15) -> float:
    """Least time of one call [s], after one that is not counted."""
    call()
    times = []
    for _ in range(repeats):
        started = time.perf_counter()
        call()
        times.append(time.perf_counter() - started)
    return min(times)


def one_axis(scene: Scene) -> Callable[[], object]:
    """Return the exact run of the component along the slope."""
    ax, az, slope = scene.ax_mps2, scene.az_mps2, scene.slope_rad
    x, z, sn, cs = kernels.bounds(ax), kernels.bounds(az), math.sin(slope), math.cos(slope)
    mu, scale, dt = scene.friction.mu_slow, scene.scale, scene.dt_s
    return lambda: kernels.slide_exact(ax, az, x, z, dt, sn, cs, mu, scene.g_mps2, scale, None)


def main() -> None:
    """Print the medians over the motions of each case."""
    headings = ("one axis us", "two axes ms", "ratio", "steps", "1e-10 ms", "by speed ms")
    print(f"{'case':24}" + "".join(f"{heading:>13}" for heading in headings))
    for slope_deg, mu, scale in CASES:
        rows = []
        for _, (ax, ay, az), dt in motions():
            scene = Scene(
                ax_mps2=ax,
                ay_mps2=ay,
                az_mps2=az,
                dt_s=dt,
                slope_rad=math.radians(slope_deg),
                friction=coulomb(mu),
                scale=scale,
                g_mps2=G,
            )
            law = Friction(mu_slow=mu, mu_fast=1.2 * mu, rate_s_per_m=30.0, mu_static=mu)
            fast = Scene(
                **{name: getattr(scene, name) for name in Scene.__slots__} | {"friction": law}
            )
            one, two = least(one_axis(scene)), least(lambda s=scene: follow(s))
            fine, slow = least(lambda s=scene: follow(s, 1e-10)), least(lambda s=fast: follow(s))
            steps = follow(scene).n_steps
            rows.append((one * 1e6, two * 1e3, two / one, steps, fine * 1e3, slow * 1e3))
        medians = [statistics.median(column) for column in zip(*rows, strict=True)]
        name = f"{slope_deg:g} deg, mu {mu:g}, x {scale:g}"
        print(f"{name:24}" + "".join(f"{figure:13.2f}" for figure in medians))


if __name__ == "__main__":
    main()
