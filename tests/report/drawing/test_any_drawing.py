"""Any hatch, face, mesh, clip and any damage of a drawing: read, or refused; nothing is lost."""

import random

import pytest
from ezdxf.xclip import XClip
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from nightly import nightly
from report.drawing.ballast import read_map
from report.drawing.read_dxf import read_dxf
from sketch import BOX_FT, UNIT_FT, Sketch
from solver.model import InputError

ANY = st.one_of(st.integers(-60, 60).map(float), st.floats(width=32))
POINTS = st.lists(st.tuples(ANY, ANY), min_size=0, max_size=7)
EXTRUSIONS = st.sampled_from([(0, 0, 1), (0, 0, -1), (0, 1, 0), (0, 0, 0.5)])
MANY = settings(deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])
CASES = pytest.mark.parametrize("count", [10, nightly(10_000)])


def is_accounted_for(path):
    """Whether everything drawn is a line, a text or named as not read."""
    try:
        found = read_dxf(path, 1.0)
    except InputError:
        return True
    return bool(found.lines or found.unread)


def hatch(sketch, points, extrusion, seed):
    made = sketch.space.add_hatch(dxfattribs={"layer": "ARRAY", "extrusion": extrusion})
    if seed % 2:
        made.paths.add_polyline_path([(x, y, seed % 5 - 2) for x, y in points], is_closed=True)
        return
    path = made.paths.add_edge_path()
    for (x0, y0), (x1, y1) in zip(points, points[1:] + points[:1], strict=True):
        if seed % 3 == 0 and abs(x1) < 1e3:
            path.add_arc((x0, y0), abs(x1) + 0.1, y0 if abs(y0) < 1e6 else 0.0, 270)
        path.add_line((x0, y0), (x1, y1))


def face(sketch, points, extrusion, seed):
    corners = [(x, y, seed % 7) for x, y in [*points, *BOX_FT][:4]]
    sketch.space.add_3dface(corners, dxfattribs={"layer": "ARRAY"})


def mesh(sketch, points, extrusion, seed):
    drawn = sketch.space.add_mesh(dxfattribs={"layer": "ARRAY"})
    with drawn.edit_data() as data:
        data.vertices = [(x, y, 0.0) for x, y in points or UNIT_FT]
        data.faces = [random.Random(seed).choices(range(len(data.vertices)), k=3)] * 2


def clip(sketch, points, extrusion, seed):
    sketch.document.blocks.new("UNIT").add_lwpolyline(UNIT_FT, close=True)
    look = {"layer": "ARRAY", "xscale": seed % 5 - 2 or 1, "zscale": seed % 2}
    put = sketch.space.add_blockref("UNIT", (0, 0), dxfattribs=look)
    if len(points) > 1:
        XClip(put).set_block_clipping_path(points)


@CASES
@pytest.mark.parametrize("draw", [hatch, face, mesh, clip])
def test_whatever_is_drawn_is_an_outline_or_named(tmp_path, draw, count):
    @settings(MANY, max_examples=max(count // 4, 10))
    @given(POINTS, EXTRUSIONS, st.integers(0, 1000))
    def holds(points, extrusion, seed):
        sketch = Sketch()
        draw(sketch, points, extrusion, seed)
        # A vertical face is a side of others.
        assert is_accounted_for(sketch.saved(tmp_path)) or draw is face

    holds()


@CASES
def test_a_damaged_drawing_is_read_or_refused(tmp_path, count):
    sketch = Sketch()
    sketch.ring("ARRAY", BOX_FT, "A1")
    hatch(sketch, list(UNIT_FT), (0, 0, 1), 1)
    path = sketch.saved(tmp_path)
    whole = path.read_bytes()
    start = whole.index(b"ENTITIES")
    for seed in range(count):
        chance = random.Random(seed)
        at = chance.randrange(start, len(whole))
        piece = chance.choice([b"", b"x", b"\n", b"9", b"\xff", b"  0\nENDSEC\n", b"-"])
        path.write_bytes(whole[:at] + piece + whole[at + chance.randrange(3) :])
        try:
            found = read_dxf(path)
        except InputError:
            continue
        # One that ends before its first entity shows nothing, which `plan read` refuses.
        assert found.lines or found.unread or found.repairs or not found.counts, seed


@CASES
def test_no_row_of_a_ballast_map_is_lost(tmp_path, count):
    rows_of = st.lists(st.tuples(st.integers(-9999, 9999), st.integers(0, 99)), max_size=9)

    @settings(MANY, max_examples=count)
    @given(rows_of, st.sampled_from(",;\t"), st.sampled_from(["utf-8", "utf-8-sig", "utf-16"]),
           st.text(st.sampled_from("0123456789.,;'\"\t -ex"), max_size=6))  # fmt: skip
    def holds(rows, mark, encoding, other):
        lines = ["x,y,blocks", *(f"{x / 8},{x / 4},{blocks}" for x, blocks in rows)]
        path = tmp_path / "map.csv"
        path.write_bytes("\n".join(lines).replace(",", mark).encode(encoding))
        assert [tuple(row[1:]) for row in read_map(path, 1.0).tolist()] == [
            (x / 8, x / 4, blocks) for x, blocks in rows
        ]
        path.write_text("\n".join([*lines, f"{other},1,1"]), encoding="utf-8")
        try:
            found = read_map(path, 1.0)
        except InputError:
            return
        assert len(found) == len(rows) + 1

    holds()
