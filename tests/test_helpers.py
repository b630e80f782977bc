"""The helpers of tests do what they say, and a name stands for one thing."""

import ast
import shutil
import subprocess
from collections import Counter, defaultdict
from pathlib import Path

import playwright
import pytest

from fixtures import golden, marks
from fixtures.paths import ROOT, TESTS

pytestmark = pytest.mark.quick


def test_a_golden_text_is_shown_as_a_difference_and_taken_over_where_asked_for(tmp_path):
    path = tmp_path / "golden" / "page.txt"
    shown = golden.difference(path, "a\nb\n", is_taken_over=False)
    assert shown.splitlines()[-2:] == ["+a", "+b"]
    assert not path.exists()
    golden.difference(path, "a\nb\n", is_taken_over=True)
    assert golden.difference(path, "a\nb\n", is_taken_over=False) == ""
    shown = golden.difference(path, "a\nc\n", is_taken_over=False)
    assert shown.splitlines()[2:] == ["@@ -1,2 +1,2 @@", " a", "-b", "+c"]


@pytest.mark.parametrize(("n", "kept"), [(1, [0]), (2, [0, 3]), (6, [0, 1, 2, 3, 4, 5])])
def test_so_many_cases_run_by_day_evenly_spaced(n, kept):
    cases = marks.by_day(range(6), n)
    assert [case for case in cases if isinstance(case, int)] == kept
    for k, case in enumerate(cases):
        assert k in kept or (case.values, case.marks[0].name) == ((k,), "nightly")


def doubled(texts):
    """Return the public names of classes that more than one of the texts gives, with where."""
    found = defaultdict(list)
    for where, text in texts.items():
        for node in ast.walk(ast.parse(text)):
            if isinstance(node, ast.ClassDef) and not node.name.startswith("_"):
                found[node.name].append(f"{where}:{node.lineno}")
    return {name: places for name, places in found.items() if len(places) > 1}


def test_no_two_classes_and_no_two_files_of_tests_have_one_name():
    files = [path for folder in ("solver", "report") for path in Path(ROOT, folder).rglob("*.py")]
    assert len(files) > 100
    assert doubled({path.relative_to(ROOT): path.read_text() for path in files}) == {}
    # Pytest stops at the second one.
    names = Counter(path.name for path in TESTS.rglob("test_*.py"))
    assert len(names) > 100
    assert [name for name, count in names.items() if count > 1] == []
    one = "class Surface:\n    pass\n\n\nclass _Part:\n    pass\n"
    other = "def made():\n    class Surface:\n        pass\n\n\nclass _Part:\n    pass\n"
    assert doubled({"one.py": one, "other.py": other}) == {"Surface": ["one.py:1", "other.py:2"]}


# Of packages that debootstrap's minbase has: libc6, libgcc-s1, libstdc++6.
IN_MINBASE = {
    "libc.so.6", "libdl.so.2", "libm.so.6", "libpthread.so.0", "librt.so.1", "libgcc_s.so.1",
    "libstdc++.so.6",
}  # fmt: skip


@pytest.fixture(scope="module")
def libraries():
    """Shared libraries of the node of Playwright, which drives the browser."""
    if shutil.which("ldd") is None:
        pytest.skip("no ldd to list libraries")
    node = Path(playwright.__file__).parent / "driver" / "node"
    done = subprocess.run(["ldd", str(node)], capture_output=True, text=True, check=True)
    return {line.split()[0] for line in done.stdout.splitlines() if "=>" in line}


def test_the_launcher_looks_after_every_library_that_a_bare_debian_lacks(libraries):
    launcher = "".join((ROOT / name).read_text() for name in ("roofslip", "tests/run.sh"))
    assert "libc.so.6" in libraries
    assert not [name for name in libraries - IN_MINBASE if f"{name}=" not in launcher]
