"""Records and motions as they are written and shown.

Computes nothing: see `report.motions`.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Annotated, ClassVar

from report.entities.cells import Column
from report.entities.shown import Entity, at
from report.motions.history import PreparedMotion
from report.sheet.schema.choices import RecordedAt
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
