"""Checks of the models: all pass, and what is wrong fails; a motion that lifts is left out."""

from dataclasses import replace

import pytest

from solver.records.record import read_only
from solver.sliding import two_axes
from solver.verification import model_checks
from solver.verification.evidence import SECTIONS
from solver.verification.study import own_triples

pytestmark = pytest.mark.quick


@pytest.fixture(scope="module")
def rows():
    return list(model_checks.model_checks(own_triples(True), quick=True))


def test_every_check_passes(rows):
    assert len(rows) >= 25
    assert [row for row in rows if not row.passed] == []
    assert {row.section for row in rows} == {SECTIONS["TA"]}


def test_each_model_is_chosen_once(rows):
    assert [row.computed for row in rows if row.quantity == "Model chosen"] == [0, 1, 2, 3, 4]


def test_every_tolerance_is_met_against_scipy(rows):
    met = [row for row in rows if row.problem.startswith("Tolerance of")]
    assert [row.tolerance for row in met] == [1e-4, 1e-6, 1e-8, 1e-10]
    assert all(0.0 < row.computed <= row.tolerance for row in met)


def test_a_solver_that_is_off_by_a_millionth_fails(monkeypatch):
    true = two_axes.run

    def off(*args):
        result = true(*args)
        return replace(result, prd_m=result.prd_m * (1.0 + 1e-6))

    monkeypatch.setattr(two_axes, "run", off)
    failed = [
        row for row in model_checks.model_checks(own_triples(True), quick=True) if not row.passed
    ]
    assert any(row.problem.startswith("No cross-slope") for row in failed)
    assert any(row.problem.startswith("One component rotated") for row in failed)


def test_a_motion_whose_vertical_lifts_the_block_is_left_out():
    (triple,) = own_triples(True)
    lifting = replace(triple, id="lifting", az_mps2=read_only(9.0 * triple.az_mps2))
    rows = model_checks.model_checks((triple, lifting), quick=True)
    assert not any("lifting" in row.problem for row in rows)
