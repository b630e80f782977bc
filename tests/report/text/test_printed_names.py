"""Long names have keys in print, and no text loses its meaning."""

import pytest

from report.text.counts import Names, ranged

ARRAYS = ["NORTHWEST ROOF 2", "A1", "NORTHWEST ROOF 10", "NORTHWEST ROOF 1"]
NAMES = Names.of(ARRAYS, ["Kitchen & make-up air", "RTU-1"])


def test_a_name_over_twelve_characters_has_a_key_and_others_are_printed():
    assert Names.of(["twelve chars", "thirteen char"]).keys == {"thirteen char": "[1]"}
    assert NAMES.keys == {
        "NORTHWEST ROOF 1": "[1]",
        "NORTHWEST ROOF 2": "[2]",
        "NORTHWEST ROOF 10": "[3]",
        "Kitchen & make-up air": "[4]",
    }


def test_a_name_within_another_name_or_a_path_is_not_that_name():
    assert NAMES("NORTHWEST ROOF 10 to A1") == "[3] to A1"
    assert NAMES("NORTHWEST ROOF 1: NG, NORTHWEST ROOF 2.") == "[1]: NG, [2]."
    for other in ("NORTHWEST ROOF 11", "records/NORTHWEST ROOF 1", "NORTHWEST ROOF 1.csv"):
        assert NAMES(other) == other


def test_a_name_that_begins_a_sentence_has_its_key():
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


def test_a_key_is_no_name_of_the_project():
    assert Names.of(["[1]", "a long name of an array"]).keys == {"a long name of an array": "[2]"}


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
