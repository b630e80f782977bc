"""Paths in plan: orientation, common scale, and what a run in one axis or without a value gives."""

import math
import re
from dataclasses import replace

import numpy as np
import pytest

import scenes
from report.figures.history import STEP_IN, PanelScale, hodographs, path_of, thinned

pytestmark = pytest.mark.quick


@pytest.fixture(scope="module")
def array():
    return scenes.package(scenes.motions(3, 12.0)).assessment.arrays[1]


def words(svg):
    return re.findall(r"<text[^>]*>([^<]+)</text>", svg)


def test_the_path_has_its_sides_and_its_farthest_point_at_the_prd(array):
    history = array.motions[0].history()
    turned = replace(history, u_m=np.array([0.0, 3.0]), across_m=np.array([0.0, 4.0]))
    path = path_of(turned)
    assert path.x_m.tolist() == [0.0, 4.0]
    assert path.y_m.tolist() == [0.0, -3.0]
    for run in array.motions:
        # The largest distance between two samples may exceed that at the samples.
        reached_m = np.hypot(*path_of(run.history())).max()
        assert reached_m == pytest.approx(run.governing.prd_m, rel=5e-3)
    paths = [path_of(run.history()) for run in array.motions]
    panel = PanelScale.around(paths)
    for path in paths:
        x = panel.start[0] + path.x_m / panel.m_per_in
        y = panel.start[1] + path.y_m / panel.m_per_in
        assert 0.0 < x.min() <= x.max() < panel.wide_in
        assert -panel.tall_in < y.min() <= y.max() < 0.0


def test_a_run_in_one_axis_is_a_straight_line_and_one_without_a_value_none(array):
    history = replace(array.motions[0].history(), across_m=np.zeros(0))
    assert not path_of(history).x_m.any()
    assert len(path_of(history).x_m) == len(history.u_m)
    history = array.motions[0].history()
    none = replace(history, result=replace(history.result, prd_m=math.nan))
    assert words(hodographs(array.motions[:1], [none], True)).count("none") == 1


@pytest.mark.parametrize(("us_first", "unit"), [(True, "in"), (False, "mm")])
def test_motions_downslope_and_a_round_scale_are_named(array, us_first, unit):
    printed = words(hodographs(array.motions, [m.history() for m in array.motions], us_first))
    assert [run.motion.id for run in array.motions] == printed[: len(array.motions)]
    assert printed[-2] == "downslope"
    assert re.fullmatch(rf"[125]0* {unit}", printed[-1])


def test_thinning_keeps_the_ends_and_no_point_is_farther_than_a_step_from_the_next():
    angle = np.linspace(0.0, 6.0, 5000)
    x, y = np.cos(angle), np.sin(angle)
    x_few, y_few = thinned(x, y)
    assert (x_few[0], y_few[0], x_few[-1], y_few[-1]) == (x[0], y[0], x[-1], y[-1])
    assert len(x_few) == pytest.approx(6.0 / STEP_IN, rel=0.02)
    assert np.hypot(np.diff(x_few), np.diff(y_few)).max() < 1.3 * STEP_IN
