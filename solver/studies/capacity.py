"""The capacity of each motion: the lowest intensity at which its PRD exceeds a limit.

A motion with a PRD of 0.1 m at 0.2 g and 0.6 m at 0.4 g first exceeds a limit of 0.3 m in between.

Found by dedicated runs, not read from the levels of a study. Fits
nothing (`fragility` does). Read `capacities`.
"""

from __future__ import annotations

import math
from bisect import bisect
from collections.abc import Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field
from functools import cached_property, partial

import numpy as np
from numpy.typing import NDArray

from solver.kernels.compiler import THREADS
from solver.model import Floats, Status
from solver.studies.campaign import grid
from solver.studies.runs import STATUSES, Track, demand_at, empty_rows

Flags = NDArray[np.bool_]

ACCURACY = 1e-4
"""Width of the bracket of a capacity, relative to it."""

# Equal steps from the beginning of slip to the greatest intensity that every scan has. The coarse
# one is for medians alone: a crossing of one motion that it misses hardly changes them.
SCAN, COARSE_SCAN = 64, 16

# Most intensities between those of a scan that are run for a limit: twice what most need.
MOST_CLOSER = 40

STEEPER = 2.0
"""How much steeper than at the runs around it the PRD may be between two runs of the scan."""

# Up to which the beginning of slip is searched: a record of zeros never has one.
GREATEST_INTENSITY = 1e9


@dataclass(frozen=True, slots=True, kw_only=True)
class Capacities:
    """The capacities of motions for one limit, each field an array of shape (motions,)."""

    intensity: Floats  # from below; if censored, up to which the limit is not reached
    is_censored: Flags
    end: Floats  # intensity above which the motion would be censored
    falls: Flags  # whether the PRD is at or below the limit again at a greater intensity
    runs: NDArray[np.int64]  # for all limits together


@dataclass(frozen=True, kw_only=True)
class Curve:
    """The PRD of one motion, the largest of its orientations, over intensity."""

    tracks: Sequence[Track]  # one for each orientation
    slope_rad: float
    mu: float
    known: dict[float, float] = field(default_factory=dict)  # PRD by intensity, of runs so far

    @cached_property
    def _alone(self) -> list[tuple[Track, dict[float, float]]]:
        """PRD by intensity of each orientation; first the one that decided last."""
        return [(track, {}) for track in self.tracks]

    @property
    def runs(self) -> int:
        """Number of runs so far."""
        return sum(len(by_intensity) for _, by_intensity in self._alone)

    def prd_m(self, intensity: Floats, limit_m: float = math.inf) -> Floats:
        """Return the PRD at intensities, shape (m,) [m]; NaN without a final value.

        In two axes with a limit it is that of some orientations, which tells whether the limit is
        exceeded: up to the first that exceeds it, and none that runs around keep below (`STEEPER`).
        """
        intensities = intensity.tolist()
        unknown = [x for x in intensities if x not in self.known]
        if math.isfinite(limit_m) and any(track.scene.ay_mps2.size for track in self.tracks):
            decided = {x: self._decided(x, limit_m) for x in unknown}
            return np.array([self.known.get(x, decided.get(x)) for x in intensities])
        for track, by_intensity in self._alone:
            self._run(track, by_intensity, unknown)
        prd_m = np.array([[alone[x] for x in unknown] for _, alone in self._alone]).max(axis=0)
        self.known.update(zip(unknown, prd_m.tolist(), strict=True))
        return np.array([self.known[x] for x in intensities])

    def _run(self, track: Track, by_intensity: dict[float, float], xs: Sequence[float]) -> None:
        unknown = [x for x in xs if x not in by_intensity]
        cases = grid(1, [self.slope_rad], [self.mu], unknown)
        rows = empty_rows((len(cases), 1))
        track.fill(cases, np.arange(len(cases)), rows, 0)
        final = rows.status == STATUSES.index(Status.OK)
        prd_m = np.where(final, rows.lengths[0], np.nan)[:, 0]
        by_intensity.update(zip(unknown, prd_m.tolist(), strict=True))

    def _decided(self, x: float, limit_m: float) -> float:
        largest_m = 0.0
        for place, (track, by_intensity) in enumerate(self._alone):
            if x not in by_intensity:
                if not _may_exceed_at(x, by_intensity, limit_m):
                    continue
                self._run(track, by_intensity, [x])
            # Not > : NaN is beyond every limit.
            if not by_intensity[x] <= limit_m:
                self._alone.insert(0, self._alone.pop(place))
                return by_intensity[x]
            largest_m = max(largest_m, by_intensity[x])
        return largest_m

    def first_slip(self) -> float:
        """Return the intensity above which the block slips; inf for none."""
        return min(map(self._first_slip, self.tracks))

    def _first_slip(self, track: Track) -> float:
        # The forces at a sample are linear in the intensity, and those without slip are a cone,
        # which is convex: a block that slips at an intensity slips at every greater one.
        def slips(x: float) -> bool:
            return (
                demand_at(track, np.array([self.slope_rad, 0.0, track.scene.scale * x])) > self.mu
            )

        # On a slope steeper than the friction angle it slips without any shaking.
        if slips(0.0):
            return 0.0
        low, high = 0.0, 1.0
        while not slips(high):
            low, high = high, 2.0 * high
            if high > GREATEST_INTENSITY:
                return math.inf
        # Until there is no float between the ends, or the ends differ only by a few rounding
        # errors.
        while low < (middle := 0.5 * (low + high)) < high and high - low > 1e-14 * high:
            low, high = (low, middle) if slips(middle) else (middle, high)
        return low


