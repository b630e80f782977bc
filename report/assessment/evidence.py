"""Supporting results that only the package prints, each computed once.

Draws nothing. Read `support`; `report.pages` prints it.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial

from report.assessment.arrays import ArrayAssessment, Displacement
from report.assessment.assess import reassess
from report.assessment.checks.check import Check
from report.assessment.checks.limits import of_limit
from report.assessment.clearances import ClearanceCheck, by_id, with_displacements
from report.assessment.friction import InputCase, with_friction
from report.assessment.project import Assessment
from report.assessment.remedies import Remedies, remedies
from report.assessment.routes import Route, statistic_basis
from report.assessment.spectra import Spectra, spectra
from report.assessment.uncertainty import Uncertainty, uncertainty
from report.assessment.verdict import SHIFT
from report.motions.history import PreparedMotion, first_period_s, through_building
from report.project.model import ProjectInput
from report.project.model.choices import Direction
from report.project.model.motions import BuildingInput, MotionInput
from report.project.model.scene import Array
from report.runs import MotionRun, run_motion
from report.text.units import nan_is_worst, number
from solver.building.structure import MOST_PERIOD_S
from solver.model import SlideHistory
from solver.rules.provisions import (
    AnalysisValue,
    analysis_floor_m,
    analysis_value,
    review_lifts_slope,
)


@dataclass(frozen=True, slots=True, kw_only=True)
class Accuracy:
    """The design with the friction coefficients decreased by 5 %, as given, and increased."""

    at_reduced_friction: Assessment
    entered: Assessment
    at_increased_friction: Assessment

    @property
    def newly_short(self) -> tuple[ClearanceCheck, ...]:
        """Clearances that are satisfied as given but not with less friction."""
        pairs = zip(self.entered.clearances, self.at_reduced_friction.clearances, strict=True)
        return tuple(after for before, after in pairs if before.ok and not after.ok)

    @property
    def newly_limited(self) -> tuple[Check, ...]:
        """Limits of the routes taken that are satisfied as given but not with less friction."""
        pairs = zip(self.entered.arrays, self.at_reduced_friction.arrays, strict=True)
        return tuple(
            of_limit(check, after.id)
            for before, after in pairs
            if all(check.ok for check in before.limits.required)
            # With less friction another route may be taken, whose limits are other ones.
            for check in replace(after.limits, route=before.route).required
            if not check.ok
        )


def accuracy(assessment: Assessment) -> Accuracy:
    """Run all arrays with changed friction."""
    return Accuracy(
        at_reduced_friction=assessment.at_reduced_friction
        or reassess(assessment, with_friction(assessment.project, 1.0 - SHIFT)),
        entered=assessment,
        at_increased_friction=reassess(assessment, with_friction(assessment.project, 1.0 + SHIFT)),
    )


PERIOD_FACTORS = (0.8, 1.2)
DAMPING_PERCENT = (2.0, 3.0, 5.0, 7.0)


Variations = Sequence[tuple[BuildingInput, AnalysisValue]]
"""The building as used and with other periods and damping, each with its value from analysis."""


def building_variations(assessment: Assessment) -> Variations:
    """Return the building as used, then each variation, with the governing array's value."""
    data, array, prepared = assessment.project, assessment.governing, assessment.shaking.prepared
    if not any(item.roof for item in prepared):
        return ()
    used = data.building.model_copy(update={"period_s": first_period_s(data)})
    variations = [(used, array.analysis)]
    for building in _others(used):
        other = data.model_copy(update={"building": building})
        rows = zip(data.motions, prepared, strict=True)
        peaks_m = assessment.runs.map(partial(_prd_m, array.array, other), rows)
        value = analysis_value(assessment.rules, peaks_m, statistic_basis(data))
        variations.append((building, value))
    return tuple(variations)


def _others(used: BuildingInput) -> Iterator[BuildingInput]:
    periods_s = used.model_dump(
        include={"period_s", "period_2_s", "transverse_s"}, exclude_none=True
    )
    for factor in PERIOD_FACTORS:
        scaled = {name: min(factor * s, MOST_PERIOD_S) for name, s in periods_s.items()}
        yield used.model_copy(update=scaled)
    for percent in DAMPING_PERCENT:
        if percent != used.damping_percent:
            yield used.model_copy(update={"damping_percent": percent})


