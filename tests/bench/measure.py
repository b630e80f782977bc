"""What the benchmarks share: how a figure is printed, how calls are timed, and their arguments.

`run.py` runs them: `.venv/bin/python tests/bench/run.py [--smoke] [--records FOLDER] [NAME ...]`.
"""

import argparse
import os
import statistics
import subprocess
import sys
import time
from collections.abc import Callable, Sequence
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]

_parser = argparse.ArgumentParser()
_parser.add_argument("--smoke", action="store_true", help="the smallest sizes, seconds in all")
_parser.add_argument("--records", type=Path, help="a folder of recorded motions")
_given, _ = _parser.parse_known_args()
SMOKE: bool = _given.smoke
RECORDS: Path | None = _given.records


def made_records() -> list[Path]:
    """Return the first components of the motions of the example."""
    return sorted((ROOT / "projects" / "example" / "records").glob("*-x.csv"))


def figure(name: str, value: float | str, unit: str = "", *, digits: int = 2) -> None:
    """Print a figure; a float is rounded to significant digits."""
    if isinstance(value, float):
        value = f"{float(f'{value:.{digits - 1}e}'):,g}"
    elif isinstance(value, int):
        value = f"{value:,}"
    print(f"figure {name}: {value} {unit}".rstrip(), flush=True)


def seconds(*calls: Callable[[], object], repeats: int) -> list[float]:
    """Median processor time of each call [s], taken in turns, after one that is not counted."""
    times: list[list[float]] = [[] for _ in calls]
    for _ in range(repeats + 1):
        for call, taken in zip(calls, times, strict=True):
            started = time.process_time()
            call()
            taken.append(time.process_time() - started)
    return [statistics.median(taken[1:]) for taken in times]


def command(*words: str) -> list[str]:
    """Return a command of Roofslip as the words that start it."""
    return [sys.executable, "-m", "report.cli", *words]


def finished(words: Sequence[str]) -> tuple[float, float, str]:
    """Run a command; return processor time [s], largest memory [MB] and what it prints."""
    child = subprocess.Popen(words, cwd=ROOT, stdout=subprocess.PIPE, text=True)
    assert child.stdout
    said = child.stdout.read()
    _, status, used = os.wait4(child.pid, 0)
    child.returncode = os.waitstatus_to_exitcode(status)
    assert child.returncode == 0, words
    return used.ru_utime + used.ru_stime, used.ru_maxrss / 1024.0, said
