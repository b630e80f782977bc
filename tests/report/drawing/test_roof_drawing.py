"""Names of layers, and names and heights as people write them at an outline."""

import math

import pytest

from inputs import FT, INCH
from report.drawing.roof_drawing import first_height, proposed, read_line
from sketch import UNIT_FT, Sketch, plan

pytestmark = pytest.mark.quick

UNIT_M = 1.0


@pytest.mark.parametrize(
    ("text", "name", "value_m", "has_unit"),
    [
        ("RTU-1, height 42.0 in (1067 mm)", "RTU-1", 42 * INCH, True),
        ('RTU-1 HT 42"', "RTU-1", 42 * INCH, True),
        ("AHU 2 (HT. 42 IN)", "AHU 2", 42 * INCH, True),
        ("HT: 3'-6\"", "", 3.5 * FT, True),
        ("HT=3\u2019 6\u201d", "", 3.5 * FT, True),
        ("HT 3'", "", 3 * FT, True),
        ("HT 3.5 ft, 900 LBS", "", 3.5 * FT, True),
        ("Height 42 1/2''", "", 42.5 * INCH, True),
        ("HEIGHT = 1067 mm", "", 1.067, True),
        ("ELEV 1.2 m", "", 1.2, True),
        ("HT42", "", 42.0, False),
        ("ELEV: 1.2", "", 1.2, False),
        ('RTU-1 48"H', "RTU-1", 48 * INCH, True),
        ("RTU-1 (48 in. H=4'-0\")", "RTU-1 (48 in.", 4 * FT, True),
        ("H=4'-0\"", "", 4 * FT, True),
        ("H = 42", "", 42.0, False),
        ("AHU 4'-6\" H", "AHU", 4.5 * FT, True),
        ("AHU, 4' HIGH", "AHU", 4 * FT, True),
        ('SKYLIGHT 12 1/2" TALL', "SKYLIGHT", 12.5 * INCH, True),
        ("TANK 1200 mm high", "TANK", 1.2, True),
        ('60"W x 48"H', "", 48 * INCH, True),
        ("RTU-2 4 ft. 6 in. high", "RTU-2", 4.5 * FT, True),
        ("RTU-2 42-in high", "RTU-2", 42 * INCH, True),
        ("RTU-2 3\u00bd' HIGH", "RTU-2", 3.5 * FT, True),
        ('RTU-2 HGT 42"', "RTU-2", 42 * INCH, True),
        ('RTU-2 H:42"', "RTU-2", 42 * INCH, True),
        ("RTU-2 height of 42 inches", "RTU-2", 42 * INCH, True),
        ("RTU-2 1,20 m high", "RTU-2", 1.2, True),
        ("RTU HT 1,2 m", "RTU", 1.2, True),
        ('RTU-1,42" HIGH', "RTU-1", 42 * INCH, True),
        ('RTU 5, 48" HIGH', "RTU 5", 48 * INCH, True),
        ('RTU-2 96"L x 60"W x 48"H', "RTU-2", 48 * INCH, True),
    ],
)
def test_a_height_is_read_with_its_unit_or_that_of_the_drawing(text, name, value_m, has_unit):
    found = read_line(text, UNIT_M)
    assert found[0] == name
    assert found[1] is not None
    assert found[1].value_m == pytest.approx(value_m)
    assert found[1].has_unit == has_unit


@pytest.mark.parametrize(
    "text", ["HT 42x60", "HT 42-48 in", "HT 42.5.1", "HEIGHT 12345678", "HT 42 yd", "HT 1,200 mm",
             'RTU 1,42" HIGH', "TANK 1,200 mm high"]
)  # fmt: skip
def test_a_number_that_is_not_read_whole_is_no_height(text):
    assert math.isnan(read_line(text, UNIT_M)[1].value_m)


@pytest.mark.parametrize(
    "text", ["HT-1", "HEIGHT VARIES", "WEIGHT 42", "ELEVATOR 2", "42 in", "H-1", "H 42", "PH=7",
             "42H", "RTU-12 H", '60x48"H', "480V 60 Hz", "12 HIGH ST"]
)  # fmt: skip
def test_a_number_that_no_word_calls_a_height_is_none(text):
    assert read_line(text, UNIT_M)[1] is None


def test_the_first_line_is_the_name_and_the_first_height_counts(tmp_path):
    lines = ["RTU-1", "HT 42 1/0 in", "HT 2 m", "HT 3 m"]
    height, unclear = first_height(lines, UNIT_M)
    assert height is not None
    assert (height.value_m, unclear) == (2.0, "")
    assert first_height(lines[:2], UNIT_M) == (None, "HT 42 1/0 in")
    sketch = Sketch()
    sketch.ring("OBJECT", UNIT_FT)
    look = {"layer": "OBJECT"}
    sketch.space.add_mtext('RTU-7\\P5 TONS\\PHT 48"', dxfattribs=look).set_location((69, 60))
    (item,) = plan(sketch.saved(tmp_path)).objects
    assert (item.name, item.note) == ("RTU-7", "HT 48.0 in (1219 mm)")
    assert item.height_m == pytest.approx(48 * INCH)


def test_a_height_that_is_not_understood_is_listed(tmp_path):
    sketch = Sketch()
    ring = sketch.ring("OBJECT", UNIT_FT, "RTU-7 HT 42-48 in")
    found = plan(sketch.saved(tmp_path))
    assert found.objects[0].name == "RTU-7"
    assert math.isnan(found.objects[0].height_m)
    (item,) = found.unread
    assert (item.handle, item.reason, item.detail) == (
        ring.dxf.handle, "a height that is not understood", "'RTU-7 HT 42-48 in'"
    )  # fmt: skip


@pytest.mark.parametrize(
    ("kind", "layers"),
    [
        ("roof", ["A-ROOF-OTLN", "A-ROOF-OTLN-N", "a-roof", "X-ROOF|A-ROOF-OTLN", "pvcRoof", "ROOF",
                  "X-ROOF$0$A-ROOF-OTLN", "Roof Outline", "Building Outline"]),
        ("not read", ["A-ROOF-PATT", "A-ROOF-OTLN-IDEN", "G-ANNO-TTLB", "pvcSetback"]),
        ("edge with parapet", ["A-ROOF-PARAPET"]),
        ("array", ["E-SOLR-PANL", "PV_Modules", "PV Array", "Solar Panels", "pvcLayout", "PANELS",
                   "Modules", "PV", "PV - Modules"]),
        ("fixed object", ["M-HVAC-EQPM", "M-ROOF-EQPM-E", "E-POWR-EQPM", "pvcObstruction", "HVAC",
                          "Skylights", "Keepout", "KEEP-OUT", "Keep Outs", "MECHANICAL UNITS",
                          "Rooftop Units", "EXHAUST FANS"]),
        (None, ["ROOF-PV", "ROOF PLAN", "HVAC-DUCT", "A-WALL", "A-ROOF-DRAN", "E-POWR-PANL",
                "PVC PIPE", ""]),
    ],
)  # fmt: skip
def test_a_name_proposes_a_kind_or_none(kind, layers):
    assert {layer: proposed(layer) for layer in layers} == dict.fromkeys(layers, kind)
