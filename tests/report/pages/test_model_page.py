"""The page on the models: which is used, why, and what it neglects."""

from dataclasses import replace

import numpy as np
import pytest

import scenes
import stand_in
from printed import printed
from report.sheet.schema.choices import Direction
from solver.sliding.least_model import Model
from solver.sliding.uplift import Supports, tipping, uplift

pytestmark = pytest.mark.quick


def scene(shaking=None, **changes):
    return scenes.package(shaking, objects=[], clearances=[], **changes)


def table(package, title):
    return printed(package, "model").table(title)


USED, NEGLECTED, CHECKS = "Model used, by array", "Neglected effects", "Checks independent"


def alone(motions):
    return tuple(replace(motion, ay_mps2=np.empty(0)) for motion in motions)


def test_a_model_that_is_not_adequate_is_ng():
    package = scene(
        scenes.motions(3, 12.0),
        arrays=[stand_in.array("A1", 2.0, mu=0.3, model="one axis")],
        options={"peer_reviewed": True},
    )
    item = package.assessment.arrays[0]
    assert item.chosen_toward_m(Direction.ANY) > 1.1 * item.design_m
    assert printed(package, "model").line("Array A1: the requested model, one axis, gives")
    assert not package.assessment.verdict.is_permitted
    assert not package.assessment.array_verdict(item).is_permitted


@pytest.mark.nightly
def test_a_neglected_vertical_component_has_its_exact_effect():
    gentle = tuple(replace(m, az_mps2=m.az_mps2 * 1e-3) for m in alone(scenes.motions(3, 8.0)))
    package = scene(gentle, arrays=[stand_in.array("A1", 1.0, mu=0.5)])
    item = package.assessment.arrays[0]
    solutions = [run.solution for m in item.motions for run in m.runs]
    assert {solution.model for solution in solutions} == {Model.ONE_AXIS}
    (row,) = table(package, NEGLECTED).cells
    effect = max(solution.next_effect_m for solution in solutions)
    assert 0.0 < effect < 2e-3
    assert (row[1], row[3], row[-1]) == (
        "Vertical shaking", f"{1e3 * effect:.0f}", "exact: both models run"
    )  # fmt: skip


def test_a_model_that_is_run_or_not_requested_is_said_so():
    gentle, full = alone(scenes.motions(2, 8.0))
    gentle = replace(gentle, az_mps2=gentle.az_mps2 * 1e-3)
    package = scene((gentle, full, full), arrays=[stand_in.array("A1", 1.0, mu=0.5)])
    models = {run.solution.model for m in package.assessment.arrays[0].motions for run in m.runs}
    assert models == {Model.ONE_AXIS, Model.ONE_AXIS_VERTICAL}
    assert float(table(package, NEGLECTED).cells[0][2]) < 0.1
    one = tuple(replace(motion, signs=(1,)) for motion in scenes.motions())
    package = scene(one)
    said = printed(package, "model")
    assert "in the polarities that the workbook requests: two runs for each motion" in said
    assert "in either polarity: four runs for each motion" in printed(scene(), "model")


def test_where_nothing_slips_nothing_is_neglected_and_the_largest_demand_said():
    still = tuple(replace(motion, scale=1e-3) for motion in scenes.motions(3, 4.0))
    package = scene(still, arrays=[stand_in.array("A1", 1.0)])
    assert table(package, USED).row("A1")["Model"] == "0, no slip"
    assert table(package, NEGLECTED).row("A1")["Neglected"] == "None: no slip"
    still = [replace(m, scale=0.02 * k) for k, m in enumerate(scenes.motions(3, 4.0), start=1)]
    row = table(scene(tuple(still[::-1]), arrays=[stand_in.array("A1", 1.0)]), USED).row("A1")
    assert row["Model"] == "0, no slip"
    assert f"the required friction coefficient, {row['Demand']}," in row["Reason"]


def test_a_stable_array_has_its_tipping_ratios():
    """Of the whole motion, also where the model of the array neglects its vertical component."""
    arrays = [
        stand_in.array("A1", 1.0, mu=0.5, model="one axis"), stand_in.array("A2", 1.0, mu=0.5)
    ]  # fmt: skip
    package = scene(arrays=arrays)
    (row,) = table(package, CHECKS).cells
    assert row[0] == "A1, A2"  # all of their numbers are equal
    forced, _ = package.assessment.arrays
    modeled = min(run.result.n_min_g for motion in forced.motions for run in motion.runs)
    assert forced.uplift.n_min_g < modeled
    for array in package.assessment.arrays:
        capacity = 0.5 * array.array.support_spacing_m / array.array.cg_height_m
        held = min(array.tipping.demand, array.array.mu) / capacity
        assert array.tipping.at_rest_ratio == pytest.approx(held, rel=1e-12)
        runs = [run for motion in array.motions for run in motion.runs]
        assert array.tipping.demand == max(run.solution.friction_demand for run in runs)
        assert array.uplift.n_min_g == min(uplift(run.scene).n_min_g for run in runs)
        supports = Supports(
            height_m=array.array.cg_height_m, spacing_m=array.array.support_spacing_m
        )
        assert array.tipping.ratio == max(tipping(run.scene, supports).ratio for run in runs)
        assert row[4] == f"{array.tipping.ratio * capacity:.2f}"
        assert row[5] == f"{capacity:.2f}"
        assert (row[2], row[8]) == ("none", "OK")


@pytest.mark.parametrize(
    ("n_vertical", "uplift_s", "text"),
    [
        (0, "not checked", "No motion has a vertical component: uplift is not checked"),
        (2, "none", "2 of 3 motions have a vertical component: uplift is not checked for the"),
        (3, "none", ""),
    ],
)
def test_uplift_is_said_to_be_checked_only_under_motions_with_a_vertical(
    n_vertical, uplift_s, text
):
    found = (*scenes.motions()[:n_vertical], *scenes.level()[n_vertical:])
    page = printed(scene(found, arrays=[stand_in.array("A1", 0.5)]), "model")
    assert page.table(CHECKS).row("A1")["Uplift time [s]"] == uplift_s
    assert ("uplift is not checked" in page) is bool(text)
    assert text in page


def test_an_array_that_begins_to_tip_is_not_ok_and_is_named():
    tall = stand_in.array("A1", 0.5, cg_height_m=0.9, support_spacing_m=0.5)
    package = scene(scenes.motions(3, 6.0), arrays=[tall])
    done = package.assessment
    assert done.arrays[0].tipping.ratio > 1.0
    assert not done.verdict.is_permitted
    assert not done.array_verdict(done.arrays[0]).is_permitted
    assert "begins to tip" in printed(package, "summary")
    assert table(package, CHECKS).row("A1")["Verdict"] == "NG"
