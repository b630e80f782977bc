"""The script that changes the solver's source: its changes, and that a test is asked of each."""

import ast
import re
import subprocess
import sys

import pytest

import mutants
from places import TESTS

pytestmark = pytest.mark.quick

SOURCE = '''
"""Text."""
LIMIT = 0.05


def f(x: float = 2.0) -> bool:
    """Text."""
    return -x + 1 < LIMIT and not x == 0
'''


def test_each_change_is_one_and_none_is_of_a_docstring():
    tree = ast.parse(SOURCE)
    drawn = mutants.sites(tree, limits=True)
    texts = {ast.unparse(mutants.mutant(tree, *site)[0]) for site in drawn}
    assert len(texts) == len(drawn) == 11
    assert all(text.count("Text.") == 2 for text in texts)
    assert ast.unparse(tree) not in texts
    assert len(mutants.sites(tree, limits=False)) == len(drawn) - 1


@pytest.mark.nightly
def test_the_tests_of_the_rules_kill_most_of_ten_mutants():
    command = [sys.executable, TESTS / "mutants.py", "solver/rules", "--count", "10"]
    done = subprocess.run(command, capture_output=True, text=True, check=True, timeout=300)
    killed = re.search(r"^killed: (\d+) of 10$", done.stdout, re.MULTILINE)
    assert int(killed[1]) >= 7, done.stdout
