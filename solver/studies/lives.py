"""Service life of a roof: Poisson events with cumulative displacement.

Two events of 0.3 m downslope leave an array 0.6 m away, unless it is moved back between them.

The responses are computed by dedicated runs, as in a study. Read `draw`, then `distances`.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from itertools import product

import numpy as np
from numpy.typing import NDArray

from solver.forces import normal_mps2
from solver.kernels import lives as kernel
from solver.kernels.compiler import THREADS
from solver.model import Floats, Status
from solver.studies.rates import HazardCurve
from solver.studies.runs import Track, scene_of

Indices = NDArray[np.int64]

RESPONSES = ("prd_m", "down_m", "up_m", "across_m", "residual_m", "residual_across_m")
FIRST_STEPS, MOST_STEPS = 16, 512
"""Intervals of intensity to begin with, and at most."""

BELOW_UPLIFT = 1.0 - 1e-9
"""Share of the intensity of uplift that is still run."""

SETTLED, SETTLED_M = 0.005, 1e-4
"""Change of the results, relative to them or in meters, below which no more intensities are run."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Responses:
    """Response of an array to events of increasing intensity."""

    levels: Floats  # equally spaced in ln up to the last of the run, which repeats; (runs, m)
    values: Floats  # `RESPONSES` [m], NaN without a final value; (frictions, runs, m, 6)

    @property
    def prd_m(self) -> Floats:
        """PRD, shape (frictions, runs, m) [m]."""
        return self.values[..., kernel.PRD]


def uplift_intensity(track: Track, slope_rad: float) -> float:
    """Return the intensity above which the block lifts off; inf for none."""
    # The normal force at a sample is linear in the intensity: one run of the forces tells.
    scene = scene_of(track.scene, np.array([slope_rad, 0.0, track.scene.scale]))
    at_rest = scene.g_mps2 * math.cos(slope_rad)
    lost = at_rest - float(normal_mps2(scene).min())
    return at_rest / lost if lost > 0.0 else math.inf


def run_levels(
    tracks: Sequence[Track], slope_rad: float, mus: Sequence[float], levels: Floats
) -> Floats:
    """Run tracks at friction coefficients and their levels; return `Responses.values`."""

    def run(case: tuple[float, tuple[Track, Floats]]) -> Floats:
        mu, (track, of_track) = case
        # Beyond its last level a track repeats it: each is run once.
        once, inverse = np.unique(of_track, return_inverse=True)
        rows = np.full((once.size, len(RESPONSES)), math.nan)
        for row, x in zip(rows, once, strict=True):
            result = track.solve(np.array([slope_rad, mu, track.scene.scale * x])).result
            if result.status is Status.OK:
                row[:] = [getattr(result, name) for name in RESPONSES]
        return rows[inverse]

    with ThreadPoolExecutor(THREADS) as pool:
        rows = list(pool.map(run, product(mus, zip(tracks, levels, strict=True))))
    return np.array(rows).reshape(len(mus), *levels.shape, len(RESPONSES))


def settled_responses(
    run: Callable[[Floats], Floats],
    low: float,
    ends: Floats,
    measured: Callable[[Responses], Floats],
) -> tuple[Responses, float]:
    """Return responses at intensities so close that halving their steps changes little.

    And the largest change of a result by more than `SETTLED_M` in the last halving, relative to it.
    `run` leads from levels to `Responses.values`, between the first intensity and the last one of
    each run, shape (runs,); `measured` from responses to what must settle [m], inf for none.
    """

    def spaced(count: int) -> Floats:
        return np.minimum(np.geomspace(low, ends.max(), count), ends[:, None])

    levels = spaced(FIRST_STEPS + 1)
    coarse = Responses(levels=levels, values=run(levels))
    before = measured(coarse)
    while True:
        levels = spaced(2 * levels.shape[1] - 1)
        values = np.empty((len(coarse.values), *levels.shape, len(RESPONSES)))
        # Every other level was run before.
        values[:, :, ::2], values[:, :, 1::2] = coarse.values, run(levels[:, 1::2])
        fine = Responses(levels=levels, values=values)
        after = measured(fine)
        # inf less inf is NaN: none before and none after has not moved.
        with np.errstate(invalid="ignore"):
            moved = np.abs(after - before) > SETTLED_M
        change = np.abs(before[moved] / after[moved] - 1.0).max(initial=0.0)
        if change < SETTLED or levels.shape[1] > MOST_STEPS:
            return fine, float(change)
        coarse, before = fine, after


