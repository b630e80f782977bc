"""Arrays compared with rows of linked blocks: the solver's own rows, limits, missing values."""

import math
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

from fixtures import assessments, project_parts, projects
from report.assessment.design.linked_blocks import assess_linked
from solver.model import Status
from solver.sliding.checked import scene, slide
from solver.sliding.model_selection import DEFAULT
from solver.sliding.row import BlockRow, slide_row

G, LB, INCH = 9.80665, 4.4482216152605, 0.0254
MOTIONS = assessments.motions(3, seconds=12.0)


def assessed(friction, lb_per_in, *, shaking=MOTIONS, peer_reviewed=True, array=(), **changes):
    """An array of two degrees as a row, with its assessment."""
    done = assessments.package(
        shaking,
        arrays=[projects.array("A1", 2.0, **dict(array))],
        objects=[],
        clearances=[],
        links=[projects.links("A1", friction, lb_per_in, **changes)],
        options=project_parts.REVIEW | {"peer_reviewed": peer_reviewed},
    ).assessment
    return done, done.linked[0]


def along(motion):
    """The four runs of a motion, by the component along the slope."""
    return [sign * x for x in (motion.ax_mps2, motion.ay_mps2) for sign in (1, -1)]


def rigid_value(mu):
    """1.1 times the largest PRD of one block in one axis, by the solver itself."""
    given = {"slope_rad": math.radians(2.0), "mu": mu}
    runs = (slide(a, m.dt_s, az_mps2=m.az_mps2, **given) for m in MOTIONS for a in along(m))
    return 1.1 * max(run.prd_m for run in runs)


@pytest.mark.nightly
def test_the_rows_are_those_of_the_solver():
    _, item = assessed("0.40, 0.45, 0.50", 500, damping_ratio=0.1)
    mass, k = 42000 * LB / G / 3, 500 * LB / INCH
    row = BlockRow(
        mus=(0.4, 0.45, 0.5),
        stiffness_per_s2=k / mass,
        damping_per_s=0.2 * math.sqrt(k * mass) / mass,
    )
    for motion, linked in zip(MOTIONS, item.motions, strict=True):
        for a, run in zip(along(motion), linked.runs, strict=True):
            one_axis = scene(
                a, motion.dt_s, slope_rad=math.radians(2.0), mu=0.45, az_mps2=motion.az_mps2
            )
            wanted = slide_row(one_axis, row)
            assert run.row.prd_m == pytest.approx(wanted.prd_m, rel=1e-9)
            assert run.row.link_force == pytest.approx(wanted.link_force, rel=1e-9)
            assert run.block == 1 + int(np.argmax(wanted.prd_m))
    peaks = [max(run.prd_m for run in linked.runs) for linked in item.motions]
    assert item.linked.value_m == pytest.approx(1.1 * max(peaks))
    assert item.rigid.value_m == pytest.approx(rigid_value(0.45))
    forces = [run.row.link_force for linked in item.motions for run in linked.runs]
    assert item.link_force_n == pytest.approx(max(forces) * mass * G)


@pytest.mark.nightly
def test_stiff_links_make_one_block_and_differing_ones_raise_the_design():
    done, item = assessed("0.40, 0.45, 0.50", 50)
    assert item.ratio == pytest.approx(item.linked.value_m / item.rigid.value_m)
    assert item.ratio > 1.1
    assert item.estimated_m == pytest.approx(item.ratio * item.design.analysis.value_m)
    assert not item.is_rigid_enough
    assert item.is_final
    assert not done.verdict.is_permitted
    _, item = assessed("0.40, 0.42, 0.50", 2e6, damping_ratio=0.5)
    assert item.linked.value_m == pytest.approx(rigid_value(0.44), rel=0.01)


@pytest.mark.parametrize("lb_per_in", [1, 5000, 1e6])
@pytest.mark.nightly
def test_blocks_with_equal_friction_move_as_one_whatever_links_them(lb_per_in):
    done, item = assessed("0.45, 0.45, 0.45", lb_per_in)
    assert item.ratio == pytest.approx(1.0, rel=1e-9)
    assert item.link_force_n == pytest.approx(0.0, abs=1e-6)
    assert item.estimated_m == pytest.approx(item.design.design_m, rel=1e-9)
    assert done.verdict.is_permitted


