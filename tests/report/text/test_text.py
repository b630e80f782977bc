"""Counts, names, numbers, fields of CSV and commands, as they are printed."""

import csv
import io
import math
import sys
from functools import partial
from pathlib import Path, PureWindowsPath

import pytest
from hypothesis import assume, example, given
from hypothesis import strategies as st

from fixtures.spaces import spaced
from report.text import units
from report.text.amounts import (
    capacity,
    compared_pairs,
    demand,
    entered,
    limit_texts,
    shown_in_order,
)
from report.text.command_line import quoted
from report.text.counts import counted, spelled
from report.text.csv_text import csv_text
from report.text.letter_case import capitalized, lowered
from report.text.names import name_lines, named, ranged
from report.text.typed_letters import trimmed
from report.text.units import Quantity, digits_down, digits_up, measured, no_less, no_more
from solver.rules.limit import Limit, Measure

pytestmark = pytest.mark.quick


@pytest.mark.parametrize(
    ("count", "text"),
    [(0, "no arrays"), (1, "one array"), (2, "two arrays"), (9, "nine arrays"), (10, "10 arrays")],
)
def test_a_count_is_in_words_up_to_nine(count, text):
    assert counted(count, "array") == text
    assert spelled(count) == text.split()[0]


@pytest.mark.parametrize(
    ("names", "text"),
    [
        ("", ""), ("A1 A2", "A1, A2"), ("A1 A2 A3", "A1 to A3"),
        ("A8 A9 A10 A12 B13 B14 A15", "A8 to A10, A12, A15, B13, B14"),
        ("CF-1 CF-2 CF-3 DA-1 SY-1 SY-2", "CF-1 to CF-3, DA-1, SY-1, SY-2"),
        ("PV-08 PV-09 PV-10 PV-12", "PV-08 to PV-10, PV-12"), ("A3 A10 A2 A1 A2", "A1 to A3, A10"),
        ("EAST EAST0 EAST1 WEST 7 8 9", "7 to 9, EAST, EAST0, EAST1, WEST"),
    ],
)  # fmt: skip
def test_names_that_count_on_are_a_range_from_three_of_them(names, text):
    assert ranged(names.split()) == text


def test_a_name_has_one_line_up_to_24_letters_and_breaks_between_words_where_it_can():
    assert name_lines("NORTHWEST CORNER ROOF 01") == ["NORTHWEST CORNER ROOF 01"]
    words = "NORTHWEST CORNER OF UPPER ROOF, ARRAY 07"
    assert name_lines(words) == ["NORTHWEST CORNER OF", "UPPER ROOF, ARRAY 07"]
    assert name_lines("A" * 40) == ["A" * 24, "A" * 16]


WIDTHLESS = "\u00ad\u200b\u200c\u200d\u200e\u200f\u2060\u2061\u2062\u2063\u2064\ufeff"


def test_letters_of_no_width_are_trimmed_names_have_their_noun_and_sentences_a_capital():
    for code in range(sys.maxunicode + 1):
        letter = chr(code)
        expected = "" if letter.isspace() or letter in WIDTHLESS else letter
        assert trimmed(letter) == expected, hex(code)
    assert trimmed(" \u200ba \u200b b\ufeff\n ") == "a \u200b b"
    assert named(["A9"], "array") == "array A9"
    assert named(["A1", "A2", "A3"], "array") == "arrays A1 to A3"
    assert capitalized("the roof of EX-1") == "The roof of EX-1"
    whole = ["V/N divided by the limit", "A1 moved west", "SDC D", "Risk Category (I = 1)"]
    assert [lowered(text) for text in (*whole, "A record", "No runs")] == [
        *whole,
        "a record",
        "no runs",
    ]


def test_a_path_of_windows_has_the_quotes_of_cmd_and_powershell(monkeypatch):
    monkeypatch.setattr(sys, "platform", "win32")
    assert quoted(PureWindowsPath(r"C:\w\roof-1\input.xlsx")) == r"C:\w\roof-1\input.xlsx"
    for path in (r"C:\My projects\roof", r"C:\R&D\roof (2)", r"C:\it's"):
        assert quoted(PureWindowsPath(path)) == f'"{path}"'