def _prd_m(array: Array, data: ProjectInput, of: tuple[MotionInput, PreparedMotion]) -> float:
    row, prepared = of
    return run_motion(array, through_building(data, row, prepared)).peak_m(Direction.ANY)


def building_case(assessment: Assessment, variations: Variations) -> InputCase | None:
    """Return the governing array with the period or damping that lets it slide farthest, if any."""
    array = assessment.governing
    # Such a design displacement does not follow from one value of the analysis.
    if not variations or array.route is not Route.ANALYSIS:
        return None
    (used, _), *others = variations
    building, value = max(others, key=lambda pair: nan_is_worst(pair[1].value_m))
    design_m = math.nan if math.isnan(value.value_m) else max(value.value_m, array.floor_m)
    if not nan_is_worst(design_m) > array.design_m:
        return None
    is_damping = building.damping_percent != used.damping_percent
    changed = (
        f"{number(building.damping_percent, 1)} % damping of the building"
        if is_damping
        else f"{number(building.period_s or math.nan, 2)} s as the period of the building"
    )
    farther = replace(array, analysis=value, design_m=design_m)
    slides = {array.id: farther.displacement}
    given = assessment.gaps_of(array.id)
    gaps = [with_displacements(assessment, slides, gap) for gap in given]
    return InputCase(array=farther, changed=changed, gaps=gaps)


def cases(assessment: Assessment, variations: Variations) -> Iterator[InputCase]:
    """Yield what would change the verdict on an array or exceed its prescriptive displacement."""
    slow = assessment.low_velocity
    by_velocity = (slow.case_of(item.id) for item in slow.arrays)
    for case in filter(None, (*by_velocity, building_case(assessment, variations))):
        now = by_id(assessment.arrays, case.array.id)
        most_m = case.array.prescriptive.value_m
        is_short = bool(case.short) and any(gap.ok for gap in assessment.gaps_of(now.id))
        is_short = is_short or (case.array.lacks_slack and not now.lacks_slack)
        if is_short or now.design_m <= most_m < nan_is_worst(case.array.design_m):
            yield case


@dataclass(frozen=True, slots=True, kw_only=True)
class Beyond:
    """One array under one motion, with the high-pass as run and without it [m]."""

    motion_id: str
    corner_hz: float
    filtered_m: float
    unfiltered_m: float

    @property
    def share(self) -> float:
        """Fraction of the PRD without high-pass that the filter removes; NaN without sliding."""
        if not self.unfiltered_m > 0.0:
            return math.nan
        return (self.unfiltered_m - self.filtered_m) / self.unfiltered_m


def beyond_corners(assessment: Assessment) -> tuple[Beyond, ...]:
    """Rerun the governing array without high-pass under every motion that has one."""
    rows, governing = assessment.project.motions, assessment.governing
    corners = {row.id: row.highpass_hz or math.nan for row in rows}
    as_run_m = {run.motion.id: run.governing.prd_m for run in governing.motions}
    return tuple(
        Beyond(
            motion_id=bare.id,
            corner_hz=corners[bare.id],
            filtered_m=as_run_m[bare.id],
            unfiltered_m=run_motion(governing.array, bare).governing.prd_m,
        )
        for prepared in assessment.shaking.prepared
        for bare in prepared.unfiltered
    )


@dataclass(frozen=True, slots=True, kw_only=True)
class Cumulative:
    """Sums for one array: the PRD of the design event and of each smaller one, by motion."""

    array: ArrayAssessment
    # However the events follow each other, and whatever their directions, the array is nowhere
    # farther from where it began than this.
    sums_m: Mapping[str, float]  # by motion [m]; NaN where a run has no final displacement

    @property
    def mean_m(self) -> float:
        """Mean of the sums [m]; NaN if a motion has none."""
        return math.fsum(self.sums_m.values()) / len(self.sums_m)

    @property
    def largest_m(self) -> float:
        """Largest of the sums [m]; NaN if a motion has none."""
        return max(self.sums_m.values()) if not math.isnan(self.mean_m) else math.nan