@pytest.mark.quick
def test_soft_links_few_motions_and_no_route_are_told():
    _, item = assessed("0.50, 0.40, 0.45", 0.01)
    assert item.linked.value_m == pytest.approx(rigid_value(0.40), rel=0.01)
    assert item.farthest.block == 2
    # Nothing moves under motions that do not qualify, as one block or as a row.
    (item,) = projects.unpermitted(links=[projects.links("A1", "0.3, 0.3", 50)]).linked
    assert (item.is_within, item.is_final) == (True, True)
    assert not item.is_rigid_enough
    _, item = assessed("0.40, 0.50", 50, shaking=MOTIONS[:2])
    assert math.isnan(item.estimated_m)
    assert not item.is_rigid_enough


@pytest.mark.parametrize("friction", ["0.40, 0.45, 0.50", "0.50, 0.40", "0.40, 0.60, 0.41, 0.55"])
@pytest.mark.parametrize("lb_per_in", [50, 5000])
def test_the_least_coefficient_entered_as_that_of_the_array_does(friction, lb_per_in):
    done, item = assessed(friction, lb_per_in, array={"mu": 0.40})
    assert item.ratio <= 1.0
    assert done.verdict.is_permitted


def test_the_floor_bears_on_links():
    done, item = assessed("0.40, 0.45, 0.50", 50, peer_reviewed=False)
    assert item.ratio > 1.1
    assert item.estimated_m == item.design.floor_m == item.design.design_m
    assert done.verdict.is_permitted


def test_a_difference_below_the_model_tolerance_is_allowed():
    _, item = assessed("0.40, 0.45, 0.50", 50)
    design = item.design.design_m
    for extra, enough in ((0.99, True), (1.01, False)):
        ratio = 1.0 + extra * DEFAULT.bound_m(design) / design
        grown = replace(item.linked, value_m=ratio * item.rigid.value_m)
        assert replace(item, linked=grown).is_rigid_enough is enough


@pytest.mark.nightly
def test_a_block_that_slides_where_one_rigid_one_does_not_has_no_ratio():
    shaking = (projects.motion("M", 0.25 * G * np.sin(np.arange(400) / 10.0)),) * 3
    done, item = assessed("0.10, 0.50", 0.01, shaking=shaking, array={"mu": 0.3})
    assert item.rigid.value_m == 0.0
    assert item.linked.value_m > 0.01
    assert math.isinf(item.ratio)
    assert math.isinf(item.estimated_m)
    assert not done.verdict.is_permitted
    _, still = assessed("0.29, 0.50", 0.01, shaking=shaking, array={"mu": 0.3})
    assert (still.linked.value_m, still.ratio) == (0.0, 1.0)
    assert still.is_within


def test_uplift_withholds_the_row_as_well():
    done, item = assessed("0.40, 0.50", 50, shaking=(*MOTIONS, projects.lifting()))
    assert item.farthest.row.status is Status.UPLIFT
    for value in (item.ratio, item.estimated_m, item.link_force_n, item.rigid_prd_m):
        assert math.isnan(value)
    assert not item.is_rigid_enough
    assert not done.verdict.is_permitted


def test_a_row_that_cannot_be_followed_is_never_enough():
    done, item = assessed("0.45, 0.45", 50)
    first, *others = item.motions
    run = first.runs[0]
    lost = replace(run.row, status=Status.DIVERGED, prd_m=(math.nan, math.nan))
    motions = [replace(first, runs=(replace(run, row=lost), *first.runs[1:])), *others]
    pool = SimpleNamespace(map=lambda *_: motions)
    again = assess_linked(pool, done.rules, item.links, item.design)
    assert again.farthest.row is lost
    assert math.isnan(again.ratio)
    assert done.verdict.is_permitted
    assert not replace(done, linked=(again,)).verdict.is_permitted


@pytest.mark.nightly
def test_a_row_that_still_slides_at_the_end_is_not_final():
    ax = np.concatenate([np.zeros(100), np.full(60, -4.0)])
    cut = (projects.motion("CUT", ax, signs=(1,)),) * 3
    done, item = assessed("0.30, 0.60", 0.01, shaking=cut, array={"mu": 0.6})
    assert item.design.motions[0].governing.result.status is Status.OK
    assert item.farthest.row.status is Status.SLIDING_AT_END
    assert not item.is_final
    assert not item.is_rigid_enough
    assert not done.verdict.is_permitted
