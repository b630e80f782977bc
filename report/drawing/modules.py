"""Modules of a roof drawing, joined into the arrays that they make up, each with its outline.

Knows no file and no texts (`report.drawing.plan_read`). Read `joined` first. Points are complex.
"""

from __future__ import annotations

import math
from collections import Counter, defaultdict
from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from report.drawing.roof_drawing import Drawn
from report.sheet.reading.locate import MAX_ROWS
from report.sheet.schema.choices import LayerKind
from report.sheet.schema.shapes import Polygon, Rectangle, Shape, mean, ring, solid
from solver.model import INCH_M, InputError

GAP_M = 20.0 * INCH_M
"""Largest gap between modules of one array [m] by default."""

SIDES_M = (0.5, 2.6)
"""Shortest and longest side of a module in plan [m]."""

LEAST_ALIKE = 3
"""Equal rectangles of a layer from which on they are modules; fewer are arrays."""

ALIKE_M = 0.005
"""Sides within this [m] are equal; a step of an outline within this is none."""
COARSE_M, COARSE_ALIKE_M = 0.01, 0.015
"""The same for a drawing whose coordinates are all rounded to a centimeter, in any direction."""
ROUNDED_GAP_M = 0.015
"""Gaps larger by this [m] are the largest one rounded, such as 20 in to 1.7 ft."""

MOST_TEXTS = 3
"""Texts within an array of which one may be its name; more are those of its modules."""

_PARALLEL_DEG, _NO_TURN_RAD = 0.5, 1e-5
_MOST_PER_M2 = 16  # drawn twice, and with inner lines
_COMPLEX = np.array((1.0, 1.0j))
_OUTWARD = np.array((-1.0, -1.0, 1.0, 1.0))

_KINDS = (LayerKind.ARRAY, LayerKind.UNLIKE_ARRAY)

Known = tuple[Drawn, LayerKind, Shape]
"""A closed line, what it is, and its shape [m]."""


_Placed = tuple[Drawn, LayerKind]


def alike_m(lines: Sequence[Drawn], unit_m: float) -> float:
    """Return within which the sides of modules are equal [m], by how a drawing is rounded."""
    points = np.array([point for line in lines for point in line.points]).reshape(-1, 2)
    steps = points * (unit_m / COARSE_M)
    is_coarse = np.allclose(steps, np.rint(steps), rtol=0.0, atol=1e-3)
    return COARSE_ALIKE_M if is_coarse else ALIKE_M


def joined(
    known: Sequence[Known], gap_m: float, alike: float = ALIKE_M
) -> tuple[list[Known], list[_Placed], list[Drawn]]:
    """Return lines without modules, the arrays of modules in reading order, and lines they overlap.

    Modules are equal rectangles of one layer, at least `LEAST_ALIKE`, with sides within `SIDES_M`.
    Parallel ones are an array where the gaps along their sides are at most `gap_m` [m].

    Raises
    ------
    InputError
        If more rectangles lie at one place than modules can, or they make up too many arrays.
    """
    layers: dict[tuple[LayerKind, str], list[int]] = defaultdict(list)
    for index, (line, kind, _) in enumerate(known):
        if kind in _KINDS and not line.is_ours:
            layers[kind, line.layer.casefold()].append(index)
    arrays: list[_Placed] = []
    gone: dict[int, bool] = {}  # whether a line is a module that counts
    for (kind, _), indices in layers.items():
        for array, inside in _arrays([known[index] for index in indices], gap_m, alike):
            arrays.append((array, kind))
            if len(arrays) > MAX_ROWS:
                raise InputError(
                    f"modules make up more than {MAX_ROWS} arrays; give a larger --gap"
                )
            gone |= {indices[k]: counts for k, counts in inside.items()}
    for kind in _KINDS:
        # Those of layouts that draw the outline of an array around its modules.
        others = [k for k, (_, of, _) in enumerate(known) if of is kind and k not in gone]
        across = _overlap([known[k][2] for k in others], [a for a, of in arrays if of is kind])
        gone |= {k: False for k, overlaps in zip(others, across, strict=True) if overlaps}
    rest = [item for index, item in enumerate(known) if index not in gone]
    return rest, _in_reading_order(arrays), [known[k][0] for k in gone if not gone[k]]


