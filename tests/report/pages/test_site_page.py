"""The site table has the rows of a permit sheet, in its order, with derived values unrounded."""

import re

import pytest

import stand_in
from report.pages.demand import demand_lines
from report.pages.registry import package_data
from report.pages.site import s_ds_note, site_parameters, site_table

BLANK = dict.fromkeys(
    ("s_s_g", "s_1_g", "f_a", "f_v", "s_ms_g", "s_m1_g", "s_ds_g", "s_d1_g", "site_class")
)
MOTIONS = stand_in.motions(3, seconds=3.0)
FT = stand_in.FOOT


def package(*, target=None, building=None, arrays=None, **changes):
    """A package of one array, its site given by `changes` alone."""
    site = stand_in.project().site.model_dump() | BLANK | changes
    data = stand_in.project(
        site=site,
        arrays=arrays or [stand_in.array("A1", 1.0)],
        objects=[],
        clearances=[],
        target=target or {},
        building=building or {},
    )
    return package_data(stand_in.assess_input(data, MOTIONS))


def plain(text):
    return re.sub(r"<[^>]+>", "", str(text))


def values(made):
    """Value of each row by its symbol, or by its description where it has none."""
    return {row.symbol or plain(row.words): row.value for row in site_parameters(made)}


FULL = {
    "s_s_g": 1.271,
    "f_a": 1.2,
    "s_1_g": 0.455,
    "f_v": 1.845,
    "site_class": "D",
    "force_factor": 1.0,
    "force_divisor": 1.5,
    "structure_height_m": 30 * FT,
    "roof_height_m": 30 * FT,
    "hazard_source": "ASCE 7 Hazard Tool",
    "hazard_date": "2026-02-20",
    "hazard": "exception of 11.4.8",
}


@pytest.fixture(scope="module")
def full():
    return package(target={"t_l_s": 8.0}, **FULL)


def test_the_rows_have_the_order_of_a_permit_sheet(full):
    names = [row.symbol or plain(row.words) for row in site_parameters(full)]
    wanted = [
        *("Risk category", "I_e", "I_p", "a_p", "R_p", "z", "S_S", "S_1", "T_L", "Site class"),
        *("F_a", "F_v", "S_MS", "S_M1", "S_DS", "S_D1", "T_a", "T_S", "SDC by short period"),
        *("SDC by 1 s period", "SDC by S1", "Controlling SDC of these", "F_p/W_p"),
    ]
    places = [names.index(name) for name in wanted]
    assert places == sorted(places)
    assert names.count("F_p/W_p") == 3


def test_the_numbers_of_the_component_name_their_own_clauses(full):
    """ASCE 7: I_p of 13.1.3; a_p, R_p of the tables for architectural and mechanical parts."""
    clauses = {row.symbol: row.clause for row in site_parameters(full)}
    assert clauses["I_p"] == "ASCE 7-16 13.1.3"
    assert clauses["a_p"] == clauses["R_p"] == "ASCE 7-16 Tables 13.5-1, 13.6-1"
    assert clauses["F_p/W_p"] == clauses["z"] == "ASCE 7-16 13.3.1"


def test_the_values_are_those_of_a_permit_sheet(full):
    """Permit sheet of provisions.md: S_S 1.271, F_a 1.2, S_1 0.455, F_v 1.845, h 30 ft."""
    found = values(full)
    assert [found[name] for name in ("S_MS", "S_DS", "S_M1", "S_D1", "T_a", "T_S")] == [
        "1.525 g",
        "1.017 g",
        "0.839 g",
        "0.560 g",
        "0.256 s",
        "0.550 s",
    ]
    assert found["Controlling SDC of these"] == found["SDC"] == "D"
    assert found["SDC by S1"] == "none, below 0.75 g"
    assert found["Date of the hazard values"] == "2026-02-20"
    assert "not given" not in found.values()


def test_a_derived_period_says_which_structure_it_assumes(full):
    row = next(row for row in site_parameters(full) if row.symbol == "T_a")
    assert (row.words, row.origin) == ("Approximate period, structure type other", "assumed")
    stated = package(building={"structure": "steel moment frame"}, **FULL)
    row = next(row for row in site_parameters(stated) if row.symbol == "T_a")
    # 0.028 x 30^0.8
    assert (row.value, row.origin) == ("0.425 s", "computed")
    assert values(package(building={"period_s": 0.62}, **FULL))["T_1"] == "0.620 s"


def test_the_component_force_is_that_of_a_permit_sheet():
    """Permit sheet of provisions.md: h 35 ft, S_DS 1.0504, a_p 1, R_p 1.5."""
    height = {"structure_height_m": 35 * FT, "roof_height_m": 35 * FT}
    made = package(s_ds_g=1.0504, force_factor=1.0, force_divisor=1.5, **height)
    forces = [row.value for row in site_parameters(made) if row.symbol == "F_p/W_p"]
    assert forces == ["0.840", "1.681", "0.315"]
    assert values(made)["T_a"] == "0.288 s"
    (line,) = (line for line in demand_lines(made) if "F_p" in line.latex)
    assert [result for _, result in line.steps] == forces


