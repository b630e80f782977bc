"""Models of the input, what cells of a site give and contradict, other inputs in Python."""

import math

import pytest
from click.testing import CliRunner
from pydantic import TypeAdapter, ValidationError

from fixtures import project_parts
from fixtures.marks import by_day
from fixtures.project_parts import SITE
from fixtures.spaces import spaced
from fixtures.workbooks import (
    cell_address,
    make,
    problems,
    project,
    row_cells,
    same,
    type_into,
    with_addresses,
)
from report.cli.main import main
from report.project.check.site_faults import site_faults
from report.project.model import ProjectInput
from report.project.model.array import slope_rad
from report.project.model.choices import RuleSetName, SiteClass, SlopeUnit
from report.project.model.input_rows import Place
from report.project.model.site_input import Site
from report.project.read.read import read
from report.project.read.what_if import retyped
from report.project.workbook import SECTIONS
from report.study.workbook import STUDY_SECTIONS
from solver.errors import DefectError, InputError
from solver.rules.hazard import HazardBasis

BARE_SITE = project_parts.SITE | {"rule_set": "ASCE 7-16", "s_1_g": None, "site_class": None}
BARE_SITE.pop("s_ds_g")


@pytest.mark.quick
def test_sections_are_parts_of_the_input_with_labels_and_choices_of_their_own():
    def fields(model):
        return [name for name, field in model.model_fields.items() if not field.exclude]

    assert [section.key for section in SECTIONS] == fields(ProjectInput)
    for section in SECTIONS:
        assert [item.name for item in section.entries] == fields(section.model)
        labels = [item.heading.casefold() for item in section.entries]
        assert len(labels) == len(set(labels))
        assert not any(set("[]*!") & set(label) for label in labels)
        choices = [choice for item in section.entries for choice in item.choices]
        assert not any("," in choice for choice in choices)


def _at_the_ends(entry):
    """Values of a field at and beside the ends of what it accepts."""
    if entry.kind in (int, float):
        ends = {0.0, entry.bounds.low, entry.bounds.high} - {math.inf, -math.inf}
        values = [end + step for end in ends for step in (-1.0, -1e-9, 0.0, 1e-9, 1.0)]
        return [int(value) for value in values] if entry.kind is int else values
    return ["", "x", "x" * entry.max_length, "x" * (entry.max_length + 1)]


@pytest.mark.quick
def test_a_cell_accepts_what_the_model_does():
    for section in (*SECTIONS, *STUDY_SECTIONS):
        for entry in section.entries:
            if entry.kind not in (int, float, str):
                continue
            info = section.model.model_fields[entry.name]
            model = TypeAdapter(info.rebuild_annotation())
            for value in _at_the_ends(entry):
                try:
                    model.validate_python(value)
                    accepts = True
                except ValidationError:
                    accepts = False
                assert entry.accepts(value) == accepts, (section.key, entry.name, value)


def test_slopes_become_angles_and_s_ds_is_unrounded():
    for value, unit, degrees in (
        (3.0, SlopeUnit.DEGREES, 3.0), (5.0, SlopeUnit.PERCENT, 2.8624052261117479),
        (0.25, SlopeUnit.IN_PER_12, 1.1934894239820351), (0.0, SlopeUnit.PERCENT, 0.0),
    ):  # fmt: skip
        assert math.degrees(slope_rad(value, unit)) == pytest.approx(degrees, rel=1e-12)
    assert Site(**BARE_SITE, s_s_g=1.313, f_a=1.2).s_ds == pytest.approx(1.0504, abs=1e-12)
    assert Site(**BARE_SITE, s_s_g=1.313, f_a=1.2, s_ds_g=1.05).s_ds == 1.05
    with pytest.raises(DefectError, match="S_DS cannot be derived"):
        assert Site(**BARE_SITE, s_s_g=1.313).s_ds


