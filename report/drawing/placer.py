"""Places labels on a drawing so that none touches another.

Sizes and positions are in inches on paper; draws nothing. Read `Placer` first.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from functools import lru_cache
from typing import NamedTuple

import numpy as np
import shapely

from report.project.model.shapes import Point

_CLEAR_IN = 0.035  # between labels
# Near rings are close, far ones wide: a leader of 3 in may as well be 0.2 in longer.
_RINGS_IN = np.concatenate((np.arange(0.0, 1.6, 0.06), np.arange(1.6, 4.0, 0.2)))
_TURNS = np.deg2rad(np.arange(0.0, 360.0, 10.0))
_OFFSETS = np.column_stack(
    (np.outer(_RINGS_IN, np.cos(_TURNS)).ravel(), np.outer(_RINGS_IN, np.sin(_TURNS)).ravel())
)
_DISTANCES_IN = np.hypot(*_OFFSETS.T)
_NEAR_IN = 0.4  # tried first
_TRIED = 200  # candidates whose leaders are checked, the nearest ones
# After so many labels in a row without room the next are sought near alone: a plan of 300 arrays
# took a minute to find that it has none.
_HOPELESS = 20
_CROSSED = 3.0  # what a leader that may cross a label or a wall costs more
_AT_START_IN = 0.12  # length of a leader within the mark that it leads from


class Frame(NamedTuple):
    """A rectangle on paper [in]."""

    x0: float
    y0: float
    x1: float
    y1: float

    @property
    def middle(self) -> Point:
        """Its center."""
        return (self.x0 + self.x1) / 2, (self.y0 + self.y1) / 2

    @property
    def wide(self) -> float:
        """Its width [in]."""
        return self.x1 - self.x0

    @property
    def tall(self) -> float:
        """Its height [in]."""
        return self.y1 - self.y0

    def nearest(self, point: Point) -> Point:
        """Return its point nearest to another one."""
        return min(max(point[0], self.x0), self.x1), min(max(point[1], self.y0), self.y1)

    @property
    def corners(self) -> tuple[Point, ...]:
        """Its corners, counterclockwise from the lower left."""
        return (self.x0, self.y0), (self.x1, self.y0), (self.x1, self.y1), (self.x0, self.y1)


def centered(x: float, y: float, wide: float, tall: float) -> Frame:
    """Return a frame about a point."""
    return Frame(x - wide / 2, y - tall / 2, x + wide / 2, y + tall / 2)


Corners = np.ndarray[tuple[int, ...], np.dtype[np.float64]]


class _Frames:
    """Frames, each a row of a table that has room for more."""

    def __init__(self) -> None:
        self._room, self._count = np.empty((64, 4)), 0

    @property
    def table(self) -> Corners:
        """The frames."""
        return self._room[: self._count]

    def add(self, rows: Sequence[Frame]) -> None:
        """Add frames."""
        start, self._count = self._count, self._count + len(rows)
        if self._count > len(self._room):
            # Room for as many again: a table that was copied for each label took the square of
            # their number.
            self._room = np.vstack((self._room, np.empty((self._count, 4))))
        self._room[start : self._count] = rows

    def remove(self, frame: Frame) -> None:
        """Remove the first frame that is equal to another one."""
        first = int(np.flatnonzero((self.table == frame).all(axis=1))[0])
        self._room[first : self._count - 1] = self._room[first + 1 : self._count]
        self._count -= 1


class Placer:
    """Labels placed so far, and items that they should not cover."""

    def __init__(self, page: Frame) -> None:
        self._page = page
        self._taken, self._threads, self._lines, self._walls = (_Frames() for _ in range(4))
        self._without_room = 0  # labels in a row, sought on the whole page

    @property
    def right(self) -> float:
        """The right end of all frames [in]."""
        return float(np.vstack((self._taken.table, self._lines.table))[:, 2].max())

    def take(self, frame: Frame) -> None:
        """Reserve a frame: no label will touch it."""
        self._taken.add([frame])

    def release(self, frame: Frame) -> None:
        """Release a reserved frame."""
        self._taken.remove(frame)

    def avoid(self, frame: Frame) -> None:
        """Mark a line or a small object to be covered only if there is no other room."""
        self._lines.add([frame])

    def wall(self, frame: Frame) -> None:
        """Mark a side of an array: as `avoid`, and no leader will cross it."""
        self.avoid(frame)
        self._walls.add([frame])

    def take_first(self, frames: Sequence[Frame], within: Sequence[Frame] = ()) -> int | None:
        """Reserve the first frame that touches no label, no line and, `within`, no wall, if any."""
        if not frames:
            return None
        corners = np.array(frames)
        low, high = corners[:, :2], corners[:, 2:]
        taken = (low < self._page[:2]).any(axis=1) | (high > self._page[2:]).any(axis=1)
        for frames_taken in (self._taken, self._threads):
            taken |= _touches(low, high, frames_taken.table, 0.0).any(axis=1)
        if within:
            corners = np.array(within)
            taken |= _touches(corners[:, :2], corners[:, 2:], self._walls.table, 0.0).any(axis=1)
        if taken.all():
            return None
        first = int(np.argmin(taken))
        self.take(frames[first])
        return first

    def take_segment(self, a: Point, b: Point) -> None:
        """Reserve a line between two points: no label will touch it, leaders may cross it."""
        # As small squares: frames are parallel to the axes, and that of an oblique line would
        # cover all between its ends.
        count = max(1, math.ceil(math.dist(a, b) / 0.06) - 1)
        (x, y), dx, dy = a, (b[0] - a[0]) / count, (b[1] - a[1]) / count
        self._threads.add([centered(x + k * dx, y + k * dy, 0.02, 0.02) for k in range(count + 1)])

    def place(
        self,
        wide: float,
        tall: float,
        near: Point,
        within: Frame | None = None,
        maximum: float = 4.0,
        *,
        may_cross: bool = False,
    ) -> Frame | None:
        """Reserve the frame of a label, on the page or within a frame, nearest to a point, or None.

        A straight leader to it, to its center at most so long [in], crosses no other label and no
        wall, or if it may, as few as there can be.
        """
        page = self._page if within is None else within
        if wide > page.wide or tall > page.tall:
            return None
        cost = _CROSSED if may_cross else np.inf
        # As bytes they are keys of the cache; arrays have no hash.
        tables = (self._taken, self._threads, self._lines, self._walls)
        rows = (frames.table.tobytes() for frames in tables)
        if self._without_room >= _HOPELESS and not may_cross:
            maximum = min(maximum, _NEAR_IN)
        frame = _placed((wide, tall), near, page, maximum, cost, *rows)
        if frame is not None:
            self.take(frame)
        if within is None:
            self._without_room = 0 if frame else self._without_room + 1
        return frame


# While a slider moves, sizes of labels stay: most are placed again where they were.
@lru_cache(500)
def _placed(
    size: Point, near: Point, page: Frame, maximum: float, crossed: float, *tables: bytes
) -> Frame | None:
    """Return the frame of a label of a size among what is taken, threads, lines and walls."""
    rows = [np.frombuffer(table).reshape(-1, 4) for table in tables]
    # Most labels find room near; what is farther away costs more than its distance.
    cost, frame = _best(size, near, page, min(_NEAR_IN, maximum), crossed, rows)
    if cost > _NEAR_IN and maximum > _NEAR_IN:
        _, frame = _best(size, near, page, maximum, crossed, rows)
    return frame


def _best(
    label: Point,
    near: Point,
    page: Frame,
    maximum: float,
    crossed: float,
    tables: Sequence[Corners],
) -> tuple[float, Frame | None]:
    """Return the frame that costs least, with its cost; infinity if there is none."""
    size = np.array(label)
    low = _OFFSETS[maximum >= _DISTANCES_IN] + near - size / 2
    low = low[np.all(low >= (page.x0, page.y0), axis=1)]
    low = low[np.all(low + size <= (page.x1, page.y1), axis=1)]
    if not len(low):
        return np.inf, None
    # What no candidate and no leader comes near makes no difference.
    reach = np.hstack((np.minimum(low.min(axis=0), near), np.maximum(low.max(axis=0) + size, near)))
    taken, threads, lines, walls = (
        table[_touches(table[:, :2], table[:, 2:], reach[None], _CLEAR_IN)[:, 0]]
        for table in tables
    )
    everything = np.vstack((taken, threads))
    low = low[~_touches(low, low + size, everything, _CLEAR_IN).any(axis=1)]
    if not len(low):
        return np.inf, None
    cost = np.hypot(*(low + size / 2 - near).T)
    # Covering a line is as bad as being 0.6 in farther away, crossing a dimension line 0.5 in.
    cost += 0.6 * _touches(low, low + size, lines, 0.015).sum(axis=1)
    # Stable: of places of one cost the first, on every machine.
    first = np.argsort(cost, kind="stable")[:_TRIED]
    low, cost = low[first], cost[first]
    total = cost + 0.5 * _crossings(low, low + size, near, threads)
    crossings = _crossings(low, low + size, near, np.vstack((taken, walls)))
    total[crossings > 0.0] += crossed * crossings[crossings > 0.0]
    best = int(np.argmin(total))
    if total[best] == np.inf:
        return np.inf, None
    x0, y0 = (float(v) for v in low[best])
    return float(total[best]), Frame(x0, y0, x0 + label[0], y0 + label[1])


def _touches(low: Corners, high: Corners, frames: Corners, clear: float) -> Corners:
    """Return for each candidate and frame whether they come nearer than a distance."""
    apart = np.zeros((len(low), len(frames)), dtype=bool)
    for axis in (0, 1):
        apart |= low[:, axis, None] > frames[None, :, 2 + axis] + clear
        apart |= high[:, axis, None] < frames[None, :, axis] - clear
    return ~apart


def _crossings(low: Corners, high: Corners, near: Point, frames: Corners) -> Corners:
    """Return for each candidate how many frames its leader would cross."""
    start = np.asarray(near)
    ends = np.clip(start, low, high)
    long = np.hypot(*(ends - start).T)
    # A leader may begin within a frame: what it leads from.
    (out,) = np.nonzero(long >= _AT_START_IN)
    begins = start + (ends[out] - start) * (_AT_START_IN / long[out, None])
    leaders = shapely.linestrings(np.stack((begins, ends[out]), axis=1))
    # By a tree, a quarter of the time of a plan with 300 arrays, which has thousands of frames.
    crossed, _ = shapely.STRtree(shapely.box(*frames.T)).query(leaders, predicate="intersects")
    return np.bincount(out[crossed], minlength=len(low)).astype(float)
