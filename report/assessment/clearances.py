"""Clearances of an array: the object across each gap, required and provided separation.

Reads no code rule itself (`solver.rules.provisions`). Read `report.assessment.project` next.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

from report.assessment.neighbors import ComparedGap, NearbyKind, PlanNeighbor
from report.assessment.verdict import Verdict, as_adopted, mark_of, nan_is_worst
from report.sheet.schema import ProjectInput
from report.sheet.schema.choices import Direction, DistanceBasis, ObjectKind
from report.sheet.schema.scene import Array, Clearance, RoofObject
from solver.rules import provisions
from solver.rules.provisions import Neighbor, Provision, RuleSet

if TYPE_CHECKING:
    from report.assessment.arrays import ArrayAssessment

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


def by_id(arrays: Sequence[ArrayAssessment], wanted: str) -> ArrayAssessment:
    """Return the array with an id."""
    return next(array for array in arrays if array.id == wanted)


@dataclass(frozen=True, slots=True, kw_only=True)
class ClearanceCheck(ComparedGap):
    """A clearance: object across it, governing displacement, required and provided separation."""

    clearance: Clearance  # its row of the workbook
    basis: DistanceBasis  # of its distance
    neighbor: Neighbor  # what is across it
    importance: float  # I_e or I_p, as the rule set takes it; 1 where the displacement includes it
    governing_array: str  # between arrays that with the larger design displacement
    design_m: float  # governing design displacement [m]; NaN without a permitted one
    separation: Provision  # of the rule set, on what is across it
    factor: float  # separation / design displacement, with the importance factor
    minimum_m: float  # minimum separation of the rule set for this neighbor [m]; 0 for none
    required_m: float  # required separation [m]; NaN without a permitted displacement
    is_permitted: bool  # whether the arrays beside it have a permitted route; else no verdict
    # of the displacement and of the required separation, where an override or a departure changes
    # them
    design_mark: str
    mark: str

    def __repr__(self) -> str:
        gap = f"{self.clearance.array} to {self.clearance.object}"
        required, provided = (1e3 * m for m in (self.required_m, self.clearance.provided_m))
        return (
            f"ClearanceCheck: {gap}, {required:.0f} mm required, {provided:.0f} mm provided, "
            f"{self.verdict.value}"
        )

    @property
    def between(self) -> tuple[str, str]:
        """What is on either side."""
        return self.clearance.array, self.clearance.object

    @property
    def provided_m(self) -> float:
        """Provided separation [m]."""
        return self.clearance.provided_m

    @property
    def is_minimum_value(self) -> bool:
        """Whether the minimum separation governs over factor x displacement."""
        return self.minimum_m > self.factor * self.design_m

    @property
    def ok(self) -> bool:
        """Whether the separation is sufficient; False without a permitted displacement."""
        return self.required_m <= self.clearance.provided_m

    @property
    def verdict(self) -> Verdict:
        """OK or NG; none where no route is permitted."""
        if not self.is_permitted:
            return Verdict.NONE
        return Verdict.OK if self.ok else Verdict.NG


def check_clearance(
    data: ProjectInput, rules: RuleSet, arrays: Sequence[ArrayAssessment], row: Clearance
) -> ClearanceCheck:
    """Return a clearance with its required separation, the larger of the two between arrays."""
    # Either array may move toward the other: the larger displacement of both governs.
    sides = beside(arrays, row)
    governing = max(sides, key=lambda array: nan_is_worst(array.permitted_m))
    design_m = governing.permitted_m
    # As entered: a trial with other friction on one side does not make them unlike.
    near = next(array for array in data.arrays if array.id == row.array)
    rows: Sequence[Array | RoofObject] = (*data.arrays, *data.objects)
    other = next(each for each in rows if each.id == row.object)
    neighbor, importance = _across(data, rules, near, other)
    key = provisions.SEPARATION_KEYS[neighbor]
    check = ClearanceCheck(
        clearance=row,
        basis=data.basis_of(row),
        neighbor=neighbor,
        importance=importance,
        governing_array=governing.id,
        design_m=design_m,
        # PV1-2012 has the importance factor here, ASCE 7 in the displacement; never both.
        separation=rules.values[key],
        factor=rules[key] * importance,
        minimum_m=provisions.minimum_separation_m(rules, neighbor),
        required_m=provisions.required_separation(
            rules, neighbor, design_m=design_m, importance=importance
        ),
        is_permitted=all(array.is_permitted for array in sides),
        design_mark="",
        mark="",
    )
    return _marked(check, data, arrays)


def slides_m(arrays: Sequence[ArrayAssessment], gap: ClearanceCheck) -> Sequence[float]:
    """Return the displacements of the arrays beside a gap that narrow it at once [m]."""
    # Arrays that are alike slide the same way: the gap loses one displacement at most.
    if gap.neighbor is Neighbor.LIKE:
        return [gap.design_m]
    # Arrays that are unlike may slide toward each other: both displacements are subtracted.
    return [array.permitted_m for array in beside(arrays, gap.clearance)]


def _across(
    data: ProjectInput, rules: RuleSet, near: Array, other: Array | RoofObject
) -> tuple[Neighbor, float]:
    """Return what is across a gap, and the importance factor of the separation."""
    if isinstance(other, Array):
        neighbor = Neighbor.LIKE if are_alike(near, other) else Neighbor.UNLIKE
    else:
        neighbor = _neighbor(rules, other, near)
    # PV1-2012: I_p of the array or of what stands beside it, whichever is greatest.
    i_p = max(near.i_p, other.i_p)
    return neighbor, _importance(rules, neighbor, i_e=data.site.i_e, i_p=i_p)


def _marked(
    check: ClearanceCheck, data: ProjectInput, arrays: Sequence[ArrayAssessment]
) -> ClearanceCheck:
    # A mark says that the number of the rule set would be another one: so it is computed as well.
    adopted = as_adopted(data)
    if adopted is data:
        return check
    rules = provisions.RULE_SETS[data.site.rule_set]
    as_arrays = [array.adopted or array for array in arrays]
    other = check_clearance(adopted, rules, as_arrays, check.clearance)
    opened = by_id(arrays, check.governing_array).opened_mark
    return replace(
        check,
        design_mark=mark_of(check.design_m, other.design_m) or opened,
        mark=mark_of(check.required_m, other.required_m) or opened,
    )


def minimum_gap(
    data: ProjectInput, rules: RuleSet, arrays: Sequence[ArrayAssessment], near: PlanNeighbor
) -> tuple[float, str]:
    """Return the separation that the rule set requires between neighbors [m], and its mark."""
    if near.kind is not NearbyKind.BARE_EDGE:
        # As a row in any direction; overlapping shapes have a negative gap, which no row may have.
        row = Clearance(
            array=near.array,
            object=near.other,
            direction=Direction.ANY,
            provided_m=max(near.gap_m, 0.0),
        )
        check = check_clearance(data, rules, arrays, row)
        return check.required_m, check.mark
    array, adopted = by_id(arrays, near.array), as_adopted(data)
    required_m = separation_m(data, rules, array.permitted_m, array.array, None)
    if adopted is data:
        return required_m, ""
    other, plain = array.adopted or array, provisions.RULE_SETS[data.site.rule_set]
    other_m = separation_m(adopted, plain, other.permitted_m, array.array, None)
    return required_m, mark_of(required_m, other_m) or array.opened_mark


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
        importance = _importance(rules, neighbor, i_e=data.site.i_e, i_p=math.nan)
    else:
        neighbor, importance = _across(data, rules, near, other)
    return provisions.required_separation(rules, neighbor, design_m=design_m, importance=importance)


def beside(arrays: Sequence[ArrayAssessment], row: Clearance) -> Sequence[ArrayAssessment]:
    """Return the arrays on either side of a clearance, that of its row first."""
    return [by_id(arrays, row.array), *(other for other in arrays if other.id == row.object)]


def _importance(rules: RuleSet, neighbor: Neighbor, *, i_e: float, i_p: float) -> float:
    """Return the importance factor of a separation: I_e at edges, the larger I_p elsewhere."""
    # ASCE 7: I_e is in the displacement already.
    if not rules.importance_in_separation:
        return 1.0
    return i_e if neighbor.is_edge else i_p


def are_alike(first: Array, other: Array) -> bool:
    """Whether two arrays slide alike: construction, slope, friction and downslope direction."""
    return (
        # Arrays of one construction, slope and friction move together under one roof motion.
        first.construction.casefold() == other.construction.casefold()
        and math.isclose(first.slope_rad, other.slope_rad, abs_tol=ALIKE_SLOPE_RAD)
        and first.friction == other.friction
        and _is_parallel(first, other)
    )


def _is_parallel(first: Array, other: Array) -> bool:
    turn = (first.downslope_deg - other.downslope_deg) % 360.0
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
    return max(
        provisions.required_separation(rules, neighbor, design_m=each_m, importance=importance)
        # With 0.0 for a minimum separation, which an array that rests must keep as well.
        for each_m in (0.0, *designs)
        if not math.isnan(each_m)
        for neighbor in Neighbor
    )