def test_a_path_that_begins_with_a_dash_is_taken_for_no_option():
    assert quoted(Path("-dash")) == "./-dash"
    assert quoted(Path("-my roof", "input.xlsx")) == "'./-my roof/input.xlsx'"
    assert quoted(Path("roof-1")) == "roof-1"


def fields(*values):
    return next(csv.reader(io.StringIO(csv_text([values]))))


@pytest.mark.parametrize(
    "text",
    ["=1+1", "+1+1", "-1+1", "@SUM(A1)", "\t=1+1", "\rx", "\u00a0=1+1", "＝1+1", "－a", "-",
     "-1 in", "-inf", "-1_0", "=cmd|'/c calc'!A0", "-٣"],
)  # fmt: skip
def test_a_text_that_a_spreadsheet_would_compute_has_an_apostrophe(text):
    assert fields("a", text, "b") == ["a", f"'{text}", "b"]


@pytest.mark.parametrize(
    "text", ["", "-0.5", "+1e-3", "-.5", "-1.", "1=1", "a-b", "'=1", "PRD > 1", "#N/A", "a\t=1"]
)
def test_numbers_and_other_texts_are_as_they_were(text):
    assert fields("a\r=1", text, "b\n=1") == ["a\r=1", text, "b\n=1"]


@given(st.floats() | st.integers() | st.none())
def test_a_value_that_is_no_text_is_as_python_prints_it(value):
    assert fields("a", value) == ["a", "" if value is None else str(value)]


LENGTHS_M = st.floats(0.01, 20.0)


@given(LENGTHS_M, LENGTHS_M)
@example(36.04 * 0.0254, 35.96 * 0.0254)
@example(1.0361, 1.0359)
@example(0.9153, 0.9154)
@example(1.2192, 1.2192)
@example(1.2, 1.2)
def test_what_is_required_is_rounded_up_what_is_provided_down_and_their_order_shows(
    required_m, provided_m
):
    assume(required_m == provided_m or abs(required_m - provided_m) > 1e-7)
    shows = shown_in_order(capacity(provided_m), demand(required_m))
    for unit in Quantity.DISPLACEMENT.value:
        provided, required = (float(show(math.nan, unit)) for show in shows)
        assert (required <= provided) is (required_m <= provided_m)
        # Equal values that have no end in a unit, such as 1200 mm in inches, have one digit more.
        slack = (0.051 if required_m == provided_m else 1e-4) * 10.0**-unit.decimals
        assert required >= required_m / unit.si - slack
        assert provided <= provided_m / unit.si + slack
        digit = 1.001 * 10.0**-unit.decimals
        assert required == pytest.approx(required_m / unit.si, abs=digit)
        assert provided == pytest.approx(provided_m / unit.si, abs=digit)


SIZE, PRESSURE, PSF = Quantity.SIZE, Quantity.PRESSURE, 47.880258980335


@pytest.mark.parametrize(
    ("found", "limit", "quantity", "is_at_least", "texts"),
    [
        (capacity(0.3048), demand(0.3041), SIZE, True,
         ("12.0 in (304.8 mm)", "12.0 in (304.1 mm)")),
        (entered(8.76 * PSF), capacity(8.76 * PSF), PRESSURE, False,
         ("8.76 psf (0.419 kPa)", "8.76 psf (0.419 kPa)")),
        (capacity(1.2192), demand(1.2192), SIZE, True,
         ("48.0 in (1219.2 mm)", "48.0 in (1219.2 mm)")),
        (capacity(1.2), demand(1.2), SIZE, True, ("47.24 in (1200 mm)", "47.24 in (1200 mm)")),
        (capacity(1.8288), demand(1.2192), SIZE, True, ("72.0 in (1828 mm)", "48.0 in (1220 mm)")),
        (capacity(math.nan), demand(1.2192), SIZE, True, ("— in (— mm)", "48.0 in (1220 mm)")),
        (entered(3.7 * PSF), entered(3.8 * PSF), PRESSURE, True,
         ("3.7 psf (0.177 kPa)", "3.8 psf (0.182 kPa)")),
        (entered(6.24 * PSF), capacity(6.2 * PSF), PRESSURE, False,
         ("6.24 psf (0.30 kPa)", "6.20 psf (0.29 kPa)")),
        (demand(0.0104), capacity(0.01), Quantity.DRIFT, False,
         ("0.41 in (10.4 mm)", "0.39 in (10.0 mm)")),
    ],
)  # fmt: skip
def test_more_digits_are_printed_where_the_usual_ones_would_not_show_the_order(
    found, limit, quantity, is_at_least, texts
):
    pairs = compared_pairs(found, limit, quantity, us_first=True, is_at_least=is_at_least)
    assert spaced(pairs) == texts


