"""Dates, reviews and confirmations, and what they cover: a later change takes them out."""

import datetime as dt
from dataclasses import replace

import pytest

import inputs
import scenes
import stand_in
from report.assessment.verdict import Verdict
from report.sheet.checking.covered import to_record
from stand_in import INCH


def assessed(**changes):
    return scenes.package(**changes).assessment


def row(done, key):
    return next((item for item in done.rows if item.id == key), None)


ISSUED = inputs.HEAD["date"]


LATER = ISSUED + dt.timedelta(days=1)


@pytest.mark.parametrize(
    ("changes", "what"),
    [
        ({"options": scenes.REVIEW | {"peer_date": LATER}}, "peer review"),
        ({"friction_tests": {"date": LATER}}, "friction report"),
        ({"site": inputs.SITE | {"hazard_date": LATER}}, "hazard"),
        ({"project": inputs.HEAD | {"drawing_confirmed_by": "RG", "drawing_confirmed_date": LATER}},
         "confirmation of the drawing"),
        (scenes.CONFIRMED | {"confirmation": scenes.CONFIRMED["confirmation"] | {"date": LATER}},
         "confirmation of the provisions"),
    ],
)  # fmt: skip
def test_what_is_dated_later_than_the_package_is_a_condition(changes, what):
    late = row(assessed(**changes), "dates")
    assert (late.title, late.verdict) == (f"Date of the {what}", Verdict.CONDITION)
    assert (late.found, late.limit) == (str(LATER), f"not later than the package, {ISSUED}")
    issued = {"project": inputs.HEAD | changes.get("project", {}) | {"date": LATER}}
    assert row(assessed(**changes | issued), "dates") is None


def test_a_review_that_is_dated_later_removes_no_floor_and_confirms_no_distance():
    reviewed = assessed(options=scenes.REVIEW)
    late = assessed(options=scenes.REVIEW | {"peer_date": LATER})
    assert [item.floor_m for item in reviewed.arrays] == [0.0] * len(reviewed.arrays)
    assert [item.floor_m for item in late.arrays] == [item.floor_m for item in assessed().arrays]
    assert all(item.floor_m > 0.0 for item in late.arrays)
    drawn = stand_in.clearance("A1", "RTU-1", 6.0) | {"source": "drawing"}
    for date, is_confirmed in ((ISSUED, True), (LATER, False)):
        head = inputs.HEAD | {"drawing_confirmed_by": "RG", "drawing_confirmed_date": date}
        found = row(assessed(project=head, clearances=[drawn]), "drawing_distances")
        assert found.is_satisfied is is_confirmed


RUN = {"surface": "wet", "number": 1, "mu": 0.46, "velocity_mps": INCH}


def on_record(**changes):
    """Sections with what their confirmations cover, as `report` fills it in."""
    records = stand_in.book(stand_in.project(**changes), scenes.motions()).shaking.hashes
    for place, text in to_record(stand_in.project(**changes), records).items():
        changes[place.section] = changes[place.section] | {place.field: text}
    return changes


def outdated_row(title, **changes):
    rows = [row for row in assessed(**changes).rows if row.title == title]
    assert len(rows) < 2
    return next(iter(rows), None)


def test_a_review_given_before_an_array_changed_removes_no_floor_and_is_a_condition():
    reviewed = on_record(options=scenes.REVIEW)
    assert outdated_row("Peer review", **reviewed) is None
    assert not any(item.floor_m for item in assessed(**reviewed).arrays)
    arrays = [stand_in.array("A1", 0.5, mu=0.42), *stand_in.project().model_dump()["arrays"][1:]]
    found = outdated_row("Peer review", **reviewed, arrays=arrays)
    assert found.verdict is Verdict.CONDITION
    assert found.found == "2026-03-01, given before these inputs changed: sheet Arrays"
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
    assert outdated_row("Peer review", options=again, arrays=arrays) is None


def test_another_record_is_not_what_was_reviewed():
    reviewed = on_record(options=scenes.REVIEW)
    book = stand_in.book(stand_in.project(**reviewed), scenes.motions())
    other = (replace(book.records[0], sha256="cd" * 32), *book.records[1:])
    done = stand_in.assessed(book.having(records=other))
    (found,) = (row for row in done.rows if row.title == "Peer review")
    assert found.found.endswith("sheet Motions")
    assert all(item.floor_m > 0.0 for item in done.arrays)


