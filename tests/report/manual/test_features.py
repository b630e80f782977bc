"""The status of a feature follows from the checks that ran."""

import re

import pytest

from fixtures import pages
from fixtures.verify_run import only
from report.manual.check_sections import features
from report.manual.manual_files import errors_by_version
from report.text.validation import VALIDATION
from solver.verification.design_checks import design_checks
from solver.verification.evidence import SECTIONS, Verified
from solver.verification.features import FEATURES, statuses

pytestmark = pytest.mark.quick

RELEASE = re.compile(r"Through version (?P<version>\S+): (?P<count>\d+) errors")


def row(id, *, passed=True):
    return Verified(id, "s", "q", "1", "p", 1.0, 1.0 if passed else 1.5, tolerance=0.0)


def every():
    return [row(id) for feature in FEATURES for id in feature.checks]


def features_of(checks):
    """The rows of the table of features by name."""
    given = only(checks=tuple(checks))
    table = pages.manual(given, features(given)).table("Features")
    return {name: list(cells) for name, *cells in table.cells}


def test_a_feature_is_verified_if_all_its_checks_passed_and_none_is_there_twice():
    found = {status.feature.name: status for status in statuses(every())}
    for feature in FEATURES:
        assert found[feature.name].is_verified == bool(feature.checks)
    table = features_of(every())
    assert table["Tipping"] == ["DV-5", "1 of 1", "verified", ""]
    assert table["Formats of records"] == ["—", "—", "not verified", "Automatic tests only"]
    names = [feature.name for feature in FEATURES]
    assert len(set(names)) == len(names)
    for feature in FEATURES:
        ids = (*feature.checks, *feature.extra)
        assert len(set(ids)) == len(ids)
        assert {id.partition("-")[0] for id in ids} <= set(SECTIONS)


def test_a_check_that_did_not_run_or_failed_leaves_its_features_unverified_and_is_named():
    left = [row for row in every() if row.id != "TA-8"]
    table = features_of(left)
    assert table["Static friction above kinetic"][2] == "not verified"
    assert table["Static friction above kinetic"][3].endswith("Did not run: TA-8")
    checks = [*every(), row("CF-3", passed=False)]
    failed = [s.feature.name for s in statuses(checks) if s.n_passed < s.n_checks]
    assert failed == ["Sliding in one axis", "Sliding in one axis with vertical shaking"]
    table = features_of(checks)
    assert all("FAIL" in table[name][2] for name in failed)
    name = "Sliding in two axes"
    without, also = (
        next(s for s in statuses(checks) if s.feature.name == name)
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


def test_the_manual_says_that_no_test_validates_the_solution():
    assert VALIDATION in pages.manual(only(), features(only()))


def test_every_error_of_a_released_version_has_an_effect_and_an_action():
    said = pages.manual(only(), errors_by_version())
    heads = [found for cells in said.table("Errors").cells if (found := RELEASE.match(cells[0]))]
    errors = [cells for cells in said.table("Errors").cells if cells[1]]
    assert sum(int(head["count"]) for head in heads) == len(errors) > 0
    assert all(text.endswith(".") for error in errors for text in error)
