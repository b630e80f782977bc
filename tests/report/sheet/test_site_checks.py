"""The seismic parameters of a site against each other, the edition and the design category."""

import pytest

from inputs import SITE
from report.sheet.checking.checks import site_faults
from report.sheet.schema.choices import SiteClass
from report.sheet.schema.project import Site
from solver.rules.hazard import HazardBasis

pytestmark = pytest.mark.quick

GIVEN = SITE | {
    "s_ds_g": None, "s_s_g": 1.271, "s_1_g": 0.455, "site_class": "C", "f_a": 1.2, "f_v": 1.5,
}  # fmt: skip


# Class D: F_a 1.0 and F_v 1.7, so S_MS 2.0, S_DS 1.333, S_M1 1.02, S_D1 0.68.
UNSOURCED = {"s_s_g": 2.0, "s_1_g": 0.6, "site_class": SiteClass.D, "f_a": None, "f_v": None}


def faults(**changes):
    row = Site.model_construct(**Site.model_validate(GIVEN).model_dump() | changes)
    draft = {"site": [dict(row)]}
    found = site_faults(draft, lambda place: place.field)
    return [(fault.place.field, fault.problem("").text) for fault in found]


@pytest.mark.parametrize(
    ("changes", "field", "text"),
    [
        ({"s_ms_g": 1.6}, "s_ms_g", "S_MS is 1.6 g, but F_a S_S is 1.5252 g; leave one of them"),
        ({"s_s_g": None, "f_a": None, "s_ms_g": 1.5, "s_ds_g": 1.1}, "s_ds_g",
         "S_DS is 1.1 g, but 2/3 S_MS is 1.0000 g"),
        ({"s_d1_g": 0.5}, "s_d1_g", "S_D1 is 0.5 g, but 2/3 F_v S_1 is 0.4550 g"),
        ({"s_s_g": 0.3, "f_a": 1.3, "sdc": "C"}, "sdc",
         "S_D1 = 0.455 g in risk category II requires D or higher (ASCE 7 Table 11.6-2)"),
        ({"s_1_g": 0.8}, "sdc",
         "seismic design category is 'D'; S_1 = 0.8 g in risk category II requires E or higher"
         " (ASCE 7 section 11.6)"),
        ({"site_class": SiteClass.D_DEFAULT, "s_s_g": 1.2, "f_a": 1.1, "f_v": 1.9}, "f_a",
         "F_a is 1.1; give at least 1.2 for site class 'D (default)' and S_S of 1.2 g in s_s_g"
         " (ASCE 7-16 Table 11.4-1†)"),
        ({"rule_set": "ASCE 7-22", "edition_name": "ASCE 7-16"}, "edition_name",
         "edition of ASCE 7 is 'ASCE 7-16', but the rule set is 'ASCE 7-22'"),
        ({"edition_name": "ASCE 7-22", "f_v": None, "s_ds_g": 1.0}, "f_a",
         "F_a is 1.2, but ASCE 7-22 has no site coefficients; leave it blank and give S_MS"),
        ({"edition_name": "ASCE 7-22", "f_a": None, "f_v": None}, "s_ds_g",
         "S_DS is missing; give S_DS or S_MS"),
        (UNSOURCED | {"s_ds_g": 1.0, "site_class": None}, "s_ds_g",
         "for site class 'D (default)', assumed because none is given ("),
        (UNSOURCED | {"s_ds_g": 1.0, "site_class": SiteClass.CD}, "site_class",
         "site class is 'CD', which ASCE 7-16 does not have; give one of A, B, "),
    ],
)  # fmt: skip
def test_an_inconsistency_is_named_at_its_cell(changes, field, text):
    ((place, said),) = faults(**changes)
    assert place == field
    assert text in said


@pytest.mark.parametrize(
    ("changes", "fields"),
    [
        ({"s_ds_g": 1.0}, ["s_ds_g"]),
        ({"s_ms_g": 1.5}, ["s_ms_g"]),
        ({"s_ms_g": 1.5, "s_ds_g": 1.0}, ["s_ms_g", "s_ds_g"]),
        ({"s_ds_g": 1.0, "s_d1_g": 0.6}, ["s_ds_g", "s_d1_g"]),
        ({"s_ds_g": 1.34, "s_m1_g": 0.9}, ["s_m1_g"]),
        ({"s_ds_g": 1.33}, []),
        ({"s_ds_g": 1.328}, ["s_ds_g"]),
        ({"s_ds_g": 1.34, "s_d1_g": 0.68}, []),
        ({"f_a": 0.9}, ["f_a"]),
        ({"f_a": 0.9, "s_ds_g": 1.2}, ["f_a"]),
        ({"f_a": 1.0, "f_v": 1.5}, ["f_v"]),
        ({"f_a": 1.1, "s_ds_g": 1.4667}, []),
        ({"site_class": SiteClass.D_DEFAULT, "s_ds_g": 1.334}, ["s_ds_g"]),
        ({"site_class": SiteClass.D_DEFAULT, "s_ds_g": 1.6}, []),
        ({"site_class": None, "s_ds_g": 1.334}, ["s_ds_g"]),
        ({"site_class": SiteClass.B, "s_ds_g": 1.2}, []),
        # No value in the table: a site-specific analysis is required, which is a requirement row.
        ({"site_class": SiteClass.E, "s_ds_g": 0.8}, []),
        ({"site_class": SiteClass.F, "s_ds_g": 0.8}, []),
        ({"site_class": SiteClass.E, "s_s_g": 0.75, "s_ds_g": 0.6}, ["s_ds_g"]),
        ({"hazard": HazardBasis.EXCEPTION, "s_ds_g": 1.0}, ["s_ds_g"]),
        ({"hazard": HazardBasis.SITE_SPECIFIC, "s_ds_g": 1.0}, []),
        ({"hazard": HazardBasis.SITE_SPECIFIC, "f_a": 0.9}, []),
        ({"edition_name": "ASCE 7-22", "s_ds_g": 1.0}, []),
        ({"edition_name": "ASCE 7-22", "s_ms_g": 2.0, "s_ds_g": 1.0}, ["s_ds_g"]),
        ({"s_s_g": None, "s_1_g": None, "s_ds_g": 1.0}, []),
    ],
)
def test_a_value_below_the_table_of_its_edition_is_an_error_at_its_cell(changes, fields):
    assert [field for field, _ in faults(**UNSOURCED | changes)] == fields


def test_a_consistent_site_and_what_the_hazard_tool_gives_for_edition_22_have_no_faults():
    assert faults() == []
    given = {"f_a": None, "f_v": None, "s_ms_g": 1.6, "s_m1_g": 0.9, "s_ds_g": 1.067}
    assert faults(rule_set="ASCE 7-22", **given) == []
