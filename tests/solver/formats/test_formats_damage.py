"""Damaged files: what a heading states is compared with what follows. Oracle: the whole file."""

from functools import cache, partial

import pytest

from places import SAMPLES
from refused import refused
from solver.formats import read_motion_file
from solver.model import InputError

pytestmark = pytest.mark.quick

# A text without remarks states neither its length nor its channels.
TEXTS = ["columns.csv", "one.txt", "remark.csv", "uneven.txt"]
NAMES = sorted({path.name for path in SAMPLES.iterdir()} - {*TEXTS, "README.md"})


def values_of(motion_file):
    return [(record.dt_s, record.a_mps2.tobytes()) for record in motion_file.channels]


problems_of = partial(refused, read_motion_file)


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
        ("csmip-even.raw", 50, "csmip-even.raw:43: states 42 values, found 0; give the whole"),
        ("geonet.v1a", 29, "geonet.v1a:1: found the heading of component 1, the last one, where"),
        ("geonet.v1a", 58, "geonet.v1a:30: found the heading of component 2, the last one, where"),
    ],
)
def test_a_file_cut_after_its_first_channel_is_refused(file, name, kept, expected):
    lines = (SAMPLES / name).read_bytes().splitlines(keepends=True)
    (problem,) = problems_of(file(b"".join(lines[:kept]), name))
    assert problem.startswith(expected)


def test_a_cut_file_of_three_components_is_told(file):
    lines = (SAMPLES / "geonet.v2a").read_text().splitlines()
    cut = read_motion_file(file("\n".join(lines[:-4])))
    assert cut.notes == (
        "Component Up Vertical Accelerometer Axis: velocities or displacements are incomplete: the"
        " file may be truncated",
    )
    (problem,) = problems_of(file("\n".join(lines[:97])))
    assert problem == "roof.csv:90: states 21 values, found 10; give the whole file"
    (problem,) = problems_of(file("\n".join(lines[:70])))
    assert problem == (
        "roof.csv:36: found the heading of component 2, the last one, where the format has 3"
        " components; give the whole file"
    )


@pytest.mark.parametrize("name", ["csmip-old.v2", "renadic.v1", "csmip-even.raw"])
def test_a_file_cut_between_two_channels_says_how_many_the_recorder_had(file, name):
    content = (SAMPLES / name).read_bytes()
    end = content.index(b"\n", content.upper().index(b"END OF DATA FOR CHANNEL")) + 1
    motion_file = read_motion_file(file(content[:end], name))
    assert len(motion_file.channels) == 1
    assert " channels of the recorder, the file has 1: the others are" in motion_file.notes[0]


@pytest.mark.parametrize(
    ("name", "lost", "problem"),
    [
        # The step of the real heading was not found there, and 0.008 s was taken for 1/128 s.
        ("csmip-new.v2", 8, "45: found 44 lines of heading above this one, where the format has 45;"
         " give the whole file"),
        ("cosmos.v2c", 30, "25: states 20 lines of real numbers, found 19; give the whole file"),
    ],
)  # fmt: skip
def test_a_heading_without_one_line_is_refused(file, name, lost, problem):
    lines = (SAMPLES / name).read_bytes().splitlines(keepends=True)
    left = b"".join([*lines[:lost], *lines[lost + 1 :]])
    assert problems_of(file(left, name)) == (f"{name}:{problem}",)


@pytest.mark.parametrize(
    ("name", "whole", "left", "problem"),
    [
        # 2.5 of 2.500000e+00 is a number, and so is 9.8 of 9.800000e+01.
        ("cosmos.v2c", "   9.800000e+01", "   9.800000", "54: found a line of 11 characters that"
         " ends within a field of 15; give the whole file"),
        ("peer-nga.at2", "-.3125000E-01", "-.3125", "6: found '-.3125' at the end, with fewer"
         " digits than all other values; give the whole file"),
        ("geonet.v1a", "Duration   0.10 sec", "Duration   0.90 sec", "10: the heading states 0.9 s,"
         " the record lasts 0.105 s; give dt with more digits, or a file whose headings agree"),
        ("csmip-pairs.v1", "     0.600     0.120", "     0.600     0.220", "21: the heading states"
         " 0.22 s, the record lasts 0.12 s; give dt with more digits, or a file whose headings"
         " agree"),
    ],
)  # fmt: skip
def test_a_value_cut_short_or_a_duration_that_is_not_there_is_refused(
    altered, name, whole, left, problem
):
    assert problems_of(altered(name, (whole, left))) == (f"{name}:{problem}",)


def test_values_of_unlike_digits_may_end_with_few(altered):
    path = altered("peer-nga.at2", (".2500000E+00", ".25"), ("-.3125000E-01", "-.0625"))
    assert read_motion_file(path).channels[0].a_mps2.size == 7


@pytest.mark.parametrize("name", TEXTS)
def test_a_text_that_is_cut_within_a_line_says_so(file, name):
    whole = (SAMPLES / name).read_bytes()
    how = {"units": "g", "dt_s": 0.01} if name == "one.txt" else {}
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


def test_a_last_value_cut_short_is_refused_and_stated_steps_are_compared(file):
    assert read_motion_file(file(VALUES), units="g").notes == ()
    assert problems_of(file(VALUES[:-3]), units="g") == (
        "roof.csv:20: found '-0.12' at the end, with fewer digits than the values before it and"
        " without a line end; give the whole file, or end its last line",
    )
    # With a line end somebody typed it.
    assert read_motion_file(file(VALUES[:-3] + "\n"), units="g").notes == ()
    assert read_motion_file(file(f"# dt = 0.01 s\ntime_s,acc_g\n{ROWS}")).channel().dt_s == 0.01
    assert problems_of(file(f"# dt = 0.02 s\ntime_s,acc_g\n{ROWS}")) == (
        "roof.csv:1: states a step of 0.02 s, the times have 0.01 s; give a file in which they"
        " agree",
    )


@pytest.mark.parametrize("lines", [1, 60])
def test_a_comment_that_ends_a_text_without_a_line_end_is_no_cut_value(file, lines):
    text = VALUES[:-3] + "\n" + "\n".join(["# end"] * lines)
    (note,) = read_motion_file(file(text), units="g").notes
    assert note.startswith("the last line has no line end")


ROWS = "".join(f"{i * 0.01:.2f},{(-1) ** i * 0.1}\n" for i in range(20))


@pytest.mark.parametrize("words", ["number of points: 20", "No. of samples 20, gal"])
def test_a_text_that_states_its_samples_is_held_to_it(file, words):
    text = f"# {words}\ntime_s,acc_g\n{ROWS}"
    assert len(read_motion_file(file(text)).channel().a_mps2) == 20
    cut = "".join(text.splitlines(keepends=True)[:-3])
    assert problems_of(file(cut)) == (
        "roof.csv:1: states 20 samples, found 17; give the whole file",
    )
    assert problems_of(file(text + "0.20,0.1\n")) == (
        "roof.csv:1: states 20 samples, found 21; correct the count",
    )
