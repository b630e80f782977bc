"""The tests run no less of the product than they did, and the quick ones some of each module."""

import pytest

import covered
from covered import Lines
from places import ROOT

SOURCE = '''"""Text."""
LIMIT = 3


def f(x):
    """Text."""
    return x + LIMIT
'''


def lines(statements, run, inside=()):
    return Lines(frozenset(statements), frozenset(run), frozenset(inside))


def test_a_module_that_is_only_imported_is_not_touched():
    inside = covered.in_functions(SOURCE)
    assert 7 in inside
    assert not lines({1, 2, 5, 7}, {1, 2, 5}, inside & {7}).is_touched
    assert lines({1, 2, 5, 7}, {1, 2, 5, 7}, inside & {7}).is_touched
    assert lines({1, 2}, {1, 2}).is_touched
    assert not lines({1, 2}, {}).is_touched


def test_a_percent_is_of_the_statements_of_a_package_and_less_is_a_problem():
    found = {
        ROOT / "solver" / "a.py": lines(range(60), range(60)),
        ROOT / "solver" / "b.py": lines(range(40), range(30)),
        ROOT / "report" / "a.py": lines(range(10), range(9)),
    }
    assert covered.percents(found) == {"solver": 90.0, "report": 90.0}
    assert covered.problems(found, {}, {"solver": 90.0, "report": 90.0}) == []
    (less,) = covered.problems(found, {}, {"solver": 90.1, "report": 90.0})
    assert less == "solver: 90.00 % of the statements are run, 90.1 % were"
    alone = {ROOT / "solver" / "a.py": lines({1, 2}, {1}, {2})}
    (left,) = covered.problems(found, alone, {"solver": 0.0, "report": 0.0})
    assert left == "solver/a.py: no quick test runs anything of it"


def test_every_module_of_the_product_is_counted():
    names = {path.relative_to(ROOT).as_posix() for path in covered.modules()}
    assert {"solver/kernels/row.py", "report/making.py", "report/web/app.py"} <= names
    assert set(covered.read()) == set(covered.PACKAGES)


@pytest.mark.nightly
def test_the_tests_run_no_less_than_they_did_and_the_quick_ones_touch_every_module():
    assert covered.main([]) == 0
