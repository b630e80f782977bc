"""The weight added to an existing building, beside its own loads."""

import pytest

from fixtures import project_parts
from fixtures.spaces import spaced
from report.assessment.checks.capacities import of_existing_roof
from report.assessment.checks.sentence import found_and_limit
from report.assessment.design.verdict import Verdict
from report.text.units import PRESSURES, WEIGHTS

BARE = {name: value for name, value in project_parts.SITE.items() if name != "roof_evaluation"}


def rows(**site):
    """The rows of an array of 42,000 lb on 80 ft x 60 ft, 8.75 psf."""
    data = project_parts.project(site=BARE | site, arrays=[project_parts.array("A1", 0.5)])
    return {row.id: row for row in of_existing_roof(data)}


def said(row):
    return found_and_limit(row, us_first=True)[0]


def load(psf):
    return {"roof_load_pa": psf * PRESSURES["psf"]}


def mass(pounds):
    return {"seismic_weight_n": pounds * WEIGHTS["lb"]}


def test_without_its_loads_one_line_says_that_it_is_not_checked():
    (row,) = rows().values()
    assert row.verdict is Verdict.CONDITION
    assert row.found == (
        "not checked: design load of the roof and seismic weight of the building not entered"
    )
    assert row.clause == "IEBC 503.3, 503.4\u2020"
    assert {place.field for place in row.places} == {
        "roof_load_pa", "seismic_weight_n", "roof_evaluation"}  # fmt: skip
    (row,) = rows(roof_evaluation="J. Doe, SE").values()
    assert (row.verdict, row.found) == (Verdict.OK, "evaluated: J. Doe, SE")


@pytest.mark.parametrize(
    ("site", "id", "share", "is_met"),
    [(load(175.0), "roof_load_pa", "5.0%", True), (load(174.9), "roof_load_pa", "5.1%", False),
     (mass(420_000.0), "seismic_weight_n", "10.0%", True),
     (mass(400_000.0), "seismic_weight_n", "10.5%", False)],
)  # fmt: skip
def test_a_share_beyond_the_rule_needs_an_evaluation(site, id, share, is_met):
    found = rows(**site)
    assert set(found) == {id, "existing_roof"}  # the load that is not entered stays open
    row = found[id]
    assert spaced(said(row)).startswith(f"{share} (")
    assert row.verdict is (Verdict.OK if is_met else Verdict.CONDITION)
    evaluated = rows(**site, roof_evaluation="J. Doe, SE")
    assert all(each.verdict is Verdict.OK for each in evaluated.values())
    assert said(evaluated[id]).endswith("; evaluated: J. Doe, SE)") is not is_met


def test_the_sections_are_of_the_existing_building_code_that_goes_with_the_code_named():
    code = {"building_code": "CBC", "building_code_year": 2022}
    found = rows(**load(200.0), **mass(500_000.0), **code)
    assert [row.clause for row in found.values()] == [
        "CEBC 503.3, 2022\u2020", "CEBC 503.4, 2022\u2020"]  # fmt: skip
    assert (
        spaced(said(found["roof_load_pa"]))
        == "4.4% (A1: 8.8 psf (0.42 kPa) of 200.0 psf (9.58 kPa))"
    )
