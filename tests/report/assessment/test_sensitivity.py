import math
import re
from dataclasses import replace
from html import unescape

import numpy as np
import pytest

import scenes
import stand_in
from one_by_one import prd_m, slid
from printed import printed
from report.assessment.sensitivity import accuracy
from report.figures.accuracy import work_precision
from solver.rivals.methods import METHODS

pytestmark = pytest.mark.quick


def made(shaking=None, **changes):
    """A package, what is found of its accuracy, and the page."""
    package = scenes.package(shaking, **changes)
    found = accuracy(package.assessment)
    return package, found, printed(package, "accuracy", accuracy=found)


PEER = {"peer_reviewed": True}


@pytest.fixture(scope="module")
def usual():
    """Without the floor, so that friction governs."""
    return made(scenes.motions(3, seconds=10.0), options=PEER)


def direct(rivals, **method):
    """The governing run along the slope alone, by the public solver."""
    along = rivals.motion.governing.scene.ax_mps2
    return slid(rivals.motion.motion, along, np.empty(0), rivals.array.array, **method)


def test_each_method_is_run_on_the_governing_scene(usual):
    scene, evidence, _ = usual
    assert evidence.rivals.array is scene.governing
    peak = evidence.rivals.motion.governing.result.prd_m
    assert peak == max(m.governing.result.prd_m for m in evidence.rivals.array.motions)
    exact = evidence.rivals.exact.prd_m
    assert evidence.rivals.exact == direct(evidence.rivals)
    assert evidence.rivals.motion.governing.result.error_m < 1e-6
    names = {run.method.name for run in evidence.rivals.runs}
    assert names == set(METHODS) - {"exact", "regularized", "paper"}
    for run in evidence.rivals.runs:
        again = direct(evidence.rivals, method=run.method.name, **run.parameters)
        assert run.result == again
        assert run.error == pytest.approx(abs(again.prd_m - exact) / exact)


@pytest.mark.nightly
def test_in_one_axis_the_methods_are_compared_with_the_result_itself():
    alone = tuple(replace(m, ay_mps2=np.empty(0)) for m in scenes.motions())
    _, evidence, page = made(alone)
    assert evidence.rivals.exact == evidence.rivals.motion.governing.result
    assert "along the slope alone, without" not in page


def test_without_vertical_shaking_the_papers_own_method_is_shown():
    _, evidence, page = made(scenes.level())
    names = {run.method.name for run in evidence.rivals.runs}
    assert "paper" in names
    assert "adaptive" not in names
    assert "without vertical shaking" in page.line("Governing run")


def test_the_same_motion_with_twice_the_samples_gives_the_same_result(usual):
    assert usual[1].rivals.doubled < 1e-12


def test_the_table_of_methods_agrees_with_the_solver(usual):
    _, evidence, page = usual
    rows = page.table("The governing run").cells
    exact = direct(evidence.rivals)
    assert rows[0][2] == f"{exact.prd_m / 0.0254:.1f}"
    by_title = {row[0]: row for row in rows[1:]}
    for method in METHODS.values():
        if method.title in by_title:
            outcome = direct(evidence.rivals, method=method.name)
            cells = by_title[method.title]
            assert cells[2] == f"{outcome.prd_m / 0.0254:.1f}"
            assert cells[-1] == f"{100 * abs(outcome.prd_m / exact.prd_m - 1):.3f}"
    assert len(by_title) == 5


def inches_up(length_m):
    """To a tenth of an inch, upward, as every design displacement is printed."""
    return f"{math.ceil(length_m / 0.0254 * 10 - 1e-6) / 10:.1f}"


