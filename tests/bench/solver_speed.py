"""Claim: an exact run costs about as much as one pass over its record; each model, some more.

Ratios measured side by side in one run, medians of repeats in turns, processor time, one core. Over
the grid of the paper (29 slopes x 15 frictions x 16 PPA) the mean time of a run is held against one
streaming pass over the record (the sum of its samples, jitted) and against the paper's algorithm at
P = 64 over every 97th of these runs, jitted too: "optimized", as `method="paper"` runs it, with
sub-steps in slip only (`method="adaptive"`), and "as listed", equation by equation. A call from
Python is that of `solver.slide`. Records: the example's, and 18 real ones of pyslammer.
"""

import itertools
import math
import statistics
from collections.abc import Callable, Sequence
from functools import partial

import numpy as np
from measure import SMOKE, figure, made_records, seconds
from numba import njit

from peers import real_records
from solver.formats import read_record
from solver.kernels import one_axis, rivals
from solver.model import STANDARD_GRAVITY_MPS2 as G
from solver.model import Floats, Friction, Scene, coulomb
from solver.records.record import NO_RECORD, Record
from solver.sliding import model_selection, two_axes
from solver.sliding import one_axis as one_axis_run
from solver.sliding.checked import slide
from solver.sliding.row import slide_row
from solver.studies.sweep import order_alike
from solver.verification.model_study import by_speed, row_of
from solver.verification.study_cases import Case, scene_of
from solver.verification.verification_motions import own_triples

SLOPES = [math.radians(0.5 * k) for k in range(-14, 15)]
FRICTIONS = [0.1 + 0.05 * k for k in range(15)]
GRID = np.array(list(itertools.product(SLOPES, FRICTIONS, [0.1 * k for k in range(16)])))
GRID = GRID[order_alike(GRID)]  # as `sweep` runs them
NO_HISTORY = np.empty((2, 0))
SUBSTEPS = 64
REPEATS = 1 if SMOKE else 5
PASSES = 500
CASES = [Case(*c) for c in itertools.product((0.0, 2.0, 5.0), (0.3, 0.4, 0.5, 0.6), (1.0, 1.5))]


@njit
def total(a: Floats) -> float:
    """Sum of the samples: one streaming pass."""
    summed = 0.0
    for value in a:
        summed += value
    return summed


@njit
def run_exact(ax: Floats, x: Floats, dt: float, peak: float, grid: Floats) -> float:
    """Run every row of the grid; the sum of the PRDs keeps the work from being optimized away."""
    sum_m = 0.0
    for k in range(grid.shape[0]):
        sn, cs, scale = math.sin(grid[k, 0]), math.cos(grid[k, 0]), grid[k, 2] * G / peak
        n_min, _ = one_axis.minimum_normal(ax, None, x, None, dt, sn, cs, G, scale)
        out = one_axis.slide_exact(ax, None, x, None, dt, sn, cs, grid[k, 1], G, scale, None)
        sum_m += max(out[0], -out[1]) + min(n_min, 0.0)
    return sum_m


