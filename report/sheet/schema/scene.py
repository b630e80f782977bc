"""What is on the roof: arrays, the objects and edges around them, and the clearances.

Read `report.sheet.schema` first.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Annotated

from pydantic import Field

from report.sheet.fields import Cell, Frozen
from report.sheet.schema.choices import (
    Direction,
    Id,
    Model,
    NotNegative,
    ObjectKind,
    Positive,
    RequiredText,
    SlopeUnit,
    Text,
)
from report.words.units import Quantity
from solver.friction_tests import MOST_MU, MOST_RATE_S_PER_M
from solver.model import Friction

ImportanceCell = Annotated[float, Field(ge=1.0, le=1.5)]
MuCell = Annotated[float, Field(ge=0.0, le=MOST_MU)]
RateCell = Annotated[float, Field(gt=0.0, le=MOST_RATE_S_PER_M)]


def slope_rad(value: float, unit: SlopeUnit) -> float:
    """Return a slope as an angle [rad]."""
    if unit is SlopeUnit.DEGREES:
        return math.radians(value)
    return math.atan(value / (100.0 if unit is SlopeUnit.PERCENT else 12.0))


@dataclass(frozen=True, slots=True)
class Rectangle:
    """A rectangle in roof plan [m]."""

    x_from_m: float
    x_to_m: float
    y_from_m: float
    y_to_m: float


def _plan(edge: str) -> Cell:
    examples = {"x from": 20.0, "x to": 100.0, "y from": 15.0, "y to": 75.0}
    return Cell(
        edge,
        "Rectangle in roof plan, from any fixed corner of the roof.",
        examples[edge],
        Quantity.PLAN,
    )


class Array(Frozen):
    """A ballasted array that moves as one block."""

    id: Annotated[Id, Cell("ID", "Short and unique, such as A1.", "A1")]
    slope_value: Annotated[
        NotNegative, Cell("Slope", "Slope of the roof under the array, 0 to less than 45 deg.", 2.0)
    ]
    slope_unit: Annotated[SlopeUnit, Cell("Slope unit", "Unit of the slope.", "degrees")]
    mu: Annotated[
        float,
        Field(ge=0.0, le=MOST_MU),
        Cell("Friction coefficient", "Kinetic, from tests; the smaller of wet and dry.", 0.45),
    ]
    mu_report: Annotated[
        Text,
        Cell(
            "Friction test report",
            "Laboratory, number and date of the friction test.",
            "ASTM G115, Lab 1234, 2025-06-12",
        ),
    ] = ""
    construction: Annotated[
        RequiredText,
        Cell(
            "Construction",
            "Product and layout. Arrays of the same text, slope, friction and downslope"
            " direction are like arrays.",
            "Tray 10 deg, landscape",
        ),
    ]
    weight_n: Annotated[
        Positive, Cell("Weight", "Modules, racking and ballast.", 42000.0, Quantity.WEIGHT)
    ]
    cg_height_m: Annotated[
        Positive, Cell("CG height", "Center of gravity above the roof surface.", 9.0, Quantity.SIZE)
    ]
    support_spacing_m: Annotated[
        Positive,
        Cell(
            "Support spacing",
            "Smallest spacing of the supports on the roof, in either plan direction.",
            40.0,
            Quantity.SIZE,
        ),
    ]
    x_from_m: Annotated[float, _plan("x from")]
    x_to_m: Annotated[float, _plan("x to")]
    y_from_m: Annotated[float, _plan("y from")]
    y_to_m: Annotated[float, _plan("y to")]
    downslope_deg: Annotated[
        float,
        Field(ge=0.0, le=360.0),
        Cell(
            "Downslope direction",
            "In plan, counterclockwise from +x: 0 is +x, 90 is +y.",
            270.0,
            "deg",
        ),
    ]

    mu_fast: Annotated[
        MuCell | None,
        Cell(
            "High-velocity friction",
            "Only if tests give velocity-dependent friction: the coefficient at high velocity. The "
            "friction coefficient is then the low-velocity value.",
            0.5,
        ),
    ] = None
    mu_rate_s_per_m: Annotated[
        RateCell | None,
        Cell(
            "Friction rate",
            "Rate of transition from low to high velocity: fast - (fast - slow) exp(-rate x "
            "velocity). Required with high-velocity friction.",
            30.0,
            "s/m",
        ),
    ] = None
    mu_static: Annotated[
        MuCell | None,
        Cell(
            "Static friction",
            "Only if tests give it: the coefficient at which slip starts. Blank: the friction "
            "coefficient.",
            0.55,
        ),
    ] = None
    model: Annotated[
        Model,
        Cell(
            "Model",
            "Choose: the simplest adequate model for each motion. Any other model is run as "
            "requested, and the package states what the automatic choice would give.",
            "choose",
        ),
    ] = Model.CHOOSE

    i_p: Annotated[
        ImportanceCell,
        Cell(
            "Importance factor I_p",
            "Of the component. Separations of PV1-2012 take the larger I_p of array and neighbor.",
            1.0,
        ),
    ] = 1.0
    base_m: Annotated[
        Positive | None,
        Cell(
            "Base dimension",
            "Least plan dimension of the supporting base, for the low-profile limit of PV1-2012."
            " Blank: the support spacing, which is on the safe side.",
            60.0,
            Quantity.SIZE,
        ),
    ] = None
    interconnection_n: Annotated[
        Positive | None,
        Cell(
            "Interconnection strength",
            "Least strength provided between the parts of the array; compared with the strength"
            " that the rule set requires.",
            4000.0,
            Quantity.WEIGHT,
        ),
    ] = None
    slack_m: Annotated[
        NotNegative | None,
        Cell(
            "Electrical slack",
            "Slack of the wiring that leaves the array; compared with the design displacement.",
            48.0,
            Quantity.SIZE,
        ),
    ] = None

    @property
    def slope_rad(self) -> float:
        """The slope as an angle [rad]."""
        return slope_rad(self.slope_value, self.slope_unit)

    @property
    def friction(self) -> Friction:
        """The friction coefficient as a function of velocity."""
        return Friction(
            mu_slow=self.mu,
            mu_fast=self.mu if self.mu_fast is None else self.mu_fast,
            rate_s_per_m=self.mu_rate_s_per_m or 0.0,
            mu_static=self.mu if self.mu_static is None else self.mu_static,
        )

    @property
    def least_mu(self) -> float:
        """The smallest friction coefficient at any velocity."""
        return min(self.friction.mu_slow, self.friction.mu_fast)

    @property
    def base_dimension_m(self) -> float:
        """Least plan dimension of the supporting base [m]; where not given, support spacing."""
        return self.support_spacing_m if self.base_m is None else self.base_m

    @property
    def rectangle(self) -> Rectangle:
        """The array in roof plan."""
        return Rectangle(self.x_from_m, self.x_to_m, self.y_from_m, self.y_to_m)


class RoofObject(Frozen):
    """An object on the roof, or a roof edge."""

    id: Annotated[Id, Cell("ID", "Short and unique, such as RTU-1.", "RTU-1")]
    kind: Annotated[
        ObjectKind,
        Cell(
            "Kind",
            "An unlike array has a different construction and is not listed in Arrays.",
            "fixed object",
        ),
    ]
    height_m: Annotated[
        NotNegative | None,
        Cell(
            "Height",
            "Of the object or parapet above the roof; required for an edge with parapet.",
            42.0,
            Quantity.SIZE,
        ),
    ] = None
    x_from_m: Annotated[float | None, _plan("x from")] = None
    x_to_m: Annotated[float | None, _plan("x to")] = None
    y_from_m: Annotated[float | None, _plan("y from")] = None
    y_to_m: Annotated[float | None, _plan("y to")] = None
    i_p: Annotated[
        ImportanceCell,
        Cell("Importance factor I_p", "Of an object or unlike array; not used for edges.", 1.0),
    ] = 1.0

    @property
    def rectangle(self) -> Rectangle | None:
        """The object in roof plan, if given."""
        x_from, x_to, y_from, y_to = self.x_from_m, self.x_to_m, self.y_from_m, self.y_to_m
        if x_from is None or x_to is None or y_from is None or y_to is None:
            return None
        return Rectangle(x_from, x_to, y_from, y_to)


class Clearance(Frozen):
    """The clearance from an array to an object or another array."""

    array: Annotated[Id, Cell("Array", "ID of the array that moves.", "A1")]
    object: Annotated[Id, Cell("Object", "ID of an object, or of another array.", "RTU-1")]
    direction: Annotated[
        Direction,
        Cell("Direction", "From the array: downslope, upslope, cross-slope, or any.", "any"),
    ]
    provided_m: Annotated[
        NotNegative, Cell("Provided clearance", "Clear distance in roof plan.", 96.0, Quantity.SIZE)
    ]
