"""Numbers, lengths, dates and choices as people type them, and number formats."""

import datetime as dt
import math

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from fixtures.cells import cell
from fixtures.marks import by_day, nightly
from fixtures.project_parts import FT
from fixtures.workbooks import (
    cell_address,
    edit,
    make,
    problems,
    read_workbook,
    type_into,
    with_addresses,
)
from report.project.model.choices import RuleSetName, UnitsFirst
from report.project.read import number_formats
from report.project.read.cells import plain
from report.project.read.read import read
from report.project.read.typed_text import choice_in, dates_in, inches_in, number_in, rise_in

NUMBERS = {
    "0.45": 0.45, "0,5": 0.5, ",45": 0.45, "-12,5": -12.5, "0,500": 0.5, "1,234.5": 1234.5,
    "1,234,567": 1234567.0, "1e-3": 1e-3, "4 1/2": 4.5, "28\u00bd": 28.5,
}  # fmt: skip


@pytest.mark.parametrize(("text", "value"), NUMBERS.items())
@pytest.mark.quick
def test_a_number_with_one_meaning_is_read(text, value):
    assert number_in(text) == value


@pytest.mark.parametrize(
    "text",
    ["", "0,4,5", "1.2.3", "0.45 (0.5)", "0.45 (wet)", "36 (m)", "42 (kip)", "2 (x 3)", "(wet)",
     "٣", "1_000", "nan", "inf", "0x1f", "4 5", "0.45*", "4 5/2", "1/2", "36 typ.", "mu = 0.45",
     "1,234", "12,345", "-1,234"],  # a comma before three digits may be either
)  # fmt: skip
@pytest.mark.quick
def test_a_number_with_two_meanings_or_none_is_not(text):
    assert not math.isfinite(number_in(text))


INCHES = {
    "28'-6\"": 342.0, "4'-0\"": 48.0, "4'": 48.0, '48"': 48.0, "28' 6 1/2\"": 342.5,
    "3 1/2''": 3.5, '1/2"': 0.5, "28\u2019-6\u201d": 342.0, "-28'-6\"": -342.0, "2.5'": 30.0,
    "0'-6\"": 6.0, "28'6\"": 342.0, '6\u00bd"': 6.5, "28'-6 \u00bd\"": 342.5,
    "28\u2019\u20136\u201d": 342.0, "48\u201c": 48.0,
}  # fmt: skip


@pytest.mark.parametrize(("text", "inches"), INCHES.items())
def test_a_length_with_marks_is_read(text, inches):
    assert inches_in(text) == pytest.approx(inches)


@pytest.mark.parametrize(
    "text", ["", "'", '"', "28", "28'-6", "6\"-28'", "4'x2'", '1/0"', "9 in", "28'-13\"",
             "28'-11/2\"", '11/2"', '3 13/8"']
)  # fmt: skip
def test_what_is_no_length_with_marks_is_not(text):
    assert math.isnan(inches_in(text))


RISES = {
    "1/2:12": 0.5, "1/4 : 12": 0.25, "1 1/2:12": 1.5, "0.5 in 12": 0.5, "2:12": 2.0, "1:24": 0.5,
    "1 : 48": 0.25, '1/4"/ft': 0.25, "1/4 in per ft": 0.25, '1/4" per foot': 0.25,
    '1/2":12"': 0.5, "1:12": 1.0,
}  # fmt: skip


@pytest.mark.parametrize(("text", "rise"), RISES.items())
def test_a_rise_in_12_is_read(text, rise):
    assert rise_in(text) == rise


@pytest.mark.parametrize("text", ["1/2", "2:24", "1/2:1", "2/12", ":12", "-1/2:12", "1/0:12",
                                  "1:0", "1/2 12", "1/2 in", "11/2:12",
                                  "13/8 in per ft"])  # fmt: skip
def test_another_ratio_is_no_rise_in_12(text):
    assert math.isnan(rise_in(text))


DAY = dt.date(2026, 11, 20)


