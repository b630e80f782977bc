"""Warnings on values that are permitted and improbable, their answers, and equal lines."""

import datetime as dt
import json
import math
import pickle
from dataclasses import replace

import pytest
from click.testing import CliRunner

from fixtures.marks import by_day
from fixtures.project_parts import FT, INCH, LB, sides
from fixtures.spaces import spaced
from fixtures.workbooks import (
    arrays,
    cell_address,
    findings_of,
    make,
    project,
    row_changed,
    type_into,
    with_addresses,
)
from report.cli.main import main
from report.project.check.finding_lines import grouped, line_of, lines
from report.project.check.plausible import implausible, unusual
from report.project.model.choices import ObjectKind
from report.project.model.finding import Level, note, warning
from report.project.model.input_rows import Place
from report.project.read.read import read
from report.web.jobs import problems as shown_problems
from solver.errors import InputError, Problem


def warnings(data):
    return {finding.id: finding.text for finding in implausible(data)}


CASES = [
    ("arrays", 0, {"weight_n": 30 * LB}, "weight A1",
     "weight is 30 lb (0.13 kN), 0.0 psf (0.00 kPa) on the plan area; 1.0 psf (0.05 kPa) to 30.0"
     " psf (1.44 kPa) is typical: correct the weight, its unit, or the plan"),
    ("arrays", 0, {"slope_value": 25.0, "mu": 0.46}, "friction A1",
     "friction coefficient is 0.46, not more than the tangent of the slope, 0.466: the array slides"
     " under its own weight; correct one of them"),
    ("arrays", 0, {"slope_value": 0.02, "slope_unit": "percent"}, "slope A1",
     "slope is 0.02 percent; did you mean 2%? Correct it, or acknowledge it"),
    ("site", None, {"roof_height_m": 37 * FT}, "height z",
     "roof height z is 37.00 ft (11.28 m), above the structure height h of 36.00 ft (10.97"
     " m); correct one of them"),
    ("clearances", 1, {"direction": "upslope"}, "direction A1 to S upslope",
     "direction is 'upslope', but S is downslope of A1 on the plan; correct the direction, the"
     " plan, or the downslope direction"),
    ("clearances", 0, {"provided_m": 10 * INCH}, "clearance A1 to A2 cross-slope",
     "provided clearance is 10.0 in (254 mm), but A1 and A2 are 120.0 in (3048 mm) apart on the"
     " plan;"
     " correct the clearance or the plan"),
]  # fmt: skip


def clearances_divided(*ratios):
    """The usual input with its first clearances divided."""
    rows = project().model_dump()["clearances"]
    for row, ratio in zip(rows, ratios, strict=False):
        row["provided_m"] /= ratio
    return project(clearances=rows)


@pytest.mark.parametrize(
    ("ratio", "words"),
    [
        (12.0, "1/12 of the distances on the plan; are they in feet?"),
        (1000.0, "1/1000 of the distances on the plan; are they in meters?"),
    ],
)
def test_clearances_in_one_wrong_unit_are_one_warning(ratio, words):
    two = warnings(clearances_divided(ratio, ratio))
    assert list(two) == ["clearance A1 to A2 cross-slope", "clearance A1 to S downslope"]
    found = warnings(clearances_divided(*[ratio] * 5))
    (name,) = (name for name in found if name.startswith("clearance"))
    assert name == f"clearances {words.partition('are they ')[2].removesuffix('?')}"
    assert found[name] == (
        f"four clearances are {words} The first is A1 to A2 cross-slope; correct the clearances"
        " or the plan"
    )


@pytest.mark.parametrize(("section", "index", "change", "name", "text"), CASES)
def test_an_improbable_value_gives_one_warning(section, index, change, name, text):
    found = warnings(row_changed(section, index, **change))
    assert list(found) == [name]
    assert text in spaced(found[name])


