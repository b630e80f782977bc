"""Comparison of models: the same scenes by every model, and the run time of each.

Read `rung_evidence`; the other functions compute its parts.
"""

from __future__ import annotations

import itertools
import math
import statistics
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from solver.model import Friction, Heading, Scene, coulomb
from solver.rivals.methods import NO_RECORD
from solver.sliding import one_axis, two_axes
from solver.sliding.row import BlockRow, RowResult, slide_row
from solver.verification import plane_work
from solver.verification.bound_study import bound_ratios
from solver.verification.rung_evidence import (
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
    RungChange,
    RungEvidence,
    RungStudy,
    RungTime,
    StaticEvidence,
)
from solver.verification.scenes import Case
from solver.verification.static_study import held, static_evidence
from solver.verification.triples import Triple
from solver.verification.workprecision import least_seconds

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

TIMED = (Case(0.0, 0.3, 1.0), Case(2.0, 0.4, 1.0), Case(5.0, 0.5, 1.5))


@dataclass(frozen=True, slots=True, kw_only=True)
class _Runs:
    """PRD of one motion, scene and heading by each model [m], and the error of two axes / PRD.

    `higher_m` uses at every velocity the coefficient that others have at high velocity or at rest.
    """

    one_axis_m: float
    vertical_m: float
    two_axes_m: float
    by_speed_m: float
    held_one_axis_m: float
    held_m: float
    higher_m: float
    error: float


def rung_evidence(triples: Sequence[Triple], *, quick: bool) -> RungEvidence:
    """Run all comparisons; accuracy and run times use the first motion."""
    scene, work = plane_work.work(triples[0], quick=quick)
    first = triples[0]
    length = (first.x_mps2.size - 1) * first.dt_s
    return RungEvidence(
        study=study(triples, quick=quick),
        static=static(triples, quick=quick),
        bounds=bound_ratios(quick=quick),
        work_scene=scene,
        work=work,
        stops=tuple(plane_work.stops()),
        times_motion=f"{first.name}, {length:.0f} s in steps of {first.dt_s:g} s",
        times=times(first),
    )


