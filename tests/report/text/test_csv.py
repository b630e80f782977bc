"""Text for files: a field of a CSV is no formula; and whether tests validate the solution."""

import csv
import io

import numba
import pytest
from hypothesis import given
from hypothesis import strategies as st

import tables
from report.text.formats import NOT_VALIDATED, csv_text, explained, validation
from solver.verification.shake_table import compare, table_tests

pytestmark = pytest.mark.quick


def fields(*values):
    return next(csv.reader(io.StringIO(csv_text([values]))))


@pytest.mark.parametrize(
    "text",
    ["=1+1", "+1+1", "-1+1", "@SUM(A1)", "\t=1+1", "\rx", "\nx", " =1+1", "\u00a0=1+1",
     "＝1+1", "＋1", "－a", "＠a", "-", "+", "=", "-1 in", "-inf", "+nan", "-1_0",
     "=cmd|'/c calc'!A0", '=HYPERLINK("http://a")', "-٣"],
)  # fmt: skip
def test_a_text_that_a_spreadsheet_would_compute_has_an_apostrophe(text):
    assert fields("a", text, "b") == ["a", f"'{text}", "b"]


@pytest.mark.parametrize(
    "text", ["", "-0.5", "+1e-3", "-.5", "-1.", "1=1", "a-b", "'=1", "PRD > 1", "#N/A", "a\t=1"]
)
def test_numbers_and_other_texts_are_as_they_were(text):
    assert fields("a", text) == ["a", text]


def test_a_line_end_in_a_text_begins_no_row():
    assert fields("a\r=1+1", "b\n=1+1", "c") == ["a\r=1+1", "b\n=1+1", "c"]


@given(st.floats() | st.integers() | st.none())
def test_a_value_that_is_no_text_is_as_python_prints_it(value):
    assert fields("a", value) == ["a", "" if value is None else str(value)]


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
