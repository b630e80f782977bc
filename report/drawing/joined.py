"""Joins open lines, whose ends meet within a tolerance, to closed ones, where no choice is left.

Knows no drawing (`report.drawing.read_dxf`). Read `join`.
"""

from __future__ import annotations

import math
from collections import Counter, defaultdict
from collections.abc import Mapping, Sequence
from typing import NamedTuple

from report.sheet.schema.shapes import Point

OPEN = "an open line that closes no outline"
BRANCHED = "open lines of which three or more meet at a point"

Line = Sequence[Point]


class Joined(NamedTuple):
    """A closed line, and which open ones it consists of."""

    points: list[Point]
    lines: list[int]


def join(lines: Sequence[Line], tolerance: float) -> tuple[list[Joined], Mapping[int, str]]:
    """Return the closed lines that open ones form, and why the rest of these does not.

    The tolerance is the largest distance of ends that meet.
    """
    from ezdxf import edgeminer

    cells: dict[Point, list[Point]] = defaultdict(list)
    ends: dict[int, tuple[Point, Point]] = {}
    drawn: dict[tuple[Point, ...], int] = {}
    loops: list[list[tuple[int, bool]]] = []
    for k, points in enumerate(lines):
        start, end = (_snapped(at, cells, tolerance) for at in (points[0], points[-1]))
        if start != end:
            ends[k] = (start, end)
            middle = points[1:-1] if start < end else points[-2:0:-1]
            drawn.setdefault((*sorted((start, end)), *middle), k)
        elif len(points) > 2:
            loops.append([(k, False)])
    meeting = Counter(end for k in drawn.values() for end in ends[k])
    # Where no more than two meet a chain has no choice, and all takes linear time.
    edges = [
        edgeminer.make_edge(*ends[k], payload=k)
        for k in drawn.values()
        if all(meeting[end] == 2 for end in ends[k])
    ]
    deposit = edgeminer.Deposit(edges, gap_tol=0.5 * tolerance) if edges else None
    for chain in edgeminer.find_all_simple_chains(deposit) if deposit else ():
        if len(chain) > 1 and edgeminer.is_loop(chain, gap_tol=0.5 * tolerance):
            loop = [(edge.payload, edge.is_reverse) for edge in chain]
            first = loop.index(min(loop))
            loops.append([*loop[first:], *loop[:first]])
    # Lines that are drawn twice count once.
    left = set(range(len(lines))) - {k for loop in loops for k, _ in loop}
    left -= ends.keys() - set(drawn.values())
    return [_closed(lines, loop) for loop in sorted(loops)], {
        k: BRANCHED if any(meeting[end] > 2 for end in ends.get(k, ())) else OPEN
        for k in sorted(left)
    }


def _snapped(at: Point, cells: dict[Point, list[Point]], tolerance: float) -> Point:
    """Return the end that stands for another within the tolerance.

    Two that stand for others are farther apart: so ends that meet one meet each other, and a chain
    cannot lead around without end.
    """
    column, row = (math.floor(value / tolerance) for value in at)
    for i, j in ((i, j) for i in (-1, 0, 1) for j in (-1, 0, 1)):
        for other in cells.get((column + i, row + j), ()):
            if math.dist(at, other) <= tolerance:
                return other
    cells[column, row].append(at)
    return at


def _closed(lines: Sequence[Line], loop: Sequence[tuple[int, bool]]) -> Joined:
    """Return a chain as a closed line; its corners are midway between the ends that meet."""
    parts = [lines[k][::-1] if is_reversed else lines[k] for k, is_reversed in loop]
    points: list[Point] = []
    for before, part in zip((parts[-1], *parts), parts, strict=False):
        (x0, y0), (x1, y1) = before[-1], part[0]
        points += [(0.5 * (x0 + x1), 0.5 * (y0 + y1)), *part[1:-1]]
    return Joined(points, [k for k, _ in loop])
