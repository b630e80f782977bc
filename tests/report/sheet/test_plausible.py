"""Warnings on values that are permitted and improbable, and how a workbook answers them."""

import datetime as dt
import math
from dataclasses import replace

import pytest

from inputs import FT, INCH, LB
from report.assessment.foresight import findings
from report.sheet.fields import Place
from report.sheet.findings import Level, lines, located, note, warning
from report.sheet.plausible import implausible
from sheets import at, make, project, read_workbook, row_changed


def warnings(data):
    return {finding.id: finding.text for finding in implausible(data)}


# The gap of A2 to RTU-1 is 5 ft, that of A1 to S 15 ft; A2 is above S, and N above A2.
def test_a_plausible_input_gives_no_warning():
    assert warnings(project()) == {}


CASES = [
    ("arrays", 0, {"weight_n": 30 * LB}, "weight A1",
     "weight is 30 lb (0.13 kN), 0.0 psf (0.00 kPa) on the plan area; 1.0 psf (0.05 kPa) to 30.0"
     " psf (1.44 kPa) is usual: correct the weight, its unit, or the plan"),
    ("arrays", 1, {"weight_n": 42e6 * LB}, "weight A2", "7777.8 psf"),
    ("arrays", 0, {"slope_value": 25.0, "mu": 0.46}, "friction A1",
     "friction coefficient is 0.46, not more than the tangent of the slope, 0.466: the array slides"
     " under its own weight; correct one of them"),
    ("site", None, {"roof_height_m": 37 * FT}, "height z",
     "height of the array z is 37.00 ft (11.28 m), above the structure height h of 36.00 ft (10.97"
     " m); correct one of them"),
    ("clearances", 1, {"direction": "up"}, "direction A1 to S up",
     "direction is 'up', but S lies 'down' from A1 in plan; correct the direction, the plan,"
     " or the downslope direction"),
    ("clearances", 4, {"direction": "down"}, "direction A2 to N down", "N lies 'up' from A2"),
    ("clearances", 0, {"direction": "down"}, "direction A1 to A2 down", "A2 lies 'across' from A1"),
    ("clearances", 0, {"provided_m": 10 * INCH}, "clearance A1 to A2 across",
     "provided clearance is 10.0 in (254 mm), but A1 and A2 are 120.0 in (3048 mm) apart in plan;"
     " correct it or the plan"),
]  # fmt: skip


@pytest.mark.parametrize(
    ("ratio", "words", "name"),
    [
        (12.0, "1/12 of the plan: in feet?", "clearances in feet"),
        (25.4, "1/25.4 of the plan: in inches?", "clearances in inches"),
        (1000.0, "1/1000 of the plan: in meters?", "clearances in meters"),
    ],
)
def test_clearances_in_one_wrong_unit_are_one_warning(ratio, words, name):
    given = project().model_dump()["clearances"]
    rows = [row | {"provided_m": row["provided_m"] / ratio} for row in given]
    found = list(implausible(project(clearances=rows)))
    in_plan = [f for f in found if f.place.field == "provided_m" and "OLD" not in f.id]
    (one,) = in_plan
    assert one.id == name
    assert one.text == (
        f"four clearances are {words} The first is A1 to A2 across; correct them or the plan"
    )


def test_two_clearances_in_feet_keep_their_own_warnings():
    given = project().model_dump()["clearances"]
    rows = [row | {"provided_m": row["provided_m"] / (12 if i < 2 else 1)}
            for i, row in enumerate(given)]  # fmt: skip
    found = warnings(project(clearances=rows))
    assert list(found) == ["clearance A1 to A2 across", "clearance A1 to S down"]


@pytest.mark.parametrize(("section", "index", "change", "name", "text"), CASES)
def test_an_improbable_value_gives_one_warning(section, index, change, name, text):
    found = warnings(row_changed(section, index, **change))
    assert list(found) == [name]
    assert text in found[name]


ISSUED, LATER = dt.date(2026, 3, 5), dt.date(2026, 3, 6)


@pytest.mark.parametrize(
    ("section", "field", "noun"),
    [
        ("options", "peer_date", "date of review"),
        ("friction_tests", "date", "date of the test report"),
        ("site", "hazard_date", "date of hazard"),
        ("options", "directional_date", "date for direction"),
    ],
)
def test_a_source_later_than_the_package_gives_a_warning(section, field, noun):
    assert warnings(row_changed(section, None, **{field: ISSUED})) == {}
    assert warnings(row_changed(section, None, **{field: LATER})) == {
        noun: f"{noun} is 2026-03-06, later than the package, 2026-03-05; correct one of them"
    }


def test_a_revision_without_its_row_gives_a_warning():
    assert warnings(row_changed("project", None, revision="C")) == {
        "revision C": "revision is 'C', which is not in the revision block; add its row, or"
        " correct it"
    }
    assert "revision 1" in warnings(project(revisions=()))


SITE = {"rule_set": "ASCE 7-16", "site_class": "C", "s_s_g": 1.5, "s_1_g": 0.6, "s_ds_g": None}


