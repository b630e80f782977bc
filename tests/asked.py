"""Runs the tests that were asked for: `./roofslip test report/sheet` those of that folder.

A folder of the product stands for the folder of its tests, a module for the test files that bear
its name or import it. A path under `tests` stands for itself. Read `tests_of`.
"""

from __future__ import annotations

import ast
import sys
from collections.abc import Iterable, Iterator
from contextlib import suppress
from difflib import get_close_matches
from functools import cache
from pathlib import Path

import pytest

from places import ROOT

PACKAGES = ("report", "solver")
WITH_VALUE = ("--dist", "--numprocesses", "--which", "-k", "-m", "-n", "-o", "-p", "-W")
"""Options of pytest whose value is a word of its own, which is no path."""


def words_for_pytest(words: list[str]) -> list[str]:
    """Return the words of the command line with each path replaced by the tests that belong."""
    found: list[str] = []
    for before, word in zip(["", *words], words, strict=False):
        is_path = not word.startswith("-") and before not in WITH_VALUE
        found += tests_of(word) if is_path else [word]
    return found


def tests_of(asked: str) -> list[str]:
    """Return the tests that belong to a path; a `LookupError` says what would do."""
    path = (ROOT / asked.partition("::")[0]).resolve()
    inside = path.relative_to(ROOT) if path.is_relative_to(ROOT) else Path("..")
    if path.exists() and inside.parts[:1] == ("tests",):
        return [asked]
    if not path.exists() or inside.parts[:1] not in {(name,) for name in PACKAGES}:
        raise LookupError(_unknown(asked))
    if path.suffix == ".py" and path.stem != "__init__":
        files = sorted(_of_module(inside))
        if files:
            return files
    return [_folder_of(inside)]


def tests_of_changed(paths: Iterable[str]) -> tuple[str, ...]:
    """Return the test files and folders that belong to files, with the folders of their tests."""
    found = set()
    for path in paths:
        if path.startswith(("tests/", *(f"{name}/" for name in PACKAGES))):
            with suppress(LookupError):  # it is deleted
                found |= set(tests_of(path))
                if path.count("/") > 1 and not path.startswith("tests/"):
                    found.add(_folder_of(Path(path)))
    return tuple(found)


def _folder_of(inside: Path) -> str:
    """Return the nearest folder of tests of a file or folder of the product."""
    folder = next(here for here in (inside, *inside.parents) if (ROOT / "tests" / here).is_dir())
    return f"tests/{folder.as_posix()}"


def _of_module(module: Path) -> Iterator[str]:
    name = ".".join(module.with_suffix("").parts)
    for file in (ROOT / "tests").rglob("test_*.py"):
        inside = file.relative_to(ROOT / "tests")
        if inside == module.with_name(f"test_{module.name}") or name in imported(file):
            yield f"tests/{inside.as_posix()}"


@cache
def imported(file: Path) -> set[str]:
    """Return the modules that a file imports; names imported from a module count as modules too."""
    found = set()
    for node in ast.walk(ast.parse(file.read_bytes())):
        if isinstance(node, ast.Import):
            found |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom) and node.module:
            found |= {node.module, *(f"{node.module}.{alias.name}" for alias in node.names)}
    return found


def _unknown(asked: str) -> str:
    known = [
        path.relative_to(ROOT).as_posix()
        for name in (*PACKAGES, "tests")
        for path in (ROOT / name).rglob("*")
        if path.suffix == ".py" or (path.is_dir() and path.name != "__pycache__")
    ]
    close = get_close_matches(asked.strip("/"), known, n=1)
    meant = f"; did you mean {close[0]}?" if close else ""
    return (
        f"no tests belong to {asked}: give a folder or module of report or solver, such as "
        f"report/sheet or report/sheet/faults.py, or a path under tests{meant}"
    )


if __name__ == "__main__":
    try:
        sys.exit(pytest.main(words_for_pytest(sys.argv[1:])))
    except LookupError as problem:
        sys.exit(f"roofslip: {problem.args[0]}")