def cumulative(assessment: Assessment) -> tuple[Cumulative, ...]:
    """Return the sums of every array; none without motions, or where no smaller event is named."""
    factors = assessment.project.options.smaller_factors
    if not (factors and assessment.has_motions):
        return ()
    return tuple(
        Cumulative(
            array=array,
            sums_m={run.motion.id: _sum_m(array, run, factors) for run in array.motions},
        )
        for array in assessment.arrays
    )


def _sum_m(array: ArrayAssessment, run: MotionRun, factors: tuple[float, ...]) -> float:
    # Equal events have equal PRDs: each factor is run once.
    smaller = {
        factor: run_motion(
            array.array, replace(run.motion, scale=factor * run.motion.scale)
        ).governing.prd_m
        for factor in set(factors)
    }
    return math.fsum([run.governing.prd_m, *(smaller[factor] for factor in factors)])


@dataclass(frozen=True, slots=True, kw_only=True)
class Evidence:
    """Results that support an assessment."""

    spectra: tuple[Spectra, ...]
    # for each group of arrays that share runs, the governing run of each motion; all NaN where it
    # has no displacement
    histories: tuple[tuple[SlideHistory, ...], ...]
    accuracy: Accuracy  # the design with changed friction
    # effect of the high-pass of each motion on the slip of the governing array
    highpass: tuple[Beyond, ...]
    remedies: Remedies  # what would satisfy each check that is NG, and all of them
    # margins in friction, and directions of shaking that are not run; none without motions
    uncertainty: Uncertainty | None
    cumulative: tuple[Cumulative, ...]  # for each array, if the workbook names smaller events
    building: Variations
    cases: tuple[InputCase, ...]  # other inputs that would change a verdict or the route


def histories(assessment: Assessment) -> tuple[tuple[SlideHistory, ...], ...]:
    """Return the governing run of each motion at its samples, for arrays that share runs once."""
    return tuple(tuple(run.history() for run in group[0].motions) for group in assessment.alike)


def support(assessment: Assessment) -> Evidence:
    """Compute the results that support an assessment."""
    building = building_variations(assessment)
    return Evidence(
        spectra=spectra(assessment),
        histories=histories(assessment),
        accuracy=accuracy(assessment),
        highpass=beyond_corners(assessment),
        remedies=remedies(assessment),
        uncertainty=uncertainty(assessment),
        cumulative=cumulative(assessment),
        building=building,
        cases=tuple(cases(assessment, building)),
    )


@dataclass(frozen=True, slots=True, kw_only=True)
class Saving:
    """The least design displacement that an analysis may give, and what it would satisfy."""

    lacks: Sequence[str]  # limits that the motions miss, in words; none without motions
    ids: Sequence[str]  # arrays that may be analyzed, and are not
    others: Sequence[str]  # arrays on roofs that are too steep for it
    is_lifted_by_review: bool  # whether these may be analyzed with peer review
    prescriptive_m: float
    floor_m: float  # without peer review
    n_short: int  # clearances that are not satisfied now
    n_satisfied: int  # of them, with the arrays that may be analyzed at the floor


def saving(assessment: Assessment) -> Saving:
    """Return what an analysis could save, of a project without motions that permit one."""
    first = assessment.arrays[0]  # the prescriptive displacement is the same for every array
    floor_m = analysis_floor_m(assessment.rules, first.prescriptive)
    without = [item for item in assessment.arrays if item.route is Route.PRESCRIPTIVE]
    ids = [item.id for item in without if item.limits.may_be_analyzed]
    at_floor = dict.fromkeys(ids, Displacement(floor_m))
    short = [gap for gap in assessment.clearances if not gap.ok]
    checks = [with_displacements(assessment, at_floor, gap) for gap in short]
    return Saving(
        lacks=assessment.against_analysis(first) if assessment.has_motions else [],
        ids=ids,
        others=[item.id for item in without if not item.limits.may_be_analyzed],
        is_lifted_by_review=review_lifts_slope(assessment.rules, assessment.project.site.sdc),
        prescriptive_m=first.prescriptive.value_m,
        floor_m=floor_m,
        n_short=len(short),
        n_satisfied=sum(check.ok for check in checks),
    )
