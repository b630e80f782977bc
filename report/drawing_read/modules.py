"""Modules of a roof drawing, grouped into arrays, each with its outline.

Twelve equal rectangles of 2.0 by 1.1 m, 0.3 m apart, are one array, outlined with its gaps closed.

Knows no file and no texts (`report.drawing_read.plan_read`). Read `joined` first. Points are
complex.
"""

from __future__ import annotations

import cmath
import math
from collections import Counter, defaultdict
from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np
import shapely
from numpy.typing import NDArray

from report.drawing_read.roof_drawing import DrawnOutline
from report.project.model.choices import LayerKind
from report.project.model.shapes import Polygon, mean, ring, solid
from report.project.read.locate import MAX_ROWS
from report.text.units import LENGTHS
from solver.errors import InputError
from solver.model import INCH_M

# Largest gap between modules of one array [m] by default.
GAP_M = 20.0 * INCH_M

# Shortest and longest side of a module in plan [m].
SIDES_M = (0.5, 2.6)

# Equal rectangles of a layer from which on they are modules; fewer are arrays.
LEAST_ALIKE = 3

# Sides within this [m] are equal; a step of an outline within this is none.
ALIKE_M = 0.005
# Steps [m] that exports round coordinates to; a finer one is within `ALIKE_M`.
ROUNDED_M = (
    *(share * LENGTHS["ft"] for share in (1.0, 0.5, 0.25, 0.1)),
    *(share * INCH_M for share in (1.0, 0.5, 0.25, 0.125)),
    0.1, 0.05, 0.01, 0.005, 0.01 * LENGTHS["ft"], 0.1 * INCH_M, 0.002,
)  # fmt: skip
# Coordinates rounded to more than this [m] do not tell modules that are turned.
COARSEST_M = ROUNDED_M[3]
# Gaps larger by this [m] are the largest one rounded, such as 20 in to 1.7 ft.
ROUNDED_GAP_M = 0.015

# Texts within an array of which one may be its name; more are those of its modules.
MOST_TEXTS = 3

_PARALLEL_DEG, _NO_TURN_RAD = 0.5, 1e-5
# A corner is off by 0.71 steps at most: two sides by 2.8 from each other, and places by 1.4.
_SIDE_STEPS, _PLACE_STEPS, _DEG_PER_M = 3.0, 2.0, 110.0
_OFF_STEP = 0.13  # such as whole inches in feet with two decimals
_MOST_PER_M2 = 16  # drawn twice, and with inner lines
# Points as complex numbers: to turn a plan is then one product.
_COMPLEX = np.array((1.0, 1.0j))
# By the ends of a box: left, bottom, right, top.
_OUTWARD = np.array((-1.0, -1.0, 1.0, 1.0))

_KINDS = (LayerKind.ARRAY, LayerKind.UNLIKE_ARRAY)


def joined(
    outlines: Sequence[DrawnOutline], gap_m: float, turned_deg: float = 0.0
) -> tuple[list[DrawnOutline], list[DrawnOutline], list[DrawnOutline]]:
    """Return lines without modules, the arrays of modules in reading order, and lines they overlap.

    Modules are equal rectangles of one layer, at least `LEAST_ALIKE`, with sides within `SIDES_M`.
    Parallel ones are an array where the gaps along their sides are at most `gap_m` [m]. Coordinates
    were rounded before the drawing was turned by `turned_deg`.

    Raises `InputError` if more rectangles lie at one place than modules can, if they make up too
    many arrays, or if their coordinates are too coarse to tell.
    """
    layers: dict[tuple[LayerKind, str], list[int]] = defaultdict(list)
    for index, line in enumerate(outlines):
        # What `report` wrote is an array already, however small.
        if line.kind in _KINDS and not line.is_ours:
            layers[line.kind, line.layer.casefold()].append(index)
    arrays: list[DrawnOutline] = []
    gone: dict[int, bool] = {}  # whether a line is a module that counts
    for indices in layers.values():
        for array, inside in _arrays([outlines[k] for k in indices], gap_m, turned_deg):
            arrays.append(array)
            if len(arrays) > MAX_ROWS:
                raise InputError(f"modules make up more than {MAX_ROWS} arrays; use a larger --gap")
            gone |= {indices[k]: counts for k, counts in inside.items()}
    for kind in _KINDS:
        # Those of layouts that draw the outline of an array around its modules.
        drawn = [k for k, line in enumerate(outlines) if line.kind is kind and k not in gone]
        # Neighbors share a border, which is nothing in common.
        inner = [solid(array.shape).buffer(-ALIKE_M) for array in arrays if array.kind is kind]
        area = shapely.union_all(inner)
        shapely.prepare(area)
        across = shapely.intersects(area, [solid(outlines[k].shape) for k in drawn])
        gone |= {k: False for k, overlaps in zip(drawn, across, strict=True) if overlaps}
    remaining = [line for index, line in enumerate(outlines) if index not in gone]
    return remaining, _in_reading_order(arrays), [outlines[k] for k in gone if not gone[k]]


