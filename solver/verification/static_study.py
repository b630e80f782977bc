"""Static friction above kinetic: limits of a small difference and of a small second component.

Compared in one axis with the exact method, in two with one coefficient. Read `static_evidence`.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import replace
from functools import partial

import numpy as np
import pandas as pd

from solver.model import STANDARD_GRAVITY_MPS2, Floats, Friction, Scene, coulomb
from solver.sliding import one_axis, two_axes
from solver.verification.model_evidence import LEAST_M, StaticEvidence
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
        differences=dict(_differences(slid, exact_m)),
        fading=dict(_fading(slid, exact_m, ratio)),
        pushed=pushed(),
    )


def _differences(slid: Sequence[Scene], exact_m: Floats) -> Iterator[tuple[float, pd.DataFrame]]:
    alone = [faded(scene, 0.0) for scene in slid]
    plain_m = plane_prds(slid, coulomb, TIGHT)
    for excess in EXCESSES:
        law = partial(held, ratio=1.0 + excess)
        one_axis_m, two_axes_m = (plane_prds(each, law, TIGHT) for each in (alone, slid))
        changes = {"one_axis": one_axis_m / exact_m, "two_axes": two_axes_m / plain_m}
        yield excess, (pd.DataFrame(changes) - 1.0).abs()


def _fading(
    slid: Sequence[Scene], exact_m: Floats, ratio: float
) -> Iterator[tuple[float, pd.DataFrame]]:
    law = partial(held, ratio=ratio)
    base_m = plane_prds([faded(scene, 0.0) for scene in slid], law, TIGHT)
    for share in FADING:
        part = [faded(scene, share) for scene in slid]
        one_m, static_m = (plane_prds(part, each, TIGHT) for each in (coulomb, law))
        changes = {"one_coefficient": one_m / exact_m, "static_above": static_m / base_m}
        yield share, (pd.DataFrame(changes) - 1.0).abs()


def pushed_scene(across_mps2: float, friction: Friction) -> Scene:
    """Return a sliding block driven back by `PUSHED_BACK_G`, with a transverse acceleration."""
    back = np.full(201, PUSHED_BACK_G * STANDARD_GRAVITY_MPS2)
    back[0], back[1:6] = 0.0, -9.0
    return flat_scene(back, np.full(201, -across_mps2), 0.01, friction)


def pushed() -> pd.DataFrame:
    """Return where a block ends that is driven back by a force between kinetic and static friction.

    Returns
    -------
    DataFrame
        A row for each transverse acceleration [m/s2], its index: the final distance from the start
        [m], the error of it that the run reports [m], and the final distance where friction falls
        from static to kinetic gradually with velocity [m].
    """
    rows = []
    for across_mps2 in ACROSS_MPS2:
        jumped = two_axes.run(pushed_scene(across_mps2, JUMPING), PUSHED_TOLERANCE)
        fell = two_axes.run(pushed_scene(across_mps2, FALLING), PUSHED_TOLERANCE)
        end_m, falling_end_m = (
            math.hypot(result.residual_m, result.residual_across_m) for result in (jumped, fell)
        )
        rows.append({"end_m": end_m, "error_m": jumped.error_m, "falling_end_m": falling_end_m})
    return pd.DataFrame(rows, index=ACROSS_MPS2)
