"""A run of an array under a motion as it is written and shown, and the peaks of a motion.

Computes nothing: see `report.assessment.runs`. Read `RunResult`.
"""

from __future__ import annotations

from typing import Annotated

from report.assessment.runs import MotionRun, OrientedRun
from report.entities.shown import Entity, Number, at
from report.sheet.schema import Direction
from solver.model import Status


class PeakResult(Entity):
    """The largest displacements of an array in all runs of a motion, by direction."""

    motion: str
    down_m: Number
    up_m: Number
    across_m: Number
    any_m: Number


class RunResult(Entity):
    """An array under a motion with one component along the slope, in one polarity."""

    motion: str
    along: Annotated[str, at("orientation.component")]
    polarity: Annotated[int, at("orientation.polarity")]
    scale: float
    dt_s: float
    status: Annotated[Status, at("result.status")]
    prd_m: Annotated[Number, at("result.prd_m")]
    residual_m: Annotated[Number, at("result.residual_m")]
    down_m: Annotated[Number, at("result.down_m")]
    up_m: Annotated[Number, at("result.up_m")]
    across_m: Annotated[Number, at("result.across_m")]
    residual_across_m: Annotated[Number, at("result.residual_across_m")]
    t_prd_s: Annotated[Number, at("result.t_prd_s")]
    n_stops: Annotated[int, at("result.n_stops")]
    n_min_g: Annotated[Number, at("result.n_min_g")]
    t_uplift_s: Annotated[Number, at("result.t_uplift_s")]
    end_speed_mps: Annotated[Number, at("result.end_speed_mps")]
    peak_speed_mps: Annotated[Number, at("result.peak_speed_mps")]
    error_m: Annotated[Number, at("result.error_m")]
    rung: Annotated[int, at("solution.model")]
    model: Annotated[str, at("solution.model.title")]
    reason: Annotated[str, at("solution.reason")]
    next_rung: Annotated[int, at("solution.next_model")]
    next_effect_m: Annotated[Number, at("solution.next_effect_m")]
    friction_demand: Annotated[Number, at("solution.friction_demand")]


def peak_result(motion: MotionRun) -> PeakResult:
    """Return the peaks of a motion."""
    peaks = {f"{direction.value}_m": motion.peak_m(direction) for direction in Direction}
    return PeakResult.model_validate({"motion": motion.motion.id} | peaks)


def run_result(motion: MotionRun, run: OrientedRun) -> RunResult:
    """Return a run of a motion."""
    about = motion.motion
    return RunResult.of(run, motion=about.id, scale=about.scale, dt_s=about.dt_s)
