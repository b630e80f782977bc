"""Overrides and departures that require less: a condition each, and a mark on what they change."""

import pytest

import scenes
import stand_in
from report.assessment.verdict import OVERRIDDEN, Verdict, override_rows
from solver.rules.limit import Consequence

pytestmark = pytest.mark.quick


def overrides(**values):
    return [{"provision": key, "value": v, "reason": "agreed"} for key, v in values.items()]


def assessed(options=None, **values):
    return scenes.package(
        scenes.motions(7),
        overrides=overrides(**values),
        options=options or {},
        arrays=[stand_in.array("A1", 0.5), stand_in.array("A2", 2.0, x=120)],
        clearances=[
            stand_in.clearance("A1", "RTU-1", 7 * stand_in.FOOT),
            stand_in.clearance("A2", "S edge", 5 * stand_in.FOOT, "down"),
        ],
    ).assessment


@pytest.mark.parametrize(
    ("key", "less", "more"),
    [
        ("separation_fixed", 0.5, 1.5),
        ("separation_fixed", 0.9, 1.0),  # the number of the rule set
        ("prescriptive_minimum_in", 3.0, 12.0),
        ("prescriptive_min_mu", 0.3, 0.5),
        ("analysis_floor", 0.4, 0.8),
        ("analysis_factor", 1.0, 1.2),
        ("analysis_mean_motions", 3.0, 11.0),
        ("parapet_height_in", 18.0, 30.0),
        ("interconnection_min", 0.05, 0.2),
        ("analysis_max_slope_deg", 10.0, 5.0),
        ("ibc_max_slope_deg", 8.0, 3.0),
        ("max_stories", 8.0, 4.0),
        ("low_profile_in", 48.0, 24.0),
    ],
)
def test_an_override_that_requires_less_is_a_condition(key, less, more):
    (found,) = override_rows(stand_in.project(overrides=overrides(**{key: less})))
    assert (found.is_satisfied, found.consequence) == (False, Consequence.CONDITION)
    assert found.verdict is Verdict.CONDITION
    assert "consent of the authority having jurisdiction" in found.remedy
    assert OVERRIDDEN in found.found
    assert "agreed" in found.found
    assert override_rows(stand_in.project(overrides=overrides(**{key: more}))) == ()


def test_an_override_is_a_row_with_both_numbers_and_a_condition():
    (found,) = override_rows(stand_in.project(overrides=overrides(prescriptive_minimum_in=3.0)))
    assert found.title == "Override of the minimum prescriptive displacement"
    assert (found.found, found.limit) == ("3 in‡, agreed", "≥ 6 in")
    assert found.basis == "PV1-2012"
    (slope,) = override_rows(stand_in.project(overrides=overrides(analysis_max_slope_deg=10.0)))
    assert slope.limit == "≤ 7 deg"
    (departure,) = override_rows(stand_in.project(options=scenes.DEPARTURE))
    assert departure.title == "Displacement by direction"
    assert "Agreed on 2026-02-10" in departure.found
    assert departure.verdict is Verdict.CONDITION
    plain, done = assessed(), assessed(separation_fixed=0.5)
    more = [row for row in done.conditions if row not in plain.conditions]
    assert [row.id for row in more] == ["override"]
    assert [row for row in done.conditions if row not in more] == list(plain.conditions)


@pytest.mark.parametrize(("rule_set", "count"), [("SEAOC PV1-2012", 1), ("ASCE 7-16", 0)])
def test_a_mean_without_factor_departs_from_a_rule_set_that_states_a_statistic(rule_set, count):
    site = stand_in.site(rule_set=rule_set)
    data = stand_in.project(site=site, options={"statistic": "mean"})
    assert len(override_rows(data)) == count
    assert override_rows(stand_in.project(options={"statistic": "1.1 x largest"})) == ()


def marks(done):
    """Marks of the design displacement of each array and of each required separation."""
    return [item.design_mark for item in done.arrays], [gap.mark for gap in done.clearances]


@pytest.mark.parametrize(("factor", "mark"), [(0.5, "‡"), (1.0, ""), (1.5, "‡")])
def test_a_separation_carries_the_mark_of_its_factor(factor, mark):
    done = assessed(separation_fixed=factor)
    assert marks(done) == (["", ""], [mark, ""])
    gap = done.clearances[0]
    assert gap.factor == factor
    assert (gap.design_mark, gap.ratio_words.endswith("‡")) == ("", bool(mark))


def test_a_lowered_floor_marks_what_it_governed_alone():
    """The value from analysis is between the two floors: without the override it would not do."""
    plain = assessed()
    assert (marks(plain), plain.is_overridden) == ((["", ""], ["", ""]), False)
    assert [item.governs for item in plain.arrays] == ["floor", "floor"]
    done = assessed(analysis_floor=0.0)
    assert [item.governs for item in done.arrays] == ["analysis", "analysis"]
    assert marks(done) == (["‡", "‡"], ["‡", "‡"])
    assert all(
        item.design_m < p.design_m for item, p in zip(done.arrays, plain.arrays, strict=True)
    )
    strong = scenes.motions(7, peak_g=6.0)
    lower = overrides(analysis_floor=0.1)
    done = scenes.package(strong, overrides=lower, clearances=[]).assessment
    assert {item.governs for item in done.arrays} == {"analysis"}
    assert not done.is_overridden
    assert "override" in [row.id for row in done.conditions]


def test_a_route_and_the_mean_that_an_override_alone_permits_are_marked():
    done = scenes.package(
        scenes.motions(7),
        arrays=[stand_in.array("A1", 8.0, mu=0.6)],
        clearances=[],
        overrides=overrides(analysis_max_slope_deg=9.0, ibc_max_slope_deg=9.0),
    ).assessment
    assert done.arrays[0].is_permitted
    assert marks(done) == (["‡"], [])
    strong = scenes.motions(11, peak_g=6.0)
    done = scenes.package(strong, options={"statistic": "mean"}, clearances=[]).assessment
    by_analysis = [item for item in done.arrays if item.governs == "analysis"]
    assert by_analysis
    assert all(item.design_mark for item in by_analysis)