@pytest.mark.parametrize(
    ("far_ft", "roof", "text"),
    [
        (2_000, {}, "OLD is 1800.00 ft (548.64 m) from A2; was it left over? Delete it"),
        (1_500, {}, ""),
        (700, sides(0, 300, 0, 121), "OLD is 400.00 ft (121.92 m) from the roof; was it l"),
        (590, sides(0, 300, 0, 121), ""),
    ],
)
def test_an_object_far_from_the_roof_or_else_from_the_largest_array_is_asked_about(
    far_ft, roof, text
):
    old = {"id": "OLD", "kind": "array of different construction"} | sides(
        far_ft, far_ft + 10, 20, 30
    )
    items = [old, *(row for row in project().model_dump()["objects"] if row["id"] != "OLD")]
    clearances = [row for row in project().model_dump()["clearances"] if row["object"] != "OLD"]
    found = warnings(project(objects=items, roof=roof, clearances=clearances))
    assert spaced(found.get("far OLD", "")).startswith(text)
    assert ("far OLD" in found) is bool(text)


@pytest.mark.parametrize(
    ("section", "field", "noun"),
    [("options", "peer_date", "date of review"), ("site", "hazard_date", "date of hazard"),
     ("friction_tests", "date", "date of the test report")],
)  # fmt: skip
def test_a_source_later_than_the_package_gives_a_warning(section, field, noun):
    assert warnings(row_changed(section, None, **{field: dt.date(2026, 3, 5)})) == {}
    assert warnings(row_changed(section, None, **{field: dt.date(2026, 3, 6)})) == {
        noun: f"{noun} is 2026-03-06, later than the package, 2026-03-05; correct one of them"
    }


def test_revisions_without_a_row_and_overrides_beyond_their_range_give_warnings():
    assert warnings(row_changed("project", None, revision="C")) == {
        "revision C": "revision is 'C', which is not in the revision block; add its row, or"
        " correct it"
    }
    assert "revision 1" in warnings(project(revisions=()))
    found = warnings(overridden(4.01, 29.0))
    assert list(found) == ["override separation_edge", "override prescriptive_factor_in"]
    assert found["override separation_edge"] == (
        "value is 4.01 for the separation factor, edge without qualifying parapet; 0.75 to 4 is"
        " typical: correct the value or its unit"
    )
    assert "value is 29 for the " in found["override prescriptive_factor_in"]
    assert " 30 to 120 is typical" in found["override prescriptive_factor_in"]
    assert warnings(overridden(0.75, 30.0)) == warnings(overridden(4.0, 120.0)) == {}


SITE = {"rule_set": "ASCE 7-16", "site_class": "C", "s_s_g": 1.5, "s_1_g": 0.6, "s_ds_g": None}


@pytest.mark.parametrize(
    ("change", "field", "text"),
    [
        ({"f_a": 0.9, "f_v": 1.4}, "f_a",
         "F_a is 0.9, less than 1.2 in ASCE 7-16 Table 11.4-1 for site class C and S_S 1.5 g"),
        ({"f_a": 1.2, "f_v": 1.39}, "f_v",
         "F_v is 1.39, less than 1.4 in ASCE 7-16 Table 11.4-2 for site class C and S_1 0.6 g"),
        ({"f_a": 1.6, "f_v": 1.4}, "f_a", "F_a is 1.6, more than 1.2 in ASCE 7-16 Table 11.4-1"),
    ],
)  # fmt: skip
@pytest.mark.quick
def test_a_site_coefficient_that_differs_from_its_table_gives_a_note(change, field, text):
    """One below it is an error without a site-specific analysis."""
    (found,) = implausible(row_changed("site", None, **SITE | change))
    assert (found.level, found.place.field) == (Level.NOTE, field)
    assert text in spaced(found.text)