def test_models_are_frozen_with_rectangles_of_arrays_and_objects():
    site = Site(**BARE_SITE, s_ds_g=1.0)
    with pytest.raises(ValidationError):
        site.i_e = 1.5
    for wrong in ({"s_ds_g": 1.0, "color": "red"}, {"s_ds_g": math.nan}):
        with pytest.raises(ValidationError):
            Site(**BARE_SITE, **wrong)
    data = project()
    with pytest.raises(ValidationError):
        data.arrays[0].outline_m = ((0.0, 0.0), (1.0, 0.0), (1.0, 1.0))
    assert data.arrays[0].shape.x_to_m == pytest.approx(30.48)
    assert data.objects[1].placed is None
    assert data.objects[0].placed.y_from_m == pytest.approx(24.384)
    assert data.site.rule_set is RuleSetName.PV1


CONSISTENT = SITE | {
    "s_ds_g": None, "s_s_g": 1.271, "s_1_g": 0.455, "site_class": "C", "f_a": 1.2, "f_v": 1.5,
}  # fmt: skip


# Class D: F_a 1.0 and F_v 1.7, so S_MS 2.0, S_DS 1.333, S_M1 1.02, S_D1 0.68.
UNSOURCED = {"s_s_g": 2.0, "s_1_g": 0.6, "site_class": SiteClass.D, "f_a": None, "f_v": None}


def faults(**changes):
    row = Site.model_construct(**Site.model_validate(CONSISTENT).model_dump() | changes)
    inputs = {"site": [dict(row)]}
    found = site_faults(inputs, lambda place: place.field)
    return [(fault.place.field, fault.problem("").text) for fault in found]


@pytest.mark.parametrize(
    ("changes", "field", "text"),
    [
        ({"s_ms_g": 1.6}, "s_ms_g", "S_MS is 1.6 g, but F_a S_S is 1.5252 g; leave one of them"),
        ({"s_d1_g": 0.5}, "s_d1_g", "S_D1 is 0.5 g, but 2/3 F_v S_1 is 0.4550 g"),
        ({"s_s_g": 0.3, "f_a": 1.3, "sdc": "C"}, "sdc",
         "S_D1 = 0.455 g in risk category II requires D or higher (ASCE 7 Table 11.6-2)"),
        ({"s_1_g": 0.8}, "sdc",
         "seismic design category is 'D'; S_1 = 0.8 g in risk category II requires E or higher"
         " (ASCE 7 Section 11.6)"),
        ({"site_class": SiteClass.D_DEFAULT, "s_s_g": 1.2, "f_a": 1.1, "f_v": 1.9}, "f_a",
         "F_a is 1.1; enter at least 1.2 for site class 'D (default)' and S_S of 1.2 g in s_s_g"
         " (ASCE 7-16 Table 11.4-1†)"),
        ({"rule_set": "ASCE 7-22", "edition_name": "ASCE 7-16"}, "edition_name",
         "edition of ASCE 7 is 'ASCE 7-16', but the rule set is 'ASCE 7-22'"),
        ({"edition_name": "ASCE 7-22", "f_v": None, "s_ds_g": 1.0}, "f_a",
         "F_a is 1.2, but ASCE 7-22 has no site coefficients; leave it blank and enter S_MS"),
        ({"edition_name": "ASCE 7-22", "f_a": None, "f_v": None}, "s_ds_g",
         "S_DS is missing; enter S_DS or S_MS"),
        (UNSOURCED | {"s_ds_g": 1.0, "site_class": None}, "s_ds_g",
         "for site class 'D (default)', assumed because none is entered ("),
        (UNSOURCED | {"s_ds_g": 1.0, "site_class": SiteClass.CD}, "site_class",
         "site class is 'CD', which ASCE 7-16 does not have; enter one of A, B, "),
    ],
)  # fmt: skip
@pytest.mark.quick
def test_an_inconsistency_is_named_at_its_cell(changes, field, text):
    ((place, said),) = faults(**changes)
    assert place == field
    assert text in spaced(said)


