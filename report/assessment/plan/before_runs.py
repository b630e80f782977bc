"""The pairs of the plan before any run, at the prescriptive displacement."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING

from report.assessment.design.routes import prescriptive_of
from report.assessment.design.rule_set import rule_set_of
from report.assessment.design.separation import separation_m
from report.assessment.plan.neighbors import REACH_FACTOR, NearbyKind, PlanNeighbor, plan_pairs
from report.project.model import ProjectInput
from report.project.model.place import Place

if TYPE_CHECKING:
    from report.assessment.design.arrays import ArrayAssessment


def pairs_before_runs(
    data: ProjectInput, addresses: Mapping[Place, str], arrays: Sequence[ArrayAssessment] = ()
) -> tuple[PlanNeighbor, ...]:
    """Return the pairs of the plan as a package has them at the prescriptive displacement."""
    # Of arrays that have been run, larger design displacements count.
    rules, least_m = rule_set_of(data), design_before_runs_m(data)
    slides = {array.id: least_m for array in data.arrays} | larger_m(arrays, least_m)
    known = {array.id: array for array in data.arrays}
    rows = {item.id: item for item in data.objects} | known

    def required(near: PlanNeighbor) -> tuple[float, str]:
        design_m = max(slides[near.array], slides.get(near.other, 0.0))
        other = None if near.kind is NearbyKind.BARE_EDGE else rows[near.other]
        return separation_m(data, rules, design_m, known[near.array], other), ""

    reaches = [(array, REACH_FACTOR * slides[array.id]) for array in data.arrays]
    return plan_pairs(data, reaches, addresses, required)


def design_before_runs_m(data: ProjectInput) -> float:
    """Return the design displacement that is taken before any run [m]: the prescriptive one."""
    # No floor on the displacement from analysis exceeds it, overridden or not.
    return prescriptive_of(data, rule_set_of(data)).value_m


def larger_m(arrays: Sequence[ArrayAssessment], least_m: float) -> dict[str, float]:
    """Return the permitted displacements of arrays that are larger than one [m]."""
    # NaN, of a displacement that is not permitted, is not larger.
    return {array.id: array.permitted_m for array in arrays if array.permitted_m > least_m}
