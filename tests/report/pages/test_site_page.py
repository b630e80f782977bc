"""The site table has the values of a permit sheet, and its equations follow what is given."""

import re

import pytest

import scenes
import stand_in
from printed import printed

BLANK = dict.fromkeys(
    ("s_s_g", "s_1_g", "f_a", "f_v", "s_ms_g", "s_m1_g", "s_ds_g", "s_d1_g", "site_class")
)
FT = stand_in.FOOT


def package(sections=None, **site):
    """A package of one array, its site given by `site` alone."""
    usual = {"arrays": [stand_in.array("A1", 1.0)], "objects": [], "clearances": []}
    shaking = scenes.motions(3, seconds=3.0)
    return scenes.package(shaking, site=stand_in.site(**BLANK | site), **usual | (sections or {}))


def table(made):
    return printed(made, "inputs").table("8.1 Site and seismic parameters")


def rows(made):
    """Rows by their symbol, or by their description where they have none; the last of each name."""
    return {row["Symbol"] or row["Description"]: row for row in table(made).rows}


def values(made):
    return {name: row["Value"] for name, row in rows(made).items()}


def forces(made):
    """The component force with its limits."""
    every = (row for row in table(made).rows if row["Symbol"] == "Fp/Wp")
    return [(row["Value"], row["Source"]) for row in every]


def sources(made):
    """How each spectral acceleration of the site follows, by its symbol."""
    return {name: row["Source"] for name, row in rows(made).items() if re.match("S[MD][S1]", name)}


def worked_out(source):
    """The result of the numbers that a source ends with."""
    numbers = source.rpartition(" = ")[2]
    return eval(numbers.replace("×", "*").replace(" g", ""))


CATEGORY = "Seismic design category of these"
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
    return package({"target": {"t_l_s": 8.0}}, **FULL)


@pytest.mark.quick
def test_the_values_are_those_of_a_permit_sheet_or_category_e_near_a_fault(full):
    """Permit sheet of provisions.md: S_S 1.271, F_a 1.2, S_1 0.455, F_v 1.845, h 30 ft."""
    found = values(full)
    assert [found[name] for name in ("SMS", "SDS", "SM1", "SD1", "Ta", "TS")] == [
        "1.525 g", "1.017 g", "0.839 g", "0.560 g", "0.256 s", "0.550 s",
    ]  # fmt: skip
    assert found[CATEGORY] == found["SDC"] == "D"
    assert rows(full)[CATEGORY]["Source"] == "largest of D (0.2 s), D (1 s), S1 below 0.75 g"
    assert "not given" not in found.values()
    found = rows(package(s_ds_g=1.5, s_1_g=0.8, sdc="E"))
    assert found[CATEGORY]["Source"] == "largest of D (0.2 s), not given (1 s), S1 E"
    assert found[CATEGORY]["Value"] == found["SDC"]["Value"] == "E (not confirmed)"
    confirmed = values(package(s_ds_g=1.5, s_1_g=0.8, s_d1_g=0.9, sdc="E"))
    assert confirmed[CATEGORY] == confirmed["SDC"] == "E"


def test_equations_and_periods_follow_what_is_given(full):
    row = rows(full)["Ta"]
    assert row["Description"] == "Approximate period, structure type other"
    assert row["Source"] == "assumed"
    row = rows(package({"building": {"structure": "steel moment frame"}}, **FULL))["Ta"]
    # 0.028 x 30^0.8
    assert (row["Value"], row["Source"]) == ("0.425 s", "computed")
    assert values(package({"building": {"period_s": 0.62}}, **FULL))["T1"] == "0.620 s"
    computed = {
        "SMS": "computed: Fa SS = 1.200 × 1.271 g",
        "SM1": "computed: Fv S1 = 1.845 × 0.455 g",
        "SDS": "computed: 2/3 SMS = 2/3 × 1.525 g",
        "SD1": "computed: 2/3 SM1 = 2/3 × 0.839 g",
    }
    assert sources(full) == computed
    for name, clause in (("SMS", "4"), ("SM1", "4"), ("SDS", "5"), ("SD1", "5")):
        row = rows(full)[name]
        value_g = float(row["Value"].removesuffix(" g"))
        assert worked_out(row["Source"]) == pytest.approx(value_g, abs=1.1e-3)
        assert row["Reference"] == f"ASCE 7-16 11.4.{clause}"
    assert sources(package(**FULL | {"s_ds_g": 1.017})) == computed | {"SDS": "input"}
    assert sources(package(s_ds_g=1.0)) == {
        "SMS": "computed: 1.5 SDS = 1.5 × 1.000 g", "SM1": "—", "SDS": "input", "SD1": "—",
    }  # fmt: skip


