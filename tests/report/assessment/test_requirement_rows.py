"""Fire lanes, overrides, dates, reviews and confirmations with what they cover."""

import datetime as dt

import pytest

from fixtures import assessments, project_parts, projects
from fixtures.marks import by_day
from fixtures.projects import FOOT, INCH
from fixtures.spaces import spaced
from report.assessment.checks.clearance_checks import of_roof
from report.assessment.checks.rule_limits import of_overrides
from report.assessment.checks.sentence import found_and_limit
from report.assessment.design.rule_set import OVERRIDDEN
from report.assessment.design.verdict import Verdict
from report.project.check.covered import to_record
from report.project.model.input_rows import Place
from solver.rules.limit import Consequence

SECTION = "2022 CFC, example section"


def rows(*x_ft, section=SECTION, units="US", **site):
    """Arrays side by side, each from one x to another, 60 ft deep."""
    arrays = [
        projects.array(f"A{n}", 0.5, x_from_m=low * FOOT, x_to_m=high * FOOT)
        for n, (low, high) in enumerate(x_ft, start=1)
    ]
    given = projects.site(fire_code_section=section, **site)
    head = projects.project().project.model_dump() | {"units_first": units}
    data = projects.project(arrays=arrays, clearances=[], site=given, project=head)
    return sections_of(data)


def sections_of(data):
    return {row.subject: row for row in of_roof(data) if row.id == "fire_lanes"}


def texts(check, *, us_first=True):
    return found_and_limit(check, us_first)


@pytest.mark.parametrize(("to_ft", "verdict"), [(150.0, Verdict.OK), (150.1, Verdict.CONDITION)])
@pytest.mark.quick
def test_fire_lanes_limit_an_array_to_150_feet_by_the_section_given(to_ft, verdict):
    (row,) = rows((0, to_ft)).values()
    assert (row.verdict, row.clause) == (verdict, f"{SECTION}†")
    assert spaced(texts(row)[0]).startswith(f"{to_ft:.2f} ft (45.7")
    (row,) = rows((0, to_ft), units="SI").values()
    assert spaced(texts(row, us_first=False)[1]) == "≤ 45.72 m (150.00 ft)†"


@pytest.mark.quick
def test_arrays_closer_than_a_lane_by_their_shapes_are_one():
    found = rows((0, 80), (83.9, 163.9), (167.9, 200))
    assert spaced([(texts(row)[0], row.verdict) for row in found.values()]) == [
        *[("163.90 ft (49.96 m) (A1, A2)", Verdict.CONDITION)] * 2,
        ("60.00 ft (18.29 m)", Verdict.OK),
    ]
    assert spaced(found["A1"].title).endswith("without a fire pathway of 4.00 ft (1.22 m)")
    assert found["A1"].remedy.startswith("Separate the arrays with a fire pathway")
    assert found["A1"].places[0] == Place("arrays", 0, "x_from_m")
    # Through a neighbor, in any order.
    found = rows((0, 60), (126, 186), (63, 123))
    assert spaced({texts(row)[0] for row in found.values()}) == {"186.00 ft (56.69 m) (A1 to A3)"}
    # A ring of an outline around another array is one with it only where it is near.
    ring = [(0, 0), (140, 0), (140, 140), (130, 140), (130, 10), (10, 10), (10, 140), (0, 140)]
    outlines = [{"name": "A1", "x_m": x * FOOT, "y_m": y * FOOT} for x, y in ring]
    arrays = [
        projects.array("A1", 0.5, **dict.fromkeys(("x_from_m", "x_to_m", "y_from_m", "y_to_m"))),
        projects.array("A2", 0.5, x_from_m=30 * FOOT, x_to_m=110 * FOOT, y_from_m=30 * FOOT,
                       y_to_m=160 * FOOT),
    ]  # fmt: skip
    site = projects.site(fire_code_section=SECTION)
    data = projects.project(arrays=arrays, outlines=outlines, clearances=[], site=site)
    found = spaced({id: texts(row)[0] for id, row in sections_of(data).items()})
    assert found["A1"].startswith("140.00 ft")
    assert found["A2"].startswith("130.00 ft")