def _overlap(shapes: Sequence[Shape], arrays: Sequence[Drawn]) -> Any:
    """Return which shapes have more in common with arrays than their borders."""
    import shapely

    inner = [solid(Polygon(array.points)).buffer(-ALIKE_M) for array in arrays]
    area = shapely.union_all(inner)
    shapely.prepare(area)
    return shapely.intersects(area, [solid(shape) for shape in shapes])


def _in_reading_order(arrays: Sequence[_Placed]) -> list[_Placed]:
    """Return arrays by rows from the top, each from the left."""
    rows: list[list[tuple[Rectangle, _Placed]]] = []
    placed = [(Polygon(item[0].points).bounds, item) for item in arrays]
    for box, item in sorted(placed, key=lambda module: -mean(module[0].points)[1]):
        if not rows or mean(box.points)[1] < rows[-1][0][0].y_from_m:
            rows.append([])
        rows[-1].append((box, item))
    return [item for row in rows for _, item in sorted(row, key=lambda module: module[0].x_from_m)]


def _arrays(
    lines: Sequence[Known], gap_m: float, alike: float
) -> Iterator[tuple[Drawn, dict[int, bool]]]:
    """Yield the arrays of a layer, with the lines within each and whether they are its modules."""
    import shapely

    small = [k for k, (*_, shape) in enumerate(lines) if shape.area_m2 <= SIDES_M[1] ** 2]
    middles = np.array([complex(*mean(lines[k][2].points)) for k in small])
    groups = list(_parallel(lines, alike))
    modules = {k for at, *_ in groups for k in at}
    for at, sizes, boxes, turn in groups:
        row = {k: n for n, k in enumerate(at)}
        parts = _closed(boxes, gap_m + ROUNDED_GAP_M)
        own = middles / turn
        inside: list[dict[int, bool]] = [{} for _ in parts]
        tree = shapely.STRtree(shapely.points(own.real, own.imag))
        for part, n in tree.query(parts, predicate="contains").T:
            if small[n] in row or small[n] not in modules:
                inside[part][small[n]] = small[n] in row
        for part, within in zip(parts, inside, strict=True):
            its = [row[k] for k in within if within[k]]
            again = _closed(_snapped(boxes[its], alike), gap_m + ROUNDED_GAP_M + 2.0 * alike)
            outline = again[0] if len(again) == 1 else part
            points = np.array(outline.exterior.coords) @ _COMPLEX * turn
            kinds = Counter(map(tuple, sizes[its].tolist())).most_common()
            first = lines[at[its[0]]][0]
            is_block = all(lines[at[n]][0].handle == first.handle for n in its)
            yield (
                Drawn(
                    handle=first.handle,
                    layer=first.layer,
                    name=first.name if is_block else "",  # of each block, it is that of a product
                    points=ring([(float(z.real), float(z.imag)) for z in points]),
                    is_ours=False,
                    sizes=tuple((count, long, short) for (long, short), count in kinds),
                ),
                within,
            )


