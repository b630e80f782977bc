"""Comparison of models: the same scenes by every model; a block driven back at rest.

A row whose links stretch by 1 mm under the weight of a block has k / m = g / 1 mm = 9,807 / s2.

Read `model_evidence`; the other functions compute its parts.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import replace
from functools import partial

import numpy as np
import pandas as pd

from solver.model import STANDARD_GRAVITY_MPS2, Floats, Friction, Motion, Scene, coulomb
from solver.records.record import NO_RECORD
from solver.sliding import one_axis, two_axes
from solver.sliding.row import BlockRow, slide_row
from solver.verification import workprecision
from solver.verification.evidence import (
    HELD,
    HELD_ONE,
    LEAST_M,
    OVER_FAST,
    OVER_SLOW,
    OVER_STATIC,
    SECOND,
    SOFT,
    STIFF,
    VERTICAL,
    WORST,
    ModelChange,
    ModelEvidence,
    ModelStudy,
)
from solver.verification.study_cases import faded, flat_scene, grid, plane_prds, scenes_of
from solver.verification.verification_motions import RECORDED

ACROSS_MPS2 = (0.0, 1e-9, 1e-6, 0.1)
"""Transverse accelerations of the block that is driven back [m/s2]."""

# Acceleration that drives it back [g], between kinetic and static friction.
PUSHED_BACK_G = 0.45

# Tolerance of its runs: above the least transverse accelerations, so that the change shows.
PUSHED_TOLERANCE = 1e-8


def held(mu: float, ratio: float) -> Friction:
    """Return friction whose static coefficient is `ratio` times the kinetic one."""
    return Friction(mu_slow=mu, mu_fast=mu, rate_s_per_m=0.0, mu_static=ratio * mu)


JUMPING = held(0.4, 1.25)
"""Friction of that block."""

FALLING = replace(JUMPING, mu_slow=JUMPING.mu_static, rate_s_per_m=100.0)
"""The same friction, falling from static to kinetic gradually with velocity."""


def pushed_scene(across_mps2: float, friction: Friction) -> Scene:
    """Return a sliding block driven back by `PUSHED_BACK_G`, with a transverse acceleration."""
    back = np.full(201, PUSHED_BACK_G * STANDARD_GRAVITY_MPS2)
    # A push downslope of 0.05 s sets it sliding.
    back[0], back[1:6] = 0.0, -9.0
    return flat_scene(back, np.full(201, -across_mps2), 0.01, friction)


def pushed() -> pd.DataFrame:
    """Return the final place of a block driven back by a force between kinetic and static friction.

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


# All combinations are run; if quick, only the first and last values.
SLOPES_DEG, MUS, PPAS_G = (0.0, 2.0, 5.0), (0.3, 0.4, 0.5, 0.6), (0.5, 1.0, 1.5)

SLOW_SHARE, RATE_S_PER_M = 0.8, 30.0
"""mu_slow over mu_fast, and the rate between them [s/m]; also used as kinetic over static."""

ROW_SHARES = (0.8, 1.1, 0.9, 1.2, 1.0)
"""Friction of the blocks of a row over that of the scene, numbered from the upslope end."""

STRETCHES_M = {STIFF: 1e-3, SOFT: 1e-2}
"""Elongation of a link of a row under the weight of a block [m]."""

ROW_DAMPING = 0.05
"""Damping ratio of one block on its link."""


def model_evidence(triples: Sequence[Motion], *, quick: bool) -> ModelEvidence:
    """Run all comparisons; accuracy against run time uses the first motion."""
    return ModelEvidence(
        study=study(triples, quick=quick),
        pushed=pushed(),
        work=workprecision.work(triples[:1], quick=quick),
    )