def study(triples: Sequence[Triple], *, quick: bool) -> RungStudy:
    """Run every scene of every motion with every heading by every model."""
    slopes, mus, ppas = _axes(quick)
    cases = _cases(quick)
    by_scene = [list(_by_heading(triple, case)) for triple in triples for case in cases]
    every = [run for runs in by_scene for run in runs]
    kept = [run for run in every if run is not None]
    return RungStudy(
        motions=tuple(triple.name for triple in triples),
        n_recorded=sum(triple.is_recorded for triple in triples),
        slopes_deg=tuple(slopes),
        mus=tuple(mus),
        ppas_g=tuple(ppas),
        slow_share=SLOW_SHARE,
        rate_s_per_m=RATE_S_PER_M,
        n_runs=len(every),
        n_uplift=len(every) - len(kept),
        changes=(*_changes(kept, by_scene), *_rows(triples, cases, ppas[len(ppas) // 2])),
        row_ppa_g=ppas[len(ppas) // 2],
        row_shares=ROW_SHARES,
        largest_error=max((run.error for run in kept), default=math.nan),
    )


def _axes(quick: bool) -> tuple[tuple[float, ...], ...]:
    """Return the slopes, friction coefficients and PPAs of the scenes."""
    every = SLOPES_DEG, MUS, PPAS_G
    return tuple((one[0], one[-1]) for one in every) if quick else every


def _cases(quick: bool) -> list[Case]:
    return [Case(*case) for case in itertools.product(*_axes(quick))]


def static(triples: Sequence[Triple], *, quick: bool) -> StaticEvidence:
    """Run every scene of every motion with the first heading and static friction above kinetic."""
    return static_evidence(_first_scenes(triples, _cases(quick)), 1.0 / SLOW_SHARE)


def _changes(
    kept: Sequence[_Runs], by_scene: Sequence[Sequence[_Runs | None]]
) -> Iterator[RungChange]:
    yield _change(VERTICAL, [(r.one_axis_m, r.vertical_m) for r in kept])
    yield _change(SECOND, [(r.vertical_m, r.two_axes_m) for r in kept])
    worst = [[run for run in runs if run is not None] for runs in by_scene]
    pairs = [
        (max(run.vertical_m for run in runs), max(run.two_axes_m for run in runs))
        for runs in worst
        if runs
    ]
    yield _change(WORST, pairs)
    yield _change(OVER_SLOW, [(r.two_axes_m, r.by_speed_m) for r in kept])
    yield _change(OVER_FAST, [(r.higher_m, r.by_speed_m) for r in kept])
    yield _change(HELD_ONE, [(r.vertical_m, r.held_one_axis_m) for r in kept])
    yield _change(HELD, [(r.two_axes_m, r.held_m) for r in kept])
    yield _change(OVER_STATIC, [(r.higher_m, r.held_m) for r in kept])


def _change(name: str, pairs: Sequence[tuple[float, float]]) -> RungChange:
    lesser, fuller = np.array(pairs).reshape(-1, 2).T
    counted = np.minimum(lesser, fuller) >= LEAST_M
    return RungChange(
        name=name,
        ratios=np.sort(fuller[counted] / lesser[counted]),
        n_small=int((~counted).sum()),
        most_m=float(np.abs(fuller - lesser).max(initial=0.0)),
    )


def _by_heading(triple: Triple, case: Case) -> Iterator[_Runs | None]:
    """Yield the runs with each horizontal component along the slope, in each sign."""
    for swapped, sign in itertools.product((False, True), (1, -1)):
        yield _runs(_scene(triple, case, Heading(swapped=swapped, sign=sign)), case.mu)


def _scene(triple: Triple, case: Case, heading: Heading) -> Scene:
    scene = triple.motion.scene(heading, slope_rad=case.slope_rad, friction=coulomb(case.mu))
    return replace(scene, scale=triple.scale_to(case.ppa_g))


def _runs(scene: Scene, mu: float) -> _Runs | None:
    """Run a scene by every model; None where the normal force vanishes.

    The simpler models use the low-velocity friction, as `solver.sliding.least_model` does.
    """
    vertical = one_axis.run(scene)
    if math.isnan(vertical.prd_m):
        return None
    both = two_axes.run(scene)
    more_at_rest = replace(scene, friction=held(mu, 1.0 / SLOW_SHARE))
    return _Runs(
        one_axis_m=one_axis.run(replace(scene, az_mps2=NO_RECORD)).prd_m,
        vertical_m=vertical.prd_m,
        two_axes_m=both.prd_m,
        by_speed_m=_plane_prd(replace(scene, friction=by_speed(mu))),
        held_one_axis_m=_plane_prd(replace(more_at_rest, ay_mps2=NO_RECORD)),
        held_m=_plane_prd(more_at_rest),
        higher_m=_plane_prd(replace(scene, friction=coulomb(mu / SLOW_SHARE))),
        error=both.error_m / both.prd_m if both.prd_m > 0.0 else 0.0,
    )


def _plane_prd(scene: Scene) -> float:
    return two_axes.run(scene).prd_m


def _rows(triples: Sequence[Triple], cases: Sequence[Case], ppa_g: float) -> Iterator[RungChange]:
    """Compare the largest PRD of the blocks of a row with the row as one rigid array."""
    scenes = _first_scenes(triples, [case for case in cases if case.ppa_g == ppa_g])
    for name, stretch_m in STRETCHES_M.items():
        rows = [row_of(one.friction.mu_slow, stretch_m, one.g_mps2) for one in scenes]
        found = [slide_row(one, row) for one, row in zip(scenes, rows, strict=True)]
        pairs = [(one.rigid.prd_m, max(one.prd_m)) for one in found]
        yield _change(name, [pair for pair in pairs if not math.isnan(sum(pair))])


def _first_scenes(triples: Sequence[Triple], cases: Sequence[Case]) -> list[Scene]:
    """Return every case of every motion in the first of its headings."""
    first = Heading(swapped=False, sign=1)
    return [_scene(triple, case, first) for triple in triples for case in cases]


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


def times(triple: Triple) -> tuple[RungTime, ...]:
    """Time every model on the scenes `TIMED`; the first two share one solver."""
    medians = []
    for title, run, law, second, vertical in _RUNGS:
        scenes = [
            triple.scene(case, law(case.mu), second=second, vertical=vertical) for case in TIMED
        ]
        each = [least_seconds(partial(run, scene)) for scene in scenes]
        medians.append((title, statistics.median(each)))
    return tuple(
        RungTime(title=title, seconds=seconds, ratio=seconds / medians[0][1])
        for title, seconds in medians
    )


def _row(scene: Scene) -> RowResult:
    return slide_row(scene, row_of(scene.friction.mu_slow, STRETCHES_M[STIFF], scene.g_mps2))


_RUNGS: tuple[tuple[str, Callable[[Scene], object], Callable[[float], Friction], bool, bool], ...]
_RUNGS = (
    ("One axis", one_axis.run, coulomb, False, False),
    ("One axis with vertical", one_axis.run, coulomb, False, True),
    ("Two axes with vertical", two_axes.run, coulomb, True, True),
    ("Two axes, velocity-dependent friction", two_axes.run, by_speed, True, True),
    ("Row of five blocks, links of 1 mm", _row, coulomb, False, True),
)
