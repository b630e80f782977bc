"""Damaged files: what a heading states is compared with what follows. Oracle: the whole file."""

import pytest

from places import DATA, ROOT
from solver.formats import read_motion_file
from solver.model import InputError

SAMPLES = DATA / "motions"
RECORDS = ROOT.parent / "shared" / "records"

# A text without remarks states neither its length nor its channels.
SILENT = {"columns.csv", "one.txt", "remark.csv", "uneven.txt", "README.md"}
NAMES = sorted(path.name for path in SAMPLES.iterdir() if path.name not in SILENT)


def values_of(motion_file):
    return [(record.dt_s, record.a_mps2.tobytes()) for record in motion_file.channels]


def problems_of(path, **how):
    with pytest.raises(InputError) as caught:
        read_motion_file(path, **how)
    return caught.value.problems


def damages(lines, at):
    """Files that have lost something at one line, with a word for what."""
    half = lines[at][: len(lines[at]) // 2]
    yield "a line lost", [*lines[:at], *lines[at + 1 :]]
    yield "cut before a line", [*lines[:at]]
    yield "half a line lost", [*lines[:at], half + b"\n", *lines[at + 1 :]]


def unnoticed(path, whole, at_lines):
    """Damages that are read as another record without an error or a note."""
    lines = whole.read_bytes().splitlines(keepends=True)
    intact, missed = read_motion_file(whole), []
    for at in at_lines:
        for what, left in damages(lines, at):
            path.write_bytes(b"".join(left))
            try:
                read = read_motion_file(path)
            except InputError:
                continue
            if values_of(read) != values_of(intact) and not {*read.notes} - {*intact.notes}:
                missed.append((at + 1, what))
    return missed


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.nightly("solver/formats/")
def test_no_damage_of_a_line_changes_a_record_without_a_word(tmp_path, name):
    count = len((SAMPLES / name).read_bytes().splitlines())
    assert unnoticed(tmp_path / name, SAMPLES / name, range(count)) == []


REAL = [
    "csmip_rio_dell_1992/Structure_CHAN4.V2",
    "smc/0165a_u.smc",
    "20161113_110300_HSES_20.V2A",
    "at2/RIO270.AT2",
]


@pytest.mark.parametrize("name", REAL)
def test_no_damage_of_a_real_record_changes_it_without_a_word(tmp_path, name):
    whole = RECORDS / name
    if not whole.is_file():
        pytest.skip("the real records are not here")
    count = len(whole.read_bytes().splitlines())
    lines = [0, 3, 11, 20, 30, 45, 46, count // 3, count // 2, count - 30, count - 1]
    assert unnoticed(tmp_path / whole.name, whole, lines) == []


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


@pytest.mark.parametrize("name", ["csmip-old.v2", "renadic.v1", "csmip-even.raw"])
def test_a_file_cut_between_two_channels_says_how_many_the_recorder_had(file, name):
    content = (SAMPLES / name).read_bytes()
    end = content.index(b"\n", content.upper().index(b"END OF DATA FOR CHANNEL")) + 1
    motion_file = read_motion_file(file(content[:end], name))
    assert len(motion_file.channels) == 1
    assert " channels of the recorder, the file has 1: the others are" in motion_file.notes[0]


def test_a_heading_of_volume_2_without_one_line_is_refused(file):
    # The step of the real heading was not found there, and 0.008 s was taken for 1/128 s.
    lines = (SAMPLES / "csmip-new.v2").read_bytes().splitlines(keepends=True)
    assert problems_of(file(b"".join([*lines[:8], *lines[9:]]), "roof.v2")) == (
        "roof.v2:45: found 44 lines of heading above this one, where the format has 45; give the"
        " whole file",
    )


def test_a_line_cut_within_a_number_is_refused(altered):
    # 2.5 of 2.500000e+00 is a number, and so is 9.8 of 9.800000e+01.
    path = altered("cosmos.v2c", ("   9.800000e+01", "   9.800000"))
    assert problems_of(path) == (
        "cosmos.v2c:54: found a line of 11 characters that ends within a field of 15; give the"
        " whole file",
    )


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.nightly("solver/formats/")
def test_no_cut_within_the_last_value_changes_a_record_without_a_word(tmp_path, name):
    whole, path = (SAMPLES / name).read_bytes(), tmp_path / name
    intact, missed = read_motion_file(SAMPLES / name), []
    for lost in range(1, 40):
        path.write_bytes(whole[:-lost])
        try:
            read = read_motion_file(path)
        except InputError:
            continue
        if values_of(read) != values_of(intact) and not {*read.notes} - {*intact.notes}:
            missed.append(lost)
    assert missed == []


def test_a_last_value_with_fewer_digits_than_all_others_is_refused_with_its_line(
    altered,
):
    assert problems_of(altered("peer-nga.at2", ("-.3125000E-01", "-.3125"))) == (
        "peer-nga.at2:6: found '-.3125' at the end, with fewer digits than all other values; give"
        " the whole file",
    )


def test_values_of_unlike_digits_may_end_with_few(altered):
    path = altered("peer-nga.at2", (".2500000E+00", ".25"), ("-.3125000E-01", "-.0625"))
    assert read_motion_file(path).channels[0].a_mps2.size == 7


TEXTS = sorted(SILENT - {"README.md"})


@pytest.mark.parametrize("name", TEXTS)
def test_a_text_that_is_cut_within_a_line_says_so(tmp_path, name):
    whole, path = (SAMPLES / name).read_bytes(), tmp_path / name
    how = {"units": "g", "dt_s": 0.01} if name == "one.txt" else {}
    intact, tried = read_motion_file(SAMPLES / name, **how), 0
    for lost in range(2, 40):
        left = whole[:-lost]
        path.write_bytes(left)
        try:
            read = read_motion_file(path, **how)
        except InputError:
            continue
        tried += 1
        is_told = bool({*read.notes} - {*intact.notes})
        assert is_told == (not left.rstrip(b" ").endswith(b"\n"))
    assert tried > 0


def test_a_text_whose_last_value_is_cut_short_is_refused(file):
    text = "".join(f"{i * 0.01:.2f},{(-1) ** i * 0.125:.4f}\n" for i in range(20))
    assert read_motion_file(file(text), units="g").notes == ()
    assert problems_of(file(text[:-3]), units="g") == (
        "roof.csv:20: found '-0.12' at the end, with fewer digits than the values before it and"
        " without a line end; give the whole file, or end its last line",
    )
    # With a line end somebody typed it.
    assert read_motion_file(file(text[:-3] + "\n"), units="g").notes == ()


@pytest.mark.parametrize("lines", [1, 60])
def test_a_comment_that_ends_a_text_without_a_line_end_is_no_cut_value(file, lines):
    rows = "".join(f"{i * 0.01:.2f},{(-1) ** i * 0.125:.4f}\n" for i in range(20))
    text = rows[:-3] + "\n" + "\n".join(["# end"] * lines)
    (note,) = read_motion_file(file(text), units="g").notes
    assert note.startswith("the last line has no line end")


def test_a_block_of_a_heading_states_its_lines(file):
    lines = (SAMPLES / "cosmos.v2c").read_bytes().splitlines(keepends=True)
    assert problems_of(file(b"".join([*lines[:30], *lines[31:]]), "roof.v2c")) == (
        "roof.v2c:25: states 20 lines of real numbers, found 19; give the whole file",
    )


def test_a_duration_that_the_values_do_not_have_is_refused(altered):
    path = altered("geonet.v1a", ("Duration   0.10 sec", "Duration   0.90 sec"))
    assert problems_of(path) == (
        "geonet.v1a:10: the heading states 0.9 s, the record lasts 0.105 s; give dt with more"
        " digits, or a file whose headings agree",
    )
    path = altered("csmip-pairs.v1", ("     0.600     0.120", "     0.600     0.220"))
    (problem,) = problems_of(path)
    assert problem.startswith("csmip-pairs.v1:21: the heading states 0.22 s, the record lasts 0.12")


ROWS = "".join(f"{i * 0.01:.2f},{(-1) ** i * 0.1}\n" for i in range(20))


@pytest.mark.parametrize("words", ["number of points: 20", "No. of samples 20, gal"])
def test_a_text_that_states_its_samples_is_held_to_it(file, words):
    text = f"# {words}\ntime_s,acc_g\n{ROWS}"
    assert len(read_motion_file(file(text)).channel().a_mps2) == 20
    cut = "".join(text.splitlines(keepends=True)[:-3])
    assert problems_of(file(cut)) == (
        "roof.csv:1: states 20 samples, found 17; give the whole file",
    )
    (problem,) = problems_of(file(text + "0.20,0.1\n"))
    assert problem == "roof.csv:1: states 20 samples, found 21; correct the count"


def test_times_are_compared_with_the_step_that_a_text_states(file):
    assert read_motion_file(file(f"# dt = 0.01 s\ntime_s,acc_g\n{ROWS}")).channel().dt_s == 0.01
    (problem,) = problems_of(file(f"# dt = 0.02 s\ntime_s,acc_g\n{ROWS}"))
    assert problem == (
        "roof.csv:1: states a step of 0.02 s, the times have 0.01 s; give a file in which they"
        " agree"
    )
