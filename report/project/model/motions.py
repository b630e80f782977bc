"""The roof motions, the building below them, their target spectra, and rows of linked blocks.

Read `report.project.model` first. `report.motions.components` loads the motions.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Annotated

from pydantic import Field

from report.project.model.choices import (
    AccelUnit,
    Baseline,
    Id,
    Polarity,
    Positive,
    RecordedAt,
    RequiredText,
    Scaling,
    StructureType,
    Text,
    decimals,
)
from report.project.model.frozen import Frozen
from report.text.units import G_MPS2
from solver.bounds import ORDINATE
from solver.friction_tests import MOST_MU
from solver.rules.hazard import Tail

if TYPE_CHECKING:
    from solver.sliding.row import BlockRow


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
        """Who states by what that a permanent displacement is real; empty unless both are given."""
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


# Fewest and most blocks of a row.
BLOCKS = (2, 20)


def coefficients(text: str) -> tuple[float, ...]:
    """Return the numbers of a list such as `0.40, 0.45, 0.50`; empty if the text is not one."""
    mus = decimals(text)
    return mus if BLOCKS[0] <= len(mus) <= BLOCKS[1] and max(mus) <= MOST_MU else ()


class Links(Frozen):
    """An array as a row of linked blocks of equal weight along the slope."""

    array: Id
    friction: Annotated[str, Field(min_length=1, max_length=200)]
    stiffness_n_per_m: Positive
    damping_ratio: Annotated[float, Field(ge=0, le=1)] = 0.0

    @property
    def mus(self) -> tuple[float, ...]:
        """Friction coefficient of each block, from the upslope end."""
        return coefficients(self.friction)

    def row(self, weight_n: float) -> BlockRow:
        """Return the row of an array of some weight [N]."""
        from solver.sliding.row import BlockRow  # loads the compiler, and a workbook needs none

        stiffness = self.stiffness_n_per_m * len(self.mus) * G_MPS2 / weight_n
        damping = 2.0 * self.damping_ratio * math.sqrt(stiffness)
        return BlockRow(mus=self.mus, stiffness_per_s2=stiffness, damping_per_s=damping)
