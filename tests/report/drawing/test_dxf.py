"""The plan as DXF: read back as it was written, clean, and the same every time."""

import io
import math
import os
import re
import subprocess
import sys
from dataclasses import replace

import ezdxf
import pytest

import scenes
import stand_in
from inputs import FT, sides
from report.assessment.envelopes import design_envelope
from report.assessment.plan_clearances import plan_gaps
from report.drawing.items import APPLICATION, Layer, write_dxf
from report.drawing.plan import gap_words, plan_drawing
from report.sheet.schema.choices import UnitsFirst

pytestmark = pytest.mark.quick


@pytest.fixture(scope="module")
def done():
    return scenes.package(roof=sides(0, 220, 0, 170) | {"north_deg": 30.0}).assessment


@pytest.fixture(scope="module", params=UnitsFirst)
def plan(request, done):
    project = done.project.project.model_copy(update={"units_first": request.param})
    return plan_drawing(replace(done, project=done.project.model_copy(update={"project": project})))


@pytest.fixture(scope="module")
def document(plan):
    return read(write_dxf(plan))


def read(data):
    return ezdxf.read(io.StringIO(data.decode("utf-8")))


def test_texts_name_what_is_drawn_and_the_same_plan_gives_the_same_bytes(done):
    assert write_dxf(plan_drawing(done)) == write_dxf(plan_drawing(done))
    plan = plan_drawing(done)
    said = [text.words for text in plan.texts]
    assert {"A1", "A2", "A3", "RTU-1, height 42.0 in", "T-1", "S edge", "N"} <= set(said)
    (gap,) = [words for words in said if words.startswith("5: ")]
    assert gap.startswith("5: A2 to S edge: provided 60.0 in (1524 mm), required 61.2 in")
    assert gap.endswith("NG")
    failed = [gap.name for gap in plan.dimensions if gap.layer is Layer.CLEARANCE_NG]
    assert failed == ["A2 to S edge"]


@pytest.mark.nightly
def test_every_process_writes_the_same_bytes():
    code = (
        "from report.drawing.items import write_dxf; from report.drawing.items import *; "
        "gap = PlanDimension(layer=Layer.CLEARANCE, name='A1 to N', ends=((0, 0), (4, 0)), "
        "words='1: 48.0 in', at=(2, 3)); drawn = PlanDrawing("
        "is_feet=True, height=1.0, lines=(), texts=(), dimensions=(gap,)); "
        "print(write_dxf(drawn).hex())"
    )
    seeds = ("1", "5")  # sets of the library's kinds in two orders
    written = {
        subprocess.run(
            [sys.executable, "-c", code],
            env=os.environ | {"PYTHONHASHSEED": seed},
            capture_output=True,
            check=True,
        ).stdout
        for seed in seeds
    }
    assert len(written) == 1


def test_the_auditor_finds_nothing_and_lines_texts_and_dimensions_are_read_back(plan, document):
    auditor = document.audit()
    assert not auditor.errors
    assert not auditor.fixes
    assert document.header["$INSUNITS"] == (2 if plan.is_feet else 6)  # feet, meters
    space = document.modelspace()
    for line, drawn in zip(plan.lines, space.query("LWPOLYLINE"), strict=True):
        assert drawn.dxf.layer == line.layer.title
        assert drawn.closed is line.is_closed
        assert drawn.get_xdata(APPLICATION)[0].value == line.name
        for point, wanted in zip(drawn.get_points("xy"), line.points, strict=True):
            assert point == pytest.approx(wanted, abs=1e-6)
    assert [text.dxf.text for text in space.query("TEXT")] == [text.words for text in plan.texts]
    for gap, drawn in zip(plan.dimensions, space.query("DIMENSION"), strict=True):
        assert (drawn.dxf.layer, drawn.dxf.text) == (gap.layer.title, gap.words)
        assert drawn.get_xdata(APPLICATION)[0].value == gap.name
        for point, wanted in zip((drawn.dxf.defpoint2, drawn.dxf.defpoint3), gap.ends, strict=True):
            assert point.vec2.isclose(wanted, abs_tol=1e-6)
    style = document.dimstyles.get("ROOFSLIP").dxf
    assert (style.dimlfac, style.dimdec) == ((12.0, 1) if plan.is_feet else (1000.0, 0))
    assert (style.dimtxt, chr(style.dimdsep), style.dimzin) == (plan.height, ".", 0)


def test_each_kind_has_its_layer_and_each_text_shows_as_it_is(document, plan):
    assert {layer.title for layer in Layer} <= {layer.dxf.name for layer in document.layers}
    used = {entity.dxf.layer for entity in document.modelspace()}
    assert used == {layer.title for layer in Layer} - {Layer.CLEARANCE_NONE.title}
    words = "%%c 5%% %%u^J a^ b 100 %"
    texts = [replace(text, words=words) for text in plan.texts]
    (shown,) = {
        text.plain_text()
        for text in read(write_dxf(replace(plan, texts=texts))).modelspace().query("TEXT")
    }
    assert shown == words


def test_the_envelope_is_that_of_the_design_displacement_if_there_is_one(done):
    line = next(line for line in plan_drawing(done).lines if line.layer is Layer.DESIGN)
    wanted = [(x / FT, y / FT) for x, y in design_envelope(done.arrays[0])]
    assert line.points == tuple(wanted)
    lost = replace(done, arrays=tuple(replace(a, design_m=math.nan) for a in done.arrays))
    plan = plan_drawing(lost)
    assert not [line for line in plan.lines if line.layer is Layer.DESIGN]
    said = {text.words for text in plan.texts}
    assert {f"A{k}: design displacement: no value" for k in (1, 2, 3)} <= said
    assert not read(write_dxf(plan)).audit().errors


def test_a_gap_short_by_less_than_a_digit_does_not_read_as_enough(done):
    gap = next(one for one in done.clearances if one.clearance.object == "RTU-1")
    near = gap.clearance.model_copy(update={"provided_m": gap.required_m - 1e-5})
    (gap,) = plan_gaps(replace(done, clearances=(replace(gap, clearance=near),)))
    words = gap_words(gap, us_first=True)
    provided, required = re.findall(r"(?:provided|required) ([\d.]+) in", words)
    assert float(required) > float(provided)
    assert words.endswith("NG")


def test_a_displacement_that_is_not_permitted_marks_nothing_and_keeps_nothing_clear():
    plan = plan_drawing(stand_in.unpermitted())
    said = [text.words for text in plan.texts]
    assert said.count("A1: design displacement: not permitted") == 1
    assert sum("keep clear" in words for words in said) == 1  # of A2
    (first, *_) = [words for words in said if words.startswith("1: ")]
    assert first == "1: A1 to RTU-1: provided 84.0 in (2134 mm), required no value, no verdict"
    layers = {gap.name: gap.layer for gap in plan.dimensions}
    assert layers == {
        "A1 to RTU-1": Layer.CLEARANCE_NONE,
        "A2 to A1": Layer.CLEARANCE_NONE,
        "A2 to S edge": Layer.CLEARANCE,
    }
    assert [line.name for line in plan.lines if line.layer is Layer.DESIGN] == ["A2"]
