"""What is open at some values of its controls shares what they do not change."""

import math

import pytest

from fixtures.paths import ROOT
from report import runs
from report.assessment.assess import Extent
from report.web.open_project import KEPT_VALUES, may_govern, open_project, reference_of


@pytest.fixture(scope="module")
def given():
    return open_project(ROOT / "projects" / "example")


def test_clearances_share_motions_and_runs_friction_the_motions_and_intensity_nothing(given):
    wider = given.at({"clearance": 6.0})
    assert (wider.shaking, wider.runs) == (given.shaking, given.runs)
    slippery = given.at({"friction": 0.9})
    assert slippery.shaking is given.shaking
    assert slippery.runs is not given.runs
    both = given.at({"friction": 0.9, "clearance": 6.0})
    assert (both.shaking, both.runs) == (given.shaking, slippery.runs)
    stronger = given.at({"intensity": 1.1})
    assert stronger.shaking is not given.shaking
    assert stronger.runs not in (given.runs, slippery.runs)
    wide = given.at({"intensity": 1.1, "clearance": 6.0})
    assert (wide.shaking, wide.runs) == (stronger.shaking, stronger.runs)
    assert wide.shared is stronger.shared


def test_the_last_values_are_kept_and_those_before_them_are_not(given):
    first, *others = [{"slope": 0.1 * k} for k in range(1, KEPT_VALUES + 2)]
    kept = given.at(first)
    assert given.at(first) is kept
    last = [given.at(values) for values in others]
    assert [given.at(values) for values in others] == last
    assert given.at(first) is not kept


@pytest.mark.quick
def test_what_was_assessed_in_whole_is_not_assessed_again_in_part():
    conditions = open_project(ROOT / "projects" / "conditions")
    part = conditions.assessed(Extent.AS_GIVEN)
    assert part.at_reduced_friction is None
    whole = conditions.assessed()
    assert whole.at_reduced_friction is not None
    assert whole.acceptance is part.acceptance
    assert open_project(ROOT / "projects" / "conditions").assessed() is not whole
    assert conditions.assessed() is whole
    narrow = conditions.at({"friction": 0.9})
    done = narrow.assessed()
    assert narrow.assessed(Extent.AS_GIVEN) is done
    assert done.acceptance is whole.acceptance


def test_where_one_array_moves_the_others_are_not_run_again(given, monkeypatch):
    known, ran = reference_of(given.assessed(Extent.AS_GIVEN)), []
    run = runs.run_oriented
    monkeypatch.setattr(runs, "run_oriented", lambda *a: ran.append(a[0].id) or run(*a))
    for mu in (0.9, 0.91):
        ran.clear()
        given.at({"friction@A1": mu}).moving(known)
    assert set(ran) == {"A1"}
    assert len(ran) <= 2 * len(given.shaking.motions)


@pytest.mark.quick
@pytest.mark.parametrize(
    ("change", "named"),
    [(1.0, "a"), (1.1, "ab"), (1 / 1.2, "ab"), (1.4, "abc"), (math.nan, ""), (0.0, "")],
)
def test_the_more_the_largest_prd_changes_the_more_orientations_may_govern(change, named):
    assert may_govern({"a": 1.0, "b": 0.98, "c": 0.9, "d": 0.5}, change) == list(named)


@pytest.mark.quick
def test_the_second_orientation_may_govern_wherever_the_largest_changed_much():
    prds_m = {"a": 0.2, "b": 1.0, "c": 0.1}
    assert [may_govern(prds_m, change) for change in (1.3, 1.4)] == [["b"], ["b", "a"]]


def test_values_of_a_search_are_none_above_the_full_ones(given):
    """To the last bit: a verdict of these runs that is NG is NG in full."""
    known, lower = reference_of(given.assessed(Extent.AS_GIVEN)), given.at({"friction": 0.7})
    some = lower.of_governing(known)
    full = lower.assessed(Extent.AS_GIVEN)
    for one, every in zip(some.arrays, full.arrays, strict=True):
        for part, whole in zip(one.motions, every.motions, strict=True):
            assert part.governing.prd_m <= whole.governing.prd_m
            assert {run.prd_m for run in part.runs} <= {run.prd_m for run in whole.runs}
