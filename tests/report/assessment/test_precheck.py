"""What `check` says without a run is what the report finds, at the cells to fill in."""

import datetime as dt
from dataclasses import replace

import pytest

from fixtures import assessments, project_parts, projects, workbooks
from fixtures.commands import stdout_of
from fixtures.spaces import spaced
from report.assessment.checks.motion_checks import shaking_acceptance
from report.assessment.checks.sentence import sentence
from report.assessment.design.routes import Route
from report.assessment.precheck import limits_before_runs
from report.motions.history import targets
from report.project.model.finding import Level
from report.project.model.input_rows import Place
from report.project.model.shapes import SIDES

SEVEN = assessments.motions(7)
BARE = projects.project(
    arrays=[projects.array("A1", 8.0, mu_report="", x_to_m=200 * projects.FOOT)], clearances=[]
)
LIMITS = {
    "the usual project": (projects.project(), SEVEN),
    "slope, risk category and stories": (
        projects.project(arrays=[projects.array("A1", 8.0)], clearances=[],
                         site=projects.site(risk_category="IV", i_e=1.5, stories=7)),
        SEVEN,
    ),
    "two motions on a slope that only analysis permits": (projects.steep(), SEVEN[:2]),
    "two motions on a slope of the prescriptive procedure": (projects.project(), SEVEN[:2]),
    "no vertical, no test report, no fire lane": (
        BARE,
        tuple(projects.motion(m.id, m.ax_mps2, ay=m.ay_mps2, dt_s=m.dt_s) for m in SEVEN[:3]),
    ),
}  # fmt: skip
NEED_RUNS = {
    "neighbors", "less_friction", "clearance_less_friction", "electrical_slack", "clearance",
    "design", "tipping", "runs", "friction_velocity", "fire_pathways",
}  # fmt: skip


@pytest.mark.parametrize("case", LIMITS)
@pytest.mark.quick
def test_check_and_report_name_the_same_limits_and_requirements(case):
    book = projects.book(*LIMITS[case])
    assessment = projects.assessed(book)
    rows = [check for check in assessment.checks if check.is_open and check.id not in NEED_RUNS]
    slack = [a for a in assessment.arrays if a.array.slack_m is None]
    listed = list(limits_before_runs(book.sheet.project, book.shaking))
    found = [f for f in listed if f.level is Level.WARNING]
    assert len(found) == len(rows) + len(slack)
    words = [finding.text for finding in found]
    for row in rows:
        # What the project comes to without it needs runs.
        known = replace(row, otherwise="")
        assert f"{row.verdict}. {sentence(known, us_first=True)}" in words
    prescribed = [a for a in assessment.arrays if a.route is Route.PRESCRIPTIVE]
    notes = [row for row in assessment.notes if row.id not in NEED_RUNS]
    assert sum(f.level is Level.NOTE for f in listed) == len(prescribed) + len(notes)


def findings(*given):
    book = projects.book(*given)
    return list(limits_before_runs(book.sheet.project, book.shaking))


@pytest.mark.quick
def test_a_limit_names_its_cell_its_value_and_the_limit_and_cannot_be_acknowledged():
    listed = findings(*LIMITS["slope, risk category and stories"])
    assert {finding.id for finding in listed} == {""}
    found = {finding.place: finding.text for finding in listed}
    assert found[Place("site", 0, "risk_category")] == (
        "NG. Risk Category (I = 1 to IV = 4): 4. Required: at most 3† (PV1-2012†)."
    )
    assert found[Place("site", 0, "stories")] == (
        "NG. Number of stories: 7. Required: at most 6† (PV1-2012†)."
    )
    slope = Place("arrays", 0, "slope_value")
    assert spaced([finding.text for finding in listed if finding.place == slope]) == [
        "NG. Roof slope, any ballasted system, A1: 8.00° (14.1%). "
        "Required: at most 4.76° (8.3%)† (IBC 1613.3†).",
        "NG. Roof slope, analysis procedure, A1: 8.00° (14.1%). "
        "Required: at most 7.00° (12.2%)† (PV1-2012†).",
    ]


