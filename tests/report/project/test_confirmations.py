"""A confirmation covers the inputs of its day: what changes after it is named, and only that."""

import datetime as dt

import pytest

from fixtures import assessments, project_parts
from fixtures.marks import by_day
from fixtures.project_parts import INCH
from fixtures.workbooks import SECTIONS as USUAL
from fixtures.workbooks import make, project, read_workbook
from report.project.check.covered import outdated, to_record
from report.project.model.choices import UnitsFirst
from report.project.model.input_rows import Place

pytestmark = pytest.mark.quick

ON = dt.date(2026, 2, 20)
RECORDS = ("M1 horizontal ab", "M2 horizontal cd")
RUN = {"surface": "wet", "number": 1, "mu": 0.46, "velocity_mps": 0.0254}
DRAWN = project_parts.clearance("A2", "RTU-1", 60 * INCH) | {"source": "drawing"}
ARRAYS = USUAL["arrays"]
GIVEN = {
    "project": project_parts.HEAD | {"drawing_confirmed_by": "RG", "drawing_confirmed_date": ON},
    "site": project_parts.SITE | {"hazard_source": "Hazard Tool", "hazard_date": ON},
    "friction_tests": assessments.TESTS,
    "friction_runs": [RUN],
    "clearances": [*USUAL["clearances"][:2], DRAWN],
    "options": assessments.REVIEW,
    "confirmation": assessments.CONFIRMED["confirmation"],
}


def given(**changes):
    return project(**GIVEN | changes)


def recorded(data, records=RECORDS):
    """The input as it is once `report` has filled the cells in."""
    blocks = {
        place.section: getattr(data, place.section).model_copy(update={place.field: text})
        for place, text in to_record(data, records).items()
    }
    return data.model_copy(update=blocks)


def changed(records=RECORDS, **changes):
    """What is outdated by a change after every confirmation is on record."""
    now = to_record(given(), RECORDS)
    blocks = {
        place.section: GIVEN[place.section] | {place.field: text} | changes.pop(place.section, {})
        for place, text in now.items()
    }
    return dict(outdated(given(**blocks, **changes), records).outdated)


def test_confirmations_are_put_on_record_where_they_cover_something():
    sheets = {
        place.field: (text[:10], [part.rpartition(" ")[0] for part in text[12:].split(", ")])
        for place, text in to_record(given(), RECORDS).items()
    }
    assert sheets == {
        "drawing_covered": (str(ON), ["Clearances"]),
        "hazard_covered": (str(ON), ["Site"]),
        "tests_covered": ("2025-06-12", ["Friction tests"]),
        "peer_covered": ("2026-03-01", ["Site", "Arrays", "Friction tests", "Motions", "Options"]),
        "covered": ("2026-03-01", ["Site", "Options"]),
    }
    assert to_record(recorded(given()), RECORDS) == {}
    assert outdated(recorded(given()), RECORDS).outdated == {}
    none = given(project=project_parts.HEAD, site=project_parts.SITE, friction_runs=[],
                 confirmation={},
                 options=assessments.REVIEW | {"peer_reviewed": False})  # fmt: skip
    assert to_record(none, RECORDS) == {}


def of(section, index, **changes):
    rows = [dict(row) for row in (USUAL | GIVEN)[section]]
    rows[index] |= changes
    return {section: rows}


CHANGES = [
    (of("arrays", 0, mu=0.42), {"options": "worksheet Arrays"}),
    ({"records": (RECORDS[0], "M2 horizontal ef")}, {"options": "worksheet Motions"}),
    (of("motions", 1, scale_value=2.1), {"options": "worksheet Motions"}),
    ({"site": {"s_ds_g": 1.6}}, {"site": "worksheet Site", "options": "worksheet Site"}),
    (of("friction_runs", 0, mu=0.47),
     {"friction_tests": "worksheet Friction tests", "options": "worksheet Friction tests"}),
    ({"friction_tests": {"report": "FT-2"}}, {"options": "worksheet Friction tests"}),
    (of("clearances", 2, provided_m=96 * INCH), {"project": "worksheet Clearances"}),
    (of("clearances", 0, source="drawing"), {"project": "worksheet Clearances"}),
    ({"target": {"t_l_s": 6.0}}, {"options": "worksheet Site"}),
    ({"target": {"to_s": 3.0}}, {"options": "worksheet Building"}),
    ({"links": [project_parts.links("A1", "0.40, 0.45", 50)]}, {"options": "worksheet Links"}),
    ({"overrides": []}, {"options": "worksheet Options", "confirmation": "worksheet Options"}),
    ({"confirmation": {"by": "MT"}}, {"confirmation": "worksheet Options"}),
    ({"site": {"rule_set": "ASCE 7-16"}},
     {"options": "worksheet Site", "confirmation": "worksheet Site"}),
    ({"site": {"building_code_year": 2019}}, {"confirmation": "worksheet Site"}),
    ({"site": {"roof_height_m": 9.0}} | of("arrays", 0, mu=0.42),
     {"options": "worksheets Site, Arrays"}),
]  # fmt: skip