def _in_reading_order(arrays: Sequence[DrawnOutline]) -> list[DrawnOutline]:
    """Return arrays by rows from the top, each from the left."""
    rows: list[list[DrawnOutline]] = []
    for array in sorted(arrays, key=_middle_y_m, reverse=True):
        if not rows or _middle_y_m(array) < rows[-1][0].shape.bounds.y_from_m:
            rows.append([])
        rows[-1].append(array)
    ordered: list[DrawnOutline] = []
    for row in rows:
        ordered += sorted(row, key=lambda array: array.shape.bounds.x_from_m)
    return ordered


def _middle_y_m(array: DrawnOutline) -> float:
    return mean(array.shape.bounds.points)[1]


def _arrays(
    lines: Sequence[DrawnOutline], gap_m: float, turned_deg: float
) -> Iterator[tuple[DrawnOutline, dict[int, bool]]]:
    """Yield the arrays of a layer, with the lines within each and whether they are its modules."""
    small = [k for k, line in enumerate(lines) if line.shape.area_m2 <= SIDES_M[1] ** 2]
    middles = np.array([complex(*mean(lines[k].shape.points)) for k in small])
    groups = list(_parallel(lines, turned_deg))
    modules: set[int] = set()
    for indices, *_ in groups:
        modules.update(indices)
    for indices, sizes, boxes, turn, step in groups:
        row = {k: n for n, k in enumerate(indices)}
        within_m = ALIKE_M + _PLACE_STEPS * step
        widest = gap_m + max(ROUNDED_GAP_M, within_m)
        parts = _closed(boxes, widest)
        turned_middles = middles / turn
        inside: list[dict[int, bool]] = [{} for _ in parts]
        tree = shapely.STRtree(shapely.points(turned_middles.real, turned_middles.imag))
        for part, n in tree.query(parts, predicate="contains").T:
            if small[n] in row or small[n] not in modules:
                inside[part][small[n]] = small[n] in row
        for part, within in zip(parts, inside, strict=True):
            its = [row[k] for k in within if within[k]]
            # The outline of the rounded boxes has a step for each: it is drawn again of boxes in
            # line, unless that would tear the array apart.
            again = _closed(_snapped(boxes[its], within_m), widest + 2.0 * within_m)
            outline = again[0] if len(again) == 1 else part
            points = np.array(outline.exterior.coords) @ _COMPLEX * turn
            kinds = Counter(map(tuple, sizes[its].tolist())).most_common()
            first = lines[indices[its[0]]]
            is_block = all(lines[indices[n]].handle == first.handle for n in its)
            yield (
                DrawnOutline(
                    handle=first.handle,
                    layer=first.layer,
                    name=first.name if is_block else "",  # of each block, it is that of a product
                    kind=first.kind,
                    shape=Polygon(ring([(float(z.real), float(z.imag)) for z in points])),
                    sizes=tuple((count, long, short) for (long, short), count in kinds),
                    rounded_m=step if turn != 1.0 else 0.0,
                ),
                within,
            )


