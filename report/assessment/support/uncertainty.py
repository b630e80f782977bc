"""Effect of uncertain inputs: friction, orientation of shaking, sign of the vertical component.

How far may friction fall before a clearance is not satisfied? From 0.50 on, 0.45, 0.40 … are tried
in the governing orientations until it fails, then hundredths; the last value that all runs confirm
is the margin.

Runs the solver and collects numbers; `report.pages.accuracy` prints them. Read `uncertainty`.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import partial

from report.assessment.assessment import Assessment
from report.assessment.design.arrays import ArrayAssessment
from report.assessment.design.clearances import ClearanceCheck
from report.assessment.remedies.friction_search import (
    Trials,
    below,
    check_alone,
    involved,
    is_final,
    search,
    trials_of,
)
from report.runs import MotionRun, run_motion, run_oriented
from report.text.units import nan_is_worst
from solver.model import HorizontalComponent, Orientation, SlideResult
from solver.records.record import read_only

# Fraction of the given friction coefficient down to which the margins are searched.
LOWEST_SHARE = 0.5


@dataclass(frozen=True, slots=True, kw_only=True)
class Margin:
    """How far the friction of one array may fall before a clearance is not satisfied."""

    number: int  # of the clearance in the workbook, from 1
    gap: ClearanceCheck
    array: ArrayAssessment
    # smallest coefficient at which all runs satisfy; NaN if the one given does not
    minimum_mu: float
    required_m: float  # required separation at it, for this array alone [m]
    limited_by: str  # what is not satisfied with 0.01 less, or that the search ends there
    lowest_tried: float  # where the search ends

    @property
    def is_beyond(self) -> bool:
        """Whether the search ended before the clearance failed."""
        return self.minimum_mu == self.lowest_tried


def margins(assessment: Assessment) -> Iterator[Margin]:
    """Yield for each clearance a margin of each array that it involves."""
    trials = trials_of(assessment)
    for number, gap in enumerate(assessment.clearances, start=1):
        for array in involved(assessment, gap.clearance):
            yield _margin(trials[array.id], number, gap)


def _margin(trials: Trials, number: int, gap: ClearanceCheck) -> Margin:
    """Walk down in the governing orientations; from the last value that all runs confirm in all."""
    row, array = gap.clearance, trials.array
    as_given = check_alone(trials.assessment, array.id, array.displacement, row)
    minimum_mu, required, limited_by, mu = math.nan, math.nan, "—", array.array.mu
    # Less rounding error: half of 0.14 in hundredths is 7.000000000000001.
    lowest = math.ceil(100.0 * LOWEST_SHARE * mu - 1e-6)
    if as_given.ok and is_final(array):
        minimum_mu, required, limited_by = mu, as_given.required_m, "search"
        start = below(mu)
        satisfied = (
            search(lambda k: trials.may_satisfy(row, mu=k), start, lowest)
            if start >= lowest > 0
            else ()
        )
        # The governing orientations refute at a quarter of the runs; only all of them confirm.
        confirmed = next((k for k in reversed(satisfied) if trials.satisfies(row, mu=k)), 0)
        while confirmed > lowest and trials.satisfies(row, mu=confirmed - 1):
            confirmed -= 1
        if confirmed:
            minimum_mu, required = confirmed / 100, trials.required_m(row, mu=confirmed)
        if lowest < (following := confirmed or start + 1):
            limited_by = trials.failure(row, mu=following - 1)
    return Margin(
        number=number,
        gap=gap,
        array=array,
        minimum_mu=minimum_mu,
        required_m=required,
        limited_by=limited_by,
        lowest_tried=lowest / 100,
    )


# Angles of the horizontal pair that the design runs do not have: those are multiples of 90.
ANGLES_DEG = tuple(k * 22.5 for k in range(16) if k % 4)


@dataclass(frozen=True, slots=True, kw_only=True)
class RotatedRun:
    """The governing motion with its horizontal pair rotated in plan from the record axes."""

    angle_deg: float
    result: SlideResult


@dataclass(frozen=True, slots=True, kw_only=True)
class Uncertainty:
    """Margins and confidence of the design values."""

    margins: tuple[Margin, ...]  # for each clearance, one for each array that it involves
    motion: MotionRun  # the governing motion of the governing array, as run for the package
    turned: tuple[RotatedRun, ...]  # empty for a motion with one horizontal component
    # largest PRD with the vertical component reversed, over the orientations of the package [m];
    # NaN without a vertical component or without a displacement
    reversed_m: float

    @property
    def used_m(self) -> float:
        """PRD of the governing motion in the package [m]."""
        return self.motion.governing.result.prd_m

    @property
    def worst(self) -> RotatedRun:
        """The rotated run with the largest PRD; at least one must exist."""
        return max(self.turned, key=lambda run: nan_is_worst(run.result.prd_m))


def uncertainty(assessment: Assessment) -> Uncertainty | None:
    """Return the sensitivity of the governing array and every clearance to uncertain inputs."""
    if not assessment.has_motions:
        return None
    governing = assessment.governing
    motion = governing.worst
    angles = ANGLES_DEG if motion.motion.has_transverse else ()
    return Uncertainty(
        margins=tuple(margins(assessment)),
        motion=motion,
        turned=tuple(assessment.runs.map(partial(_turned, governing), angles)),
        reversed_m=_reversed_m(governing),
    )


def _turned(array: ArrayAssessment, angle_deg: float) -> RotatedRun:
    motion, angle = array.worst.motion, math.radians(angle_deg)
    cs, sn = math.cos(angle), math.sin(angle)
    along = cs * motion.ax_mps2 - sn * motion.ay_mps2
    across = sn * motion.ax_mps2 + cs * motion.ay_mps2
    turned = replace(motion, ax_mps2=read_only(along), ay_mps2=read_only(across))
    # One orientation: the other polarity is the angle 180 degrees farther.
    run = run_oriented(
        array.array, turned, Orientation(component=HorizontalComponent.RECORD, polarity=1)
    )
    return RotatedRun(angle_deg=angle_deg, result=run.result)


def _reversed_m(array: ArrayAssessment) -> float:
    motion = array.worst.motion
    if not motion.has_vertical:
        return math.nan
    mirrored = replace(motion, az_mps2=read_only(-motion.az_mps2))
    return run_motion(array.array, mirrored).governing.result.prd_m
