"""Other periods and other damping of the building, held against the public solver."""

import math
from dataclasses import replace

import numpy as np
import pytest

import scenes
import stand_in
from one_by_one import prd_m
from printed import printed
from report.assessment.evidence import building_variations
from report.entities.evidence import variation_result
from solver import at_roof, building_of_periods
from solver.sliding.least_model import DEFAULT

pytestmark = pytest.mark.quick

T1_S, T2_S, FACTOR = 0.5, 0.16, 1.4
BUILDING = {"period_s": T1_S, "period_2_s": T2_S, "damping_percent": 3.0}
GROUND = scenes.motions(3, peak_g=0.5)
PLACES = ("ground", "ground", "roof")


@pytest.fixture(scope="module")
def made():
    rows = [
        {"id": f"M{k}", "record": "x", "transverse": "y", "vertical": "z"}
        | {"recorded_at": place, "scaling": "factor", "scale_value": FACTOR}
        for k, place in enumerate(PLACES, start=1)
    ]
    data = stand_in.project(motions=rows, building=BUILDING, options=scenes.REVIEW)
    done = stand_in.assessed(scenes.grounded(data, GROUND, transverse=True))
    return done, building_variations(done)


def alone(motion, building, place):
    """Return a motion as the solver has it at the roof of a building, from scaled records."""
    names = ("ax_mps2", "ay_mps2", "az_mps2")
    ground = replace(motion, **{name: FACTOR * getattr(motion, name) for name in names})
    return at_roof(ground, building) if place == "ground" else ground


@pytest.mark.parametrize(
    ("row", "factor", "damping"), [(0, 1.0, 3), (1, 0.8, 3), (2, 1.2, 3), (3, 1.0, 2), (5, 1.0, 7)]
)
def test_a_variation_is_that_of_separate_runs_through_such_a_building(made, row, factor, damping):
    done, found = made
    building = building_of_periods(
        [factor * T1_S, factor * T2_S], damping=(damping / 100,), stories=done.project.site.stories
    )
    array = done.governing.array
    peaks = [
        prd_m(alone(motion, building, place), array)
        for motion, place in zip(GROUND, PLACES, strict=True)
    ]
    (varied, value), bound = found[row], max(map(DEFAULT.bound_m, peaks))
    assert varied.period_s == pytest.approx(factor * T1_S)
    assert varied.damping_percent == damping
    assert value.mean_m == pytest.approx(np.mean(peaks), abs=bound)
    assert value.largest_m == pytest.approx(max(peaks), abs=bound)
    assert value.value_m == 1.1 * value.largest_m  # of three motions


def test_the_building_as_used_is_first_and_is_that_of_the_design(made):
    done, found = made
    assert found[0][1] is done.governing.analysis
    assert len({value.mean_m for _, value in found}) == 6  # of four dampings one is used
    written = [variation_result(*each).model_dump() for each in found]
    assert written[0] == {
        "period_s": T1_S,
        "damping_percent": 3.0,
        **{name: getattr(found[0][1], name) for name in ("mean_m", "largest_m", "value_m")},
    }


@pytest.mark.nightly
def test_the_page_says_the_range_of_the_means_with_the_statistic_of_seven(made):
    done, found = made
    page = printed(done, "motions")
    table = page.table(f"Array {done.governing.id} with the building as used, in the first row")
    assert table.column("Period [/ used]") == ["1.00", "0.80", "1.20", "1.00", "1.00", "1.00"]
    assert table.column("Damping [% of critical]") == ["3.0", "3.0", "3.0", "2.0", "5.0", "7.0"]
    shares = [value.mean_m / found[0][1].mean_m for _, value in found]
    assert table.column("Mean PRD [/ used]") == [f"{share:.2f}" for share in shares]
    values_mm = [1e3 * value.value_m for _, value in found]  # as a design displacement: upward
    assert table.column("Value from analysis [mm]") == [f"{math.ceil(v - 1e-6)}" for v in values_mm]
    assert f"is {min(shares):.2f} to {max(shares):.2f} times that used" in str(page)
    for _, value in building_variations(scenes.shipped("school")):
        assert value.value_m == pytest.approx(1.1 * value.mean_m)


def test_the_slowest_building_is_made_no_slower_and_without_ground_motions_none_is_varied():
    rows = [{"id": f"M{k}", "record": "x", "recorded_at": "ground"} for k in (1, 2, 3)]
    data = stand_in.project(motions=rows, building={"period_s": 10.0})
    found = building_variations(stand_in.assessed(scenes.grounded(data, GROUND)))
    assert [building.period_s for building, _ in found[:4]] == [10.0, 8.0, 10.0, 10.0]
    assert building_variations(scenes.package().assessment) == ()
