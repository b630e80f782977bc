"""The separation that a rule set requires beside an array, by what is across the gap.

A factor times the design displacement, times an importance factor where that is not in the
displacement: I_e at roof edges, elsewhere the larger I_p of the array and what is across the gap.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING

from report.project.model import ProjectInput
from report.project.model.array import Array
from report.project.model.choices import ObjectKind
from report.project.model.roof import RoofObject
from solver.rules import provisions
from solver.rules.provisions import Neighbor, RuleSet

if TYPE_CHECKING:
    from report.assessment.design.arrays import ArrayAssessment


# Tolerance [deg] within which two downslope directions are the same. The live formulas of the sheet
# have it, too.
ALIKE_DEG = 1.0

# Tolerance [rad] within which two slopes are the same: they may be typed in different units.
ALIKE_SLOPE_RAD = 1e-6

# Edges with a parapet are missing here: their height decides.
_KINDS = {
    ObjectKind.FIXED: Neighbor.FIXED,
    ObjectKind.UNLIKE_ARRAY: Neighbor.UNLIKE,
    ObjectKind.EDGE_WITHOUT_PARAPET: Neighbor.EDGE,
}


def neighbor_across(
    data: ProjectInput, rules: RuleSet, near: Array, other: Array | RoofObject
) -> tuple[Neighbor, float]:
    """Return what is across a gap, and the importance factor of the separation."""
    if isinstance(other, Array):
        neighbor = Neighbor.LIKE if are_alike(near, other) else Neighbor.UNLIKE
    else:
        neighbor = _neighbor(rules, other, near)
    # PV1-2012: I_p of the array or of what stands beside it, whichever is greatest.
    i_p = max(near.i_p, other.i_p)
    return neighbor, importance_factor(rules, neighbor, i_e=data.site.i_e, i_p=i_p)


def separation_m(
    data: ProjectInput,
    rules: RuleSet,
    design_m: float,
    near: Array,
    other: Array | RoofObject | None,
) -> float:
    """Return the separation [m] that a design displacement requires; None for a bare roof edge."""
    if other is None:
        neighbor = Neighbor.EDGE
        importance = importance_factor(rules, neighbor, i_e=data.site.i_e, i_p=math.nan)
    else:
        neighbor, importance = neighbor_across(data, rules, near, other)
    return provisions.required_separation(rules, neighbor, design_m=design_m, importance=importance)


def importance_factor(rules: RuleSet, neighbor: Neighbor, *, i_e: float, i_p: float) -> float:
    """Return the importance factor of a separation: I_e at edges, the larger I_p elsewhere."""
    # ASCE 7: I_e is in the displacement already.
    if not rules.importance_in_separation:
        return 1.0
    return i_e if neighbor.is_edge else i_p


def are_alike(first: Array, second: Array) -> bool:
    """Whether two arrays slide alike: construction, slope, friction and downslope direction."""
    return (
        # Arrays of one construction, slope and friction move together under one roof motion.
        first.construction.casefold() == second.construction.casefold()
        and math.isclose(first.slope_rad, second.slope_rad, abs_tol=ALIKE_SLOPE_RAD)
        and first.friction == second.friction
        and _is_parallel(first, second)
    )


def _is_parallel(first: Array, second: Array) -> bool:
    turn = (first.downslope_deg - second.downslope_deg) % 360.0
    return min(turn, 360.0 - turn) <= ALIKE_DEG


def _neighbor(rules: RuleSet, obstacle: RoofObject, array: Array) -> Neighbor:
    """Return the kind of object across the gap; a low parapet is an edge without parapet."""
    if obstacle.kind is not ObjectKind.EDGE_WITH_PARAPET:
        return _KINDS[obstacle.kind]
    # A height that is not given does not qualify.
    qualifies = obstacle.height_m is not None and provisions.parapet_qualifies(
        rules, parapet_height_m=obstacle.height_m, cg_height_m=array.cg_height_m
    )
    return Neighbor.PARAPET if qualifies else Neighbor.EDGE


def largest_separation_m(
    data: ProjectInput, rules: RuleSet, arrays: Sequence[ArrayAssessment]
) -> float:
    """Return a length [m] that no separation of a project exceeds, whatever is across it."""
    designs = [array.permitted_m for array in arrays]
    i_ps = *(array.i_p for array in data.arrays), *(item.i_p for item in data.objects)
    importance = max(data.site.i_e, *i_ps)
    # At least 0.0, for a minimum separation, which an array that rests must keep as well.
    largest_m = max((design_m for design_m in designs if not math.isnan(design_m)), default=0.0)
    return max(
        provisions.required_separation(rules, neighbor, design_m=largest_m, importance=importance)
        for neighbor in Neighbor
    )
