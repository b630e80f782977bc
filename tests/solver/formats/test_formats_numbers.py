"""Numbers in lines. Oracle: Python's own numbers."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from refused import refused
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
from solver.formats.source import Source
from solver.model import InputError

pytestmark = pytest.mark.quick


def source(*lines):
    return Source(name="a", lines=list(lines), units="", dt_s=math.nan)


def block(count, stop, first=0):
    return Block(first=first, stop=stop, count=count, promised=9)


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("8F10.3", (8, 10)),
        ("8f9.6", (8, 9)),
        (" 10I8", (10, 8)),
        ("1F15.6E", (1, 15)),
        ("5ES15.7", (5, 15)),
        ("free", None),
        ("0F10.3", None),
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
    told = refused(fixed_values, source(*lines), block(6, 3), layout)
    assert told == ("a:2: found 1 value; give 2",)
    told = refused(fixed_rows, source("  1x   2"), block(2, 1), layout)
    assert told == ("a:1: found '1x'; give a number",)


@pytest.mark.parametrize("field", ["1_0", "nan", "inf", "1e999", "", "1 2", "****", "٣"])
def test_what_python_or_numpy_may_take_but_is_no_number_is_refused(field):
    lines = (f"{field:>8}       2", "       3       4")
    layout = FieldFormat(per_line=2, width=8)
    (problem,) = refused(fixed_values, source(*lines), block(4, 2), layout)
    assert problem.startswith(f"a:1: found {field!r}")


@pytest.mark.parametrize(
    ("count", "told"),
    [
        (5, "found 4; give the whole"),
        (9, "found 4; give the whole"),
        (3, "found 4; correct the count"),
        (2, "found more in line 2"),
    ],
)
def test_counts_that_do_not_hold_are_told_at_the_line_of_the_promise(count, told):
    lines = source("   1   2", "   3   4", "no more")
    problem = refused(fixed_values, lines, block(count, 3), FieldFormat(per_line=2, width=4))[0]
    assert problem.startswith(f"a:10: states {count} values, {told}")


@pytest.mark.parametrize(
    ("text", "value", "rounding"),
    [
        (" .005 ", 0.005, 0.0005),
        ("200", 200.0, 0.0),
        ("0.1700000E+39", 1.7e38, 5e31),
        (".20000E-01", 0.02, 5e-7),
        ("7.8125", 7.8125, 5e-5),
        ("-999.0", -999.0, 0.05),
    ],
)
def test_a_printed_number_knows_its_rounding(text, value, rounding):
    number = printed(text, 3)
    assert (number.value, number.index) == (value, 3)
    assert number.rounding == pytest.approx(rounding, rel=1e-12)


@pytest.mark.parametrize("text", ["", "x", "1e", ".", "1,5", "--1"])
def test_what_is_no_number_is_nan(text):
    assert math.isnan(printed(text, 0).value)


def test_problems_of_all_items_are_told_together():
    def read(item):
        if item % 2:
            raise InputError([f"{item} is odd", "that is all"])
        return item * 10

    assert each(read, [2, 4]) == [20, 40]
    told = ("1 is odd", "that is all", "3 is odd", "that is all")
    assert refused(each, read, [1, 2, 3]) == told
