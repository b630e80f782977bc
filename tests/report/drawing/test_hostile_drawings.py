"""Drawings that are damaged, endless or no drawings are refused with the limit that they exceed."""

import io
import math

import pytest

from report.drawing.read_dxf import MAX_ENTITIES, MAX_VALUES, read_dxf
from report.sheet.schema import LayerKind
from sketch import LIBRECAD_R12, Sketch, plan
from solver.model import InputError


def hostile(tmp_path, content):
    path = tmp_path / "roof.dxf"
    path.write_bytes(content if isinstance(content, bytes) else content.encode())
    with pytest.raises(InputError) as caught:
        read_dxf(path, 1.0)
    (problem,) = caught.value.problems
    return problem


def test_a_million_entities_are_refused_with_the_limit(tmp_path):
    def entities(count):
        body = "0\nPOINT\n8\n0\n" * count
        return f"0\nSECTION\n2\nENTITIES\n{body}0\nENDSEC\n0\nEOF\n"

    found = hostile(tmp_path, entities(1_000_000))
    assert found.startswith(f"2,000,004 values, more than {MAX_VALUES:,}; save the layers")
    found = hostile(tmp_path, entities(400_000))
    assert found.startswith(f"400,003 entities, more than {MAX_ENTITIES:,}; save the layers")


def test_a_large_file_is_refused_before_it_is_read(tmp_path):
    assert hostile(tmp_path, b" " * 26_000_000).startswith("26 MB, more than 25 MB")


@pytest.mark.parametrize(
    ("content", "start"),
    [
        (b"AC1032\x00\x00", "a DWG drawing"),
        (b"AutoCAD Binary DXF\r\n\x1a\x00", "a binary DXF"),
        (b"", "not a DXF drawing"),
        (b"hello\nworld\n", "not a DXF drawing"),
        (LIBRECAD_R12[:200].encode(), "not a DXF drawing"),
        (b"\x00\xff" * 1000, "not a DXF drawing"),
    ],
)
def test_what_is_no_drawing_is_refused(tmp_path, content, start):
    assert hostile(tmp_path, content).startswith(start)


def written(sketch):
    out = io.StringIO()
    sketch.document.write(out)
    return out.getvalue()


def nested(levels, each, *, rows=1):
    sketch = Sketch()
    previous = None
    for level in range(levels):
        block = sketch.document.blocks.new(f"B{level}")
        if previous is None:
            block.add_lwpolyline([(0, 0), (1, 0), (1, 1)], close=True)
        for k in range(each if previous else 0):
            block.add_blockref(previous, (k, 0))
        previous = block.name
    counts = {"row_count": rows, "column_count": rows}
    sketch.space.add_blockref(previous, (0, 0), dxfattribs=counts)
    return written(sketch)


def test_blocks_that_expand_without_end_are_refused(tmp_path):
    assert "expand to more than" in hostile(tmp_path, nested(7, 10))
    assert "expand to more than" in hostile(tmp_path, nested(1, 1, rows=30_000))
    assert "nested more than 8 deep" in hostile(tmp_path, nested(12, 1))


def test_a_block_within_itself_is_refused(tmp_path):
    sketch = Sketch()
    block = sketch.document.blocks.new("LOOP")
    block.add_blockref("LOOP", (1, 1))
    sketch.space.add_blockref("LOOP", (0, 0))
    assert "nested more than 8 deep" in hostile(tmp_path, written(sketch))


@pytest.mark.parametrize("bad", ["nan", "inf", "1e400"])
def test_a_coordinate_that_is_not_a_number_is_listed(tmp_path, bad):
    path = tmp_path / "roof.dxf"
    path.write_text(LIBRECAD_R12.replace("\n10\n10.0\n", f"\n10\n{bad}\n", 1))
    found = plan(path, "m", {"PV": LayerKind.ARRAY})
    assert found.arrays == ()
    assert "not a number" in found.unread[0].reason


def test_a_line_of_many_vertices_is_listed(tmp_path):
    sketch = Sketch()
    points = [(math.cos(k / 1000.0), math.sin(k / 1000.0)) for k in range(6000)]
    sketch.space.add_lwpolyline(points, close=True, dxfattribs={"layer": "ARRAY"})
    (found,) = plan(sketch.saved(tmp_path)).unread
    assert found.reason == "a LWPOLYLINE of more than 2000 points"