@pytest.mark.parametrize(
    ("gap_m", "lane_m", "is_one"),
    [(1.2, None, True), (1.219, None, False),  # 4 ft is 1.2192 m
     (1.2192, 1.22, False), (1.2192, 8 * FOOT, True), (0.0, None, True)],
)  # fmt: skip
def test_a_gap_that_is_a_lane_within_rounding_is_one(gap_m, lane_m, is_one):
    width = {} if lane_m is None else {"fire_lane_m": lane_m}
    found = rows((0, 100), (100 + gap_m / FOOT, 200), **width)
    assert [row.is_satisfied for row in found.values()] == [not is_one] * 2


def test_without_a_section_of_the_fire_code_all_arrays_have_a_condition():
    site = projects.site(fire_code_section="")
    (found,) = (row for row in of_roof(projects.project(site=site)) if row.id == "fire_code")
    assert (found.verdict, found.arrays) == (Verdict.CONDITION, ("A1", "A2", "A3"))
    assert found.remedy == "Enter the section of the fire code on the Site worksheet."
    assert found.places == (Place("site", 0, "fire_code_section"),)
    found = rows((0, 80), (90, 150), (160, 320), section="")
    assert [row.is_satisfied for row in found.values()] == [True, True, False]
    assert {row.clause for row in found.values()} == {"fire code†"}


def overrides(**values):
    return [{"provision": key, "value": v, "reason": "agreed"} for key, v in values.items()]


def overridden(options=None, **values):
    return assessments.package(
        assessments.motions(7),
        overrides=overrides(**values),
        options=options or {},
        arrays=[projects.array("A1", 0.5), projects.array("A2", 2.0, x=120)],
        clearances=[
            projects.clearance("A1", "RTU-1", 7 * FOOT),
            projects.clearance("A2", "S edge", 5 * FOOT, "downslope"),
        ],
    ).assessment


@pytest.mark.parametrize(
    ("key", "less", "more"),
    [("separation_fixed", 0.9, 1.0),  # the number of the rule set
     ("prescriptive_minimum_in", 3.0, 12.0), ("prescriptive_min_mu", 0.3, 0.5),
     ("analysis_floor", 0.4, 0.8), ("analysis_factor", 1.0, 1.2),
     ("analysis_mean_motions", 3.0, 11.0), ("parapet_height_in", 18.0, 30.0),
     ("interconnection_min", 0.05, 0.2), ("analysis_max_slope_deg", 10.0, 5.0),
     ("ibc_max_slope_deg", 8.0, 3.0), ("max_stories", 8.0, 4.0), ("low_profile_in", 48.0, 24.0)],
)  # fmt: skip
@pytest.mark.quick
def test_an_override_that_requires_less_is_a_condition(key, less, more):
    (found,) = of_overrides(projects.project(overrides=overrides(**{key: less})))
    assert (found.is_satisfied, found.consequence) == (False, Consequence.CONDITION)
    assert found.verdict is Verdict.CONDITION
    assert "consent of the authority having jurisdiction" in found.remedy
    assert OVERRIDDEN in found.found
    assert "agreed" in found.found
    (safe,) = of_overrides(projects.project(overrides=overrides(**{key: more})))
    assert safe.is_satisfied


@pytest.mark.quick
def test_an_override_is_a_row_with_both_numbers_and_a_condition():
    (found,) = of_overrides(projects.project(overrides=overrides(prescriptive_minimum_in=3.0)))
    assert found.title == "Override of the minimum prescriptive displacement"
    assert spaced((found.found, found.limit)) == ("3 in‡, agreed", "≥ 6 in")
    assert found.clause == "PV1-2012"
    (slope,) = of_overrides(projects.project(overrides=overrides(analysis_max_slope_deg=10.0)))
    assert spaced(slope.limit) == "≤ 7 deg†"
    plain, done = overridden(), overridden(separation_fixed=0.5)
    more = [row for row in done.open if row not in plain.open]
    assert [row.id for row in more] == ["override"]
    assert [row for row in done.open if row not in more] == plain.open


