"""Runs a batch of a study; each row is bit-identical to `solver.solve` with `SETTINGS`.

A motion of one component in two polarities fills two columns of `Rows`, a row for each case.

Motions of one horizontal component are run many cases at a time, with what the choice of the model
needs from a record computed once; others by `solver.sliding.model_selection`. Read `run_part`.
"""

from __future__ import annotations

import math
import sys
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from solver.forces import friction_demand
from solver.kernels import one_axis as kernel
from solver.model import STANDARD_GRAVITY_MPS2, Floats, Motion, Orientation, Scene, Status, coulomb
from solver.sliding import model_selection
from solver.sliding.model_selection import Model, Settings, Solution
from solver.sliding.one_axis import RecordBounds, bounds_of
from solver.studies.campaign import Campaign, Cases
from solver.studies.sweep import order_alike

# The PRDs of a study differ from motion to motion by far more than by this bound on their error in
# two axes; that of a package, a hundred times closer, takes longer.
SETTINGS = Settings(tolerance=1e-4)

STATUSES = tuple(Status)
"""Meaning of the numbers in `Rows.status`."""
LENGTHS = ("prd_m", "down_m", "up_m", "across_m", "residual_m")


@dataclass(frozen=True, slots=True, kw_only=True)
class Rows:
    """Outcomes of the runs of a part, of shape (cases, columns)."""

    lengths: Floats  # `LENGTHS` first, as in `SlideResult`; NaN for none
    status: NDArray[np.uint8]  # index into `STATUSES`
    model: NDArray[np.uint8]  # `Model`


def empty_rows(shape: tuple[int, int]) -> Rows:
    """Return rows to be filled, of shape (cases, columns)."""
    return Rows(
        lengths=np.empty((len(LENGTHS), *shape)),
        status=np.empty(shape, dtype=np.uint8),
        model=np.empty(shape, dtype=np.uint8),
    )


def run_part(runner: Runner, part: slice) -> Rows:
    """Run a range of cases under all motions."""
    cases = runner.campaign.cases[part]
    rows = empty_rows((len(cases), len(runner.campaign.columns)))
    for building in np.unique(cases.building):
        chosen = np.flatnonzero(cases.building == building)
        for column, track in enumerate(runner.tracks[building]):
            track.fill(cases, chosen, rows, column)
    return rows


@dataclass(frozen=True)
class Runner:
    """A campaign whose records are prepared once."""

    campaign: Campaign

    @cached_property
    def tracks(self) -> tuple[tuple[Track, ...], ...]:
        """Prepared records, by building and column."""
        return tuple(
            tuple(
                _track(motions[number], orientation)
                for number, orientation in self.campaign.columns
            )
            for motions in self.campaign.motions
        )


def _track(motion: Motion, orientation: Orientation) -> Track:
    scene = motion.scene(orientation, slope_rad=0.0, friction=coulomb(0.0))
    return Track(scene=scene, bounds=bounds_of(scene), has_vertical=motion.has_vertical)


@dataclass(frozen=True, slots=True, kw_only=True)
class Track:
    """A motion at one orientation, prepared."""

    scene: Scene  # with the factor for an intensity of 1
    bounds: RecordBounds
    has_vertical: bool

    @property
    def x(self) -> Floats:
        """Bounds of its horizontal record."""
        return self.bounds.x

    @property
    def z(self) -> Floats | None:
        """Bounds of its vertical record; None without one."""
        return self.bounds.z if self.has_vertical else None

    def solve(self, slope_mu_scale: Floats) -> Solution:
        """Solve it at a slope [rad], friction coefficient and scale."""
        return model_selection.solve(scene_of(self.scene, slope_mu_scale), SETTINGS, self.bounds)

    def fill(self, cases: Cases, chosen: NDArray[np.intp], rows: Rows, column: int) -> None:
        """Run the chosen cases and fill their rows of a column."""
        slope, mu = cases.slope_rad[chosen], cases.mu[chosen]
        scenes = np.stack([slope, mu, self.scene.scale * cases.intensity[chosen]], axis=-1)
        odd = np.arange(len(chosen))
        if not self.scene.ay_mps2.size:
            solved, odd = _solve_along(self, scenes)
            for length, values in zip(rows.lengths, solved.lengths, strict=True):
                length[chosen, column] = values
            rows.status[chosen, column], rows.model[chosen, column] = solved.status, solved.model
        for index in odd:
            place = int(chosen[index]), column
            solution = self.solve(scenes[index])
            rows.lengths[:, *place] = [getattr(solution.result, name) for name in LENGTHS]
            rows.status[place] = STATUSES.index(solution.result.status)
            rows.model[place] = solution.model


def scene_of(scene: Scene, slope_mu_scale: Floats) -> Scene:
    """Return a scene at another slope [rad], friction coefficient and scale."""
    slope, mu, scale = map(float, slope_mu_scale)
    return replace(scene, slope_rad=slope, friction=coulomb(mu), scale=scale)


