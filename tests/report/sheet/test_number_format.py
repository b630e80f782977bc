"""What a number format makes of a number, as Excel shows it, and units that cells may not state."""

import pytest

from cells import cell
from nightly import by_day
from report.sheet.reading.typed_text import is_percentage, misleading, shows_nothing
from report.sheet.schema.choices import UnitsFirst
from sheets import at, edit, make, problems, read_workbook, said, type_into


@pytest.mark.quick
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


# Cell, number format, and how it shows the number; what to give instead.
MISLEADING = [
    ("Arrays/A1/CG height", '0" mm"', "9, shown in mm", "more than 0 [in]"),
    ("Arrays/A1/Weight", "0,", "42000, shown divided by 1,000", "more than 0 [lb]"),
    ("Arrays/A1/Friction coefficient", '0.00"g"', "0.45, shown in g", "from 0 to 1.5"),
    ("Arrays/A1/Slope", '0.0"%"', "0.5, shown in %", "0 or more"),
    ("Site/Structure height h", '0.0" m"', "36, shown in m", "0 [ft]"),
    ("Options/1/Value", '0" ft"', "18, shown in ft", "give a number"),
    ("Motions/M2/Factor or PPA", '0.0"g"', "2, shown in g", "more than 0"),
]


def formatted(path, formats):
    """Give cells their number formats."""

    def change(book):
        for name, code in formats.items():
            cell(book, name).number_format = code

    return edit(path, change)


@pytest.mark.parametrize(("name", "code", "what", "wish"), by_day(MISLEADING, 2))
def test_a_number_shown_in_another_unit_or_in_thousands_is_an_error(
    tmp_path, name, code, what, wish
):
    (line,) = problems(formatted(make(tmp_path), {name: code}))
    (begin,) = said(f"{name} is {what} by its number format ({code}); give a number")
    assert line.startswith(begin)
    assert line.endswith(", formatted as a number")
    assert wish in line


OWN_UNITS = {
    "US": {
        "Arrays/A1/CG height": '0.0" in"', "Arrays/A1/Weight": "#,##0",
        "Arrays/A2/Weight": '#,##0" lbs"', "Arrays/A1/Friction coefficient": '0.00" (lab)"',
        "Arrays/A1/Slope": "0.0°",  # in degrees
        "Arrays/A2/Slope": '0.0"%"',  # in percent
        "Options/1/Value": '0" in"', "Site/S_DS": '0.000"g"',
        "Motions/M3/Factor or PPA": '0.0"g"',  # a PPA
    },
    "SI": {"Arrays/A1/CG height": '0.0" mm"', "Site/Structure height h": '0.0" m"'},
}  # fmt: skip


@pytest.mark.parametrize("units", OWN_UNITS)
def test_a_number_format_may_name_the_unit_of_its_cell(tmp_path, units):
    read_workbook(formatted(make(tmp_path, UnitsFirst(units)), OWN_UNITS[units]))


LENGTHS = "write one of in, ft, mm, cm, m"

# Cells that are changed in one workbook, and how the line of each begins after `unit of`.
UNITS = [
    {
        "Arrays/heading/Friction coefficient": (
            "Friction coefficient [%]", "friction coefficient is '%'; it has no unit: delete it"),
        "Arrays/heading/Weight": ("Weight [t]", "weight is 't'; write one of lb, kip, N, kN, kg"),
        "Arrays/heading/CG height": ("CG height", f"CG height is missing; {LENGTHS}"),
        "Arrays/heading/Downslope direction": (
            "Downslope direction [rad]", "downslope direction is 'rad'; give the number"),
    },
    # A unit that cannot be chosen must be that of the sheet.
    {
        "Site/F_a/Unit": ("%", "F_a is '%'; it has no unit: delete it"),
        "Site/S_DS/Unit": ("m/s2", "S_DS is 'm/s2'; give the number in g, and write g"),
        "Building/Period T1/Unit": ("Hz", "period T1 is 'Hz'; give the number in s, and write s"),
        "Building/Damping/Unit": ("-", "damping is '-'; give the number in %, and write %"),
    },
    {
        "Friction tests/heading/Velocity": (
            "Velocity [mph]", "velocity is 'mph'; write one of in/s, in/min,"),
        "Links/heading/Link stiffness": (
            "Link stiffness [psi]", "link stiffness is 'psi'; write one of lb/in, kip/in,"),
    },
]  # fmt: skip


@pytest.mark.parametrize("units", UNITS, ids=["headings", "single fields", "other headings"])
def test_a_unit_must_be_valid(tmp_path, units):
    cells = {name: unit for name, (unit, _) in units.items()}
    reported = problems(type_into(make(tmp_path), cells))
    for line, (name, (_, wanted)) in zip(reported, units.items(), strict=True):
        assert line.startswith(f"{at(name)}: unit of {wanted}")


def test_a_percentage_is_an_error_with_the_number_that_excel_holds(tmp_path):
    def percent(book):
        slope = cell(book, "Arrays/A2/Slope")
        slope.value, slope.number_format = 0.05, "0.0%"

    assert problems(edit(make(tmp_path), percent)) == said(
        "Arrays/A2/Slope is a percentage (5%, which Excel holds as 0.05); give a number of 0 or"
        " more, formatted as a number"
    )
