"""Movement of a whole plan between a workbook and a drawing: shift, turn, factor, mirror.

A plan in inches, entered in feet in the workbook, is twelve times as large and not rotated.

Knows no cells (`report.drawing_read.fill`). Read `whole_move` first. Points are complex.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from itertools import chain, starmap

import numpy as np
import shapely

from report.drawing_read.geometry import boxed
from report.project.model.shapes import Polygon, Shape, ring, solid
from report.text.units import Unit

# Outlines are the same within this [m].
SAME_M = 0.05
# Factors between these are no unit that is taken for another: a roof has grown.
_GROWN = (0.9, 1.1)
_MOST_TRIED = 100

# A row or an outline: its name where rows and drawing have it, else what kind of place it is.
Keyed = tuple[str, Shape]


@dataclass(frozen=True, slots=True)
class Move:
    """A point z of the workbook, or its mirror image in the x axis, is at turn z + shift [m]."""

    turn: complex = 1.0
    shift: complex = 0.0
    is_mirrored: bool = False

    @property
    def is_none(self) -> bool:
        """Whether nothing has moved."""
        return self.is_straight and abs(self.shift) < SAME_M

    @property
    def is_straight(self) -> bool:
        """Whether it is a shift alone."""
        return self.turn == 1.0 and not self.is_mirrored

    @property
    def factor(self) -> float:
        """Factor on the size of the plan."""
        return round(abs(self.turn), 6)

    def of(self, shape: Shape) -> Shape:
        """Return the moved shape of a shape of the workbook."""
        points = [complex(x, -y if self.is_mirrored else y) for x, y in shape.points]
        moved = [self.turn * point + self.shift for point in points]
        return shape if self.is_none else boxed(Polygon(ring([(z.real, z.imag) for z in moved])))

    def way_deg(self, degrees: float) -> float:
        """Return a moved direction in plan, counterclockwise from +x."""
        way_deg = math.degrees(cmath.phase(self.turn)) + (-1 if self.is_mirrored else 1) * degrees
        return round(way_deg, 6) % 360.0

    def words(self, unit: Unit) -> str:
        """Return the movement as text: `rotated counterclockwise by 90°, moved by x 2, y 0 ft`."""
        x, y = (f"{m / unit.si:.{unit.decimals}f}" for m in (self.shift.real, self.shift.imag))
        parts = {
            "mirrored": self.is_mirrored,
            f"rotated counterclockwise by {self.way_deg(0.0):g}°": self.way_deg(0.0),
            f"{self.factor:.4g} times as large": self.factor != 1.0,
            f"moved by x {x}, y {y} {unit.symbol}": abs(self.shift) >= SAME_M,
        }
        return ", ".join(part for part, counts in parts.items() if counts)


def whole_move(
    roofs: tuple[Shape | None, Shape | None],
    rows: Sequence[Keyed],
    drawn: Sequence[Keyed],
    named: Iterable[tuple[Shape, Shape]],
) -> Move | None:
    """Return the movement of a plan; None if the roof has moved in an undetermined way.

    The roof and rows of the same name are given as they were and as they are drawn.
    """
    was, moved = roofs
    of_roof = list(_fits(was, moved)) if was and moved else []
    is_same_roof = any(move.factor == 1.0 for move in of_roof)
    if is_same_roof:
        tried = [move for move in of_roof if move.factor == 1.0]
    else:
        # Where the roof is another, rows of the same name tell.
        of_rows = chain.from_iterable(starmap(_fits, named))
        fits = (*of_roof, *of_rows)
        tried = [Move(), *(move for move in fits if not move.is_mirrored)]
    # Each is compared with all rows; the likely ones, by the roof, come first.
    counts = {move: _agreeing(move, rows, drawn) for move in tried[:_MOST_TRIED]}

    def likely(move: Move) -> tuple[int, bool]:
        # A plan is seldom turned: that is told by more than twice as many rows.
        return counts[move] * (2 if move.is_straight else 1), move.is_straight

    best = max(counts, key=likely)
    count = counts[best]
    if not is_same_roof:
        is_told = count > 1 or (count == 1 and (best.is_none or best in of_roof))
        return best if is_told else None if was and moved and rows else Move()
    if best.is_straight:
        return best
    slower = [move for move in counts if move != best]
    is_told = all(counts[move] < count for move in slower)
    # A layout that is mirrored is more likely than a sheet, where the roof has other fits.
    if best.is_mirrored:
        is_told &= all(move.is_mirrored for move in slower)
    return best if is_told and (count > 1 or not any(m.is_straight for m in slower)) else None


def _agreeing(move: Move, rows: Sequence[Keyed], drawn: Sequence[Keyed]) -> int:
    """Return the number of rows that match the drawing after a move."""
    if not rows:
        return 0
    shapes = [solid(move.of(shape)) for _, shape in rows]
    places = [solid(shape) for _, shape in drawn]
    near = shapely.STRtree(places).query(shapes, predicate="intersects").T.tolist()
    return len({
        row for row, number in near
        if rows[row][0] == drawn[number][0]
        and shapes[row].hausdorff_distance(places[number]) <= SAME_M
    })  # fmt: skip


def _fits(was: Shape, moved: Shape) -> Iterator[Move]:
    """Yield the moves that bring an outline to another one, those that mirror it last."""
    if len(was.points) != len(moved.points):
        return
    earlier, drawn = (np.array(shape.points) @ (1.0, 1.0j) for shape in (was, moved))
    y = drawn - drawn.mean()
    for is_mirrored in (False, True):
        points = earlier.conj()[::-1] if is_mirrored else earlier
        x = points - points.mean()
        # Least squares, with each vertex of the one as the first of the other.
        size = (abs(x) ** 2).sum()
        # The correlation of both rings at every offset of their vertices in one transform, n log n
        # instead of n squared.
        turns = np.fft.ifft(np.fft.fft(y) * np.fft.fft(x).conj()) / size
        # What is left of the squares once the best turn and factor are taken out.
        off = (abs(y) ** 2).sum() - abs(turns) ** 2 * size
        for turn in turns[off <= len(y) * SAME_M**2].tolist():
            rounded = _rounded(turn, SAME_M / abs(y).max())
            shift = complex(drawn.mean() - rounded * points.mean())
            move = Move(rounded, shift, is_mirrored)
            if move.factor == 1.0 or not _GROWN[0] < move.factor < _GROWN[1]:
                yield move


def _rounded(turn: complex, noise: float) -> complex:
    """Return a turn as one of quarters and as without a factor, where it is but for noise."""
    factor, quarters = abs(turn), 2.0 * cmath.phase(turn) / math.pi
    way = (1.0, 1.0j, -1.0, -1.0j)[round(quarters) % 4]
    if abs(turn / factor - way) > noise:
        way = turn / factor
    return way if abs(factor - 1.0) <= noise else factor * way
