"""Where the time of `roofslip report` goes, by stage: medians of fresh processes.

Run from the top: .venv/bin/python tests/bench/report_stages.py [RUNS] [PROJECT]
"""

from __future__ import annotations

import json
import platform
import statistics
import subprocess
import sys
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]


def child(project: Path) -> None:
    """Make a report, stage by stage, and print the seconds of each as JSON."""
    laps: dict[str, float] = {}
    clock = [time.perf_counter(), ""]

    def stage(name: str) -> None:
        now = time.perf_counter()
        if clock[1]:
            laps[clock[1]] = laps.get(clock[1], 0.0) + now - clock[0]
        clock[:] = [now, name]

    stage("read the workbook, with imports")
    from report.sheet.read import read_workbook

    book = read_workbook(project)
    stage("run the motions, compiled code loaded")
    from report.assessment.project import assess

    assessment = assess(book.input, book.motions)
    stage("(the same once more, now that all code is loaded)")
    solver_s = assess(book.input, book.motions).solver_seconds
    stage("load what draws and lays out")
    from report.assessment.evidence import find
    from report.package.html import load, render, words
    from report.pages.parts import Scene

    load()
    stage("spectra, histories, the governing run by every method")
    scene = Scene(data=book.input, assessment=assessment)
    found = find(book, assessment, scene.governing)
    package = render(scene, lambda: found, lambda: words(book, scene, found), stage)
    stage("result tables")
    from report.results.json import results_json
    from report.results.xlsx import results_xlsx

    sizes = [len(package), len(results_xlsx(book, assessment)), len(results_json(book, assessment))]
    stage("")
    count = sum(len(motion.runs) for item in assessment.arrays for motion in item.motions)
    laps[f"(the solver alone, {count} histories)"] = solver_s
    print(json.dumps({"laps": laps, "bytes": sizes}))


def main() -> None:
    """Print the median of each stage and of the whole process."""
    runs = int(sys.argv[1]) if len(sys.argv) > 1 else 5
    project = Path(sys.argv[2]) if len(sys.argv) > 2 else ROOT / "projects" / "example"
    found, walls = [], []
    for _ in range(runs + 1):
        started = time.perf_counter()
        done = subprocess.run(
            [sys.executable, __file__, "--child", str(project)],
            cwd=ROOT,
            check=True,
            capture_output=True,
            text=True,
        )
        walls.append(time.perf_counter() - started)
        found.append(json.loads(done.stdout)["laps"])
    print(f"{platform.machine()}, Python {platform.python_version()}, median of {runs} runs")
    for name in found[-1]:
        print(f"{name:56}{statistics.median(laps[name] for laps in found[1:]):8.4f} s")
    print(f"{'whole process':56}{statistics.median(walls[1:]):8.4f} s")


if __name__ == "__main__":
    if sys.argv[1:2] == ["--child"]:
        sys.path.insert(0, str(ROOT))
        child(Path(sys.argv[2]))
    else:
        main()
