"""Records and motions as they are written and shown.

Computes nothing: see `report.motions`.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Annotated

from report.entities.shown import Entity, at
from report.motions.history import PreparedMotion
from report.sheet.schema import RecordedAt
from solver.model import Motion
from solver.records.measures import Measures


class RecordResult(Entity):
    """A record as it was read."""

    motion: Annotated[str, at("motion_id")]
    component: str
    name: str
    format: str
    notes: tuple[str, ...]
    sha256: str
    npts: int
    dt_s: float
    peak_g: float


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

    id: str
    recorded_at: RecordedAt
    processing: Annotated[str, at("done")]
    scaling: str
    scale: float
    dt_s: float
    npts: int
    components: Annotated[Mapping[str, Measures], at("measures")]
    building: Annotated[Mapping[str, RoofResult], at("roof")]


def motion_result(motion: Motion, prepared: PreparedMotion) -> MotionResult:
    """Return a motion."""
    return MotionResult.of(
        prepared, id=motion.id, scale=motion.scale, dt_s=motion.dt_s, npts=len(motion.ax_mps2)
    )
