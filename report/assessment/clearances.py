"""Clearances of an array: the object across each gap, required and provided separation.

Reads no code rule itself (`solver.rules.provisions`). Read `report.assessment.project` next.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

from report.assessment.neighbors import ComparedGap, NearbyKind, PlanNeighbor
from report.assessment.verdict import Verdict, mark_of
from report.project.model import ProjectInput
from report.project.model.choices import DistanceBasis, ObjectKind
from report.project.model.scene import Array, Clearance, RoofObject
from report.text.units import nan_is_worst
from solver.rules import provisions
from solver.rules.provisions import Neighbor, Provision, RuleSet

if TYPE_CHECKING:
    from report.assessment.arrays import ArrayAssessment, Displacement
    from report.assessment.project import Assessment

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
    design_mark: str = ""
    mark: str = ""

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
    data: ProjectInput, rules: RuleSet, displacements: Mapping[str, Displacement], row: Clearance
) -> ClearanceCheck:
    """Return a clearance with its required separation, by the displacement of each array."""
    names = row.array, row.object
    sides = {name: displacements[name] for name in names if name in displacements}
    governing = _governing(displacements, names)
    design_m = displacements[governing].permitted_m
    # As entered: a trial with other friction on one side does not make them unlike.
    near = next(array for array in data.arrays if array.id == row.array)
    rows: Sequence[Array | RoofObject] = (*data.arrays, *data.objects)
    other = next(each for each in rows if each.id == row.object)
    neighbor, importance = _across(data, rules, near, other)
    key = provisions.SEPARATION_KEYS[neighbor]
    return ClearanceCheck(
        clearance=row,
        basis=data.basis_of(row),
        neighbor=neighbor,
        importance=importance,
        governing_array=governing,
        design_m=design_m,
        # PV1-2012 has the importance factor here, ASCE 7 in the displacement; never both.
        separation=rules.values[key],
        factor=rules[key] * importance,
        minimum_m=provisions.minimum_separation_m(rules, neighbor),
        required_m=provisions.required_separation(
            rules, neighbor, design_m=design_m, importance=importance
        ),
        is_permitted=all(each.is_permitted for each in sides.values()),
    )


def _governing(displacements: Mapping[str, Displacement], between: Sequence[str]) -> str:
    """Return the array between which and another that slides farther, or has no value."""
    # Either array may move toward the other: the larger displacement of both governs.
    arrays = [name for name in between if name in displacements]
    return max(arrays, key=lambda name: nan_is_worst(displacements[name].permitted_m))


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


def with_displacements(
    done: Assessment, changed: Mapping[str, Displacement], gap: ClearanceCheck
) -> ClearanceCheck:
    """Return a clearance of a project where some arrays slide otherwise; its marks stay."""
    slides = {**done.displacements, **changed}
    check = check_clearance(done.project, done.rules, slides, gap.clearance)
    return replace(check, design_mark=gap.design_mark, mark=gap.mark)


def marked_gap(
    check: ClearanceCheck, adopted: ClearanceCheck, arrays: Sequence[ArrayAssessment]
) -> ClearanceCheck:
    """Return a clearance with the marks of what is another number under the rule set as adopted."""
    opened = by_id(arrays, check.governing_array).overridden.opened
    return replace(
        check,
        design_mark=mark_of(check.design_m, adopted.design_m) or opened,
        mark=mark_of(check.required_m, adopted.required_m) or opened,
    )


def minimum_gap(done: Assessment, near: PlanNeighbor) -> tuple[float, str]:
    """Return the separation that the rule set requires between neighbors [m], and its mark."""
    required_m = _minimum_m(done, near)
    if done.adopted is None:
        return required_m, ""
    governing = by_id(done.arrays, _governing(done.displacements, near.between))
    return required_m, (
        mark_of(required_m, _minimum_m(done.adopted, near)) or governing.overridden.opened
    )


def _minimum_m(done: Assessment, near: PlanNeighbor) -> float:
    data, displacements = done.project, done.displacements
    rows: dict[str, Array | RoofObject] = {item.id: item for item in data.objects}
    rows |= {array.id: array for array in data.arrays}
    return separation_m(
        data,
        done.rules,
        displacements[_governing(displacements, near.between)].permitted_m,
        by_id(done.arrays, near.array).array,
        None if near.kind is NearbyKind.BARE_EDGE else rows[near.other],
    )


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
