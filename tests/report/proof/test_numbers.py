"""JSON from a stranger is read whole or refused, and numbers are compared to a tolerance."""

import pytest

from growth import grows_faster
from report.proof.contents import differences, first_other_word, parsed
from solver.model import InputError

pytestmark = pytest.mark.quick

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
    """Without the words of its reader."""
    said = r"no JSON|the key \"\w+\" is given twice|\".+ is larger than any number of a package"
    with pytest.raises(InputError, match=rf"^results.json is damaged: ({said})$"):
        parsed(BAD[why], "results.json")


def test_json_is_read_as_it_is_and_other_types_differ():
    assert parsed(b'{"a": [1, 2.5, "x", null, true]}', "") == {"a": [1, 2.5, "x", None, True]}
    for other in ([], "x", 1, None, {"a": []}):
        assert list(differences(other, {"a": 1.0}))


@pytest.mark.parametrize(
    ("key", "one", "two", "count"),
    [
        ("design_m", 1.0 + 5e-10, 1.0, 0),
        ("design_m", 1.0 + 2e-9, 1.0, 1),
        ("design_m", 5e-15, 0.0, 0),
        ("design_m", 2e-14, 0.0, 1),
        ("error_m", 1.9e-9, 1e-9, 0),
        ("error_m", 2.1e-9, 1e-9, 1),
        ("error_m", 1.0, 1e-9, 1),
        ("error_m", -1e-10, 1e-9, 1),
        ("is_ok", True, 1, 1),
        ("name", "A1", "A2", 1),
    ],
)
def test_numbers_are_the_same_to_the_tolerance_and_no_further(key, one, two, count):
    told = list(differences({"runs": [{key: one}]}, {"runs": [{key: two}]}))
    assert len(told) == count
    assert all(text.startswith(f"runs[0].{key} is ") for text in told)


def test_numbers_that_both_have_and_every_letter_are_compared():
    ours = {"a": 1.0, "name": "A", "list": [1.0, 2.0], "new": 3.0}
    assert not list(
        differences({"a": 1.0, "name": "B", "list": [1.0], "old": 4}, ours, shared=True)
    )
    assert list(differences({"a": 1.1}, ours, shared=True)) == ["a is 1.1; the input gives 1.0"]
    assert len(list(differences({"list": [1.0, 2.1]}, ours, shared=True))) == 1
    assert first_other_word("RTU- 1\n10 .", "RTU-1 10.") == ""
    assert first_other_word("a b 24.0 in", "ab 24.1 in") == '"24.0" where the input gives "24.1"'
    assert first_other_word("24.0 in", "24.0") == '"in" where the input gives nothing'
    assert first_other_word("24.0", "24.0 in") == 'nothing where the input gives "in"'


def test_an_object_of_many_keys_is_refused_in_a_time_that_grows_as_their_number():
    def twice(count):
        keys = [f'"k{k}": 1' for k in range(count)]
        return f"{{{', '.join([*keys, keys[-1]])}}}".encode()

    def read(content):
        with pytest.raises(InputError, match=r'the key "k\d+" is given twice'):
            parsed(content, "results.json")

    assert not grows_faster(read, twice, 2_000)
