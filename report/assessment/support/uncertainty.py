"""What is not known exactly: friction, directions of shaking that are not run, the vertical's sign.

Runs the solver and collects numbers; `report.pages.accuracy` prints them. Read `uncertainty`.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from functools import partial

from report.assessment.assessment import Assessment
from report.assessment.design.arrays import ArrayAssessment
from report.assessment.support.margins import Margin, margins
from report.runs import MotionRun, run_motion, run_oriented
from report.text.units import nan_is_worst
from solver.model import HorizontalComponent, Orientation, SlideResult
from solver.records.record import read_only

# Angles of the horizontal pair that the design runs do not have: those are multiples of 90.
ANGLES_DEG = tuple(k * 22.5 for k in range(16) if k % 4)


@dataclass(frozen=True, slots=True, kw_only=True)
class RotatedRun:
    """The governing motion with its horizontal pair turned in plan, from the record's own axes."""

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
        """The turned run with the largest PRD; there must be one."""
        return max(self.turned, key=lambda run: nan_is_worst(run.result.prd_m))


def uncertainty(assessment: Assessment) -> Uncertainty | None:
    """Return how the governing array and every clearance react to what is not known exactly."""
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