def test_a_site_of_s_ds_alone_has_what_can_be_derived_and_no_more():
    made = package(s_ds_g=1.0)
    found = values(made)
    assert (found["S_DS"], found["S_MS"]) == ("1.000 g", "1.500 g")
    missing = {name for name, value in found.items() if value == "not given"}
    assert missing == {
        *("a_p", "R_p", "S_S", "S_1", "T_L", "Site class", "F_a", "F_v", "S_M1", "S_D1", "T_S"),
        *("SDC by 1 s period", "SDC by S1", "F_p/W_p"),
        *("Hazard source", "Date of the hazard values"),
    }
    origins = {row.cells[0]: row.cells[4] for row in site_table(made).rows}
    assert origins["Site class"] == "—"
    assert equations(made) == [r"S_{MS}=\frac{3}{2}\,S_{DS}"]


def test_asce_7_22_has_no_site_coefficients_and_its_own_clauses():
    made = package(
        rule_set="ASCE 7-22",
        s_ms_g=2.4,
        s_m1_g=1.2,
        site_class="CD",
        force_factor=1.4,
        force_divisor=1.5,
    )
    rows = {row.symbol or plain(row.words): row for row in site_parameters(made)}
    assert not {"F_a", "F_v", "a_p", "R_p"} & rows.keys()
    assert (rows["C_AR"].value, rows["R_po"].value) == ("1.40", "1.50")
    assert (rows["S_DS"].value, rows["S_DS"].clause) == ("1.600 g", "ASCE 7-22 11.4.4")
    assert (rows["S_MS"].origin, rows["S_DS"].origin) == ("input", "computed")
    assert not any("7-16" in row.clause for row in rows.values())
    assert equations(made) == [
        r"S_{DS}=\frac{2}{3}\,S_{MS}",
        r"S_{D1}=\frac{2}{3}\,S_{M1}",
    ]
    # 0.4 S_DS H_f / R_mu C_AR / R_po with H_f = 3.5 at the roof and R_mu = 1.3
    force = next(row.value for row in site_parameters(made) if row.symbol == "F_p/W_p")
    assert float(force) == pytest.approx(0.4 * 1.6 * 3.5 / 1.3 * 1.4 / 1.5, abs=6e-4)


def test_the_equations_follow_what_is_given(full):
    assert equations(full) == [
        r"S_{MS}=F_a\,S_S",
        r"S_{DS}=\frac{2}{3}\,S_{MS}",
        r"S_{M1}=F_v\,S_1",
        r"S_{D1}=\frac{2}{3}\,S_{M1}",
    ]
    first, second = list(demand_lines(full))[:2]
    assert (first.reference, second.reference) == ("ASCE 7-16 11.4.4", "ASCE 7-16 11.4.5")
    assert (first.steps[0][1], second.steps[0][1]) == ("1.525 g", "1.017 g")
    assert equations(package(**FULL | {"s_ds_g": 1.017}))[:2] == [
        r"S_{MS}=F_a\,S_S",
        r"S_{M1}=F_v\,S_1",
    ]


def equations(made):
    return [line.latex for line in demand_lines(made) if line.latex.startswith(("S_{M", "S_{D"))]


def test_the_note_names_the_values_that_s_ds_comes_from(full):
    assert "computed from SS and Fa in" in plain(s_ds_note(full.data.site))
    given = package(**FULL | {"s_ds_g": 1.02}).data.site
    assert "The value from SS and Fa is 1.017 g; it is not used." in plain(s_ds_note(given))
    alone = package(s_ds_g=1.0).data.site
    assert plain(s_ds_note(alone)) == "SDS is as given in the workbook."


def test_i_p_is_a_range_where_arrays_differ():
    arrays = [stand_in.array("A1", 1.0, i_p=1.5), stand_in.array("A2", 1.0, x=120)]
    made = package(s_ds_g=1.0, arrays=arrays, force_factor=1.0, force_divisor=1.5)
    assert values(made)["I_p"] == "1.00 to 1.50"
    forces = [row.value for row in site_parameters(made) if row.symbol == "F_p/W_p"]
    assert forces[1] == "2.400"  # 1.6 x S_DS x the larger I_p


def test_a_near_fault_site_is_category_e():
    found = values(package(s_ds_g=1.5, s_1_g=0.8, sdc="E"))
    assert (found["SDC by short period"], found["SDC by S1"]) == ("D", "E")
    assert found["Controlling SDC of these"] == found["SDC"] == "E (not confirmed)"
    confirmed = values(package(s_ds_g=1.5, s_1_g=0.8, s_d1_g=0.9, sdc="E"))
    assert confirmed["Controlling SDC of these"] == confirmed["SDC"] == "E"
