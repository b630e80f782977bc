"""Names of layers, and what they propose."""

import pytest

from report.drawing.drawing_names import proposed

pytestmark = pytest.mark.quick


@pytest.mark.parametrize(
    ("layer", "kind"),
    [
        ("A-ROOF-OTLN", "roof"),
        ("A-ROOF-OTLN-N", "roof"),
        ("a-roof", "roof"),
        ("X-ROOF|A-ROOF-OTLN", "roof"),
        ("X-ROOF$0$A-ROOF-OTLN", "roof"),
        ("A-ROOF-PATT", "not read"),
        ("A-ROOF-OTLN-IDEN", "not read"),
        ("G-ANNO-TTLB", "not read"),
        ("A-ROOF-PARAPET", "edge with parapet"),
        ("E-SOLR-PANL", "array"),
        ("PV_Modules", "array"),
        ("PV Array", "array"),
        ("Solar Panels", "array"),
        ("M-HVAC-EQPM", "fixed object"),
        ("M-ROOF-EQPM-E", "fixed object"),
        ("E-POWR-EQPM", "fixed object"),
        ("pvcRoof", "roof"),
        ("pvcLayout", "array"),
        ("pvcObstruction", "fixed object"),
        ("pvcSetback", "not read"),
        ("ROOF", "roof"),
        ("Roof Outline", "roof"),
        ("PANELS", "array"),
        ("Modules", "array"),
        ("PV", "array"),
        ("HVAC", "fixed object"),
        ("Skylights", "fixed object"),
        ("Keepout", "fixed object"),
        ("KEEP-OUT", "fixed object"),
        ("Keep Outs", "fixed object"),
        ("PV - Modules", "array"),
        ("Building Outline", "roof"),
        ("MECHANICAL UNITS", "fixed object"),
        ("Rooftop Units", "fixed object"),
        ("EXHAUST FANS", "fixed object"),
        ("ROOF-PV", None),
        ("ROOF PLAN", None),
        ("HVAC-DUCT", None),
        ("A-WALL", None),
        ("A-ROOF-DRAN", None),
        ("E-POWR-PANL", None),
        ("PVC PIPE", None),
        ("", None),
    ],
)
def test_a_name_proposes_a_kind_or_none(layer, kind):
    assert proposed(layer) == kind
