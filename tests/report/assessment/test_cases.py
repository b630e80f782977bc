"""Arrays with another input in place of one that is not certain, held against runs with it."""

import math
from dataclasses import replace
from functools import partial

import pytest

import scenes
import stand_in
from report.assessment.arrays import Route
from report.assessment.evidence import building_case, cases, support
from report.assessment.verdict import Requirement, Verdict, as_one
from solver.rules.limit import Consequence

pytestmark = pytest.mark.quick

LAW = {"mu": 0.20, "mu_fast": 0.45, "mu_rate_s_per_m": 20.0}
ROWS = [
    {"id": f"M{k}", "record": "x", "transverse": "y", "recorded_at": "ground", "scaling": "factor"}
    | {"scale_value": 1.4}
    for k in range(1, 4)
]


def assessed(provided_m, **changes):
    gaps = [stand_in.clearance("A1", "RTU-1", provided_m)]
    given = {"arrays": [stand_in.array("A1", 2.0)], "clearances": gaps, "options": scenes.REVIEW}
    return scenes.package(scenes.motions(3), **given | changes).assessment


def by_velocity(provided_m):
    return assessed(provided_m, arrays=[stand_in.array("A1", 2.0, **LAW)])


@pytest.fixture(scope="module")
def alone_m():
    """The design displacement with the low-velocity coefficient, of a project of its own."""
    return assessed(9.0, arrays=[stand_in.array("A1", 2.0, mu=0.20)]).arrays[0].design_m


def test_the_low_velocity_coefficient_is_a_case_only_where_it_changes_something(alone_m):
    done = by_velocity(0.99 * alone_m)
    assert done.clearances[0].ok
    (case,) = support(done).cases
    assert case.array.design_m == pytest.approx(alone_m)
    assert [gap.verdict for gap in case.short] == [Verdict.NG]
    words = case.words(us_first=True)
    assert words.startswith("A1 with μ = 0.20 at every velocity: design displacement ")
    assert ", NG: A1 to RTU-1 " in words
    done = by_velocity(1.01 * alone_m)
    assert done.arrays[0].prescriptive.value_m > alone_m
    assert support(done).cases == ()
    below = replace(done.arrays[0].prescriptive, value_m=0.99 * alone_m)
    slow = done.low_velocity
    exceeded = replace(slow, arrays=(replace(slow.arrays[0], prescriptive=below),))
    (case,) = cases(replace(done, low_velocity=exceeded), ())
    assert case.words(us_first=False).endswith(", its clearance OK.")


@pytest.fixture(scope="module")
def grounded():
    building = {"period_s": 0.5, "damping_percent": 5.0}
    data = stand_in.project(
        arrays=[stand_in.array("A1", 2.0)],
        clearances=[stand_in.clearance("A1", "RTU-1", 2.0)],
        motions=ROWS,
        building=building,
        options=scenes.REVIEW,
    )
    done = stand_in.assessed(scenes.grounded(data, scenes.motions(3, peak_g=0.5), transverse=True))
    array = done.arrays[0]
    by_analysis = {"route": Route.ANALYSIS, "is_permitted": True, "floor_m": 0.0}
    array = replace(array, design_m=array.analysis.value_m, **by_analysis)
    return replace(done, arrays=(array,)), support(done)


def test_the_building_case_is_the_farthest_or_the_variation_without_a_value(grounded):
    done, evidence = grounded
    building, value = max(evidence.building[1:], key=lambda pair: pair[1].value_m)
    assert value.value_m > done.arrays[0].design_m
    case = building_case(done, evidence.building)
    assert case.array.design_m == value.value_m  # peer reviewed: no floor
    assert case.gaps[0].required_m == pytest.approx(value.value_m * case.gaps[0].factor)
    if building.damping_percent == 5.0:
        assert case.changed == f"{building.period_s:.2f} s as the period of the building"
    else:
        assert case.changed == f"{building.damping_percent:.1f} % damping of the building"
    used, (building, value), *others = evidence.building
    lifting = building, replace(value, value_m=math.nan)
    for order in ((lifting, *others), (*others, lifting)):
        (case,) = cases(done, (used, *order))
        assert math.isnan(case.array.design_m)
        assert ": no design displacement" in case.words(us_first=True)


def test_without_a_building_or_where_it_matters_not_there_is_no_building_case(grounded):
    done, evidence = grounded
    assert building_case(done, ()) is None
    used = evidence.building[0]
    assert building_case(done, (used, used)) is None
    directional = replace(done, arrays=(replace(done.arrays[0], by_direction=True),))
    assert building_case(directional, evidence.building) is None


row = partial(
    Requirement,
    id="x",
    title="Friction",
    limit="tests",
    basis="tests",
    is_satisfied=False,
    consequence=Consequence.CONDITION,
)


def test_rows_that_ask_the_same_are_one_with_what_each_finds():
    rows = [
        row(subject="A1", found="tested to 4; slides at 62", outcome="One."),
        row(subject="A2", found="tested to 4; slides at 66"),
        row(subject="A3", found="tested to 4; slides at 66", outcome="Three."),
    ]
    found = as_one(rows)
    assert found.found == "tested to 4; A1: slides at 62; A2, A3: slides at 66"
    assert found.outcome == "One. Three."
    assert as_one(rows[1:2]).found == "tested to 4; slides at 66"
    alike = [row(subject=name, found="not given") for name in ("A1", "A2")]
    assert as_one(alike).found == "not given"
