"""A drawing is read as it is shown: nothing hidden, nothing twice, no size that no roof has."""

import math

import pytest
from ezdxf.xclip import XClip

from fixtures.commands import errors_of, output_of, stdout_of
from fixtures.dxf import BOX_FT, ROOF_FT, UNIT_FT, Sketch, plan
from fixtures.marks import by_day
from fixtures.project_parts import FT
from fixtures.workbooks import blank
from report.drawing_read.read_dxf import read_dxf
from report.project.model.choices import UnitsFirst
from solver.errors import InputError


def reasons(found):
    return [(one.reason, one.layer) for one in found.unread]


def names(found):
    return [place.name for place in (*found.arrays, *found.objects) if place.handle]


def with_block(sketch, layer="OBJECT", own="0", **put):
    block = sketch.document.blocks.new("UNIT")
    block.add_lwpolyline(UNIT_FT, close=True, dxfattribs={"layer": own})
    return sketch.space.add_blockref("UNIT", (0, 0), dxfattribs={"layer": layer} | put)


@pytest.mark.quick
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
    assert only[0] == {"frozen": "on a frozen layer", "off": "on a layer that is turned off"}[state]
    assert only[1].casefold() == "object"


@pytest.mark.quick
@pytest.mark.parametrize(("state", "shown"), [("frozen", []), ("off", ["OBJ-1"])])
def test_a_block_on_a_layer_that_is_off_shows_what_has_layers_of_its_own(tmp_path, state, shown):
    sketch = Sketch()
    layer = sketch.document.layers.add("BLOCKS")
    layer.freeze() if state == "frozen" else layer.off()
    with_block(sketch, "BLOCKS", own="OBJECT")
    assert names(plan(sketch.saved(tmp_path))) == shown


@pytest.mark.quick
def test_what_is_invisible_is_left_out_and_an_external_reference_is_named(tmp_path):
    sketch = Sketch()
    sketch.ring("ARRAY", BOX_FT).dxf.invisible = 1
    with_block(sketch, invisible=1)
    found = plan(sketch.saved(tmp_path))
    assert names(found) == []
    assert reasons(found) == [("invisible", "ARRAY"), ("invisible", "OBJECT")]
    sketch = Sketch()
    sketch.document.add_xref_def("other.dxf", "MECHANICAL")
    sketch.space.add_blockref("MECHANICAL", (0, 0), dxfattribs={"layer": "X"})
    (only,) = read_dxf(sketch.saved(tmp_path)).unread
    assert (only.reason, only.detail) == (
        "an external reference (bind it in CAD)", "'MECHANICAL'"
    )  # fmt: skip


CLIPPED = "a block that is clipped, and read whole where the clip crosses a line"


@pytest.mark.quick
@pytest.mark.parametrize("is_nested", [False, True])
@pytest.mark.parametrize(
    ("path", "is_inverted", "shown"),
    [
        ([(67, 55), (70, 60)], False, ["OBJ-1"]),
        ([(0, 0), (60, 50)], False, []),
        ([(0, 0), (60, 50)], True, ["OBJ-1"]),
        ([(60, 50), (80, 70)], True, []),
    ],
)
def test_a_clipped_block_is_read_without_the_lines_that_are_hidden(
    tmp_path, path, is_inverted, shown, is_nested
):
    sketch = Sketch()
    put = with_block(sketch)
    clip = XClip(put)
    clip.set_block_clipping_path(path)
    if is_inverted:
        clip.invert_clipping_path([(-500, -500), (500, 500)], ignore_acad_compatibility=True)
    if is_nested:
        outer = sketch.document.blocks.new("OUTER")
        sketch.space.unlink_entity(put)
        outer.add_entity(put)
        turned = {"layer": "OBJECT", "rotation": 90, "xscale": -1}
        sketch.space.add_blockref("OUTER", (300, 10), dxfattribs=turned)
    found = plan(sketch.saved(tmp_path))
    assert names(found) == shown
    left = [] if shown else [("clipped off", "OBJECT")]
    assert reasons(found) == [*left, (CLIPPED, "OBJECT")]


def test_texts_and_open_lines_and_hatches_that_a_clip_hides_are_not_read(tmp_path):
    sketch = Sketch()
    block = sketch.document.blocks.new("UNITS")
    near, far = (((x, 0), (x + 8, 0), (x + 8, 10), (x, 10)) for x in (0, 20))
    for ring in (near, far):
        for ends in zip(ring, (*ring[1:], ring[0]), strict=True):
            block.add_line(*ends)
    block.add_text('GHOST HT 99"').set_placement((44, 5))
    block.add_hatch().paths.add_polyline_path([(x + 60, y) for x, y in near], is_closed=True)
    put = sketch.space.add_blockref("UNITS", (100, 20), dxfattribs={"layer": "OBJECT"})
    XClip(put).set_block_clipping_path([(-1, -1), (10, 12)])
    sketch.ring("OBJECT", ((140, 20), (148, 20), (148, 30), (140, 30)), "RTU-1")
    found = plan(sketch.saved(tmp_path))
    assert [(item.name, item.shape.bounds.x_from_m / FT) for item in found.objects] == [
        ("RTU-1", pytest.approx(140)), ("OBJ-1", pytest.approx(100))
    ]  # fmt: skip
    assert all(math.isnan(item.height_m) for item in found.objects)
    assert reasons(found) == [*[("clipped off", "OBJECT")] * 5, (CLIPPED, "OBJECT")]


