"""Counts in sentences."""

import pytest

from report.text.counts import capitalized, counted, named, ranged, spelled

pytestmark = pytest.mark.quick


@pytest.mark.parametrize(
    ("count", "text"),
    [(0, "no arrays"), (1, "one array"), (2, "two arrays"), (9, "nine arrays"), (10, "10 arrays")],
)
def test_a_count_is_in_words_up_to_nine(count, text):
    assert counted(count, "array") == text
    assert spelled(count) == text.split()[0]


def test_a_sentence_begins_in_upper_case_and_keeps_its_other_letters():
    assert capitalized("the roof of EX-1") == "The roof of EX-1"


@pytest.mark.parametrize(
    ("names", "text"),
    [
        ("", ""),
        ("A1", "A1"),
        ("A1 A2", "A1, A2"),
        ("A1 A2 A3", "A1 to A3"),
        ("A8 A9 A10 A12 B13 B14 A15", "A8 to A10, A12, A15, B13, B14"),
        ("CF-1 CF-2 CF-3 DA-1 SY-1 SY-2", "CF-1 to CF-3, DA-1, SY-1, SY-2"),
        ("PV-08 PV-09 PV-10 PV-12", "PV-08 to PV-10, PV-12"),
        ("A3 A10 A2 A1 A2", "A1 to A3, A10"),
        ("EAST EAST0 EAST1 WEST 7 8 9", "7 to 9, EAST, EAST0, EAST1, WEST"),
    ],
)
def test_names_that_count_on_are_a_range_from_three_of_them(names, text):
    assert ranged(names.split()) == text


def test_names_have_their_noun_in_the_number_that_they_are():
    assert named(["A9"], "array") == "array A9"
    assert named(["A1", "A2", "A3"], "array") == "arrays A1 to A3"