def capacities(
    curves: Sequence[Curve],
    limits_m: Sequence[float],
    levels: Floats,
    *,
    is_censoring: bool,
    steps: int = SCAN,
    to_end: bool = True,
) -> tuple[Capacities, ...]:
    """Return the capacities of motions, for each limit.

    For a limit of 0 they are where the friction demand reaches the coefficient, at any intensity.
    Others are searched from there to the greatest level: at the levels and in equal steps,
    closer where the slope of the curve lets the PRD exceed the limit between two runs (`STEEPER`),
    then by bisection. Where the PRD exceeds the limit several times the first counts. A search ends
    after `MOST_CLOSER` further runs, with a capacity from below that is then less accurate.

    Parameters
    ----------
    limits_m : sequence of float
        0 or above [m].
    levels : array, shape (m,)
        Increasing intensities above 0.
    is_censoring : bool
        Whether a run without a value censors its motion; otherwise it is treated as an exceedance.
    to_end : bool
        Whether to run intensities above the first beyond all limits: `Capacities.end` and
        `Capacities.falls` need them.
    """
    of_motion = partial(
        _of_motion,
        limits_m=limits_m,
        levels=levels,
        is_censoring=is_censoring,
        steps=steps,
        to_end=to_end,
    )
    with ThreadPoolExecutor(THREADS) as pool:
        # The five fields of `Capacities`, for each motion and limit.
        rows = np.array(list(pool.map(of_motion, curves))).reshape(len(curves), len(limits_m), 5)
    return tuple(
        Capacities(
            intensity=values[:, 0],
            is_censored=values[:, 1] > 0.0,
            end=values[:, 2],
            falls=values[:, 3] > 0.0,
            runs=values[:, 4].astype(np.int64),
        )
        for values in rows.transpose(1, 0, 2)
    )


def maximum_searches(limits_m: Sequence[float], levels: Floats, steps: int = SCAN) -> int:
    """Return the maximum number of intensities that `capacities` runs for a motion."""
    return steps + len(levels) + MOST_CLOSER * sum(limit > 0.0 for limit in limits_m)


def _of_motion(
    curve: Curve,
    limits_m: Sequence[float],
    levels: Floats,
    *,
    is_censoring: bool,
    steps: int,
    to_end: bool,
) -> list[tuple[float, bool, float, bool, int]]:
    """Return the fields of `Capacities` for each limit."""
    slip, top = curve.first_slip(), float(levels[-1])
    if slip >= top:
        beyond = (top, True, top, False, 0)
        return [
            beyond if limit or math.isinf(slip) else (slip, False, math.inf, False, 0)
            for limit in limits_m
        ]
    if not slip:  # the slope alone exceeds friction: a block at rest does not stay at rest
        return [(0.0, is_censoring and limit > 0.0, 0.0, False, 0) for limit in limits_m]
    before = curve.runs
    # Levels that the caller has already run need no further run (`Curve.known`).
    x = np.union1d(np.linspace(slip, top, steps + 1), levels[levels > slip])
    # Below the first that is beyond all limits every orientation is run: none exceeds it.
    decisive_m = math.inf if is_censoring else max(limits_m)
    run = (
        curve.prd_m(x[1:], decisive_m)
        if to_end
        else np.array([*_until_beyond(curve, x[1:], max(limits_m), decisive_m)])
    )
    # At the onset of slip the PRD is zero, so no run is needed.
    x, prd_m = x[: run.size + 1], np.concatenate([[0.0], run])
    capacities = [
        _Scan(curve, x, prd_m).capacity(limit, is_censoring)
        if limit
        else (slip, False, math.inf, False)
        for limit in limits_m
    ]
    return [(*capacity, curve.runs - before) for capacity in capacities]


