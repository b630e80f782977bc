"""What a number format makes of a number, as Excel shows it."""

import pytest

from report.sheet.reading.typed_text import is_percentage, misleading, shows_nothing

pytestmark = pytest.mark.quick


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
    ("unit", "codes"),
    [
        ("", ["0.####"]),
        ("lb", ["#,##0", "#,##0.00_);[Red](#,##0.00)", '0" lbs"',
                '_($* #,##0.00_);_($* (#,##0.00);_($* "-"??_);_(@_)']),
        ("in", ["General", "", "@", "0.00E+00", "# ?/?", '0.0" in"', '0.0" in."', r"0.0\"",
                '0.0" in (mm)"', '0.0" approx."', '"min. "0', '0;-0;"none";" mm"@']),
        ("ft", ["0'"]),
        ("kip", ['0" kips"']),
        ("mm", ['0.0" mm"']),
        ("g", ['0.00"g"']),
        ("in/s", ['0" in/sec"']),
        ("deg", ['0" deg in plan"']),
        ("%", ['0"%"']),
    ],
)  # fmt: skip
def test_a_format_with_its_own_unit_or_with_other_words_is_none(unit, codes):
    assert {code: misleading(code, unit) for code in codes} == dict.fromkeys(codes, "")


def test_a_percent_sign_that_is_written_as_text_is_no_percentage():
    assert is_percentage("0%")
    assert is_percentage("0.0 %")
    assert not any(map(is_percentage, (r"0\%", '0"%"', "0_%")))


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
