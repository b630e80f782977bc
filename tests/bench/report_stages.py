"""Where the time of `roofslip report` goes, by stage: medians of fresh processes.

Run from the top: .venv/bin/python tests/bench/report_stages.py [RUNS] [PROJECT]
"""

from __future__ import annotations

import gc
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
    gc.disable()  # as the command does
    laps: dict[str, float] = {}
    clock = [time.perf_counter(), ""]

    def stage(name: str) -> None:
        now = time.perf_counter()
        if clock[1]:
            laps[clock[1]] = laps.get(clock[1], 0.0) + now - clock[0]
        clock[:] = [now, name]

    stage("read the workbook and its records, with imports")
    from report.motions.prepare import prepare
    from report.sheet.read import read

    sheet = read(project)
    shaking = prepare(sheet)
    stage("run the motions, compiled code loaded")
    from report.assessment.project import assess

    assessment = assess(sheet, shaking)
    stage("(the same once more, now that all code is loaded)")
    solver_s = assess(sheet, shaking).solver_seconds
    stage("spectra, histories, other friction, the governing run by every method")
    from report.assessment.evidence import support

    evidence = support(assessment)
    stage("pages: charts, words and formulas, with imports")
    from report.package.html import pages

    html = pages(assessment, evidence)
    stage("PDF, with imports")
    from report.typeset.pdf import lay_out

    package = lay_out(html)
    stage("result tables")
    from report.results.tables import tables

    sizes = [len(package), *(len(table) for table in tables(assessment, evidence).values())]
    stage("")
    count = sum(len(motion.runs) for item in assessment.arrays for motion in item.motions)
    laps[f"(the solver alone, {count} histories)"] = solver_s
    print(json.dumps({"laps": laps, "bytes": sizes}))


def main() -> None:
    """Print the median of each stage and of the whole process."""
    runs = int(sys.argv[1]) if len(sys.argv) > 1 else 5
    project = Path(sys.argv[2]) if len(sys.argv) > 2 else ROOT / "projects" / "example"
    stages, walls = [], []
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
        stages.append(json.loads(done.stdout)["laps"])
    print(f"{platform.machine()}, Python {platform.python_version()}, median of {runs} runs")
    for name in stages[-1]:
        print(f"{name:56}{statistics.median(laps[name] for laps in stages[1:]):8.4f} s")
    print(f"{'whole process':56}{statistics.median(walls[1:]):8.4f} s")


if __name__ == "__main__":
    if sys.argv[1:2] == ["--child"]:
        sys.path.insert(0, str(ROOT))
        child(Path(sys.argv[2]))
    else:
        main()
