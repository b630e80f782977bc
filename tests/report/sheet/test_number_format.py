"""What a number format makes of a number, as Excel shows it."""

import pytest

from report.sheet.reading.typed_text import is_percentage, misleading, shows_nothing

pytestmark = pytest.mark.quick


@pytest.mark.parametrize(
    ("how", "unit", "codes"),
    [
        ("in mm", "in", ['0" mm"', r"0.0\ \m\m", "[$mm]0", '#,##0;-0.0" mm"', '0" (mm)"']),
        ("in kg", "lb", ['0.0"kg"']),
        ("in %", "", ['0"%"', r"0\%"]),
        ("in °", "%", ["0°"]),
        ("in ft²", "ft", ['0.0" ft²"']),
        ("in in/min", "in/s", ['0.0" in/min"']),
        ("in meters", "ft", ['0" meters"']),
        ("divided by 1,000", "lb", ["0,", "#,##0,", "0,.0"]),
        ("divided by 1,000", "kip", ['#,##0.0,"k"']),
        ("divided by 1,000,000", "lb", ["0.0,,"]),
    ],
)
def test_a_format_that_shows_another_number_is_told(how, unit, codes):
    assert {code: misleading(code, unit) for code in codes} == dict.fromkeys(codes, how)


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
    ("nothing", "cells"),
    [
        (True, [(";;;", 5.0), (";;;", "text"), ("0;;", -1), ("0;-0;", 0), ('"n/a"', 5.0)]),
        (False, [("0;;", 1), ("0;;;@", "text"), ("0", "text"), ("General", 5.0), (";;;", True),
                 ("General;-General", -5.0)]),
    ],
)  # fmt: skip
def test_a_format_without_digits_shows_nothing(nothing, cells):
    assert [shows_nothing(*cell) for cell in cells] == [nothing] * len(cells)
