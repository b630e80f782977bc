"""Where the time of `roofslip report` goes, by stage, and what the command takes: medians.

The stages run one after the other in one process; the command has a second one, which draws and
writes the tables meanwhile. Processor time is user and system time of both processes.

Run from the top: .venv/bin/python tests/bench/report_stages.py [RUNS] [PROJECT]
"""

from __future__ import annotations

import gc
import json
import platform
import resource
import statistics
import subprocess
import sys
import tempfile
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
    stage("pictures as PDF operators, with imports")
    from concurrent.futures import Future

    from report.typeset.pdf import draw_ahead, lay_out, pictures

    drawn = Future()
    drawn.set_result(draw_ahead(pictures(html)))
    stage("PDF")
    package = lay_out(html, drawn)
    stage("plan.dxf, with imports")
    from report.drawing.dxf import write_dxf
    from report.drawing.plan import plan_drawing

    write_dxf(plan_drawing(assessment))
    stage("result tables")
    from report.results.json import results_json
    from report.results.xlsx import results_xlsx

    written = (results_xlsx(assessment, evidence.spectra), results_json(assessment, evidence))
    sizes = [len(package), *map(len, written)]
    stage("")
    count = sum(len(motion.runs) for item in assessment.arrays for motion in item.motions)
    laps[f"(the solver alone, {count} histories)"] = solver_s
    print(json.dumps({"laps": laps, "bytes": sizes}))


def twice(project: Path, out: Path) -> None:
    """Make a report as the command does, and again in the same processes; print the seconds."""
    from report.beside import beside
    from report.cli.terminal import no_collections
    from report.making import make

    seconds = []
    with no_collections(), beside() as second:
        for _ in range(2):
            started = time.perf_counter()
            make(project, out, None, lambda doing: None, second)
            seconds.append(time.perf_counter() - started)
    print(json.dumps(seconds))


def fresh(*arguments: str) -> tuple[str, float, float]:
    """Run this file in a fresh process: what it prints, its time and its processor time [s]."""
    before, started = resource.getrusage(resource.RUSAGE_CHILDREN), time.perf_counter()
    done = subprocess.run(
        [sys.executable, *arguments], cwd=ROOT, check=True, capture_output=True, text=True
    )
    wall, after = time.perf_counter() - started, resource.getrusage(resource.RUSAGE_CHILDREN)
    return (
        done.stdout,
        wall,
        after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime,
    )


def main() -> None:
    """Print the median of each stage, of the command, and of a report in warm processes."""
    runs = int(sys.argv[1]) if len(sys.argv) > 1 else 5
    project = sys.argv[2] if len(sys.argv) > 2 else str(ROOT / "projects" / "example")
    stages, commands, warm = [], [], []
    with tempfile.TemporaryDirectory() as out:
        for _ in range(runs + 1):
            stages.append(json.loads(fresh(__file__, "--child", project)[0])["laps"])
            commands.append(fresh("-m", "report.cli", "report", project, "--out", out)[1:])
            warm.append(json.loads(fresh(__file__, "--twice", project, out)[0])[1])
    print(f"{platform.machine()}, Python {platform.python_version()}, median of {runs} runs")
    for name in stages[-1]:
        print(f"{name:64}{statistics.median(laps[name] for laps in stages[1:]):8.4f} s")
    walls, busy = zip(*commands[1:], strict=True)
    print(f"{'the command, with its second process':64}{statistics.median(walls):8.4f} s")
    print(f"{'the command, processor time':64}{statistics.median(busy):8.4f} s")
    print(f"{'a report in two processes that are warm':64}{statistics.median(warm[1:]):8.4f} s")


if __name__ == "__main__":
    if sys.argv[1:2] == ["--child"]:
        sys.path.insert(0, str(ROOT))
        child(Path(sys.argv[2]))
    elif sys.argv[1:2] == ["--twice"]:
        sys.path.insert(0, str(ROOT))
        twice(Path(sys.argv[2]), Path(sys.argv[3]))
    else:
        main()
