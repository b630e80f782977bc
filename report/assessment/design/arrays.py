"""One array under all motions, checked against the rule set: its design displacement.

Seven PRDs with a mean of 0.40 m give 1.1 x 0.40 = 0.44 m by PV1-2012. With a prescriptive value of
1.00 m, the floor without peer review, half of it, governs: 0.50 m.

The PRDs of its runs give a value from analysis by a statistic of the rule set. The design
displacement is that value, or the floor where that is larger and no peer review removes it; by the
prescriptive route it is the prescriptive value, or the largest PRD where that is larger.

Computes no physics (`report.runs`) and reads no code rule itself
(`solver.rules.provisions`). Read `assess_array`.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from enum import StrEnum
from functools import cached_property
from itertools import chain
from operator import attrgetter

from report.assessment.design.routes import (
    NOT_PERMITTED,
    Route,
    RouteLimits,
    interconnection_n,
    limits_of,
    prescriptive_of,
    statistic_basis,
)
from report.assessment.design.rule_set import OVERRIDDEN, mark_of
from report.project.model import ProjectInput
from report.project.model.array import Array
from report.runs import MotionRun, OrientedRun
from report.text.units import nan_is_worst
from solver.rules import provisions
from solver.rules.provisions import AnalysisValue, Basis, Prescriptive
from solver.rules.rulesets import RuleSet
from solver.sliding.uplift import Supports, Tipping, Uplift, tipping_at

# Of an array without runs: nothing is known of its normal force.
NO_UPLIFT = Uplift(n_min_g=math.nan, t_first_s=math.nan, duration_s=0.0, times=0)


class DesignBasis(StrEnum):
    """Source of a design displacement."""

    ANALYSIS = "analysis"
    FLOOR = "floor"
    PRESCRIPTIVE = "prescriptive"
    NO_VALUE = "none"


@dataclass(frozen=True, slots=True)
class Displacement:
    """Displacement of an array, for adjacent items."""

    design_m: float  # NaN where there is no value
    is_permitted: bool = True

    @property
    def permitted_m(self) -> float:
        """Design displacement that may be used [m]; NaN where no route is permitted."""
        return self.design_m if self.is_permitted else math.nan


@dataclass(frozen=True, slots=True, kw_only=True)
class ArrayMarks:
    """Marks of the numbers of an array that are changed by an override or a departure."""

    prescriptive: str = ""
    analysis: str = ""
    floor: str = ""
    interconnection: str = ""
    opened: str = ""  # of what is by a route that an override alone permits
    design: str = ""


@dataclass(frozen=True, kw_only=True)
class ArrayAssessment:
    """One array: its runs, the value from analysis, the prescriptive value, the design value."""

    array: Array  # its row of the workbook
    motions: tuple[MotionRun, ...]  # the runs under each motion
    limits: RouteLimits
    analysis: AnalysisValue  # of the PRDs
    prescriptive: Prescriptive
    floor_m: float  # minimum design displacement without peer review [m]; 0 with it
    is_permitted: bool  # by the limits of the route, and by analysis those on the motions
    # Design displacement [m]. By analysis: the larger of the value from analysis and the floor. By
    # the prescriptive route: the prescriptive value, not less than the largest PRD of any runs. NaN
    # where a run has no final displacement, or neither route gives a value.
    design_m: float
    interconnection_n: float  # required strength between the parts of the array [N]
    overridden: ArrayMarks = ArrayMarks()

    def __repr__(self) -> str:
        design = f"design displacement {1e3 * self.design_m:.0f} mm"
        return f"ArrayAssessment: {self.id}, {design}, by {self.source}"

    @property
    def id(self) -> str:
        """Name of the array in the workbook."""
        return self.array.id

    @property
    def route(self) -> Route:
        """Procedure by which the design displacement is obtained."""
        return self.limits.route

    @property
    def runs(self) -> tuple[OrientedRun, ...]:
        """Every run under every motion."""
        return tuple(chain.from_iterable(motion.runs for motion in self.motions))

    @cached_property  # with `uplift` 8 % of a move of the page, which asks for neither
    def tipping(self) -> Tipping:
        """Tipping of the run nearest to it; without runs, by the most that friction transmits."""
        # Both ratios of the check rise with the friction that a run demands.
        demand = max((run.solution.friction_demand for run in self.runs), default=math.inf)
        array = self.array
        supports = Supports(height_m=array.cg_height_m, spacing_m=array.support_spacing_m)
        return tipping_at(demand, array.friction, supports)

    @cached_property
    def uplift(self) -> Uplift:
        """Uplift of the run with the smallest normal force; none without runs."""
        of_motions = (motion.uplift for motion in self.motions)
        return min(of_motions, key=attrgetter("n_min_g"), default=NO_UPLIFT)

    @property
    def governs(self) -> DesignBasis:
        """Source of the design displacement."""
        if math.isnan(self.design_m):
            return DesignBasis.NO_VALUE
        if self.route is Route.PRESCRIPTIVE:
            return DesignBasis.PRESCRIPTIVE
        return DesignBasis.FLOOR if self.floor_m > self.analysis.value_m else DesignBasis.ANALYSIS

    @property
    def source(self) -> str:
        """Source of the design displacement as text; not permitted if neither procedure is."""
        mark = f", {NOT_PERMITTED}" if self.has_unpermitted_value else ""
        return f"{self.governs.value}{mark}"

    @property
    def satisfies_limits(self) -> bool:
        """Whether array and procedure are permitted: every applicable limit is satisfied."""
        return self.is_permitted and all(check.ok for check in self.limits.required)

    @property
    def is_by_runs(self) -> bool:
        """Whether its design displacement is based on its runs, even if there is none."""
        return self.route is Route.ANALYSIS or self.design_m != self.prescriptive.value_m

    @property
    def lacks_motions(self) -> bool:
        """Whether it uses the analysis displacement, but the motions are too few for one."""
        return self.route is Route.ANALYSIS and self.analysis.basis is Basis.TOO_FEW

    @property
    def lacks_slack(self) -> bool:
        """Whether the entered electrical slack is less than the design displacement."""
        slack_m = self.array.slack_m
        return slack_m is not None and slack_m < self.design_m

    @property
    def has_unpermitted_value(self) -> bool:
        """Whether there is a design displacement, but by a procedure that is not permitted."""
        return not math.isnan(self.design_m) and not self.is_permitted

    @property
    def displacement(self) -> Displacement:
        """Its displacement."""
        return Displacement(self.design_m, self.is_permitted)

    @property
    def permitted_m(self) -> float:
        """Design displacement that may be used [m]; NaN where no route is permitted."""
        return self.displacement.permitted_m

    def prescriptive_mark(self, refused: str = f", {NOT_PERMITTED}") -> str:
        """Return the mark of the prescriptive displacement, whether it is permitted or not."""
        is_permitted = all(check.ok for check in self.limits.prescriptive_checks)
        return self.overridden.prescriptive + refused * (not is_permitted)

    @property
    def ratio(self) -> float:
        """Design displacement / prescriptive displacement."""
        return self.design_m / self.prescriptive.value_m

    @property
    def variation(self) -> float:
        """Coefficient of variation of the motions' PRDs; NaN for one motion."""
        peaks = [run.governing.prd_m for run in self.motions]
        mean = self.analysis.mean_m
        if len(peaks) < 2 or not mean > 0.0:
            return math.nan
        return math.sqrt(sum((p - mean) ** 2 for p in peaks) / (len(peaks) - 1)) / mean

    @property
    def fastest_mps(self) -> float:
        """Largest sliding velocity of all runs [m/s]; NaN if a run gives none or there is none."""
        speeds = (run.result.peak_speed_mps for run in self.runs)
        return max(speeds, key=nan_is_worst, default=math.nan)

    @property
    def residual_m(self) -> float:
        """Largest distance from its location at the end of a run [m]; NaN if a run gives none."""
        results = (run.result for run in self.runs)
        ends = (math.hypot(end.residual_m, end.residual_across_m) for end in results)
        return max(ends, key=nan_is_worst, default=math.nan)

    @property
    def worst(self) -> MotionRun:
        """The motion with the largest PRD."""
        return max(self.motions, key=lambda run: nan_is_worst(run.governing.prd_m))


