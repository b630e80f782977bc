"""Modules of a layout become the arrays that they make up, with exact outlines."""

import math
import random

import pytest

from inputs import FT, INCH
from report.drawing.modules import joined
from report.drawing.read_dxf import Drawn
from report.sheet.schema import LayerKind, Polygon, Rectangle
from sketch import Sketch, plan
from solver.model import InputError

LONG, SHORT = 2.0, 1.1
ROW, COLUMN = 0.4, 0.02
"""Gaps between the rows and the columns of modules [m]."""

PITCH_X, PITCH_Y = LONG + COLUMN, SHORT + ROW
CORNERS = ((0, 0), (LONG, 0), (LONG, SHORT), (0, SHORT))

# Rows from the bottom, each with its columns from and to; lower left corner [m].
FIELDS = {
    "A1": ((0.0, 40.0), [(0, 8)] * 5),
    "A2": ((30.0, 41.0), [(0, 6)] * 2 + [(0, 3)] * 3),  # an L
    "A3": ((60.0, 40.0), [(0, 4)] * 5),
    "A4": ((0.0, 10.0), [(0, 10)] * 4),
    "A5": ((30.0, 10.0), [(2, 5), (0, 7), (2, 5)]),  # a cross
}
COUNTS = {"A1": 40, "A2": 21, "A3": 20, "A4": 40, "A5": 13}


def modules(fields=FIELDS):
    """The lower left corners of modules [m]."""
    for (x, y), rows in fields.values():
        for row, (start, end) in enumerate(rows):
            yield from ((x + k * PITCH_X, y + row * PITCH_Y) for k in range(start, end))


def turned(points, deg):
    cos, sin = math.cos(math.radians(deg)), math.sin(math.radians(deg))
    return [(x * cos - y * sin, x * sin + y * cos) for x, y in points]


def layout(deg=0.0, noise=0.0, seed=1):
    """A sketch of all fields turned about the origin, with vertices that are off by a noise [m]."""
    sketch, chance = Sketch(unit="m"), random.Random(seed)
    corners = list(modules())
    chance.shuffle(corners)
    for x, y in corners:
        start = chance.randrange(4)  # any corner first, either way round
        points = turned([(x + a, y + b) for a, b in CORNERS], deg)
        points = (points[start:] + points[:start])[:: chance.choice((1, -1))]
        points = [(x + chance.uniform(-noise, noise), y + chance.uniform(-noise, noise))
                  for x, y in points]  # fmt: skip
        sketch.space.add_lwpolyline(points, close=True, dxfattribs={"layer": "ARRAY"})
    return sketch


def edges(columns):
    """Where a run of columns, or of rows, starts and ends."""
    return columns[0] * PITCH_X, (columns[1] - 1) * PITCH_X + LONG


def outline(name):
    """The exact outline of a field, from its lowest left corner."""
    (x, y), rows = FIELDS[name]
    top = (len(rows) - 1) * PITCH_Y + SHORT
    (x0, x1) = edges(rows[0])
    points = {
        "A2": [(x0, 0), (x1, 0), (x1, PITCH_Y + SHORT), (edges((0, 3))[1], PITCH_Y + SHORT),
               (edges((0, 3))[1], top), (x0, top)],
        "A5": [(x0, 0), (x1, 0), (x1, PITCH_Y), (edges((0, 7))[1], PITCH_Y),
               (edges((0, 7))[1], PITCH_Y + SHORT), (x1, PITCH_Y + SHORT), (x1, top), (x0, top),
               (x0, PITCH_Y + SHORT), (0, PITCH_Y + SHORT), (0, PITCH_Y), (x0, PITCH_Y)],
    }.get(name, [(x0, 0), (x1, 0), (x1, top), (x0, top)])  # fmt: skip
    return [(x + a, y + b) for a, b in points]


def is_ring(got, wanted, within):
    """Whether two rings have the same vertices in the same order, from any first one."""
    got, wanted = list(got), list(wanted)
    near = min(range(len(got)), key=lambda k: math.dist(got[k], wanted[0]))
    turned_on = got[near:] + got[:near]
    return len(got) == len(wanted) and all(
        math.dist(a, b) <= within for a, b in zip(turned_on, wanted, strict=True)
    )


@pytest.mark.parametrize("deg", [0.0, 17.0, 45.0, -3.5, 90.0])
@pytest.mark.parametrize(("noise", "within"), [(0.0, 1e-8), (0.0005, 0.0015)])
def test_modules_become_arrays_with_their_outlines(tmp_path, deg, noise, within):
    found = plan(layout(deg, noise).saved(tmp_path))
    assert found.unread == ()
    assert sorted(place.name for place in found.arrays) == sorted(FIELDS)
    for place in found.arrays:
        wanted = {name: turned(outline(name), deg) for name in FIELDS}
        (name,) = (n for n in FIELDS if is_ring(place.shape.points, wanted[n], within))
        assert place.modules.count == COUNTS[name]
        ((_, long, short),) = place.modules.sizes
        assert (long, short) == pytest.approx((LONG, SHORT), abs=max(within, 1e-9))
        assert place.modules.gap_m == pytest.approx(ROW, abs=2 * within + 1e-9)
        assert place.modules.opening_m2 == 0.0
        is_box = deg in (0.0, 90.0) and name in ("A1", "A3", "A4") and noise == 0.0
        assert isinstance(place.shape, Rectangle) or not is_box
        if deg == 0.0:
            assert place.name == name  # in reading order
            assert place.note == "named in reading order"
