"""Checks independent of the model: uplift of a block, and tipping about an edge of its supports.

A block 2 m wide with its center of gravity 0.5 m high tips at a shear of twice its normal force.

Integrates no motion; with uplift no displacement reported. Read `uplift`, then `tipping`.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from solver.errors import raise_any
from solver.forces import friction_demand, normal_mps2
from solver.model import Floats, Friction, Scene


@dataclass(frozen=True, slots=True, kw_only=True)
class Uplift:
    """The normal force N of a block over a record."""

    n_min_g: float  # minimum of N / (m g); negative with uplift
    t_first_s: float  # when N first falls below zero; NaN if it never does
    duration_s: float  # in total, with N below zero
    times: int  # that N falls below zero, including a record that begins there

    @property
    def lifts(self) -> bool:
        """Whether the block would leave the roof."""
        return self.n_min_g < 0.0


def uplift(scene: Scene) -> Uplift:
    """Return when and how far N falls below zero, exactly for N linear between samples."""
    normal, dt = normal_mps2(scene), scene.dt_s
    n_min_g = float(normal.min()) / scene.g_mps2
    if n_min_g >= 0.0:
        return Uplift(n_min_g=n_min_g, t_first_s=math.nan, duration_s=0.0, times=0)
    below, starts = _below(normal), _starts(normal)
    return Uplift(
        n_min_g=n_min_g,
        t_first_s=float(starts[0]) * dt if starts.size else math.nan,
        duration_s=float(below.sum()) * dt,
        times=starts.size,
    )


def _below(normal: Floats) -> Floats:
    """Return the fraction of each interval in which N, linear between samples, is below zero."""
    first, last = normal[:-1], normal[1:]
    # Similar triangles: |below| / (|below| + |above|) where the signs differ, else 0 or 1.
    deep = np.maximum(-first, 0.0) + np.maximum(-last, 0.0)
    total = np.abs(first) + np.abs(last)
    # Zero at both ends: no part of the interval is below.
    return deep / np.where(total > 0.0, total, 1.0)


def _starts(normal: Floats) -> Floats:
    """Return when N falls below zero, in samples, including at the beginning of the record."""
    first, last = normal[:-1], normal[1:]
    (starts,) = np.nonzero((first >= 0.0) & (last < 0.0))
    begins = [0.0] if normal[0] < 0.0 else []
    # N is linear in the interval: it is zero at first / (first - last) of it.
    return np.array([*begins, *(starts + first[starts] / (first[starts] - last[starts]))])


@dataclass(frozen=True, slots=True, kw_only=True)
class Supports:
    """Position of the center of gravity of a block, midway between its supports; both > 0."""

    height_m: float  # of the center of gravity above the plane of the supports
    spacing_m: float  # in the direction in which it is smallest

    @property
    def capacity(self) -> float:
        """Shear over normal force at which the block begins to tip about an edge, b / (2 h)."""
        # V h = N b / 2, with all of N at one edge.
        return 0.5 * self.spacing_m / self.height_m


@dataclass(frozen=True, slots=True, kw_only=True)
class Tipping:
    """Shear transmitted by the supports compared with the shear at which the block begins to tip.

    Before slip, the ratio is the smaller of the demand and the static friction coefficient, divided
    by the capacity; while the block slides, the kinetic coefficient divided by the capacity, and 0
    with no slip.
    """

    demand: float  # largest shear over normal force with no slip; inf if the block lifts off
    capacity: float  # `Supports.capacity`
    at_rest_ratio: float
    sliding_ratio: float

    @property
    def ratio(self) -> float:
        """The larger of the two ratios."""
        return max(self.at_rest_ratio, self.sliding_ratio)

    @property
    def transmitted(self) -> float:
        """Shear over normal force that reaches the block in the state that governs."""
        return self.ratio * self.capacity

    @property
    def governs(self) -> str:
        """The state with the greater ratio, at rest or sliding; at rest if they are equal."""
        return "at rest" if self.at_rest_ratio >= self.sliding_ratio else "sliding"

    @property
    def is_ok(self) -> bool:
        """Whether the block never begins to tip."""
        return self.ratio <= 1.0


def tipping(scene: Scene, supports: Supports) -> Tipping:
    """Compare the shear on a block with the shear that would tip it about an edge of its supports.

    About the center of gravity, the shear V at the supports has the moment V h. The normal force
    can balance at most N b / 2, when all of it acts at one edge. The block therefore stays flat
    while V / N <= b / (2 h), at rest or sliding (Housner, Bull. Seism. Soc. Am. 53 (1963) 403-417,
    for a block that does not slip; Ishiyama, Earthquake Eng. Struct. Dyn. 10 (1982) 635-650, with
    friction: it slides before it tips if mu < b / (2 h)). Friction transmits at most V = mu N. On a
    slope the components of gravity are included in G (in the plane of the roof) and N (normal to
    it).

    A ratio above 1 means that rocking begins, not that the block overturns. With two horizontal
    components the resultant is compared with the smallest support spacing, which is conservative.
    """
    return tipping_at(friction_demand(scene), scene.friction, supports)


def tipping_at(demand: float, friction: Friction, supports: Supports) -> Tipping:
    """Return the same from the largest shear over normal force with no slip.

    Raises `InputError` with every length that is not above 0.
    """
    lengths = {"height_m": supports.height_m, "spacing_m": supports.spacing_m}
    raise_any(
        f"{name} is {value!r}; use a length in meters above 0"
        for name, value in lengths.items()
        if not 0.0 < value < math.inf
    )
    # A block at rest transmits no more than mu N; while it slides, exactly mu N.
    slips = demand > friction.mu_static
    # The greatest coefficient at any speed.
    kinetic = friction.mu_slow
    if friction.rate_s_per_m > 0.0:
        kinetic = max(friction.mu_slow, friction.mu_fast)
    return Tipping(
        demand=demand,
        capacity=supports.capacity,
        at_rest_ratio=min(demand, friction.mu_static) / supports.capacity,
        sliding_ratio=kinetic / supports.capacity if slips else 0.0,
    )
