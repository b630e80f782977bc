"""Records, motions and runs as they are written and shown.

Computes nothing: see `report.motions`.
"""

from __future__ import annotations

from collections.abc import Mapping
from operator import attrgetter
from typing import Annotated, ClassVar

from report.assessment.runs import MotionRun, OrientedRun
from report.entities.shown import Column, Entity, Number, at, up_column
from report.motions.history import PreparedMotion
from report.project.model.choices import Direction, RecordedAt
from solver.model import Motion, Status
from solver.records.measures import Measures
from solver.sliding.least_model import Model


class RecordResult(Entity):
    """A record as it was read."""

    across: ClassVar[str] = "motion component name format npts dt_s peak_g"

    motion: Annotated[str, at("motion_id"), Column("Motion")]
    component: Annotated[str, Column("Component")]
    name: Annotated[str, Column("Record")]
    format: Annotated[str, Column("Format")]
    notes: tuple[str, ...]
    """What was read or assumed beyond the plain numbers."""
    sha256: Annotated[str, Column("SHA-256")]
    npts: Annotated[int, Column("Samples")]
    dt_s: Annotated[float, Column("Time step [s]")]
    peak_g: Annotated[float, Column("Peak [g]")]


class RoofResult(Entity):
    """A component of a ground motion, carried to the roof."""

    words: Annotated[str, at("building.words")]
    """The building in words."""
    n_modes: int
    """Number of modes included."""
    next_mode_share: Annotated[float, at("next_share")]
    """Contribution of the first neglected mode / peak at the roof."""
    left_out_share: float
    """Contribution of all neglected modes / peak at the roof."""
    ground_peak_mps2: float
    """Peak acceleration at the ground."""
    roof_peak_mps2: float
    """Peak acceleration at the roof."""
    pad_s: float
    """Free vibration after the end of the ground record."""


class MotionResult(Entity):
    """A motion as it was run."""

    id: Annotated[str, Column("Motion")]
    recorded_at: Annotated[RecordedAt, Column("Recorded at")]
    processing: Annotated[str, at("done"), Column("Processing")]
    scaling: Annotated[str, Column("Scaling")]
    scale: Annotated[float, Column("Factor")]
    dt_s: float
    """Time step."""
    npts: int
    """Number of samples."""
    components: Annotated[Mapping[str, Measures], at("measures")]
    """Measures of each component."""
    building: Annotated[Mapping[str, RoofResult], at("roof")]
    """How each component was carried to the roof; empty for roof motions."""


def motion_result(motion: Motion, prepared: PreparedMotion) -> MotionResult:
    """Return a motion."""
    return MotionResult.of(
        prepared, id=motion.id, scale=motion.scale, dt_s=motion.dt_s, npts=len(motion.ax_mps2)
    )


def _model_words(rung: int) -> str:
    return f"{rung}, {Model(rung).title}"


class PeakResult(Entity):
    """The largest displacements of an array in all runs of a motion, by direction."""

    motion: Annotated[str, Column("Motion")]
    down_m: Annotated[Number, up_column("Downslope [in]", 1, "=MAX({runs.down_m})")]
    up_m: Annotated[Number, up_column("Upslope [in]", 1, "=MAX({runs.up_m})")]
    across_m: Annotated[Number, up_column("Cross-slope [in]", 1, "=MAX({runs.across_m})")]
    any_m: Annotated[Number, up_column("Any direction [in]", 1, "=MAX({runs.prd_m})")]


class OrientedResult(Entity):
    """A motion with one component along the slope, in one polarity."""

    motion: Annotated[str, Column("Motion")]
    along: Annotated[str, at("orientation.component"), Column("Component along slope")]
    polarity: Annotated[
        int,
        at("orientation.polarity"),
        Column("Polarity", value=lambda sign: "as recorded" if sign > 0 else "reversed"),
    ]
    """1 as recorded, -1 reversed."""


class RunResult(OrientedResult):
    """An array under a motion with one component along the slope, in one polarity."""

    scale: Annotated[float, at("scene.scale"), Column("Scale")]
    dt_s: Annotated[float, at("scene.dt_s")]
    """Time step."""
    status: Annotated[Status, at("result.status"), Column("Outcome", value=attrgetter("sentence"))]
    prd_m: Annotated[Number, at("result.prd_m"), Column("PRD [in]"), Column("PRD [mm]")]
    """Peak relative displacement in plan; null without a final value."""
    residual_m: Annotated[
        Number, at("result.residual_m"), Column("Residual [in]"), Column("Residual [mm]")
    ]
    down_m: Annotated[Number, at("result.down_m"), Column("Downslope [in]")]
    up_m: Annotated[Number, at("result.up_m"), Column("Upslope [in]")]
    across_m: Annotated[Number, at("result.across_m"), Column("Cross-slope [in]")]
    residual_across_m: Annotated[
        Number, at("result.residual_across_m"), Column("Residual cross-slope [in]")
    ]
    t_prd_s: Annotated[Number, at("result.t_prd_s"), Column("Time of PRD [s]")]
    n_stops: Annotated[int, at("result.n_stops"), Column("Stops")]
    n_min_g: Annotated[Number, at("result.n_min_g"), Column("Minimum N/(m g)")]
    """Least normal force / weight."""
    t_uplift_s: Annotated[Number, at("result.t_uplift_s")]
    """Time of the first uplift; null without uplift."""
    end_speed_mps: Annotated[Number, at("result.end_speed_mps")]
    """Sliding velocity at the end of the record."""
    peak_speed_mps: Annotated[
        Number, at("result.peak_speed_mps"), Column("Largest velocity [in/s]")
    ]
    error_m: Annotated[Number, at("result.error_m"), Column("Error bound [in]")]
    rung: Annotated[int, at("solution.model"), Column("Model", value=_model_words)]
    """Number of the model used, from 0, no slip, to 5, a row of linked blocks."""
    model: Annotated[str, at("solution.model.title")]
    """Model used, in words."""
    reason: Annotated[str, at("solution.reason"), Column("Reason")]
    next_rung: Annotated[int, at("solution.next_model"), Column("Next model", value=_model_words)]
    """Number of the next model, run to see its effect; that of this one if none is."""
    next_effect_m: Annotated[
        Number, at("solution.next_effect_m"), Column("Effect of next model [in]")
    ]
    friction_demand: Annotated[Number, at("solution.friction_demand"), Column("Friction demand")]
    """Required friction coefficient: largest shear over normal force without slip."""


def peak_result(motion: MotionRun) -> PeakResult:
    """Return the peaks of a motion."""
    # No attribute has them: they are of all runs, by direction.
    peaks = {f"{direction.value}_m": motion.peak_m(direction) for direction in Direction}
    return PeakResult.model_validate({"motion": motion.motion.id} | peaks)


def run_result(motion: MotionRun, run: OrientedRun) -> RunResult:
    """Return a run of a motion."""
    return RunResult.of(run, motion=motion.motion.id)
