"""The status of a feature follows from the checks that ran and from the tests of a shake table."""

import re
from dataclasses import replace
from importlib.metadata import version

import numba
import pytest

import printed
import tables
from report.document.templates import section
from report.manual.measured import result, shake_table
from report.text.formats import NOT_VALIDATED, explained
from solver.verification.design_checks import design_checks
from solver.verification.evidence import SECTIONS, Check
from solver.verification.features import FEATURES, statuses
from solver.verification.shake_table import compare, table_tests
from verified import only

pytestmark = pytest.mark.quick

RELEASE = re.compile(r"Version (?P<version>\S+) as released: (?P<count>\d+) errors")

compiled = pytest.mark.skipif(numba.config.DISABLE_JIT, reason="runs of whole records")


def row(id, *, passed=True):
    return Check(id, "s", "q", "1", "p", 1.0, 1.0 if passed else 1.5, tolerance=0.0)


def every():
    return [row(id) for feature in FEATURES for id in feature.checks]


def features_of(checks, *found):
    """The rows of the table of features by name."""
    given = only(checks=tuple(checks), tables=found)
    table = printed.manual(given, section("manual/features", "Features")).table("Features")
    return {name: list(cells) for name, *cells in table.cells}


@pytest.fixture
def table(tmp_path):
    """A function that compares made tests with the ratios given."""

    def of(ratios, data="computed"):
        tables.write_folder(tmp_path, ratios, data=data)
        return compare(table_tests(tmp_path))

    return of


def test_a_feature_is_verified_if_all_its_checks_passed_and_none_is_there_twice():
    found = {status.feature.name: status for status in statuses(every(), ())}
    for feature in FEATURES:
        assert found[feature.name].is_verified == bool(feature.checks)
        assert not found[feature.name].is_validated
    table = features_of(every())
    assert table["Tipping"] == ["DV-5", "1 of 1", "verified, not validated", ""]
    assert table["Formats of records"] == ["—", "—", "neither", "Automatic tests only"]
    names = [feature.name for feature in FEATURES]
    assert len(set(names)) == len(names)
    for feature in FEATURES:
        ids = (*feature.checks, *feature.extra)
        assert len(set(ids)) == len(ids)
        assert {id.partition("-")[0] for id in ids} <= set(SECTIONS)


def test_a_check_that_did_not_run_or_failed_leaves_its_features_unverified_and_is_named():
    left = [row for row in every() if row.id != "TA-8"]
    table = features_of(left)
    assert table["Static friction above kinetic"][2] == "neither"
    assert table["Static friction above kinetic"][3].endswith("Did not run: TA-8")
    checks = [*every(), row("CF-3", passed=False)]
    failed = [s.feature.name for s in statuses(checks, ()) if s.n_passed < s.n_checks]
    assert failed == ["Sliding in one axis", "Sliding in one axis with vertical shaking"]
    table = features_of(checks)
    assert all("FAIL" in table[name][2] for name in failed)
    name = "Sliding in two axes"
    without, also = (
        next(s for s in statuses(checks, ()) if s.feature.name == name)
        for checks in (every(), [*every(), row("TA-13", passed=False)])
    )
    assert without.is_verified
    assert "TA-13" not in without.ids
    assert not also.is_verified


def test_checks_of_rules_spectra_filters_uplift_and_tipping_pass_and_fail_where_wrong(monkeypatch):
    rows = list(design_checks())
    assert [row for row in rows if not row.passed] == []
    assert {row.id for row in rows} == {f"DV-{number}" for number in range(1, 9)}
    name = "solver.verification.design_checks.required_separation"
    monkeypatch.setattr(name, lambda *_, design_m, **__: design_m)
    wrong = [row.problem for row in design_checks() if not row.passed]
    # Like arrays and edges of both documents, and the parapet beside I_e 1.25.
    assert len(wrong) == 5
    assert all("Separation" in problem for problem in wrong)


def test_without_tests_the_manual_says_that_nothing_is_validated():
    said = printed.manual(only(), shake_table(only()))
    assert explained(()) in said
    assert "option --table" in said
    assert "the median of the ratios is 0.9 to 1.1" in said


@compiled
def test_measured_slip_validates_the_models_of_its_tests_and_computed_slip_nothing(table):
    made = table((0.99, 1.0, 1.0, 1.0, 1.01))
    said = printed.manual(only(), shake_table(only(tables=(made,))))
    assert "the slip of 0 was measured and that of 5 was computed" in said
    assert "A slip that was computed validates nothing" in said
    assert f"The acceptance is satisfied. {NOT_VALIDATED}" in said
    assert tables.MADE in said
    assert not any(status.is_validated for status in statuses(every(), [made]))
    # The words of the file decide; the data are made here as well.
    stated = table((0.99, 1.0, 1.0, 1.0, 1.01), data="measured")
    validated = [s.feature.name for s in statuses(every(), [stated]) if s.is_validated]
    assert validated == ["Sliding in one axis"]
    listed = features_of(every(), stated)
    assert listed["Sliding in one axis"][2] == "verified, validated by 5 tests"
    assert listed["Sliding in two axes"][2] == "verified, not validated"


@compiled
def test_what_is_not_accepted_is_said_with_its_numbers(table):
    made = table((1.5, 1.5, 1.5, 1.0, 1.0), data="measured")
    said = result(made)
    assert "median ratio, 1.500 instead of 0.9 to 1.1" in said
    assert "share of the ratios in 0.75 to 1.33, 40 % instead of 80 % or more" in said
    assert said.endswith(NOT_VALIDATED)
    few = result(replace(made, runs=made.runs[3:]))
    assert few.startswith("The acceptance is not satisfied: number of ratios, 2 instead of 5 or")


def test_every_error_of_a_released_version_has_an_effect_and_an_action():
    said = printed.manual(only(), section("manual/known-errors", "Known errors"))
    heads = [found for cells in said.table("Errors").cells if (found := RELEASE.match(cells[0]))]
    errors = [cells for cells in said.table("Errors").cells if cells[1]]
    assert sum(int(head["count"]) for head in heads) == len(errors) > 0
    assert all(text.endswith(".") for error in errors for text in error)
    is_released = version("roofslip") in [head["version"] for head in heads]
    assert ("is a later state with the same number" in said) == is_released
