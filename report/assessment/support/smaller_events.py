"""Sums of the displacements of the design event and of smaller ones."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace

from report.assessment.assessment import Assessment
from report.assessment.design.arrays import ArrayAssessment
from report.runs import MotionRun, run_motion


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
