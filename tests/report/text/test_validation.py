"""Whether the sliding solution is validated follows from the shake-table tests at hand."""

import numba
import pytest

import tables
from report.text.validation import NOT_VALIDATED, explained, validation
from solver.verification.shake_table import compare, table_tests

pytestmark = pytest.mark.quick

compiled = pytest.mark.skipif(numba.config.DISABLE_JIT, reason="runs of whole records")


def test_without_tests_nothing_is_validated_and_the_text_says_what_that_means():
    assert validation(()) == NOT_VALIDATED
    assert explained(()).startswith(f"{NOT_VALIDATED} The checks of the verification manual")


@compiled
@pytest.mark.parametrize(
    ("ratio", "data", "is_validated"),
    [(1.02, "measured", True), (1.02, "computed", False), (1.6, "measured", False)],
)
def test_only_accepted_measured_tests_validate(tmp_path, ratio, data, is_validated):
    tables.write_folder(tmp_path, [ratio] * 5, data=data)
    found = compare(table_tests(tmp_path))
    assert (NOT_VALIDATED not in explained((found,))) is is_validated
    assert validation((found,)) == explained((found,)) or not is_validated