def test_values_that_changed_after_their_document_are_a_condition_until_they_are_compared():
    site = inputs.SITE | {"hazard_source": "Hazard Tool", "hazard_date": dt.date(2026, 2, 20)}
    tests = {"friction_tests": scenes.TESTS, "friction_runs": [RUN]}
    given = on_record(site=site, **tests)
    for title, change, sheet, label, clear in (
        ("Hazard", {"site": given["site"] | {"s_ds_g": 1.6}}, "Site", "Hazard covered",
         {"hazard_covered": ""}),
        ("Friction report", {"friction_runs": [RUN | {"mu": 0.47}]}, "Friction tests",
         "Test report covered", {"tests_covered": ""}),
    ):  # fmt: skip
        assert outdated_row(title, **given) is None
        found = outdated_row(title, **given | change)
        assert found.found.endswith(f"given before these inputs changed: sheet {sheet}")
        assert found.remedy.endswith(f"if they agree, clear {label}.")
        key = found.places[0].section
        cleared = given | change | {key: (given | change)[key] | clear}
        assert outdated_row(title, **cleared) is None


OVERRIDE = {"provision": "parapet_height_in", "value": 18.0, "reason": "Agreed on 2026-02-11"}


def test_provisions_that_are_confirmed_have_no_mark_but_where_they_are_overridden():
    done = assessed(**scenes.CONFIRMED, overrides=[OVERRIDE])
    assert row(done, "confirmation").verdict is Verdict.OK
    marked = {key for key, value in done.rules.values.items() if not value.verified}
    assert marked == {OVERRIDE["provision"]}
    assert len({k for k, v in assessed().rules.values.items() if not v.verified}) > 10


@pytest.mark.parametrize(
    "change",
    [
        {"rule_set": "ASCE 7-16", "edition_name": "ASCE 7-16"},
        {"edition_name": "ASCE 7-22", "s_1_g": 0.7},
        {"building_code_year": 2019},
        {"building_code": "IBC"},
    ],
)
def test_provisions_of_another_rule_set_edition_or_code_are_not_those_confirmed(change):
    """Also where no report has been made between, which would have put it on record."""
    site = scenes.CONFIRMED["site"] | change
    done = assessed(**scenes.CONFIRMED | {"site": site})
    found = row(done, "confirmation")
    assert found.verdict is Verdict.CONDITION
    assert found.found == "SEAOC PV1-2012, ASCE 7-16, 2022 CBC: RG, SE, 2026-03-01"
    assert (done.project.confirmed, found.limit) == ("", ", ".join(done.project.site.adopted))
    assert done.rules.values == assessed(site=site).rules.values


@pytest.mark.parametrize(
    ("change", "sheet"),
    [
        ({"overrides": [OVERRIDE]}, "sheet Options"),
        ({"confirmation": {"by": "MT"}}, "sheet Options"),
        ({"confirmation": {"code": "2019 CBC"}, "site": {"building_code_year": 2019}},
         "sheets Site, Options"),
        ({"site": {"rule_set": "ASCE 7-16"}}, "sheet Site"),
    ],
)  # fmt: skip
def test_a_later_change_of_what_was_confirmed_brings_the_marks_back(change, sheet):
    given = on_record(**scenes.CONFIRMED)
    assert assessed(**given).project.confirmed == "RG, SE, 2026-03-01"
    rows = {key: given[key] | part for key, part in change.items() if key in given}
    done = assessed(**given | change | rows)
    assert done.project.confirmed == ""
    (said,) = (row for row in done.rows if row.title == "Confirmation of the provisions")
    assert said.verdict is Verdict.CONDITION
    assert said.found == f"2026-03-01, given before these inputs changed: {sheet}"
    again = given | change | rows
    again["confirmation"] = again["confirmation"] | {"date": dt.date(2026, 3, 2)}
    is_same = done.project.confirmation.of == done.project.site.adopted
    assert bool(assessed(**again).project.confirmed) is is_same


def test_a_drawing_distance_that_changed_by_hand_is_not_confirmed_any_more():
    drawn = stand_in.clearance("A1", "RTU-1", 6.0) | {"source": "drawing"}
    head = inputs.HEAD | {"drawing_confirmed_by": "RG", "drawing_confirmed_date": ISSUED}
    given = on_record(project=head, clearances=[drawn])
    assert row(assessed(**given), "drawing_distances").is_satisfied
    changed = given | {"clearances": [drawn | {"provided_m": 5.0}]}
    assert not row(assessed(**changed), "drawing_distances").is_satisfied
    found = outdated_row("Confirmation of the drawing", **changed)
    assert found.found == f"{ISSUED}, given before these inputs changed: sheet Clearances"
