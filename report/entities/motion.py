"""Records and motions as they are written and shown.

Computes nothing: see `report.motions`.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Annotated, ClassVar

from report.entities.cells import Column
from report.entities.shown import Entity, at
from report.motions.history import PreparedMotion
from report.sheet.schema import RecordedAt
from solver.model import Motion
from solver.records.measures import Measures


class RecordResult(Entity):
    """A record as it was read."""

    across: ClassVar[str] = "motion component name format npts dt_s peak_g"

    motion: Annotated[str, at("motion_id"), Column("Motion")]
    component: Annotated[str, Column("Component")]
    name: Annotated[str, Column("Record")]
    format: Annotated[str, Column("Format")]
    notes: tuple[str, ...]
    sha256: Annotated[str, Column("SHA-256")]
    npts: Annotated[int, Column("Samples")]
    dt_s: Annotated[float, Column("Time step [s]")]
    peak_g: Annotated[float, Column("Peak [g]")]


class RoofResult(Entity):
    """A component of a ground motion, carried to the roof."""

    words: Annotated[str, at("building.words")]
    n_modes: int
    next_mode_share: Annotated[float, at("next_share")]
    left_out_share: float
    ground_peak_mps2: float
    roof_peak_mps2: float
    pad_s: float


class MotionResult(Entity):
    """A motion as it was run."""

    id: Annotated[str, Column("Motion")]
    recorded_at: Annotated[RecordedAt, Column("Recorded at")]
    processing: Annotated[str, at("done"), Column("Processing")]
    scaling: Annotated[str, Column("Scaling")]
    scale: Annotated[float, Column("Factor")]
    dt_s: float
    npts: int
    components: Annotated[Mapping[str, Measures], at("measures")]
    building: Annotated[Mapping[str, RoofResult], at("roof")]


def motion_result(motion: Motion, prepared: PreparedMotion) -> MotionResult:
    """Return a motion."""
    return MotionResult.of(
        prepared, id=motion.id, scale=motion.scale, dt_s=motion.dt_s, npts=len(motion.ax_mps2)
    )