def _solve_along(track: Track, scenes: Floats) -> tuple[Rows, NDArray[np.intp]]:
    """Solve scenes in one axis like `model_selection.solve`; return those left for it to solve.

    These are uplift that only the kernel or only the forces at the samples find, by rounding error.
    """
    full = _sweep(track, scenes, track.scene.az_mps2 if track.z is not None else None, track.z)
    level = full if track.z is None else _sweep(track, scenes, None, None)
    demand = _demands(track, scenes)
    # The kernel gives no number where N falls below zero.
    lifted = np.isnan(full[0])
    still = demand <= scenes[:, 1]
    uses_level = _is_level_enough(track, scenes, level, full) & ~still & ~lifted
    lengths = np.where(uses_level, level, full)
    s_end = np.where(uses_level, level[5], full[5])
    status = np.where(
        s_end == 0.0, STATUSES.index(Status.OK), STATUSES.index(Status.SLIDING_AT_END)
    )
    top = Model.ONE_AXIS if track.z is None else Model.ONE_AXIS_VERTICAL
    model = np.where(still, Model.NO_SLIP, np.where(uses_level, Model.ONE_AXIS, top))
    rows = Rows(
        lengths=lengths[: len(LENGTHS)],
        status=np.where(lifted, STATUSES.index(Status.UPLIFT), status).astype(np.uint8),
        model=np.where(lifted, top, model).astype(np.uint8),
    )
    return rows, np.flatnonzero(lifted != np.isinf(demand))


def _sweep(track: Track, scenes: Floats, az: Floats | None, z: Floats | None) -> Floats:
    """Return `LENGTHS` [m] and the speed at the end [m/s], shape (6, m)."""
    # The order of `order_alike` is 10 to 20% faster; the results are put back in that of the
    # scenes.
    order, out = order_alike(scenes), np.empty((len(scenes), 4))
    scene = track.scene
    kernel.sweep_exact(scene.ax_mps2, az, track.x, z, scene.dt_s, scene.g_mps2, scenes[order], out)
    s_max, s_min, s_end, w_end = np.empty((4, len(scenes)))
    for values, computed in zip((s_max, s_min, s_end, w_end), out.T, strict=True):
        values[order] = computed
    cs = _by_slope(math.cos, scenes)
    prd = np.where(np.isnan(s_max), np.nan, cs * np.maximum(s_max, -s_min))
    none = np.where(np.isnan(s_max), np.nan, 0.0)
    return np.stack([prd, cs * s_max, cs * np.abs(s_min), none, cs * s_end, cs * w_end])


def _by_slope(function: object, scenes: Floats) -> Floats:
    """Return a function of the slopes by the math library, as single runs evaluate it."""
    slopes, inverse = np.unique(scenes[:, 0], return_inverse=True)
    return np.array([function(slope) for slope in slopes.tolist()])[inverse]  # type: ignore[operator]


def _is_level_enough(
    track: Track, scenes: Floats, level: Floats, full: Floats
) -> NDArray[np.bool_]:
    """Whether neglecting the vertical record changes no displacement by more than matters."""
    if track.z is None:
        return np.ones(len(scenes), dtype=bool)
    bound = np.maximum(SETTINGS.matters_m, SETTINGS.matters_share * full[0])
    # All rows but the speed, as `model_selection` compares them: a vertical record may change the
    # residual alone.
    effect = np.abs(full[:-1] - level[:-1]).max(axis=0) + _rounding(track, scenes)
    return np.asarray(effect <= bound)


def _rounding(track: Track, scenes: Floats) -> Floats:
    """Return `one_axis.rounding` of each scene [m]."""
    # Its terms in its order: a run of a study equals a single run to the bit.
    scene, (x, z) = track.scene, (track.x, track.z)
    sn, cs = np.abs(_by_slope(math.sin, scenes)), _by_slope(math.cos, scenes)
    mu, scale = scenes[:, 1], np.abs(scenes[:, 2])
    up = 0.0 if z is None else scale * max(-z[0, -1], z[1, -1], 0.0)
    along = scale * max(-x[0, -1], x[1, -1])
    terms = (sn + mu * cs) * (scene.g_mps2 + up) + (cs + mu * sn) * along
    lasts = (scene.ax_mps2.size - 1) * scene.dt_s
    return np.asarray(4.0 * sys.float_info.epsilon * terms * lasts * lasts)


# Well above the rounding error of a ratio of forces, about 1e-15.
_NEAR = 1e-12


def _demands(track: Track, scenes: Floats) -> Floats:
    """Return the friction demand of each scene."""
    if track.z is not None:
        pairs, inverse = np.unique(scenes[:, [0, 2]], axis=0, return_inverse=True)
        exact = [demand_at(track, np.array([slope, 0.0, scale])) for slope, scale in pairs.tolist()]
        return np.array(exact, dtype=np.float64)[inverse.ravel()]
    # Without a vertical record the demand is tan(theta - atan(a / g)), monotone in a, so that it is
    # largest at the least or greatest sample.
    sn, cs = _by_slope(math.sin, scenes), _by_slope(math.cos, scenes)
    a = np.outer(track.x[:, -1], scenes[:, 2])
    normal = STANDARD_GRAVITY_MPS2 * cs + a * sn
    with np.errstate(divide="ignore"):
        demand = (np.abs(STANDARD_GRAVITY_MPS2 * sn - a * cs) / normal).max(axis=0)
    demand[(normal <= 0.0).any(axis=0)] = math.inf
    # Where rounding error might decide, all samples are evaluated, as `model_selection.solve` does.
    near = np.abs(demand - scenes[:, 1]) <= _NEAR * scenes[:, 1]
    near |= (np.abs(normal) <= _NEAR * STANDARD_GRAVITY_MPS2).any(axis=0)
    for index in np.flatnonzero(near):
        demand[index] = demand_at(track, scenes[index])
    return np.asarray(demand)


def demand_at(track: Track, slope_mu_scale: Floats) -> float:
    """Return the friction demand at a slope [rad] and scale; inf for uplift."""
    return friction_demand(scene_of(track.scene, slope_mu_scale))
