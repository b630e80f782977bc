"""Code rules against published permit calculations and the paper; limits and overrides."""

import csv
import math
from dataclasses import replace
from functools import partial

import numpy as np
import pytest

from fixtures.errors import input_problems
from fixtures.paths import DATA
from solver.errors import InputError
from solver.rules.ac156 import Tail, ac156_horizontal, ac156_vertical
from solver.rules.hazard import EDITIONS
from solver.rules.limit import MOTIONS, PROGRAM, Limit, Measure
from solver.rules.provisions import (
    Basis,
    Neighbor,
    analysis_checks,
    analysis_floor_m,
    analysis_value,
    array_checks,
    basis_for,
    factored,
    interconnection_strength_n,
    parapet_qualifies,
    prescriptive_checks,
    prescriptive_displacement,
    required_separation,
)
from solver.rules.rulesets import ALLOWED, RULE_SETS, Allowed, Confidence, usual

pytestmark = pytest.mark.quick

PV1, A16, A22 = (RULE_SETS[name] for name in ("SEAOC PV1-2012", "ASCE 7-16", "ASCE 7-22"))
E16, E22 = EDITIONS["ASCE 7-16"], EDITIONS["ASCE 7-22"]
INCH = 0.0254
TABLE = list(csv.DictReader((DATA / "provisions.csv").read_text().splitlines()))


def prescriptive(rules, s_ds, sdc="D", importance=1.0):
    return prescriptive_displacement(rules, s_ds_g=s_ds, sdc=sdc, importance=importance)


def prescriptive_in(*given):
    return prescriptive(*given).value_m / INCH


def separation(rules, kind, design_m, importance=1.0):
    return required_separation(rules, kind, design_m=design_m, importance=importance)


@pytest.mark.parametrize(("rules", "column"), [(PV1, "pv1"), (A16, "asce7_16"), (A22, "asce7_22")])
def test_every_number_and_mark_is_that_of_the_table_of_provisions(rules, column):
    rows = {row["key"]: row for row in TABLE if row[column]}
    assert set(rules.values) == set(rows)
    for key, row in rows.items():
        value, provision = row[column], rules.values[key]
        if ":" in value:
            rise, run = map(float, value.split(":"))
            value = math.degrees(math.atan(rise / run))
        assert provision.value == pytest.approx(float(value), rel=1e-12), key
        assert provision.confidence.value == row[f"{column}_mark"], key
        if column == "pv1":
            assert provision.clause == row["pv1_clause"], key


def test_separations_strengths_and_edges_are_those_published():
    delta = prescriptive(PV1, 1.0, "D", 1.25).value_m
    kinds = {Neighbor.LIKE: 1.0, Neighbor.FIXED: 1.0, Neighbor.PARAPET: 1.25, Neighbor.EDGE: 1.25}
    inches = [separation(PV1, kind, delta, i_e) / INCH for kind, i_e in kinds.items()]
    assert [f"{one:.1f}" for one in inches] == ["10.8", "21.6", "27.0", "40.5"]
    # W1,max = min(F / (0.133 S_DS), F / 0.1) for strengths of 358 lb and 110 lb.
    for strength, weight in ((358.0, 2691.7), (110.0, 827.1)):
        required = interconnection_strength_n(PV1, s_ds_g=1.0, w1_n=weight)
        assert f"{required:.1f}" == f"{strength:.1f}"
    assert interconnection_strength_n(PV1, s_ds_g=0.751, w1_n=1.0) == 0.1
    assert interconnection_strength_n(PV1, s_ds_g=0.752, w1_n=1.0) > 0.1
    for rules, expected in ((PV1, 0.15), (A16, 4 * 0.3048)):
        assert separation(rules, Neighbor.EDGE, 0.1) == pytest.approx(expected, rel=1e-12)
    for kind in Neighbor:
        assert math.isnan(separation(A16, kind, math.nan))
    assert [kind.name for kind in Neighbor if kind.is_edge] == ["PARAPET", "EDGE"]


