"""Which tests run by day, at night and as quick ones."""

import os
import subprocess
import sys
from dataclasses import dataclass, field
from types import SimpleNamespace

import pytest

import selection
from places import ROOT


@dataclass(frozen=True)
class Item:
    """A test as pytest gives it to the selection."""

    nodeid: str
    marks: dict = field(default_factory=dict, hash=False)

    def get_closest_marker(self, name):
        return self.marks.get(name)


def of(name, *marks, cases=1):
    found = {mark.name: mark.mark for mark in marks}
    return [Item(f"{name}[{k}]", found) for k in range(cases)]


@pytest.mark.parametrize(("n", "cases", "kept"), [(1, 8, [0]), (2, 8, [0, 4]), (3, 3, [0, 1, 2])])
def test_so_many_cases_run_by_day_evenly_spaced(n, cases, kept):
    items = of("f", pytest.mark.by_day(n), cases=cases)
    left = selection.nightly(items, set())
    assert [item for item in items if item not in left] == [items[k] for k in kept]
    assert selection.nightly(items, set(), is_all_changed=True) == set()


def test_a_nightly_test_runs_by_day_where_one_of_its_files_changed():
    items = of("f", pytest.mark.nightly("a.py")) + of("g", pytest.mark.nightly())
    assert selection.nightly(items, {"b.py"}) == set(items)
    assert selection.nightly(items, {"a.py"}) == {items[1]}
    assert selection.nightly(items, set(), is_all_changed=True) == {items[1]}


def test_as_many_cases_run_every_day_as_are_short_alone_and_together():
    durations = {"a/b.py::f": 2.0, "a/b.py::g": 0.5, "a::@made": 0.3, "c.py::f": 9.0}
    functions = {"a/b.py::f": (), "a/b.py::g": ["made"], "c.py::f": (), "c.py::g": ()}
    cases = {**dict.fromkeys(functions, 1), "a/b.py::f": 4}
    counts = selection.counts_of_every_day(durations, functions, cases)
    assert [counts[name] for name in list(functions)[:3]] == [2, 0, 0]
    assert counts["c.py::g"] > 1
    items = of("a/b.py::f", cases=4) + of("c.py::f") + of("c.py::g")
    assert selection.dear_and_apart(items, counts, ()) == {items[1], items[3], items[4]}
    assert selection.dear_and_apart(items, counts, ("c", "a/b.py")) == set()
    items = of("c.py::f", pytest.mark.by_day(1))
    assert selection.dear_and_apart(items, counts, ()) == set()


def test_of_each_file_the_shortest_test_is_quick_and_every_one_that_is_short():
    durations = {"a::f": 3.0, "a::g": 2.0, "b::f": 0.04, "b::g": 0.6}
    functions = dict.fromkeys([*durations, "b::h"], ())
    assert selection.is_quick(durations, functions) == {"a::g", "b::f", "b::h"}


def test_a_test_that_uses_a_dear_fixture_is_not_quick_whoever_sets_it_up():
    durations = {"a::@made": 2.0, "::@shared": 3.0, "b::@made": 0.04}
    functions = {"a::f": ["made"], "a::g": [], "b::f": ["shared"], "b::g": ["made"]}
    assert selection.is_quick(durations, functions) == {"a::g", "b::g"}


@pytest.mark.parametrize("workers", ["-pno:xdist", "-n2"])
def test_what_is_left_out_is_counted_at_the_end(tmp_path, workers):
    (tmp_path / "test_two.py").write_text(
        "import pytest\n\n\ndef test_day(): pass\n\n\n"
        "@pytest.mark.nightly\n@pytest.mark.parametrize('k', range(3))\ndef test_night(k): pass\n"
    )
    (tmp_path / "pytest.ini").write_text("[pytest]\nmarkers = nightly\n")
    command = [sys.executable, "-m", "pytest", "-p", "selection", workers, str(tmp_path)]
    paths = os.pathsep.join([str(ROOT / "tests"), os.environ.get("PYTHONPATH", "")])
    done = subprocess.run(
        command, env=os.environ | {"PYTHONPATH": paths}, capture_output=True, text=True, timeout=60
    )
    assert "roofslip: 3 nightly tests are left out: ./roofslip test --nightly" in done.stdout
    assert "1 passed" in done.stdout


@pytest.mark.parametrize(
    ("args", "kept"), [(["tests"], {"a::f"}), (["tests/b.py"], {"a::f", "gone"})]
)
def test_durations_of_tests_that_are_gone_are_dropped_where_all_are_run(
    tmp_path, monkeypatch, args, kept
):
    monkeypatch.setattr(selection, "DURATIONS", tmp_path / "durations.csv")
    selection.DURATIONS.write_text("test,seconds\ngone,1.00\n")
    clock = selection.Clock()
    report = SimpleNamespace(nodeid="a::f[0]", duration=0.5, when="call")
    clock.pytest_runtest_logreport(report)
    asked = SimpleNamespace(keyword="", markexpr="")
    args = [str(ROOT / path) for path in args]
    clock.pytest_sessionfinish(SimpleNamespace(config=SimpleNamespace(args=args, option=asked)))
    assert set(selection.read(selection.DURATIONS)) == kept
