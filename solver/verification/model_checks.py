"""Checks of the models against each other, closed forms and SciPy, one row for each value.

Under a roof that moves in a circle, 6 m/s2 at 1 Hz, a block with mu = 0.3 slides at
sqrt(6^2 - (0.3 g)^2) / (2 pi) = 0.832 m/s, which two axes give to 1e-9.

Returns the same rows as `checks`. Read `model_checks`.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import replace
from functools import partial

import numpy as np

from solver.forces import friction_demand
from solver.kernels import runge_kutta
from solver.model import STANDARD_GRAVITY_MPS2, Floats, Friction, Motion, Scene, Status, coulomb
from solver.records.record import read_only
from solver.rivals import by_scipy
from solver.sliding import model_selection, one_axis, two_axes
from solver.sliding.model_selection import Model, Settings
from solver.sliding.row import BlockRow, slide_row
from solver.spaces import NO_BREAK, equation
from solver.verification.checks import slip_checks
from solver.verification.evidence import Verified
from solver.verification.random_pairs import KINDS, UNBOUNDED, pair
from solver.verification.study_cases import (
    MODEL_CASES,
    TIGHT,
    faded,
    flat_scene,
    samples_of,
    scene_of,
    scenes_of,
)
from solver.verification.verification_motions import RECORDED, cut

AGREES = 1e-9
"""Tolerance where two computations agree to rounding error and the tightest tolerance."""

REFERENCE_SAMPLES = (61, 101)
"""Samples of the part of a motion that the SciPy reference integrates, quick and full."""

SCIPY_TOLERANCES = (1e-4, 1e-6, 1e-8, 1e-10)
"""Tolerances of two axes that are compared with that reference."""

PAIRS = (40, 1000)
"""Random pairs of each kind, quick and full."""


def model_checks(triples: Sequence[Motion], *, quick: bool) -> Iterator[Verified]:
    """Run the checks; the first motion, a generated one, is used where one motion is enough.

    Motions whose vertical component lifts the block in one of `MODEL_CASES` are excluded.
    """
    chosen = [triple for triple in triples if stays(triple)]
    for triple in chosen:
        yield from _one_axis(triple)
        yield from _turned(triple)
        yield _in_proportion(triple)
        yield from _friction_by_speed(triple)
        yield from _static_friction(triple)
        yield from _one_block(triple)
        yield _left_out(triple, quick=quick)
    yield from _circle()
    yield from _stop()
    yield from _choices(chosen[0])
    yield from _random_pairs(quick=quick)
    recorded = [triple for triple in chosen if triple.source == RECORDED]
    for triple in [chosen[0], *recorded][: 1 if quick else 3]:
        yield from _against_scipy(triple, REFERENCE_SAMPLES[not quick])


def stays(triple: Motion) -> bool:
    """Whether the motion's vertical component lifts the block in none of `MODEL_CASES`."""
    runs = (one_axis.run(scene) for scene in scenes_of([triple], MODEL_CASES))
    return all(run.status is not Status.UPLIFT for run in runs)


def _one_axis(triple: Motion) -> Iterator[Verified]:
    source = "Exact method, one axis with vertical"
    for case in MODEL_CASES:
        scene = scene_of(triple, case, coulomb(case.mu), second=False)
        name = f"No cross-slope component: {triple.id}, {case}"
        exact, plane = one_axis.run(scene), two_axes.run(scene, TIGHT)
        yield from slip_checks("TA-1", source, name, exact, plane, AGREES)


def _turned(triple: Motion) -> Iterator[Verified]:
    row = partial(Verified, "TA-2", "Flat roof: the displacement rotates with the motion")
    case = MODEL_CASES[0]
    flat = scene_of(triple, case, coulomb(case.mu))
    plain = two_axes.run(flat, TIGHT)
    # Only on a flat roof: on a slope, N depends on the direction of the acceleration.
    for degrees in (30.0, 137.0):
        turned = two_axes.run(_turned_by(flat, degrees), TIGHT)
        back = _turn(np.array([turned.residual_m, turned.residual_across_m]), -degrees)
        off = math.dist(back.tolist(), (plain.residual_m, plain.residual_across_m)) / plain.prd_m
        name = f"Both components rotated by {degrees:g} degrees: {triple.id}, {case}"
        yield row("PRD", "m", name, plain.prd_m, turned.prd_m, AGREES)
        yield row("Residual, rotated back: difference / PRD", "1", name, 0.0, off, AGREES)


