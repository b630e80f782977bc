"""What a number format makes of a number, as Excel shows it."""

import pytest

from report.sheet.number_format import is_percentage, misleading, shows_nothing


@pytest.mark.parametrize(
    ("code", "unit", "how"),
    [
        ('0" mm"', "in", "in mm"),
        ('0.0"kg"', "lb", "in kg"),
        (r"0.0\ \m\m", "in", "in mm"),
        ("[$mm]0", "in", "in mm"),
        ('#,##0;-0.0" mm"', "in", "in mm"),
        ('0"%"', "", "in %"),
        (r"0\%", "", "in %"),
        ("0°", "%", "in °"),
        ('0.0" ft²"', "ft", "in ft²"),
        ('0.0" in/min"', "in/s", "in in/min"),
        ('0" meters"', "ft", "in meters"),
        ('0" (mm)"', "in", "in mm"),
        ("0,", "lb", "divided by 1,000"),
        ("#,##0,", "lb", "divided by 1,000"),
        ("0.0,,", "lb", "divided by 1,000,000"),
        ("0,.0", "lb", "divided by 1,000"),
        ('#,##0.0,"k"', "kip", "divided by 1,000"),
    ],
)
def test_a_format_that_shows_another_number_is_told(code, unit, how):
    assert misleading(code, unit) == how


@pytest.mark.parametrize(
    ("code", "unit"),
    [
        ("General", "in"),
        ("", "in"),
        ("@", "in"),
        ("0.####", ""),
        ("#,##0", "lb"),
        ("#,##0.00_);[Red](#,##0.00)", "lb"),
        ('_($* #,##0.00_);_($* (#,##0.00);_($* "-"??_);_(@_)', "lb"),
        ("0.00E+00", "in"),
        ("# ?/?", "in"),
        ('0.0" in"', "in"),
        ('0.0" in."', "in"),
        (r"0.0\"", "in"),
        ("0'", "ft"),
        ('0" lbs"', "lb"),
        ('0" kips"', "kip"),
        ('0.0" mm"', "mm"),
        ('0.00"g"', "g"),
        ('0" in/sec"', "in/s"),
        ('0" deg in plan"', "deg"),
        ('0.0" in (mm)"', "in"),
        ('0"%"', "%"),
        ('0.0" approx."', "in"),
        ('"min. "0', "in"),
        ('0;-0;"none";" mm"@', "in"),
    ],
)
def test_a_format_with_its_own_unit_or_with_other_words_is_none(code, unit):
    assert misleading(code, unit) == ""


def test_a_percent_sign_that_is_written_as_text_is_no_percentage():
    assert [is_percentage(code) for code in ("0%", "0.0 %", r"0\%", '0"%"', "0_%")] == [
        True,
        True,
        False,
        False,
        False,
    ]


@pytest.mark.parametrize(
    ("code", "value", "nothing"),
    [
        (";;;", 5.0, True),
        (";;;", "text", True),
        ("0;;", -1, True),
        ("0;;", 1, False),
        ("0;-0;", 0, True),
        ('"n/a"', 5.0, True),
        ("0;;;@", "text", False),
        ("0", "text", False),
        ("General", 5.0, False),
        ("General;-General", -5.0, False),
        (";;;", True, False),
    ],
)
def test_a_format_without_digits_shows_nothing(code, value, nothing):
    assert shows_nothing(code, value) is nothing
