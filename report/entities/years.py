"""years.json: what a study says of the life of arrays, which a package may show.

Read `StudyYears`.
"""

from __future__ import annotations

from typing import Final, Literal

from pydantic import BaseModel, ConfigDict

SUPPORTING: Final = "Supporting analysis, not a code value"

FILE = "years.json"


class _Written(BaseModel):
    model_config = ConfigDict(frozen=True, extra="forbid", allow_inf_nan=False)


class LifeYears(_Written):
    """Distances from the installed place [m], by when the array is put back; null for none."""

    put_back: str
    largest_mean_m: float | None
    largest_p95_m: float | None
    largest_beyond_clearance: float
    last_mean_m: float | None
    last_p95_m: float | None
    last_beyond_clearance: float
    without_value: float


class RecurrenceYears(_Written):
    """PRD of a mean recurrence interval with its 16 % and 84 % quantiles [m]; null for none."""

    years: float
    prd_m: float | None
    prd_16_m: float | None
    prd_84_m: float | None


class YearsOfArray(_Written):
    """One array on one building."""

    array: str
    building: str
    slope_deg: float
    mu: float
    clearance_m: float
    clearance_rate: float
    recurrences: tuple[RecurrenceYears, ...]
    lives: tuple[LifeYears, ...]


class StudyYears(_Written):
    """The whole file."""

    note: Literal["Supporting analysis, not a code value"]
    title: str
    date: str
    study: str
    program: str
    site: str
    source: str
    edition: str
    vs30_mps: float
    site_vs30_mps: float
    site_factor: float
    roof_factor: float
    life_years: float
    arrays: tuple[YearsOfArray, ...]
