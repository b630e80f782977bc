"""All formats: the real records of the manifest, detection, damage, and what strangers may send."""

import csv
import math
import sys
from functools import cache, partial
from pathlib import Path

import numpy as np
import pytest
from test_formats import HELD

from fixtures.errors import input_problems
from fixtures.paths import RECORDS, SAMPLES
from solver.errors import InputError
from solver.formats import read_motion_file, read_record
from solver.formats.source import MAX_BYTES, Stated, open_source

G = 9.80665
BARE = {"units": "gal", "dt_s": 0.005}

TEXTS = ("columns.csv", "one.txt", "remark.csv", "uneven.txt")
FORMATS = dict.fromkeys(TEXTS, "text") | {name: held.format for name, held in HELD.items()}


def manifest():
    """Rows of the folder of real records, none where the folder is not present."""
    path = RECORDS / "MANIFEST.csv"
    if not path.is_file():
        return [pytest.param(None, marks=pytest.mark.skip(reason="folder of records absent"))]
    rows = list(csv.DictReader(path.read_text(encoding="utf-8").splitlines()))
    return [pytest.param(row, id=f"{row['file']}-{row['component'][:16]}") for row in rows]


def channel_of(row):
    plain = row["format"] == "plain column"
    how = {"units": "g", "dt_s": float(row["dt_s"])} if plain else {}
    motion_file = read_motion_file(RECORDS / row["file"], **how)
    return motion_file.channel(row["component"] if len(motion_file.channels) > 1 else "")


@pytest.mark.parametrize("row", manifest())
def test_real_records_have_the_step_count_and_peak_of_the_manifest(row):
    record = channel_of(row)
    a, count = record.a_mps2, int(row["npts"])
    assert record.dt_s == float(row["dt_s"])
    if "offset of first 1 s removed" in row["note"]:
        a = a - a[: round(1.0 / record.dt_s)].mean()
    decimals = len(row["pga_g"].partition(".")[2])
    assert np.abs(a).max() / G == pytest.approx(float(row["pga_g"]), abs=0.501 * 10.0**-decimals)
    # The manifest leaves out the last line of channels 1 and 2 of RENADIC's files, five pairs or
    # three; each file promises the pairs that it holds, 10000 and 24923.
    left_out = {9995: 5, 24920: 3}.get(count, 0) if row["format"].startswith("RENADIC") else 0
    assert len(a) == count + left_out


@pytest.mark.parametrize("name", sorted(FORMATS))
@pytest.mark.quick
def test_the_content_tells_the_format_whatever_the_name(file, name):
    path = file((SAMPLES / name).read_bytes(), "motion.dat")
    motion_file = read_motion_file(path, **(BARE if name == "one.txt" else {}))
    assert (motion_file.name, motion_file.format) == ("motion.dat", FORMATS[name])
    assert all(0 < len(note) < 200 for note in motion_file.notes)
    for record in motion_file.channels:
        assert not record.a_mps2.flags.writeable
        assert record.a_mps2.dtype == np.float64
        assert record.a_mps2.ndim == 1


@pytest.mark.quick
def test_every_sample_is_listed_and_a_record_is_one_of_its_channels():
    assert {path.name for path in SAMPLES.iterdir()} == {*FORMATS, "README.md"}
    record = read_record(SAMPLES / "renadic.v1", channel="chan 2: v (sta chn: 2)")
    (_, expected, _) = read_motion_file(SAMPLES / "renadic.v1").channels
    assert record.name == expected.name
    assert np.array_equal(record.a_mps2, expected.a_mps2)


# A text without remarks states neither its length nor its channels.
NAMES = sorted(HELD)


def values_of(motion_file):
    return [(record.dt_s, record.a_mps2.tobytes()) for record in motion_file.channels]


problems_of = partial(input_problems, read_motion_file)


intact = cache(read_motion_file)


def is_unnoticed(path, whole, left):
    """Whether what is left of a file is read as another record without an error or a note."""
    path.write_bytes(left)
    try:
        read = read_motion_file(path)
    except InputError:
        return False
    is_other = values_of(read) != values_of(intact(whole))
    return is_other and not {*read.notes} - {*intact(whole).notes}


