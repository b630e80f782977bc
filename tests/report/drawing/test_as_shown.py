"""A drawing is read as it is shown: nothing hidden, nothing twice, no size that no roof has."""

import pytest
from click.testing import CliRunner
from ezdxf.xclip import XClip

from report.cli.main import main
from report.drawing.read_dxf import read_dxf
from report.sheet.schema.choices import UnitsFirst
from sheets import blank
from sketch import BOX_FT, ROOF_FT, UNIT_FT, Sketch, plan

pytestmark = pytest.mark.quick


def reasons(found):
    return [(one.reason, one.layer) for one in found.unread]


def names(found):
    return [place.name for place in (*found.arrays, *found.objects) if place.handle]


def with_block(sketch, layer="OBJECT", own="0", **put):
    block = sketch.document.blocks.new("UNIT")
    block.add_lwpolyline(UNIT_FT, close=True, dxfattribs={"layer": own})
    return sketch.space.add_blockref("UNIT", (0, 0), dxfattribs={"layer": layer} | put)


@pytest.mark.parametrize("state", ["frozen", "off"])
@pytest.mark.parametrize("is_block", [False, True])
def test_what_is_on_a_hidden_layer_is_left_out_with_its_reason(tmp_path, state, is_block):
    sketch = Sketch()
    sketch.ring("ARRAY", BOX_FT, "A1")
    layer = sketch.document.layers.add("OBJECT")
    layer.freeze() if state == "frozen" else layer.off()
    with_block(sketch) if is_block else sketch.ring("object", UNIT_FT)
    found = plan(sketch.saved(tmp_path))
    assert names(found) == ["A1"]
    (only,) = reasons(found)
    assert only[0] == f"on a layer that is {state}"
    assert only[1].casefold() == "object"


@pytest.mark.parametrize(("state", "shown"), [("frozen", []), ("off", ["OBJ-1"])])
def test_a_block_on_a_layer_that_is_off_shows_what_has_layers_of_its_own(tmp_path, state, shown):
    sketch = Sketch()
    layer = sketch.document.layers.add("BLOCKS")
    layer.freeze() if state == "frozen" else layer.off()
    with_block(sketch, "BLOCKS", own="OBJECT")
    assert names(plan(sketch.saved(tmp_path))) == shown


def test_what_is_invisible_is_left_out(tmp_path):
    sketch = Sketch()
    sketch.ring("ARRAY", BOX_FT).dxf.invisible = 1
    with_block(sketch, invisible=1)
    found = plan(sketch.saved(tmp_path))
    assert names(found) == []
    assert reasons(found) == [("invisible", "ARRAY"), ("invisible", "OBJECT")]


def test_an_external_reference_that_is_not_bound_is_named(tmp_path):
    sketch = Sketch()
    sketch.document.add_xref_def("other.dxf", "MECHANICAL")
    sketch.space.add_blockref("MECHANICAL", (0, 0), dxfattribs={"layer": "X"})
    (only,) = read_dxf(sketch.saved(tmp_path)).unread
    assert (only.reason, only.detail) == (
        "an external reference, to be bound in CAD", "'MECHANICAL'"
    )  # fmt: skip


def test_a_clipped_block_is_read_whole_and_named(tmp_path):
    sketch = Sketch()
    put = with_block(sketch)
    XClip(put).set_block_clipping_path([(67, 55), (70, 60)])
    found = plan(sketch.saved(tmp_path))
    assert names(found) == ["OBJ-1"]
    assert reasons(found) == [("a block that is clipped, of which all is read", "OBJECT")]


def test_a_block_of_no_height_is_read_as_any_other(tmp_path):
    sketch = Sketch()
    with_block(sketch, zscale=0.0)
    found = plan(sketch.saved(tmp_path))
    assert names(found) == ["OBJ-1"]
    assert reasons(found) == []


def test_an_outline_over_an_equal_one_counts_once(tmp_path):
    sketch = Sketch()
    sketch.ring("ARRAY", BOX_FT, "A-1")
    sketch.ring("ARRAY", [(x + 0.001, y) for x, y in BOX_FT[::-1]])
    sketch.ring("OBJECT", UNIT_FT, "RTU-1")
    sketch.ring("OBJECT", UNIT_FT)
    sketch.ring("ARRAY-UNLIKE", UNIT_FT)  # of another kind
    found = plan(sketch.saved(tmp_path))
    assert names(found) == ["A-1", "RTU-1", "PV-1"]
    assert reasons(found) == [
        ("drawn twice, counted once", "ARRAY"), ("drawn twice, counted once", "OBJECT")
    ]  # fmt: skip


@pytest.mark.parametrize(
    ("unit", "factor", "has_roof", "said"),
    [
        ("in", 0.0254, True, "the roof is 6.10 ft (1.86 m) long, which none is; give --units with"
         " that of the drawing, ft or m"),
        ("in", 1 / 200, False, "the largest array is 0.40 ft (0.12 m) long"),
        ("m", 304.8, True, "the roof is 73152.00 ft (22296.73 m) long, which none is; give --units"
         " with that of the drawing, in or mm or cm"),
    ],
)  # fmt: skip
def test_a_size_that_no_roof_has_is_refused_with_the_units_that_would_do(
    tmp_path, unit, factor, has_roof, said
):
    sketch = Sketch(unit=unit)
    if has_roof:
        sketch.ring("ROOF-OUTLINE", [(x * factor, y * factor) for x, y in ROOF_FT])
    sketch.ring("ARRAY", [(x * factor, y * factor) for x, y in BOX_FT], "A1")
    path = blank(tmp_path / "input.xlsx", UnitsFirst.US)
    before = path.read_bytes()
    done = CliRunner().invoke(main, ["plan", "read", str(sketch.saved(tmp_path)), str(path)])
    assert done.exit_code == 2
    assert said in done.output
    assert path.read_bytes() == before
