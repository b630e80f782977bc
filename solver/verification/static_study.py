"""Static friction above kinetic: limits of a small difference and of a small second component.

Compared in one axis with the exact method, in two with one coefficient. Read `static_evidence`.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import replace

import numpy as np

from solver.model import STANDARD_GRAVITY_MPS2, Floats, Friction, Scene
from solver.rivals.methods import NO_RECORD
from solver.sliding import one_axis, two_axes
from solver.verification.rung_evidence import (
    LEAST_M,
    FadingAxis,
    PushedPoint,
    StaticDifference,
    StaticEvidence,
)
from solver.verification.rungs import TIGHT
from solver.verification.triples import readonly

EXCESSES = (0.3, 0.1, 1e-2, 1e-3, 1e-4)
"""Static over kinetic friction, less 1."""

FADING = (1e-1, 1e-2, 1e-4)
"""Factors of the second component."""

ACROSS_MPS2 = (0.0, 1e-9, 1e-6, 0.1)
"""Transverse accelerations of the block that is driven back [m/s2]."""

PUSHED_BACK_G = 0.45
"""Acceleration that drives it back [g], between kinetic and static friction."""

PUSHED_TOLERANCE = 1e-8
"""Tolerance of its runs: above the least transverse accelerations, so that the change shows."""


def held(mu: float, ratio: float) -> Friction:
    """Return friction whose static coefficient is `ratio` times the kinetic one."""
    return Friction(mu_slow=mu, mu_fast=mu, rate_s_per_m=0.0, mu_static=ratio * mu)


JUMPING = held(0.4, 1.25)
"""Friction of that block."""

FALLING = replace(JUMPING, mu_slow=JUMPING.mu_static, rate_s_per_m=100.0)
"""The same friction, falling from static to kinetic gradually with velocity."""


def static_evidence(scenes: Sequence[Scene], ratio: float) -> StaticEvidence:
    """Run scenes with their coefficient as kinetic friction; scenes with little slip are excluded.

    Parameters
    ----------
    scenes : sequence of Scene
        Of three components.
    ratio : float
        Static over kinetic friction where the second component decreases.
    """
    alone = [(scene, one_axis.run(scene).prd_m) for scene in scenes]
    slid = [(scene, prd_m) for scene, prd_m in alone if prd_m >= LEAST_M]
    return StaticEvidence(
        n_scenes=len(slid),
        ratio=ratio,
        differences=tuple(_differences(slid)),
        fading=tuple(_fading(slid, ratio)),
        pushed=tuple(_pushed()),
    )


def _differences(slid: Sequence[tuple[Scene, float]]) -> Iterator[StaticDifference]:
    plain = [_prd(scene) for scene, _ in slid]
    for excess in EXCESSES:
        laws = [held(scene.friction.mu_slow, 1.0 + excess) for scene, _ in slid]
        pairs = list(zip(slid, laws, strict=True))
        one = [_prd(_faded(scene, 0.0), law) / prd_m for (scene, prd_m), law in pairs]
        two = [_prd(scene, law) for (scene, _), law in pairs]
        yield StaticDifference(
            excess=excess,
            one_axis=_changes(one),
            two_axes=_changes([fuller / prd_m for fuller, prd_m in zip(two, plain, strict=True)]),
        )


def _fading(slid: Sequence[tuple[Scene, float]], ratio: float) -> Iterator[FadingAxis]:
    laws = [held(scene.friction.mu_slow, ratio) for scene, _ in slid]
    bases = [_prd(_faded(scene, 0.0), law) for (scene, _), law in zip(slid, laws, strict=True)]
    for share in FADING:
        faded = [_faded(scene, share) for scene, _ in slid]
        plain = [_prd(scene) / prd_m for scene, (_, prd_m) in zip(faded, slid, strict=True)]
        runs = zip(faded, laws, bases, strict=True)
        yield FadingAxis(
            share=share,
            one_coefficient=_changes(plain),
            static_above=_changes([_prd(scene, law) / base for scene, law, base in runs]),
        )


def _prd(scene: Scene, law: Friction | None = None) -> float:
    run = scene if law is None else replace(scene, friction=law)
    return two_axes.run(run, TIGHT).prd_m


def _faded(scene: Scene, share: float) -> Scene:
    across = readonly(share * scene.ay_mps2) if share else NO_RECORD
    return replace(scene, ay_mps2=across)


def _changes(ratios: Sequence[float]) -> Floats:
    return np.sort(np.abs(np.array(ratios) - 1.0))


def pushed_scene(across_mps2: float, friction: Friction) -> Scene:
    """Return a sliding block driven back by `PUSHED_BACK_G`, with a transverse acceleration."""
    back = np.full(201, PUSHED_BACK_G * STANDARD_GRAVITY_MPS2)
    back[0], back[1:6] = 0.0, -9.0
    return Scene(
        ax_mps2=readonly(back),
        ay_mps2=readonly(np.full(201, -across_mps2)),
        az_mps2=NO_RECORD,
        dt_s=0.01,
        slope_rad=0.0,
        friction=friction,
        scale=1.0,
        g_mps2=STANDARD_GRAVITY_MPS2,
    )


def _pushed() -> Iterator[PushedPoint]:
    for across_mps2 in ACROSS_MPS2:
        found = two_axes.run(pushed_scene(across_mps2, JUMPING), PUSHED_TOLERANCE)
        fell = two_axes.run(pushed_scene(across_mps2, FALLING), PUSHED_TOLERANCE)
        yield PushedPoint(
            across_mps2=across_mps2,
            end_m=math.hypot(found.residual_m, found.residual_across_m),
            error_m=found.error_m,
            falling_end_m=math.hypot(fell.residual_m, fell.residual_across_m),
        )