@pytest.mark.parametrize(
    ("change", "field", "text"),
    [
        (
            {"f_a": 0.9, "f_v": 1.4},
            "f_a",
            "F_a is 0.9, less than 1.2 in ASCE 7-16 Table 11.4-1 for site class C and S_S 1.5 g",
        ),
        (
            {"f_a": 1.2, "f_v": 1.39},
            "f_v",
            "F_v is 1.39, less than 1.4 in ASCE 7-16 Table 11.4-2 for site class C and S_1 0.6 g",
        ),
        (
            {"site_class": "D", "s_s_g": 0.6, "f_a": 1.2, "f_v": 1.7},
            "f_a",
            "F_a is 1.2, less than 1.32 in",
        ),
    ],
)
def test_a_site_coefficient_below_its_table_gives_a_note_with_a_site_specific_analysis(
    change, field, text
):
    """Without one it is an error."""
    (found,) = implausible(row_changed("site", None, **SITE | change))
    assert (found.level, found.place.field) == (Level.NOTE, field)
    assert text in found.text


def test_a_site_coefficient_above_its_table_gives_a_note():
    (found,) = implausible(row_changed("site", None, **SITE | {"f_a": 1.6, "f_v": 1.4}))
    assert (found.level, found.place.field) == (Level.NOTE, "f_a")
    assert "F_a is 1.6, more than 1.2 in ASCE 7-16 Table 11.4-1" in found.text


@pytest.mark.parametrize(
    "change",
    [
        {"f_a": 1.2, "f_v": 1.4},
        {"f_a": 1.195, "f_v": 1.395},
        {"site_class": "D", "s_s_g": 1.271, "s_1_g": 0.455, "f_a": 1.0, "f_v": 1.845},
        {"site_class": "D (default)", "f_a": 1.2, "f_v": 1.7},
        # Site-specific in the table, or no row of it.
        {"site_class": "E", "f_a": 0.8, "f_v": 0.8},
        {"site_class": "CD", "f_a": 0.8, "f_v": 0.8},
        {"site_class": None, "f_a": 0.8, "f_v": 0.8},
        {"rule_set": "ASCE 7-22", "f_a": 0.8, "f_v": 0.8, "s_ds_g": 1.0},
    ],
)
def test_a_site_coefficient_of_the_table_gives_none(change):
    assert list(implausible(row_changed("site", None, **SITE | change))) == []


def overridden(**values):
    """The usual input with other numbers of the rule set."""
    return project(
        overrides=[
            {"provision": key, "value": value, "reason": "agreed"} for key, value in values.items()
        ]
    )


def test_an_override_beyond_the_usual_range_gives_a_warning_of_its_key():
    found = warnings(overridden(separation_edge=4.01, prescriptive_factor_in=29.0))
    assert list(found) == ["override separation_edge", "override prescriptive_factor_in"]
    assert found["override separation_edge"] == (
        "value is 4.01 for the separation to an edge without qualifying parapet / design"
        " displacement; 0.75 to 4 is usual: correct the value or its unit"
    )
    assert "value is 29 for the " in found["override prescriptive_factor_in"]
    assert " 30 to 120 is usual" in found["override prescriptive_factor_in"]


def test_an_override_at_a_limit_of_the_usual_range_gives_none():
    for values in ((0.75, 30.0), (4.0, 120.0)):
        pairs = zip(("separation_edge", "prescriptive_factor_in"), values, strict=True)
        assert warnings(overridden(**dict(pairs))) == {}


def test_a_weight_in_the_usual_range_and_a_gap_within_tolerance_give_none():
    for psf in (1.01, 29.9):
        assert warnings(row_changed("arrays", 0, weight_n=psf * 4800 * LB)) == {}
    assert warnings(row_changed("clearances", 0, provided_m=119.1 * INCH)) == {}
    assert "clearance A1 to A2 across" in warnings(
        row_changed("clearances", 0, provided_m=119 * INCH)
    )


def test_an_object_at_a_corner_lies_in_both_directions():
    rows = [dict(row) for row in project().model_dump()["objects"]]
    # 10 ft to the right of A2 and 10 ft above it.
    rows[0] |= {"x_from_m": 210 * FT, "x_to_m": 215 * FT, "y_from_m": 85 * FT, "y_to_m": 90 * FT}
    for direction in ("up", "across"):
        gap = {"array": "A2", "object": "RTU-1", "direction": direction, "provided_m": 169 * INCH}
        assert warnings(project(objects=rows, clearances=[gap])) == {}
    gap["direction"] = "down"
    assert list(warnings(project(objects=rows, clearances=[gap]))) == ["direction A2 to RTU-1 down"]


def read(tmp_path, acknowledged=(), **changes):
    """A workbook as read, with its warnings."""
    book = read_workbook(make(tmp_path, acknowledged=list(acknowledged), **changes))
    return book.sheet, findings(book.sheet, book.shaking)


LIGHT = {"arrays": row_changed("arrays", 0, weight_n=30 * LB).model_dump()["arrays"]}