@pytest.mark.parametrize(("rule_set", "count"), [("SEAOC PV1-2012", 1), ("ASCE 7-16", 0)])
def test_a_mean_without_factor_departs_from_a_rule_set_that_states_a_statistic(rule_set, count):
    site = projects.site(rule_set=rule_set)
    data = projects.project(site=site, options={"statistic": "mean"})
    rows = list(of_overrides(data))
    assert [row.verdict for row in rows] == [Verdict.CONDITION] * count
    assert [row.title for row in rows] == ["Design value statistic"] * count
    assert not list(of_overrides(projects.project(options={"statistic": "1.1 x largest"})))


def marks(done):
    """Marks of the design displacement of each array and of each required separation."""
    return [item.overridden.design for item in done.arrays], [gap.mark for gap in done.clearances]


@pytest.mark.parametrize(("factor", "mark"), [(0.5, "‡"), (1.0, ""), (1.5, "‡")])
def test_a_separation_carries_the_mark_of_its_factor(factor, mark):
    done = overridden(separation_fixed=factor)
    assert marks(done) == (["", ""], [mark, ""])
    gap = done.clearances[0]
    assert gap.factor == factor
    assert (gap.design_mark, gap.ratio_words.endswith("‡")) == ("", bool(mark))


def test_a_lowered_floor_marks_what_it_governed_alone():
    """The value from analysis is between the two floors: without the override it would not do."""
    plain = overridden()
    assert (marks(plain), plain.is_overridden) == ((["", ""], ["", ""]), False)
    assert [item.governs for item in plain.arrays] == ["floor", "floor"]
    done = overridden(analysis_floor=0.0)
    assert [item.governs for item in done.arrays] == ["analysis", "analysis"]
    assert marks(done) == (["‡", "‡"], ["‡", "‡"])
    assert all(
        item.design_m < p.design_m for item, p in zip(done.arrays, plain.arrays, strict=True)
    )
    strong = assessments.motions(7, peak_g=6.0)
    lower = overrides(analysis_floor=0.1)
    done = assessments.package(strong, overrides=lower, clearances=[]).assessment
    assert {item.governs for item in done.arrays} == {"analysis"}
    assert not done.is_overridden
    assert "override" in [row.id for row in done.open]


def test_a_route_and_the_mean_that_an_override_alone_permits_are_marked():
    done = assessments.package(
        assessments.motions(7),
        arrays=[projects.array("A1", 8.0, mu=0.6)],
        clearances=[],
        overrides=overrides(analysis_max_slope_deg=9.0, ibc_max_slope_deg=9.0),
    ).assessment
    assert done.arrays[0].is_permitted
    assert marks(done) == (["‡"], [])
    strong = assessments.motions(11, peak_g=6.0)
    done = assessments.package(strong, options={"statistic": "mean"}, clearances=[]).assessment
    by_analysis = [item for item in done.arrays if item.governs == "analysis"]
    assert by_analysis
    assert all(item.overridden.design for item in by_analysis)


def assessed(**changes):
    return assessments.package(**changes).assessment


def row(done, key):
    found = [item for item in done.checks if item.id == key]
    return next((item for item in found if not item.is_satisfied), found[0] if found else None)


ISSUED = project_parts.HEAD["date"]
LATER = ISSUED + dt.timedelta(days=1)


