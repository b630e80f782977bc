"""The separation required by a rule set next to an array, and a gap compared with it.

By PV1-2012, a displacement of 0.50 m with I = 1 requires 0.25 m to an array of similar
construction, 0.50 m to an object or another array, and 0.75 m to an edge without a parapet.

A factor times the design displacement, times an importance factor where that is not in the
displacement: I_e at roof edges, elsewhere the larger I_p of the array and what is across the gap.
"""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from collections.abc import Sequence
from typing import TYPE_CHECKING

from report.project.model import ProjectInput
from report.project.model.array import Array
from report.project.model.choices import ObjectKind
from report.project.model.roof import RoofObject
from report.text.amounts import capacity, demand, shown_in_order
from report.text.units import Show, ratio
from solver.rules import provisions
from solver.rules.provisions import Neighbor
from solver.rules.rulesets import RuleSet

if TYPE_CHECKING:
    from report.assessment.design.arrays import ArrayAssessment


class ComparedGap(ABC):
    """A gap whose required separation is compared with the entered or drawn one."""

    __slots__ = ()
    required_m: float  # required separation [m]; NaN without a permitted displacement
    mark: str  # of the required separation

    @property
    @abstractmethod
    def between(self) -> tuple[str, str]:
        """The items on either side."""

    @property
    @abstractmethod
    def provided_m(self) -> float:
        """Provided separation [m]."""

    @property
    def demand_capacity(self) -> float:
        """Required / provided separation; NaN without a required one."""
        if math.isnan(self.required_m):
            return math.nan
        return self.required_m / self.provided_m if self.provided_m > 0.0 else math.inf

    @property
    def ratio_words(self) -> str:
        """Required / provided separation for print, with its mark."""
        return ratio(self.demand_capacity) + self.mark

    @property
    def shows(self) -> tuple[Show, Show]:
        """Format of the provided and the required separation, side by side."""
        return shown_in_order(capacity(self.provided_m), demand(self.required_m))

    def involves(self, array_id: str) -> bool:
        """Whether an array is on either side of the gap."""
        return array_id in self.between

    def across_from(self, array_id: str) -> str:
        """Return the item on the other side of the gap."""
        first, second = self.between
        return first if second == array_id else second


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
    data: ProjectInput, rules: RuleSet, near: Array, across: Array | RoofObject
) -> tuple[Neighbor, float]:
    """Return the item across a gap, and the importance factor of the separation."""
    if isinstance(across, Array):
        neighbor = Neighbor.LIKE if are_alike(near, across) else Neighbor.UNLIKE
    else:
        neighbor = _neighbor(rules, across, near)
    # PV1-2012: I_p of the array or of what stands beside it, whichever is greatest.
    i_p = max(near.i_p, across.i_p)
    return neighbor, importance_factor(rules, neighbor, i_e=data.site.i_e, i_p=i_p)


def separation_m(
    data: ProjectInput,
    rules: RuleSet,
    design_m: float,
    near: Array,
    across: Array | RoofObject | None,
) -> float:
    """Return the separation [m] that a design displacement requires; None for a bare roof edge."""
    if across is None:
        neighbor = Neighbor.EDGE
        importance = importance_factor(rules, neighbor, i_e=data.site.i_e, i_p=math.nan)
    else:
        neighbor, importance = neighbor_across(data, rules, near, across)
    return provisions.required_separation(rules, neighbor, design_m=design_m, importance=importance)


def importance_factor(rules: RuleSet, neighbor: Neighbor, *, i_e: float, i_p: float) -> float:
    """Return the importance factor of a separation: I_e at edges, the larger I_p elsewhere."""
    # ASCE 7: I_e is in the displacement already.
    if not rules.importance_in_separation:
        return 1.0
    return i_e if neighbor.is_edge else i_p


def are_alike(first: Array, second: Array) -> bool:
    """Whether two arrays are similar: construction, slope, friction and downslope direction."""
    # Directions of 359 and 1 degrees are 2 degrees apart, not 358.
    turn = (first.downslope_deg - second.downslope_deg) % 360.0
    return (
        # Arrays of one construction, slope and friction move together under one roof motion.
        first.construction.casefold() == second.construction.casefold()
        and math.isclose(first.slope_rad, second.slope_rad, abs_tol=ALIKE_SLOPE_RAD)
        and first.friction == second.friction
        and min(turn, 360.0 - turn) <= ALIKE_DEG
    )


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
    # An upper bound serves: it only decides which pairs of the plan need not be looked at.
    importance = max(data.site.i_e, *i_ps)
    # At least 0.0, for a minimum separation, which an array that rests must keep as well.
    largest_m = max((design_m for design_m in designs if not math.isnan(design_m)), default=0.0)
    return max(
        provisions.required_separation(rules, neighbor, design_m=largest_m, importance=importance)
        for neighbor in Neighbor
    )
