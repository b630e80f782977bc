"""Clearances of an array: the object across each gap, required and provided separation.

An array that may slide 0.80 m stands 1.00 m from a fixed object. If the rule set requires one
displacement there, 0.80 m is required: D/C 0.80, OK. If the object is another array that slides
0.95 m, that displacement governs for both.

Reads no code rule itself (`solver.rules.provisions`). Read `check_clearance`.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

from report.assessment.design.rule_set import mark_of
from report.assessment.design.separation import ComparedGap, neighbor_across
from report.assessment.design.verdict import Verdict
from report.project.model import ProjectInput
from report.project.model.array import Array
from report.project.model.choices import DistanceBasis
from report.project.model.roof import Clearance, RoofObject
from report.text.units import nan_is_worst
from solver.rules import provisions
from solver.rules.provisions import Neighbor
from solver.rules.rulesets import Provision, RuleSet

if TYPE_CHECKING:
    from report.assessment.assessment import Assessment
    from report.assessment.design.arrays import ArrayAssessment, Displacement


def by_id(arrays: Sequence[ArrayAssessment], array_id: str) -> ArrayAssessment:
    """Return the array with an id."""
    return next(array for array in arrays if array.id == array_id)


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
        """The items on either side."""
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
        # Both in full precision: a separation that prints as equal may be NG, and is printed with
        # as many digits as show it (`ComparedGap.shows`).
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
    governing = governing_array(displacements, names)
    design_m = displacements[governing].permitted_m
    # As entered: a trial with other friction on one side does not make them unlike.
    near = next(array for array in data.arrays if array.id == row.array)
    rows: Sequence[Array | RoofObject] = (*data.arrays, *data.objects)
    neighbor_row = next(side for side in rows if side.id == row.object)
    neighbor, importance = neighbor_across(data, rules, near, neighbor_row)
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
        is_permitted=all(side.is_permitted for side in sides.values()),
    )


def governing_array(displacements: Mapping[str, Displacement], between: Sequence[str]) -> str:
    """Return the array of a pair that slides farther, or has no value."""
    # Either array may move toward the other: the larger displacement of both governs.
    arrays = [name for name in between if name in displacements]
    return max(arrays, key=lambda name: nan_is_worst(displacements[name].permitted_m))


def slides_m(arrays: Sequence[ArrayAssessment], gap: ClearanceCheck) -> Sequence[float]:
    """Return the displacements of the arrays that narrow a gap simultaneously [m]."""
    # Arrays that are alike slide the same way: the gap loses one displacement at most.
    if gap.neighbor is Neighbor.LIKE:
        return [gap.design_m]
    # Arrays that are unlike may slide toward each other: both displacements are subtracted.
    return [array.permitted_m for array in beside(arrays, gap.clearance)]


def with_displacements(
    done: Assessment, changed: Mapping[str, Displacement], gap: ClearanceCheck
) -> ClearanceCheck:
    """Return a clearance with other displacements of some arrays; its marks are kept."""
    slides = {**done.displacements, **changed}
    # Of the project as entered, whose friction says which arrays are alike: a trial with other
    # friction on one side must not make a like array unlike, with twice the factor.
    check = check_clearance(done.project, done.rules, slides, gap.clearance)
    return replace(check, design_mark=gap.design_mark, mark=gap.mark)


def marked_gap(
    check: ClearanceCheck, adopted: ClearanceCheck, arrays: Sequence[ArrayAssessment]
) -> ClearanceCheck:
    """Return a clearance with marks on numbers that differ under the rule set as adopted."""
    opened = by_id(arrays, check.governing_array).overridden.opened
    return replace(
        check,
        design_mark=mark_of(check.design_m, adopted.design_m) or opened,
        mark=mark_of(check.required_m, adopted.required_m) or opened,
    )


def beside(arrays: Sequence[ArrayAssessment], row: Clearance) -> Sequence[ArrayAssessment]:
    """Return the arrays on either side of a clearance, that of its row first."""
    return [by_id(arrays, row.array), *(item for item in arrays if item.id == row.object)]