def a_limit(found, limit, measure=Measure.PLAIN, *, is_at_least=False, key=""):
    check = Limit(
        title="", found=found, limit=limit, measure=measure, is_at_least=is_at_least, key=key
    )
    return spaced(limit_texts(check, us_first=True))


def test_a_limit_is_rounded_to_the_safe_side_and_what_is_computed_to_the_other():
    angle = partial(a_limit, measure=Measure.ANGLE_DEG, key="analysis_max_slope_deg")
    assert angle(3.0, 7.0) == ("3.00° (5.2%)", "7.00° (12.2%)")
    assert angle(7.004, 7.0) == ("7.004° (12.3%)", "7.000° (12.2%)")
    assert angle(7.0, 7.0) == ("7.00° (12.278%)", "7.00° (12.278%)")
    assert angle(7.00001, 7.0) == ("7.01° (12.3%)", "7.00° (12.2%)")
    assert a_limit(0.3001, 0.3) == ("0.31", "0.30")
    assert a_limit(0.8999, 0.9, is_at_least=True) == ("0.89", "0.90")
    assert a_limit(0.399, 0.4, is_at_least=True, key="prescriptive_min_mu") == ("0.399", "0.400")
    assert a_limit(5, 7, Measure.COUNT, is_at_least=True) == ("5", "7")
    assert a_limit(19.96, 20.0, Measure.TIME_S, is_at_least=True) == ("19.9 s", "20.0 s")
    length = a_limit(0.9143, 0.9144, Measure.LENGTH_M, key="low_profile_in")
    assert length == ("36.0 in (914 mm)", "36.0 in (914 mm)")


def test_rounding_up_and_down_keep_what_is_exact_zero_and_no_value():
    inch, mm = Quantity.SIZE.value
    assert no_less(1.00001, mm) == "1001"
    assert no_more(1.00099, mm) == "1000"
    assert no_less(40.8001 * 0.0254, inch) == "40.9"
    for tenths in range(1, 2000):
        length_m, text = tenths / 10 * 0.0254, f"{tenths / 10:.1f}"
        assert no_less(length_m, inch) == no_more(length_m, inch) == text
    assert digits_up(0.0, 2) == digits_down(0.0, 2) == "0"
    for show in (measured, no_less, no_more):
        assert show(math.nan, Quantity.SIZE.si) == "—"
        assert show(math.inf, Quantity.SIZE.si) == "∞"
    assert math.isnan(units.round_down(math.nan, 1))
    assert units.round_down(math.inf, 1) == math.inf


@given(st.floats(1e-6, 999.0), st.integers(1, 4))
@example(99.6, 2)
@example(0.1, 3)
def test_significant_digits_enclose_a_value(value, digits):
    low, high = float(digits_down(value, digits)), float(digits_up(value, digits))
    last = 10.0 ** min(math.floor(math.log10(value)) - digits + 1, 0)
    assert low <= value * (1 + 1e-9) + 1e-6 * last
    assert high >= value * (1 - 1e-9) - 1e-6 * last
    assert high - low <= 1.001 * last


@pytest.mark.parametrize(
    ("value_m", "text"),
    [(2.07196, "81.6 in (2072 mm)"), (0.9994, "39.3 in (999 mm)"), (1.0049, "39.6 in (1005 mm)"),
     (12.345, "486.0 in (12345 mm)"), (-1.2346, "−48.6 in (−1235 mm)")],
)  # fmt: skip
def test_displacements_print_in_whole_millimeters_of_any_size(value_m, text):
    assert spaced(units.pair(value_m, Quantity.DISPLACEMENT)) == text
    assert [units.round_below(value) for value in (1.0, 4.9, 0.7)] == pytest.approx([1.0, 2.0, 0.5])
