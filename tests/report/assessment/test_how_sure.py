"""What friction, slope and direction change: grids, margins, turned shaking and accuracy."""

import math
import re

import numpy as np
import pytest

from fixtures import assessments, project_parts, projects
from fixtures.marks import by_day
from fixtures.pages import page_of
from fixtures.single_runs import prd_m, slid
from fixtures.spaces import spaced
from report.assessment.support.response_surface import surface
from report.assessment.support.shifted_friction import accuracy
from report.assessment.support.uncertainty import uncertainty
from report.text.error_text import below_mm
from solver.model import Friction

PEER = project_parts.REVIEW
SHORT = assessments.motions()


def made(found=SHORT, **changes):
    return assessments.package(found, **{"options": PEER} | changes).assessment


@pytest.fixture(scope="module")
def usual():
    assessment = made()
    return assessment, uncertainty(assessment)


@pytest.fixture(scope="module")
def grid(usual):
    return surface(usual[0], usual[0].governing)


def mean_m(governing, **changes):
    """The mean PRD of an array over its motions, each in its governing orientation, solved."""
    peaks = []
    for run in governing.motions:
        motion, orientation = run.motion, run.governing.orientation
        pair = (motion.ax_mps2, motion.ay_mps2)
        along, across = pair[::-1] if orientation.is_transverse else pair
        peaks.append(
            slid(motion, orientation.polarity * along, across, governing.array, **changes).prd_m
        )
    return sum(peaks) / len(peaks)


def test_the_grid_is_around_the_arrays_and_agrees_with_runs_one_by_one(usual, grid):
    assessment, _ = usual
    assert grid.mean_m.shape == (6, 8)
    mus = [one.array.mu for one in assessment.arrays]
    slopes = [one.array.slope_rad for one in assessment.arrays]
    assert grid.mus[0] < min(mus) < max(mus) < grid.mus[-1]
    assert grid.slopes_rad[0] <= min(slopes) < max(slopes) < grid.slopes_rad[-1]
    assert assessment.governing.array.mu in grid.mus
    assert (np.diff(grid.mus) > 0).all()
    assert (np.diff(grid.slopes_rad) > 0).all()
    assert grid.n_runs == 6 * 8 * 3
    governing = assessment.governing
    for row, column in ((0, 0), (5, 0), (3, 4), (5, 7)):
        point = {"mu": float(grid.mus[column]), "slope_rad": float(grid.slopes_rad[row])}
        assert grid.mean_m[row, column] == pytest.approx(mean_m(governing, **point), rel=2e-3)
    row = int(np.argmin(abs(grid.slopes_rad - governing.array.slope_rad)))
    column = int(np.argmin(abs(grid.mus - governing.array.mu)))
    assert grid.mean_m[row, column] == pytest.approx(governing.analysis.mean_m, rel=2e-3)


# In the second and the third the governing headings pass a value that other headings refute.
@pytest.mark.parametrize(("seed", "share"), by_day([(11, 1.3), (12, 1.25), (28, 1.7)], 1))
def test_a_margin_satisfies_with_all_runs_and_one_hundredth_less_does_not(seed, share):
    found = assessments.motions(seed=seed)
    (roomy,) = made(found, clearances=[projects.clearance("A2", "A3", 9.0)]).clearances
    close = projects.clearance("A2", "A3", share * roomy.required_m)
    every = uncertainty(made(found, clearances=[close])).margins
    searched = [one for one in every if not one.is_beyond]
    assert searched
    for margin in searched:
        array, gap, mu = margin.array.array, margin.gap, margin.minimum_mu
        there, below = (
            1.1 * max(prd_m(motion, array, mu=each) for motion in found) for each in (mu, mu - 0.01)
        )
        assert margin.limited_by == "clearance"
        assert there <= gap.clearance.provided_m / gap.factor < below
        assert margin.required_m == pytest.approx(gap.factor * there, rel=1e-5)


def test_margins_are_of_each_array_with_a_permitted_route():
    gaps = [projects.clearance("A2", "A3", 0.05), projects.clearance("A1", "RTU-1", 9.0)]
    found = uncertainty(made(clearances=gaps))
    listed = [(one.number, one.array.id) for one in found.margins]
    assert listed == [(1, "A2"), (1, "A3"), (2, "A1")]
    assert math.isnan(found.margins[0].minimum_mu)
    assert math.isnan(found.margins[1].minimum_mu)
    assert found.margins[2].is_beyond
    assert [one.limited_by for one in found.margins] == ["—", "—", "search"]
    assert found.margins[2].minimum_mu == pytest.approx(0.23)  # half of 0.45, in whole hundredths
    first, second, across, own = uncertainty(projects.unpermitted()).margins
    for margin in (first, second, across):  # the second and third are of one clearance
        assert math.isnan(margin.minimum_mu)
    assert own.array.id == "A2"
    assert own.minimum_mu == 0.40
    assert own.limited_by == "Friction coefficient, prescriptive procedure"


