"""Claim: processor time of each command in all of its processes, and how long a user waits for it.

Medians of repeats; set-up is that of a fresh clone, whose packages are in the cache.
"""

import re
import statistics
import tempfile
import time
from collections.abc import Iterator
from pathlib import Path

from measure import ROOT, SMOKE, command, figure, finished

from fixtures.dxf import Sketch
from report.results.publish import OUTPUTS

REPEATS = 1 if SMOKE else 3
PROJECTS = ROOT / "projects"
COLUMNS, ROWS, FIELDS = 10, 20, 20
"""Modules of an array, and arrays of a roof: 4,000 modules."""


def roof_of_modules(folder: Path) -> Path:
    """Draw a roof with a closed line for each module [ft]; return its drawing."""
    sketch = Sketch()
    sketch.ring("A-ROOF-OTLN", ((0, 0), (400, 0), (400, 400), (0, 400)))
    for field in range(FIELDS):
        west, south = 10 + 75 * (field % 5), 10 + 95 * (field // 5)
        for k in range(COLUMNS * ROWS):
            x, y = west + 5.7 * (k % COLUMNS), south + 3.6 * (k // COLUMNS)
            corners = ((x, y), (x + 5.6, y), (x + 5.6, y + 3.4), (x, y + 3.4))
            sketch.ring("E-SOLR-PANL", corners)
    return sketch.saved(folder)


def waits(top: Path) -> Iterator[tuple[str, list[str]]]:
    """Yield what a user waits for, and its command; each may run again."""
    yield "--help", command("--help")
    yield "check of the example", command("check", str(PROJECTS / "example"), "--quiet")
    if SMOKE:
        return
    drawing, job = roof_of_modules(top), str(top / "job")
    finished(command("new", job))
    fill = command("plan", "read", str(drawing), job, "--replace", "--accept")
    yield f"plan read of {COLUMNS * ROWS * FIELDS:,} modules", fill
    for name in ("example", "campus"):
        words = ("report", str(PROJECTS / name), "--out", str(top / name), "--quiet")
        yield f"report of {name}", command(*words)
    yield "verify-package of example", command("verify-package", str(top / "example" / OUTPUTS[0]))
    target = ("--sds", "1.2", "--zh", "1", "--code", "asce7-16")
    yield "motion suite of seven", command("motion", "suite", str(top / "suite"), *target)
    # Without its parts, from which it would go on.
    anew = ["sh", "-c", 'rm -rf "$0"; exec "$@"', str(top / "study")]
    study = command("study", str(PROJECTS / "study"), "--out", str(top / "study"), "--quiet")
    yield "study of projects/study", [*anew, *study]
    yield "verify --quick", command("verify", "--quick", "--out", str(top / "quick"))
    yield "verify", command("verify", "--out", str(top / "full"))
    # Cloned each time: compiled kernels are kept beside their source.
    set_up = 'rm -rf "$0"; git clone -q "$1" "$0"; exec "$0/roofslip" report "$0/$2" --quiet'
    clone_and_report = ["sh", "-c", set_up, str(top / "clone"), str(ROOT), "projects/example"]
    yield "set-up and first report after clone", clone_and_report
    for words in (("test", "--quick"), ("test",)):
        yield f"./roofslip {' '.join(words)}", [str(ROOT / "roofslip"), *words]


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as folder:
        for name, words in waits(Path(folder)):
            repeats = 1 if "test" in words else REPEATS  # of minutes each
            times = []
            for _ in range(repeats):
                started = time.perf_counter()
                processor_s, _, said = finished(words)
                times.append((processor_s, time.perf_counter() - started))
            processor_s, waited_s = map(statistics.median, zip(*times, strict=True))
            figure(name, processor_s, "s")
            print(f"{name}: {waited_s:.2g} s by the clock")
            if passed := re.search(r"PASS: (\d+) of \1 checks", said):
                figure(f"checks that pass in {name}", int(passed[1]))