@pytest.mark.parametrize(
    "change",
    [
        {"f_a": 1.195, "f_v": 1.395},
        {"site_class": "D", "s_s_g": 1.271, "s_1_g": 0.455, "f_a": 1.0, "f_v": 1.845},
        # Site-specific in the table, or no row of it.
        *({"site_class": name, "f_a": 0.8, "f_v": 0.8} for name in ("E", "CD")),
    ],
)
def test_a_site_coefficient_of_the_table_gives_none(change):
    assert list(implausible(row_changed("site", None, **SITE | change))) == []


def overridden(edge, factor_in):
    """The usual input with other numbers of the rule set."""
    values = {"separation_edge": edge, "prescriptive_factor_in": factor_in}
    rows = [{"provision": key, "value": value, "reason": "agreed"} for key, value in values.items()]
    return project(overrides=rows)


def test_an_object_at_a_corner_lies_in_both_directions():
    rows = [dict(row) for row in project().model_dump()["objects"]]
    # 10 ft to the right of A2 and 10 ft above it.
    rows[0] |= {"x_from_m": 210 * FT, "x_to_m": 215 * FT, "y_from_m": 85 * FT, "y_to_m": 90 * FT}
    for direction in ("upslope", "cross-slope"):
        gap = {"array": "A2", "object": "RTU-1", "direction": direction, "provided_m": 169 * INCH}
        assert warnings(project(objects=rows, clearances=[gap])) == {}
    gap["direction"] = "downslope"
    assert list(warnings(project(objects=rows, clearances=[gap]))) == [
        "direction A2 to RTU-1 downslope"
    ]


@pytest.mark.quick
def test_equal_findings_are_one_line_with_a_count():
    places = [Place("clearances", index, "provided_m") for index in range(1500)]
    found = [warning(f"usual {i}", place, "provided is 4 in") for i, place in enumerate(places)]
    addresses = {place: f"cell {i}" for i, place in enumerate(places)}
    answered = replace(found[0], reason="Seen")
    equal, other = lines([*found[1:], answered], addresses)
    assert equal.cell == "cell 1, cell 2, cell 3 and 1,496 more"
    assert equal.id == "usual 1, usual 2, usual 3 and 1,496 more"
    assert other == replace(answered, cell="cell 0")
    (note_of_two,) = lines([note(place, "read") for place in places[:2]], addresses)
    assert (note_of_two.cell, note_of_two.id) == ("cell 0, cell 1", "")


@pytest.mark.nightly
def test_an_acknowledgment_of_no_warning_is_a_note_at_its_cell(tmp_path):
    rows = [{"warning": "wieght A1", "reason": "Frames alone"}]
    cell, text = (
        cell_address("Acknowledged/1/Warning"),
        "warning is 'wieght A1', which is not among the warnings;",
    )
    _, found = findings_of(make(tmp_path, acknowledged=rows, arrays=arrays(weight_n=30 * LB)))
    assert found == ("", cell, f"{text} did you mean 'weight A1'?")
    assert findings_of(make(tmp_path, acknowledged=rows)) == [("", cell, f"{text} delete the row")]


def of_records(path, **changes):
    """What is said of a motion by name, once samples are given to its records, some with times."""
    for name, samples in changes.items():
        (path.parent / "records" / f"{name}.csv").write_text("\n".join([*samples, ""]))
    return {name or "note": text for name, _, text in findings_of(path)}


@pytest.mark.parametrize(
    ("step", "counts", "names", "words"),
    by_day([
        (0.2, (100, 100), ["step M1"],
         "time step of 0.2 s, and so no content above 2.5 Hz; 0.02 s or less"),
        (0.02, (18001, 18001), ["duration M1"],
         "lasts 360 s at a time step of 0.02 s; 300 s or less"),
        (0.02, (15001, 15001), [], ""),
        (0.01, (200, 190), ["note"],
         "last 10 of 200 samples trimmed to the length of the shortest component"),
        (0.01, (200, 189), ["length M1", "note"],
         "x.csv has 200 samples, and 11 of them are trimmed"),
    ], 3),
)  # fmt: skip
def test_a_coarse_or_long_record_or_one_that_is_cut_gives_a_warning(
    tmp_path, step, counts, names, words
):
    motion = {"id": "M1", "record": "records/x.csv", "vertical": "records/z.csv", "units": "g"}
    x, z = ([f"{i * step:.3f},{0.1 * (-1) ** i}" for i in range(count)] for count in counts)
    found = of_records(make(tmp_path, motions=[motion]), x=x, z=z)
    assert list(found) == names
    assert words in spaced("".join(found.values()))


