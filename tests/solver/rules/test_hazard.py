"""Seismic design parameters and site coefficients, against permit sheets and printed tables."""

import math

import pytest

from fixtures.spaces import spaced
from solver.rules.ac156 import ac156_horizontal, ac156_vertical
from solver.rules.hazard import (
    EDITIONS,
    FOOT_M,
    approximate_period_s,
    component_force,
    design_categories,
    period_height_factor,
    seismic_parameters,
)
from solver.rules.site_coefficients import F_A, F_V, site_coefficient, site_specific_reason

pytestmark = pytest.mark.quick

E16, E22 = EDITIONS["ASCE 7-16"], EDITIONS["ASCE 7-22"]


def test_seismic_parameters_of_both_editions_and_of_too_little():
    site = seismic_parameters(E16, s_s=1.271, f_a=1.2, s_1=0.455, f_v=1.845)
    printed = [f"{value:.3f}" for value in (site.s_ms, site.s_ds, site.s_m1, site.s_d1, site.t_s)]
    assert printed == ["1.525", "1.017", "0.839", "0.560", "0.550"]
    assert f"{approximate_period_s('other', 30 * FOOT_M):.3f}" == "0.256"
    given = {"s_ds_g": site.s_ds, "s_d1_g": site.s_d1, "s_1_g": 0.455}
    assert design_categories(**given, is_essential=False) == ("D", "D", "")
    site = seismic_parameters(E22, s_s=1.0, f_a=1.2, s_ms=1.5, s_d1=0.6)
    assert (site.s_ms, site.s_ds, site.s_d1) == (1.5, 1.0, 0.6)
    assert site.s_m1 == pytest.approx(0.9)
    assert seismic_parameters(E22, s_s=1.0, f_a=1.2).s_ds is None
    assert seismic_parameters(E16, s_ds=1.2).s_ms == pytest.approx(1.8)
    for given in ({"s_s": 1.0}, {"f_a": 1.2}, {"s_1": 0.4}, {"f_v": 1.9}):
        site = seismic_parameters(E16, **given)
        assert (site.s_ms, site.s_m1, site.s_ds, site.s_d1, site.t_s) == (None,) * 5


def force(edition=E16, **given):
    usual = {"s_ds_g": 1.0, "factor": 1.0, "divisor": 1.5, "i_p": 1.0, "z_over_h": 1.0}
    return component_force(edition, **(usual | given))


def test_the_component_force_is_that_of_a_permit_sheet_or_by_its_period():
    found = force(s_ds_g=1.0504)
    printed = [f"{value:.2f}" for value in (found.value, found.maximum, found.minimum)]
    assert printed == ["0.84", "1.68", "0.32"]
    assert f"{approximate_period_s('other', 35 * FOOT_M):.3f}" == "0.288"
    assert force(E22).formula == pytest.approx(0.4 * 3.5 / 1.3 / 1.5, rel=1e-12)
    assert force(E22, period_s=1.0).formula == pytest.approx(0.4 * 2.84 / 1.3 / 1.5, rel=1e-12)
    assert force(E16, period_s=1.0) == force(E16)
    factors = [f"{period_height_factor(1.0, t):.2f}" for t in (0.2, 0.4, 0.5, 1.0, 2.0)]
    assert factors == ["3.50", "3.50", "3.36", "2.84", "2.46"]
    # By hand: a1 = 1, a2 = 1 - 0.4^2 = 0.84.
    assert period_height_factor(0.5, 1.0) == pytest.approx(1.0 + 0.5 + 0.84 / 1024, rel=1e-12)
    found = force(s_ds_g=1.2, divisor=2.5, i_p=1.5, z_over_h=0.5)
    assert found.formula == pytest.approx(0.4 * 1.2 * 1.5 * 2.0 / 2.5, rel=1e-12)


@pytest.mark.parametrize(("factor", "expected"), [(0.1, 0.45), (10.0, 2.4)])
def test_the_component_force_keeps_within_its_limits(factor, expected):
    found = force(factor=factor, i_p=1.5)
    assert found.value in (found.minimum, found.maximum)
    assert (found.minimum, found.maximum) == pytest.approx((0.45, 2.4))
    assert found.value == pytest.approx(expected)


def test_an_ac156_report_that_envelopes_roof_and_grade():
    roof = ac156_horizontal(E22, s_ds_g=2.0, z_over_h=1.0).sa_g[[1, 3]]
    grade = ac156_horizontal(E22, s_ds_g=2.5, z_over_h=0.0).sa_g[[1, 3]]
    upward = [ac156_vertical(s_ds_g=s).sa_g[[1, 3]] for s in (2.0, 2.5)]
    assert [f"{max(pair):.2f}" for pair in zip(roof, grade, strict=True)] == ["3.20", "2.15"]
    printed = [f"{max(pair) + 1e-12:.2f}" for pair in zip(*upward, strict=True)]
    assert printed == ["1.68", "0.68"]


@pytest.mark.parametrize(
    ("s_ds", "s_d1", "ordinary", "essential"),
    [
        (0.1669, 0.0669, "A", "A"),
        (0.167, 0.067, "B", "C"),
        (0.33, 0.133, "C", "D"),
        (0.50, 0.20, "D", "D"),
    ],
)
def test_the_steps_of_both_category_tables(s_ds, s_d1, ordinary, essential):
    given = {"s_ds_g": s_ds, "s_d1_g": s_d1, "s_1_g": None}
    assert design_categories(**given, is_essential=False) == (ordinary, ordinary, "")
    assert design_categories(**given, is_essential=True) == (essential, essential, "")