def _parallel(
    lines: Sequence[DrawnOutline], turned_deg: float
) -> Iterator[tuple[list[int], Any, Any, complex, float]]:
    """Yield the parallel modules of a layer: lines, sizes, boxes, direction, step of rounding."""
    # Sizes are those of equal ones; boxes, along their sides, are x from, y from, x to and y to.
    four = [
        k for k, line in enumerate(lines)
        if len(line.shape.points) == 4
        and line.shape.area_m2 <= (SIDES_M[1] + ROUNDED_M[0]) ** 2
    ]  # fmt: skip
    corners = np.array([lines[k].shape.points for k in four]).reshape(-1, 4, 2) @ _COMPLEX
    along = corners - np.roll(corners, 1, axis=1)  # its first is the side to the first corner
    a, b = 0.5 * (along[:, 1] - along[:, 3]), 0.5 * (along[:, 2] - along[:, 0])
    step, is_turned = _rounding(corners * cmath.rect(1.0, -math.radians(turned_deg)))
    alike = ALIKE_M + (_SIDE_STEPS if is_turned else 1.0) * step
    # 0 for a parallelogram, whose diagonals halve each other.
    skew = np.abs(corners @ np.array((1, -1, 1, -1)))
    long, short = np.maximum(abs(a), abs(b)), np.minimum(abs(a), abs(b))
    is_right = (skew <= 2.0 * alike) & (abs((a * b.conj()).real) <= alike * long)
    fits = is_right & (short >= SIDES_M[0] - alike) & (long <= SIDES_M[1] + alike)
    if step > COARSEST_M and fits.sum() >= LEAST_ALIKE:
        raise InputError(
            f"layer {lines[four[0]].layer}: coordinates of rotated modules are rounded to"
            f" {1e3 * step:.4g} mm, which does not tell their arrays; export more decimals"
        )
    sizes = np.full((len(four), 2), np.nan)
    for equal in _equal(long, short, np.flatnonzero(fits), alike):
        if len(equal) >= LEAST_ALIKE:
            # Those of a drawing along its axes are as it has them.
            groups = [equal] if is_turned else _equal(long, short, equal, ALIKE_M)
            for same in groups:
                sizes[same] = long[same].mean(), short[same].mean()
    step = step if is_turned else 0.0
    parallel_deg = _PARALLEL_DEG + _DEG_PER_M * step
    angles = np.degrees(np.angle(np.where(abs(a) >= abs(b), a, b))) % 90.0
    runs = _runs(angles, np.flatnonzero(np.isfinite(sizes[:, 0])), parallel_deg)
    # Angles are taken modulo 90: 0.1 and 89.9 degrees are neighbors.
    if len(runs) > 1 and angles[runs[0][0]] + 90.0 - angles[runs[-1][0]] <= parallel_deg:
        runs[0] = np.concatenate((runs[0], runs.pop()))
    for run in runs:
        off = (angles[run] - angles[run[0]] + 45.0) % 90.0 - 45.0
        angle = math.radians((angles[run[0]] + float(off.mean()) + 45.0) % 90.0 - 45.0)
        turn = complex(math.cos(angle), math.sin(angle)) if abs(angle) > _NO_TURN_RAD else 1.0
        turned_corners = corners[run] / turn
        ends = [
            np.sort(part, axis=1).reshape(-1, 2, 2).mean(2)
            for part in (turned_corners.real, turned_corners.imag)
        ]
        boxes = np.stack((ends[0][:, 0], ends[1][:, 0], ends[0][:, 1], ends[1][:, 1]), axis=1)
        once = _once(boxes, lines[four[run[0]]].layer)
        yield [four[k] for k in run[once]], sizes[run[once]], boxes[once], turn, step


