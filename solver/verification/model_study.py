"""Comparison of models: the same scenes by every model, and the run time of each.

Read `model_evidence`; the other functions compute its parts.

Static friction above kinetic: limits of a small difference and of a small second component.
"""

from __future__ import annotations

import math
import statistics
from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from functools import partial

import numpy as np
import pandas as pd

from solver.model import STANDARD_GRAVITY_MPS2, Floats, Friction, Motion, Scene, coulomb
from solver.rivals.methods import NO_RECORD
from solver.sliding import one_axis, two_axes
from solver.sliding.row import BlockRow, RowResult, slide_row
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
    StaticEvidence,
)
from solver.verification.random_pairs import bound_ratios
from solver.verification.study import (
    MODEL_CASES,
    RECORDED,
    TIGHT,
    faded,
    flat_scene,
    grid,
    minimum_seconds,
    plane_prds,
    scene_of,
    scenes_of,
)

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


SLOPES_DEG, MUS, PPAS_G = (0.0, 2.0, 5.0), (0.3, 0.4, 0.5, 0.6), (0.5, 1.0, 1.5)
"""All combinations are run; if quick, only the first and last values."""

SLOW_SHARE, RATE_S_PER_M = 0.8, 30.0
"""mu_slow over mu_fast, and the rate between them [s/m]; also used as kinetic over static."""

ROW_SHARES = (0.8, 1.1, 0.9, 1.2, 1.0)
"""Friction of the blocks of a row over that of the scene, numbered from the upslope end."""

STRETCHES_M = {STIFF: 1e-3, SOFT: 1e-2}
"""Elongation of a link of a row under the weight of a block [m]."""

ROW_DAMPING = 0.05
"""Damping ratio of one block on its link."""


def model_evidence(triples: Sequence[Motion], *, quick: bool) -> ModelEvidence:
    """Run all comparisons; accuracy and run times use the first motion."""
    first = triples[0]
    length = (first.ax_mps2.size - 1) * first.dt_s
    return ModelEvidence(
        study=study(triples, quick=quick),
        static=static(triples, quick=quick),
        bounds=bound_ratios(quick=quick),
        work=workprecision.work(first, quick=quick),
        stops=workprecision.stops(),
        times_motion=f"{first.id}, {length:.0f} s in steps of {first.dt_s:g} s",
        times=times(first),
    )


def study(triples: Sequence[Motion], *, quick: bool) -> ModelStudy:
    """Run every scene of every motion with every orientation by every model."""
    slopes, mus, ppas = _axes(quick)
    row_ppa_g = ppas[len(ppas) // 2]
    headings = triples[0].orientations
    scenes = scenes_of(triples, grid(slopes, mus, ppas), headings)
    results = [two_axes.run(scene) for scene in scenes]
    answered = [result for result in results if not math.isnan(result.prd_m)]
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


def _axes(quick: bool) -> tuple[tuple[float, ...], ...]:
    """Return the slopes, friction coefficients and PPAs of the scenes."""
    axes = SLOPES_DEG, MUS, PPAS_G
    return tuple((values[0], values[-1]) for values in axes) if quick else axes


def static(triples: Sequence[Motion], *, quick: bool) -> StaticEvidence:
    """Run every scene of every motion in its first orientation, static friction above kinetic."""
    return static_evidence(scenes_of(triples, grid(*_axes(quick))), 1.0 / SLOW_SHARE)


def _changes(
    scenes: Sequence[Scene], plane_m: Floats, headings: tuple[int, int]
) -> Iterator[ModelChange]:
    """Compare the models; the simpler ones use the low-velocity friction, as `least_model` does.

    `higher_m` uses at every velocity the coefficient that others have at high velocity or at rest.
    """
    alone_m = _axis_prds([replace(scene, az_mps2=NO_RECORD) for scene in scenes])
    vertical_m = _axis_prds(scenes)
    at_rest = partial(held, ratio=1.0 / SLOW_SHARE)
    by_speed_m, held_m = plane_prds(scenes, by_speed), plane_prds(scenes, at_rest)
    held_alone_m = plane_prds([faded(scene, 0.0) for scene in scenes], at_rest)
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
    """Compare the runs that both models answer."""
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
        results = [_slide_row(scene, stretch_m) for scene in scenes]
        rigid_m = np.array([result.rigid.prd_m for result in results])
        yield _change(name, rigid_m, np.array([max(result.prd_m) for result in results]))


def _slide_row(scene: Scene, stretch_m: float = STRETCHES_M[STIFF]) -> RowResult:
    return slide_row(scene, row_of(scene.friction.mu_slow, stretch_m, scene.g_mps2))


def row_of(mu: float, stretch_m: float, g_mps2: float) -> BlockRow:
    """Return five blocks whose links elongate by `stretch_m` under the weight of a block."""
    stiffness = g_mps2 / stretch_m
    return BlockRow(
        mus=tuple(mu * share for share in ROW_SHARES),
        stiffness_per_s2=stiffness,
        damping_per_s=2.0 * ROW_DAMPING * math.sqrt(stiffness),
    )


def by_speed(mu_slow: float) -> Friction:
    """Return friction that rises with velocity."""
    return Friction(
        mu_slow=mu_slow,
        mu_fast=mu_slow / SLOW_SHARE,
        rate_s_per_m=RATE_S_PER_M,
        mu_static=mu_slow,
    )


def times(triple: Motion) -> dict[str, float]:
    """Time every model on the scenes `MODEL_CASES`; the first two share one solver."""
    medians = {}
    for title, run, law, second, vertical in _MODELS:
        scenes = [
            scene_of(triple, case, law(case.mu), second=second, vertical=vertical)
            for case in MODEL_CASES
        ]
        medians[title] = statistics.median(minimum_seconds(partial(run, scene)) for scene in scenes)
    return medians


_MODELS: tuple[tuple[str, Callable[[Scene], object], Callable[[float], Friction], bool, bool], ...]
_MODELS = (
    ("One axis", one_axis.run, coulomb, False, False),
    ("One axis with vertical", one_axis.run, coulomb, False, True),
    ("Two axes with vertical", two_axes.run, coulomb, True, True),
    ("Two axes, velocity-dependent friction", two_axes.run, by_speed, True, True),
    ("Row of five blocks, links of 1 mm", _slide_row, coulomb, False, True),
)
