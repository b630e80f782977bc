"""Runs are begun once, whoever asks for them, and of other motions there are none."""

import math
from dataclasses import replace

import pytest

from fixtures import assessments, projects
from report import runs as module
from report.runs import Runs, run_motion
from solver.errors import DefectError

MOTIONS = assessments.motions(2, 6.0)
COUNT = sum(len(motion.orientations) for motion in MOTIONS)


@pytest.fixture
def begun(monkeypatch):
    """The array, motion and orientation of each run that was begun."""
    found = []
    run = module.run_oriented

    def counted(array, motion, orientation, *tolerance):
        found.append((array.id, motion.id, orientation.name))
        return run(array, motion, orientation, *tolerance)

    monkeypatch.setattr(module, "run_oriented", counted)
    return found


def array(name="A1", slope_deg=2.0, **changes):
    data = projects.project(arrays=[projects.array(name, slope_deg, **changes)], clearances=[])
    return data.arrays[0]


def test_arrays_of_one_slope_and_friction_share_runs_that_are_those_of_each_motion(begun):
    runs = Runs()
    first, alike, other = array(), array("A2"), array("A3", mu=0.61)
    found = runs.of(first, MOTIONS)
    assert len(begun) == COUNT
    assert all(a is b for a, b in zip(found, runs.of(alike, MOTIONS), strict=True))
    assert len(begun) == COUNT
    runs.of(other, MOTIONS)
    assert len(begun) == 2 * COUNT
    alone = [run_motion(first, motion).governing.prd_m for motion in MOTIONS]
    assert [run.governing.prd_m for run in found] == alone


def test_of_all_orientations_those_are_run_that_were_not_before(begun):
    runs, first = Runs(), {motion.id: [motion.orientations[0].name] for motion in MOTIONS}
    some = runs.knowing({array().id: first}).of(array(), MOTIONS)
    assert [len(run.runs) for run in some] == [1, 1]
    assert len(begun) == 2
    every = runs.of(array(), MOTIONS)
    assert len(begun) == COUNT == len(set(begun))
    assert all(a.runs[0] is b.runs[0] for a, b in zip(some, every, strict=True))


def test_a_copy_has_the_runs_that_there_are_and_keeps_its_own(begun):
    runs = Runs()
    runs.of(array(), MOTIONS)
    copy = runs.copy()
    copy.of(array(), MOTIONS)
    assert len(begun) == COUNT
    copy.of(array(mu=0.61), MOTIONS)
    assert len(begun) == 2 * COUNT
    runs.of(array(mu=0.61), MOTIONS)
    assert len(begun) == 3 * COUNT


def test_known_orientations_are_run_alone_and_without_any_all_of_them():
    full = Runs().of(array(), MOTIONS)
    first, second = MOTIONS
    two = [run.orientation.name for run in sorted(full[0].runs, key=lambda run: -run.prd_m)[:2]]
    quick = Runs(1e-4).knowing({"A1": {first.id: two}}).of(array(), MOTIONS)
    assert [len(run.runs) for run in quick] == [2, len(second.orientations)]
    for some, every in zip(quick, full, strict=True):
        assert math.isclose(some.governing.prd_m, every.governing.prd_m, rel_tol=2e-4)


def test_another_motion_of_the_same_name_has_no_runs_here():
    runs = Runs()
    runs.of(array(), MOTIONS)
    twice = replace(MOTIONS[0], scale=2.0 * MOTIONS[0].scale)
    with pytest.raises(DefectError, match="not the same motion"):
        runs.of(array(), [twice])
