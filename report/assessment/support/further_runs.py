"""Additional runs: without high-pass filter, smaller events, other building properties.

A PRD of 0.42 m with the high-pass and 0.50 m without: the filter removes 16%. A design event with
0.40 m and a smaller one with 0.10 m add up to 0.50 m.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial
from itertools import chain

from report.assessment.assessment import Assessment
from report.assessment.design.arrays import ArrayAssessment
from report.assessment.design.routes import statistic_basis
from report.motions.history import PreparedMotion, first_period_s, through_building
from report.project.model import ProjectInput
from report.project.model.array import Array
from report.project.model.choices import Direction
from report.project.model.motion_input import BuildingInput, MotionInput
from report.runs import MotionRun, run_motion
from solver.building.structure import MOST_PERIOD_S
from solver.rules.provisions import AnalysisValue, analysis_value


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
    unfiltered = chain.from_iterable(motion.unfiltered for motion in assessment.shaking.prepared)
    return tuple(
        Beyond(
            motion_id=motion.id,
            corner_hz=corners[motion.id],
            filtered_m=as_run_m[motion.id],
            unfiltered_m=run_motion(governing.array, motion).governing.prd_m,
        )
        for motion in unfiltered
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
    """Return the sums of every array; none without motions or smaller events."""
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


PERIOD_FACTORS = (0.8, 1.2)


DAMPING_PERCENT = (2.0, 3.0, 5.0, 7.0)


Variations = Sequence[tuple[BuildingInput, AnalysisValue]]
"""The building as used and with other periods and damping, each with its value from analysis."""


def building_variations(assessment: Assessment) -> Variations:
    """Return the building as used, then each variation, with the governing array's value."""
    data, array, prepared = assessment.project, assessment.governing, assessment.shaking.prepared
    if not any(item.roof for item in prepared):
        return ()
    # With its period even where the structure type gives it: the variations multiply it.
    used = data.building.model_copy(update={"period_s": first_period_s(data)})
    variations = [(used, array.analysis)]
    for building in _others(used):
        varied = data.model_copy(update={"building": building})
        rows = zip(data.motions, prepared, strict=True)
        peaks_m = assessment.runs.map(partial(_prd_m, array.array, varied), rows)
        value = analysis_value(assessment.rules, peaks_m, statistic_basis(data))
        variations.append((building, value))
    return tuple(variations)


def _others(used: BuildingInput) -> Iterator[BuildingInput]:
    periods_s = used.model_dump(
        include={"period_s", "period_2_s", "transverse_s"}, exclude_none=True
    )
    for factor in PERIOD_FACTORS:
        # All periods by one factor: a softer building is softer in each mode and direction.
        scaled = {name: min(factor * s, MOST_PERIOD_S) for name, s in periods_s.items()}
        yield used.model_copy(update=scaled)
    for percent in DAMPING_PERCENT:
        if percent != used.damping_percent:
            yield used.model_copy(update={"damping_percent": percent})


def _prd_m(array: Array, data: ProjectInput, motion: tuple[MotionInput, PreparedMotion]) -> float:
    row, prepared = motion
    return run_motion(array, through_building(data, row, prepared)).peak_m(Direction.ANY)
