import math
import re
from dataclasses import replace

import numpy as np
import pytest

import scenes
import stand_in
from one_by_one import prd_m
from printed import printed
from report.assessment.evidence import accuracy
from report.text.counts import below_mm

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


def test_the_error_is_said_by_its_model_and_none_of_a_block_that_lifts_off(usual):
    scene, _, page = usual
    result = scene.governing.worst.governing.result
    assert 0.0 < result.error_m < 1e-6
    assert f"the error of this PRD is below {below_mm(result.error_m)} (a bound)" in page
    alone = tuple(replace(m, ay_mps2=np.empty(0)) for m in scenes.level())
    _, _, page = made(alone)
    assert "in one axis the solution is exact, event by event" in page
    _, _, page = made((*scenes.motions(3, seconds=4.0), stand_in.lifting(signs=(1,))))
    assert "lifts off the roof" in page
    assert set(page.table("Design displacement with").rows[0].values()) >= {"none"}
    assert not re.search(r"\bnan\b", page)


def inches_up(length_m):
    """To a tenth of an inch, upward, as every design displacement is printed."""
    return f"{math.ceil(length_m / 0.0254 * 10 - 1e-6) / 10:.1f}"


def test_friction_is_changed_by_five_percent_and_all_motions_run_again(usual):
    scene, evidence, page = usual
    for factor, assessed in (
        (0.95, evidence.at_reduced_friction),
        (1.0, evidence.entered),
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
    scene, evidence, _ = usual
    assert evidence.at_reduced_friction is scene.assessment.at_reduced_friction
