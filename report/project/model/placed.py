"""What has a place in roof plan."""

from __future__ import annotations

from operator import attrgetter
from typing import Annotated, Self

from pydantic import Field

from report.project.model.frozen import Frozen
from report.project.model.shapes import Point, Polygon, Rectangle, Shape


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
