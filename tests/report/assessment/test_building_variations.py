"""Other periods and other damping of the building, held against the public solver."""

from dataclasses import replace

import numpy as np
import pytest

import scenes
import stand_in
from one_by_one import prd_m
from printed import printed
from report.assessment.building_variations import building_variations
from solver import at_roof, building_of_periods
from solver.sliding.least_model import DEFAULT

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
    item, bound = found[row], max(map(DEFAULT.bound_m, peaks))
    assert (item.period_s, item.damping_percent) == (pytest.approx(factor * T1_S), damping)
    assert item.mean_prd_m == pytest.approx(np.mean(peaks), abs=bound)
    assert item.largest_prd_m == pytest.approx(max(peaks), abs=bound)
    # These motions do not qualify for a value from analysis.
    assert item.design_m == max(done.governing.prescriptive.value_m, item.largest_prd_m)


def test_the_building_as_used_is_first_and_is_that_of_the_design(made):
    done, (used, *others) = made
    assert len(others) == 5  # of four dampings one is used
    assert used.mean_prd_m == done.governing.analysis.mean_m
    assert used.design_m == done.governing.design_m
    assert len({each.mean_prd_m for each in (used, *others)}) == 6


def test_the_page_says_the_range_of_the_means(made):
    done, (used, *others) = made
    page = printed(done, "motions")
    table = page.table(f"Array {done.governing.id} with other periods and other damping")
    assert table.column("Change") == [
        "none, as used", "period −20 %", "period +20 %", "damping", "damping", "damping"
    ]  # fmt: skip
    shares = [each.mean_prd_m / used.mean_prd_m for each in (used, *others)]
    assert table.column("Mean PRD [/ used]") == [f"{share:.2f}" for share in shares]
    assert f"is {min(shares):.2f} to {max(shares):.2f} times that used" in str(page)


def test_a_building_at_the_longest_period_is_made_no_slower():
    rows = [{"id": f"M{k}", "record": "x", "recorded_at": "ground"} for k in (1, 2, 3)]
    data = stand_in.project(motions=rows, building={"period_s": 10.0})
    found = building_variations(stand_in.assessed(scenes.grounded(data, GROUND)))
    assert [each.period_s for each in found] == [10.0, 8.0, 10.0, 10.0, 10.0]


def test_a_design_by_analysis_has_the_statistic_of_the_varied_runs():
    """Seven motions and a peer review: 1.1 times the mean."""
    for item in building_variations(scenes.shipped("school")):
        assert item.design_m == pytest.approx(1.1 * item.mean_prd_m)


def test_without_ground_motions_no_building_is_varied():
    assert building_variations(scenes.package().assessment) == ()
