"""What a workbook may override, and which values of it are unusual or require less."""

from dataclasses import replace

import pytest

from solver.rules.rulesets import ALLOWED, RULE_SETS, Allowed, Confidence, usual

pytestmark = pytest.mark.quick

# Provision, the least and the greatest number allowed, and of those that are usual.
RANGES = """
prescriptive_factor_in      1    600   30      120
prescriptive_minimum_in     0    240   3       48
prescriptive_low_sdc_in     0    240   3       12
prescriptive_max_slope_deg  0    30    1.4312  6
prescriptive_min_mu         0    1.5   0.2     0.8
analysis_max_slope_deg      0    30    1.4312  14
ibc_max_slope_deg           0    30    2.3818  9.5273
max_stories                 1    200   3       12
max_risk_category           1    4     2       4
low_profile_in              1    120   18      72
low_profile_ratio           0.01 5     0.25    1
analysis_min_motions        1    100   2       6
analysis_mean_motions       1    100   4       14
analysis_factor             1    10    1       2.2
analysis_floor              0    1     0.25    1
separation_like             0    10    0.25    1
separation_fixed            0.1  10    0.5     2
separation_parapet          0    10    0.5     2
separation_edge             0.1  10    0.75    4
separation_edge_min_in      0    600   0       96
parapet_height_in           0    240   6       48
parapet_over_cg_in          0    240   0       12
interconnection_sds         0    2     0.0665  0.266
interconnection_min         0    2     0.05    0.2
"""


def test_ranges_are_those_of_the_table_with_zero_where_it_is_allowed():
    rows = {key: map(float, values) for key, *values in map(str.split, RANGES.split("\n")[1:-1])}
    assert ALLOWED.keys() == rows.keys()
    for key, wanted in rows.items():
        allowed, common = ALLOWED[key], usual(key)
        found = (allowed.low, allowed.high, common.low, common.high)
        assert found == pytest.approx(tuple(wanted), rel=1e-4), key
    zero = {"parapet_over_cg_in": replace(VALUE, value=0.0)}
    nothing = {
        name: replace(rules, values=rules.values | zero) for name, rules in RULE_SETS.items()
    }
    assert usual("parapet_over_cg_in", nothing) == ALLOWED["parapet_over_cg_in"]


VALUE = RULE_SETS["SEAOC PV1-2012"].values["parapet_over_cg_in"]


def test_a_range_has_its_ends_and_requires_less_beyond_its_limit():
    most, least = Allowed(low=0, high=10, is_maximum=True), Allowed(low=0, high=10)
    assert [most.lowers(value, 5.0) for value in (4.0, 5.0, 6.0)] == [False, False, True]
    assert [least.lowers(value, 5.0) for value in (4.0, 5.0, 6.0)] == [True, False, False]
    whole = Allowed(low=1, high=4, is_whole=True)
    assert list(filter(whole.has, (0.0, 1.0, 2.5, 4.0, 5.0))) == [1.0, 4.0]
    confirmed = replace(VALUE, confidence=Confidence.CONFIRMED)
    assert confirmed.verified
    assert not replace(confirmed, reason="agreed").verified
    assert not replace(confirmed, confidence=Confidence.KNOWN).verified