def test_friction_is_changed_by_five_percent_and_all_motions_run_again(usual):
    scene, evidence, page = usual
    for factor, assessed in (
        (0.95, evidence.at_reduced_friction),
        (1.0, evidence.given),
        (1.05, evidence.at_increased_friction),
    ):
        for array, item in zip(scene.data.arrays, assessed.arrays, strict=True):
            motions = scene.assessment.shaking.motions
            peaks = [prd_m(motion, array, mu=array.mu * factor) for motion in motions]
            assert item.design_m == pytest.approx(1.1 * max(peaks), rel=1e-12)
    rows = page.table("Design displacement with").rows
    for row, less, more in zip(
        rows,
        evidence.at_reduced_friction.arrays,
        evidence.at_increased_friction.arrays,
        strict=True,
    ):
        assert row["5 % less [in]"].rstrip("†") == inches_up(less.design_m)
        assert row["5 % more [in]"].rstrip("†") == inches_up(more.design_m)


def test_the_runs_with_less_friction_are_those_of_the_conditions(usual):
    scene, evidence, _ = usual
    assert evidence.at_reduced_friction is scene.assessment.at_reduced_friction


@pytest.mark.nightly
def test_where_nothing_slides_there_is_no_chart():
    arrays = [stand_in.array("B1", 0.0, mu=1.5)]
    still = tuple(replace(motion, scale=1e-3) for motion in scenes.motions(3, seconds=4.0))
    _, evidence, page = made(still, arrays=arrays, objects=[], clearances=[])
    assert evidence.rivals.runs == ()
    assert "No sliding along the slope" in page
    assert "by every method" not in page
    assert "[Chart" not in page


def test_a_block_that_lifts_off_has_no_error_and_no_sensitivity():
    _, evidence, page = made((*scenes.motions(3, seconds=4.0), stand_in.lifting(signs=(1,))))
    assert "lifts off the roof" in page
    assert "no permitted design displacement" in page
    assert not re.search(r"\bnan\b", page)
    assert math.isnan(evidence.rivals.doubled)


def test_a_failed_run_is_counted_in_the_caption_and_said_in_the_table(usual):
    scene, evidence, _ = usual
    first = next(run for run in evidence.rivals.runs if run.is_default)
    failed = replace(first, error=math.nan)
    runs = tuple(failed if run is first else run for run in evidence.rivals.runs)
    changed = replace(evidence, rivals=replace(evidence.rivals, runs=runs))
    page = printed(scene, "accuracy", accuracy=changed)
    assert "1 failed run is not drawn" in page
    assert page.table("The governing run").column("Error in PRD [%]").count("failed") == 1


def test_two_charts_are_the_same_bytes_and_name_every_method_as_the_table_does(usual):
    scene, evidence, _ = usual
    svg = work_precision(evidence.rivals)
    assert svg == work_precision(evidence.rivals)
    page = printed(scene, "accuracy", accuracy=evidence)
    methods = page.table("The governing run").column("Method")
    drawn = [unescape(text) for text in re.findall(r">([^<>]+)</text>", svg)]
    assert [text for text in drawn if text in methods] == methods
    assert methods[0] == "Exact, event by event"


def test_the_chart_of_errors_has_one_axis_of_powers_of_ten(usual):
    drawn = re.findall(r">([^<>]+)</text>", work_precision(usual[1].rivals))
    assert [text for text in drawn if text.startswith("Error")] == ["Error in PRD [%]"]
    powers = [text for text in drawn if text.startswith("10") and text[2:] and text != "100"]
    assert powers == ["10⁻¹⁴", "10⁻¹⁰", "10⁻⁶", "10⁻²", "10²"]


@pytest.mark.parametrize(("seconds", "said"), [(4e-5, "10"), (9e-4, "10"), (1.1e-3, "100")])
def test_the_time_of_a_run_is_said_as_a_power_of_ten_well_above_it(usual, seconds, said):
    scene, evidence, _ = usual
    timed = replace(evidence, rivals=replace(evidence.rivals, seconds=seconds))
    page = printed(scene, "accuracy", accuracy=timed)
    assert f"A run took less than {said} ms." in page
    assert float(said) * 1e-3 >= 10 * seconds
