"""The cells that `check` names are those that the engineer must fill in or change."""

import datetime as dt

import pytest

import inputs
import scenes
import sheets
import stand_in
from commands import printed
from report.assessment.precheck import limits_before_runs
from report.sheet.schema.fields import Place
from report.sheet.schema.scene import SIDES

pytestmark = pytest.mark.quick

HAZARD = {
    "hazard_source": "GeoEngineers",
    "hazard_date": dt.date(2026, 2, 1),
    "hazard_printout": "hazard.pdf",
}
TESTS = {"laboratory": "Laboratory", "report": "FT-1", "date": dt.date(2025, 6, 12)}
REVIEW = {
    "peer_reviewed": True, "peer_reviewer": "Reviewer", "peer_license": "CA S1",
    "peer_date": dt.date(2026, 3, 1), "peer_letter": "",
}  # fmt: skip
RUN = {"surface": "dry", "number": 1, "mu": 0.5}
SITE = {name: value for name, value in stand_in.site().items() if name not in HAZARD}


def site(**changes):
    return {"site": SITE | changes}


CASES = {
    "S_1 and S_D1": (
        site(s_1_g=None, f_v=None),
        "basis of the seismic design category",
        [("site", 0, "s_1_g"), ("site", 0, "s_d1_g")],
    ),
    "S_D1": (site(f_v=None), "basis of the seismic design category", [("site", 0, "s_d1_g")]),
    "report number of the hazard": (
        site(**HAZARD, hazard="site-specific analysis"),
        "report on the site-specific hazard analysis",
        [("site", 0, "hazard_report")],
    ),
    "date of the hazard": (
        site(hazard_source="Tool"),
        "source, date and printout of the seismic parameters",
        [("site", 0, "hazard_date"), ("site", 0, "hazard_printout")],
    ),
    "S_1 that decides on a site-specific analysis": (
        site(s_1_g=None), "hazard analysis for site class D", [("site", 0, "s_1_g")],
    ),
    "mapped values in site class D": (
        site(hazard="mapped values"), "hazard analysis for site class D", [("site", 0, "hazard")],
    ),
    "jurisdiction": (
        site(building_code="CBC", building_code_year=2022),
        "building code and jurisdiction",
        [("site", 0, "jurisdiction")],
    ),
    "building code": (
        site(jurisdiction="City"), "building code and juris", [("site", 0, "building_code")],
    ),
    "letter of the review": (
        {"options": REVIEW}, "peer review of the analysis", [("options", 0, "peer_letter")],
    ),
    "license and letter of the review": (
        {"options": REVIEW | {"peer_license": ""}},
        "peer review of the analysis",
        [("options", 0, "peer_license"), ("options", 0, "peer_letter")],
    ),
    "standard and accreditation": (
        {"friction_tests": TESTS},
        "tested to ASTM G115",
        [("friction_tests", 0, "standard"), ("friction_tests", 0, "accreditation")],
    ),
    "another standard": (
        {"friction_tests": TESTS | {"standard": "ISO 1", "accreditation": "ISO/IEC 17025"}},
        "tested to ASTM G115",
        [("friction_tests", 0, "standard")],
    ),
    "date of the friction report": (
        {"friction_tests": TESTS | {"date": None}},
        "friction test report stated",
        [("friction_tests", 0, "date")],
    ),
    "no runs": ({}, "wet and dry, three runs", [("friction_runs", 0, "")]),
    "runs without a velocity": (
        {"friction_runs": [RUN | {"velocity_mps": 0.1}, RUN | {"number": 2}]},
        "wet and dry, three runs",
        [("friction_runs", 1, "velocity_mps")],
    ),
    "outline of the roof": ({}, "outline of the roof", [("roof", 0, side) for side in SIDES]),
    "mean of few motions": (
        {"options": {"statistic": "mean"}},
        "takes the prescriptive displacement: 7 motions are given, and the statistic 'mean'",
        [("options", 0, "statistic")],
    ),
    "drawn distances": (
        {
            "clearances": [
                row | {"source": source}
                for row, source in zip(
                    stand_in.SECTIONS["clearances"],
                    ("drawing", "measured", "drawing", None, None),
                    strict=True,
                )
            ]
        },
        "A3, clear distances from the drawing",
        [("clearances", 0, "source"), ("clearances", 2, "source")],
    ),
    "overrides that require less": (
        {"overrides": [{"provision": key, "value": value, "reason": "agreed"} for key, value in (
            ("max_stories", 8.0), ("separation_fixed", 1.5), ("low_profile_in", 40.0))]},
        "override",
        [("overrides", 0, "value"), ("overrides", 2, "value")],
    ),
    "weight on the roof": (
        {"arrays": [inputs.array("A1", 0.5, roof_capacity_pa=10.0)], "clearances": []},
        "weight per plan area",
        [("arrays", 0, "weight_n"), ("arrays", 0, "roof_capacity_pa")],
    ),
    "weight in wind": (
        {"arrays": [inputs.array("A1", 0.5, wind_weight_pa=10.0)], "clearances": []},
        "weight in wind design",
        [("arrays", 0, "weight_n"), ("arrays", 0, "wind_weight_pa")],
    ),
}  # fmt: skip


@pytest.mark.parametrize("case", CASES)
def test_a_finding_names_the_cells_that_are_missing_or_wrong(case):
    changes, text, places = CASES[case]
    book = stand_in.book(stand_in.project(**changes), scenes.motions(7))
    found = [f for f in limits_before_runs(book.sheet.project, book.shaking) if text in f.text]
    named = {place for finding in found for place in (finding.place, *finding.others)}
    assert named == {Place(*each) for each in places}


def test_cells_of_a_drift_and_of_several_values_are_printed(tmp_path):
    path = sheets.make(tmp_path)
    drift = "".join(f"{2.0 if 20 < i < 60 else 0.0}\n" for i in range(200))
    (tmp_path / "records" / "z.csv").write_text(drift)
    found = [line for line in printed("check", path).splitlines() if "M1, final displ" in line]
    assert [line.split(": ")[1] for line in found] == [sheets.at("Motions/M1/Vertical record")]
    path = sheets.make(tmp_path, site=sheets.site(s_1_g=None))
    line = next(line for line in printed("check", path).splitlines() if "basis of the se" in line)
    cells = f"{sheets.at('Site/S_1')}, {sheets.at('Site/S_D1')}"
    assert line.startswith(f"warning: {cells}: basis of the seismic design category: S_1 and S_D1")
