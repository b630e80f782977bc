"""Which tests run: the nightly ones apart, and of the others, the quick ones.

`./roofslip test --durations` writes `tests/durations.csv`. Read `is_quick`.
"""

from __future__ import annotations

import csv
import os
import subprocess
import time
from collections import Counter, defaultdict
from collections.abc import Generator, Iterable, Mapping
from pathlib import Path, PurePosixPath
from typing import Any

import pytest

from asked import tests_of_changed
from places import ROOT

DURATIONS = Path(__file__).with_name("durations.csv")
KEPT_S = 0.02
"""Shorter tests are not kept in the file: they are quick."""

QUICK_S = 0.1
"""Longest quick test; of a file whose tests all take longer, the shortest one is quick."""

DEAR_S = 0.6
"""Longest case that runs on every day; quick tests and those marked `by_day` run all the same."""

TOGETHER_S = 1.2
"""Longest time of the cases of a function that run on every day."""


COUNT = pytest.StashKey[int]()
"""How many tests are left out."""


def function_of(nodeid: str) -> str:
    """Return the test function of a test: its cases count as one."""
    return nodeid.partition("[")[0]


def pytest_addoption(parser: pytest.Parser) -> None:
    """Add the options that `./roofslip test` uses."""
    group = parser.getgroup("selection")
    group.addoption("--which", choices=("usual", "quick", "nightly", "all"), default="usual")
    group.addoption("--all-changed", action="store_true", help="as if every file had changed")
    group.addoption("--write-durations", action="store_true")


def pytest_collection_modifyitems(config: pytest.Config, items: list[pytest.Item]) -> None:
    """Leave out what was not asked for; a test named by `::` always runs."""
    which = config.getoption("--which")
    if which == "all" or any("::" in argument for argument in config.args):
        return
    functions = {function_of(item.nodeid): item.fixturenames for item in items}
    cases = Counter(function_of(item.nodeid) for item in items)
    durations = read(DURATIONS)
    quick = is_quick(durations, functions)
    changed, is_all_changed = changed_files(), config.getoption("--all-changed")
    nights = nightly(items, changed, is_all_changed=is_all_changed)
    if not is_all_changed:
        counts = counts_of_every_day(durations, functions, cases)
        counts |= {name: max(counts[name], 1) for name in quick}
        nights |= dear_and_apart(items, counts, (*tests_of_changed(changed), *named(config)))
    left_out = []
    for item in items:
        is_nightly = item in nights
        runs = {
            "usual": not is_nightly,
            "quick": not is_nightly and function_of(item.nodeid) in quick,
            "nightly": is_nightly,
        }
        if not runs[which]:
            left_out.append(item)
    config.hook.pytest_deselected(items=left_out)
    config.stash[COUNT] = len(left_out)
    gone = set(left_out)
    items[:] = [item for item in items if item not in gone]


def named(config: pytest.Config) -> list[str]:
    """Return the files and folders of the command line, which are all there are without one."""
    paths = (os.path.relpath(argument, ROOT) for argument in config.args)
    return [path for path in paths if path not in ("tests", ".")]


def nightly(
    items: list[pytest.Item], changed: set[str], *, is_all_changed: bool = False
) -> set[pytest.Item]:
    """Return the tests that are left out by day.

    A test marked `nightly(*paths)` runs by day where one of these files, or a file in one of these
    folders, changed. Of a function marked `by_day(n)`, n cases run by day, evenly spaced; where
    every file is taken as changed, all: each may run lines of its own.
    """
    found, cases = set(), defaultdict(list)
    for item in items:
        night = item.get_closest_marker("nightly")
        runs_by_day = night is None or (
            bool(night.args) and (is_all_changed or any(f.startswith(night.args) for f in changed))
        )
        if not runs_by_day:
            found.add(item)
        elif item.get_closest_marker("by_day") and not is_all_changed:
            cases[function_of(item.nodeid)].append(item)
    for of in cases.values():
        found |= beyond(of, of[0].get_closest_marker("by_day").args[0])
    return found


def beyond(cases: list[pytest.Item], n: int) -> set[pytest.Item]:
    """Return the cases of a function that are left out where n run, evenly spaced."""
    return {
        case for k, case in enumerate(cases) if k * n // len(cases) == (k - 1) * n // len(cases)
    }


def dear_and_apart(
    items: list[pytest.Item], counts: Mapping[str, int], belonging: tuple[str, ...]
) -> set[pytest.Item]:
    """Return the cases beyond a count that neither are marked nor belong to what changed.

    Parameters
    ----------
    counts : mapping of str to int
        How many cases of a function run on every day.
    belonging : tuple of str
        The test files and folders that belong to what changed.
    """
    cases = defaultdict(list)
    for item in items:
        is_marked = item.get_closest_marker("nightly") or item.get_closest_marker("by_day")
        if not is_marked and not item.nodeid.startswith(belonging):
            cases[function_of(item.nodeid)].append(item)
    return {left for name, of in cases.items() for left in beyond(of, counts[name])}


def changed_files() -> set[str]:
    """Return the files that differ from the last commit but one; none where git does not say."""
    command = ["git", "diff", "--name-only", "HEAD~1"]
    try:
        done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False)
    except OSError:
        return set()
    return set(done.stdout.split())


