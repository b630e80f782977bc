"""Open lines of a drawing whose ends meet, joined into closed lines.

The four sides of an array that are drawn one by one are its outline, wherever each begins. Where
three lines meet at a point, it is ambiguous which belong together. Read `join`.
"""

from __future__ import annotations

import math
from collections import Counter, defaultdict
from collections.abc import Mapping, Sequence
from itertools import chain, product

from ezdxf import edgeminer

from report.project.model.shapes import Point

OPEN = "an open line that is not part of a closed outline"
BRANCHED = "three or more open lines that meet at a point"

Line = Sequence[Point]
# A closed line, and which open ones it consists of.
Closed = tuple[list[Point], list[int]]


def join(lines: Sequence[Line], tolerance: float) -> tuple[list[Closed], Mapping[int, str]]:
    """Return closed lines from open ones with ends within a tolerance, and reasons for the rest."""
    cells: dict[Point, list[Point]] = defaultdict(list)
    # Ends that meet are one point from here on, so that a chain is found by equality.
    ends: dict[int, tuple[Point, Point]] = {}
    drawn: dict[tuple[Point, ...], int] = {}
    loops: list[list[tuple[int, bool]]] = []
    for k, points in enumerate(lines):
        start, end = (_snapped(point, cells, tolerance) for point in (points[0], points[-1]))
        if start != end:
            ends[k] = (start, end)
            # From the smaller end to the larger one, so that a line that is drawn twice, once in
            # reverse, has one key.
            middle = points[1:-1] if start < end else points[-2:0:-1]
            drawn.setdefault((*sorted((start, end)), *middle), k)
        elif len(points) > 2:
            loops.append([(k, False)])
    meeting = Counter(chain.from_iterable(ends[k] for k in drawn.values()))
    # Where no more than two meet a chain has no choice, and all takes linear time.
    edges = [
        edgeminer.make_edge(*ends[k], payload=k)
        for k in drawn.values()
        if all(meeting[end] == 2 for end in ends[k])
    ]
    gap = 0.5 * tolerance
    deposit = edgeminer.Deposit(edges, gap_tol=gap) if edges else None
    for edges_of_chain in edgeminer.find_all_simple_chains(deposit) if deposit else ():
        if len(edges_of_chain) > 1 and edgeminer.is_loop(edges_of_chain, gap_tol=gap):
            loop = [(edge.payload, edge.is_reverse) for edge in edges_of_chain]
            # From the line that was drawn first: the library may begin anywhere, and the same
            # drawing must give the same outline.
            first = loop.index(min(loop))
            loops.append([*loop[first:], *loop[:first]])
    # Lines that are drawn twice count once.
    unused = set(range(len(lines))) - {k for k, _ in chain.from_iterable(loops)}
    unused -= ends.keys() - set(drawn.values())
    reasons = {}
    for k in sorted(unused):
        is_branched = any(meeting[end] > 2 for end in ends.get(k, ()))
        reasons[k] = BRANCHED if is_branched else OPEN
    return [_closed(lines, loop) for loop in sorted(loops)], reasons


def _snapped(point: Point, cells: dict[Point, list[Point]], tolerance: float) -> Point:
    """Return the end that stands for another within the tolerance."""
    # Two that stand for others are farther apart: so ends that meet one meet each other, and a
    # chain cannot lead around without end.
    column, row = (math.floor(value / tolerance) for value in point)
    for i, j in product((-1, 0, 1), repeat=2):
        for end in cells.get((column + i, row + j), ()):
            if math.dist(point, end) <= tolerance:
                return end
    cells[column, row].append(point)
    return point


def _closed(lines: Sequence[Line], loop: Sequence[tuple[int, bool]]) -> Closed:
    """Return a chain as a closed line; of the two ends at a corner, the one that begins a line."""
    points: list[Point] = []
    for k, is_reversed in loop:
        line = lines[k][::-1] if is_reversed else lines[k]
        points += line[:-1]
    return points, [k for k, _ in loop]
