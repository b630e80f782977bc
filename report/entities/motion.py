"""Records and motions as they are written and shown.

Computes nothing: see `report.motions`.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Annotated, ClassVar

from report.entities.cells import column
from report.entities.shown import Entity, at
from report.motions.history import PreparedMotion
from report.sheet.schema import RecordedAt
from solver.model import Motion
from solver.records.measures import Measures


class RecordResult(Entity):
    """A record as it was read."""

    across: ClassVar[str] = "motion component name format npts dt_s peak_g"

    motion: Annotated[str, at("motion_id"), column("Motion")]
    component: Annotated[str, column("Component")]
    name: Annotated[str, column("Record")]
    format: Annotated[str, column("Format")]
    notes: tuple[str, ...]
    sha256: Annotated[str, column("SHA-256")]
    npts: Annotated[int, column("Samples")]
    dt_s: Annotated[float, column("Time step [s]")]
    peak_g: Annotated[float, column("Peak [g]")]


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

    id: Annotated[str, column("Motion")]
    recorded_at: Annotated[RecordedAt, column("Recorded at")]
    processing: Annotated[str, at("done"), column("Processing")]
    scaling: Annotated[str, column("Scaling")]
    scale: Annotated[float, column("Factor")]
    dt_s: float
    npts: int
    components: Annotated[Mapping[str, Measures], at("measures")]
    building: Annotated[Mapping[str, RoofResult], at("roof")]


def motion_result(motion: Motion, prepared: PreparedMotion) -> MotionResult:
    """Return a motion."""
    return MotionResult.of(
        prepared, id=motion.id, scale=motion.scale, dt_s=motion.dt_s, npts=len(motion.ax_mps2)
    )
