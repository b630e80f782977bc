"""JSON from a stranger is read whole or refused, and numbers are compared to a tolerance."""

import pytest

from growth import grows_faster
from report.proof.numbers import number_differences, parsed, word_differences
from solver.model import InputError

BAD = {
    "deep": b'{"a": ' + b"[" * 100_000 + b"]" * 100_000 + b"}",
    "not closed": b"[" * 100_000,
    "a key twice": b'{"design_m": 1.0, "design_m": 2.0}',
    "a key twice below": b'{"a": [{"b": 1, "c": 2, "b": 1}]}',
    "not a number": b'{"a": NaN}',
    "infinite": b'{"a": -Infinity}',
    "beyond floats": b'{"a": 1e999}',
    "beyond floats, whole": b'{"a": ' + b"9" * 400 + b"}",
    "many digits": b'{"a": ' + b"9" * 100_000 + b"}",
    "not UTF-8": b'{"a": "\xff"}',
    "UTF-16": '{"a": 1}'.encode("utf-16"),
    "half a pair": b'{"a": "\\ud800"}',
    "empty": b"",
    "cut": b'{"a": 1',
}
"""What is no JSON of ours, under why."""


@pytest.mark.parametrize("why", BAD)
def test_json_that_two_programs_could_read_as_two_things_is_refused(why):
    with pytest.raises(InputError, match=r"^results.json is damaged: "):
        parsed(BAD[why], "results.json")


def test_json_is_read_as_it_is():
    assert parsed(b'{"a": [1, 2.5, "x", null, true]}', "") == {"a": [1, 2.5, "x", None, True]}


def test_documents_of_other_types_differ():
    for other in ([], "x", 1, None, {"a": []}):
        assert list(number_differences(other, {"a": 1.0}, 1e-9))


def test_numbers_are_the_same_to_the_tolerance_and_no_further():
    assert not list(number_differences({"a": 1.0 + 1e-10}, {"a": 1.0}, 1e-9))
    assert list(number_differences({"a": 1.0 + 1e-8}, {"a": 1.0}, 1e-9))
    assert list(number_differences({"a": True}, {"a": 1}, 1e-9))


def test_blanks_between_words_do_not_count_and_every_letter_does():
    assert word_differences("RTU- 1\n10 .", "RTU-1 10.") == []
    assert word_differences("24.0 in", "24.1 in") == ["'24.0' where the input gives '24.1'"]


@pytest.mark.parametrize("content", [b"{", b"", b"\xff", b"[" * 3000, b'{"a": NaN}'])
def test_what_the_reader_of_json_says_reaches_nobody(content):
    with pytest.raises(InputError, match=r"^results.json is damaged: no JSON$"):
        parsed(content, "results.json")


def test_an_object_of_many_keys_is_refused_in_a_time_that_grows_as_their_number():
    def twice(count):
        keys = [f'"k{k}": 1' for k in range(count)]
        return f"{{{', '.join([*keys, keys[-1]])}}}".encode()

    def read(content):
        with pytest.raises(InputError, match=r'the key "k\d+" is given twice'):
            parsed(content, "results.json")

    assert not grows_faster(read, twice, 2_000)


def test_sheets_of_the_same_words_in_another_order_differ_from_the_first_of_them_on():
    few, many = ("0.1 " + "a b " * count for count in (20, 1_000))
    assert word_differences(few + "b", few) == ["'b' where the input gives nothing"]
    assert word_differences(many + "b", many) == ["'b' where the input gives nothing"]
    (told,) = word_differences("0.1 b " + "a b " * 1_000, many + "a")
    assert told.startswith("'b a b a b")
    assert " where the input gives 'a b a b" in told
    assert not grows_faster(
        lambda pair: word_differences(*pair),
        lambda size: ("a b " * size, "b " * size + "a " * size),
        500,
    )
