"""What is open at some values of its controls shares what they do not change."""

import pytest

from fixtures.paths import ROOT
from report import runs
from report.assessment.assess import Extent
from report.web.open_project import KEPT_VALUES, open_project, reference_of


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
    assert wide.first is stronger


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
    assert ran == ["A1"] * 2 * len(given.shaking.motions)
