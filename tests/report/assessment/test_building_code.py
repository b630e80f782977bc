"""The building code beside the rule set and the edition of the seismic parameters."""

import pytest

from fixtures import assessments, project_parts, projects
from fixtures.spaces import spaced
from report.assessment.checks.seismic_parameters import of_site
from report.assessment.design.verdict import Verdict
from report.assessment.precheck import limits_before_runs
from report.project.model.choices import BuildingCode
from solver.rules.hazard import EDITIONS, REFERENCED
from solver.rules.rulesets import RULE_SETS

IDS = ("rule_set", "edition_name", "code_edition")
OF_22 = {"edition_name": "ASCE 7-22", "f_a": None, "f_v": None}


def site(code, **changes):
    year, _, name = code.rpartition(" ")
    given = {"building_code": name, "building_code_year": int(year)} if code else {}
    return projects.site(**given, **changes)


def listed(rows):
    return {row.id: row for row in rows if row.id in IDS}


def not_so(rows):
    return {id: row for id, row in rows.items() if not row.is_satisfied}


def before_runs(code, **changes):
    return listed(of_site(projects.project(site=site(code, **changes))))


def assessed(code, *, sections=(), **changes):
    return assessments.package(site=site(code, **changes), **dict(sections)).assessment


@pytest.mark.quick
def test_known_codes_are_those_offered_and_named_where_one_is_not_known():
    assert {code.split()[1] for code in REFERENCED} == {code.value for code in BuildingCode}
    assert set(REFERENCED.values()) <= EDITIONS.keys() & RULE_SETS.keys()
    row = before_runs("2001 CBC")["code_edition"]
    assert row.found == "not known to this program for the 2001 CBC"
    assert all(code in row.remedy for code in REFERENCED)


@pytest.mark.parametrize("year", [2018, 2021, 2024])
def test_the_cbc_references_what_the_ibc_of_the_year_before_does(year):
    assert REFERENCED[f"{year + 1} CBC"] == REFERENCED[f"{year} IBC"]


@pytest.mark.parametrize("code", ["2001 CBC", "2025 CBC"])
def test_the_letter_of_the_jurisdiction_satisfies_what_it_accepts(code):
    accepted = before_runs(code, acceptance_letter="acceptance.pdf")
    assert list(accepted) == list(before_runs(code))
    assert all(row.verdict is Verdict.OK and not row.to_close for row in accepted.values())
    letter = "; acceptance.pdf, attached"
    assert [id for id, row in accepted.items() if row.found.endswith(letter)] == [
        *not_so(before_runs(code))
    ]


@pytest.mark.parametrize(
    ("code", "changes", "found"),
    [("", {}, []), ("2022 CBC", {"rule_set": "ASCE 7-16"}, []), ("2022 CBC", {}, ["rule_set"]),
     ("2025 CBC", OF_22, ["rule_set"]), ("2025 CBC", {}, ["rule_set", "edition_name"]),
     ("2021 IBC", OF_22 | {"rule_set": "ASCE 7-22"}, ["rule_set", "edition_name"]),
     ("2001 CBC", {}, ["code_edition"]), ("2022 IBC", {"rule_set": "ASCE 7-16"}, ["code_edition"])],
)  # fmt: skip
def test_what_is_not_by_the_edition_of_the_building_code_is_a_condition(code, changes, found):
    rows = not_so(before_runs(code, **changes))
    assert list(rows) == found
    assert {row.verdict for row in rows.values()} <= {Verdict.CONDITION}
    assert {row.clause for row in rows.values()} <= {f"{code}, chapter 35†"}


def test_check_says_so_at_the_cell_without_any_run():
    made = projects.book(projects.project(site=site("2025 CBC")), assessments.motions())
    said = {f.place.field: f.text for f in limits_before_runs(made.sheet.project, made.shaking)}
    for field in ("rule_set", "edition_name"):
        assert "Required: ASCE 7-22 of the 2025 CBC†, or written acceptance of" in said[field]
        assert "Under ASCE" not in said[field]


@pytest.mark.parametrize("changes", [{}, OF_22, {"rule_set": "ASCE 7-16"}])
def test_one_of_two_conditions_says_what_an_assessment_by_the_rule_set_of_the_code_gives(changes):
    done = assessed("2025 CBC", **changes)
    rule_set = {"rule_set": "ASCE 7-22", "f_a": None, "f_v": None}
    by_code = assessed("2025 CBC", **rule_set)
    assert listed(by_code.open) == {}
    gaps = [gap for gap in by_code.clearances if gap.demand_capacity > 0.0]
    worst = max(gaps, key=lambda gap: gap.demand_capacity)
    verdict = by_code.verdict
    between = f"clearance {worst.clearance.array} to {worst.clearance.object}"
    rows = listed(done.open)
    assert len(rows) == (1 if changes == OF_22 else 2)
    text = f"Under ASCE 7-22 13.6.12, with the same motions and S_DS: {verdict}, {between} "
    outcome, *others = (row.otherwise for row in rows.values())
    # The two editions of ASCE 7 ask for the same: there nothing else comes of it.
    assert (text in outcome) is (changes != {"rule_set": "ASCE 7-16"})
    assert bool(outcome) is (text in outcome)
    assert not any(others)


def test_the_outcome_says_other_reasons_and_takes_no_override_over():
    sections = {"overrides": [{"provision": "max_stories", "value": 9, "reason": "Agreed"}]}
    done = assessed("2022 CBC", sections=sections, stories=8)
    outcome = listed(done.open)["rule_set"].otherwise
    assert "S_DS, without overrides and departures: NG, " in outcome
    assert "; number of stories" in outcome


def test_a_row_of_linked_blocks_counts_with_the_other_displacement_too():
    links = [projects.links("A1", "0.40, 0.45, 0.50", 50)]
    sections = {"arrays": [projects.array("A1", 2.0)], "objects": [], "clearances": [],
                "links": links, "options": project_parts.REVIEW}  # fmt: skip
    done = assessed("2022 CBC", sections=sections)
    assert not done.is_rigid_enough(done.arrays[0])
    # The floor, which governs without the review, is more than the row slides.
    text = done.otherwise["peer_review"]
    assert spaced(text).startswith("Without peer review: not NG; Δ up to 40.8 in ")