@pytest.mark.parametrize(
    ("unit", "values", "text"),
    [
        ("g", 0.9, ""),
        ("g", 0.02, ""),
        (
            "cm/s2",
            0.1,
            "peak 0.000102 g as run, 1/981 times the other motions: is the record in g?",
        ),
        ("g", 9.81, "peak 9.81 g as run, 327 times the other motions: is the record in cm/s2?"),
    ],
)
def test_a_motion_in_another_unit_than_the_others_gives_a_warning(tmp_path, unit, values, text):
    peaks = {"a": 0.03 if values > 5.0 else 0.1, "b": 0.03 if values > 5.0 else 0.1, "x": values}
    units = {"a": "g", "b": "g", "x": unit}
    motions = [
        {"id": name, "record": f"records/{name}.csv", "units": units[name], "dt_s": 0.01}
        for name in peaks
    ]
    # One is no multiple of another, which would be the same motion again.
    shapes = {"a": 0.2, "b": 0.3, "x": 0.5}
    records = {
        name: [f"{peaks[name] * math.sin(shapes[name] * i):.7f}" for i in range(300)]
        for name in peaks
    }
    found = of_records(make(tmp_path, motions=motions), **records)
    assert spaced(found.get("peak x", "")).startswith(text)
    assert ("peak x" in found) is bool(text)
    assert not {"peak a", "peak b"} & found.keys()


@pytest.mark.parametrize(
    ("indices", "which"),
    by_day(
        [((70,), "sample 71, at 0.7 s, is"), ((250, 70), "sample 71 and 1 more, at 0.7 s, reach")],
        1,
    ),
)
def test_a_sample_far_above_all_others_gives_a_warning_that_names_it(tmp_path, indices, which):
    path = make(tmp_path, motions=[{"id": "M1", "record": "records/x.csv", "dt_s": 0.01}])
    values = [-9.31 if i in indices else 0.3 * math.sin(0.2 * i) for i in range(300)]
    found = of_records(path, x=["acc_g", *(f"{value:.5f}" for value in values)])
    assert spaced(found["spike M1 horizontal"]) == (
        f"records/x.csv: {which} 9.31 g, and no other is more than 0.3 g; correct the file, or"
        " use another record"
    )


@pytest.mark.parametrize(
    ("section", "index", "change", "name", "text"),
    [
        ("arrays", 0, {"cg_height_m": 0.75 * INCH}, "usual CG height A1",
         "CG height is 0.75 in; 4 to 36 in is typical: correct the value or its unit"),
        ("arrays", 1, {"mu": 0.2}, "usual friction coefficient A2",
         "friction coefficient is 0.2; 0.3 to 0.8 is typical: correct the value or its unit"),
        ("clearances", 0, {"provided_m": 5 * INCH}, "usual provided clearance A1 to A2 cross-slope",
         "provided clearance is 5 in; 6 to 600 in is typical"),
        ("motions", 2, {"scale_value": 14.0}, "usual factor or PPA M3",
         "factor or PPA is 14; 0.2 to 5 is typical"),
        ("site", None, {"s_1_g": 0.02}, "usual S_1", "S_1 is 0.02 g; 0.03 to 1.5 g is typical"),
    ],
)  # fmt: skip
def test_a_number_outside_its_usual_range_gives_a_warning(section, index, change, name, text):
    (finding,) = unusual(row_changed(section, index, **change))
    assert finding.id == name
    assert finding.place == Place(section, index or 0, next(iter(change)))
    assert text in spaced(finding.text)


