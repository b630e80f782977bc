import math
import re
from dataclasses import replace
from html import unescape

import numpy as np
import pytest

import stand_in
from report.assessment.sensitivity import accuracy
from report.figures.base import load_fonts
from report.pages import accuracy as accuracy_page
from report.pages.registry import package_data
from report.typeset.pdf import TEMPLATES
from solver.rivals.methods import METHODS
from solver.sliding.checked import slide


@pytest.fixture(scope="module", autouse=True)
def fonts():
    load_fonts(TEMPLATES / "fonts")


def made(data=None, shaking=None):
    book = stand_in.book(data, shaking or stand_in.motions(3, seconds=10.0))
    package = package_data(stand_in.assessed(book))
    return book, package, accuracy(package.assessment)


PEER = {"peer_reviewed": True}


@pytest.fixture(scope="module")
def usual():
    """Without the floor, so that friction governs."""
    return made(stand_in.project(options=PEER))


def words(page):
    return " ".join([page["run"], page["plane"], page["method"], *page["sentences"]])


def direct(run, array, **method):
    motion = run.motion
    return slide(
        run.governing.scene.ax_mps2,
        motion.dt_s,
        slope_rad=array.slope_rad,
        mu=array.mu,
        az_mps2=motion.az_mps2 if motion.has_vertical else None,
        scale=motion.scale,
        **method,
    )


def test_each_method_is_run_on_the_governing_scene(usual):
    _, scene, evidence = usual
    assert evidence.rivals.array is scene.governing
    peak = evidence.rivals.motion.governing.result.prd_m
    assert peak == max(m.governing.result.prd_m for m in evidence.rivals.array.motions)
    exact = evidence.rivals.exact.prd_m
    assert evidence.rivals.exact == direct(evidence.rivals.motion, evidence.rivals.array.array)
    assert {run.method.name for run in evidence.rivals.runs} == set(METHODS) - {
        "exact",
        "regularized",
        "paper",
    }
    for run in evidence.rivals.runs:
        again = direct(
            evidence.rivals.motion,
            evidence.rivals.array.array,
            method=run.method.name,
            **run.parameters,
        )
        assert run.result == again
        assert run.error == pytest.approx(abs(again.prd_m - exact) / exact)


def test_the_page_states_that_the_methods_are_compared_along_the_slope(usual):
    _, scene, evidence = usual
    page = accuracy_page.page(scene, evidence)
    peak = evidence.rivals.motion.governing.result.prd_m
    assert f"PRD {peak / 0.0254:.1f} in" in page["run"]
    assert "two axes with vertical" in page["run"]
    assert "All methods are compared on this run along the slope alone" in page["plane"]
    assert f"{evidence.rivals.exact.prd_m / 0.0254:.1f} in" in page["plane"]
    assert "is not a result of this package" in page["plane"]
    assert evidence.rivals.motion.governing.result.error_m < 1e-6
    assert "below 10" in page["plane"]


def test_in_one_axis_the_methods_are_compared_with_the_result_itself():
    alone = tuple(replace(m, ay_mps2=np.empty(0)) for m in stand_in.motions(3, seconds=8.0))
    _, scene, evidence = made(shaking=alone)
    assert evidence.rivals.exact == evidence.rivals.motion.governing.result
    assert accuracy_page.page(scene, evidence)["plane"] == ""


def test_without_vertical_shaking_the_papers_own_method_is_shown():
    level = tuple(
        replace(motion, az_mps2=np.empty(0)) for motion in stand_in.motions(3, seconds=8.0)
    )
    _, scene, evidence = made(shaking=level)
    names = {run.method.name for run in evidence.rivals.runs}
    assert "paper" in names
    assert "adaptive" not in names
    assert "without vertical shaking" in accuracy_page.page(scene, evidence)["run"]


def test_the_same_motion_with_twice_the_samples_gives_the_same_result(usual):
    *_, evidence = usual
    assert evidence.rivals.doubled < 1e-12


def test_the_table_of_methods_agrees_with_the_solver(usual):
    _, scene, evidence = usual
    rows = accuracy_page.page(scene, evidence)["methods"].rows
    exact = direct(evidence.rivals.motion, evidence.rivals.array.array)
    assert rows[0].cells[2] == f"{exact.prd_m / 0.0254:.1f}"
    by_title = {row.cells[0]: row.cells for row in rows[1:]}
    for method in METHODS.values():
        if method.title in by_title:
            outcome = direct(
                evidence.rivals.motion, evidence.rivals.array.array, method=method.name
            )
            cells = by_title[method.title]
            assert cells[2] == f"{outcome.prd_m / 0.0254:.1f}"
            assert cells[-1] == f"{100 * abs(outcome.prd_m / exact.prd_m - 1):.3f}"
    assert len(by_title) == 5


def test_friction_is_changed_by_five_percent_and_all_motions_run_again(usual):
    book, scene, evidence = usual
    for factor, assessed in ((0.95, evidence.less), (1.0, evidence.given), (1.05, evidence.more)):
        for array, item in zip(book.input.arrays, assessed.arrays, strict=True):
            peaks = [
                max(
                    slide(
                        sign * along,
                        motion.dt_s,
                        slope_rad=array.slope_rad,
                        mu=array.mu * factor,
                        ay_mps2=across,
                        az_mps2=motion.az_mps2,
                    ).prd_m
                    for along, across in (
                        (motion.ax_mps2, motion.ay_mps2),
                        (motion.ay_mps2, motion.ax_mps2),
                    )
                    for sign in (1, -1)
                )
                for motion in book.motions
            ]
            assert item.design_m == pytest.approx(1.1 * max(peaks), rel=1e-12)
    rows = accuracy_page.page(scene, evidence)["friction"].rows
    for row, less, more in zip(rows, evidence.less.arrays, evidence.more.arrays, strict=True):
        assert row.cells[2].rstrip("†") == f"{less.design_m / 0.0254:.1f}"
        assert row.cells[6].rstrip("†") == f"{more.design_m / 0.0254:.1f}"


