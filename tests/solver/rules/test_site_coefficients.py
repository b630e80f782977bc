"""Site coefficients of ASCE 7-16, against values read off its tables by hand."""

import math

import pytest

from solver.rules.site_coefficients import F_A, F_V, site_coefficient


@pytest.mark.parametrize(
    ("table", "site_class", "mapped_g", "expected"),
    [
        (F_A, "C", 1.271, 1.2),  # the permit sheet of 7-16 with F_a 1.2
        (F_V, "D", 0.455, 1.845),  # and its F_v, between 1.9 and 1.8
        (F_A, "D", 0.1, 1.6),
        (F_A, "D", 0.375, 1.5),
        (F_A, "D", 1.5, 1.0),
        (F_A, "D", 2.5, 1.0),
        (F_A, "D (default)", 1.1, 1.2),
        (F_A, "D (default)", 0.625, 1.3),
        (F_A, "E", 0.75, 1.3),
        (F_V, "C", 0.55, 1.45),
        (F_V, "C", 0.70, 1.4),
        (F_V, "B", 0.3, 0.8),
    ],
)
def test_coefficients_are_those_of_the_tables(table, site_class, mapped_g, expected):
    assert site_coefficient(table, site_class, mapped_g) == pytest.approx(expected, abs=1e-12)


@pytest.mark.parametrize(
    ("table", "site_class", "mapped_g"),
    [(F_A, "E", 0.76), (F_A, "E", 2.0), (F_V, "E", 0.11), (F_A, "F", 0.2), (F_V, "F", 1.0)],
)
def test_a_site_specific_coefficient_is_none(table, site_class, mapped_g):
    assert math.isnan(site_coefficient(table, site_class, mapped_g))


def test_the_default_of_site_class_d_is_never_below_d_nor_below_1_2():
    for mapped_g in (0.3, 0.7, 0.76, 0.9, 1.3):
        by_default = site_coefficient(F_A, "D (default)", mapped_g)
        assert by_default == max(1.2, site_coefficient(F_A, "D", mapped_g))


def test_asce_7_22_site_classes_between_the_letters_have_no_coefficient():
    with pytest.raises(KeyError):
        site_coefficient(F_A, "CD", 1.0)
