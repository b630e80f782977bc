"""Files from strangers: what may be opened, and what the caller may say of them."""

import math
import sys
from pathlib import Path

import pytest

from refused import refused
from solver.formats.source import MAX_BYTES, Stated, open_source

pytestmark = pytest.mark.quick


def problems_of(path, units="g", dt_s=math.nan):
    return refused(open_source, path, units=units, dt_s=dt_s)


@pytest.mark.parametrize("content", [b"\x89PNG\r\n\x1a\n\x00", b"\xff\xfe\x00", b"a\x1a\x00b"])
def test_what_is_no_text_is_refused(file, content):
    assert problems_of(file(content)) == ("roof.csv: not a text file; give the text of a record",)


@pytest.mark.parametrize(
    ("content", "kind"),
    [
        (b"MS\x03\x00", "miniSEED 3; convert it to times and accelerations, for example"),
        (b"PK\x03\x04\x14\x00", "a zip or a workbook; unpack it, or save its sheet as CSV"),
        (b"%PDF-1.7\n\x00\x01", "a PDF; give the record itself"),
    ],
)
def test_a_known_kind_of_file_is_named_with_what_to_do(file, content, kind):
    (problem,) = problems_of(file(content))
    assert problem.startswith(f"roof.csv: not a text file; {kind}")


def test_what_is_no_file_or_too_large_is_refused(tmp_path):
    assert problems_of(tmp_path / "none.csv")[0].startswith("none.csv: no such file")
    assert problems_of(tmp_path)[0].startswith(f"{tmp_path.name}: not a file")
    with (tmp_path / "roof.csv").open("wb") as hollow:
        hollow.truncate(MAX_BYTES + 1)
    (problem,) = problems_of(tmp_path / "roof.csv")
    assert problem.endswith(f"give at most {MAX_BYTES // 1_000_000} MB")


@pytest.mark.skipif(
    sys.platform == "win32" or not Path("/proc/self/mem").is_file(),
    reason="a file that gives no bytes, which Wine takes from the system below",
)
def test_a_file_that_cannot_be_read_says_why():
    assert problems_of(Path("/proc/self/mem")) == ("mem: cannot be read (Input/output error)",)


def test_lines_too_long_or_too_many_are_refused(file):
    assert problems_of(file("0 1\n" + "1" * 1200)) == (
        "roof.csv:2: found a line of 1200 characters; give at most 1000",
    )
    assert problems_of(file("0\n" * 1_000_001 + "x")) == (
        "roof.csv: found 1,000,002 lines; give at most 1,000,000",
    )


@pytest.mark.parametrize(
    "content", ["0,1\r\n1,2\r\n\x1a", "0,1\r1,2", "\ufeff0,1\n1,2\n\n\x1a\x1a"]
)
def test_line_ends_marks_of_order_and_of_the_end_are_taken_off(file, content):
    assert open_source(file(content), units="", dt_s=math.nan).lines == ["0,1", "1,2"]


@pytest.mark.parametrize("dt_s", [0.0, -0.01, math.inf])
def test_unknown_units_and_impossible_steps_are_refused_together(file, dt_s):
    problems = problems_of(file("0,1\n"), units="furlong", dt_s=dt_s)
    assert problems[0] == "roof.csv: unit is 'furlong'; give one of g, m/s2, cm/s2, mm/s2, gal"
    assert problems[1].startswith(f"roof.csv: time step dt is {dt_s!r}; give a number")


@pytest.mark.parametrize("value", [0.0, -0.01, math.inf])
def test_a_stated_step_must_be_one(file, value):
    source = open_source(file("x"), units="", dt_s=math.nan)
    (problem,) = refused(source.step, Stated(value=value, rounding=0.0, index=0))
    assert problem == f"roof.csv:1: found time step {value:g} s; give a number above 0"