@pytest.mark.parametrize(
    ("dates", "texts"),
    [
        ([DAY], ["Nov 20, 2026", "November 20, 2026", "nov 20 2026", "Nov. 20, 2026", "20 Nov 2026",
                 "20-Nov-2026", "November 20th, 2026", "Friday, November 20, 2026", "2026.11.20",
                 "2026-11-20 00:00:00", "2026/11/20", "2026-11-20", "11/20/2026", "20.11.2026"]),
        ([dt.date(2026, 9, 5)], ["Sept. 5, 2026"]),
        ([dt.date(2026, 3, 3)], ["3/3/2026"]),
        ([dt.date(2026, 3, 5), dt.date(2026, 5, 3)], ["3/5/2026"]),
        ([], ["20-Nov-26", "3/5/26", "Nov 2026", "Feb 30, 2026", "30/30/2026", "tomorrow"]),
    ],
)  # fmt: skip
def test_a_date_has_the_meanings_that_it_may_have(dates, texts):
    assert {text: dates_in(text) for text in texts} == dict.fromkeys(texts, dates)


KINDS = (
    "fixed object",
    "array of different construction",
    "edge with parapet",
    "edge without parapet",
)


CHOICES = {
    KINDS: {"  Fixed   OBJECT ": "fixed object", "fixed": "", "edge w/o parapet": "", "": ""},
    ("C", "D"): {"d": "D", "Site Class D": "", "": ""},
    RuleSetName: {"ASCE7-16": "ASCE 7-16", "asce 7-16": "ASCE 7-16", "ASCE 7": "", "PV1-2012": ""},
    ("g", "cm/s2"): {"cm/s": ""},
    ("D", "D (default)"): {"D default": "D (default)"},
}  # fmt: skip


@pytest.mark.parametrize(("choices", "texts"), CHOICES.items())
def test_a_choice_is_told_by_all_of_its_letters_and_digits(choices, texts):
    assert {text: choice_in(text, choices) for text in texts} == texts


# In three workbooks: each cell is typed in one way, and read as the value of a field.
AS_TYPED = [
    {
        "Arrays/A1/x to": ("28'-6\"", "x_to_m", pytest.approx(28.5 * FT)),
        "Arrays/A1/Slope": ("0,5", "slope_value", 0.5),
        "Project/Date": ("Nov 20, 2026", "date", DAY),
        "Site/Risk category": (2, "risk_category", "II"),
        "Site/Rule set": ("ASCE7-16", "rule_set", "ASCE 7-16"),
        "Objects/RTU-1/Type": ("Fixed  object", "kind", "fixed object"),
        "Clearances/1/Direction": ("Cross-Slope", "direction", "cross-slope"),
        "Arrays/A1/Slope unit": ("%", "slope_unit", "percent"),
    },
    {
        "Arrays/A1/Slope": ("1/2:12", "slope_value", 0.5),
        "Arrays/A1/Slope unit": ("in/12", "slope_unit", "in/12"),
        "Project/Date": ((DAY - dt.date(1899, 12, 30)).days, "date", DAY),
    },
    {"Arrays/A1/Slope unit": ("in/ft", "slope_unit", "in/12")},
    {  # the words of earlier workbooks
        "Clearances/1/Direction": ("Down", "direction", "downslope"),
        "Objects/RTU-1/Type": ("unlike array", "kind", "array of different construction"),
        "Options/Design value statistic": ("rule set", "statistic", "per rule set"),
        "Options/Sheet size of the roof plan": ("by size", "plan_paper", "automatic"),
    },
]


# A remark in a cell, and the end of its message.
REMARKS = {
    "Arrays/A1/Friction coefficient": ("0.45 (wet)", "enter a number from 0 to 1.5"),
    "Site/Site class": ("Site Class D", "choose A, B, BC, C, CD, D, D (default), DE, E or F"),
    "Objects/RTU-1/Type": (
        "fixed",
        f"choose {', '.join(KINDS[:-1])} or {KINDS[-1]}",
    ),
}


def test_a_remark_in_a_cell_is_an_error_that_says_what_to_type(tmp_path):
    path = type_into(make(tmp_path), {name: text for name, (text, _) in REMARKS.items()})
    expected = [f"{name} is '{text}'; {wanted}" for name, (text, wanted) in REMARKS.items()]
    assert sorted(problems(path)) == sorted(with_addresses(*expected))


