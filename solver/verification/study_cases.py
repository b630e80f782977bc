"""The cases of the studies, how they are run, and how their times and misfits are measured.

A study chooses its variants and counts the results. Read `grid`, `scenes_of`, `processor_seconds`.
"""

from __future__ import annotations

import itertools
import math
import sys
import time
from collections.abc import Callable, Iterable, Sequence
from dataclasses import replace
from functools import partial
from itertools import product
from typing import NamedTuple, TypeVar

import numpy as np

from solver.forces import forces
from solver.model import (
    STANDARD_GRAVITY_MPS2,
    Floats,
    Friction,
    HorizontalComponent,
    Motion,
    Orientation,
    Scene,
    SlideHistory,
    SlideResult,
    coulomb,
)
from solver.records.record import NO_RECORD, Record, read_only
from solver.rivals import by_scipy
from solver.rivals.methods import METHODS
from solver.sliding import checked, one_axis, two_axes
from solver.sliding.method import AxisScene, Method
from solver.spaces import equation, with_minus
from solver.verification.verification_motions import own_records, scale_to, triple_scale


class Case(NamedTuple):
    """A block on a slope and the peak acceleration of its record."""

    slope_deg: float
    mu: float
    ppa_g: float

    @property
    def slope_rad(self) -> float:
        """Slope in radians."""
        return math.radians(self.slope_deg)

    def __str__(self) -> str:
        block = f"{with_minus(self.slope_deg)}°, {equation('μ', self.mu)}"
        return f"{block}, {equation('PPA', self.ppa_g, 'g')}"


# From small to large slip, with both signs of the slope; quick runs take the first ones.
CASES = (
    Case(0.0, 0.3, 1.0),
    Case(4.0, 0.4, 1.0),
    Case(-4.0, 0.2, 0.5),
    Case(7.0, 0.6, 1.5),
    Case(2.0, 0.1, 0.5),
    Case(-2.0, 0.5, 1.5),
)


def runnable_methods() -> list[Method]:
    """Return the methods, without those of SciPy where it is not installed."""
    scipy = by_scipy.is_installed()
    # The source of a method that runs by SciPy begins with the name of its function.
    return [m for m in METHODS.values() if scipy or not m.source.startswith("scipy")]


def compared_runs(quick: bool) -> list[tuple[Record, Case]]:
    """Return the runs on which methods are compared: the project's records with every case."""
    return list(itertools.product(own_records(quick), CASES[:3] if quick else CASES))


AS_RECORDED = Orientation(component=HorizontalComponent.RECORD, polarity=1)


def scene_of(
    triple: Motion,
    case: Case,
    friction: Friction,
    orientation: Orientation = AS_RECORDED,
    *,
    second: bool = True,
    vertical: bool = True,
) -> Scene:
    """Return a case of a motion with all components, or without the second or vertical."""
    scene = triple.scene(orientation, slope_rad=case.slope_rad, friction=friction)
    return replace(
        scene,
        ay_mps2=scene.ay_mps2 if second else NO_RECORD,
        az_mps2=scene.az_mps2 if vertical else NO_RECORD,
        scale=triple_scale(triple, case.ppa_g),
    )


T = TypeVar("T")

TIGHT = 1e-10
"""Tightest tolerance of two axes."""

MODEL_CASES = (Case(0.0, 0.3, 1.0), Case(2.0, 0.4, 1.0), Case(5.0, 0.5, 1.5))
"""Cases on which the models are checked and timed."""
REPEATS = 5

ENOUGH_S = 0.02
"""Repeats end after this number, or after this time [s]."""

BATCH_S = 1e-3
"""Time that short runs are repeated for between two readings of the clock [s]."""

# Windows counts processor time in ticks of 16 ms: a short run would take none.
CLOCK = time.perf_counter if sys.platform == "win32" else time.process_time
"""The clock of runs [s]."""


def grid(
    slopes_deg: Iterable[float], mus: Iterable[float], ppas_g: Iterable[float]
) -> tuple[Case, ...]:
    """Return all combinations, the PPA varying fastest."""
    return tuple(itertools.starmap(Case, itertools.product(slopes_deg, mus, ppas_g)))