def test_published_displacements_are_reproduced_with_the_importance_entering_once():
    value = prescriptive_in(PV1, 1.566)
    assert f"{value:.1f}" == "81.6"
    assert float(f"{value * 25.4:.3g}") == 2070
    s_ds = 2 / 3 * 1.2 * 1.313
    delta = prescriptive(A16, s_ds).value_m
    assert (f"{s_ds:.4f}", f"{delta / INCH:.1f}") == ("1.0504", "25.4")
    kinds = (Neighbor.LIKE, Neighbor.FIXED, Neighbor.PARAPET, Neighbor.EDGE)
    feet = [f"{separation(A16, kind, delta) / 0.3048:.2f}" for kind in kinds]
    assert feet == ["1.06", "2.12", "2.12", "4.23"]
    for rules in (PV1, A16):
        delta = prescriptive(rules, 1.4, "D", 1.25).value_m
        assert separation(rules, Neighbor.UNLIKE, delta, 1.25) == pytest.approx(
            1.25 * 60 * INCH, rel=1e-12
        )


@pytest.mark.parametrize(
    ("rules", "s_ds", "sdc", "importance", "inches"),
    [
        (PV1, 0.70, "D", 1.0, 6.0),
        (PV1, 2.00, "C", 1.0, 6.0),
        (PV1, 1.00, "D", 1.0, 21.6),
        (PV1, 1.00, "D", 1.5, 21.6),
        (A16, 1.00, "D", 1.0, 24.0),
        (A16, 1.00, "D", 1.25, 27.0),
        (A16, 1.40, "D", 1.0, 60.0),
        (PV1, 1.40, "D", 1.0, 60.0),
    ],
)
def test_the_prescriptive_displacement_of_worked_values(rules, s_ds, sdc, importance, inches):
    assert prescriptive_in(rules, s_ds, sdc, importance) == pytest.approx(inches, rel=1e-12)


def peaks(count):
    return [0.1 * k for k in range(1, count + 1)]


@pytest.mark.parametrize(
    ("given", "basis", "expected"),
    [
        ((PV1, peaks(7)), Basis.MEAN_FACTORED, 1.1 * 0.4),
        ((PV1, peaks(6)), Basis.LARGEST_FACTORED, 1.1 * 0.6),
        ((PV1, peaks(3)), Basis.LARGEST_FACTORED, 1.1 * 0.3),
        ((PV1, peaks(2)), Basis.TOO_FEW, math.nan),
        ((A16, [0.1] * 10, Basis.MEAN), Basis.TOO_FEW, math.nan),
        ((A16, [0.1] * 11, Basis.MEAN), Basis.MEAN, 0.1),
    ],
)
def test_the_statistic_follows_the_number_of_motions(given, basis, expected):
    statistic = analysis_value(*given)
    assert statistic.basis is basis
    assert statistic.value_m == pytest.approx(expected, rel=1e-12, nan_ok=True)


@pytest.mark.parametrize("peaks", [[0.1, math.nan, 0.2], [math.nan, 0.1, 0.2]])
def test_a_missing_peak_gives_no_value(peaks):
    statistic = analysis_value(PV1, peaks)
    assert np.isnan([statistic.value_m, statistic.largest_m]).all()


@pytest.mark.parametrize("rules", RULE_SETS.values())
@pytest.mark.parametrize("count", [1, 2, 3, 6, 7, 12])
def test_the_value_of_many_cases_is_that_of_each(rules, count):
    peaks = np.random.default_rng(count).lognormal(size=(5, count))
    peaks[2, 0] = math.nan
    mean, largest = peaks.mean(axis=1), peaks.max(axis=1)
    found = factored(rules, basis_for(rules, count), mean, largest)
    wanted = [analysis_value(rules, list(map(float, row))).value_m for row in peaks]
    assert found == pytest.approx(wanted, rel=1e-12, nan_ok=True)


