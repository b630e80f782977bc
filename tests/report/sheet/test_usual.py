"""A number outside the range that the sheet prints as usual gives a warning of its own."""

import pytest

from inputs import INCH
from report.sheet.checking.findings import unusual
from report.sheet.schema import SECTIONS
from report.sheet.schema.choices import ObjectKind
from report.sheet.schema.fields import Place, entries
from sheets import arrays, project, row_changed

BARE = ObjectKind.EDGE_WITHOUT_PARAPET

pytestmark = pytest.mark.quick


@pytest.mark.parametrize(
    ("section", "index", "change", "name", "text"),
    [
        ("arrays", 0, {"cg_height_m": 0.75 * INCH}, "usual CG height A1",
         "CG height is 0.75 in; 4 to 36 in is usual: correct the value or its unit"),
        ("arrays", 1, {"mu": 0.2}, "usual friction coefficient A2",
         "friction coefficient is 0.2; 0.3 to 0.8 is usual: correct the value or its unit"),
        ("objects", 0, {"height_m": 3.5 * INCH}, "usual height RTU-1", "3.5 in; 4 to 240 in is"),
        ("clearances", 0, {"provided_m": 5 * INCH}, "usual provided clearance A1 to A2 across",
         "provided clearance is 5 in; 6 to 600 in is usual"),
        ("motions", 2, {"scale_value": 14.0}, "usual factor or PPA M3",
         "factor or PPA is 14; 0.2 to 5 is usual"),
        ("site", None, {"structure_height_m": 36 * INCH}, "usual structure height h",
         "structure height h is 3 ft; 8 to 120 ft is usual"),
        ("site", None, {"s_1_g": 0.02}, "usual S_1", "S_1 is 0.02 g; 0.03 to 1.5 g is usual"),
    ],
)  # fmt: skip
def test_a_number_outside_its_usual_range_gives_a_warning(section, index, change, name, text):
    (finding,) = unusual(row_changed(section, index, **change))
    assert finding.id == name
    assert finding.place == Place(section, index or 0, next(iter(change)))
    assert text in finding.text


def test_the_range_is_in_the_units_that_come_first():
    metric = project().project.model_dump() | {"units_first": "SI"}
    (finding,) = unusual(project(project=metric, arrays=arrays(cg_height_m=0.05)))
    assert finding.text.startswith("CG height is 50 mm; 101.6 to 914.4 mm is usual")


def test_the_limits_of_a_range_and_the_height_0_of_an_edge_without_parapet_are_usual():
    for inches in (4, 36):
        assert list(unusual(row_changed("arrays", 0, cg_height_m=inches * INCH))) == []
    for kind, count in ((BARE, 0), (ObjectKind.EDGE_WITH_PARAPET, 1)):
        data = row_changed("objects", 0, kind=kind, height_m=0.0)
        assert len(list(unusual(data))) == count


def test_every_example_is_usual():
    for section in SECTIONS:
        for entry in entries(section.model):
            if entry.cell.usual is not None:
                low, high = entry.cell.usual
                assert low <= entry.cell.example <= high
