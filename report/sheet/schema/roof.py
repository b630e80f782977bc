"""The outline of the roof in plan, and the direction of north.

Read `report.sheet.schema` first.
"""

from __future__ import annotations

from typing import Annotated

from pydantic import Field

from report.sheet.fields import Cell, Frozen
from report.sheet.schema.scene import Rectangle
from report.words.units import Quantity


def _side(side: str, example: float) -> Cell:
    return Cell(
        f"Roof {side}",
        "Roof edge in the coordinates of the arrays. Give all four sides, or none.",
        example,
        Quantity.PLAN,
    )


class Roof(Frozen):
    """The rectangle that bounds the roof, if given, and north."""

    x_from_m: Annotated[float | None, _side("x from", 0.0)] = None
    x_to_m: Annotated[float | None, _side("x to", 360.0)] = None
    y_from_m: Annotated[float | None, _side("y from", 0.0)] = None
    y_to_m: Annotated[float | None, _side("y to", 240.0)] = None
    north_deg: Annotated[
        Annotated[float, Field(ge=0.0, le=360.0)],
        Cell(
            "Direction of north",
            "In plan, counterclockwise from +x: 90 is +y.",
            90.0,
            "deg",
        ),
    ] = 90.0

    @property
    def outline(self) -> Rectangle | None:
        """The roof in plan, if given."""
        x_from, x_to, y_from, y_to = self.x_from_m, self.x_to_m, self.y_from_m, self.y_to_m
        if x_from is None or x_to is None or y_from is None or y_to is None:
            return None
        return Rectangle(x_from, x_to, y_from, y_to)