@pytest.mark.parametrize(("rules", "expected_in"), [(PV1, 10.8), (A16, 19.2), (A22, 19.2)])
def test_the_floor_is_a_share_of_the_prescriptive_displacement_unless_reviewed(rules, expected_in):
    found = prescriptive(rules, 1.0)
    assert analysis_floor_m(rules, found) == pytest.approx(expected_in * INCH)
    assert analysis_floor_m(rules, found, is_reviewed=True) == 0.0


@pytest.mark.parametrize(
    ("rules", "slope_rad", "ok"),
    [
        (PV1, math.radians(3.0), True),
        (PV1, math.radians(3.001), False),
        (A16, math.atan(0.05), True),
        (A16, math.atan(0.0501), False),
    ],
)
def test_a_slope_equal_to_the_limit_passes(rules, slope_rad, ok):
    assert prescriptive_checks(rules, slope_rad=slope_rad, mu=0.6)[0].ok is ok


def test_limits_hold_but_for_rounding_and_never_of_nan():
    mus = (0.4 * part for part in (1 - 1e-15, 1 - 1.6e-9))
    friction = [prescriptive_checks(PV1, slope_rad=0.0, mu=mu)[1].ok for mu in mus]
    high = PV1.overridden({"low_profile_in": (120.0, "a test")})
    heights_m = (120 * INCH * part for part in (1 + 6e-10, 1 + 1.6e-9))
    height = [checked(high, height_m=h, spacing_m=9.0, base_m=9.0)[0].ok for h in heights_m]
    assert friction == height == [True, False]
    assert not prescriptive_checks(PV1, slope_rad=math.nan, mu=math.nan)[0].ok
    assert not prescriptive_checks(PV1, slope_rad=0.0, mu=math.nan)[1].ok
    assert not analysis_checks(PV1, slope_rad=0.0, n_motions=2, sdc="D", is_reviewed=False)[1].ok


def test_friction_and_profile_are_limited_as_each_code_has_it():
    limits = [
        prescriptive_checks(rules, slope_rad=math.atan(rise), mu=0.4)[1].limit
        for rules in (A16, PV1)
        for rise in (0.0, 0.03, 0.05)
    ]
    assert limits == pytest.approx([0.4, 0.4, 0.414, 0.4, 0.4, 0.4], rel=1e-12)
    limits = [
        checked(rules, spacing_m=spacing * INCH, base_m=base * INCH)[0].limit / INCH
        for rules, spacing, base in ((PV1, 40, 60), (A16, 40, 60), (PV1, 40, 100), (A16, 90, 60))
    ]
    assert limits == pytest.approx([30.0, 20.0, 36.0, 36.0], rel=1e-12)


def checked(rules, *, height_m=0.1, spacing_m=1.0, base_m=1.0, slope_rad=0.0):
    return array_checks(
        rules, cg_height_m=height_m, support_spacing_m=spacing_m, base_m=base_m, slope_rad=slope_rad
    )


@pytest.mark.parametrize("rules", [PV1, A16, A22])
def test_one_in_twelve_of_the_ibc_limits_every_rule_set(rules):
    rises = (0.0, 1 / 12, 1 / 12 + 1e-6)
    checks = [checked(rules, slope_rad=math.atan(rise))[1] for rise in rises]
    assert [check.ok for check in checks] == [True, True, False]
    assert checks[0].provision.clause == "IBC 1613.3"


def analysis_slope(rules, rise, sdc, is_reviewed):
    about = {"n_motions": 7, "sdc": sdc, "is_reviewed": is_reviewed}
    return analysis_checks(rules, slope_rad=math.atan(rise), **about)[0]


def test_peer_review_permits_steeper_roofs_in_low_sdc_up_to_13_6_12():
    for rules, sdc, is_reviewed, ok, by_exception in (
        (A16, "C", True, True, True),
        (A22, "A", True, True, True),
        (A16, "C", False, False, False),
        (A16, "D", True, False, False),
        (PV1, "C", True, True, False),
    ):
        check = analysis_slope(rules, 0.07, sdc, is_reviewed)
        assert (check.ok, check.passes_by_exception) == (ok, by_exception)
    over, within = (analysis_slope(A16, rise, "C", True) for rise in (0.07, 0.05))
    assert over.limit == within.limit == pytest.approx(math.degrees(math.atan(1 / 20)), rel=1e-12)
    assert over.provision.clause == "ASCE 7-16 13.6.12"
    assert over.provision.confidence == "L"
    assert within.ok
    assert not within.passes_by_exception
    assert not analysis_slope(A16, math.nan, "C", True).ok


