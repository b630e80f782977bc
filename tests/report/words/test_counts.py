"""Counts in sentences."""

import pytest

from report.words.counts import capitalized, counted, ranged, spelled


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
        ("A1", "A1"),
        ("A1 A2", "A1, A2"),
        ("A3 A1 A2", "A1 to A3"),
        ("A1 A2 A3 A5 A7 A8 B", "A1 to A3, A5, A7 to B"),
    ],
)
def test_three_names_or_more_that_follow_each_other_are_a_range(names, text):
    order = ["A1", "A2", "A3", "A4", "A5", "A6", "A7", "A8", "B"]
    assert ranged(names.split(), order) == text
