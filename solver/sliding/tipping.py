"""Tipping: whether a block would begin to turn about an edge of its supports, held or sliding.

Beside every model, as a limitation of the sliding block; follows no rocking. Read `tipping`.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from solver.forces import forces
from solver.model import Friction, InputError, Scene


@dataclass(frozen=True, slots=True, kw_only=True)
class Supports:
    """Where the weight of a block acts over what it stands on.

    Attributes
    ----------
    height_m : float
        Of the centre of gravity over the plane of the supports [m], > 0. It is taken to lie
        midway between the supports.
    spacing_m : float
        Of the supports, in the direction in which they are closest [m], > 0.
    """

    height_m: float
    spacing_m: float

    @property
    def capacity(self) -> float:
        """Shear over normal force at which the block begins to turn about an edge, b / (2 h)."""
        return 0.5 * self.spacing_m / self.height_m


@dataclass(frozen=True, slots=True, kw_only=True)
class Tipping:
    """Shear that the supports hand on against the shear that would begin to turn the block.

    Attributes
    ----------
    demand : float
        Largest shear over normal force that would hold the block; inf where it lifts off.
    capacity : float
        `Supports.capacity`.
    held_ratio : float
        Held by friction, up to the moment it slips: the lesser of demand and static friction, by
        capacity.
    sliding_ratio : float
        While it slides: kinetic friction by capacity; 0 for a block that does not slip.
    """

    demand: float
    capacity: float
    held_ratio: float
    sliding_ratio: float

    @property
    def ratio(self) -> float:
        """The greater of the two."""
        return max(self.held_ratio, self.sliding_ratio)

    @property
    def governs(self) -> str:
        """Which ratio is the greater, in words; held where they are equal."""
        return "held" if self.held_ratio >= self.sliding_ratio else "sliding"

    @property
    def is_ok(self) -> bool:
        """Whether the block never begins to turn."""
        return self.ratio <= 1.0


def tipping(scene: Scene, supports: Supports) -> Tipping:
    """Compare the shear that reaches a block with what turns it about an edge of its supports.

    About the centre of gravity, shear V at the supports turns with V h, and the normal force can
    balance N b / 2 at most, when all of it is at an edge: the block keeps flat while V / N <= b /
    (2 h), held or sliding (Housner, Bull. Seism. Soc. Am. 53 (1963) 403-417, for a block that does
    not slip; Ishiyama, Earthquake Eng. Struct. Dyn. 10 (1982) 635-650, with friction: it slides
    before it tips where mu < b / (2 h)). Friction hands on V = mu N at most. Gravity's part on a
    slope is in G and N, which act along the plane and across it.

    A ratio above 1 says that rocking begins, not that the block falls over. With two horizontal
    components the resultant is held against the closest supports, which is never less.

    Raises
    ------
    InputError
        With every length that is not above 0.
    """
    _check(supports)
    demand, friction = forces(scene).friction_demand, scene.friction
    slips = demand > friction.mu_static
    return Tipping(
        demand=demand,
        capacity=supports.capacity,
        held_ratio=min(demand, friction.mu_static) / supports.capacity,
        sliding_ratio=_kinetic(friction) / supports.capacity if slips else 0.0,
    )


def _kinetic(friction: Friction) -> float:
    """Return the greatest coefficient at any speed."""
    if friction.rate_s_per_m > 0.0:
        return max(friction.mu_slow, friction.mu_fast)
    return friction.mu_slow


def _check(supports: Supports) -> None:
    lengths = {"height_m": supports.height_m, "spacing_m": supports.spacing_m}
    problems = [
        f"{name} is {value!r}; give a length in metres above 0"
        for name, value in lengths.items()
        if not 0.0 < value < math.inf
    ]
    if problems:
        raise InputError(problems)
