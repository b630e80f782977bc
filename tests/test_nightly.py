"""Of many cases, some run by day, evenly spaced."""

import pytest

import nightly

pytestmark = pytest.mark.quick


@pytest.mark.parametrize(("n", "kept"), [(1, [0]), (2, [0, 3]), (6, [0, 1, 2, 3, 4, 5])])
def test_so_many_cases_run_by_day_evenly_spaced(n, kept):
    cases = nightly.by_day(range(6), n)
    assert [case for case in cases if isinstance(case, int)] == kept


def test_the_others_are_marked_with_their_values():
    (_, one), (_, several) = (nightly.by_day(cases, 1) for cases in ("ab", [(1, 2), (3, 4)]))
    assert (one.values, several.values) == (("b",), (3, 4))
    assert [mark.name for case in (one, several) for mark in case.marks] == ["nightly", "nightly"]