@pytest.mark.parametrize(("change", "said"), CHANGES)
def test_an_input_that_changes_after_a_confirmation_is_named(change, said):
    assert changed(**change) == said


@pytest.mark.parametrize(
    "change",
    [
        {"project": {"checked_by": "MT", "revision": "1", "units_first": "SI"},
         "site": {"jurisdiction": "City of Los Angeles", "hazard_report": "GE-1"},
         "friction_tests": {"report_file": "report.pdf"},
         "options": {"plan_paper": "Letter", "peer_letter": "letter.pdf"}},
        of("arrays", 0, slack_m=1.2, interconnection_n=4000.0, x_to_m=ARRAYS[0]["x_to_m"] - 1.0),
        of("clearances", 0, provided_m=121 * INCH),  # which is not from the drawing
    ],
)  # fmt: skip
def test_what_no_confirmation_covers_changes_none(change):
    assert changed(**change) == {}


def test_the_order_of_rows_is_no_change_and_a_record_in_the_order_of_rows_holds():
    rows = {"friction_runs": [RUN, RUN | {"mu": 0.41}, RUN | {"mu": 0.44}]}
    on_record = recorded(given(**rows))
    whole = on_record.model_dump()
    turned = {key: whole[key][::-1] for key in ("arrays", "motions", "clearances", "friction_runs")}
    again = type(on_record).model_validate(whole | turned)
    assert outdated(again, RECORDS[::-1]).outdated == {}
    # As 0.3 put it on record: by the rows in their order.
    text = "2025-06-12: Friction tests d04a95"
    tests = assessments.TESTS | {"tests_covered": text}
    assert outdated(given(**rows, friction_tests=tests), RECORDS).outdated == {}
    other = outdated(given(friction_runs=rows["friction_runs"][:2], friction_tests=tests), RECORDS)
    assert other.outdated == {"friction_tests": "worksheet Friction tests"}


def test_another_date_is_a_new_confirmation():
    arrays = of("arrays", 0, mu=0.42)
    assert changed(**arrays, options={"peer_date": dt.date(2026, 3, 2)}) == {}
    on_record = recorded(given())
    options = on_record.options.model_copy(update={"peer_date": dt.date(2026, 3, 2)})
    again = given(options=dict(options), **arrays)
    (text,) = (v for k, v in to_record(again, RECORDS).items() if k.section == "options")
    assert text.startswith("2026-03-02: ")


@pytest.mark.parametrize("text", ["2026-03-01: ", "2026-03-01: none", "2026-03-01: Nowhere 3f, ,"])
def test_a_record_that_was_typed_over_covers_nothing(text):
    found = outdated(given(options=assessments.REVIEW | {"peer_covered": text}), RECORDS).outdated
    if text.endswith(": "):
        assert "options" not in found  # blank: the next report fills it in
    else:
        assert found["options"].startswith("worksheets Site, Arrays")


@pytest.mark.parametrize("units", by_day(UnitsFirst, 1))
def test_what_is_covered_does_not_depend_on_the_units_of_the_cells(tmp_path, units):
    options = assessments.REVIEW | {"peer_letter": ""}
    book = read_workbook(make(tmp_path, units=units, **GIVEN | {"options": options}))
    found = to_record(book.input, RECORDS)
    assert found == to_record(given(), RECORDS)
    assert all(place in book.sheet.addresses for place in found)
    assert Place("options", 0, "peer_covered") in found