@pytest.mark.parametrize(
    ("changes", "what"),
    by_day([
        ({"options": assessments.REVIEW | {"peer_date": LATER}}, "peer review"),
        ({"friction_tests": {"date": LATER}}, "friction report"),
        ({"site": project_parts.SITE | {"hazard_date": LATER}}, "seismic parameters"),
        ({"project": project_parts.HEAD
          | {"drawing_confirmed_by": "RG", "drawing_confirmed_date": LATER}},
         "confirmation of the drawing"),
        (assessments.CONFIRMED
         | {"confirmation": assessments.CONFIRMED["confirmation"] | {"date": LATER}},
         "confirmation of the provisions"),
    ], 2),
)  # fmt: skip
def test_what_is_dated_later_than_the_package_is_a_condition(changes, what):
    late = row(assessed(**changes), "dates")
    assert (late.title, late.verdict) == (f"Date of the {what}", Verdict.CONDITION)
    assert late.found == str(LATER)
    assert late.limit == f"not later than {ISSUED}, and for these inputs"
    issued = {"project": project_parts.HEAD | changes.get("project", {}) | {"date": LATER}}
    assert row(assessed(**changes | issued), "dates").is_satisfied


def test_a_review_that_is_dated_later_removes_no_floor_and_confirms_no_distance():
    reviewed = assessed(options=assessments.REVIEW)
    late = assessed(options=assessments.REVIEW | {"peer_date": LATER})
    assert [item.floor_m for item in reviewed.arrays] == [0.0] * len(reviewed.arrays)
    assert [item.floor_m for item in late.arrays] == [item.floor_m for item in assessed().arrays]
    assert all(item.floor_m > 0.0 for item in late.arrays)
    drawn = projects.clearance("A1", "RTU-1", 6.0) | {"source": "drawing"}
    for date, is_confirmed in ((ISSUED, True), (LATER, False)):
        head = project_parts.HEAD | {"drawing_confirmed_by": "RG", "drawing_confirmed_date": date}
        given = {"project": head, "clearances": [drawn]}
        assert row(assessed(**given), "drawing_distances").is_satisfied is is_confirmed
    given = on_record(project=head | {"drawing_confirmed_date": ISSUED}, clearances=[drawn])
    moved = assessed(**given | {"clearances": [drawn | {"provided_m": 5.0}]})
    assert not row(moved, "drawing_distances").is_satisfied


RUN = {"surface": "wet", "number": 1, "mu": 0.46, "velocity_mps": INCH}


def on_record(**changes):
    """Sections with what their confirmations cover, as `report` fills it in."""
    records = projects.book(projects.project(**changes), assessments.motions()).shaking.hashes
    for place, text in to_record(projects.project(**changes), records).items():
        changes[place.section] = changes[place.section] | {place.field: text}
    return changes


def outdated_row(title, **changes):
    rows = [row for row in assessed(**changes).checks if row.title == f"Date of the {title}"]
    rows = [row for row in rows if not row.is_satisfied]
    assert len(rows) < 2
    return next(iter(rows), None)


def test_a_review_given_before_an_array_changed_removes_no_floor_and_is_a_condition():
    reviewed = on_record(options=assessments.REVIEW)
    assert outdated_row("peer review", **reviewed) is None
    assert not any(item.floor_m for item in assessed(**reviewed).arrays)
    arrays = [projects.array("A1", 0.5, mu=0.42), *projects.project().model_dump()["arrays"][1:]]
    found = outdated_row("peer review", **reviewed, arrays=arrays)
    assert found.verdict is Verdict.CONDITION
    assert found.found == "2026-03-01, dated before these inputs changed: worksheet Arrays"
    assert found.remedy.startswith("Have it confirmed for these inputs, and enter the new date")
    after = assessed(**reviewed, arrays=arrays)
    floors = [item.floor_m for item in assessed(arrays=arrays).arrays]
    assert [item.floor_m for item in after.arrays] == floors
    assert all(floor_m > 0.0 for floor_m in floors)
    reduced = after.at_reduced_friction
    assert all(item.floor_m > 0.0 for item in reduced.arrays)
    # Less friction is a variation of the input as it is, which is still reviewed.
    assert not any(item.floor_m for item in assessed(**reviewed).at_reduced_friction.arrays)
    again = reviewed["options"] | {"peer_date": dt.date(2026, 3, 2)}
    assert outdated_row("peer review", options=again, arrays=arrays) is None