def test_a_warning_names_its_cell(tmp_path):
    sheet, (finding,) = read(tmp_path, **LIGHT)
    assert (finding.level, finding.id, finding.reason) == (Level.WARNING, "weight A1", "")
    (cell,) = located([finding], sheet.addresses)
    assert cell == at("Arrays/A1/Weight")


def test_equal_findings_are_one_line_with_a_count():
    places = [Place("clearances", index, "provided_m") for index in range(1500)]
    found = [warning(f"usual {i}", place, "provided is 4 in") for i, place in enumerate(places)]
    addresses = {place: f"cell {i}" for i, place in enumerate(places)}
    answered = replace(found[0], reason="Seen")
    equal, other = lines([*found[1:], answered], addresses)
    assert equal.cells == "cell 1, cell 2, cell 3 and 1,496 more"
    assert equal.names == "usual 1, usual 2, usual 3 and 1,496 more"
    assert (other.finding, other.cells, other.names) == (answered, "cell 0", "usual 0")
    (note_of_two,) = lines([note(place, "read") for place in places[:2]], addresses)
    assert (note_of_two.cells, note_of_two.names) == ("cell 0, cell 1", "")


def test_an_acknowledged_warning_carries_its_reason(tmp_path):
    row = {"warning": " Weight  a1", "reason": "Frames alone"}
    _, (finding,) = read(tmp_path, [row], **LIGHT)
    assert finding.reason == "Frames alone"


def test_an_acknowledgment_of_no_warning_is_a_note_at_its_cell(tmp_path):
    rows = [{"warning": "wieght A1", "reason": "Frames alone"}]
    sheet, found = read(tmp_path, rows, **LIGHT)
    assert [(f.level, f.reason) for f in found] == [(Level.WARNING, ""), (Level.NOTE, "")]
    assert found[1].text == "warning is 'wieght A1', which is not given; did you mean 'weight A1'?"
    assert list(located(found, sheet.addresses))[1] == at("Acknowledged/1/Warning")
    _, (idle,) = read(tmp_path / "other", rows)
    assert idle.text == "warning is 'wieght A1', which is not given; delete the row"


def records(tmp_path, *, steps, counts, dt_s=None):
    """A motion of two components with time columns, as read, with its findings."""
    motion = {"id": "M1", "record": "records/x.csv", "vertical": "records/z.csv", "units": "g"}
    path = make(tmp_path, motions=[motion])
    for name, step, count in zip("xz", steps, counts, strict=True):
        lines = (f"{i * step:.3f},{0.1 * (-1) ** i}\n" for i in range(count))
        (path.parent / "records" / f"{name}.csv").write_text("".join(lines))
    book = read_workbook(path)
    return {
        finding.id or finding.level: finding.text for finding in findings(*book.__dict__.values())
    }


def test_a_step_of_a_fifth_of_a_second_gives_a_warning(tmp_path):
    found = records(tmp_path, steps=(0.2, 0.2), counts=(100, 100))
    assert list(found) == ["step M1"]
    assert "time step of 0.2 s, and so no content above 2.5 Hz; 0.02 s or less" in found["step M1"]
    assert records(tmp_path / "b", steps=(0.02, 0.02), counts=(100, 100)) == {}


def test_a_record_of_six_minutes_gives_a_warning(tmp_path):
    found = records(tmp_path, steps=(0.02, 0.02), counts=(18001, 18001))
    assert list(found) == ["duration M1"]
    assert "lasts 360 s at a time step of 0.02 s; 300 s or less" in found["duration M1"]
    assert records(tmp_path / "b", steps=(0.02, 0.02), counts=(15001, 15001)) == {}


@pytest.mark.parametrize(
    ("indices", "which"),
    [((70,), "sample 71, at 0.7 s, is"), ((250, 70), "sample 71 and 1 more, at 0.7 s, reach")],
)
def test_a_sample_far_above_all_others_gives_a_warning_that_names_it(tmp_path, indices, which):
    path = make(tmp_path, motions=[{"id": "M1", "record": "records/x.csv", "dt_s": 0.01}])
    values = [0.3 * math.sin(0.2 * i) for i in range(300)]
    for index in indices:
        values[index] = -99.99
    lines = ["acc_g", *(f"{value:.5f}" for value in values), ""]
    (path.parent / "records" / "x.csv").write_text("\n".join(lines))
    book = read_workbook(path)
    found = {finding.id: finding.text for finding in findings(*book.__dict__.values())}
    assert found["spike M1 horizontal"] == (
        f"records/x.csv: {which} 99.99 g, and no other is more than 0.3 g; correct the file, or"
        " give another record"
    )


def test_a_few_samples_are_trimmed_with_a_note_and_many_with_a_warning(tmp_path):
    few = records(tmp_path, steps=(0.01, 0.01), counts=(200, 190))
    assert list(few) == ["note"]
    assert few["note"].endswith("last 10 of 200 samples trimmed, to the length of the shortest"
                                " component")  # fmt: skip
    many = records(tmp_path / "b", steps=(0.01, 0.01), counts=(200, 189))
    assert list(many) == ["length M1", "note"]
    assert "x.csv has 200 samples, and 11 of them are trimmed" in many["length M1"]