def test_turned_and_reversed_shaking_agree_with_the_public_solver(usual):
    assessment, found = usual
    array, motion = assessment.governing.array, found.motion.motion
    assert len(found.turned) == 12
    assert not any(turned.angle_deg % 90 == 0 for turned in found.turned)
    for turned in found.turned[::5]:
        angle = math.radians(turned.angle_deg)
        both = np.array([motion.ax_mps2, motion.ay_mps2])
        cs, sn = math.cos(angle), math.sin(angle)
        along, across = np.array([[cs, -sn], [sn, cs]]) @ both
        wanted = slid(motion, along, across, array).prd_m
        assert turned.result.prd_m == pytest.approx(wanted, rel=0.006)
    assert found.worst.result.prd_m == max(turned.result.prd_m for turned in found.turned)
    largest = prd_m(motion, array, az_mps2=-motion.az_mps2)
    assert found.reversed_m == pytest.approx(largest, rel=1e-5)


@pytest.mark.quick
def test_one_component_and_blocks_that_lift_off_leave_holes():
    assessment = made(assessments.along(SHORT), clearances=[])
    found = uncertainty(assessment)
    assert found.margins == ()
    assert found.turned == ()
    assert math.isnan(found.reversed_m)
    assert (surface(assessment, assessment.governing).mean_m > 0).all()
    lifting = made(tuple(projects.lifting(f"L{k}", signs=(1,)) for k in range(3)))
    assert np.isnan(surface(lifting, lifting.governing).mean_m).all()
    assert all(math.isnan(one.minimum_mu) for one in uncertainty(lifting).margins)


def test_a_law_by_velocity_is_scaled_as_a_whole_and_the_other_arrays_are_named():
    law = {"mu_rate_s_per_m": 20.0}
    arrays = [
        projects.array("A1", 0.5, mu=0.6),
        projects.array("A2", 2.0, mu=0.45, mu_fast=0.54, **law),
        projects.array("A3", 3.0, mu=0.3, mu_fast=0.36, **law),
    ]
    assessment = made(arrays=arrays, clearances=[])
    found = surface(assessment, assessment.governing)
    assert assessment.governing.id == "A3"
    assert found.others == ("A1",)
    mu = float(found.mus[-1])
    friction = Friction(mu_slow=mu, mu_fast=1.2 * mu, rate_s_per_m=20.0, mu_static=mu)
    wanted = mean_m(assessment.governing, mu=friction, slope_rad=float(found.slopes_rad[-1]))
    assert found.mean_m[-1, -1] == pytest.approx(wanted, rel=2e-3)


def paged(shaking=None, **changes):
    """A package, what is found of its accuracy, and the page."""
    package = assessments.package(shaking, **changes)
    found = accuracy(package.assessment)
    return package, found, page_of(package, "accuracy", accuracy=found)


@pytest.fixture(scope="module")
def unfloored():
    """Without the floor, so that friction governs."""
    return paged(assessments.motions(3, seconds=10.0), options=PEER)


@pytest.mark.quick
def test_the_error_is_said_by_its_model_and_none_of_a_block_that_lifts_off(unfloored):
    scene, _, page = unfloored
    result = scene.assessment.governing.worst.governing.result
    assert 0.0 < result.error_m < 1e-6
    said = f"the error of this PRD is below {below_mm(result.error_m)} (a bound)"
    assert spaced(said) in page
    _, _, page = paged((*assessments.motions(3, seconds=4.0), projects.lifting(signs=(1,))))
    assert "lifts off the roof" in page
    assert set(page.table("Design displacement with").rows[0].values()) >= {"none"}
    assert not re.search(r"\bnan\b", page)


def inches_up(length_m):
    """To a tenth of an inch, upward, as every design displacement is printed."""
    return f"{math.ceil(length_m / 0.0254 * 10 - 1e-6) / 10:.1f}"


@pytest.mark.quick
def test_friction_is_changed_by_five_percent_and_all_motions_run_again(unfloored):
    scene, evidence, page = unfloored
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
    for name, assessed in (("less", evidence.at_reduced_friction),
                           ("more", evidence.at_increased_friction)):  # fmt: skip
        shown = [row[f"5% {name} [in]"].rstrip("†") for row in rows]
        assert shown == [inches_up(array.design_m) for array in assessed.arrays]
    assert evidence.at_reduced_friction is scene.assessment.at_reduced_friction