def test_values_that_changed_after_their_document_are_a_condition_until_they_are_compared():
    site = project_parts.SITE | {
        "hazard_source": "Hazard Tool",
        "hazard_date": dt.date(2026, 2, 20),
    }
    tests = {"friction_tests": assessments.TESTS, "friction_runs": [RUN]}
    given = on_record(site=site, **tests)
    for title, change, sheet, label, cell in (
        ("seismic parameters", {"site": given["site"] | {"s_ds_g": 1.6}}, "Site",
         "Seismic parameters", "hazard"),
        ("friction report", {"friction_runs": [RUN | {"mu": 0.47}]}, "Friction tests",
         "Test report", "tests"),
    ):  # fmt: skip
        assert outdated_row(title, **given) is None
        found = outdated_row(title, **given | change)
        assert found.found.endswith(f"dated before these inputs changed: worksheet {sheet}")
        assert found.remedy.endswith(f"if they agree, clear {label} covered.")
        key = found.places[0].section
        cleared = given | change | {key: (given | change)[key] | {f"{cell}_covered": ""}}
        assert outdated_row(title, **cleared) is None


OVERRIDE = {"provision": "parapet_height_in", "value": 18.0, "reason": "Agreed on 2026-02-11"}


def test_provisions_that_are_confirmed_have_no_mark_but_where_they_are_overridden():
    done = assessed(**assessments.CONFIRMED, overrides=[OVERRIDE])
    assert row(done, "confirmation").verdict is Verdict.OK
    marked = {key for key, value in done.rules.values.items() if not value.verified}
    assert marked == {OVERRIDE["provision"]}
    assert len({k for k, v in assessed().rules.values.items() if not v.verified}) > 10


@pytest.mark.parametrize(
    "change",
    [{"rule_set": "ASCE 7-16", "edition_name": "ASCE 7-16"}, {"building_code_year": 2019},
     {"edition_name": "ASCE 7-22", "s_1_g": 0.7}],
)  # fmt: skip
def test_provisions_of_another_rule_set_edition_or_code_are_not_those_confirmed(change):
    """Also where no report has been made between, which would have put it on record."""
    site = assessments.CONFIRMED["site"] | change
    done = assessed(**assessments.CONFIRMED | {"site": site})
    found = row(done, "confirmation")
    assert found.verdict is Verdict.CONDITION
    assert found.found == "SEAOC PV1-2012, ASCE 7-16, 2022 CBC: RG, SE, 2026-03-01"
    assert (done.project.confirmed, found.limit) == ("", ", ".join(done.project.site.adopted))
    assert done.rules.values == assessed(site=site).rules.values


@pytest.mark.parametrize(
    ("change", "sheet"),
    by_day([
        ({"overrides": [OVERRIDE]}, "worksheet Options"),
        ({"confirmation": {"by": "MT"}}, "worksheet Options"),
        ({"confirmation": {"code": "2019 CBC"}, "site": {"building_code_year": 2019}},
         "worksheets Site, Options"),
        ({"site": {"rule_set": "ASCE 7-16"}}, "worksheet Site"),
    ], 1),
)  # fmt: skip
def test_a_later_change_of_what_was_confirmed_brings_the_marks_back(change, sheet):
    given = on_record(**assessments.CONFIRMED)
    assert assessed(**given).project.confirmed == "RG, SE, 2026-03-01"
    rows = {key: given[key] | part for key, part in change.items() if key in given}
    done = assessed(**given | change | rows)
    assert done.project.confirmed == ""
    title = "Date of the confirmation of the provisions"
    (said,) = (row for row in done.checks if row.title == title)
    assert said.verdict is Verdict.CONDITION
    assert said.found == f"2026-03-01, dated before these inputs changed: {sheet}"
    again = given | change | rows
    again["confirmation"] = again["confirmation"] | {"date": dt.date(2026, 3, 2)}
    is_same = done.project.confirmation.of == done.project.site.adopted
    assert bool(assessed(**again).project.confirmed) is is_same
