"""An assessed project as one record: arrays, clearances, checks and the verdict.

Runs nothing: `report.assessment.assess` does.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property

from report.assessment.checks.check import Check, verdict_of
from report.assessment.checks.every import every
from report.assessment.checks.rule_limits import against_analysis
from report.assessment.checks.sentence import alike
from report.assessment.design.arrays import ArrayAssessment, Displacement
from report.assessment.design.clearances import (
    ClearanceCheck,
    by_id,
    governing_array,
    with_displacements,
)
from report.assessment.design.linked_blocks import LinkedArray
from report.assessment.design.rule_set import mark_of
from report.assessment.design.separation import ComparedGap, largest_separation_m, separation_m
from report.assessment.design.verdict import Verdict, severity
from report.assessment.plan.neighbors import NearbyKind, PlanNeighbor, plan_pairs, reaches_of
from report.motions.history import Targets
from report.motions.prepare import Shaking
from report.project.model import ProjectInput
from report.project.model.array import Array
from report.project.model.roof import RoofObject
from report.project.read.workbook_data import WorkbookSource
from report.runs import Runs, scene_key
from report.text.grouping import grouped_by
from report.text.units import nan_is_worst
from solver.records.acceptance import Acceptance
from solver.rules.rulesets import RuleSet


@dataclass(frozen=True, slots=True, kw_only=True)
class LowVelocityAssessment:
    """The arrays whose friction depends on velocity, with the low-velocity coefficient alone."""

    arrays: tuple[ArrayAssessment, ...]  # empty where no friction depends on velocity
    # the clearances of these arrays, by their number in the workbook, from 1
    clearances: Mapping[int, ClearanceCheck]

    def of(self, array_id: str) -> ArrayAssessment | None:
        """Return an array; None if its friction does not depend on velocity."""
        return next((item for item in self.arrays if item.id == array_id), None)


NOT_BY_VELOCITY = LowVelocityAssessment(arrays=(), clearances={})


def low_velocity(done: Assessment, slow: Assessment) -> LowVelocityAssessment:
    """Return the arrays changed by `with_low_velocity`, as assessed with it."""
    ids = {array.id for array in done.project.arrays if array.friction.is_by_velocity}
    return LowVelocityAssessment(
        arrays=tuple(item for item in slow.arrays if item.id in ids),
        # Arrays stay unlike that are so as given.
        clearances={
            count: with_displacements(done, slow.displacements, gap)
            for count, gap in enumerate(done.clearances, start=1)
            if not ids.isdisjoint(gap.between)
        },
    )


@dataclass(frozen=True, kw_only=True)
class Assessment:
    """An assessed project and the results."""

    project: ProjectInput  # as assessed: that of the workbook, or a changed one
    source: WorkbookSource  # the workbook, of which cells and files are printed
    shaking: Shaking  # the motions at the roof
    runs: Runs = field(compare=False, repr=False)  # of the arrays, and of others that were tried
    rules: RuleSet
    targets: Targets  # target spectra of the motions: AC156 or project-specific
    arrays: tuple[ArrayAssessment, ...]
    clearances: tuple[ClearanceCheck, ...]
    acceptance: Acceptance  # limits on the motions as run, at the roof
    # the same without overrides and departures, where the workbook has any
    adopted: Assessment | None
    # What only more than `Extent.ALONE` has. Arrays whose rigid-block model the workbook asks to be
    # checked:
    linked: tuple[LinkedArray, ...] = ()
    low_velocity: LowVelocityAssessment = NOT_BY_VELOCITY
    at_reduced_friction: Assessment | None = None
    # what the project comes to if a check is not met, as a sentence by the id of the check
    otherwise: Mapping[str, str] = field(default_factory=dict)
    more: tuple[Check, ...] = ()  # checks that do not follow from the input alone

    @cached_property
    def checks(self) -> tuple[Check, ...]:
        """All requirements, satisfied or not; the verdicts are the worst of them."""
        return (*every(self), *self.more)

    @cached_property
    def displacements(self) -> Mapping[str, Displacement]:
        """Displacement of each array, by its id."""
        return {item.id: item.displacement for item in self.arrays}

    @cached_property
    def pairs(self) -> tuple[PlanNeighbor, ...]:
        """Items on the plan next to each array, with its clearances."""
        largest_m = largest_separation_m(self.project, self.rules, self.arrays)

        def required(near: PlanNeighbor) -> tuple[float, str]:
            # Most pairs of a large roof are out of reach, and farther apart than any separation.
            if not near.given and near.gap_m > max(largest_m, near.reach_m):
                return math.nan, ""
            return _required_separation(self, near)

        return plan_pairs(self.project, reaches_of(self.arrays), self.source.addresses, required)

    @cached_property
    def neighbors(self) -> tuple[PlanNeighbor, ...]:
        """Items on the plan near each array, or with a clearance entered."""
        return tuple(pair for pair in self.pairs if pair.is_listed)

    @cached_property
    def missing_gaps(self) -> tuple[PlanNeighbor, ...]:
        """Those without a clearance that are not known to be sufficient."""
        return tuple(near for near in self.neighbors if near.is_short)

    def __repr__(self) -> str:
        counts = f"{len(self.arrays)} arrays, {len(self.clearances)} clearances"
        return f"Assessment: {self.verdict.value}; {counts}, {len(self.open)} open checks"

    @property
    def has_motions(self) -> bool:
        """Whether there is an analysis; otherwise every array uses the prescriptive procedure."""
        return bool(self.shaking.motions)

    @property
    def governing(self) -> ArrayAssessment:
        """The array with the largest design displacement, or one without a value."""
        return max(self.arrays, key=lambda array: nan_is_worst(array.design_m))

    @property
    def alike(self) -> Sequence[Sequence[ArrayAssessment]]:
        """The arrays in groups that share their runs, in order."""
        return tuple(grouped_by(self.arrays, lambda item: scene_key(item.array)).values())

    @property
    def verdict(self) -> Verdict:
        """Verdict on the project: the worst of its checks."""
        return verdict_of(self.checks)

    def array_verdict(self, item: ArrayAssessment) -> Verdict:
        """Return the verdict on an array: the worst of its checks."""
        return verdict_of(self.checks, item.id)

    @property
    def open(self) -> Sequence[Check]:
        """NG items, then the conditions; identical ones of several subjects are combined."""
        checks = [check for check in self.checks if check.is_open]
        return alike(sorted(checks, key=lambda check: -severity(check.verdict)))

    @property
    def notes(self) -> Sequence[Check]:
        """Unsatisfied requirements on the analysis that have no consequence, other than limits."""
        notes = (check for check in self.checks if check.verdict is Verdict.NOTE)
        return [check for check in notes if check.id not in self.rules.values]

    @property
    def is_overridden(self) -> bool:
        """Whether an override or a departure changes a design displacement or a separation."""
        return any(
            (
                *(item.overridden.design for item in self.arrays),
                *(gap.mark for gap in self.clearances),
                *(gap.mark for gap in self.missing_gaps),
            )
        )

    def against_analysis(self, item: ArrayAssessment) -> Sequence[str]:
        """Return the short reasons why the analysis of an array is not permitted."""
        count = len(self.shaking.motions)
        return against_analysis(self.project, self.rules, item.limits, self.acceptance, count)

    def is_rigid_enough(self, item: ArrayAssessment) -> bool:
        """Whether one rigid block is adequate for an array, if the workbook requests this check."""
        return all(row.is_rigid_enough for row in self.linked if row.design.id == item.id)

    def gaps_of(self, array_id: str) -> Sequence[ClearanceCheck]:
        """Return the clearances that involve an array, on either side."""
        return [gap for gap in self.clearances if gap.involves(array_id)]

    def governing_gap(self, array_id: str = "") -> ComparedGap | None:
        """Return the gap with the largest D/C, of equal ones the largest deficit; None if none."""
        # Pairs that the plan shows to be short and no clearance covers are gaps as well.
        gaps: Sequence[ComparedGap] = (*self.clearances, *self.missing_gaps)
        concerned = [gap for gap in gaps if not array_id or gap.involves(array_id)]

        def size(gap: ComparedGap) -> tuple[float, float]:
            return nan_is_worst(gap.demand_capacity), nan_is_worst(gap.required_m)

        return max(concerned, key=size, default=None)


def _required_separation(done: Assessment, near: PlanNeighbor) -> tuple[float, str]:
    """Return the separation required by the rule set for a pair on the plan [m], and its mark."""
    required_m = _separation_of_pair_m(done, near)
    if done.adopted is None:
        return required_m, ""
    governing = by_id(done.arrays, governing_array(done.displacements, near.between))
    mark = mark_of(required_m, _separation_of_pair_m(done.adopted, near))
    return required_m, mark or governing.overridden.opened


def _separation_of_pair_m(done: Assessment, near: PlanNeighbor) -> float:
    data, displacements = done.project, done.displacements
    governing = governing_array(displacements, near.between)
    rows: dict[str, Array | RoofObject] = {array.id: array for array in data.arrays}
    rows |= {item.id: item for item in data.objects}
    across = None if near.kind is NearbyKind.BARE_EDGE else rows[near.other]
    array = by_id(done.arrays, near.array).array
    return separation_m(data, done.rules, displacements[governing].permitted_m, array, across)
