"""Whether the choice of the model leaves out a second axis that matters, and what choosing costs.

Run from the top: .venv/bin/python tests/bench/rung_choice.py [SCENES]
Random scenes of two components, 10 to 20 s: noise, periodic and recorded shaking along the slope
(records where they are, else the example's), and across it a share of that, noise, or a push that
stays. Each is solved and run in two axes to 1e-8; wrong are scenes in which the chosen model is off
by more than the ladder allows.
"""

from __future__ import annotations

import math
import sys
import time
from collections import Counter
from functools import cache
from pathlib import Path

import numpy as np

from solver.formats.reader import read_motion_file, read_record
from solver.model import STANDARD_GRAVITY_MPS2 as G
from solver.model import Floats, Scene, SlideResult, Status, coulomb
from solver.rivals.methods import NO_RECORD
from solver.sliding import least_model, one_axis, two_axes
from solver.verification.triples import readonly

ROOT = Path(__file__).resolve().parents[2]
RECORDS = ROOT.parent / "shared" / "records"
KINDS = ("noise", "periodic", "recorded")
ACROSS = ("like it", "noise", "push")


@cache
def records() -> tuple[tuple[list[Floats], float], ...]:
    """Return recorded or made components, three to a motion, with their step."""
    motions = []
    for path in sorted(RECORDS.glob("*.V2A")):
        channels = read_motion_file(path).channels
        motions.append(([channel.a_mps2 for channel in channels], channels[0].dt_s))
    for path in sorted((ROOT / "projects" / "example" / "records").glob("*-x.csv")):
        names = (path.name.replace("-x", side) for side in ("-x", "-y", "-z"))
        sides = [read_record(path.with_name(name)) for name in names]
        motions.append(([side.a_mps2 for side in sides], sides[0].dt_s))
    return tuple(motions)


def noise(rng: np.random.Generator, n: int, dt: float) -> Floats:
    """Noise of 0.3 to 8 Hz under a bell, its peak 1."""
    freq = np.fft.rfftfreq(n, dt)
    wave = np.fft.irfft(((freq > 0.3) & (freq < 8.0)) * np.exp(6.2832j * rng.random(freq.size)), n)
    wave *= np.sin(np.pi * np.arange(n) / n)
    return wave / np.abs(wave).max()


def scene(rng: np.random.Generator) -> tuple[str, Scene]:
    """Return a scene and what it is made of."""
    kind, across = str(rng.choice(KINDS)), str(rng.choice(ACROSS))
    dt, mu = 0.01, float(rng.choice((0.2, 0.3, 0.4, 0.5, 0.7)))
    t = np.arange(int(rng.choice((1000, 2000)))) * dt
    az = NO_RECORD
    if kind == "recorded":
        sides, dt = records()[rng.integers(len(records()))]
        sides = [side[:: max(1, round(0.01 / dt))] for side in sides]
        dt *= max(1, round(0.01 / dt))
        ax, ay, az = (side / np.abs(sides[0]).max() for side in sides)
        az = 0.5 * az if rng.random() < 0.5 else NO_RECORD
        t = np.arange(ax.size) * dt
    elif kind == "noise":
        ax, ay = noise(rng, t.size, dt), noise(rng, t.size, dt)
    else:
        hz = rng.uniform(0.5, 5.0)
        ax = np.sin(2.0 * np.pi * hz * t) * np.minimum(t / 2.0, 1.0)
        ay = np.sin(2.0 * np.pi * hz * rng.choice((1.0, 0.5, 1.37)) * t + rng.uniform(0.0, 6.28))
    if across == "like it":
        ay = ax * rng.choice((-1.0, 1.0))
    elif across == "push":
        ay = np.minimum(t / rng.uniform(0.5, 5.0), 1.0)
    peak = mu * rng.uniform(1.02, 4.0) * G
    share = 10.0 ** rng.uniform(-4.0, 0.3)
    return f"{kind}, across: {across}", Scene(
        ax_mps2=readonly(ax * peak),
        ay_mps2=readonly(ay * share * mu * G),
        az_mps2=readonly(az * peak) if az.size else NO_RECORD,
        dt_s=dt,
        slope_rad=math.radians(rng.choice((0.0, 0.0, 1.0, 3.0, 7.0))),
        friction=coulomb(mu),
        scale=1.0,
        g_mps2=G,
    )


def difference(result: SlideResult, other: SlideResult) -> float:
    """Return the largest difference of PRD and excursions [m]."""
    names = ("prd_m", "down_m", "up_m", "across_m")
    return max(abs(getattr(result, name) - getattr(other, name)) for name in names)


def main() -> None:
    """Print, for each kind of scene, how many are wrong, need rung 3 and get it, and the cost."""
    scenes = int(sys.argv[1]) if sys.argv[1:] else 100_000
    count: Counter[tuple[str, str]] = Counter()
    chosen_s = always_s = worst = 0.0
    for index in range(scenes):
        kind, block = scene(np.random.default_rng([10, index]))
        started = time.perf_counter()
        solution = least_model.solve(block)
        chosen_s += time.perf_counter() - started
        if solution.rung is least_model.Rung.NO_SLIP or solution.result.status is Status.UPLIFT:
            continue
        started = time.perf_counter()
        two_axes.run(block)
        always_s += time.perf_counter() - started
        true, lesser = two_axes.run(block, 1e-8), one_axis.run(block)
        off = difference(solution.result, true)
        bound = least_model.DEFAULT.bound_m(lesser.prd_m)
        worst = max(worst, off / bound)
        for what in (kind, "all"):
            count[what, "slide"] += 1
            count[what, "wrong"] += off > bound + true.error_m + solution.result.error_m
            count[what, "need rung 3"] += difference(lesser, true) > bound
            count[what, "get rung 3"] += solution.rung is least_model.Rung.TWO_AXES
    print(f"{'scenes':34}{'slide':>8}{'wrong':>8}{'need rung 3':>13}{'get rung 3':>13}")
    for kind in sorted({kind for kind, _ in count}):
        slide, wrong = count[kind, "slide"], count[kind, "wrong"]
        need, get = (100.0 * count[kind, name] / slide for name in ("need rung 3", "get rung 3"))
        print(f"{kind:34}{slide:8}{wrong:8}{need:12.1f}%{get:12.1f}%")
    print(f"largest of what was left out, by what may be: {worst:.3f}; choice and run take "
          f"{chosen_s / always_s:.2f} of two axes always")  # fmt: skip


if __name__ == "__main__":
    main()