@pytest.mark.parametrize("cells", by_day(AS_TYPED, 1))
def test_cells_are_read_as_they_are_typed(tmp_path, cells):
    typed = {name: text for name, (text, _, _) in cells.items()}
    inputs = read(type_into(make(tmp_path), typed)).inputs
    for name, (_, field, value) in cells.items():
        section = name.partition("/")[0].lower()
        assert inputs[section][0][field] == value, name


LETTERS = "0123456789.,:;'\"/ -+()eEinfwetdry\u2019\u201d\u0661"
TYPED = st.text(st.sampled_from(LETTERS), max_size=14)


@pytest.mark.parametrize("count", [100, nightly(10_000)])
def test_any_text_is_one_number_or_none(count):
    """Oracle of numbers: Python's own, for a text of digits with at most one point or comma."""

    @settings(max_examples=count, deadline=None)
    @given(TYPED)
    def holds(text):
        for found in (number_in(text), inches_in(text), rise_in(text)):
            assert isinstance(found, float)
        assert all(isinstance(day, dt.date) for day in dates_in(text))
        assert choice_in(text, KINDS) in ("", *KINDS)

    @settings(max_examples=count, deadline=None)
    @given(st.integers(0, 10**9), st.integers(0, 99), st.sampled_from("+-"))
    def is_read(whole, hundredths, sign):
        value = float(f"{sign}{whole}.{hundredths:02}")
        for point in ".,":
            assert number_in(f"{sign}{whole}{point}{hundredths:02}") == value
        if whole:
            assert number_in(f"{sign}{whole:,}.{hundredths:02}") == value
        feet, inches = divmod(whole, 12)
        assert inches_in(f"{sign}{feet}'-{inches}\"") == float(f"{sign}{whole}")

    holds()
    is_read()


PLAIN = {
    0.1 + 0.2: "0.3", 47.99999999999999: "48", 0.59000000000000008: "0.59", 48.0: "48",
    1e-7: "1e-07", dt.datetime(2026, 11, 20): "2026-11-20", True: "TRUE",
}  # fmt: skip


def test_a_number_has_the_digits_that_a_spreadsheet_keeps():
    assert [plain(value) for value in PLAIN] == [*PLAIN.values()]


@pytest.mark.quick
@pytest.mark.parametrize(
    ("how", "unit", "codes"),
    [("in mm", "in", ['0" mm"', r"0.0\ \m\m", "[$mm]0", '#,##0;-0.0" mm"', '0" (mm)"']),
     ("in %", "", ['0"%"', r"0\%"]), ("in ft²", "ft", ['0.0" ft²"']),
     ("in in/min", "in/s", ['0.0" in/min"']), ("in meters", "ft", ['0" meters"']),
     ("divided by 1,000", "lb", ["0,", "#,##0,", "0,.0", '#,##0.0,"k"']),
     ("divided by 1,000,000", "lb", ["0.0,,"])],
)  # fmt: skip
def test_a_format_that_shows_another_number_is_told(how, unit, codes):
    assert {code: number_formats.misleading(code, unit) for code in codes} == dict.fromkeys(
        codes, how
    )


@pytest.mark.parametrize(
    ("unit", "codes"),
    [("lb", ["#,##0", "#,##0.00_);[Red](#,##0.00)", '0" lbs"',
             '_($* #,##0.00_);_($* (#,##0.00);_($* "-"??_);_(@_)']),
     ("in", ["General", "", "@", "0.00E+00", "# ?/?", '0.0" in"', '0.0" in."', r"0.0\"",
             '0.0" in (mm)"', '0.0" approx."', '"min. "0', '0;-0;"none";" mm"@']),
     ("ft", ["0'"]), ("in/s", ['0" in/sec"']), ("deg", ['0" deg in plan"']), ("%", ['0"%"'])],
)  # fmt: skip
def test_a_format_with_its_own_unit_or_with_other_words_is_none(unit, codes):
    assert {code: number_formats.misleading(code, unit) for code in codes} == dict.fromkeys(
        codes, ""
    )