@pytest.mark.parametrize(
    ("case", "text"),
    [
        (
            "two motions on a slope that only analysis permits",
            "Number of motions: 2. Required: at least 3†",
        ),
        ("no vertical, no test report, no fire lane", "two horizontal and one vertical"),
    ],
)
def test_too_few_motions_and_no_vertical_are_said_at_the_motions(case, text):
    found = [f.text for f in findings(*LIMITS[case]) if f.place == Place("motions")]
    assert any(text in words for words in found)


def test_a_statistic_that_needs_more_motions_is_the_reason_or_ng_at_its_cell():
    data = projects.project(options={"statistic": "mean"})
    notes = [f.text for f in findings(data, SEVEN) if f.level is Level.NOTE]
    found = [text for text in notes if "uses the prescriptive displacement" in text]
    reason = "the statistic 'mean' requires at least 11 motions; 7 are listed"
    assert found
    assert all(reason in text for text in found)
    found = findings(projects.steep(options={"statistic": "mean"}), SEVEN)
    texts = [f.text for f in found if f.place == Place("options", 0, "statistic")]
    (lacking,) = (text for text in texts if text.startswith("NG. Design displacement"))
    assert f"none ({reason}). Required: a displacement from a permitted procedure" in lacking
    prescribed = findings(projects.project(options={"statistic": "mean"}), SEVEN)
    assert not any(f.text.startswith("NG. Design") for f in prescribed)


HAZARD = {
    "hazard_source": "GeoEngineers",
    "hazard_date": dt.date(2026, 2, 1),
    "hazard_printout": "hazard.pdf",
}
TESTS = {"laboratory": "Laboratory", "report": "FT-1", "date": dt.date(2025, 6, 12)}
REVIEW = assessments.REVIEW | {"peer_letter": ""}
RUN = {"surface": "dry", "number": 1, "mu": 0.5}
SITE = {name: value for name, value in projects.site().items() if name not in HAZARD}


def site(**changes):
    return {"site": SITE | changes}


CASES = {
    "S_1 that decides on the design category": (
        site(s_1_g=None, f_v=None), "Seismic design category",
        [("site", 0, "s_1_g")]),
    "report number of the hazard": (
        site(**HAZARD, hazard="site-specific analysis"),
        "Report on the site-specific hazard analysis", [("site", 0, "hazard_report")]),
    "date of the hazard": (
        site(hazard_source="Tool"), "Source, date and printout of the seismic parameters",
        [("site", 0, "hazard_date"), ("site", 0, "hazard_printout")]),
    "S_1 that decides on a site-specific analysis": (
        site(s_1_g=None), "Hazard analysis for site class D", [("site", 0, "s_1_g")]),
    "mapped values in site class D": (
        site(hazard="mapped values"), "Hazard analysis for site class D", [("site", 0, "hazard")]),
    "jurisdiction": (
        site(building_code="CBC", building_code_year=2022), "Building code and jurisdiction",
        [("site", 0, "jurisdiction")]),
    "license and letter of the review": (
        {"options": REVIEW | {"peer_license": ""}}, "Peer review of the analysis",
        [("options", 0, "peer_license"), ("options", 0, "peer_letter")]),
    "standard and accreditation": (
        {"friction_tests": TESTS}, "Friction test standard",
        [("friction_tests", 0, "standard"), ("friction_tests", 0, "accreditation")]),
    "date of the friction report": (
        {"friction_tests": TESTS | {"date": None}}, "Friction test report",
        [("friction_tests", 0, "date")]),
    "no runs": ({}, "Friction test repeats", [("friction_runs", 0, "")]),
    "runs without a velocity": (
        {"friction_runs": [RUN | {"velocity_mps": 0.1}, RUN | {"number": 2}]},
        "Friction test repeats", [("friction_runs", 1, "velocity_mps")]),
    "Outline of the roof": ({}, "Outline of the roof", [("roof", 0, side) for side in SIDES]),
    "mean of few motions": (
        {"options": {"statistic": "mean"}},
        "uses the prescriptive displacement: the statistic 'mean' requires at least 11 motions",
        [("options", 0, "statistic")]),
    "drawn distances": (
        {"clearances": [row | {"source": source} for row, source in zip(
            projects.SECTIONS["clearances"], ("drawing", "measured", "drawing", None, None),
            strict=True)]},
        "Clear distances from the drawing, A3",
        [("clearances", 0, "source"), ("clearances", 2, "source")]),
    "overrides that require less": (
        {"overrides": [{"provision": key, "value": value, "reason": "agreed"} for key, value in (
            ("max_stories", 8.0), ("separation_fixed", 1.5), ("low_profile_in", 40.0))]},
        "Override", [("overrides", 0, "value"), ("overrides", 2, "value")]),
    "weight in wind": (
        {"arrays": [project_parts.array("A1", 0.5, wind_weight_pa=10.0)], "clearances": []},
        "Weight in wind design", [("arrays", 0, "weight_n"), ("arrays", 0, "wind_weight_pa")]),
}  # fmt: skip


