"""How long each rung takes, as ratios to one axis measured side by side in one run.

Run from the top: .venv/bin/python tests/bench/rung_speed.py [REPEATS]
Medians of repeats in turns, processor time, warm, over 24 scenes of one made motion of three
components, 30 s at 0.005 s; what counts is the whole call, with the search for uplift. Two axes to
a tolerance of 1e-6 and, for comparison, 1e-10.
"""

from __future__ import annotations

import itertools
import math
import platform
import statistics
import sys
import time
from collections.abc import Callable
from functools import partial

import numba

from solver.model import Friction, Scene, coulomb
from solver.sliding import least_model, one_axis, two_axes
from solver.sliding.row import slide_row
from solver.synthesis import make_suite
from solver.verification.rung_study import by_speed, row_of
from solver.verification.scenes import HORIZONTAL, SEED, VERTICAL, Case
from solver.verification.triples import Triple

CASES = [Case(*c) for c in itertools.product((0.0, 2.0, 5.0), (0.3, 0.4, 0.5, 0.6), (1.0, 1.5))]
TIGHT = 1e-10


def motion() -> Triple:
    """Return a made motion of three components."""
    (made,) = make_suite(HORIZONTAL, VERTICAL, count=1, seed=SEED, dt_s=0.005)
    x, y, z = (record.a_mps2 for record in made.components)
    return Triple(name="made", is_recorded=False, dt_s=0.005, x_mps2=x, y_mps2=y, z_mps2=z)


def row(scene: Scene) -> object:
    """Slide five blocks with links that stretch by 1 mm under the weight of a block."""
    return slide_row(scene, row_of(scene.friction.mu_slow, 1e-3, scene.g_mps2))


Law = Callable[[float], Friction]
RUNGS: tuple[tuple[str, Callable[[Scene], object], Law, bool, bool], ...] = (
    ("1 one axis", one_axis.run, coulomb, False, False),
    ("2 one axis with vertical", one_axis.run, coulomb, False, True),
    ("3 two axes with vertical", two_axes.run, coulomb, True, True),
    ("3 the same to 1e-10", partial(two_axes.run, tolerance=TIGHT), coulomb, True, True),
    ("4 friction by speed", two_axes.run, by_speed, True, True),
    ("5 row of five blocks", row, coulomb, False, True),
    ("choice of the rung and run", least_model.solve, coulomb, True, True),
)


def main() -> None:
    """Print a row for each rung: median and longest time of a scene, ratio to one axis."""
    repeats = int(sys.argv[1]) if sys.argv[1:] else 5
    triple = motion()
    works = {
        title: [
            partial(run, triple.scene(case, law(case.mu), second=second, vertical=vertical))
            for case in CASES
        ]
        for title, run, law, second, vertical in RUNGS
    }
    times: dict[str, list[list[float]]] = {title: [[] for _ in CASES] for title in works}
    for _ in range(repeats + 1):
        for title, calls in works.items():
            for call, taken in zip(calls, times[title], strict=True):
                started = time.process_time()
                call()
                taken.append(time.process_time() - started)
    print(f"{platform.machine()}, Python {platform.python_version()}, numba {numba.__version__}, "
          f"medians of {repeats}, {len(CASES)} scenes, {triple.x_mps2.size} samples")  # fmt: skip
    print(f"{'rung':30}{'median ms':>12}{'longest ms':>12}{'ratio':>9}")
    first = math.nan
    for title, taken in times.items():
        each = [statistics.median(call_times[1:]) for call_times in taken]
        middle = statistics.median(each)
        first = middle if math.isnan(first) else first
        print(f"{title:30}{1e3 * middle:12.4f}{1e3 * max(each):12.4f}{middle / first:9.1f}")


if __name__ == "__main__":
    main()
