"""A name stands for one thing: no two classes of the product, and no two files of tests."""

import ast
from collections import Counter, defaultdict
from pathlib import Path

import pytest

from places import ROOT, TESTS

pytestmark = pytest.mark.quick


def doubled(texts):
    """Return the public names of classes that more than one of the texts gives, with where."""
    found = defaultdict(list)
    for where, text in texts.items():
        for node in ast.walk(ast.parse(text)):
            if isinstance(node, ast.ClassDef) and not node.name.startswith("_"):
                found[node.name].append(f"{where}:{node.lineno}")
    return {name: places for name, places in found.items() if len(places) > 1}


def test_a_name_of_two_classes_is_found_unless_it_is_private():
    one = "class Surface:\n    pass\n\n\nclass _Part:\n    pass\n"
    other = "def made():\n    class Surface:\n        pass\n\n\nclass _Part:\n    pass\n"
    assert doubled({"one.py": one, "other.py": other}) == {"Surface": ["one.py:1", "other.py:2"]}


def test_no_two_classes_and_no_two_files_of_tests_have_one_name():
    files = [path for folder in ("solver", "report") for path in Path(ROOT, folder).rglob("*.py")]
    assert len(files) > 100
    assert doubled({path.relative_to(ROOT): path.read_text() for path in files}) == {}
    # Pytest stops at the second one.
    names = Counter(path.name for path in TESTS.rglob("test_*.py"))
    assert len(names) > 100
    assert [name for name, count in names.items() if count > 1] == []