def test_ranges_are_in_the_units_that_come_first_and_include_their_limits():
    metric = project().project.model_dump() | {"units_first": "SI"}
    (finding,) = unusual(project(project=metric, arrays=arrays(cg_height_m=0.05)))
    assert spaced(finding.text).startswith("CG height is 50 mm; 101.6 to 914.4 mm is typical")
    for inches in (4, 36):
        assert list(unusual(row_changed("arrays", 0, cg_height_m=inches * INCH))) == []
    for kind, count in ((ObjectKind.EDGE_WITHOUT_PARAPET, 0), (ObjectKind.EDGE_WITH_PARAPET, 1)):
        data = row_changed("objects", 0, kind=kind, height_m=0.0)
        assert len(list(unusual(data))) == count


IS_WET, NUMBER = "friction coefficient is 'wet'", "enter a number from 0 to 1.5"
WRONG = f"{IS_WET}; {NUMBER}"
OTHER = "weight is 0; enter a number greater than 0 [lb]"


@pytest.mark.quick
def test_equal_errors_are_one_line_and_others_stay_apart():
    (equal,) = grouped(Problem(IS_WET, NUMBER, f"Arrays!E{row}") for row in range(8, 1508))
    assert line_of(equal) == f"Arrays!E8, Arrays!E9, Arrays!E10 and 1,497 more: {WRONG}"
    assert equal[-1].where == "Arrays!E1507"
    first, second, elsewhere = (
        Problem(IS_WET, NUMBER, cell) for cell in ("Arrays!E8", "Arrays!E9", "Objects!E8")
    )
    no_file, weight = Problem("no such file"), Problem.of(OTHER).at("Arrays!H8")
    lines = [*map(line_of, grouped([no_file, first, weight, second, elsewhere, no_file]))]
    apart = list(map(str, (no_file, weight, elsewhere, no_file)))
    assert lines == [apart[0], f"Arrays!E8, Arrays!E9: {WRONG}", *apart[1:]]


MU = "Arrays/{}/Friction coefficient"
WET = {MU.format("A1"): "wet", MU.format("A2"): "wet"}


def test_check_prints_one_line_and_counts_all(tmp_path):
    path = type_into(make(tmp_path), WET | {"Arrays/A1/Weight": 0})
    done = CliRunner().invoke(main, ["check", str(path)])
    assert done.exit_code == 2
    # After a second, a slow machine says what it does.
    head, *lines = (line for line in done.stderr.splitlines() if not line.startswith("["))
    assert head == f"{path}: 3 errors:"
    assert lines == [
        f"  {', '.join(with_addresses(*WET))}: {WRONG}",
        cell_address(f"  <Arrays/A1/Weight>: {OTHER}"),
    ]
    data = json.loads(CliRunner().invoke(main, ["check", str(path), "--json"]).stdout)
    assert len(data["errors"]) == 3


def refused(path):
    """The error of a workbook."""
    with pytest.raises(InputError) as caught:
        _ = read(path).project
    return caught.value


def test_typed_semicolons_and_problems_without_a_cell_are_shown_on_the_page(tmp_path):
    path = type_into(make(tmp_path), {MU.format("A1"): "wet; dry"})
    (found,) = shown_problems(path, refused(path))
    assert (found["found"], found["remedy"]) == ("friction coefficient is 'wet; dry'", NUMBER)
    error = InputError(
        [Problem("one row is entered", "enter two", "Spectrum"), "no file; enter one"]
    )
    found = shown_problems(tmp_path / "none.xlsx", error)
    shown = [(each["found"], each["remedy"]) for each in found]
    assert shown == [("Spectrum: one row is entered", "enter two"), ("no file", "enter one")]
    assert error.problems == ("Spectrum: one row is entered; enter two", "no file; enter one")
    assert pickle.loads(pickle.dumps(error)).parts == error.parts