def assess_array(
    data: ProjectInput,
    rules: RuleSet,
    array: Array,
    runs: tuple[MotionRun, ...],
    *,
    motions_qualify: bool,
) -> ArrayAssessment:
    """Return an array checked against the rule set."""
    prescriptive = prescriptive_of(data, rules)
    peaks_m = [run.governing.prd_m for run in runs]
    analysis = provisions.analysis_value(rules, peaks_m, statistic_basis(data))
    # A review without name, license, date and letter, of other inputs, or dated after the package
    # removes nothing (`ProjectInput.is_peer_reviewed`).
    floor_m = provisions.analysis_floor_m(rules, prescriptive, is_reviewed=data.is_peer_reviewed)
    has_value = motions_qualify and analysis.basis is not Basis.TOO_FEW
    limits = limits_of(data, rules, array, n_motions=len(runs), has_value=has_value)
    return ArrayAssessment(
        array=array,
        motions=runs,
        analysis=analysis,
        prescriptive=prescriptive,
        floor_m=floor_m,
        limits=limits,
        is_permitted=(motions_qualify or limits.route is Route.PRESCRIPTIVE)
        and all(check.ok for check in limits.of_route),
        design_m=_design_m(limits.route, runs, analysis, prescriptive, floor_m),
        interconnection_n=interconnection_n(data, rules, array),
    )


def marked(item: ArrayAssessment, adopted: ArrayAssessment) -> ArrayAssessment:
    """Return an array with marks on numbers that differ under the rule set as adopted."""
    # True is greater than False: permitted with overrides, and not without.
    opened = OVERRIDDEN if item.is_permitted > adopted.is_permitted else ""
    marks = ArrayMarks(
        prescriptive=mark_of(item.prescriptive.value_m, adopted.prescriptive.value_m),
        analysis=mark_of(item.analysis.value_m, adopted.analysis.value_m),
        floor=mark_of(item.floor_m, adopted.floor_m),
        interconnection=mark_of(item.interconnection_n, adopted.interconnection_n),
        opened=opened,
        design=mark_of(item.design_m, adopted.design_m) or opened,
    )
    return replace(item, overridden=marks)


def _design_m(
    route: Route,
    runs: Sequence[MotionRun],
    analysis: AnalysisValue,
    prescriptive: Prescriptive,
    floor_m: float,
) -> float:
    """Return the design displacement of a procedure [m]; NaN if a run has no final value."""
    largest_m = max((run.governing.prd_m for run in runs), key=nan_is_worst, default=0.0)
    if math.isnan(largest_m):
        return math.nan
    if route is Route.PRESCRIPTIVE:
        # Runs that do not qualify as an analysis reduce nothing, but one that slides farther than
        # the prescriptive value is not ignored (test_project.py).
        return max(prescriptive.value_m, largest_m)
    # NaN first: max would drop it.
    return max(analysis.value_m, floor_m)
