"""What the summary must name: a removed floor, and a departure from the rule set."""

import datetime as dt

import stand_in
from report.pages.front import summary
from report.pages.registry import package_data

REVIEW = {
    "peer_reviewed": True,
    "peer_reviewer": "Reviewer of record",
    "peer_license": "CA S0000",
    "peer_date": dt.date(2026, 3, 1),
}
DEPARTURE = {
    "directional": True,
    "directional_reason": "Agreed on 2026-02-10",
    "directional_reviewer": "Reviewer of record",
    "directional_license": "CA S0000",
    "directional_date": dt.date(2026, 3, 1),
}


def numbers(**options):
    data = stand_in.project(options=options)
    done = stand_in.assess_input(data, stand_in.motions(3, seconds=8.0))
    return {label: text for label, text, _ in summary(package_data(done), (), ())["numbers"]}


def test_neither_is_named_where_there_is_none():
    assert not {"Floor", "Departure"} & set(numbers())


def test_a_removed_floor_is_named_with_its_reviewer():
    assert numbers(**REVIEW)["Floor"] == (
        "removed by peer review: Reviewer of record, CA S0000, 2026-03-01"
    )
    assert "reviewer not given" in numbers(peer_reviewed=True)["Floor"]


def test_a_departure_is_named_with_its_reason():
    assert "Agreed on 2026-02-10" in numbers(**DEPARTURE)["Departure"]
