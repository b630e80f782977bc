"""Cells as a person typed them."""

import datetime as dt

import pytest

from report.sheet.reading.cells import plain

pytestmark = pytest.mark.quick


@pytest.mark.parametrize(
    ("value", "text"),
    [
        (0.1 + 0.2, "0.3"),
        (47.99999999999999, "48"),
        (0.59000000000000008, "0.59"),
        (48.0, "48"),
        (1e-7, "1e-07"),
        (dt.datetime(2026, 11, 20), "2026-11-20"),
        (True, "TRUE"),
    ],
)
def test_a_number_has_the_digits_that_a_spreadsheet_keeps(value, text):
    assert plain(value) == text