@pytest.mark.parametrize(
    ("changes", "fields"),
    [
        ({"s_ms_g": 1.5, "s_ds_g": 1.0}, ["s_ms_g", "s_ds_g"]),
        ({"s_ds_g": 1.0, "s_d1_g": 0.6}, ["s_ds_g", "s_d1_g"]),
        ({"s_ds_g": 1.34, "s_m1_g": 0.9}, ["s_m1_g"]),
        ({"s_ds_g": 1.33}, []), ({"s_ds_g": 1.328}, ["s_ds_g"]),
        ({"f_a": 0.9, "s_ds_g": 1.2}, ["f_a"]), ({"f_a": 1.0, "f_v": 1.5}, ["f_v"]),
        ({"site_class": SiteClass.D_DEFAULT, "s_ds_g": 1.334}, ["s_ds_g"]),
        ({"site_class": SiteClass.D_DEFAULT, "s_ds_g": 1.6}, []),
        # No value in the table: a site-specific analysis is required, which is a requirement row.
        ({"site_class": SiteClass.E, "s_ds_g": 0.8}, []),
        ({"site_class": SiteClass.E, "s_s_g": 0.75, "s_ds_g": 0.6}, ["s_ds_g"]),
        ({"hazard": HazardBasis.EXCEPTION, "s_ds_g": 1.0}, ["s_ds_g"]),
        ({"hazard": HazardBasis.SITE_SPECIFIC, "s_ds_g": 1.0}, []),
        ({"edition_name": "ASCE 7-22", "s_ms_g": 2.0, "s_ds_g": 1.0}, ["s_ds_g"]),
    ],
)  # fmt: skip
@pytest.mark.quick
def test_a_value_below_the_table_of_its_edition_is_an_error_at_its_cell(changes, fields):
    assert [field for field, _ in faults(**UNSOURCED | changes)] == fields


def test_a_consistent_site_and_what_the_hazard_tool_gives_for_edition_22_have_no_faults():
    assert faults() == []
    given = {"f_a": None, "f_v": None, "s_ms_g": 1.6, "s_m1_g": 0.9, "s_ds_g": 1.067}
    assert faults(rule_set="ASCE 7-22", **given) == []


GIVEN = {
    "Rule set": "ASCE 7-16", "Risk category": "III", "Importance factor I_e": None, "S_S": 0.75,
    "S_1": 0.30, "Site class": "D", "F_a": None, "F_v": 2.0, "S_DS": None,
    "Seismic design category": None, "S_MS": None, "S_M1": None, "S_D1": None,
    "Basis of seismic parameters": None,
}  # fmt: skip
"""ASCE 7-16 Table 11.4-1: F_a is 1.2, so S_DS is 2/3 x 1.2 x 0.75 g = 0.6 g, and S_D1 0.4 g: D."""
NAMES = ("Importance factor I_e", "F_a", "Seismic design category")


def made(folder, **changes):
    return type_into(make(folder), row_cells("Site", GIVEN | changes))


@pytest.mark.quick
def test_what_is_blank_is_computed_and_the_echo_says_so(tmp_path):
    sheet = read(made(tmp_path))
    site = sheet.project.site
    assert (site.i_e, site.f_a, site.sdc) == (1.25, 1.2, "D")
    assert site.s_ds == pytest.approx(0.6, rel=1e-12)
    echo = {row.label: row.value for row in sheet.echo if row.sheet == "Site"}
    assert [echo[name] for name in NAMES] == [
        "1.25 (computed, ASCE 7 Table 1.5-2†)",
        "1.2 (computed, ASCE 7-16 Table 11.4-1†)",
        "D (computed, ASCE 7 Section 11.6†)",
    ]
    places = [row.address for row in sheet.echo if row.sheet == "Site"]
    assert places == sorted(places, key=lambda place: int(place.partition("!B")[2]))


def test_what_is_computed_is_said_unless_it_is_given(tmp_path):
    done = CliRunner().invoke(main, ["check", str(made(tmp_path))])
    for name, value in zip(NAMES, ("I_e is 1.25", "F_a is 1.2", "category is D"), strict=True):
        begin = f"note: {cell_address('Site/' + name)}"
        (line,) = (line for line in done.output.splitlines() if line.startswith(begin))
        assert f"{value} (computed, ASCE 7" in line
    typed = {"F_a": 1.3, "Importance factor I_e": 1.5, "Seismic design category": "E"}
    site = read(made(tmp_path, **typed)).project.site
    assert (site.i_e, site.f_a, site.sdc) == (1.5, 1.3, "E")
    for name in ("S_DS", "S_MS"):
        site = read(made(tmp_path / name, **{name: 1.0})).project.site
        assert site.f_a is None


