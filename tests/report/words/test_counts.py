"""Counts in sentences."""

import pytest

from report.words.counts import capitalized, counted, spelled


@pytest.mark.parametrize(
    ("count", "text"),
    [(0, "no arrays"), (1, "one array"), (2, "two arrays"), (9, "nine arrays"), (10, "10 arrays")],
)
def test_a_count_is_in_words_up_to_nine(count, text):
    assert counted(count, "array") == text
    assert spelled(count) == text.split()[0]


def test_a_sentence_begins_in_upper_case_and_keeps_its_other_letters():
    assert capitalized("the roof of EX-1") == "The roof of EX-1"
