"""The outline of the roof in plan, and the direction of north.

Read `report.sheet.schema` first.
"""

from __future__ import annotations

from typing import Annotated

from pydantic import Field

from report.sheet.schema.fields import Cell
from report.sheet.schema.scene import Placed
from report.words.units import Quantity

_HELP = (
    "Roof edge in the coordinates of the arrays. Give all four sides, or none. Another shape: its"
    " outline on the sheet Outlines, under the name roof."
)


def _side(side: str, example: float) -> Cell:
    return Cell(f"Roof {side}", example, Quantity.PLAN, help=_HELP)


class Roof(Placed):
    """The outline of the roof, if given, and north."""

    x_from_m: Annotated[float | None, _side("x from", 0.0)] = None
    x_to_m: Annotated[float | None, _side("x to", 360.0)] = None
    y_from_m: Annotated[float | None, _side("y from", 0.0)] = None
    y_to_m: Annotated[float | None, _side("y to", 240.0)] = None
    north_deg: Annotated[
        float, Field(ge=0.0, le=360.0), Cell("Direction of north", 90.0, "deg")
    ] = 90.0
    """In plan, counterclockwise from +x: 90 is +y."""
