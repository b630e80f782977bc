"""Places labels on a drawing so that none touches another.

Sizes and positions are in inches on paper; draws nothing. Read `Placer` first.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import cache

import numpy as np
from matplotlib import font_manager

from report.figures.base import FAMILY

TYPE_PT = 9.0  # the renderer clips letters of 8.5 pt
LINE_IN = 1.33 * TYPE_PT / 72.0
"""Distance between lines of a label."""

_CLEAR_IN = 0.035  # between labels
_RINGS_IN = np.concatenate((np.arange(0.0, 1.6, 0.06), np.arange(1.6, 4.0, 0.2)))
_TURNS = np.deg2rad(np.arange(0.0, 360.0, 10.0))
_OFFSETS = np.column_stack(
    (np.outer(_RINGS_IN, np.cos(_TURNS)).ravel(), np.outer(_RINGS_IN, np.sin(_TURNS)).ravel())
)
_TRIED = 200  # candidates whose leaders are checked, the nearest ones
_AT_START_IN = 0.12  # length of a leader within the mark that it leads from

Point = tuple[float, float]


@dataclass(frozen=True, slots=True)
class Frame:
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


def centered(x: float, y: float, wide: float, tall: float) -> Frame:
    """Return a frame about a point."""
    return Frame(x - wide / 2, y - tall / 2, x + wide / 2, y + tall / 2)


@cache
def _font(weight: str) -> font_manager.FontProperties:
    return font_manager.FontProperties(family=FAMILY, weight=weight, size=TYPE_PT)


@cache
def width_in(text: str, weight: str = "regular") -> float:
    """Return the width of a text [in] at `TYPE_PT`."""
    font = font_manager.get_font(font_manager.findfont(_font(weight)))
    font.set_size(TYPE_PT, 72.0 * 16)  # the resolution removes the rounding to pixels
    font.set_text(text, 0.0)
    wide: float = font.get_width_height()[0] / 64.0
    return wide / 16.0 / 72.0


class Placer:
    """Labels placed so far, and what they should not cover."""

    def __init__(self, page: Frame) -> None:
        self._page = page
        self._taken: list[Frame] = []
        self._threads: list[Frame] = []
        self._lines: list[Frame] = []

    def take(self, frame: Frame) -> None:
        """Reserve a frame: no label will touch it."""
        self._taken.append(frame)

    def release(self, frame: Frame) -> None:
        """Give a reserved frame back."""
        self._taken.remove(frame)

    def avoid(self, frame: Frame) -> None:
        """Mark a line or a small object, covered only where there is no other room."""
        self._lines.append(frame)

    def take_segment(self, a: Point, b: Point) -> None:
        """Reserve a line between two points: no label will touch it, leaders may cross it."""
        count = max(2, math.ceil(math.dist(a, b) / 0.06))
        for x, y in zip(
            np.linspace(a[0], b[0], count), np.linspace(a[1], b[1], count), strict=True
        ):
            self._threads.append(centered(float(x), float(y), 0.02, 0.02))

    def place(
        self,
        wide: float,
        tall: float,
        near: Point,
        within: Frame | None = None,
        maximum: float = 4.0,
    ) -> Frame | None:
        """Reserve and return the frame of a label nearest to a point; None if there is no room.

        A straight leader from the point to the label crosses no other label.

        Parameters
        ----------
        within : Frame, optional
            Where it must lie; the page if not given.
        maximum : float
            Largest distance of its center from the point [in].
        """
        page = self._page if within is None else within
        size = np.array((wide, tall))
        low = _OFFSETS[np.hypot(*_OFFSETS.T) <= maximum] + near - size / 2
        low = low[np.all(low >= (page.x0, page.y0), axis=1)]
        low = low[np.all(low + size <= (page.x1, page.y1), axis=1)]
        everything = [*self._taken, *self._threads]
        low = low[~_touches(low, low + size, everything, _CLEAR_IN).any(axis=1)]
        cost = np.hypot(*(low + size / 2 - near).T)
        cost += 0.6 * _touches(low, low + size, self._lines, 0.015).sum(axis=1)
        first = np.argsort(cost, kind="stable")[:_TRIED]
        low, cost = low[first], cost[first]
        is_free = _crossings(low, low + size, near, self._taken) == 0.0
        if not is_free.any():
            return None
        cost += 0.5 * _crossings(low, low + size, near, self._threads)
        x0, y0 = (float(v) for v in low[int(np.argmin(np.where(is_free, cost, np.inf)))])
        frame = Frame(x0, y0, x0 + wide, y0 + tall)
        self.take(frame)
        return frame


Corners = np.ndarray[tuple[int, ...], np.dtype[np.float64]]


def _touches(low: Corners, high: Corners, frames: Sequence[Frame], clear: float) -> Corners:
    """Return for each candidate and frame whether they come nearer than a distance."""
    if not frames:
        return np.zeros((len(low), 1), dtype=bool)
    table = np.array([(f.x0, f.y0, f.x1, f.y1) for f in frames])
    apart = np.zeros((len(low), len(frames)), dtype=bool)
    for axis in (0, 1):
        apart |= low[:, axis, None] > table[None, :, 2 + axis] + clear
        apart |= high[:, axis, None] < table[None, :, axis] - clear
    return ~apart


def _crossings(low: Corners, high: Corners, near: Point, frames: Sequence[Frame]) -> Corners:
    """Return for each candidate how many frames its leader would cross."""
    if not len(low):
        return np.zeros(0)
    ends = nearest_point(low, high, near)
    start = np.asarray(near)
    at = np.linspace(0.0, 1.0, 16)[:, None, None]
    points = start + at * (ends - start)[None]
    flat = points.reshape(-1, 2)
    touched = _touches(flat, flat, frames, 0.0)
    far = np.hypot(*(flat - start).T) > _AT_START_IN
    crossed = (touched & far[:, None]).reshape(len(at), len(low), -1).any(axis=0)
    return np.asarray(crossed.sum(axis=1), dtype=float)


def nearest_point(low: Corners, high: Corners, near: Iterable[float]) -> Corners:
    """Return the point of each frame that is nearest to a point."""
    point: Corners = np.clip(np.asarray(tuple(near)), low, high)
    return point