@pytest.mark.parametrize(
    ("nothing", "cells"),
    [
        (True, [(";;;", 5.0), (";;;", "text"), ("0;;", -1), ("0;-0;", 0), ('"n/a"', 5.0)]),
        (False, [("0;;", 1), ("0;;;@", "text"), ("0", "text"), ("General", 5.0), (";;;", True),
                 ("General;-General", -5.0)]),
    ],
)  # fmt: skip
def test_a_format_without_digits_shows_nothing(nothing, cells):
    assert [number_formats.shows_nothing(*cell) for cell in cells] == [nothing] * len(cells)


# Cell, number format, and how it shows the number; what to give instead.
MISLEADING = [
    ("Arrays/A1/CG height", '0" mm"', "9, shown in mm", "greater than 0 [in]"),
    ("Arrays/A1/Weight", "0,", "42000, shown divided by 1,000", "greater than 0 [lb]"),
    ("Site/Structure height h", '0.0" m"', "36, shown in m", "0 [ft]"),
    ("Options/1/Value", '0" ft"', "18, shown in ft", "enter a number"),
    ("Motions/M2/Factor or PPA", '0.0"g"', "2, shown in g", "greater than 0"),
]


def formatted(path, formats):
    """Give cells their number formats."""

    def change(book):
        for name, code in formats.items():
            cell(book, name).number_format = code

    return edit(path, change)


@pytest.mark.parametrize(("name", "code", "what", "wish"), by_day(MISLEADING, 1))
def test_a_number_shown_in_another_unit_or_in_thousands_is_an_error(
    tmp_path, name, code, what, wish
):
    (line,) = problems(formatted(make(tmp_path), {name: code}))
    (begin,) = with_addresses(f"{name} is {what} by its number format ({code}); enter a number")
    assert line.startswith(begin)
    assert line.endswith(", formatted as a number")
    assert wish in line


OWN_UNITS = {
    "US": {
        "Arrays/A1/CG height": '0.0" in"', "Arrays/A1/Weight": "#,##0", "Options/1/Value": '0" in"',
        "Arrays/A1/Friction coefficient": '0.00" (lab)"', "Site/S_DS": '0.000"g"',
        "Arrays/A1/Slope": "0.0°", "Arrays/A2/Slope": '0.0"%"',  # in degrees, and in percent
        "Motions/M3/Factor or PPA": '0.0"g"',  # a PPA
    },
    "SI": {"Arrays/A1/CG height": '0.0" mm"', "Site/Structure height h": '0.0" m"'},
}  # fmt: skip


@pytest.mark.parametrize("units", by_day(OWN_UNITS, 1))
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
    },
    # A unit that cannot be chosen must be that of the sheet.
    {
        "Site/F_a/Unit": ("%", "F_a is '%'; it has no unit: delete it"),
        "Site/S_DS/Unit": ("m/s2", "S_DS is 'm/s2'; enter the number in g, and write g"),
        "Links/heading/Link stiffness": (
            "Link stiffness [psi]", "link stiffness is 'psi'; write one of lb/in, kip/in,"),
    },
]  # fmt: skip


@pytest.mark.parametrize("units", UNITS, ids=["headings", "single fields"])
def test_a_unit_must_be_valid(tmp_path, units):
    cells = {name: unit for name, (unit, _) in units.items()}
    reported = problems(type_into(make(tmp_path), cells))
    for line, (name, (_, wanted)) in zip(reported, units.items(), strict=True):
        assert line.startswith(f"{cell_address(name)}: unit of {wanted}")


def test_a_percentage_is_an_error_with_the_number_that_excel_holds(tmp_path):
    def percent(book):
        slope = cell(book, "Arrays/A2/Slope")
        slope.value, slope.number_format = 0.05, "0.0%"

    assert problems(edit(make(tmp_path), percent)) == with_addresses(
        "Arrays/A2/Slope is a percentage (5%, which Excel stores as 0.05); enter a number of 0 or"
        " more, formatted as a number"
    )
