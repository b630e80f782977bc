"""Numbers in print: required and provided values never look the other way round."""

import math

import pytest
from hypothesis import assume, example, given
from hypothesis import strategies as st

from report.text import units
from report.text.units import Quantity, beside, digits_down, digits_up, measured, no_less, number

pytestmark = pytest.mark.quick

LENGTHS_M = st.floats(0.01, 20.0)


@given(LENGTHS_M, LENGTHS_M)
@example(36.04 * 0.0254, 35.96 * 0.0254)
@example(1.0361, 1.0359)
@example(0.9153, 0.9154)
def test_a_required_value_is_rounded_up_and_a_provided_one_shows_the_order(required_m, provided_m):
    assume(abs(required_m - provided_m) > 1e-8)
    ok = required_m <= provided_m
    for unit in Quantity.DISPLACEMENT.value:
        required = float(no_less(required_m, unit))
        provided = float(beside(required_m, provided_m)(provided_m, unit))
        assert (required <= provided) is ok
        assert required >= required_m / unit.si - 1e-5
        for printed, value_m in ((required, required_m), (provided, provided_m)):
            assert printed == pytest.approx(value_m / unit.si, abs=1.001 * 10.0**-unit.decimals)


def test_provided_values_and_rounding_up_keep_what_is_exact():
    _, mm = Quantity.SIZE.value
    for required_m, shown in ((0.5486, "305"), (0.2, "305"), (0.3049, "304"), (math.nan, "305")):
        assert beside(required_m, 12.0 * 0.0254)(12.0 * 0.0254, mm) == shown
    assert units.compared_pairs(0.3041, 0.3042, Quantity.SIZE, us_first=False) == (
        "305 mm (12.0 in)",
        "305 mm (12.0 in)",
    )
    inch, mm = Quantity.SIZE.value
    assert no_less(1.00001, mm) == "1001"
    assert no_less(40.8001 * 0.0254, inch) == "40.9"
    for tenths in range(1, 2000):
        length_m, text = tenths / 10 * 0.0254, f"{tenths / 10:.1f}"
        assert no_less(length_m, inch) == number(units.round_down(length_m / inch.si, 1), 1) == text


@given(st.floats(1e-6, 999.0), st.integers(1, 4))
@example(99.6, 2)
@example(0.1, 3)
def test_significant_digits_enclose_a_value(value, digits):
    low, high = float(digits_down(value, digits)), float(digits_up(value, digits))
    last = 10.0 ** min(math.floor(math.log10(value)) - digits + 1, 0)
    assert low <= value * (1 + 1e-9) + 1e-6 * last
    assert high >= value * (1 - 1e-9) - 1e-6 * last
    assert high - low <= 1.001 * last


def test_zero_no_value_and_infinity_have_their_signs():
    assert digits_up(0.0, 2) == digits_down(0.0, 2) == "0"
    for show in (measured, no_less):
        assert show(math.nan, Quantity.SIZE.si) == "—"
        assert show(math.inf, Quantity.SIZE.si) == "∞"
    assert math.isnan(units.round_down(math.nan, 1))
    assert units.round_down(math.inf, 1) == math.inf


@pytest.mark.parametrize(
    ("value_m", "text"),
    [(2.07196, "81.6 in (2072 mm)"), (0.9994, "39.3 in (999 mm)"), (1.0049, "39.6 in (1005 mm)"),
     (12.345, "486.0 in (12345 mm)"), (-1.2346, "−48.6 in (−1235 mm)")],
)  # fmt: skip
def test_displacements_print_in_whole_millimeters_of_any_size(value_m, text):
    assert units.pair(value_m, Quantity.DISPLACEMENT) == text


@pytest.mark.parametrize(("value", "length"), [(1.0, 1.0), (4.9, 2.0), (99.0, 50.0), (0.7, 0.5)])
def test_the_bar_is_one_two_or_five(value, length):
    assert units.round_below(value) == pytest.approx(length)
