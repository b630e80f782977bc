"""What the summary must name: a removed floor, and a departure from the rule set."""

import datetime as dt

import stand_in
from places import ROOT
from report.assessment.arrays import Route
from report.assessment.project import assess
from report.pages.front import summary, verdict_sentence
from report.pages.letter import letter
from report.pages.registry import package_data
from report.pages.summary import document
from report.pages.summary import summary as printed
from report.web.opened import opened, with_values

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


def test_no_floor_is_removed_where_the_design_is_prescriptive():
    arrays = [stand_in.array("A2", 0.5, x=120)]
    package = package_data(stand_in.unpermitted(arrays=arrays, clearances=[]))
    assert package.governing.route is Route.PRESCRIPTIVE
    shown = {label: text for label, text, _ in summary(package, (), ())["numbers"]}
    assert "Floor" not in shown
    assert shown["Peer review"] == (
        "reviewer not given; no floor is used: the design displacements are prescriptive"
    )
    assert not any("floor" in text for text in letter(package)["texts"])


def test_a_departure_is_named_with_its_reason():
    assert "Agreed on 2026-02-10" in numbers(**DEPARTURE)["Departure"]


def test_clearances_without_a_verdict_are_counted_beside_what_is_ng():
    for count, words in ((3, "2 of 3 clearances."), (1, "1 of 1 clearance.")):
        given = [row.model_dump() for row in stand_in.unpermitted().project.clearances]
        package = package_data(stand_in.unpermitted(clearances=given[:count]))
        text = verdict_sentence(package)
        assert text.startswith("Marked NG: ")
        assert text.endswith(f"; without a verdict: {words}")


def test_the_terminal_marks_what_is_not_permitted_and_calls_nothing_beside_it_ok():
    weak = with_values(opened(ROOT / "projects/school"), {"intensity": 0.32, "together": "no"})
    done = assess(weak.sheet, weak.shaking)
    lines = list(printed(done))
    for item, line in zip(done.arrays, lines[1:], strict=False):
        assert line.startswith(item.id)
        assert "0 mm (0.0 in), not permitted" in line
        assert "none  NG: limits on the motions" in line
        causes = [cause for cause in causes_of(done, item) if cause.startswith("clearance to ")]
        assert causes
        assert all(cause.endswith(", no verdict") for cause in causes)
    assert not any("OK" in line or line.startswith("NG: clearance") for line in lines)
    assert lines[-1] == "verdict: NG"


def causes_of(done, item):
    """The causes of an array's verdict, as JSON has them."""
    return next(array["causes"] for array in document(done)["arrays"] if array["id"] == item.id)
