"""Model 5: blocks in a row along the slope, linked by springs and dashpots, each with its friction.

Two blocks with mu = 0.1 and 0.3 that a stiff link holds together slide as one with mu = 0.2;
without a link, under a short pulse, the first slides three times as far and the second a seventh.

Shows whether one rigid block is adequate for an array; not used by default. Integrates nothing
itself (see `solver.kernels.row`). Read `BlockRow`, then `slide_row`.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from solver.errors import raise_any
from solver.forces import forces
from solver.kernels import row as kernel
from solver.model import Floats, Scene, SlideResult, Status, coulomb
from solver.sliding import one_axis
from solver.sliding.arguments import is_zero_or_more

# Limit on time steps, above which links are too stiff: about one minute for a row of five.
MOST_STEPS = 10_000_000

# Per sampling interval; with more events, the run ends with `Status.DIVERGED`.
_MOST_EVENTS = 20_000


@dataclass(frozen=True, slots=True, kw_only=True)
class BlockRow:
    """Blocks in a row, numbered from the upslope end, with a link between neighbors."""

    mus: tuple[float, ...]  # of each block, static and kinetic, >= 0
    # Of each link / mean mass of a block, k / m and c / m, >= 0: k / m is g / d for a link that
    # stretches by d under the weight of one mean block.
    stiffness_per_s2: float
    damping_per_s: float = 0.0
    shares: tuple[float, ...] = ()  # of the weight of the row, with a sum of 1; () of equal blocks

    @property
    def weights(self) -> tuple[float, ...]:
        """Weight of each block / weight of the row."""
        return self.shares or (1.0 / len(self.mus),) * len(self.mus)

    @property
    def mean_mu(self) -> float:
        """Friction coefficient of the row as one rigid array: the weighted mean of the blocks."""
        # A weighted mean of equal ones may differ from them in the last bit.
        if len(set(self.mus)) == 1:
            return self.mus[0]
        return math.fsum(mu * share for mu, share in zip(self.mus, self.weights, strict=True))


@dataclass(frozen=True, slots=True, kw_only=True)
class RowResult:
    """A row under one motion: displacements of each block as in `SlideResult`.

    With `Status.UPLIFT` or `Status.DIVERGED` every float is NaN. The error is a bound of the
    difference of any block's position from the exact motion under the interpolated record, from
    energy (`solver.kernels.row`), rounding error included.
    """

    status: Status
    prd_m: tuple[float, ...]
    residual_m: tuple[float, ...]
    down_m: tuple[float, ...]
    up_m: tuple[float, ...]
    # Largest lengthening or shortening of a link, along the slope. At most one extreme per step is
    # located; a step is at most one sixth of the shortest period of the links.
    stretch_m: float
    link_force: float  # largest / mean weight of a block
    error_m: float
    n_stops: int
    rigid: SlideResult  # of the row as one rigid array with `BlockRow.mean_mu`


def slide_row(scene: Scene, row: BlockRow) -> RowResult:
    """Slide a row of blocks along the slope, exactly except for rounding error.

    The row starts at rest with unstretched links, and all blocks are subjected to the same roof
    motion. Cross-slope shaking and the friction of the scene are ignored: each block has its own
    coefficient. Links carry no force normal to the roof, so N is that of an unlinked block.

    Raises `InputError` with every error in the row, or if its links are so stiff that the run would
    take more than `MOST_STEPS` steps.
    """
    return _run(scene, row, None)


def row_history(scene: Scene, row: BlockRow) -> Floats:
    """Return the displacement of each block at the samples, shape (blocks, n) [m].

    NaN if `slide_row` gives no displacement; same errors as `slide_row`.
    """
    samples = np.full((len(row.mus), scene.ax_mps2.size), np.nan)
    result = _run(scene, row, samples)
    if math.isnan(result.prd_m[0]):
        # The kernel may have filled some samples before it stopped.
        samples[:] = np.nan
    return samples * math.cos(scene.slope_rad)


def _run(scene: Scene, row: BlockRow, samples: Floats | None) -> RowResult:
    """Run a row; `samples`, if given, is filled with s at the samples."""
    # `or`: the number of steps can be computed only from valid values.
    raise_any(_faults(row) or _too_stiff(scene, row))
    # Rigid links: one block of the mean friction, weighted by the shares; N is the same for all.
    rigid = one_axis.run(replace(scene, friction=coulomb(row.mean_mu)))
    if rigid.status is Status.UPLIFT:
        return _nothing(Status.UPLIFT, row, rigid)
    count, on_plane = len(row.mus), forces(scene)
    peaks, links = np.empty((count, 4)), np.empty((count - 1, 2))
    reached, error, n_stops = kernel.slide_row(
        on_plane.down_mps2,
        on_plane.normal_mps2,
        scene.dt_s,
        np.array(row.mus, dtype=np.float64),
        # Masses over the mean mass, by which k / m and c / m are given.
        np.array(row.weights, dtype=np.float64) * count,
        float(row.stiffness_per_s2),
        float(row.damping_per_s),
        _MOST_EVENTS,
        peaks,
        links,
        samples,
    )
    if not reached or not np.isfinite(peaks).all():
        return _nothing(Status.DIVERGED, row, rigid)
    down, up, end, rate = math.cos(scene.slope_rad) * peaks.T
    # A single block has no link; `initial` is the maximum of an empty array.
    stretch, force = links.max(axis=0, initial=0.0)
    return RowResult(
        # Exactly zero at rest: the kernel sets a block's rate to zero where it stops.
        status=Status.OK if not rate.any() else Status.SLIDING_AT_END,
        prd_m=_tuple(np.maximum(down, -up)),
        residual_m=_tuple(end),
        down_m=_tuple(down),
        up_m=_tuple(np.abs(up)),
        stretch_m=float(stretch),
        # The kernel has it over the mean mass of a block.
        link_force=float(force) / scene.g_mps2,
        error_m=error,
        n_stops=n_stops,
        rigid=rigid,
    )


def _nothing(status: Status, row: BlockRow, rigid: SlideResult) -> RowResult:
    none = (math.nan,) * len(row.mus)
    return RowResult(
        status=status,
        prd_m=none,
        residual_m=none,
        down_m=none,
        up_m=none,
        stretch_m=math.nan,
        link_force=math.nan,
        error_m=math.nan,
        n_stops=0,
        rigid=rigid,
    )


def _tuple(values: Floats) -> tuple[float, ...]:
    return tuple(values.tolist())


def _faults(row: BlockRow) -> list[str]:
    """Return an error for every invalid value of a row."""
    problems = []
    if not row.mus:
        problems.append("mus is empty; use the friction coefficient of 1 block or more")
    if not all(is_zero_or_more(mu) for mu in row.mus):
        problems.append(f"mus is {row.mus!r}; use friction coefficients of 0 or more")
    for name in ("stiffness_per_s2", "damping_per_s"):
        if not is_zero_or_more(getattr(row, name)):
            problems.append(f"{name} is {getattr(row, name)!r}; use a finite number of 0 or more")
    return problems + _share_faults(row.shares, len(row.mus))


def _share_faults(shares: Sequence[float], count: int) -> list[str]:
    if not shares:
        return []
    if len(shares) != count:
        return [f"shares has {len(shares)} values for {count} blocks; use one for each, or none"]
    if not all(0.0 < share < math.inf for share in shares) or abs(math.fsum(shares) - 1.0) > 1e-9:
        return [f"shares is {shares!r}; use numbers above 0 with a sum of 1"]
    return []


def minimum_steps(row: BlockRow, seconds: float) -> float:
    """Return a lower bound of the number of steps that a row needs for a motion this long [s]."""
    # Without links nothing limits the step but the sampling interval.
    if len(row.mus) == 1:
        return 0.0
    # The kernel steps at most 1 / rate: no mode of the chain is faster than 2 sqrt(k / m) or more
    # damped than 4 c / m, with the lightest mass for m.
    lightest = min(row.weights) * len(row.mus)
    rate = 2.0 * math.sqrt(row.stiffness_per_s2 / lightest) + 4.0 * row.damping_per_s / lightest
    return rate * seconds


def _too_stiff(scene: Scene, row: BlockRow) -> list[str]:
    if minimum_steps(row, scene.dt_s * scene.ax_mps2.size) <= MOST_STEPS:
        return []
    return [
        f"stiffness_per_s2 {row.stiffness_per_s2:g} with damping_per_s {row.damping_per_s:g} takes "
        f"more than {MOST_STEPS:.0e} steps; use softer links, or model the row as one rigid block"
    ]
