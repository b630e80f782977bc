"""The room around an array: what lies across each gap, how much is required, how much is there.

Reads no code rule itself (`solver.rules.provisions`). Read `report.assessment.project` next.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

from report.assessment.arrays import ArrayAssessment, by_id, same_id
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
from solver.rules.provisions import Neighbour, RuleSet

ALIKE_DEG = 1.0
"""Slopes that fall within so many degrees of each other fall in the same direction."""

_KINDS = {
    ObjectKind.FIXED: Neighbour.FIXED,
    ObjectKind.UNLIKE_ARRAY: Neighbour.UNLIKE,
    ObjectKind.EDGE_WITHOUT_PARAPET: Neighbour.EDGE,
}
_OPPOSITE = {Direction.DOWN: Direction.UP, Direction.UP: Direction.DOWN}


@dataclass(frozen=True, slots=True, kw_only=True)
class ClearanceCheck:
    """A clearance: what lies across it, the displacement that counts, required and provided.

    Attributes
    ----------
    governing_array, governing_direction : str, Direction
        Whose design displacement counts, in its own direction: the larger of the two between
        arrays.
    least_m : float
        Least separation of the rule set for this neighbour [m]; 0 for none.
    """

    clearance: Clearance
    neighbour: Neighbour
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
        """Return what lies across the gap, seen from one of its two sides."""
        seen_from_object = same_id(self.clearance.object, array_id)
        return self.clearance.array if seen_from_object else self.clearance.object

    @property
    def is_least_value(self) -> bool:
        """Whether the least separation governs over factor x displacement."""
        return self.least_m > self.factor * self.design_m

    @property
    def ok(self) -> bool:
        """Whether the room suffices; without a design displacement it does not."""
        return self.required_m <= self.clearance.provided_m


def check_clearance(
    data: ProjectInput,
    rules: RuleSet,
    arrays: Sequence[ArrayAssessment],
    row: Clearance,
) -> ClearanceCheck:
    """Return a clearance with what it requires, the larger of the two sides between arrays."""
    near = by_id(arrays, row.array)
    others = [a for a in arrays if same_id(a.array.id, row.object)]
    facing = [(near, row.direction)]
    facing += [
        (other, facing_direction(near.array, other.array, row.direction)) for other in others
    ]
    governing, direction = max(facing, key=lambda a: nan_is_worst(a[0].design_towards_m(a[1])))
    design_m = governing.design_towards_m(direction)
    if others:
        alike = same_id(near.array.construction, others[0].array.construction)
        neighbour = Neighbour.LIKE if alike else Neighbour.UNLIKE
    else:
        found = next(item for item in data.objects if same_id(item.id, row.object))
        neighbour = _neighbour(rules, found, near.array)
    required = provisions.required_separation(
        rules, neighbour, design_m=design_m, importance=data.site.i_e
    )
    factor = rules[provisions.SEPARATION_KEYS[neighbour]]
    if rules.importance_in_separation:
        factor *= data.site.i_e
    return ClearanceCheck(
        clearance=row,
        neighbour=neighbour,
        governing_array=governing.array.id,
        governing_direction=direction,
        design_m=design_m,
        factor=factor,
        least_m=provisions.least_separation_m(rules, neighbour),
        required_m=required,
    )


def facing_direction(near: Array, other: Array, direction: Direction) -> Direction:
    """Return a direction of an array as seen from the array across the gap.

    Any where their slopes fall in different directions.
    """
    turn = (near.downslope_deg - other.downslope_deg) % 360.0
    if min(turn, 360.0 - turn) > ALIKE_DEG:
        return Direction.ANY
    return _OPPOSITE.get(direction, direction)


def _neighbour(rules: RuleSet, found: RoofObject, array: Array) -> Neighbour:
    """Return what lies across the gap; a parapet that is too low leaves an edge without."""
    if found.kind is not ObjectKind.EDGE_WITH_PARAPET:
        return _KINDS[found.kind]
    qualifies = found.height_m is not None and provisions.parapet_qualifies(
        rules, parapet_height_m=found.height_m, cg_height_m=array.cg_height_m
    )
    return Neighbour.PARAPET if qualifies else Neighbour.EDGE