def test_closed_lines_in_a_layout_are_said_to_be_there(tmp_path):
    sketch = Sketch()
    paper = sketch.document.layouts.new("A-101 Roof")
    paper.add_lwpolyline(BOX_FT, close=True, dxfattribs={"layer": "ARRAY"})
    assert read_dxf(sketch.saved(tmp_path)).layouts == ("A-101 Roof",)
    assert said_by_read(sketch, tmp_path) == (
        "its closed lines are in the layout A-101 Roof, not in model space; move them there in CAD"
    )


@pytest.mark.parametrize(
    ("code", "said"),
    [
        (21, "states US survey feet; use --units ft"),
        (10, "states yards; use --units ft, if it is drawn in that unit, or scale it in CAD"),
        (0, "the drawing does not state its unit; use --units with one of in, ft, mm, cm, m"),
    ],
)  # fmt: skip
def test_a_unit_that_no_roof_is_drawn_in_is_named(tmp_path, code, said):
    sketch = Sketch()
    sketch.document.header["$INSUNITS"] = code
    sketch.ring("ARRAY", BOX_FT, "A1")
    assert said_by_read(sketch, tmp_path) == said


def said_by_read(sketch, tmp_path):
    path = blank(tmp_path / "input.xlsx", UnitsFirst.US)
    output = errors_of("plan", "read", sketch.saved(tmp_path), path, "--accept")
    return output.splitlines()[1].strip()


def damaged(tmp_path, old, new):
    sketch = Sketch()
    sketch.ring("ARRAY", BOX_FT, "A1")
    path = sketch.saved(tmp_path)
    assert old in path.read_text()
    path.write_text(path.read_text().replace(old, new, 1))
    return path


SECTION, END = "  0\nSECTION\n  2\nCLASSES\n", "  0\nENDSEC\n"


@pytest.mark.quick
@pytest.mark.parametrize(("old", "new"), [(END, 2 * END), (SECTION, "")])
def test_a_damaged_drawing_is_read_as_far_as_it_can_be_and_says_so(tmp_path, old, new):
    found = read_dxf(damaged(tmp_path, old, new))
    assert found.repairs.startswith("a damaged drawing, read as far as possible")
    assert found.repairs.endswith(": compare the plan")
    assert [len(line.shape.points) for line in found.lines] == [4]


@pytest.mark.quick
def test_a_drawing_whose_number_would_be_guessed_is_refused(tmp_path):
    path = damaged(tmp_path, "\n 20\n75.0\n", "\n 20\n75.0x\n")
    with pytest.raises(InputError, match="not a DXF drawing, or damaged"):
        read_dxf(path)


@pytest.mark.quick
def test_a_flat_block_is_read_and_an_outline_over_an_equal_one_counts_once(tmp_path):
    sketch = Sketch()
    with_block(sketch, zscale=0.0)
    found = plan(sketch.saved(tmp_path))
    assert names(found) == ["OBJ-1"]
    assert reasons(found) == []
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


def sized(tmp_path, unit, factor, *, has_roof=True, item=8):
    """A drawing of a roof, an array and a unit, drawn by a factor too large."""
    sketch = Sketch(unit=unit)
    x, y = 110, 110
    shapes = [
        ("ARRAY", BOX_FT, "A1"),
        ("OBJECT", ((x, y), (x + item, y), (x + item, y + item), (x, y + item)), "RTU-1"),
    ]
    for layer, points, name in [("ROOF-OUTLINE", ROOF_FT, "")] * has_roof + shapes:
        sketch.ring(layer, [(x * factor, y * factor) for x, y in points], name)
    return sketch.saved(tmp_path)


@pytest.mark.parametrize(
    ("unit", "factor", "has_roof", "said"),
    by_day([
        ("in", 1 / 12, True, ("RTU-1 is 0.67 ft (0.20 m) by", "ft or m, or in if it is so, as")),
        ("in", 0.0254, True, ("the roof is 6.10 ft (1.86 m) by", "ft or m, or in if it is so")),
        ("in", 1 / 200, False, ("A1 is 0.40 ft (0.12 m) by 0.28 ft (0.08 m)", "or in if it is so")),
        ("ft", 12.0, True, ("A1 is 960.00 ft (292.61 m) by", "in or cm, or ft if it is so")),
        ("m", 304.8, True, ("the roof is 73152.00 ft (22296.73 m) by", "or m if it is so")),
    ], 1),
)  # fmt: skip
def test_a_size_that_few_have_is_asked_about_with_the_units_that_would_do(
    tmp_path, unit, factor, has_roof, said
):
    path = blank(tmp_path / "input.xlsx", UnitsFirst.US)
    before = path.read_bytes()
    drawing = sized(tmp_path, unit, factor, has_roof=has_roof)
    output = errors_of("plan", "read", drawing, path)
    for part in said:
        assert part in output
    assert path.read_bytes() == before
    stdout_of("plan", "read", drawing, path, "--units", unit)


@pytest.mark.parametrize(
    ("item", "is_asked"), [(0.9, True), (1.1, False), (59.0, False), (61.0, True)]
)
@pytest.mark.nightly
def test_a_unit_below_a_foot_or_above_sixty_is_asked_about(tmp_path, item, is_asked):
    path = blank(tmp_path / "input.xlsx", UnitsFirst.US)
    drawing = sized(tmp_path, "ft", 1.0, item=item)
    output = output_of("plan", "read", drawing, path, exit_code=2 if is_asked else 0)
    assert ("an unusual size" in output) is is_asked
