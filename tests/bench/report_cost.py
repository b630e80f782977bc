"""Claim: where the time of `roofslip report` goes, and what larger projects take.

Processor time, for other programs may be at work; medians of repeats. The stages of the example run
one after the other. Larger projects repeat the arrays
and motions of the example, the motions in reverse, or one after the other where they are longer.
"""

import gc
import itertools
import json
import math
import shutil
import statistics
import sys
import tempfile
import time
from collections.abc import Iterator
from pathlib import Path

import numpy as np
from measure import ROOT, SMOKE, command, figure, finished

from projects.example import make as example
from report.motions.prepare import prepare
from report.project.model import ProjectInput
from report.project.model.choices import UnitsFirst
from report.project.read.read import read
from report.project.write.template import write_template
from solver.formats import read_record

EXAMPLE = ROOT / "projects" / "example"
REPEATS = 1 if SMOKE else 2
COMPONENTS = ("record", "transverse", "vertical")
# Arrays, motions, and the length of the motions as a multiple of 30 s.
SIZES = ((3, 7, 1), (12, 14, 1), (3, 7, 4), (100, 7, 1), (300, 7, 1), (1000, 7, 1))
SIZES = SIZES[: 1 if SMOKE else None]


def stages() -> Iterator[str]:
    """Make the report of the example, yielding the name of each stage before it begins."""
    yield "start, read the workbook and its records, with imports"
    sheet = read(EXAMPLE)
    shaking = prepare(sheet)
    yield "load the compiled solver and run the motions"
    from report.assessment.assess import assess

    assessment = assess(sheet, shaking)
    yield "repeat the runs"
    assess(sheet, shaking)
    yield "spectra, histories, sensitivity to friction, searches, comparison methods"
    from report.assessment.support.evidence import support

    evidence = support(assessment)
    yield "charts, text and formulas of the pages, with imports"
    from report.package.html import pages

    html = pages(assessment, evidence)
    yield "PDF, with tags and imports"
    from report.typeset.pdf import lay_out

    lay_out(html)
    yield "plan.dxf, results.xlsx and results.json"
    from report.drawing.plan_dxf import write_dxf
    from report.drawing.plan_layers import plan_drawing
    from report.results.results_json import results_json
    from report.results.xlsx import results_xlsx

    write_dxf(plan_drawing(assessment))
    results_xlsx(assessment, evidence.spectra)
    results_json(assessment, evidence)


def stage_seconds() -> dict[str, float]:
    """Return the processor time of each stage [s], as the command runs them."""
    gc.disable()
    taken: dict[str, float] = {}
    running, since = "", 0.0
    for name in itertools.chain(stages(), ("",)):
        now = time.process_time()
        if running:
            taken[running], since = now - since, now
        running = name
    return taken


def make(folder: Path, arrays: int, motions: int, length: int) -> None:
    """Write a project of this size."""
    (folder / "records").mkdir(parents=True)
    shutil.copytree(EXAMPLE / "documents", folder / "documents")
    for path in (EXAMPLE / "records").iterdir():
        record = read_record(path)
        a_g = np.tile(record.a_mps2 / 9.80665, length)
        for name, samples in ((path.name, a_g), (_back(path.name), a_g[::-1])):
            lines = (f"{k * record.dt_s:.4f},{a:.6f}\n" for k, a in enumerate(samples))
            (folder / "records" / name).write_text("time_s,acceleration_g\n" + "".join(lines))
    data = example.project().model_dump()
    columns = max(5, math.ceil(math.sqrt(arrays)))
    corners = [(60.0 * (k % columns), 60.0 * (k // columns)) for k in range(arrays)]
    data["arrays"] = [
        data["arrays"][k % 3]
        | {"id": f"A{k + 1}", "x_from_m": x, "x_to_m": x + 20.0, "y_from_m": y, "y_to_m": y + 20.0}
        for k, (x, y) in enumerate(corners)
    ]
    data |= {"objects": [], "clearances": []}
    data["roof"] |= {"x_to_m": 60.0 * columns, "y_to_m": 60.0 * columns}
    given = data["motions"]
    backward = [row | {name: _back(row[name]) for name in COMPONENTS} for row in given]
    rows = [*given, *backward][:motions]
    data["motions"] = [row | {"id": f"R{k + 1}"} for k, row in enumerate(rows)]
    project = ProjectInput.model_validate(data)
    write_template(folder / "input.xlsx", units=UnitsFirst.US, example=project)


def _back(name: str) -> str:
    """Return the name of a record reversed in time: no motion may be given twice."""
    return f"{name.removesuffix('.csv')}-back.csv"


def reported(folder: Path) -> tuple[float, float]:
    """Return the processor time [s] of a report, and its memory [MB]."""
    used = [finished(command("report", str(folder), "--quiet"))[:2] for _ in range(REPEATS)]
    seconds, megabytes = zip(*used, strict=True)
    return statistics.median(seconds), max(megabytes)


def main() -> None:
    """Measure the stages of the example, then the command over projects of several sizes."""
    laps = [json.loads(finished([sys.executable, __file__, "--stages"])[2]) for _ in range(REPEATS)]
    for name in laps[0]:
        figure(f"stage of the example: {name}", statistics.median(t[name] for t in laps), "s")
    for arrays, motions, length in SIZES:
        with tempfile.TemporaryDirectory() as top:
            folder = Path(top) / "job"
            make(folder, arrays, motions, length)
            taken, megabytes = reported(folder)
        size = f"{arrays} arrays, {motions} motions of {30 * length} s"
        figure(f"report of {size}", taken, "s")
        figure(f"memory, {size}", megabytes / 1000.0, "GB")


if __name__ == "__main__":
    if "--stages" in sys.argv:
        print(json.dumps(stage_seconds()))
    else:
        main()
