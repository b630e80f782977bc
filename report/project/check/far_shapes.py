"""Shapes that lie far from the roof: leftovers of another plan."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from report.project.model.shapes import Shape, gap_m
from report.text.units import Quantity, pair

# Distance [m] from which on a shape is far from a roof, if that is not longer; or from an array.
LEAST_FAR_M, FAR_M = 30.0, 500.0


def far_off(
    shapes: Mapping[str, Shape], roof: Shape | None, is_us: bool
) -> Iterator[tuple[str, str]]:
    """Yield what lies far from the roof, or else from the largest shape, with a question."""
    if not shapes:
        return
    largest = max(shapes, key=lambda name: shapes[name].area_m2)
    center = roof or shapes[largest]
    box = center.bounds
    long_m = max(box.x_to_m - box.x_from_m, box.y_to_m - box.y_from_m)
    far_m = max(long_m, LEAST_FAR_M) if roof else FAR_M
    for name, shape in shapes.items():
        away_m = gap_m(shape, center)
        if away_m > far_m:
            away = pair(away_m, Quantity.PLAN, is_us)
            text = f"{name} is {away} from {'the roof' if roof else largest}: is it a leftover?"
            yield name, f"{text} Delete it, or correct its place"
