"""Static friction above kinetic: limits of a small difference and of a small second component.

Compared in one axis with the exact method, in two with one coefficient. Read `static_evidence`.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import replace
from functools import partial

import numpy as np

from solver.model import STANDARD_GRAVITY_MPS2, Floats, Friction, Scene, coulomb
from solver.sliding import one_axis, two_axes
from solver.verification.model_evidence import (
    LEAST_M,
    FadingAxis,
    PushedPoint,
    StaticDifference,
    StaticEvidence,
)
from solver.verification.study import TIGHT, faded, flat_scene, plane_prds

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
    slid = [scene for scene, prd_m in alone if prd_m >= LEAST_M]
    exact_m = np.array([prd_m for _, prd_m in alone if prd_m >= LEAST_M])
    return StaticEvidence(
        n_scenes=len(slid),
        ratio=ratio,
        differences=tuple(_differences(slid, exact_m)),
        fading=tuple(_fading(slid, exact_m, ratio)),
        pushed=tuple(_pushed()),
    )


def _differences(slid: Sequence[Scene], exact_m: Floats) -> Iterator[StaticDifference]:
    alone = [faded(scene, 0.0) for scene in slid]
    plain_m = plane_prds(slid, coulomb, TIGHT)
    for excess in EXCESSES:
        law = partial(held, ratio=1.0 + excess)
        yield StaticDifference(
            excess=excess,
            one_axis=_changes(plane_prds(alone, law, TIGHT), exact_m),
            two_axes=_changes(plane_prds(slid, law, TIGHT), plain_m),
        )


def _fading(slid: Sequence[Scene], exact_m: Floats, ratio: float) -> Iterator[FadingAxis]:
    law = partial(held, ratio=ratio)
    base_m = plane_prds([faded(scene, 0.0) for scene in slid], law, TIGHT)
    for share in FADING:
        part = [faded(scene, share) for scene in slid]
        yield FadingAxis(
            share=share,
            one_coefficient=_changes(plane_prds(part, coulomb, TIGHT), exact_m),
            static_above=_changes(plane_prds(part, law, TIGHT), base_m),
        )


def _changes(prd_m: Floats, base_m: Floats) -> Floats:
    return np.sort(np.abs(prd_m / base_m - 1.0))


def pushed_scene(across_mps2: float, friction: Friction) -> Scene:
    """Return a sliding block driven back by `PUSHED_BACK_G`, with a transverse acceleration."""
    back = np.full(201, PUSHED_BACK_G * STANDARD_GRAVITY_MPS2)
    back[0], back[1:6] = 0.0, -9.0
    return flat_scene(back, np.full(201, -across_mps2), 0.01, friction)


def _pushed() -> Iterator[PushedPoint]:
    for across_mps2 in ACROSS_MPS2:
        jumped = two_axes.run(pushed_scene(across_mps2, JUMPING), PUSHED_TOLERANCE)
        fell = two_axes.run(pushed_scene(across_mps2, FALLING), PUSHED_TOLERANCE)
        yield PushedPoint(
            across_mps2=across_mps2,
            end_m=math.hypot(jumped.residual_m, jumped.residual_across_m),
            error_m=jumped.error_m,
            falling_end_m=math.hypot(fell.residual_m, fell.residual_across_m),
        )