def _rounding(corners: Any) -> tuple[float, bool]:
    """Return the step that the corners of a layer are rounded to [m], and if they are turned."""
    # It is 0 for a fine one, and for a coarse one of a layer along the axes: as that was meant.
    along = np.diff(corners, axis=1)
    is_turned = bool((np.minimum(abs(along.real), abs(along.imag)) > ROUNDED_M[-1]).any())
    values = np.ravel(corners - corners[:1, :1])
    parts = np.concatenate((values.real, values.imag))
    for step in ROUNDED_M if len(corners) >= LEAST_ALIKE else ():
        if np.abs(parts / step - np.rint(parts / step)).max() <= _OFF_STEP:
            return (step if is_turned or step <= COARSEST_M else 0.0), is_turned
    return 0.0, is_turned


def _equal(long: Any, short: Any, indices: Any, width: float) -> Iterator[NDArray[np.intp]]:
    """Yield the indices `at` of equal sizes."""
    for run in _runs(long, indices, width):
        yield from _runs(short, run, width)


def _runs(values: Any, indices: Any, width: float) -> list[NDArray[np.intp]]:
    """Return the indices `at` by runs of ascending values, none wider than a width."""
    # Stable: equal values keep the order of the drawing.
    order = indices[np.argsort(values[indices], kind="stable")]
    starts: list[int] = []
    for place, value in enumerate(values[order]):
        if not starts or value - values[order[starts[-1]]] > width:
            starts.append(place)
    return np.split(order, starts[1:]) if starts else []


def _once(boxes: Any, layer: str) -> Any:
    """Return which boxes are modules: none that is drawn again, and no line within another one."""
    middles = 0.5 * (boxes[:, :2] + boxes[:, 2:])
    densest = max(Counter(map(tuple, np.floor(middles).tolist())).values())
    if densest > _MOST_PER_M2:  # their pairs would be without number
        text = f"layer {layer}: {densest} module-size rectangles on one square meter"
        raise InputError(f"{text}, more than {_MOST_PER_M2}; save one outline for each module")
    tree = shapely.STRtree(shapely.box(*boxes.T))
    inner, outer = tree.query(shapely.points(middles), predicate="intersects")
    # To 0.01 m2, so that equal modules stay in their order whatever the last bit of their areas.
    areas = np.round(np.prod(boxes[:, 2:] - boxes[:, :2], axis=1), 2)
    rank = np.argsort(np.argsort(-areas, kind="stable"))
    return ~np.isin(np.arange(len(boxes)), inner[rank[outer] < rank[inner]])


def _closed(boxes: Any, width_m: float) -> list[Any]:
    """Return the polygons of boxes with the gaps up to a width [m] closed."""
    half = 0.5 * width_m
    grown = boxes + half * _OUTWARD
    blocks = shapely.box(*_blocks(grown).T)
    touching = shapely.STRtree(blocks).query(blocks, predicate="intersects")
    # Each touches itself; most arrays are one block, and of others the union takes longer.
    areas = blocks if touching.shape[1] == len(blocks) else shapely.union_all(shapely.box(*grown.T))
    return list(shapely.get_parts(shapely.buffer(areas, -half, join_style="mitre")))


def _blocks(boxes: Any) -> Any:
    """Return the boxes that rows and columns of boxes of one width fill without a gap."""
    for near, along in ((1, 0), (0, 1)):
        width = [near, near + 2]
        boxes = boxes[np.lexsort((boxes[:, along], *boxes[:, width].T))]
        is_next = (boxes[1:, width] == boxes[:-1, width]).all(axis=1)
        is_next &= boxes[1:, along] <= boxes[:-1, along + 2]
        starts = np.flatnonzero(np.concatenate(([True], ~is_next)))
        ends = np.maximum.reduceat(boxes[:, along + 2], starts)
        boxes = boxes[starts]
        boxes[:, along + 2] = ends
    return boxes


def _snapped(boxes: Any, alike: float) -> Any:
    """Return boxes without the steps between them that a drawing did not mean."""
    snapped = boxes.copy()
    for side in range(4):
        for run in _runs(boxes[:, side], np.arange(len(boxes)), alike):
            snapped[run, side] = boxes[run, side].mean()
    return snapped
