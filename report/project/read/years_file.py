"""years.json of a study: service-life results of arrays; lengths in meters, null for none."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Annotated, Final, Literal

from pydantic import BaseModel, BeforeValidator, ConfigDict

SUPPORTING: Final = "Supporting analysis, not a code value"
YEARS = "years.json"
# When an array is put back where it was installed.
NEVER, ABOVE, ALWAYS = "never", "above a distance", "after every event"

# JSON has no infinity: a distance without bound is null.
Meters = Annotated[
    float | None, BeforeValidator(lambda v: None if isinstance(v, float) and math.isinf(v) else v)
]


class _Written(BaseModel):
    model_config = ConfigDict(
        frozen=True, extra="forbid", allow_inf_nan=False, from_attributes=True
    )


class Distance(_Written):
    """A distance from the installed location over lives, as in `LifeStatistics`."""

    mean_m: Meters
    p95_m: Meters
    beyond: float
    without_value: float


class YearsOfArray(_Written):
    """One array on one building."""

    array: str
    building: str
    slope_deg: float
    mu: float
    clearance_m: float
    clearance_rate: float
    prd_m: Mapping[str, Meters]  # by mean recurrence interval in years
    largest: Mapping[str, Distance]  # by when the array is put back
    last: Mapping[str, Distance]


class StudyYears(_Written):
    """The whole file."""

    note: Literal["Supporting analysis, not a code value"]
    title: str
    date: str
    study: str  # identity of its manifest
    program: str
    hazard: Mapping[str, str | float | None]  # the cells of the Hazard worksheet
    life_years: float
    arrays: tuple[YearsOfArray, ...]
