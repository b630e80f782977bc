"""Texts without what nobody sees at their ends."""

import sys

import pytest

from growth import grows_faster
from report.text.counts import trimmed

pytestmark = pytest.mark.quick

WIDTHLESS = "\u00ad\u200b\u200c\u200d\u200e\u200f\u2060\u2061\u2062\u2063\u2064\ufeff"


def test_blanks_and_letters_of_no_width_are_trimmed_and_no_others():
    for code in range(sys.maxunicode + 1):
        letter = chr(code)
        expected = "" if letter.isspace() or letter in WIDTHLESS else letter
        assert trimmed(letter) == expected, hex(code)


def test_only_the_ends_are_trimmed():
    assert trimmed(" \u200ba \u200b b\ufeff\n ") == "a \u200b b"


@pytest.mark.parametrize("run", [" ", "\n", "\u200b", " \u00ad"])
@pytest.mark.parametrize("end", ["b", ""])
def test_a_long_run_of_blanks_takes_time_as_its_length(run, end):
    assert not grows_faster(trimmed, lambda size: f"a{run * size}{end}", 4000)