def is_quick(durations: Mapping[str, float], functions: Mapping[str, Iterable[str]]) -> set[str]:
    """Return the quick test functions: each file has one or more.

    A test that uses a dear fixture is not quick, whichever test sets it up.

    Parameters
    ----------
    functions : mapping of str to iterable of str
        The fixtures that each function uses.
    """
    of_file = defaultdict(list)
    for name, fixtures in functions.items():
        seconds = durations.get(name, 0.0) + dear_fixtures_s(durations, name, fixtures)
        of_file[name.partition("::")[0]].append((seconds, name))
    return {
        name
        for tests in of_file.values()
        for seconds, name in tests
        if seconds <= max(QUICK_S, min(tests)[0])
    }


def counts_of_every_day(
    durations: Mapping[str, float],
    functions: Mapping[str, Iterable[str]],
    cases: Mapping[str, int],
) -> dict[str, int]:
    """Return how many cases of each function are short, alone with fixtures, and together."""
    counts = {}
    for name, fixtures in functions.items():
        case_s = durations.get(name, 0.0) / cases[name]
        is_dear = case_s + dear_fixtures_s(durations, name, fixtures) > DEAR_S
        counts[name] = 0 if is_dear else int(TOGETHER_S / max(case_s, KEPT_S / cases[name]))
    return counts


def dear_fixtures_s(durations: Mapping[str, float], name: str, fixtures: Iterable[str]) -> float:
    """Return the seconds of the fixtures of a test that are not quick."""
    file = PurePosixPath(name.partition("::")[0])
    places = (str(file), *(str(folder).replace(".", "") for folder in file.parents))
    keys = (fixture_key(place, fixture) for fixture in fixtures for place in places)
    return sum(s for s in (durations.get(key, 0.0) for key in keys) if s > QUICK_S)


def fixture_key(place: str, name: str) -> str:
    """Return the name of a fixture in the file of durations."""
    return f"{place}::@{name}"


def read(path: Path) -> dict[str, float]:
    """Return the seconds of each test function in the file."""
    if not path.is_file():
        return {}
    with path.open(encoding="utf-8", newline="") as lines:
        return {row["test"]: float(row["seconds"]) for row in csv.DictReader(lines)}


class Clock:
    """Adds up the durations of tests and of fixtures, and writes them at the end."""

    def __init__(self) -> None:
        self._seconds: Counter[str] = Counter()
        self._set_up: list[tuple[str, float]] = []

    @pytest.hookimpl(wrapper=True)
    def pytest_fixture_setup(self, fixturedef: pytest.FixtureDef) -> Generator[None, Any, Any]:
        """Time a fixture without those that it uses."""
        started = time.perf_counter()
        value = yield
        key = fixture_key(fixturedef.baseid.partition("::")[0], fixturedef.argname)
        self._set_up.append((key, time.perf_counter() - started))
        return value

    @pytest.hookimpl(tryfirst=True)
    def pytest_runtest_makereport(self, item: pytest.Item) -> None:
        """Send what was set up to the process that writes."""
        item.user_properties += [("fixture", each) for each in self._set_up]
        self._set_up.clear()

    def pytest_runtest_logreport(self, report: pytest.TestReport) -> None:
        """Add a phase of a test, and apart from it the fixtures that it was the first to use."""
        name = function_of(report.nodeid)
        self._seconds[name] += report.duration
        if report.when == "teardown":
            for kind, told in report.user_properties:
                if kind == "fixture":
                    key, seconds = told
                    self._seconds[key] = max(self._seconds[key], seconds)
                    self._seconds[name] -= seconds

    def pytest_sessionfinish(self, session: pytest.Session) -> None:
        """Write what was run; where only a part was asked for, the others stay as they were."""
        config = session.config
        if hasattr(config, "workerinput"):
            return
        is_part = named(config) or config.option.keyword or config.option.markexpr
        known = read(DURATIONS) if is_part else {}
        rows = sorted((known | dict(self._seconds)).items())
        with DURATIONS.open("w", encoding="utf-8", newline="") as lines:
            table = csv.writer(lines, lineterminator="\n")
            table.writerow(("test", "seconds"))
            table.writerows((name, f"{s:.2f}") for name, s in rows if s >= KEPT_S)


def pytest_configure(config: pytest.Config) -> None:
    """Time the tests if that was asked for."""
    if config.getoption("--write-durations"):
        config.pluginmanager.register(Clock())


def pytest_sessionfinish(session: pytest.Session) -> None:
    """Have a worker tell how many tests it left out; each leaves out the same."""
    if hasattr(session.config, "workeroutput"):
        session.config.workeroutput["left_out"] = session.config.stash.get(COUNT, 0)


@pytest.hookimpl(optionalhook=True)
def pytest_testnodedown(node: Any) -> None:
    """Keep what a worker told."""
    node.config.stash[COUNT] = getattr(node, "workeroutput", {}).get("left_out", 0)


def pytest_terminal_summary(
    terminalreporter: pytest.TerminalReporter, config: pytest.Config
) -> None:
    """Say how many tests were left out."""
    left_out = config.stash.get(COUNT, 0)
    if left_out and not config.option.collectonly:
        terminalreporter.write_line(
            f"roofslip: {left_out:,} {LEFT_OUT[config.getoption('--which')]}"
        )


LEFT_OUT = {
    "usual": "nightly tests are left out: ./roofslip test --nightly runs them",
    "quick": "tests that take longer are left out: ./roofslip test runs them",
    "nightly": "tests of the day are left out: ./roofslip test runs them",
}
