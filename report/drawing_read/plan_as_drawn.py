"""The roof plan as drawn, and its changes since the rows of a workbook."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field

from report.drawing_read.moved import Move
from report.drawing_read.roof_drawing import DrawnOutline, Unread
from report.project.model.input_rows import InputRow
from report.project.model.roof import DRAWN_MODULES
from report.project.model.shapes import Shape, solid
from report.text.aligned import aligned
from report.text.units import Quantity, Unit

STILL_M = 1e-3  # what has moved by less has not


@dataclass(frozen=True, slots=True, kw_only=True)
class RoofPlan:
    """The plan as drawn; with the names of the rows of a workbook once it is matched with them."""

    roof: tuple[DrawnOutline, ...]  # one or none
    arrays: tuple[DrawnOutline, ...]
    objects: tuple[DrawnOutline, ...]
    unread: tuple[Unread, ...]
    # Of the rows that it is matched with (`report.drawing_read.row_matching`):
    gone: tuple[str, ...] = ()  # with a place from a former drawing that is not in this one
    typed: tuple[str, ...] = ()  # the same with a place that was typed
    move: Move | None = None  # of the plan as a whole; None where it cannot be told
    rows: Mapping[str, InputRow] = field(default_factory=dict)  # as they were
    row_shapes: Mapping[str, Shape] = field(default_factory=dict)  # where they were
    before: Mapping[str, Shape] = field(default_factory=dict)  # the same, moved with the whole
    unit: Unit = Quantity.PLAN.us  # of places in what is said

    @property
    def roof_shape(self) -> Shape | None:
        """The roof, if it is drawn."""
        return self.roof[0].shape if self.roof else None

    @property
    def shapes(self) -> dict[str, Shape]:
        """The arrays and objects by name."""
        return {place.name: place.shape for place in (*self.arrays, *self.objects)}

    def lines(self, *, replace: bool) -> Iterator[str]:
        """Yield a table of what moved, is new or is gone with `replace`, and modules not drawn."""
        if self.move is None:
            yield (
                "the roof is another one, and how the plan has moved cannot be told: its edges are"
                " new; check the downslope directions, and that of north"
            )
        elif not self.move.is_none:
            check = "" if self.move.is_straight else "; check the direction of north"
            text = f"the plan as a whole is {self.move.words(self.unit)} since the workbook{check}"
            yield f"{text}; typed items that are not drawn are moved with it"
        drawn = self.shapes
        moves = []
        # At first, when nothing was in plan, there is no table.
        for name in {**self.before, **drawn} if self.before else ():
            was, shape = self.before.get(name), drawn.get(name)
            if was and shape and solid(was).hausdorff_distance(solid(shape)) < STILL_M:
                continue
            stays = "stays as typed" if name in self.typed else "kept without --replace"
            gone = f"not in the drawing; {'deleted' if replace and name in self.gone else stays}"
            from_, new_place = (placed(place, self.unit) if place else "" for place in (was, shape))
            moves.append((name, from_ or "new", new_place or gone))
        yield from aligned([("name", "from", "to"), *moves]) if moves else ()
        for place in self.arrays:
            row = self.rows.get(place.name, {})
            if not place.modules and (count := row.get("modules")):
                is_drawn = row.get("place_from") == DRAWN_MODULES
                fate = "deleted, as they are not drawn" if is_drawn else "stay as typed"
                yield f"{place.name}: {count} modules {fate}"


def placed(shape: Shape, unit: Unit) -> str:
    """Return the location of a shape, such as `x 0.00 to 80.00, y 10.00 to 50.00 ft`."""
    box = shape.bounds
    ends = ((box.x_from_m, box.x_to_m), (box.y_from_m, box.y_to_m))
    x, y = (" to ".join(f"{end / unit.si:.{unit.decimals}f}" for end in pair) for pair in ends)
    return f"x {x}, y {y} {unit.symbol}"
