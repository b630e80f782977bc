"""Names of layers, and what they propose."""

import pytest

from report.drawing.drawing_names import proposed

pytestmark = pytest.mark.quick


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
