"""Counts, names, texts without blanks at their ends, and commands, as they are printed."""

import sys
from pathlib import PureWindowsPath

import pytest

from growth import grows_faster
from report.text.counts import Names, capitalized, counted, named, quoted, ranged, spelled, trimmed

pytestmark = pytest.mark.quick


@pytest.mark.parametrize(
    ("count", "text"),
    [(0, "no arrays"), (1, "one array"), (2, "two arrays"), (9, "nine arrays"), (10, "10 arrays")],
)
def test_a_count_is_in_words_up_to_nine(count, text):
    assert counted(count, "array") == text
    assert spelled(count) == text.split()[0]


@pytest.mark.parametrize(
    ("names", "text"),
    [
        ("", ""), ("A1", "A1"), ("A1 A2", "A1, A2"), ("A1 A2 A3", "A1 to A3"),
        ("A8 A9 A10 A12 B13 B14 A15", "A8 to A10, A12, A15, B13, B14"),
        ("CF-1 CF-2 CF-3 DA-1 SY-1 SY-2", "CF-1 to CF-3, DA-1, SY-1, SY-2"),
        ("PV-08 PV-09 PV-10 PV-12", "PV-08 to PV-10, PV-12"), ("A3 A10 A2 A1 A2", "A1 to A3, A10"),
        ("EAST EAST0 EAST1 WEST 7 8 9", "7 to 9, EAST, EAST0, EAST1, WEST"),
    ],
)  # fmt: skip
def test_names_that_count_on_are_a_range_from_three_of_them(names, text):
    assert ranged(names.split()) == text


def test_names_have_their_noun_in_the_number_that_they_are_and_a_sentence_its_capital():
    assert named(["A9"], "array") == "array A9"
    assert named(["A1", "A2", "A3"], "array") == "arrays A1 to A3"
    assert capitalized("the roof of EX-1") == "The roof of EX-1"


ARRAYS = ["NORTHWEST ROOF 2", "A1", "NORTHWEST ROOF 10", "NORTHWEST ROOF 1"]
NAMES = Names.of(ARRAYS, ["Kitchen & make-up air", "RTU-1"])


def test_long_names_have_keys_where_they_stand_by_themselves():
    assert Names.of(["twelve chars", "thirteen char"]).keys == {"thirteen char": "[1]"}
    roofs = {f"NORTHWEST ROOF {k}": f"[{n}]" for n, k in enumerate((1, 2, 10), start=1)}
    assert NAMES.keys == roofs | {"Kitchen & make-up air": "[4]"}
    # A key is no name of the project.
    assert Names.of(["[1]", "a long name of an array"]).keys == {"a long name of an array": "[2]"}
    assert NAMES("NORTHWEST ROOF 10 to A1") == "[3] to A1"
    assert NAMES("NORTHWEST ROOF 1: NG, NORTHWEST ROOF 2.") == "[1]: NG, [2]."
    for other in ("NORTHWEST ROOF 11", "records/NORTHWEST ROOF 1", "NORTHWEST ROOF 1.csv"):
        assert NAMES(other) == other
    names = Names.of(["north penthouse", "Roof of the kitchen", "roof of the kitchen"])
    assert names.keys["Roof of the kitchen"] == "[1]"
    assert names("North penthouse: NG. Roof of the kitchen: OK") == "[2]: NG. [1]: OK"


@pytest.mark.parametrize("count", [3, 12])
def test_a_range_of_names_is_the_range_of_their_keys(count):
    # Nine of twelve characters, and others of thirteen.
    names = [f"UPPER ROOF {k}" for k in range(1, count + 1)]
    keys = Names.of(["LOWER ROOF EAST 7", *reversed(names)])
    both = "[2] to [13]" if count == 12 else "UPPER ROOF 1 to UPPER ROOF 3"
    assert keys(ranged(names)) == both
    assert keys.keys["LOWER ROOF EAST 7"] == "[1]"


def test_names_that_end_in_words_are_a_range_of_keys():
    roofs = [f"roof of bay {word}" for word in ("east", "north", "south", "west")]
    names = Names.of(roofs)
    assert names(ranged(roofs)) == "[1] to [4]"
    assert names(ranged([roofs[0], *roofs[2:]])) == "[1], [3], [4]"
    assert names.in_html(f"<body><td>{', '.join(roofs)}</td>") == "<body><td>[1] to [4]</td>"


def test_a_document_has_keys_in_its_texts_alone():
    html = (
        "<html><title>Kitchen &amp; make-up air</title><body>"
        '<h1 id="NORTHWEST ROOF 1" translate="no">NORTHWEST ROOF 1 <b>A1</b></h1>'
        '<p title="NORTHWEST ROOF 1">NORTHWEST ROOF 1 and Kitchen &amp; make-up air</p></body>'
    )
    printed = NAMES.in_html(html)
    assert printed == html.replace(
        ">NORTHWEST ROOF 1 and Kitchen &amp; make-up air<", ">[1] and [4]<"
    )
    assert Names.of(["A1"]).in_html(html) is html


WIDTHLESS = "\u00ad\u200b\u200c\u200d\u200e\u200f\u2060\u2061\u2062\u2063\u2064\ufeff"


def test_blanks_and_letters_of_no_width_are_trimmed_at_the_ends():
    for code in range(sys.maxunicode + 1):
        letter = chr(code)
        expected = "" if letter.isspace() or letter in WIDTHLESS else letter
        assert trimmed(letter) == expected, hex(code)
    assert trimmed(" \u200ba \u200b b\ufeff\n ") == "a \u200b b"


@pytest.mark.parametrize("run", [" ", "\n", "\u200b", " \u00ad"])
@pytest.mark.parametrize("end", ["b", ""])
def test_a_long_run_of_blanks_takes_time_as_its_length(run, end):
    assert not grows_faster(trimmed, lambda size: f"a{run * size}{end}", 4000)


def test_a_path_of_windows_has_the_quotes_of_cmd_and_powershell(monkeypatch):
    monkeypatch.setattr(sys, "platform", "win32")
    assert quoted(PureWindowsPath(r"C:\w\roof-1\input.xlsx")) == r"C:\w\roof-1\input.xlsx"
    for path in (r"C:\My projects\roof", r"C:\R&D\roof (2)", r"C:\it's"):
        assert quoted(PureWindowsPath(path)) == f'"{path}"'