@pytest.mark.parametrize("case", CASES)
@pytest.mark.quick
def test_a_finding_names_the_cells_that_are_missing_or_wrong(case):
    changes, text, places = CASES[case]
    book = projects.book(projects.project(**changes), assessments.motions(7))
    found = [f for f in limits_before_runs(book.sheet.project, book.shaking) if text in f.text]
    named = {place for finding in found for place in (finding.place, *finding.others)}
    assert named == {Place(*each) for each in places}


@pytest.mark.quick
def test_cells_of_a_drift_and_of_several_values_are_printed(tmp_path):
    path = workbooks.make(tmp_path)
    drift = "".join(f"{2.0 if 20 < i < 60 else -0.01}\n" for i in range(200))
    (tmp_path / "records" / "z.csv").write_text(drift)
    found = [
        line
        for line in stdout_of("check", path).splitlines()
        if "Final displacement of the record, M1" in line
    ]
    assert [line.split(": ")[1] for line in found] == [
        workbooks.cell_address("Motions/M1/Vertical record")
    ]
    path = workbooks.make(tmp_path, site=workbooks.site(hazard_source="Tool"))
    line = next(
        line for line in stdout_of("check", path).splitlines() if "date and printout" in line
    )
    date = workbooks.cell_address("Site/Date of seismic parameters")
    cells = f"{date}, {workbooks.cell_address('Site/Printout of seismic parameters')}"
    assert line.startswith(f"warning: {cells}: Condition. Source, date and printout of the seismic")


def scaled(factor):
    return tuple(replace(motion, scale=factor * motion.scale) for motion in SEVEN)


def spectral(motions):
    # A slope that only analysis permits: what the motions miss is NG.
    return [f.text for f in findings(projects.steep(), motions) if "target" in f.text]


def test_a_factor_is_advised_where_one_reaches_the_target_and_then_it_does():
    book = projects.book(projects.project(), SEVEN)
    rows = shaking_acceptance(book.shaking, targets(book.sheet.project)).rows
    just = max(row.limit / row.found for row in rows if row.is_ratio_to_target)
    assert spectral(scaled(1.001 * just)) == []
    text = next(text for text in spectral(scaled(0.7 * just)) if "times their factors" in text)
    assert "set Scaling to factor on the Motions worksheet, and the factors M1 to M7 " in text
    factor = float(text.partition(" M1 to M7 ")[2].split()[0].rstrip("."))
    assert just <= factor < 1.2 * just
    assert spectral(scaled(factor)) == []
    texts = spectral(scaled(0.3 * just))  # of another intensity than the target
    assert texts
    assert not any("times their factors" in text for text in texts)
