"""A ballasted array that moves as one block, or as a row of linked blocks."""

from __future__ import annotations

import math
from functools import lru_cache
from typing import TYPE_CHECKING, Annotated

from pydantic import Field

from report.project.model.choices import SlopeUnit
from report.project.model.input_rows import InputRow
from report.project.model.shapes import Placed, Shape
from report.project.model.values import (
    Frozen,
    Id,
    NotNegative,
    Positive,
    RequiredText,
    Text,
    decimals,
)
from report.text.units import G_MPS2
from solver.errors import DefectError
from solver.friction_tests import MOST_MU, MOST_RATE_S_PER_M
from solver.model import Friction

if TYPE_CHECKING:
    from solver.sliding.row import BlockRow


# I_p is 1.0 or 1.5 (ASCE 7, 13.1.3).
ImportanceCell = Annotated[float, Field(ge=1.0, le=1.5)]
MuCell = Annotated[float, Field(ge=0.0, le=MOST_MU)]
RateCell = Annotated[float, Field(gt=0.0, le=MOST_RATE_S_PER_M)]


def slope_rad(value: float, unit: SlopeUnit) -> float:
    """Return a slope as an angle [rad]."""
    if unit is SlopeUnit.DEGREES:
        return math.radians(value)
    # A roof of 100% or 12 in 12 rises at 45 degrees: the angle is that of the rise, not a share of
    # it.
    return math.atan(value / (100.0 if unit is SlopeUnit.PERCENT else 12.0))


@lru_cache
def friction_law(
    mu: float, mu_fast: float | None, rate_s_per_m: float | None, mu_static: float | None
) -> Friction:
    """Return a friction law; missing values are those of the coefficient."""
    return Friction(
        mu_slow=mu,
        mu_fast=mu if mu_fast is None else mu_fast,
        rate_s_per_m=rate_s_per_m or 0.0,
        mu_static=mu if mu_static is None else mu_static,
    )


# Fields of an array from which its weight is computed.
WEIGHT_PARTS = ("modules", "module_weight_n", "ballast_n")


def weight_of_parts(row: InputRow) -> float | None:
    """Return the weight [N] of modules and ballast, if entered."""
    modules, each_n, ballast_n = (row.get(part) for part in WEIGHT_PARTS)
    if modules is None or each_n is None or ballast_n is None:
        return None
    return float(modules * each_n + ballast_n)


class Array(Placed):
    """A ballasted array that moves as one block."""

    id: Id
    slope_value: NotNegative
    slope_unit: SlopeUnit
    mu: Annotated[float, Field(ge=0.0, le=MOST_MU)]
    mu_report: Text = ""
    construction: RequiredText
    modules: Annotated[int, Field(ge=1)] | None = None
    module_weight_n: Positive | None = None
    ballast_n: NotNegative | None = None
    weight_n: Positive
    cg_height_m: Positive
    support_spacing_m: Positive
    x_from_m: float | None = None
    x_to_m: float | None = None
    y_from_m: float | None = None
    y_to_m: float | None = None
    downslope_deg: Annotated[float, Field(ge=0.0, le=360.0)]

    mu_fast: MuCell | None = None
    mu_rate_s_per_m: RateCell | None = None
    mu_static: MuCell | None = None

    i_p: ImportanceCell = 1.0
    base_m: Positive | None = None
    contact_pressure_pa: Positive | None = None
    interconnection_n: Positive | None = None
    slack_m: NotNegative | None = None
    roof_capacity_pa: Positive | None = None
    wind_weight_pa: Positive | None = None
    place_from: Text = ""  # `DRAWING` where a command has written the row

    @property
    def parts_n(self) -> float | None:
        """Weight of modules and ballast [N], if entered."""
        return weight_of_parts(dict(self))

    @property
    def slope_rad(self) -> float:
        """The slope as an angle [rad]."""
        return slope_rad(self.slope_value, self.slope_unit)

    @property
    def friction(self) -> Friction:
        """The friction coefficient as a function of velocity."""
        return friction_law(self.mu, self.mu_fast, self.mu_rate_s_per_m, self.mu_static)

    @property
    def minimum_mu(self) -> float:
        """The smallest friction coefficient at any velocity."""
        # Static friction is never less: `report.project.check.faults` refuses it.
        return min(self.friction.mu_slow, self.friction.mu_fast)

    @property
    def weight_pa(self) -> float:
        """Weight per plan area [Pa]."""
        return self.weight_n / self.shape.area_m2

    @property
    def base_dimension_m(self) -> float:
        """Smallest plan dimension of the supporting base [m]; if not entered, support spacing."""
        return self.support_spacing_m if self.base_m is None else self.base_m

    @property
    def shape(self) -> Shape:
        """The array in roof plan."""
        placed = self.placed
        if placed is None:
            raise DefectError(f"array {self.id} has no location on the plan")
        return placed


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

        # Per mass of a block, W / (n g): the row knows no mass.
        stiffness = self.stiffness_n_per_m * len(self.mus) * G_MPS2 / weight_n
        # Of critical damping, as of one block on one link: c / m = 2 ζ sqrt(k / m).
        damping = 2.0 * self.damping_ratio * math.sqrt(stiffness)
        return BlockRow(mus=self.mus, stiffness_per_s2=stiffness, damping_per_s=damping)
