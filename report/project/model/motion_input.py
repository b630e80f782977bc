"""Motions as requested, the building below them, and their target spectra.

`report.motions.components` loads the motions.
"""

from __future__ import annotations

from typing import Annotated

from pydantic import Field

from report.project.model.choices import (
    AccelUnit,
    Baseline,
    Polarity,
    RecordedAt,
    Scaling,
    StructureType,
)
from report.project.model.values import Frozen, Id, RequiredText, Text
from solver.bounds import ORDINATE
from solver.rules.ac156 import Tail


class MotionInput(Frozen):
    """A roof motion, as requested."""

    id: Id
    record: RequiredText
    transverse: RequiredText | None = None
    vertical: RequiredText | None = None
    units: AccelUnit = AccelUnit.FROM_FILE
    dt_s: Annotated[float | None, Field(gt=0, le=1)] = None
    scaling: Scaling = Scaling.AS_RECORDED
    scale_value: Annotated[float | None, Field(gt=0, le=1000)] = None
    polarity: Polarity = Polarity.BOTH
    source: Text = ""
    recorded_at: RecordedAt = RecordedAt.ROOF
    from_s: Annotated[float | None, Field(ge=0)] = None
    to_s: Annotated[float | None, Field(gt=0)] = None
    baseline: Baseline = Baseline.NONE
    highpass_hz: Annotated[float | None, Field(gt=0, le=100)] = None
    lowpass_hz: Annotated[float | None, Field(gt=0, le=1000)] = None
    order: Annotated[int, Field(ge=2, le=12)] = 4
    new_dt_s: Annotated[float | None, Field(gt=0, le=1)] = None
    pad_s: Annotated[float | None, Field(gt=0, le=600)] = None
    event: Text = ""
    magnitude: Annotated[float | None, Field(ge=3, le=10)] = None
    distance_km: Annotated[float | None, Field(ge=0, le=1000)] = None
    v_s30_mps: Annotated[float | None, Field(ge=50, le=3000)] = None
    drift_by: Text = ""
    drift_source: Text = ""

    @property
    def drift_basis(self) -> str:
        """Who confirms a permanent displacement, and the source; empty unless both are entered."""
        is_stated = self.drift_by and self.drift_source
        return f"{self.drift_by}, {self.drift_source}" if is_stated else ""


Period = Annotated[float, Field(gt=0, le=10)]
Percent = Annotated[float, Field(ge=1, le=50)]


class BuildingInput(Frozen):
    """An elastic building of a few modes; blank if all motions are roof motions."""

    structure: StructureType | None = None
    period_s: Period | None = None
    period_2_s: Period | None = None
    transverse_s: Period | None = None
    damping_percent: Percent = 5.0
    stiffness_ratio: Annotated[float | None, Field(ge=0, le=1000)] = None
    left_out_percent: Annotated[float, Field(ge=0, le=50)] = 5.0


class TargetInput(Frozen):
    """Target spectra at long periods, and the period range over which motions are scaled."""

    tail: Tail = Tail.AC156
    t_l_s: Annotated[float | None, Field(gt=0, le=20)] = None
    from_s: Annotated[float, Field(ge=0.02, le=10)] = 0.2
    to_s: Annotated[float, Field(ge=0.02, le=10)] = 5.0


class SpectrumPoint(Frozen):
    """A point of the project-specific target spectrum."""

    period_s: Annotated[float, Field(ge=0.001, le=1000)]
    horizontal_g: Annotated[float, Field(gt=0, le=ORDINATE.most)]
    vertical_g: Annotated[float | None, Field(gt=0, le=ORDINATE.most)] = None