def study(triples: Sequence[Motion], *, quick: bool) -> ModelStudy:
    """Run every scene of every motion with every orientation by every model."""
    axes: tuple[tuple[float, ...], ...] = (SLOPES_DEG, MUS, PPAS_G)
    slopes, mus, ppas = ((values[0], values[-1]) for values in axes) if quick else axes
    row_ppa_g = ppas[len(ppas) // 2]
    headings = triples[0].orientations
    scenes = scenes_of(triples, grid(slopes, mus, ppas), headings)
    results = [two_axes.run(scene) for scene in scenes]
    answered = [result for result in results if not math.isnan(result.prd_m)]
    # A block that does not slip has no error.
    errors = (result.error_m / result.prd_m if result.prd_m else 0.0 for result in answered)
    changes = _changes(
        scenes, np.array([result.prd_m for result in results]), (len(triples), len(headings))
    )
    return ModelStudy(
        motions=tuple(triple.id for triple in triples),
        n_recorded=sum(triple.source == RECORDED for triple in triples),
        slopes_deg=tuple(slopes),
        mus=tuple(mus),
        ppas_g=tuple(ppas),
        n_runs=len(scenes),
        n_uplift=len(scenes) - len(answered),
        changes=(*changes, *_rows(scenes_of(triples, grid(slopes, mus, [row_ppa_g])))),
        row_ppa_g=row_ppa_g,
        largest_error=max(errors, default=math.nan),
    )


def _changes(
    scenes: Sequence[Scene], plane_m: Floats, headings: tuple[int, int]
) -> Iterator[ModelChange]:
    """Compare the models; the simpler ones use the low-velocity friction."""
    alone_m = _axis_prds([replace(scene, az_mps2=NO_RECORD) for scene in scenes])
    vertical_m = _axis_prds(scenes)
    at_rest = partial(held, ratio=1.0 / SLOW_SHARE)
    by_speed_m, held_m = plane_prds(scenes, by_speed), plane_prds(scenes, at_rest)
    held_alone_m = plane_prds([faded(scene, 0.0) for scene in scenes], at_rest)
    # At every velocity the coefficient that others have at high velocity or at rest.
    higher_m = plane_prds(scenes, lambda mu: coulomb(mu / SLOW_SHARE))
    yield _change(VERTICAL, alone_m, vertical_m)
    yield _change(SECOND, vertical_m, plane_m)
    yield _change(WORST, *(_worst_heading(prd_m, headings) for prd_m in (vertical_m, plane_m)))
    yield _change(OVER_SLOW, plane_m, by_speed_m)
    yield _change(OVER_FAST, higher_m, by_speed_m)
    yield _change(HELD_ONE, vertical_m, held_alone_m)
    yield _change(HELD, plane_m, held_m)
    yield _change(OVER_STATIC, higher_m, held_m)


def _axis_prds(scenes: Sequence[Scene]) -> Floats:
    return np.array([one_axis.run(scene).prd_m for scene in scenes])


def _worst_heading(prd_m: Floats, headings: tuple[int, int]) -> Floats:
    """Return the largest PRD of the orientations of each motion and case that give one."""
    by_heading = prd_m.reshape(*headings, -1)
    return np.asarray(np.fmax.reduce(by_heading, axis=1).ravel())


def _change(name: str, lesser_m: Floats, fuller_m: Floats) -> ModelChange:
    """Compare the runs for which both models give a result."""
    # Without the vertical component no block lifts: one model alone may have no displacement.
    answered = ~np.isnan(lesser_m + fuller_m)
    lesser, fuller = lesser_m[answered], fuller_m[answered]
    counted = np.minimum(lesser, fuller) >= LEAST_M
    return ModelChange(
        name=name,
        ratios=np.sort(fuller[counted] / lesser[counted]),
        n_small=int((~counted).sum()),
        maximum_m=float(np.abs(fuller - lesser).max(initial=0.0)),
    )


def _rows(scenes: Sequence[Scene]) -> Iterator[ModelChange]:
    """Compare the largest PRD of the blocks of a row with the row as one rigid array."""
    for name, stretch_m in STRETCHES_M.items():
        rows = [row_of(scene.friction.mu_slow, stretch_m, scene.g_mps2) for scene in scenes]
        results = list(map(slide_row, scenes, rows))
        rigid_m = np.array([result.rigid.prd_m for result in results])
        yield _change(name, rigid_m, np.array([max(result.prd_m) for result in results]))


def row_of(mu: float, stretch_m: float, g_mps2: float) -> BlockRow:
    """Return five blocks whose links elongate by `stretch_m` under the weight of a block."""
    stiffness = g_mps2 / stretch_m
    return BlockRow(
        mus=tuple(mu * share for share in ROW_SHARES),
        stiffness_per_s2=stiffness,
        # c / m = 2 zeta sqrt(k / m), of one block alone on one link.
        damping_per_s=2.0 * ROW_DAMPING * math.sqrt(stiffness),
    )


def by_speed(mu_slow: float) -> Friction:
    """Return friction that rises with velocity."""
    return Friction(
        mu_slow=mu_slow, mu_fast=mu_slow / SLOW_SHARE, rate_s_per_m=RATE_S_PER_M, mu_static=mu_slow
    )
