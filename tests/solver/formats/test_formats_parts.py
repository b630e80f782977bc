"""Channels, headings and numbers of files. Oracles: each meaning by hand, Python's numbers."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from fixtures.errors import input_problems
from fixtures.spaces import spaced
from solver.errors import InputError
from solver.formats import read_motion_file
from solver.formats.channels import motion_file, offset_notes, peak_notes
from solver.formats.numbers import (
    Block,
    FieldFormat,
    each,
    fixed_rows,
    fixed_values,
    free_values,
    header_values,
    layout_of,
    printed,
)
from solver.formats.phrases import Kind, parse, remark, settled, units_in, words
from solver.formats.record_file import distinct
from solver.formats.source import Source
from solver.records.record import UNIT_CHOICES, UNITS, Record, is_other_unit, unit_size

pytestmark = pytest.mark.quick

G = 9.80665
SOURCE = Source(name="a.v2", lines=[], units="", dt_s=math.nan)


def made(*names, notes=()):
    channels = [
        Record(name=name, dt_s=0.01, a_mps2=np.array([0.0, float(i)]), notes=notes)
        for i, name in enumerate(names, start=1)
    ]
    return motion_file(SOURCE, "made", channels, ["of the file"])


def test_a_channel_is_chosen_by_name_then_by_number():
    channels = made("CHAN  1: EW ", "CHAN  2: NS", "3: Up")
    assert channels.channel("chan 1:  ew").a_mps2[1] == 1.0
    assert channels.channel(" 2 ").name == "CHAN 2: NS"
    assert channels.channel("3").name == "3: Up"
    assert made("2", "1").channel("1").a_mps2[1] == 2.0
    assert made("180").channel().name == "180"
    assert made("").channel().name == "a.v2"


@pytest.mark.parametrize(
    ("names", "wanted", "problem"),
    [
        ("x y", "", "found several channels; use one by name or number: 1 x; 2 y"),
        *(
            ("x y", name, f"found no channel '{name}'; use one by name or number: 1 x; 2 y")
            for name in ("z", "3", "0", "-1")
        ),
        ("North Vertical", "vertcal",
         "found no channel 'vertcal'; did you mean 'Vertical'? Use one by name or number: "
         "1 North; 2 Vertical"),
    ],
)  # fmt: skip
def test_a_channel_that_is_not_there_is_refused_with_those_that_are(names, wanted, problem):
    assert input_problems(made(*names.split()).channel, wanted) == (f"a.v2: {problem}",)


def test_names_and_notes_of_channels_differ_and_long_lists_are_cut():
    (problem,) = input_problems(made(*(f"c{i}" for i in range(40))).channel, "roof")
    assert problem.endswith("30 c29; ... and 10 more")
    assert distinct(["x", " X", "", "x (2)", "x"]) == [
        "x", "X (2)", "channel 3", "x (2) (2)", "x (3)",
    ]  # fmt: skip
    assert made("x", notes=("odd",)).notes == ("of the file", "odd")
    assert made("x", "y", notes=("odd",)).notes == ("of the file", "x: odd", "y: odd")
    (problem,) = input_problems(made)
    assert problem.startswith("a.v2: found no acceleration in this made file; use a")
    short = Record(name="x", dt_s=0.01, a_mps2=np.zeros(1), notes=())
    (problem,) = input_problems(motion_file, SOURCE, "made", [short])
    assert problem == "a.v2: found 1 sample; enter at least 2"


def test_stated_peaks_and_offsets_are_told():
    a = np.array([0.0, -0.5 * G, 0.2 * G])
    assert peak_notes(SOURCE, 3, -0.5 * G, a) == ()
    assert peak_notes(SOURCE, 3, 0.504 * G, a) == ()
    assert spaced(peak_notes(SOURCE, 3, 0.6 * G, a)) == (
        "the header states a peak of 0.6 g, the values reach 0.5 g",
    )
    for unknown in (0.0, math.nan, math.inf):
        assert peak_notes(SOURCE, 3, unknown, a) == ()
    for stated in (0.24 * G, 1.01 * G):
        with pytest.raises(InputError, match=r"a\.v2:4: the header states a peak of .* agree"):
            peak_notes(SOURCE, 3, stated, a)
    assert offset_notes(np.array([1.0, -1.0, 0.0])) == ()
    assert offset_notes(np.zeros(5)) == ()
    assert spaced(offset_notes(np.array([0.1 * G, -0.05 * G]))) == (
        "uncorrected: the mean is 0.025 g, 25% of the peak; it is not removed",
    )


def shaken(code, at=(20,), unit="g", peak=0.3):
    size = {"g": 1.0, "cm/s2": 981.0, "m/s2": 9.81}[unit]
    values = [f"{peak * size * math.sin(0.3 * k) * math.exp(-0.01 * k):.6f}" for k in range(300)]
    for index in at:
        values[index] = code
    return "\n".join(values) + "\n"


@pytest.mark.parametrize(
    ("code", "unit", "at"),
    [
        ("-999", "g", (20,)), ("-999.0", "g", (20, 21, 22)), ("9999", "cm/s2", (0,)),
        ("-9999.00", "cm/s2", (299,)), ("99999", "cm/s2", (7,)), ("999.99", "m/s2", (7, 90)),
        ("-999.25", "g", (7,)), ("-12345", "cm/s2", (7,)), ("32767", "cm/s2", (7,)),
        ("99.99", "g", (7,)), ("-99", "g", (7,)),
    ],
)  # fmt: skip
def test_a_code_for_missing_data_is_no_sample(file, code, unit, at):
    (problem,) = input_problems(
        read_motion_file, file(shaken(code, at, unit)), units=unit, dt_s=0.01
    )
    shown = "99999" if code == "999.99" else f"{float(code):g}"  # the file may be of cm/s2
    assert f"roof.csv: sample {at[0] + 1} is {shown} where no other exceeds" in problem
    assert "code for missing data" in problem


def test_codes_beside_shaking_and_gravity_are_told(file):
    for code, unit, peak in (("-999", "cm/s2", 0.05), ("-999", "g", 1.4)):
        path = file(shaken(code, unit=unit, peak=peak))
        (problem,) = input_problems(read_motion_file, path, units=unit, dt_s=0.01)
        assert "code for missing data" in problem
    # Strong shaking is nearly as large as the code, which is no peak of it; 999 may be one.
    for at in (26, 31):
        path = file(shaken("-999", at=(at,), unit="cm/s2", peak=0.6))
        (problem,) = input_problems(read_motion_file, path, units="cm/s2", dt_s=0.01)
        assert "code for missing data" in problem
    peak = "".join(f"{value}\n" for value in (0, 300, 700, 999, 800, 200, -400, 0))
    assert read_motion_file(file(peak), units="cm/s2", dt_s=0.01).channels
    rows = "".join(f"{k / 100},{0.1 * (-1) ** k},{1 - 0.1 * (-1) ** k}\n" for k in range(50))
    path = file(f"t_s,X_g,Z_g\n{rows}")
    assert spaced(read_motion_file(path).notes) == (
        "Z: the mean is about 1 g because the record includes gravity",
    )


@pytest.mark.parametrize(
    ("code", "unit", "peak"), [("-999", "cm/s2", 0.9), ("9.99", "m/s2", 0.9), ("1.5", "g", 0.3)]
)
def test_a_large_sample_that_shaking_may_have_is_one(file, code, unit, peak):
    path = file(shaken(code, unit=unit, peak=peak))
    assert read_motion_file(path, units=unit, dt_s=0.01).channels


G = 9.80665


SIZES = {
    G: ("g", "G", "gn", "g's"), G / 10: ("g/10",), G / 100: ("%g",),
    G / 1000: ("mg", "milli-g", "milli g"), G / 1e6: ("µg", "ug", "micro-g"),
    1.0: ("m/s2", "m/s/s", "m/s**2", "m/s^2", "m/s²", "m/sec/sec", "m s-2", "m·s⁻²", "m_s2",
          "mps2", "m.s-2", "meter/s2"),
    0.01: ("gal", "Gals", "CM/SEC/SEC", "cm/sec2", "cm_s2", "cmps2"),
    0.001: ("mm/s/s",), 0.3048: ("ft/s2", "feet/sec^2"), 0.0254: ("in/s2", "Inches/sec2"),
    1e-6: ("um/s2", "µm/s²"), 1e-9: ("nm/s2", "nm/s**2"),
}  # fmt: skip


@pytest.mark.parametrize(
    ("text", "size"), [(text, size) for size, texts in SIZES.items() for text in texts]
)
def test_spellings_of_a_unit_have_its_size(text, size):
    assert unit_size(text) == pytest.approx(size, rel=1e-15)


def test_words_and_units_of_headings_are_those_known():
    assert (*UNITS, "gal") == UNIT_CHOICES
    others = ("", "cm", "cm/s", "s", "volt", "counts", "km/s2", "gallon", "ms2")
    assert all(math.isnan(unit_size(text)) for text in others)
    texts = ("cm", "CM/SEC", "m/s", "in", "g", "s")
    assert list(filter(is_other_unit, texts)) == ["cm", "CM/SEC", "m/s", "in"]
    numbers = ("sample", "Index", "No.", "N", "n_g", "NS", "t")
    assert [parse(word).is_index for word in numbers] == [True] * 4 + [False] * 3
    assert words("Time [s] Acc (cm/s2) NS", None) == ["Time [s]", "Acc (cm/s2)", "NS"]
    assert words("t;a b;c", ";") == ["t", "a b", "c"]


@pytest.mark.parametrize(
    ("text", "name", "kind", "unit"),
    [
        ("t", "t", Kind.TIME, ""),
        ("Time (sec)", "Time", Kind.TIME, "sec"),
        ("time_ms", "time", Kind.TIME, "ms"),
        ("Zeit", "Zeit", Kind.TIME, ""),
        ("chan_s", "chan_s", Kind.UNSAID, ""),
        ("a_m_s2", "a", Kind.ACCELERATION, "m_s2"),
        ("EW [cm/s2]", "EW", Kind.ACCELERATION, "cm/s2"),
        ('"Acc (gal)"', "Acc", Kind.ACCELERATION, "gal"),
        ("velocity_g", "velocity", Kind.OTHER, "g"),
        ("pseudo-velocity accel_g", "pseudo-velocity accel", Kind.ACCELERATION, "g"),
        ("level_g", "level", Kind.ACCELERATION, "g"),
        ("EW [yd/s^2]", "EW", Kind.OTHER, "yd/s^2"),
        ("plug_in", "plug_in", Kind.UNSAID, ""),
    ],
)
def test_a_heading_says_name_kind_and_unit(text, name, kind, unit):
    heading = parse(text)
    assert (heading.name, heading.kind, heading.unit) == (name, kind, unit)
    assert heading.seconds == (0.001 if unit == "ms" else 1.0)


@pytest.mark.parametrize(
    ("text", "seconds"),
    [
        ("Time [min]", 60.0),
        ("t in minutes", 60.0),
        ("ms", 0.001),
        ("t (msec)", 0.001),
        ("Time [us]", math.nan),
        ("Time (UTC)", math.nan),
        ("hours", math.nan),
    ],
)
def test_a_time_in_an_unknown_unit_has_no_value_in_seconds(text, seconds):
    heading = parse(text)
    assert heading.kind is Kind.TIME
    assert heading.seconds == pytest.approx(seconds, nan_ok=True)


def test_remarks_and_letters_name_columns_only_where_they_must():
    prose = "t_s,acc_g  San Francisco, 575 Market, 42nd floor"
    assert [heading.name for heading in remark(prose, ",", 2)] == ["t", "acc"]
    assert remark("made by hand, long ago", ",", 2) == []
    assert remark("t_s", ",", 2) == []
    assert remark("t_s", None, 1) == []
    assert [h.unit for h in settled([*map(parse, ("t", "ch_f", "ch_g"))])] == ["", "", ""]
    assert [h.unit for h in settled([*map(parse, ("t", "ch_gal", "ch_g"))])] == ["", "gal", "g"]
    assert settled([*map(parse, ("t", "EW", "vel_g"))])[2].kind is Kind.OTHER


@pytest.mark.parametrize(
    ("line", "units"),
    [
        ("units: cm/s2", ["cm/s2"]),
        ("ACCELERATION TIME SERIES IN UNITS OF IN/SEC/SEC", ["IN/SEC/SEC"]),
        ("accelerations in units of g.", ["g"]),
        ("a in m/s², north", ["m/s²"]),
        ("roof acceleration [g]", ["g"]),
        ("Acceleration, cm/s2", ["cm/s2"]),
        ("# acc: gal, corrected", ["gal"]),
        ("Corrected acceleration - cm/sec**2", ["cm/sec**2"]),
        ("PGA = 300 cm/s2, station: G, Vs30 = 760 m/s", []),
        ("in the north [roof]", []),
        ("units unknown", []),
    ],
)
def test_prose_may_state_units(line, units):
    assert list(dict.fromkeys(units_in(line))) == units


def source(*lines):
    return Source(name="a", lines=list(lines), units="", dt_s=math.nan)


def block(count, stop, first=0):
    return Block(first=first, stop=stop, count=count, promised=9)


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("8F10.3", (8, 10)),
        (" 10I8", (10, 8)),
        ("1F15.6E", (1, 15)),
        ("free", None),
        ("8F0.3", None),
        ("", None),
    ],
)
def test_a_fortran_format_gives_fields_and_width(text, expected):
    layout = layout_of(text)
    assert (layout and (layout.per_line, layout.width)) == expected


@given(st.lists(st.integers(-99999, 999999), min_size=2, max_size=40))
def test_touching_fields_are_cut_by_width(values):
    fields = [f"{value / 1000:8.3f}" for value in values]
    lines = ["".join(fields[i : i + 5]) for i in range(0, len(fields), 5)]
    read = fixed_values(
        source(*lines), block(len(values), len(lines)), FieldFormat(per_line=5, width=8)
    )
    assert read.tolist() == [value / 1000 for value in values]


def test_numbers_may_be_set_left_touch_or_be_unused():
    layout = FieldFormat(per_line=2, width=8)
    read = fixed_values(source("1.5     -2.D+01 ", "3"), block(3, 2), layout)
    assert read.tolist() == [1.5, -20.0, 3.0]
    assert free_values(source("1.5 -2.D+01", "", "3"), block(3, 3)).tolist() == [1.5, -20.0, 3.0]
    read = free_values(source("-.1234E-02-.5678E+01 1.-2.5+3"), block(5, 1))
    assert read.tolist() == [-0.001234, -5.678, 1.0, -2.5, 3.0]
    # An exponent without its letter is not guessed at: the count does not hold.
    with pytest.raises(InputError, match=r"a:10: states 2 values, found 3"):
        free_values(source("1.0-101 2.0"), block(2, 1))
    numbers = header_values(source("   1****", "    -2.5"), 0, 6, FieldFormat(per_line=2, width=4))
    none, values = math.nan, [number.value for number in numbers]
    assert np.array_equal(values, [1.0, none, none, -2.5, none, none], equal_nan=True)
    assert [number.index for number in numbers] == [0, 0, 1, 1, 2, 2]


def test_short_lines_are_allowed_only_where_they_are_asked_for():
    layout, lines = FieldFormat(per_line=2, width=4), ("   1   2", "   3    ", "   4   5")
    assert fixed_rows(source(*lines), block(5, 3), layout).tolist() == [1, 2, 3, 4, 5]
    told = input_problems(fixed_values, source(*lines), block(6, 3), layout)
    assert told == ("a:2: found 1 value; enter 2",)
    told = input_problems(fixed_rows, source("  1x   2"), block(2, 1), layout)
    assert told == ("a:1: found '1x'; enter a number",)


@pytest.mark.parametrize("field", ["1_0", "nan", "inf", "1e999", "", "1 2", "****", "٣"])
def test_what_python_or_numpy_may_take_but_is_no_number_is_refused(field):
    lines = (f"{field:>8}       2", "       3       4")
    layout = FieldFormat(per_line=2, width=8)
    (problem,) = input_problems(fixed_values, source(*lines), block(4, 2), layout)
    assert problem.startswith(f"a:1: found {field!r}")


@pytest.mark.parametrize(
    ("count", "told"),
    [
        (5, "found 4; use the complete"),
        (9, "found 4; use the complete"),
        (3, "found 4; correct the count"),
        (2, "found more in line 2"),
    ],
)
def test_counts_that_do_not_hold_are_told_at_the_line_of_the_promise(count, told):
    lines = source("   1   2", "   3   4", "no more")
    problem = input_problems(
        fixed_values, lines, block(count, 3), FieldFormat(per_line=2, width=4)
    )[0]
    assert problem.startswith(f"a:10: states {count} values, {told}")


@pytest.mark.parametrize(
    ("text", "value", "rounding"),
    [
        (" .005 ", 0.005, 0.0005),
        ("200", 200.0, 0.0),
        ("0.1700000E+39", 1.7e38, 5e31),
        (".20000E-01", 0.02, 5e-7),
        ("7.8125", 7.8125, 5e-5),
    ],
)
def test_a_printed_number_knows_its_rounding(text, value, rounding):
    assert all(math.isnan(printed(other, 0).value) for other in ("", "x", "1e", ".", "1,5", "--1"))
    number = printed(text, 3)
    assert (number.value, number.index) == (value, 3)
    assert number.rounding == pytest.approx(rounding, rel=1e-12)


def test_problems_of_all_items_are_told_together():
    def read(item):
        if item % 2:
            raise InputError([f"{item} is odd", "that is all"])
        return item * 10

    assert each(read, [2, 4]) == [20, 40]
    told = ("1 is odd", "that is all", "3 is odd", "that is all")
    assert input_problems(each, read, [1, 2, 3]) == told