@pytest.mark.parametrize(
    ("rules", "top_in", "cg_in", "ok"),
    [
        (PV1, 24, 18, True),
        (PV1, 23.9, 10, False),
        (PV1, 24, 18.1, False),
        (A16, 11.9, 12, False),
        (A16, 12.0, 12, True),
    ],
)
def test_a_parapet_must_clear_the_roof_and_in_asce_7_the_center_of_gravity_alone(
    rules, top_in, cg_in, ok
):
    found = parapet_qualifies(rules, parapet_height_m=top_in * INCH, cg_height_m=cg_in * INCH)
    assert found is ok


def test_an_override_keeps_its_reason_and_its_range_has_the_numbers_of_the_codes():
    changed = PV1.overridden({"prescriptive_minimum_in": (12.0, "county amendment")})
    assert prescriptive_in(changed, 0.5) == pytest.approx(12.0)
    assert changed.values["prescriptive_minimum_in"].reason == "county amendment"
    assert prescriptive_in(PV1, 0.5) == pytest.approx(6.0)
    with pytest.raises(InputError, match="provision is 'nonsense'"):
        PV1.overridden({"nonsense": (1.0, "")})
    for rules in RULE_SETS.values():
        assert all(ALLOWED[key].has(row.value) for key, row in rules.values.items())
    # 60 in (0.9 - 0.4)^2 without rounding.
    equal = A16.overridden({"prescriptive_minimum_in": (15.0, "a test")})
    found = prescriptive(equal, 0.9)
    assert found.minimum_m == found.value_m
    assert found.governs.name == "FORMULA"
    assert prescriptive(A16, 0.7).governs.name == "MINIMUM"


@pytest.mark.parametrize(
    ("key", "value", "words"),
    [
        ("analysis_factor", -1.0, "analysis_factor is -1.0; enter a number from 1 to 10"),
        ("analysis_floor", 1.01, "analysis_floor is 1.01; enter a number from 0 to 1"),
        ("analysis_factor", float("nan"), "analysis_factor is nan; enter a number from 1 to 10"),
        ("max_stories", 6.5, "max_stories is 6.5; enter a whole number from 1 to 200"),
        ("separation_edge", 10**400, "; enter a number from 0.1 to 10"),
    ],
)
def test_an_override_outside_of_its_range_is_refused(key, value, words):
    (problem,) = input_problems(PV1.overridden, {key: (value, "a reason")})
    assert words in problem
    assert len(problem) < 200


def test_the_ac156_spectrum_is_straight_on_log_axes_and_that_of_published_sites():
    spectrum = ac156_horizontal(E16, s_ds_g=1.0, z_over_h=1.0)
    freq = np.array([0.1, 0.2, 0.5, 1, 1.3, 8.3, 10, 15, 20, 33.3, 50])
    expected = [0.16, 0.2981, 0.6786, 1.2642, 1.6, 1.6, 1.5394, 1.4155, 1.3336, 1.2, 1.2]
    assert spectrum.at(freq) == pytest.approx(expected, abs=6e-5)
    spectrum = ac156_horizontal(E16, s_ds_g=1.26, z_over_h=1.0)
    assert [round(v, 2) for v in spectrum.sa_g[[1, 3]]] == [2.02, 1.51]
    edition_22 = ac156_horizontal(E22, s_ds_g=1.0, z_over_h=1.0)
    assert edition_22.sa_g[[1, 3]] == pytest.approx([1.6, 0.4 * 3.5 / 1.3], rel=1e-12)
    assert ac156_horizontal(E22, s_ds_g=1.0, z_over_h=0.0).sa_g[[1, 3]].tolist() == [1.0, 0.4]
    assert ac156_vertical(s_ds_g=1.0).sa_g[[1, 3]] == pytest.approx([0.67, 0.27], rel=1e-12)
    horizontal = partial(ac156_horizontal, E16, s_ds_g=1.0, z_over_h=1.0)
    for of in (horizontal, partial(ac156_vertical, s_ds_g=1.0)):
        line, reciprocal = of(tail=Tail.AC156), of(tail=Tail.RECIPROCAL)
        period = np.array([1.0, 2.0, 5.0, 10.0])
        flexible = line.sa_g[1]
        assert reciprocal.at(1 / period) == pytest.approx(flexible / 1.3 / period, rel=1e-12)
        assert line.at(1 / period[-1:]) == pytest.approx(0.1 * flexible, rel=1e-12)
        assert np.array_equal(reciprocal.sa_g[1:], line.sa_g[1:])
    assert "1/T" in Tail.RECIPROCAL.sentence
    assert "AC156 line" in Tail.AC156.sentence