def _in_proportion(triple: Motion) -> Verified:
    case = MODEL_CASES[0]
    scene = scene_of(triple, case, coulomb(case.mu), second=False)
    exact, line = one_axis.run(scene), two_axes.run(_turned_by(scene, 53.0), TIGHT)
    name = f"One component rotated by 53 degrees: {triple.id}, {case}"
    source = "Proportional components cause slip along one line: exact method, one axis"
    return Verified("TA-3", source, "PRD", "m", name, exact.prd_m, line.prd_m, AGREES)


def _turned_by(scene: Scene, degrees: float) -> Scene:
    across = scene.ay_mps2 if scene.ay_mps2.size else np.zeros_like(scene.ax_mps2)
    x, y = _turn(np.array([scene.ax_mps2, across]), degrees)
    return replace(scene, ax_mps2=read_only(x), ay_mps2=read_only(y))


def _turn(pair: Floats, degrees: float) -> Floats:
    sn, cs = math.sin(math.radians(degrees)), math.cos(math.radians(degrees))
    return np.array([[cs, -sn], [sn, cs]]) @ pair


def _circle() -> Iterator[Verified]:
    # In the rotating frame v is constant: A^2 = (mu g)^2 + (w v)^2.
    a, omega, mu, count, turns = 6.0, 2.0 * math.pi, 0.3, 2000, 12
    dt = 1.0 / count
    t = np.arange(turns * count + 1) * dt
    history = two_axes.run_history(
        flat_scene(a * np.cos(omega * t), a * np.sin(omega * t), dt, coulomb(mu)), TIGHT
    )
    # Linear interpolation between samples reduces the amplitude of a sine by this factor.
    a *= (math.sin(0.5 * omega * dt) / (0.5 * omega * dt)) ** 2
    speed = math.sqrt(a * a - (mu * STANDARD_GRAVITY_MPS2) ** 2) / omega
    # Half a cycle earlier the block was at the opposite point of its circular path.
    half = history.u_m.size - 1 - count // 2
    across = math.hypot(
        history.u_m[-1] - history.u_m[half], history.across_m[-1] - history.across_m[half]
    )
    name = f"Circular roof motion, 6 m/s² at 1 Hz, {equation('μ', mu)}, flat roof, after 12 cycles"
    source = "Steady state: speed √(A² − (μ g)²) / ω, radius speed / ω; 2000 samples per cycle"
    final = math.hypot(float(history.v_mps[-1]), float(history.across_mps[-1]))
    yield Verified("TA-4", source, "Speed", "m/s", name, speed, final, AGREES)
    yield Verified("TA-4", source, "Diameter", "m", name, 2.0 * speed / omega, across, AGREES)


def stopped_scene() -> Scene:
    """Return a block set sliding downslope that stops under a constant cross-slope acceleration."""
    ax, ay = np.zeros(201), np.full(201, -2.0)
    ax[1:6] = -9.0
    return flat_scene(ax, ay, 0.01, coulomb(0.4))


def _stop() -> Iterator[Verified]:
    scene = stopped_scene()
    history = two_axes.run_history(scene, TIGHT)
    # From sample 6 the drive is constant; the velocity there is taken from the run.
    start, push, c = 6, 2.0, 0.4 * STANDARD_GRAVITY_MPS2
    vx, vy = float(history.v_mps[start]), float(history.across_mps[start])
    w, along = math.hypot(vx, vy), push * vy
    decay = c * c - push * push
    stop = (c * w + along) / decay
    ahead = (w * w + (2.0 * c * w * along + along * along) / push**2) / (4.0 * decay) * push
    aside = -push * vx * (2.0 * c * w + along) / (push * (4.0 * c * c - push * push))
    name = "Sliding block stops under a transverse acceleration of 2 m/s², "
    name += f"{equation('μ', 0.4)}, flat roof"
    source = (
        "(v (μ N + G cos ψ))' = G² − (μ N)², ψ = angle from drive G to v, and similar forms "
        "for displacement, from 0.06 s"
    )
    stop_s = history.events[-1].t_s - start * scene.dt_s
    across_m = float(history.across_m[-1] - history.across_m[start])
    along_m = float(history.u_m[-1] - history.u_m[start])
    for quantity, unit, known, computed in (
        ("Time to stop", "s", stop, stop_s),
        ("Transverse displacement", "m", ahead, across_m),
        ("Longitudinal displacement", "m", -aside, along_m),
    ):
        yield Verified("TA-5", source, quantity, unit, name, known, computed, AGREES)


