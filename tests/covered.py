"""How much of the product its tests run: `python tests/covered.py`, or `--raise`.

The statements that tests run on a day on which every file has changed are counted for each package,
kernels by their tests with the compiler off, and compared with `tests/covered.csv`; `--raise`
writes what is more than there. Modules of which the quick tests run nothing are named.
`./roofslip test --nightly` does it.
"""

from __future__ import annotations

import ast
import csv
import os
import sqlite3
import subprocess
import sys
import tempfile
from collections.abc import Iterable
from contextlib import closing
from dataclasses import dataclass
from pathlib import Path

from coverage import Coverage

from places import ROOT, TESTS

PACKAGES = ("solver", "report")
KEPT = TESTS / "covered.csv"
KERNELS = TESTS / "solver" / "kernels"
SLACK = 0.05
"""Percent that a run may fall short: a process that is killed loses what it had counted."""


@dataclass(frozen=True)
class Lines:
    """The statements of a module, those that were run, and those that stand in its functions."""

    statements: frozenset[int]
    run: frozenset[int]
    in_functions: frozenset[int]

    @property
    def is_touched(self) -> bool:
        """Whether a function was called; of a module without one, whether it was imported."""
        return not self.run.isdisjoint(self.in_functions or self.statements or self.run)


def modules() -> list[Path]:
    """Return the modules of the product that have more than a docstring."""
    found = sorted(path for package in PACKAGES for path in (ROOT / package).rglob("*.py"))
    return [path for path in found if len(ast.parse(path.read_bytes()).body) > 1]


def in_functions(source: str) -> frozenset[int]:
    """Return the lines of the bodies of functions."""
    return frozenset(
        line
        for node in ast.walk(ast.parse(source))
        if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef)
        for line in range(node.body[0].lineno, (node.end_lineno or node.lineno) + 1)
    )


def measure(which: str, folder: Path) -> dict[Path, Lines]:
    """Return what the tests of a part run: of all processes that they start."""
    settings = folder / f"settings-{which}.ini"
    sources = "".join(f"\n    {ROOT / package}" for package in PACKAGES)
    settings.write_text(
        f"[run]\nsource ={sources}\ndata_file = {folder / which}\nparallel = true\n"
        "patch = subprocess\ndisable_warnings = no-data-collected, module-not-imported\n"
    )
    both = ["-p", "no:cacheprovider", "--all-changed", "--which"]
    _run(settings, ["--numprocesses", "2", "--dist", "worksteal", *both, which], {})
    uncompiled = [str(path) for path in KERNELS.glob("test_*kernel*.py")]
    uncompiled.append(str(KERNELS / "test_fixed_steps.py"))
    every = "quick" if which == "quick" else "all"  # as in `tests/uncompiled.py`
    _run(settings, [*both, every, *uncompiled], {"NUMBA_DISABLE_JIT": "1"})
    for path in folder.glob(f"{which}.*"):
        if not _is_whole(path):
            path.unlink()
    counted = Coverage(config_file=str(settings), messages=False)
    counted.combine()
    return {path: _lines(counted, path) for path in modules()}


def _is_whole(path: Path) -> bool:
    """Whether a process lived to write what it counted: one that is killed writes a part."""
    with closing(sqlite3.connect(path)) as data:
        try:
            named = data.execute("SELECT name FROM sqlite_master WHERE name = 'file'").fetchall()
            return bool(named) and data.execute("PRAGMA integrity_check").fetchone() == ("ok",)
        except sqlite3.DatabaseError:
            return False


def _run(settings: Path, words: list[str], variables: dict[str, str]) -> None:
    """Run tests; one that fails there, on a slower clock, counts with the lines that it ran."""
    paths = os.pathsep.join([str(ROOT), os.environ.get("PYTHONPATH", "")])
    known = {k: v for k, v in os.environ.items() if not k.startswith(("PYTEST_", "COVERAGE_"))}
    command = [sys.executable, "-m", "coverage", "run", f"--rcfile={settings}", "-m", "pytest"]
    done = subprocess.run(
        [*command, *words],
        cwd=ROOT,
        env=known | {"PYTHONPATH": paths} | variables,
        capture_output=True,
        text=True,
        check=False,
    )
    if done.returncode not in {0, 1}:
        raise RuntimeError(done.stdout[-5000:] + done.stderr[-5000:])
    print(done.stdout[-3000:])


def _lines(counted: Coverage, path: Path) -> Lines:
    _, statements, _, missing, _ = counted.analysis2(str(path))
    return Lines(
        statements=frozenset(statements),
        run=frozenset(statements) - frozenset(missing),
        in_functions=in_functions(path.read_text(encoding="utf-8")) & frozenset(statements),
    )


def percents(lines: dict[Path, Lines]) -> dict[str, float]:
    """Return the percent of the statements that were run, by package."""
    return {
        package: _percent(
            one for path, one in lines.items() if package in path.relative_to(ROOT).parts[:1]
        )
        for package in PACKAGES
    }


def _percent(lines: Iterable[Lines]) -> float:
    every = list(lines)
    return 100.0 * sum(len(one.run) for one in every) / sum(len(one.statements) for one in every)


def read() -> dict[str, float]:
    """Return the percents that were reached."""
    with KEPT.open(encoding="utf-8", newline="") as table:
        return {row["package"]: float(row["percent"]) for row in csv.DictReader(table)}


def write(reached: dict[str, float]) -> None:
    """Keep the percents, rounded down to a tenth."""
    with KEPT.open("w", encoding="utf-8", newline="") as out:
        table = csv.writer(out, lineterminator="\n")
        table.writerow(("package", "percent"))
        table.writerows((name, f"{int(10 * value) / 10:.1f}") for name, value in reached.items())


def problems(day: dict[Path, Lines], quick: dict[Path, Lines], kept: dict[str, float]) -> list[str]:
    """Return what is less than it was, and each module that the quick tests leave alone."""
    less = [
        f"{name}: {value:.2f} % of the statements are run, {kept[name]:.1f} % were"
        for name, value in percents(day).items()
        if value < kept[name] - SLACK
    ]
    alone = [path.relative_to(ROOT).as_posix() for path, one in quick.items() if not one.is_touched]
    return less + [f"{name}: no quick test runs anything of it" for name in alone]


def main(words: list[str]) -> int:
    """Measure, compare, and with `--raise` keep what is more."""
    with tempfile.TemporaryDirectory() as folder:
        day, quick = (measure(which, Path(folder)) for which in ("usual", "quick"))
    reached, kept = percents(day), read()
    for name, value in reached.items():
        print(f"{name}: {value:.2f} %, at least {kept[name]:.1f} % are asked for")
    for path, one in sorted(day.items(), key=lambda item: len(item[1].run - item[1].statements)):
        left = one.statements - one.run
        if left:
            print(f"{path.relative_to(ROOT)}: {len(left)} of {len(one.statements)} are not run")
    if "--raise" in words:
        write({name: max(value, kept[name]) for name, value in reached.items()})
    found = problems(day, quick, kept)
    print("\n".join(found))
    return int(bool(found))


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