def _parallel(
    lines: Sequence[Known], alike: float
) -> Iterator[tuple[list[int], Any, Any, complex]]:
    """Yield the modules of a layer that are parallel: lines, sizes [m], boxes and their direction.

    Sizes are those of equal ones; boxes, along their sides, are x from, y from, x to and y to [m].
    """
    four = [k for k, (*_, shape) in enumerate(lines) if len(shape.points) == 4]
    corners = np.array([lines[k][2].points for k in four]).reshape(-1, 4, 2) @ _COMPLEX
    a, b = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 1]
    skew = np.abs(corners @ np.array((1, -1, 1, -1)))
    long, short = np.maximum(abs(a), abs(b)), np.minimum(abs(a), abs(b))
    is_right = (skew <= 2.0 * alike) & (abs((a * b.conj()).real) <= alike * long)
    fits = is_right & (short >= SIDES_M[0] - alike) & (long <= SIDES_M[1] + alike)
    sizes = np.full((len(four), 2), np.nan)
    for run in _runs(long, np.flatnonzero(fits), alike):
        for equal in _runs(short, run, alike):
            if len(equal) >= LEAST_ALIKE:
                sizes[equal] = long[equal].mean(), short[equal].mean()
    parallel_deg = _PARALLEL_DEG * alike / ALIKE_M
    angles = np.degrees(np.angle(a)) % 90.0
    runs = _runs(angles, np.flatnonzero(np.isfinite(sizes[:, 0])), parallel_deg)
    if len(runs) > 1 and angles[runs[0][0]] + 90.0 - angles[runs[-1][0]] <= parallel_deg:
        runs[0] = np.concatenate((runs[0], runs.pop()))
    for run in runs:
        off = (angles[run] - angles[run[0]] + 45.0) % 90.0 - 45.0
        angle = math.radians((angles[run[0]] + float(off.mean()) + 45.0) % 90.0 - 45.0)
        turn = complex(math.cos(angle), math.sin(angle)) if abs(angle) > _NO_TURN_RAD else 1.0
        own = corners[run] / turn
        sides = (own.real.min(1), own.imag.min(1), own.real.max(1), own.imag.max(1))
        boxes = np.stack(sides, axis=1)
        once = _once(boxes, lines[four[run[0]]][0].layer)
        yield [four[k] for k in run[once]], sizes[run[once]], boxes[once], turn


def _runs(values: Any, at: Any, width: float) -> list[NDArray[np.intp]]:
    """Return the indices `at` by runs of ascending values, none wider than a width."""
    order = at[np.argsort(values[at], kind="stable")]
    starts: list[int] = []
    for place, value in enumerate(values[order]):
        if not starts or value - values[order[starts[-1]]] > width:
            starts.append(place)
    return np.split(order, starts[1:]) if starts else []


def _once(boxes: Any, layer: str) -> Any:
    """Return which boxes are modules: none that is drawn again, and no line within another one."""
    import shapely

    middles = 0.5 * (boxes[:, :2] + boxes[:, 2:])
    most = max(Counter(map(tuple, np.floor(middles).tolist())).values())
    if most > _MOST_PER_M2:  # their pairs would be without number
        text = f"layer {layer}: {most} rectangles of the size of modules on one square meter"
        raise InputError(f"{text}, more than {_MOST_PER_M2}; save one line for each module")
    tree = shapely.STRtree(shapely.box(*boxes.T))
    inner, outer = tree.query(shapely.points(middles), predicate="intersects")
    areas = np.round(np.prod(boxes[:, 2:] - boxes[:, :2], axis=1), 2)
    rank = np.argsort(np.argsort(-areas, kind="stable"))
    return ~np.isin(np.arange(len(boxes)), inner[rank[outer] < rank[inner]])


def _closed(boxes: Any, width_m: float) -> list[Any]:
    """Return the polygons of boxes with the gaps up to a width [m] closed."""
    import shapely

    half = 0.5 * width_m
    grown = shapely.union_all(shapely.box(*(boxes + half * _OUTWARD).T))
    return list(shapely.get_parts(grown.buffer(-half, join_style="mitre")))


def _snapped(boxes: Any, alike: float) -> Any:
    """Return boxes without the steps between them that a drawing did not mean."""
    snapped = boxes.copy()
    for side in range(4):
        for run in _runs(boxes[:, side], np.arange(len(boxes)), alike):
            snapped[run, side] = boxes[run, side].mean()
    return snapped