def _friction_by_speed(triple: Motion) -> Iterator[Verified]:
    source = "Converges to two axes with one coefficient: within 50 times the difference"
    case = MODEL_CASES[1]
    plain = two_axes.run(scene_of(triple, case, coulomb(case.mu)), TIGHT)
    for drop in (1e-4, 1e-5, 1e-6):
        slow = case.mu * (1.0 - drop)
        law = Friction(mu_slow=slow, mu_fast=case.mu, rate_s_per_m=30.0, mu_static=slow)
        run = two_axes.run(scene_of(triple, case, law), TIGHT)
        name = f"Low-velocity friction lower by {100.0 * drop:.4g}%: {triple.id}, {case}"
        yield Verified("TA-6", source, "PRD", "m", name, plain.prd_m, run.prd_m, 50.0 * drop)


def _static_friction(triple: Motion) -> Iterator[Verified]:
    # A delay of the onset of slip changes the velocity by its square.
    case = MODEL_CASES[1]
    both = scene_of(triple, case, coulomb(case.mu))
    alone = scene_of(triple, case, coulomb(case.mu), second=False)
    prd_alone_m, prd_both_m = one_axis.run(alone).prd_m, two_axes.run(both, TIGHT).prd_m
    for excess in (1e-2, 1e-3, 1e-4):
        law = replace(both.friction, mu_static=(1.0 + excess) * case.mu)
        for id, scene, axes, kinetic_m, method in (
            ("TA-7", alone, "one axis", prd_alone_m, "the exact method with vertical"),
            ("TA-8", both, "two axes", prd_both_m, "two axes with one coefficient"),
        ):
            source = f"Converges to {method}: within 50 times the square of the difference"
            name = f"Static friction {100.0 * excess:g}% above kinetic, {axes}: {triple.id}, "
            found_m = two_axes.run(replace(scene, friction=law), TIGHT).prd_m
            tolerance = 50.0 * excess**2
            yield Verified(id, source, "PRD", "m", f"{name}{case}", kinetic_m, found_m, tolerance)


def _one_block(triple: Motion) -> Iterator[Verified]:
    # Rows that move as one block: one block, and three identical ones with unloaded links.
    source = "Exact method, one axis with vertical: the links carry no force"
    row = partial(Verified, "TA-9", source, "PRD, largest of the blocks", "m")
    case = MODEL_CASES[1]
    scene = scene_of(triple, case, coulomb(case.mu), second=False)
    exact = one_axis.run(scene)
    for count in (1, 3):
        blocks = slide_row(scene, BlockRow(mus=(case.mu,) * count, stiffness_per_s2=1e4))
        name = f"Row of identical blocks, {count} in all: {triple.id}, {case}"
        yield row(name, exact.prd_m, max(blocks.prd_m), AGREES)


def _left_out(triple: Motion, *, quick: bool) -> Verified:
    # Counts scenes in which the neglected component matters more than the stated estimate.
    over = count = 0
    for share in (0.3, 0.1, 0.03, 0.01, 0.003):
        for case in MODEL_CASES[:2] if quick else MODEL_CASES:
            full = scene_of(triple, case, coulomb(case.mu))
            scene = faded(full, share)
            choice = model_selection.solve(scene)
            change = abs(two_axes.run(scene, TIGHT).prd_m - choice.result.prd_m)
            stated_m = 0.0 if choice.model is Model.TWO_AXES else choice.next_effect_m
            # Not >: a run without a displacement (NaN) counts as well.
            over += not change <= stated_m + choice.result.error_m
            count += 1
    name = f"Effect of the neglected component: {triple.id}, {count} cases"
    source = "Two axes with vertical, second component times 0.3, 0.1, 0.03, 0.01 and 0.003"
    exceeding = "Cases that exceed the stated effect"
    return Verified("TA-10", source, exceeding, "1", name, 0.0, float(over), 0.0)