@dataclass(frozen=True, slots=True, kw_only=True)
class Draws:
    """The events of lives: those of life i are from first[i] to first[i + 1]."""

    first: Indices
    friction: Indices  # of each life: index of the coefficient
    run: Indices  # of each event: index of the motion and its orientation
    side: Floats  # sign of the cross-slope component
    intensity: Floats  # inf beyond the greatest that is run


def draw(
    rng: np.random.Generator,
    curve: HazardCurve,
    *,
    low: float,
    top: float,
    runs: int,
    frictions: int,
    years: float,
    lives: int,
) -> Draws:
    """Draw lives: Poisson events above an intensity, with the rates of a hazard curve.

    Those above the top intensity have none that is run: inf. Motions, orientations and friction
    coefficients are equally likely.
    """
    rate = float(curve.at(np.array([low]))[0])
    counts = rng.poisson(rate * years, lives)
    first = np.concatenate([[0], np.cumsum(counts)])
    events = int(first[-1])
    # The rate at which an event is exceeded is uniform from 0 to that of the least: its intensity
    # is the inverse of the curve.
    rates = rate * (1.0 - rng.random(events))
    is_beyond = rates <= float(curve.at(np.array([top]))[0])
    return Draws(
        first=first,
        friction=rng.integers(frictions, size=lives),
        run=rng.integers(runs, size=events),
        side=rng.choice([-1.0, 1.0], size=events),
        intensity=np.where(is_beyond, np.inf, curve.intensity_of(rates)),
    )


def distances(draws: Draws, responses: Responses, recenter_m: float) -> Floats:
    """Return the largest and the last distance from the installed location, shape (2, lives) [m].

    The array is moved back after an event beyond `recenter_m`: inf for never, 0 for always. In two
    axes the largest is an upper bound (`solver.kernels.lives`); inf for a life with an event
    without a final value.
    """
    # Level -1 is beyond what is run: the kernel gives that life no distance.
    level, weight = np.full(draws.run.size, -1), np.zeros(draws.run.size)
    for run, levels in enumerate(responses.levels):
        events = np.flatnonzero((draws.run == run) & (draws.intensity <= levels[-1]))
        x = draws.intensity[events]
        level[events] = low = np.maximum(np.searchsorted(levels, x) - 1, 0)
        weight[events] = np.maximum((x - levels[low]) / (levels[low + 1] - levels[low]), 0.0)
    out = np.empty((2, draws.friction.size))
    kernel.live(
        draws.first, draws.friction, draws.run, level, weight, draws.side, responses.values,
        recenter_m, out,
    )  # fmt: skip
    return out


@dataclass(frozen=True, slots=True, kw_only=True)
class LifeStatistics:
    """Statistics of a distance over lives; one without a distance is beyond all others."""

    mean_m: float  # inf for none: of one without a distance no mean is known
    p95_m: float  # inf for none
    beyond: float  # share of the lives beyond a clearance
    without_value: float  # share of the lives without a distance


def life_statistics(distances_m: Floats, clearance_m: float) -> LifeStatistics:
    """Return the statistics of distances of lives; inf for none."""
    return LifeStatistics(
        mean_m=float(distances_m.mean()),
        # Without interpolation: between a distance and inf it is not possible.
        p95_m=float(np.quantile(distances_m, 0.95, method="inverted_cdf")),
        beyond=float((distances_m > clearance_m).mean()),
        without_value=float(np.isinf(distances_m).mean()),
    )