def test_a_sentence_gives_the_effect_of_friction_on_each_array(usual):
    _, scene, evidence = usual
    text = words(accuracy_page.page(scene, evidence))
    for item in scene.assessment.arrays:
        assert item.array.id in text
    a2, less = scene.assessment.arrays[1], evidence.less.arrays[1]
    grown = 100 * (less.design_m / a2.design_m - 1)
    assert grown > 0.1
    assert f"+{grown:.1f} %" in text


def test_clearances_not_satisfied_with_less_friction_are_named():
    def project(provided_m):
        gaps = [stand_in.clearance("A2", "A3", provided_m)]
        return stand_in.project(clearances=gaps, options=PEER)

    _, roomy, _ = made(project(9.0))
    needed = roomy.assessment.clearances[0].required_m
    _, scene, evidence = made(project(needed * 1.001))
    text = words(accuracy_page.page(scene, evidence))
    assert "1 clearance would no longer be satisfied: A2 to A3." in text


def test_a_floor_that_always_governs_is_stated_once():
    arrays = [stand_in.array(name, 0.5, mu=1.2) for name in ("B1", "B2")]
    _, scene, evidence = made(stand_in.project(arrays=arrays, objects=[], clearances=[]))
    text = words(accuracy_page.page(scene, evidence))
    assert "Arrays B1, B2: ±5 % friction does not change" in text
    assert "40.8 in (1036 mm)" in text


def test_where_nothing_slides_there_is_no_chart():
    arrays = [stand_in.array("B1", 0.0, mu=1.5)]
    still = tuple(replace(motion, scale=1e-3) for motion in stand_in.motions(3, seconds=4.0))
    _, scene, evidence = made(stand_in.project(arrays=arrays, objects=[], clearances=[]), still)
    assert evidence.rivals.runs == ()
    page = accuracy_page.page(scene, evidence)
    assert "No sliding along the slope" in page["method"]
    assert page["methods"] is None


def test_a_block_that_lifts_off_has_no_error_and_no_sensitivity():
    up = np.zeros(800)
    up[300:400] = -1.4 * stand_in.G
    lifted = stand_in.motion("LIFT", np.zeros(800), up, signs=(1,))
    _, scene, evidence = made(shaking=(*stand_in.motions(3, seconds=4.0), lifted))
    page = accuracy_page.page(scene, evidence)
    assert "lifts off the roof" in page["method"]
    assert "no permitted design displacement" in words(page)
    assert not re.search(r"\bnan\b", words(page))
    assert math.isnan(evidence.rivals.doubled)


def test_a_failed_run_is_counted_in_the_caption_and_said_in_the_table(usual):
    _, scene, evidence = usual
    first = next(run for run in evidence.rivals.runs if run.is_default)
    failed = replace(first, error=math.nan)
    runs = tuple(failed if run is first else run for run in evidence.rivals.runs)
    changed = replace(evidence, rivals=replace(evidence.rivals, runs=runs))
    assert "1 failed run is not drawn" in accuracy_page.picture(changed.rivals, True).caption
    rows = accuracy_page.page(scene, changed)["methods"].rows
    assert [row.cells[-1] for row in rows].count("failed") == 1


def test_two_charts_are_the_same_bytes_and_name_every_method(usual):
    *_, evidence = usual
    svg = accuracy_page.picture(evidence.rivals, True).svg
    assert svg == accuracy_page.picture(evidence.rivals, True).svg
    for text in ("exact", "linear acceleration", "link, explicit", "normal force frozen"):
        assert f">{text}<" in svg


def test_the_page_is_in_the_package():
    book = stand_in.book(shaking=stand_in.motions(3, seconds=8.0))
    html = unescape(stand_in.html(book))
    section = html[html.index('<h1 id="accuracy">') : html.index('<h1 id="how-sure">')]
    assert "Governing run: array A" in section
    assert "The governing run along the slope alone, by every method" in section
    assert "Design displacement with changed friction" in section
    assert section.count("<img") == 1


@pytest.mark.parametrize(("seconds", "said"), [(4e-5, "10"), (9e-4, "10"), (1.1e-3, "100")])
def test_the_time_of_a_run_is_said_as_a_power_of_ten_well_above_it(seconds, said):
    assert accuracy_page._decade_ms(seconds) == said
    assert float(said) * 1e-3 >= 10 * seconds


def test_a_limit_that_less_friction_breaks_is_named():
    """Two motions are too few: the arrays take the prescriptive route, which asks for 0.40."""
    arrays = [stand_in.array("A1", 0.5, mu=0.41), stand_in.array("A2", 2.0, x=120)]
    data = stand_in.project(arrays=arrays, clearances=[], links=[])
    _, package, evidence = made(data, stand_in.motions(2, seconds=10.0))
    assert [array.id for array, _ in evidence.newly_limited] == ["A1"]
    assert (
        "Friction coefficient, prescriptive route, array A1: with 5 % less friction 0.389, and the "
        "limit is 0.400†: NG." in words(accuracy_page.page(package, evidence))
    )
