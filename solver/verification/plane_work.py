"""Two axes: accuracy against run time, and the behavior of each method after a block has stopped.

Compared with fixed steps (`solver.kernels.fixed_steps`) and, if installed, SciPy. Read `work`,
then `stops`.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from functools import partial

from solver.kernels import fixed_steps
from solver.model import Scene, coulomb
from solver.sliding import two_axes
from solver.verification import plane_scipy
from solver.verification.model_checks import stopped_scene
from solver.verification.model_evidence import PlaneWork, StopPoint
from solver.verification.plane_scipy import Solver, samples_of
from solver.verification.study import MODEL_CASES, TIGHT, clocked, minimum_seconds
from solver.verification.triples import Triple

OURS = "Power series, event by event"
HOLDING = "Fixed steps, stick at velocity reversal"
CHATTERING = "Fixed steps, no stick"

CASE = MODEL_CASES[1]
SAMPLES = (101, 151)
"""Samples of the part of a motion, quick and full: SciPy takes a second per run."""

TOLERANCES = (1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9)
SUBSTEPS = (1, 4, 16, 64, 256, 1024)

SCIPY: tuple[tuple[Solver, float, tuple[float, ...]], ...] = (
    ("RK45", 1e-2, (1e-3, 1e-4, 1e-5, 1e-6)),
    ("RK45", 1e-3, (1e-3, 1e-4, 1e-5, 1e-6)),
    ("DOP853", 1e-3, (1e-3, 1e-4, 1e-5, 1e-6)),
    ("Radau", 1e-3, (1e-3, 1e-4, 1e-5)),
    ("Radau", 1e-4, (1e-4, 1e-5)),
)
"""Solver, v0 [m/s] of the friction mu N tanh(w / v0), relative tolerances."""


def work(triple: Triple, *, quick: bool) -> tuple[str, tuple[PlaneWork, ...]]:
    """Return the scene in words, and every method with each of its settings on it."""
    part = triple.cut(SAMPLES[not quick])
    scene = part.scene(CASE, coulomb(CASE.mu))
    exact = two_axes.run(scene, TIGHT)
    points = (*_ours(scene), *_fixed(scene, exact.prd_m), *_scipy(scene, exact.prd_m, quick))
    return f"{part.name}, {CASE}", tuple(points)


def _ours(scene: Scene) -> Iterator[PlaneWork]:
    """The error is the largest at the samples: that of the PRD may be zero by chance."""
    truth = two_axes.run_history(scene, TIGHT)
    for tolerance in TOLERANCES:
        outcome = two_axes.follow(scene, tolerance)
        seen = two_axes.run_history(scene, tolerance)
        off = max(
            abs(outcome.prd_m - truth.result.prd_m),
            float(abs(seen.u_m - truth.u_m).max()),
            float(abs(seen.across_m - truth.across_m).max()),
        )
        yield PlaneWork(
            method=OURS,
            setting=f"tol. {tolerance:g}",
            seconds=minimum_seconds(partial(two_axes.follow, scene, tolerance)),
            steps=outcome.n_steps,
            error_percent=100.0 * off / truth.result.prd_m,
        )


def _fixed(scene: Scene, prd_m: float) -> Iterator[PlaneWork]:
    rows, cs = samples_of(scene), math.cos(scene.slope_rad)
    for method, holds in ((HOLDING, True), (CHATTERING, False)):
        for substeps in SUBSTEPS:
            run = partial(fixed_steps.slide_fixed, rows, scene.dt_s, cs, substeps, holds)
            end_prd_m = run()[0]  # before timing: the first call compiles
            yield PlaneWork(
                method=method,
                setting=f"P = {substeps}",
                seconds=minimum_seconds(run),
                steps=substeps * (len(rows) - 1),
                error_percent=100.0 * abs(end_prd_m - prd_m) / prd_m,
            )


def _scipy(scene: Scene, prd_m: float, quick: bool) -> Iterator[PlaneWork]:
    if not plane_scipy.is_installed():
        return
    for solver, velocity_mps, tolerances in SCIPY[:3] if quick else SCIPY:
        for tolerance in tolerances[:2] if quick else tolerances:
            outcome, seconds = clocked(
                partial(plane_scipy.regularized, scene, solver, velocity_mps, tolerance)
            )
            yield PlaneWork(
                method=f"SciPy {solver}, v0 = {1e3 * velocity_mps:g} mm/s",
                setting=f"tol. {tolerance:g}",
                seconds=seconds if outcome.followed else math.nan,
                steps=outcome.evaluations,
                error_percent=100.0 * abs(outcome.prd_m - prd_m) / prd_m,
            )


def stops() -> Iterator[StopPoint]:
    """Run the block that stops under a transverse acceleration and rests for 1.8 s, every method.

    Its position is known in closed form, see `model_checks.stopped_scene` and its checks.
    """
    scene = stopped_scene()
    truth = two_axes.run(scene, TIGHT)
    place = truth.residual_m, truth.residual_across_m
    for tolerance in (1e-4, 1e-6):
        ours = two_axes.follow(scene, tolerance)
        yield StopPoint(
            method=OURS,
            setting=f"tol. {tolerance:g}",
            steps=ours.n_steps,
            error_m=math.dist(ours.end_m, place),
            end_speed_mps=math.hypot(*ours.end_mps),
        )
    rows = samples_of(scene)
    for method, holds in ((HOLDING, True), (CHATTERING, False)):
        for substeps in (10, 100, 1000):
            _, x, y, speed = fixed_steps.slide_fixed(rows, scene.dt_s, 1.0, substeps, holds)
            yield StopPoint(
                method=method,
                setting=f"{1e3 * scene.dt_s / substeps:g} ms",
                steps=substeps * (len(rows) - 1),
                error_m=math.dist((x, y), place),
                end_speed_mps=speed,
            )
    if plane_scipy.is_installed():
        yield from _scipy_stops(scene, place)


def _scipy_stops(scene: Scene, place: tuple[float, float]) -> Iterator[StopPoint]:
    runs: tuple[tuple[Solver, float, float], ...] = (
        ("RK45", 1e-2, 1e-4),
        ("RK45", 1e-3, 1e-6),
        ("Radau", 1e-3, 1e-6),
        ("Radau", 1e-5, 1e-6),
        ("DOP853", 0.0, 1e-6),
    )
    for solver, velocity_mps, tolerance in runs:
        outcome = plane_scipy.regularized(scene, solver, velocity_mps, tolerance)
        friction = f"v0 = {1e3 * velocity_mps:g} mm/s" if velocity_mps else "Coulomb, no events"
        yield StopPoint(
            method=f"SciPy {solver}, {friction}",
            setting=f"tol. {tolerance:g}",
            steps=outcome.evaluations,
            error_m=math.dist(outcome.end_m, place),
            end_speed_mps=outcome.end_speed_mps,
        )