def scenes_of(
    triples: Iterable[Motion],
    cases: Sequence[Case],
    orientations: Sequence[Orientation] = (AS_RECORDED,),
) -> list[Scene]:
    """Return every case of every motion, with all components and one friction coefficient."""
    return [
        scene_of(triple, case, coulomb(case.mu), orientation)
        for triple, orientation, case in product(triples, orientations, cases)
    ]


def flat_scene(ax_mps2: Floats, ay_mps2: Floats, dt_s: float, friction: Friction) -> Scene:
    """Return a block on a flat roof under given horizontal accelerations of n samples each."""
    return Scene(
        ax_mps2=read_only(ax_mps2),
        ay_mps2=read_only(ay_mps2),
        az_mps2=NO_RECORD,
        dt_s=dt_s,
        slope_rad=0.0,
        friction=friction,
        scale=1.0,
        g_mps2=STANDARD_GRAVITY_MPS2,
    )


def samples_of(scene: Scene) -> Floats:
    """Return downslope G, cross-slope G and mu N at the samples, shape (n, 3) [m/s2]."""
    forces_on = forces(scene)
    cap = scene.friction.mu_slow * forces_on.normal_mps2
    return np.column_stack([forces_on.down_mps2, forces_on.across_mps2, cap])


def faded(scene: Scene, share: float) -> Scene:
    """Return the scene with its second component multiplied by `share`; 0 removes it."""
    across = read_only(share * scene.ay_mps2) if share else NO_RECORD
    return replace(scene, ay_mps2=across)


def plane_prds(
    scenes: Iterable[Scene],
    law: Callable[[float], Friction],
    tolerance: float = two_axes.DEFAULT_TOLERANCE,
) -> Floats:
    """Return the PRD of every scene in two axes, with the law of its own low-velocity friction [m].

    NaN where the normal force vanishes.
    """
    laws = ((scene, law(scene.friction.mu_slow)) for scene in scenes)
    runs = (two_axes.run(replace(scene, friction=friction), tolerance) for scene, friction in laws)
    return np.array([run.prd_m for run in runs])


def run(record: Record, case: Case, method: str = "exact", **parameters: float) -> SlideResult:
    """Run one case of a record by a method."""
    return posed(checked.slide, record, case)(method=method, **parameters)


def history(record: Record, case: Case, method: str, **parameters: float) -> SlideHistory:
    """Return the motion of that run at the samples."""
    return posed(checked.slide_history, record, case)(method=method, **parameters)


def posed(solve: Callable[..., T], record: Record, case: Case) -> partial[T]:
    """Return a callable that solves one case of a record."""
    scale = scale_to(record, case.ppa_g)
    place = {"slope_rad": case.slope_rad, "mu": case.mu, "scale": scale}
    return partial(solve, record.a_mps2, record.dt_s, **place)


def prepared(record: Record, case: Case) -> AxisScene:
    """Return the input of `Method.follow`, so that only the method is timed."""
    # `checked.scene` checks the arguments and scales; this is not part of the time of a method.
    return one_axis.prepared(posed(checked.scene, record, case)())


def clocked(
    work: Callable[[], T], clock: Callable[[], float] = time.perf_counter
) -> tuple[T, float]:
    """Return the result and the time it took [s]."""
    start = clock()
    result = work()
    return result, clock() - start


def processor_seconds(work: Callable[[], object]) -> float:
    """Return the processor time of a run, the least of several repeats, fewer if they are long [s].

    Excludes the time of other programs during a long run, and includes all threads.
    """
    _, once_s = clocked(work, CLOCK)
    # A short run many times: reading the clock takes about as long as one.
    # The microsecond avoids division by zero if the clock has not advanced.
    count = 1 + int(BATCH_S / (once_s + 1e-6))

    def batch() -> None:
        for _ in range(count):
            work()

    if once_s > ENOUGH_S:
        return once_s
    return min(clocked(batch, CLOCK)[1] for _ in range(REPEATS)) / count


def unexplained(computed: Floats, recorded: Floats) -> float:
    """Return the sum of squares of the difference over that of the recorded motions."""
    return float(((computed - recorded) ** 2).sum() / (recorded**2).sum())


def best_of(misfit: Callable[[T], float], points: Iterable[T]) -> tuple[float, T]:
    """Return the least misfit and its point, the first of equal ones."""
    return min(((misfit(point), point) for point in points), key=lambda pair: pair[0])