def test_the_force_and_its_factors_are_those_of_a_permit_sheet():
    """Permit sheet of provisions.md: h 35 ft, S_DS 1.0504, a_p 1, R_p 1.5."""
    height = {"structure_height_m": 35 * FT, "roof_height_m": 35 * FT}
    made = package(s_ds_g=1.0504, force_factor=1.0, force_divisor=1.5, **height)
    assert forces(made) == [("0.840", "computed: at most 1.681, at least 0.315")]
    assert values(made)["Ta"] == "0.288 s"
    arrays = [stand_in.array("A1", 1.0, i_p=1.5), stand_in.array("A2", 1.0, x=120)]
    made = package({"arrays": arrays}, s_ds_g=1.0, force_factor=1.0, force_divisor=1.5)
    assert values(made)["Ip"] == "1.00 to 1.50"
    assert "at most 2.400," in forces(made)[0][1]  # 1.6 x S_DS x the larger I_p


@pytest.mark.parametrize("rule_set", ["SEAOC PV1-2012", "ASCE 7-16", "ASCE 7-22"])
@pytest.mark.parametrize("height_m", [0.0, 5.0, 10.0])
def test_the_amplification_with_its_numbers_gives_the_result(rule_set, height_m):
    height = {"roof_height_m": height_m, "structure_height_m": 10.0}
    made = package({"spectrum": []}, rule_set=rule_set, s_ds_g=1.566, **height)
    flexible, rigid = (rows(made)[name] for name in ("AFLX", "ARIG"))
    numbers, limit = flexible["Source"].split(", at most ")
    assert limit == "1.6 SDS"
    value = worked_out(numbers)
    values_g = [float(row["Value"].removesuffix(" g")) for row in (flexible, rigid)]
    assert values_g == pytest.approx([min(value, 1.6 * 1.566), 0.4 * value], abs=6e-4)
    formula = numbers.split(" = ")[0].removeprefix("computed: ")
    assert rigid["Source"] == f"computed: 0.4 {formula}"


@pytest.mark.quick
def test_asce_7_22_has_no_site_coefficients_and_its_own_clauses():
    made = package(
        rule_set="ASCE 7-22",
        s_ms_g=2.4,
        s_m1_g=1.2,
        site_class="CD",
        force_factor=1.4,
        force_divisor=1.5,
    )
    found = rows(made)
    assert not {"Fa", "Fv", "ap", "Rp"} & found.keys()
    assert (found["CAR"]["Value"], found["Rpo"]["Value"]) == ("1.40", "1.50")
    assert (found["SDS"]["Value"], found["SDS"]["Reference"]) == ("1.600 g", "ASCE 7-22 11.4.4")
    assert not any("7-16" in row["Reference"] for row in found.values())
    assert sources(made) == {
        "SMS": "input",
        "SM1": "input",
        "SDS": "computed: 2/3 SMS = 2/3 × 2.400 g",
        "SD1": "computed: 2/3 SM1 = 2/3 × 1.200 g",
    }
    # 0.4 S_DS H_f / R_mu C_AR / R_po with H_f = 3.5 at the roof and R_mu = 1.3
    ((force, _),) = forces(made)
    assert float(force) == pytest.approx(0.4 * 1.6 * 3.5 / 1.3 * 1.4 / 1.5, abs=6e-4)
