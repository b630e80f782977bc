"""Site coefficients of ASCE 7-16, against values read off its tables by hand."""

import math

import pytest

from solver.rules.hazard import EDITIONS
from solver.rules.site_coefficients import F_A, F_V, site_coefficient, site_specific_reason

pytestmark = pytest.mark.quick

E16, E22 = EDITIONS["ASCE 7-16"], EDITIONS["ASCE 7-22"]


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


@pytest.mark.parametrize(
    ("table", "site_class", "mapped_g"),
    [(F_A, "E", 0.76), (F_A, "E", 2.0), (F_V, "E", 0.11), (F_A, "F", 0.2), (F_V, "F", 1.0)],
)
def test_a_site_specific_coefficient_is_none(table, site_class, mapped_g):
    assert math.isnan(site_coefficient(table, site_class, mapped_g))


def test_the_default_is_never_below_d_nor_1_2_and_between_letters_there_is_none():
    for mapped_g in (0.3, 0.7, 0.76, 0.9, 1.3):
        by_default = site_coefficient(F_A, "D (default)", mapped_g)
        assert by_default == max(1.2, site_coefficient(F_A, "D", mapped_g))
    with pytest.raises(KeyError):
        site_coefficient(F_A, "CD", 1.0)


@pytest.mark.parametrize(
    ("edition", "site_class", "s_s", "s_1", "reason"),
    [
        (E16, "D", 1.0, 0.2, "site class D with S_1 = 0.2 g"),
        (E16, "D (default)", 1.0, 0.6, "site class D by default with S_1 = 0.6 g"),
        (E16, "D", 1.0, 0.199, ""),
        (E16, "E", 1.0, None, "site class E with S_S = 1 g"),
        (E16, "E", 0.75, 0.1, ""),
        (E16, "E", 0.76, 0.1, "site class E with S_S = 0.76 g"),
        (E16, "E", 0.75, 0.11, "site class E with S_1 = 0.11 g"),
        (E16, "E", 0.75, None, "site class E, S_1 not given"),
        (E16, "E", None, None, "site class E, S_S and S_1 not given"),
        (E16, "D", None, None, "site class D, S_1 not given"),
        (E16, "C", None, None, ""),
        (E16, "C", 2.0, 1.0, ""),
        (E16, "F", 0.1, 0.1, "site class F"),
        (E22, "F", 0.1, 0.1, "site class F"),
        (E22, "D", 1.0, 0.6, ""),
        (E22, "DE", 1.0, 0.6, ""),
    ],
)
def test_sites_that_need_a_hazard_analysis_of_their_own(edition, site_class, s_s, s_1, reason):
    found = site_specific_reason(edition, site_class=site_class, s_s_g=s_s, s_1_g=s_1)
    missing = reason.partition(", ")[2].removesuffix(" not given")
    assert (found[0], " and ".join(found[1])) == (reason, missing)