# The least and the greatest number allowed, and of those that are usual.
RANGES = {
    "prescriptive_factor_in": (1, 600, 30, 120),
    "analysis_max_slope_deg": (0, 30, 1.4312, 14),
    "analysis_factor": (1, 10, 1, 2.2),
    "separation_edge": (0.1, 10, 0.75, 4),
    "parapet_over_cg_in": (0, 240, 0, 12),
}


def test_ranges_are_those_of_the_table_with_zero_where_it_is_allowed():
    for key, wanted in RANGES.items():
        allowed, common = ALLOWED[key], usual(key)
        found = (allowed.low, allowed.high, common.low, common.high)
        assert found == pytest.approx(wanted, rel=1e-4), key
    zero = {"parapet_over_cg_in": replace(VALUE, value=0.0)}
    nothing = {
        name: replace(rules, values=rules.values | zero) for name, rules in RULE_SETS.items()
    }
    assert usual("parapet_over_cg_in", nothing) == ALLOWED["parapet_over_cg_in"]


VALUE = RULE_SETS["SEAOC PV1-2012"].values["parapet_over_cg_in"]


def test_a_range_has_its_ends_and_requires_less_beyond_its_limit():
    most, least = Allowed(0, 10, "of a test", is_maximum=True), Allowed(0, 10, "of a test")
    assert [most.lowers(value, 5.0) for value in (4.0, 5.0, 6.0)] == [False, False, True]
    assert [least.lowers(value, 5.0) for value in (4.0, 5.0, 6.0)] == [True, False, False]
    whole = Allowed(1, 4, "of a test", is_whole=True)
    assert list(filter(whole.has, (0.0, 1.0, 2.5, 4.0, 5.0))) == [1.0, 4.0]
    confirmed = replace(VALUE, confidence=Confidence.CONFIRMED)
    assert confirmed.verified
    assert not replace(confirmed, reason="agreed").verified
    assert not replace(confirmed, confidence=Confidence.KNOWN).verified


def made(found, limit=20.0, **more):
    return Limit(title="", found=found, limit=limit, **{"is_at_least": True} | more)


def test_limits_have_units_and_say_whose_they_are():
    assert [measure.unit for measure in Measure] == ["deg", "m", "s", "mps", "", ""]
    assert made(1.0, provision=PROGRAM).is_program_limit
    assert not made(1.0, provision=MOTIONS).is_program_limit
    assert not MOTIONS.verified
    assert PROGRAM.verified


@pytest.mark.parametrize("is_at_least", [True, False])
def test_a_value_equal_within_rounding_is_permitted(is_at_least):
    side = -1.0 if is_at_least else 1.0
    assert made(20.0 * (1.0 + side * 5e-10), is_at_least=is_at_least).ok
    assert not made(20.0 * (1.0 + side * 2e-9), is_at_least=is_at_least).ok
    assert not made(math.nan, is_at_least=is_at_least, may_exceed=True).ok
