"""The roof and what is on it: arrays, the objects and edges around them, and the clearances.

Read `report.sheet.schema` first.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from functools import lru_cache
from operator import attrgetter
from typing import Annotated, Any, Self

from pydantic import Field

from report.sheet.schema.choices import (
    ClearanceSource,
    Direction,
    Id,
    LayerKind,
    NotNegative,
    ObjectKind,
    Positive,
    RequiredText,
    SlopeUnit,
    Text,
)
from report.sheet.schema.fields import Cell, Frozen
from report.sheet.schema.shapes import Point, Polygon, Rectangle, Shape
from report.text.units import Quantity
from solver.friction_tests import MOST_MU, MOST_RATE_S_PER_M
from solver.model import DefectError, Friction

ImportanceCell = Annotated[float, Field(ge=1.0, le=1.5)]
MuCell = Annotated[float, Field(ge=0.0, le=MOST_MU)]
RateCell = Annotated[float, Field(gt=0.0, le=MOST_RATE_S_PER_M)]


OR_OUTLINE = "required, or an outline"
# Whence a row comes that a command has taken from a drawing.
DRAWING = "drawing"
# The same with the number of modules.
DRAWN_MODULES = f"{DRAWING}, modules too"
# Name of the roof on the sheet Outlines.
ROOF = "roof"


def slope_rad(value: float, unit: SlopeUnit) -> float:
    """Return a slope as an angle [rad]."""
    if unit is SlopeUnit.DEGREES:
        return math.radians(value)
    return math.atan(value / (100.0 if unit is SlopeUnit.PERCENT else 12.0))


_EXAMPLES = {"x from": 20.0, "x to": 100.0, "y from": 15.0, "y to": 75.0}
_HELP = (
    "Rectangle in roof plan, from any fixed corner of the roof. Another shape: leave all four blank"
    " and give its outline on the sheet Outlines."
)
_ROOF_HELP = (
    "Roof edge in the coordinates of the arrays. Give all four sides, or none. Another shape: its"
    " outline on the sheet Outlines, under the name roof."
)


def _plan(edge: str, need: str = "") -> Cell:
    return Cell(edge, _EXAMPLES[edge], Quantity.PLAN, need=need, help=_HELP)


def _edge(side: str, example: float) -> Cell:
    return Cell(f"Roof {side}", example, Quantity.PLAN, help=_ROOF_HELP)


class Placed(Frozen):
    """What has a place in roof plan: by the four sides of a rectangle, or by an outline."""

    outline_m: Annotated[tuple[Point, ...], Field(exclude=True)] = ()
    """Vertices of an outline in place of the rectangle: rows of another table."""

    def outlined(self, points: tuple[Point, ...]) -> Self:
        """Return the same with an outline [m] in place of a rectangle; empty for none."""
        return self.model_copy(update={"outline_m": points})

    @property
    def placed(self) -> Shape | None:
        """Its shape in roof plan, if given."""
        if self.outline_m:
            return Polygon(self.outline_m)
        sides = _sides_of(self)
        return None if None in sides else Rectangle(*sides)


# Fields of a rectangle in roof plan.
SIDES = ("x_from_m", "x_to_m", "y_from_m", "y_to_m")
_sides_of = attrgetter(*SIDES)


class Roof(Placed):
    """The outline of the roof, if given, and north."""

    x_from_m: Annotated[float | None, _edge("x from", 0.0)] = None
    x_to_m: Annotated[float | None, _edge("x to", 360.0)] = None
    y_from_m: Annotated[float | None, _edge("y from", 0.0)] = None
    y_to_m: Annotated[float | None, _edge("y to", 240.0)] = None
    north_deg: Annotated[
        float, Field(ge=0.0, le=360.0), Cell("Direction of north", 90.0, "deg")
    ] = 90.0
    """In plan, counterclockwise from +x: 90 is +y."""


@lru_cache
def friction_law(
    mu: float, mu_fast: float | None, rate_s_per_m: float | None, mu_static: float | None
) -> Friction:
    """Return a friction law; what is not given is as the coefficient says."""
    return Friction(
        mu_slow=mu,
        mu_fast=mu if mu_fast is None else mu_fast,
        rate_s_per_m=rate_s_per_m or 0.0,
        mu_static=mu if mu_static is None else mu_static,
    )


# Fields of an array from which its weight is computed.
WEIGHT_PARTS = ("modules", "module_weight_n", "ballast_n")


PlaceFrom = Annotated[Text, Cell("Place from", DRAWING, is_rare=True)]


class Array(Placed):
    """A ballasted array that moves as one block."""

    id: Annotated[Id, Cell("ID", "A1")]
    """Short and unique, such as A1."""
    slope_value: Annotated[NotNegative, Cell("Slope", 2.0, unit_from=("slope_unit", str))]
    """Slope of the roof under the array, 0 to less than 45 deg."""
    slope_unit: Annotated[SlopeUnit, Cell("Slope unit", "degrees")]
    """Unit of the slope."""
    mu: Annotated[
        float, Field(ge=0.0, le=MOST_MU), Cell("Friction coefficient", 0.45, usual=(0.3, 0.8))
    ]
    """Kinetic, from tests; the smaller of wet and dry."""
    mu_report: Annotated[Text, Cell("Friction test report", "ASTM G115, Lab 1234, 2025-06-12")] = ""
    """Laboratory, number and date of the friction test."""
    construction: Annotated[RequiredText, Cell("Construction", "Tray 10 deg, landscape")]
    """Product and layout. Arrays of the same text, slope, friction and downslope direction are like
    arrays."""
    modules: Annotated[Annotated[int, Field(ge=1)] | None, Cell("Modules", 320)] = None
    """Number of modules."""
    module_weight_n: Annotated[
        Positive | None, Cell("Module weight", 75.0, Quantity.WEIGHT, usual=(20.0, 300.0))
    ] = None
    """Of one module with its racking, without ballast."""
    ballast_n: Annotated[
        NotNegative | None, Cell("Ballast weight", 18000.0, Quantity.WEIGHT, usual=(0.0, 500000.0))
    ] = None
    """Of the whole array; 0 if it has none."""
    weight_n: Annotated[
        Positive,
        Cell("Weight", 42000.0, Quantity.WEIGHT, need="required, or modules and ballast",
             usual=(500.0, 500000.0)),
    ]  # fmt: skip
    """Modules, racking and ballast. Blank: computed from modules, module weight and ballast
    weight."""
    cg_height_m: Annotated[Positive, Cell("CG height", 9.0, Quantity.SIZE, usual=(4.0, 36.0))]
    """Center of gravity above the roof surface."""
    support_spacing_m: Annotated[
        Positive, Cell("Support spacing", 40.0, Quantity.SIZE, usual=(12.0, 120.0))
    ]
    """Smallest spacing of the supports on the roof, in either plan direction."""
    x_from_m: Annotated[float | None, _plan("x from", OR_OUTLINE)] = None
    x_to_m: Annotated[float | None, _plan("x to", OR_OUTLINE)] = None
    y_from_m: Annotated[float | None, _plan("y from", OR_OUTLINE)] = None
    y_to_m: Annotated[float | None, _plan("y to", OR_OUTLINE)] = None
    downslope_deg: Annotated[
        float, Field(ge=0.0, le=360.0), Cell("Downslope direction", 270.0, "deg")
    ]
    """In plan, counterclockwise from +x: 0 is +x, 90 is +y."""

    mu_fast: Annotated[
        MuCell | None, Cell("High-velocity friction", 0.5, usual=(0.3, 0.9), is_rare=True)
    ] = None
    """Only if tests give velocity-dependent friction: the coefficient at high velocity. The
    friction coefficient is then the low-velocity value."""
    mu_rate_s_per_m: Annotated[
        RateCell | None, Cell("Friction rate", 30.0, "s/m", usual=(1.0, 200.0), is_rare=True)
    ] = None
    """Rate of transition from low to high velocity: fast - (fast - slow) exp(-rate x velocity).
    Required with high-velocity friction."""
    mu_static: Annotated[
        MuCell | None, Cell("Static friction", 0.55, usual=(0.3, 1.0), is_rare=True)
    ] = None
    """Only if tests give it: the coefficient at which slip starts. Blank: the friction
    coefficient."""

    i_p: Annotated[ImportanceCell, Cell("Importance factor I_p", 1.0, is_rare=True)] = 1.0
    """Of the component. Separations of PV1-2012 take the larger I_p of array and neighbor."""
    base_m: Annotated[
        Positive | None,
        Cell("Base dimension", 60.0, Quantity.SIZE, usual=(12.0, 240.0), is_rare=True),
    ] = None
    """Least plan dimension of the supporting base, for the low-profile limit of PV1-2012. Blank:
    the support spacing, which is on the safe side."""
    contact_pressure_pa: Annotated[
        Positive | None, Cell("Contact pressure", 150.0, Quantity.PRESSURE, is_rare=True)
    ] = None
    """Weight over the contact area of the supports; printed beside that of the friction tests."""
    interconnection_n: Annotated[
        Positive | None, Cell("Interconnection strength", 4000.0, Quantity.WEIGHT)
    ] = None
    """Least strength provided between the parts of the array; compared with the strength that the
    rule set requires."""
    slack_m: Annotated[
        NotNegative | None, Cell("Electrical slack", 48.0, Quantity.SIZE, usual=(6.0, 240.0))
    ] = None
    """Slack of the wiring that leaves the array; compared with the design displacement."""
    roof_capacity_pa: Annotated[
        Positive | None, Cell("Roof capacity", 6.0, Quantity.PRESSURE, usual=(2.0, 50.0))
    ] = None
    """Weight per area of the array that the roof's engineer permits; compared with the weight over
    the plan area. Blank: by others."""
    wind_weight_pa: Annotated[
        Positive | None, Cell("Weight in wind design", 5.5, Quantity.PRESSURE, usual=(1.0, 50.0))
    ] = None
    """Weight per area, with ballast, in the wind design by others; compared with the weight over
    the plan area."""
    place_from: PlaceFrom = ""
    """Drawing: written by roofslip plan read, which takes the row out when the drawing no longer
    has it; clear it where you change the place. Blank: as entered."""

    @classmethod
    def computed(cls, name: str, row: Mapping[str, Any]) -> float | None:
        """Return the weight [N] of modules and ballast, where they are given."""
        modules, each_n, ballast_n = (row.get(part) for part in WEIGHT_PARTS)
        if name != "weight_n" or modules is None or each_n is None or ballast_n is None:
            return None
        return float(modules * each_n + ballast_n)

    @property
    def parts_n(self) -> float | None:
        """Weight of modules and ballast [N], where they are given."""
        return self.computed("weight_n", dict(self))

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
        return min(self.friction.mu_slow, self.friction.mu_fast)

    @property
    def weight_pa(self) -> float:
        """Weight per plan area [Pa]."""
        return self.weight_n / self.shape.area_m2

    @property
    def base_dimension_m(self) -> float:
        """Least plan dimension of the supporting base [m]; where not given, support spacing."""
        return self.support_spacing_m if self.base_m is None else self.base_m

    @property
    def shape(self) -> Shape:
        """The array in roof plan."""
        placed = self.placed
        if placed is None:
            raise DefectError(f"array {self.id} has no place in plan")
        return placed


class RoofObject(Placed):
    """An object on the roof, or a roof edge."""

    id: Annotated[Id, Cell("ID", "RTU-1")]
    """Short and unique, such as RTU-1."""
    kind: Annotated[ObjectKind, Cell("Kind", "fixed object")]
    """An unlike array has a different construction and is not listed in Arrays."""
    height_m: Annotated[
        NotNegative | None, Cell("Height", 42.0, Quantity.SIZE, usual=(4.0, 240.0))
    ] = None
    """Of the object or parapet above the roof; required for an edge with parapet."""
    x_from_m: Annotated[float | None, _plan("x from")] = None
    x_to_m: Annotated[float | None, _plan("x to")] = None
    y_from_m: Annotated[float | None, _plan("y from")] = None
    y_to_m: Annotated[float | None, _plan("y to")] = None
    i_p: Annotated[ImportanceCell, Cell("Importance factor I_p", 1.0, is_rare=True)] = 1.0
    """Of an object or unlike array; not used for edges."""
    place_from: PlaceFrom = ""
    """As of an array."""


class Vertex(Frozen):
    """A vertex of the outline of an array, an object or the roof."""

    name: Annotated[Id, Cell("Outline of", "A1")]
    """ID of an array or an object, or roof for the roof."""
    x_m: Annotated[float, Cell("x", 20.0, Quantity.PLAN)]
    """Vertices in order around the outline, one to a row."""
    y_m: Annotated[float, Cell("y", 15.0, Quantity.PLAN)]
    """In the coordinates of the arrays."""
    source: Annotated[Text, Cell("From", DRAWING)] = ""
    """Drawing: written by roofslip plan read; clear it where you change the row. Blank: as
    entered."""


class DrawingLayer(Frozen):
    """A layer of a roof drawing, and what is drawn on it."""

    layer: Annotated[RequiredText, Cell("Layer", "A-ROOF-PV")]
    """Name of a layer of the roof drawing."""
    kind: Annotated[LayerKind, Cell("Drawn on it", "array")]
    """What the closed polylines on the layer are."""


class Clearance(Frozen):
    """The clearance from an array to an object or another array."""

    array: Annotated[Id, Cell("Array", "A1")]
    """ID of the array that moves."""
    object: Annotated[Id, Cell("Object", "RTU-1")]
    """ID of an object, or of another array."""
    direction: Annotated[Direction, Cell("Direction", "any")]
    """From the array: downslope, upslope, cross-slope, or any."""
    provided_m: Annotated[
        NotNegative, Cell("Provided clearance", 96.0, Quantity.SIZE, usual=(6.0, 600.0))
    ]
    """Clear distance in roof plan."""
    pathway_m: Annotated[
        NotNegative | None,
        Cell("Fire pathway", 48.0, Quantity.SIZE, usual=(24.0, 240.0), zero="none"),
    ] = None
    """Width that the fire code requires of a pathway along this clearance, or none: the package
    checks that it is left after the design displacement. Blank: a condition of the package."""
    source: Annotated[ClearanceSource | None, Cell("Distance from", "measured")] = None
    """Blank: as entered. Drawing: taken from the plan, a condition of the package until it is
    confirmed, here by measured, or for all by name and date on the sheet Project."""
