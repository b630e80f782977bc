"""Arrays that no fire lane separates are one, and the section of the fire code is an input."""

import pytest

import stand_in
from report.assessment.requirement_rows import fire_lane_rows
from report.assessment.verdict import Verdict
from report.sheet.schema.fields import Place
from stand_in import FOOT

pytestmark = pytest.mark.quick

SECTION = "2022 CFC, example section"


def rows(*x_ft, section=SECTION, units="US", **site):
    """Arrays side by side, each from one x to another, 60 ft deep."""
    arrays = [
        stand_in.array(f"A{n}", 0.5, x_from_m=low * FOOT, x_to_m=high * FOOT)
        for n, (low, high) in enumerate(x_ft, start=1)
    ]
    given = stand_in.site(fire_code_section=section, **site)
    head = stand_in.project().project.model_dump() | {"units_first": units}
    data = stand_in.project(arrays=arrays, clearances=[], site=given, project=head)
    return {row.subject: row for row in fire_lane_rows(data)}


@pytest.mark.parametrize(("to_ft", "verdict"), [(150.0, Verdict.OK), (150.1, Verdict.CONDITION)])
def test_fire_lanes_limit_an_array_to_150_feet_by_the_section_given(to_ft, verdict):
    (row,) = rows((0, to_ft)).values()
    assert (row.verdict, row.basis) == (verdict, f"{SECTION}†")
    assert row.found.startswith(f"{to_ft:.2f} ft (45.7")
    (row,) = rows((0, to_ft), units="SI").values()
    assert row.limit == "≤ 45.72 m (150.00 ft)"


def test_arrays_closer_than_a_lane_by_their_shapes_are_one():
    found = rows((0, 80), (83.9, 163.9), (167.9, 200))
    assert [(row.found, row.verdict) for row in found.values()] == [
        *[("A1, A2 together: 163.90 ft (49.96 m)", Verdict.CONDITION)] * 2,
        ("60.00 ft (18.29 m)", Verdict.OK),
    ]
    assert found["A1"].title.endswith("between fire lanes of 4.00 ft (1.22 m)")
    assert found["A1"].remedy.startswith("Divide the arrays by a fire lane")
    assert found["A1"].places[0] == Place("arrays", 0, "x_from_m")
    # Through a neighbor, in any order.
    found = rows((0, 60), (126, 186), (63, 123))
    assert {row.found for row in found.values()} == {"A1 to A3 together: 186.00 ft (56.70 m)"}
    # A ring of an outline around another array is one with it only where it is near.
    ring = [(0, 0), (140, 0), (140, 140), (130, 140), (130, 10), (10, 10), (10, 140), (0, 140)]
    outlines = [{"name": "A1", "x_m": x * FOOT, "y_m": y * FOOT} for x, y in ring]
    arrays = [
        stand_in.array("A1", 0.5, **dict.fromkeys(("x_from_m", "x_to_m", "y_from_m", "y_to_m"))),
        stand_in.array("A2", 0.5, x_from_m=30 * FOOT, x_to_m=110 * FOOT, y_from_m=30 * FOOT,
                       y_to_m=160 * FOOT),
    ]  # fmt: skip
    site = stand_in.site(fire_code_section=SECTION)
    data = stand_in.project(arrays=arrays, outlines=outlines, clearances=[], site=site)
    found = {row.subject: row.found for row in fire_lane_rows(data)}
    assert found["A1"].startswith("140.00 ft")
    assert found["A2"].startswith("130.00 ft")


@pytest.mark.parametrize(
    ("gap_m", "lane_m", "is_one"),
    [
        (1.2, None, True),
        (1.219, None, False),  # 4 ft is 1.2192 m
        (1.2192, 1.22, False),
        (1.2192, 8 * FOOT, True),
        (0.0, None, True),
    ],
)
def test_a_gap_that_is_a_lane_within_rounding_is_one(gap_m, lane_m, is_one):
    width = {} if lane_m is None else {"fire_lane_m": lane_m}
    found = rows((0, 100), (100 + gap_m / FOOT, 200), **width)
    assert [row.is_satisfied for row in found.values()] == [not is_one] * 2


def test_without_a_section_the_row_says_so_and_is_a_condition():
    found = rows((0, 80), (90, 150), (160, 320), section="")
    assert {row.verdict for row in found.values()} == {Verdict.CONDITION}
    assert {row.basis for row in found.values()} == {"fire code, section not given†"}
    fits, long = found["A2"], found["A3"]
    assert (found["A1"].asked, found["A1"].found) == (fits.asked, fits.found)
    assert fits.found == "at most 80.00 ft (24.38 m); section not given"
    assert fits.remedy == "State on the sheet Site the section of the fire code."
    assert long.found == "160.00 ft (48.77 m); section not given"
    assert "by a fire lane" in long.remedy
    assert long.places == (Place("site", 0, "fire_code_section"),)