def _until_beyond(
    curve: Curve, intensity: Floats, limit_m: float, decisive_m: float
) -> Iterator[float]:
    """Yield the PRD at increasing intensities, up to the first that exceeds a limit."""
    for x in intensity:
        (prd_m,) = curve.prd_m(x[None], decisive_m).tolist()
        yield prd_m
        # Not > : NaN is beyond every limit.
        if not prd_m <= limit_m:
            return


def _may_exceed(x: Floats, prd_m: Floats, limit_m: float) -> Flags:
    """Return whether a limit may be exceeded in the steps between runs, shape (m - 1,)."""
    steps = np.diff(x)
    with np.errstate(invalid="ignore"):
        steep = np.nan_to_num(np.abs(np.diff(prd_m)) / steps, nan=0.0)
    padded = np.concatenate([[0.0], steep, [0.0]])
    around = np.maximum(np.maximum(padded[:-2], padded[2:]), steep)
    # A curve through two points with a slope of at most L stays below their mean + L step / 2.
    mean = 0.5 * (prd_m[:-1] + prd_m[1:])
    # Not > : NaN is beyond every limit.
    return np.asarray(~(mean + 0.5 * STEEPER * around * steps <= limit_m))


def _may_exceed_at(x: float, known: dict[float, float], limit_m: float) -> bool:
    """Return whether the limit may be exceeded at an intensity next to the known ones."""
    xs = sorted(known)
    place = bisect(xs, x)
    # Outside the range of the runs so far, nothing bounds the curve.
    if place in (0, len(xs)):
        return True
    # The step, with one on each side.
    start = max(place - 2, 0)
    near = np.array(xs[start : place + 2])
    prd_m = np.array([known[level] for level in near.tolist()])
    return bool(_may_exceed(near, prd_m, limit_m)[place - 1 - start])


class _Scan:
    """Runs of a curve in the order of their intensity."""

    def __init__(self, curve: Curve, x: Floats, prd_m: Floats) -> None:
        self._curve, self._x, self._prd_m = curve, x, prd_m

    def capacity(self, limit_m: float, is_censoring: bool) -> tuple[float, bool, float, bool]:
        """Return the fields of `Capacities` for a limit above 0."""
        levels_allowed = self._x.size + MOST_CLOSER
        decisive_m = math.inf if is_censoring else limit_m
        first = self._first_beyond(limit_m, decisive_m, levels_allowed)
        while (close := self._doubtful(first, limit_m)).size and self._x.size < levels_allowed:
            self._add(close[: levels_allowed - self._x.size], decisive_m)
            first = self._first_beyond(limit_m, decisive_m, levels_allowed)
        lost = np.flatnonzero(np.isnan(self._prd_m)) if is_censoring else np.array([], dtype=int)
        end = int(lost[0]) - 1 if lost.size else self._x.size - 1
        is_censored = first > end
        falls = bool((self._prd_m[first:] <= limit_m).any())
        last = end if is_censored else max(first - 1, 0)
        # The first crossing may be in a step that was not searched; the capacity is taken below it.
        if close.size:
            last = min(last, int(np.searchsorted(self._x, close[0])) - 1)
        return float(self._x[last]), is_censored, float(self._x[end]), falls

    def _first_beyond(self, limit_m: float, decisive_m: float, maximum: int) -> int:
        """Return the index of the first run beyond a limit, bisected; their number for none."""
        while True:
            beyond = np.flatnonzero(~(self._prd_m <= limit_m))
            if not beyond.size:
                return self._x.size
            first = int(beyond[0])
            low, high = self._x[first - 1], self._x[first]
            if high - low <= ACCURACY * high or self._x.size >= maximum:
                return first
            self._add(np.array([0.5 * (low + high)]), decisive_m)

    def _doubtful(self, first: int, limit_m: float) -> Floats:
        """Return the middles of the steps before a run between which the limit may be exceeded."""
        low, high = self._x[: first - 1], self._x[1:first]
        may = _may_exceed(self._x, self._prd_m, limit_m)[: first - 1]
        may &= high - low > ACCURACY * high
        return np.asarray(0.5 * (low + high)[may])

    def _add(self, intensity: Floats, decisive_m: float) -> None:
        places = np.searchsorted(self._x, intensity)
        self._x = np.insert(self._x, places, intensity)
        self._prd_m = np.insert(self._prd_m, places, self._curve.prd_m(intensity, decisive_m))