NO_F_A = "Site/F_a is missing; enter S_DS, S_MS, or both S_S and F_a"
NO_SDC = "Site/Seismic design category is missing; choose A, B, C, D, E or F, or enter"


@pytest.mark.parametrize(
    ("changes", "line"),
    by_day(
        [
            ({"S_1": None, "S_D1": 0.4}, f"{NO_SDC} S_1"),
            ({"F_v": None, "S_S": 0.3}, f"{NO_SDC} S_D1"),
            ({"S_1": None, "F_v": None}, f"{NO_SDC} S_1"),
            ({"S_1": None, "F_v": None, "S_S": 0.3}, f"{NO_SDC} S_1 and S_D1"),
            ({"Site class": "E", "S_S": 1.2}, NO_F_A),
            ({"Basis of seismic parameters": "site-specific analysis"}, NO_F_A),
            ({"Risk category": None}, "Site/Risk category is missing; choose I, II, III or IV"),
        ],
        2,
    ),
)
def test_what_does_not_follow_is_asked_for(tmp_path, changes, line):
    assert problems(made(tmp_path, **changes)) == with_addresses(line)


@pytest.mark.parametrize(
    ("changes", "sdc"),
    [
        ({"F_v": None}, "D"),
        ({"F_v": None, "S_1": 0.7499}, "D"),
        ({"F_v": None, "S_1": 0.75}, "E"),
        ({"F_v": None, "S_1": 0.8, "S_S": 0.1, "Risk category": "IV"}, "F"),
    ],
)
def test_a_category_that_s_d1_cannot_change_is_computed_without_it(tmp_path, changes, sdc):
    site = read(made(tmp_path, **changes)).project.site
    assert (site.sdc, site.s_d1, site.sdc_text) == (sdc, None, sdc)


def test_what_is_computed_follows_other_values_that_are_tried(tmp_path):
    sheet = read(made(tmp_path))
    tried = retyped(sheet, {Place("site", 0, "s_s_g"): 0.5, Place("site", 0, "risk_category"): "I"})
    site = tried.project.site
    assert (site.i_e, site.f_a, site.sdc) == (1.0, 1.4, "D")
    assert site.s_ds == pytest.approx(2 / 3 * 1.4 * 0.5, rel=1e-12)
    given = retyped(sheet, {Place("site", 0, "f_a"): 1.3}).project.site
    assert (given.f_a, given.i_e) == (1.3, 1.25)


@pytest.mark.quick
def test_other_inputs_are_those_of_a_workbook_that_has_them(tmp_path):
    sheet = read(make(tmp_path))
    first, *others = sheet.project.arrays
    arrays = [first.model_copy(update={"mu": 0.4, "cg_height_m": 0.254}), *others]
    varied = sheet.with_(arrays=arrays, site=sheet.project.site)
    typed = type_into(
        sheet.path, {"Arrays/A1/Friction coefficient": 0.4, "Arrays/A1/CG height": 10.0}
    )
    assert same(varied.project, read(typed).project)
    assert sheet.project.arrays[0] == first


@pytest.mark.parametrize(
    ("changes", "said"),
    by_day([({"mu": -0.4}, "arrays: mu: Input should be greater than or equal to 0"),
     ({"slope_value": 60.0}, "slope is 60"), ({"id": "A9"}, "which is not in Arrays")], 1),
)  # fmt: skip
def test_what_a_workbook_may_not_have_is_refused(tmp_path, changes, said):
    sheet = read(make(tmp_path))
    first, *others = sheet.project.arrays
    with pytest.raises(InputError, match=said):
        sheet.with_(arrays=[first.model_copy(update=changes), *others])


def test_inputs_that_are_not_there_or_at_fault_are_refused(tmp_path):
    with pytest.raises(InputError, match="unknown input array; choose from project"):
        read(make(tmp_path)).with_(array=[])
    sheet = read(type_into(make(tmp_path), {"Arrays/A1/Weight": "heavy"}))
    with pytest.raises(InputError, match="weight is 'heavy'"):
        sheet.with_(arrays=[])