def damages(lines, at):
    """Files that have lost something at one line, by a word for what."""
    half = lines[at][: len(lines[at]) // 2] + b"\n"
    yield "a line lost", [*lines[:at], *lines[at + 1 :]]
    yield "cut before a line", lines[:at]
    yield "half a line lost", [*lines[:at], half, *lines[at + 1 :]]


def unnoticed(path, whole, at_lines):
    lines = whole.read_bytes().splitlines(keepends=True)
    return [
        (at + 1, what)
        for at in at_lines
        for what, left in damages(lines, at)
        if is_unnoticed(path, whole, b"".join(left))
    ]


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.nightly
def test_no_damage_of_a_line_or_cut_in_the_last_value_changes_a_record_without_a_word(
    tmp_path, name
):
    count = len((SAMPLES / name).read_bytes().splitlines())
    assert unnoticed(tmp_path / name, SAMPLES / name, range(count)) == []
    whole = SAMPLES / name
    left = {lost: whole.read_bytes()[:-lost] for lost in range(1, 40)}
    assert [lost for lost in left if is_unnoticed(tmp_path / name, whole, left[lost])] == []


@pytest.mark.parametrize(
    ("name", "kept", "expected"),
    [
        # Sixty-six lines of two channels: one channel, and the heading of the other.
        ("cosmos.v1c", 66, "cosmos.v1c:58: found a heading without a line ... pts, approx ... sec"),
        ("csmip-even.raw", 50, "csmip-even.raw:43: states 42 values, found 0; use the complete"),
        ("geonet.v1a", 58, "geonet.v1a:30: found the heading of component 2, the last one, where"),
    ],
)
def test_a_file_cut_after_its_first_channel_is_refused(file, name, kept, expected):
    lines = (SAMPLES / name).read_bytes().splitlines(keepends=True)
    (problem,) = problems_of(file(b"".join(lines[:kept]), name))
    assert problem.startswith(expected)


@pytest.mark.parametrize(
    ("name", "whole", "left", "problem"),
    [
        # 2.5 of 2.500000e+00 is a number, and so is 9.8 of 9.800000e+01.
        ("cosmos.v2c", "   9.800000e+01", "   9.800000", "54: found a line of 11 characters that"
         " ends within a field of 15; use the complete file"),
        ("peer-nga.at2", "-.3125000E-01", "-.3125", "6: found '-.3125' at the end, with fewer"
         " digits than all other values; use the complete file"),
        ("geonet.v1a", "Duration   0.10 sec", "Duration   0.90 sec", "10: the heading states 0.9 s,"
         " the record lasts 0.105 s; enter dt with more digits, or a file whose headings agree"),
        ("csmip-pairs.v1", "     0.600     0.120", "     0.600     0.220", "21: the heading states"
         " 0.22 s, the record lasts 0.12 s; enter dt with more digits, or a file whose headings"
         " agree"),
    ],
)  # fmt: skip
def test_a_value_cut_short_or_a_duration_that_is_not_there_is_refused(
    altered, name, whole, left, problem
):
    assert problems_of(altered(name, (whole, left))) == (f"{name}:{problem}",)


@pytest.mark.parametrize("name", TEXTS)
def test_a_text_that_is_cut_within_a_line_says_so(file, name):
    whole = (SAMPLES / name).read_bytes()
    how = {"units": "gal", "dt_s": 0.01} if name == "one.txt" else {}
    usual, tried = {*read_motion_file(SAMPLES / name, **how).notes}, 0
    for left in (whole[:-lost] for lost in range(2, 40)):
        try:
            read = read_motion_file(file(left, name), **how)
        except InputError:
            continue
        tried += 1
        assert bool({*read.notes} - usual) == (not left.rstrip(b" ").endswith(b"\n"))
    assert tried > 0


VALUES = "".join(f"{i * 0.01:.2f},{(-1) ** i * 0.125:.4f}\n" for i in range(20))


def test_a_last_value_cut_short_is_refused_and_stated_steps_are_compared(file, altered):
    assert read_motion_file(file(VALUES), units="g").notes == ()
    assert problems_of(file(VALUES[:-3]), units="g") == (
        "roof.csv:20: found '-0.12' at the end, with fewer digits than the values before it and"
        " without a line end; use the complete file, or end its last line",
    )
    for lines in (1, 60):
        text = VALUES[:-3] + "\n" + "\n".join(["# end"] * lines)
        (note,) = read_motion_file(file(text), units="g").notes
        assert note.startswith("the last line has no line end")
    # With a line end somebody typed it.
    assert read_motion_file(file(VALUES[:-3] + "\n"), units="g").notes == ()
    assert read_motion_file(file(f"# dt = 0.01 s\ntime_s,acc_g\n{ROWS}")).channel().dt_s == 0.01
    assert problems_of(file(f"# dt = 0.02 s\ntime_s,acc_g\n{ROWS}")) == (
        "roof.csv:1: states a step of 0.02 s, the times have 0.01 s; use a file in which they"
        " agree",
    )
    path = altered("peer-nga.at2", (".2500000E+00", ".25"), ("-.3125000E-01", "-.0625"))
    assert read_motion_file(path).channels[0].a_mps2.size == 7


ROWS = "".join(f"{i * 0.01:.2f},{(-1) ** i * 0.1}\n" for i in range(20))


@pytest.mark.parametrize("words", ["number of points: 20", "No. of samples 20, gal"])
def test_a_text_that_states_its_samples_is_held_to_it(file, words):
    text = f"# {words}\ntime_s,acc_g\n{ROWS}"
    assert len(read_motion_file(file(text)).channel().a_mps2) == 20
    cut = "".join(text.splitlines(keepends=True)[:-3])
    assert problems_of(file(cut)) == (
        "roof.csv:1: states 20 samples, found 17; use the complete file",
    )
    assert problems_of(file(text + "0.20,0.1\n")) == (
        "roof.csv:1: states 20 samples, found 21; correct the count",
    )


def refusals(path, units="g", dt_s=math.nan):
    return input_problems(open_source, path, units=units, dt_s=dt_s)


@pytest.mark.parametrize(
    ("content", "kind"),
    [
        (b"MS\x03\x00", "miniSEED 3; convert it to times and accelerations, for example"),
        (b"PK\x03\x04\x14\x00", "a zip or a workbook; unpack it, or save its worksheet as CSV"),
        (b"%PDF-1.7\n\x00\x01", "a PDF; export its numbers as text or CSV"),
    ],
)
def test_a_known_kind_of_file_is_named_with_what_to_do(file, content, kind):
    (problem,) = refusals(file(content))
    assert problem.startswith(f"roof.csv: not a text file; {kind}")
    for unknown in (b"\x89PNG\r\n\x1a\n\x00", b"\xff\xfe\x00", b"a\x1a\x00b"):
        told = ("roof.csv: not a text file; use text or CSV",)
        assert refusals(file(unknown)) == told


def test_what_is_no_file_or_too_large_or_long_is_refused(tmp_path, file):
    assert refusals(tmp_path / "none.csv")[0].startswith("none.csv: no such file")
    assert refusals(tmp_path)[0].startswith(f"{tmp_path.name}: is a folder; use a file")
    with (tmp_path / "roof.csv").open("wb") as hollow:
        hollow.truncate(MAX_BYTES + 1)
    (problem,) = refusals(tmp_path / "roof.csv")
    assert problem.startswith(f"roof.csv: larger than {MAX_BYTES // 1_000_000} MB")
    assert refusals(file("0 1\n" + "1" * 1200)) == (
        "roof.csv:2: found a line of 1200 characters; enter at most 1000",
    )
    assert refusals(file("0\n" * 1_000_001 + "x")) == (
        "roof.csv: found 1,000,002 lines; enter at most 1,000,000",
    )


@pytest.mark.skipif(
    sys.platform == "win32" or not Path("/proc/self/mem").is_file(),
    reason="a file that gives no bytes, which Wine takes from the system below",
)
def test_a_file_that_cannot_be_read_says_why():
    assert refusals(Path("/proc/self/mem")) == (
        "mem: cannot be read (Input/output error); close it in other programs, or check its rights",
    )


@pytest.mark.parametrize(
    "content", ["0,1\r\n1,2\r\n\x1a", "0,1\r1,2", "\ufeff0,1\n1,2\n\n\x1a\x1a"]
)
def test_line_ends_marks_of_order_and_of_the_end_are_taken_off(file, content):
    assert open_source(file(content), units="", dt_s=math.nan).lines == ["0,1", "1,2"]


@pytest.mark.parametrize("dt_s", [0.0, -0.01, math.inf])
def test_unknown_units_and_impossible_steps_are_refused_together(file, dt_s):
    problems = refusals(file("0,1\n"), units="furlong", dt_s=dt_s)
    assert problems[0] == "roof.csv: unit is 'furlong'; enter one of g, m/s2, cm/s2, mm/s2, gal"
    assert problems[1].startswith(f"roof.csv: time step dt is {dt_s!r}; enter a number")
    source = open_source(file("x"), units="", dt_s=math.nan)
    (problem,) = input_problems(source.step, Stated(value=dt_s, rounding=0.0, index=0))
    assert problem == f"roof.csv:1: found time step {dt_s:g} s; enter a number above 0"
