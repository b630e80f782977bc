"""Joins open lines, whose ends meet within a tolerance, to closed ones, where no choice is left.

Knows no drawing (`report.drawing.read_dxf`). Read `join`.
"""

from __future__ import annotations

import math
from collections import Counter, defaultdict
from collections.abc import Mapping, Sequence

from report.sheet.schema.shapes import Point

OPEN = "an open line that closes no outline"
BRANCHED = "open lines of which three or more meet at a point"

Line = Sequence[Point]


Closed = tuple[list[Point], list[int]]
"""A closed line, and which open ones it consists of."""


def join(lines: Sequence[Line], tolerance: float) -> tuple[list[Closed], Mapping[int, str]]:
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
    gap = 0.5 * tolerance
    deposit = edgeminer.Deposit(edges, gap_tol=gap) if edges else None
    for chain in edgeminer.find_all_simple_chains(deposit) if deposit else ():
        if len(chain) > 1 and edgeminer.is_loop(chain, gap_tol=gap):
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


def _closed(lines: Sequence[Line], loop: Sequence[tuple[int, bool]]) -> Closed:
    """Return a chain as a closed line; of the two ends at a corner, the one that begins a line."""
    parts = [lines[k][::-1] if is_reversed else lines[k] for k, is_reversed in loop]
    return [point for part in parts for point in part[:-1]], [k for k, _ in loop]
