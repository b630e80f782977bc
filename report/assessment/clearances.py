"""Clearances of an array: the object across each gap, required and provided separation.

Reads no code rule itself (`solver.rules.provisions`). Read `report.assessment.project` next.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

from report.assessment.arrays import ArrayAssessment, by_id
from report.assessment.runs import nan_is_worst
from report.sheet.schema import (
    Array,
    Clearance,
    Direction,
    ObjectKind,
    ProjectInput,
    RoofObject,
)
from solver.rules import provisions
from solver.rules.provisions import Neighbor, RuleSet

ALIKE_DEG = 1.0
"""Tolerance [deg] within which two downslope directions are the same."""

_KINDS = {
    ObjectKind.FIXED: Neighbor.FIXED,
    ObjectKind.UNLIKE_ARRAY: Neighbor.UNLIKE,
    ObjectKind.EDGE_WITHOUT_PARAPET: Neighbor.EDGE,
}
_OPPOSITE = {Direction.DOWN: Direction.UP, Direction.UP: Direction.DOWN}


@dataclass(frozen=True, slots=True, kw_only=True)
class ClearanceCheck:
    """A clearance: object across it, governing displacement, required and provided separation.

    Attributes
    ----------
    governing_array, governing_direction : str, Direction
        Array and direction of the governing design displacement: the larger of the two between
        arrays.
    least_m : float
        Minimum separation of the rule set for this neighbor [m]; 0 for none.
    """

    clearance: Clearance
    neighbor: Neighbor
    governing_array: str
    governing_direction: Direction
    design_m: float
    factor: float
    least_m: float
    required_m: float

    @property
    def demand_capacity(self) -> float:
        """Required / provided separation."""
        provided = self.clearance.provided_m
        return self.required_m / provided if provided > 0.0 else math.inf

    def across_from(self, array_id: str) -> str:
        """Return the id on the other side of the gap."""
        seen_from_object = self.clearance.object == array_id
        return self.clearance.array if seen_from_object else self.clearance.object

    @property
    def is_least_value(self) -> bool:
        """Whether the minimum separation governs over factor x displacement."""
        return self.least_m > self.factor * self.design_m

    @property
    def ok(self) -> bool:
        """Whether the separation is sufficient; False without a design displacement."""
        return self.required_m <= self.clearance.provided_m


def check_clearance(
    data: ProjectInput,
    rules: RuleSet,
    arrays: Sequence[ArrayAssessment],
    row: Clearance,
) -> ClearanceCheck:
    """Return a clearance with its required separation, the larger of the two between arrays."""
    near = by_id(arrays, row.array)
    others = [a for a in arrays if a.id == row.object]
    facing = [(near, row.direction)]
    facing += [
        (other, facing_direction(near.array, other.array, row.direction)) for other in others
    ]
    governing, direction = max(facing, key=lambda a: nan_is_worst(a[0].design_toward_m(a[1])))
    design_m = governing.design_toward_m(direction)
    if others:
        alike = near.array.construction.casefold() == others[0].array.construction.casefold()
        neighbor = Neighbor.LIKE if alike else Neighbor.UNLIKE
    else:
        obstacle = next(item for item in data.objects if item.id == row.object)
        neighbor = _neighbor(rules, obstacle, near.array)
    required = provisions.required_separation(
        rules, neighbor, design_m=design_m, importance=data.site.i_e
    )
    factor = rules[provisions.SEPARATION_KEYS[neighbor]]
    if rules.importance_in_separation:
        factor *= data.site.i_e
    return ClearanceCheck(
        clearance=row,
        neighbor=neighbor,
        governing_array=governing.id,
        governing_direction=direction,
        design_m=design_m,
        factor=factor,
        least_m=provisions.least_separation_m(rules, neighbor),
        required_m=required,
    )


def facing_direction(near: Array, other: Array, direction: Direction) -> Direction:
    """Return the direction in the axes of the array across the gap.

    Any where the two arrays have different downslope directions.
    """
    turn = (near.downslope_deg - other.downslope_deg) % 360.0
    if min(turn, 360.0 - turn) > ALIKE_DEG:
        return Direction.ANY
    return _OPPOSITE.get(direction, direction)


def _neighbor(rules: RuleSet, obstacle: RoofObject, array: Array) -> Neighbor:
    """Return the kind of object across the gap; a low parapet is an edge without parapet."""
    if obstacle.kind is not ObjectKind.EDGE_WITH_PARAPET:
        return _KINDS[obstacle.kind]
    qualifies = obstacle.height_m is not None and provisions.parapet_qualifies(
        rules, parapet_height_m=obstacle.height_m, cg_height_m=array.cg_height_m
    )
    return Neighbor.PARAPET if qualifies else Neighbor.EDGE