def _random_pairs(*, quick: bool) -> Iterator[Verified]:
    source = "Both runs of a pair have a result, and they agree within the sum of their error "
    row = partial(Verified, "TA-11", f"{source}bounds", "Failed pairs", "1")
    # False is 0 and True is 1, so this is the first number if quick.
    count = PAIRS[not quick]
    for kind in KINDS:
        if kind not in UNBOUNDED:
            failed = sum(not _agrees(kind, index) for index in range(count))
            yield row(f"{count} random pairs, {kind}", 0.0, float(failed), 0.0)


def _agrees(kind: str, index: int) -> bool:
    try:
        return pair(kind, index).run().ratio <= 1.0
    except ArithmeticError:
        return False


def _choices(triple: Motion) -> Iterator[Verified]:
    source = "Number of the simplest sufficient model (section 12)"
    case = MODEL_CASES[1]
    full = scene_of(triple, case, coulomb(case.mu))
    peak = friction_demand(full)
    law = Friction(mu_slow=0.3, mu_fast=0.4, rate_s_per_m=30.0, mu_static=0.3)
    faint = faded(full, 1e-4)
    level = replace(faint, az_mps2=read_only(1e-5 * full.az_mps2))
    for claim, scene, model in (
        ("Friction above the demand", replace(full, friction=coulomb(1.001 * peak)), Model.NO_SLIP),
        ("Second and vertical components negligible", level, Model.ONE_AXIS),
        ("Second component negligible", faint, Model.ONE_AXIS_VERTICAL),
        ("Three components", full, Model.TWO_AXES),
        ("Velocity-dependent friction", replace(full, friction=law), Model.SPEED_FRICTION),
    ):
        name = f"{claim}: {triple.id}, {case.slope_deg:g}°, {equation('PPA', case.ppa_g, 'g')}"
        chosen = float(model_selection.solve(scene, Settings()).model)
        yield Verified("TA-12", source, "Model chosen", "1", name, float(model), chosen, 0.0)


def _against_scipy(triple: Motion, samples: int) -> Iterator[Verified]:
    source = "SciPy DOP853, relative tolerance 10⁻¹², restarted at every sample and event"
    row = partial(Verified, "TA-13", source, "Position error / PRD", "1")
    case, part = MODEL_CASES[1], cut(triple, samples)
    scene = scene_of(part, case, coulomb(case.mu))
    names = {
        t: f"Tolerance of 1{NO_BREAK}/{NO_BREAK}{1.0 / t:,.0f}: {part.id}, {case}"
        for t in SCIPY_TOLERANCES
    }
    compiled = {
        order: f"{solver}, compiled, relative tolerance 10⁻⁹: {part.id}, {case}"
        for solver, order in (("DOP853", 8), ("RK45", 5))
    }
    if not by_scipy.is_installed():
        for name in (*names.values(), *compiled.values()):
            yield row(name, 0.0, math.nan, is_run=False)
        return
    s, y, _, _ = by_scipy.plane(samples_of(scene), scene.dt_s)
    x = math.cos(scene.slope_rad) * s
    for tolerance, name in names.items():
        history = two_axes.run_history(scene, tolerance)
        off = float(np.hypot(history.u_m - x, history.across_m - y).max()) / history.result.prd_m
        yield row(name, 0.0, off, tolerance)
    rows, cosine = samples_of(scene), math.cos(scene.slope_rad)
    for order, name in compiled.items():
        prd, *end, _ = runge_kutta.slide_plane(rows, scene.dt_s, cosine, order, 1e-9)
        # Ten times their tolerance, which applies to the error of a step, not of the run.
        yield row(name, 0.0, math.dist(end, (x[-1], y[-1])) / prd, 1e-8)