@pytest.mark.parametrize(
    ("s_d1", "s_1", "is_essential", "categories"),
    [
        (None, None, False, ("B", "", "")),
        (0.25, 0.3, False, ("B", "D", "")),
        (0.01, 0.749, False, ("B", "A", "")),
        (0.01, 0.75, False, ("B", "A", "E")),
        (0.01, 0.75, True, ("C", "A", "F")),
    ],
)
def test_categories_by_what_is_known_of_a_site(s_d1, s_1, is_essential, categories):
    given = {"s_ds_g": 0.2, "s_d1_g": s_d1, "s_1_g": s_1, "is_essential": is_essential}
    assert design_categories(**given) == categories


E16, E22 = EDITIONS["ASCE 7-16"], EDITIONS["ASCE 7-22"]


@pytest.mark.parametrize(
    ("table", "site_class", "mapped_g", "expected"),
    [
        (F_A, "C", 1.271, 1.2),  # the permit sheet of 7-16 with F_a 1.2
        (F_V, "D", 0.455, 1.845),  # and its F_v, between 1.9 and 1.8
        (F_A, "D", 0.1, 1.6),
        (F_A, "D", 0.375, 1.5),
        (F_A, "D", 2.5, 1.0),
        (F_A, "D (default)", 1.1, 1.2),
        (F_V, "C", 0.55, 1.45),
    ],
)
def test_coefficients_are_those_of_the_tables(table, site_class, mapped_g, expected):
    assert site_coefficient(table, site_class, mapped_g) == pytest.approx(expected, abs=1e-12)


PRINTED = """
             0.25 0.5  0.75 1.0  1.25 1.5   0.1  0.2  0.3  0.4  0.5  0.6
A            0.8  0.8  0.8  0.8  0.8  0.8   0.8  0.8  0.8  0.8  0.8  0.8
B            0.9  0.9  0.9  0.9  0.9  0.9   0.8  0.8  0.8  0.8  0.8  0.8
C            1.3  1.3  1.2  1.2  1.2  1.2   1.5  1.5  1.5  1.5  1.5  1.4
D            1.6  1.4  1.2  1.1  1.0  1.0   2.4  2.2  2.0  1.9  1.8  1.7
D (default)  1.6  1.4  1.2  1.2  1.2  1.2   2.4  2.2  2.0  1.9  1.8  1.7
E            2.4  1.7  1.3  nan  nan  nan   4.2  nan  nan  nan  nan  nan
F            nan  nan  nan  nan  nan  nan   nan  nan  nan  nan  nan  nan
"""


@pytest.mark.parametrize(("table", "part"), [(F_A, slice(6)), (F_V, slice(6, 12))])
def test_every_entry_is_that_of_the_printed_table(table, part):
    lines = PRINTED.splitlines()[1:]
    heads, *values = [[float(text) for text in line[13:].split()][part] for line in lines]
    rows = dict(zip((line[:13].strip() for line in lines[1:]), values, strict=True))
    assert table.rows.keys() == rows.keys()
    assert table.mapped_g == tuple(heads)
    for site_class, printed in rows.items():
        assert len(table.rows[site_class]) == len(heads)
        found = [site_coefficient(table, site_class, head) for head in heads]
        assert found == pytest.approx(printed, nan_ok=True), site_class


def test_the_default_is_never_below_d_nor_1_2_and_between_letters_there_is_none():
    for mapped_g in (0.3, 0.7, 0.76, 0.9, 1.3):
        by_default = site_coefficient(F_A, "D (default)", mapped_g)
        assert by_default == max(1.2, site_coefficient(F_A, "D", mapped_g))
    with pytest.raises(KeyError):
        site_coefficient(F_A, "CD", 1.0)
    none = (F_A, "E", 0.76), (F_A, "E", 2.0), (F_V, "E", 0.11), (F_A, "F", 0.2), (F_V, "F", 1.0)
    assert all(math.isnan(site_coefficient(*given)) for given in none)


@pytest.mark.parametrize(
    ("edition", "site_class", "s_s", "s_1", "reason"),
    [
        (E16, "D", 1.0, 0.2, "site class D with S_1 = 0.2 g"),
        (E16, "D (default)", 1.0, 0.6, "site class D by default with S_1 = 0.6 g"),
        (E16, "D", 1.0, 0.199, ""),
        (E16, "E", 0.75, 0.1, ""),
        (E16, "E", 0.76, 0.1, "site class E with S_S = 0.76 g"),
        (E16, "E", 0.75, 0.11, "site class E with S_1 = 0.11 g"),
        (E16, "E", None, None, "site class E, S_S and S_1 not entered"),
        (E16, "C", 2.0, 1.0, ""),
        (E16, "F", 0.1, 0.1, "site class F"),
        (E22, "F", 0.1, 0.1, "site class F"),
    ],
)
def test_sites_that_need_a_hazard_analysis_of_their_own(edition, site_class, s_s, s_1, reason):
    found = site_specific_reason(edition, site_class=site_class, s_s_g=s_s, s_1_g=s_1)
    missing = reason.partition(", ")[2].removesuffix(" not entered")
    assert spaced((found[0], " and ".join(found[1]))) == (reason, missing)