@njit
def paper_as_listed(
    ax: Floats, dt: float, theta: float, mu: float, g: float, scale: float, substeps: int
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


def run_listed(ax: Floats, dt: float, peak: float, grid: Floats) -> Floats:
    """PRD of every row of the grid by the paper's algorithm as it is listed."""
    return np.array(
        [paper_as_listed(ax, dt, slope, mu, G, ppa * G / peak, SUBSTEPS) for slope, mu, ppa in grid]
    )


def run_fast(ax: Floats, dt: float, peak: float, grid: Floats, *, skips: bool = False) -> Floats:
    """PRD of every row of the grid by the paper's algorithm as fast as it goes."""
    prd_m = np.empty(len(grid))
    for k, (slope, mu, ppa) in enumerate(grid):
        sn, cs, scale = math.sin(slope), math.cos(slope), ppa * G / peak
        scene = ax, NO_RECORD, dt, sn, cs, mu, G, scale
        _, s_max, s_min, *_ = rivals.slide_constant(*scene, SUBSTEPS, skips, NO_HISTORY)
        prd_m[k] = cs * max(s_max, -s_min)
    return prd_m


def run_checked(record: Record, peak: float, grid: Floats) -> None:
    """Call every row of the grid as a user does, with the checks of its arguments."""
    for slope, mu, ppa in grid:
        slide(record, slope_rad=slope, mu=mu, scale=ppa * G / peak)


def of_a_run(record: Record) -> list[float]:
    """Return the time of a run [s]: exact, one pass, the paper optimized, sub-stepping in slip
    only, and as listed, and a call from Python.
    """
    ax, dt = record.a_mps2, record.dt_s
    x, peak, few = one_axis.bounds(ax), float(np.abs(ax).max()), GRID[::97]
    listed, fast = run_listed(ax, dt, peak, few), run_fast(ax, dt, peak, few)
    np.testing.assert_allclose(fast, listed, rtol=1e-9, atol=1e-9)
    exact, passes, *others = seconds(
        lambda: run_exact(ax, x, dt, peak, GRID),
        lambda: [total(ax) for _ in range(PASSES)],
        lambda: run_fast(ax, dt, peak, few),
        lambda: run_fast(ax, dt, peak, few, skips=True),
        lambda: run_listed(ax, dt, peak, few),
        lambda: run_checked(record, peak, few),
        repeats=REPEATS,
    )
    return [exact / len(GRID), passes / PASSES, *(other / len(few) for other in others)]


def runs(kind: str, records: Sequence[Record]) -> None:
    """Print the geometric means over records."""
    logs = []
    for record in records[: 1 if SMOKE else None]:
        times = of_a_run(record)
        print(f"{record.name:32}", *(f"{each * 1e6:10.3g}" for each in times), flush=True)
        logs.append(np.log(times))
    exact, passed, fast, skipping, listed, call = np.exp(np.mean(logs, axis=0)).tolist()
    figure(f"exact run, {kind} records", exact * 1e6, "us")
    figure(f"the same called from Python, with argument checks, {kind} records", call * 1e6, "us")
    figure(f"exact run, relative to one pass over its record, {kind} records", exact / passed)
    figure(
        f"the paper's algorithm, optimized, relative to an exact run, {kind} records", fast / exact
    )
    figure(f"the same with sub-steps during slip only, {kind} records", skipping / exact)
    figure(f"the same as the paper lists it, {kind} records", listed / exact)


@njit
def repeat(ax: Floats, x: Floats, dt: float, sn: float, mu: float, times: int) -> tuple[float, int]:
    """Run one scene many times; the sum keeps the work from being optimized away."""
    sum_m, stops, cs = 0.0, 0, math.sqrt(1.0 - sn * sn)
    for _ in range(times):
        out = one_axis.slide_exact(ax, None, x, None, dt, sn, cs, mu, G, 1.0, None)
        sum_m += out[0] - out[1]
        stops = out[5]
    return sum_m, stops


def nanoseconds(ax: Floats, sn: float, mu: float) -> float:
    """Median time of a run [ns]."""
    ax.setflags(write=False)
    (taken,) = seconds(
        lambda: repeat(ax, one_axis.bounds(ax), 0.005, sn, mu, 200), repeats=3 * REPEATS
    )
    return taken / 200 * 1e9


def parts() -> None:
    """Print the cost of each part of an exact run, from scenes that differ in one thing alone."""
    short, long = (nanoseconds(np.zeros(n), 0.05, 0.4) for n in (2_000, 200_000))
    figure("one sample at rest (blocks of samples are skipped)", (long - short) / 198_000, "ns")
    short, long = (nanoseconds(np.zeros(n), 0.2, 0.1) for n in (2_000, 20_000))
    figure("one sample while sliding", (long - short) / 18_000, "ns")
    noise = np.random.default_rng(1).normal(0.0, 6.0, 20_000)
    taken = nanoseconds(noise, 0.0, 0.5)
    _, stops = repeat(noise, one_axis.bounds(noise), 0.005, 0.0, 0.5, 1)
    figure("one slip with its stop", taken / stops, "ns")


def row(scene: Scene) -> object:
    """Slide five blocks with links that stretch by 1 mm under the weight of a block."""
    return slide_row(scene, row_of(scene.friction.mu_slow, 1e-3, scene.g_mps2))


Model = tuple[Callable[[Scene], object], Callable[[float], Friction], bool, bool]
MODELS: dict[str, Model] = {
    "one axis": (one_axis_run.run, coulomb, False, False),
    "one axis with vertical": (one_axis_run.run, coulomb, False, True),
    "two axes with vertical, to 1e-6": (two_axes.run, coulomb, True, True),
    "the same to 1e-10": (partial(two_axes.run, tolerance=1e-10), coulomb, True, True),
    "velocity-dependent friction": (two_axes.run, by_speed, True, True),
    "row of five linked blocks": (row, coulomb, False, True),
    "model selection and run": (model_selection.solve, coulomb, True, True),
}


def models() -> None:
    """Print the median time of each model over cases of one made motion, by that of one axis."""
    triple = own_triples(quick=True)[0]
    times = []
    for run, law, second, vertical in MODELS.values():
        scenes = [scene_of(triple, c, law(c.mu), second=second, vertical=vertical) for c in CASES]
        times.append([partial(run, scene) for scene in scenes[: 2 if SMOKE else None]])
    taken = [statistics.median(seconds(*calls, repeats=REPEATS)) for calls in times]
    figure("samples of the motion used to compare the models", triple.ax_mps2.size)
    figure("one axis, median of 24 cases", taken[0] * 1e3, "ms")
    for name, one in zip([*MODELS][1:], taken[1:], strict=True):
        figure(f"{name}, relative to one axis", one / taken[0], "times")


if __name__ == "__main__":
    runs("generated", [read_record(path, units="g") for path in made_records()])
    runs("real", real_records())
    parts()
    models()
