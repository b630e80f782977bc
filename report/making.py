"""From workbook to package: one line for each step.

Orders the steps and writes the files; each step is a function of a room below. Read `make`.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from concurrent.futures import Executor
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from report.assessment.changes import Changes
    from report.assessment.project import Assessment

OUTPUTS = ("calc-package.pdf", "plan.dxf", "results.xlsx", "results.json")

STEPS = 5
"""Steps that `make` reports."""


def make(
    source: Path,
    out: Path | None,
    since: Path | None,
    progress: Callable[[str], None],
    second: Executor,
    on_assessment: Callable[[Assessment], None] = lambda _: None,
) -> tuple[Assessment, Path, Mapping[str, bytes], Changes]:
    """Read a workbook, run its motions, and write the package and the tables.

    A second process (`report.beside`) draws and writes what it can meanwhile. `on_assessment` is
    given the assessment before the package is made, which takes longer.
    """
    second.submit(load)
    from report.assessment.changes import NO_FORMER
    from report.assessment.cost import cost
    from report.assessment.evidence import plotted, support
    from report.assessment.project import assess
    from report.drawing.dxf import write_dxf
    from report.drawing.plan import plan_drawing
    from report.motions.prepare import prepare
    from report.package.html import begin, pages
    from report.provenance.files import attachments, fingerprint, sources
    from report.results.compare import changes
    from report.results.json import results_json
    from report.results.publish import check_apart, check_writable, publish
    from report.results.since import read_former
    from report.results.tables import results_table
    from report.sheet.read import read
    from report.typeset.letters import check_letters
    from report.typeset.pdf import draw_ahead, lay_out, pictures

    progress("reading the workbook")
    former = [read_former(path) for path in (since,) if path]
    sheet = read(source)
    folder = out or sheet.path.parent / "out"
    check_letters(sheet)
    check_writable(folder)
    check_apart(OUTPUTS, folder, [sheet.path, *([since] if since else [])])
    shaking = prepare(sheet)
    found = sources(sheet, shaking, since)
    long_run_notice = cost(sheet.project, shaking)
    progress(f"running the motions ({long_run_notice or 'the first run compiles the solver'})")
    assessment = assess(sheet, shaking)
    changed = changes(former[0], assessment) if former else NO_FORMER
    begun = begin(assessment, changed, second)
    shown = plotted(assessment)
    begun = begun.plot(shown)
    on_assessment(assessment)
    evidence = support(assessment, shown)
    progress("writing the pages")
    html = pages(assessment, evidence, changed, begun)
    progress("laying out the package")
    drawn = second.submit(draw_ahead, pictures(html))
    results = second.submit(results_json, assessment, evidence)
    plan = second.submit(write_dxf, plan_drawing(assessment))
    table = second.submit(results_table, assessment, evidence.spectra)
    short = fingerprint(sheet, shaking)
    pdf = lay_out(html, drawn, lambda: attachments(found, results.result(), short))
    progress("writing the result tables")
    written = (pdf, plan.result(), table.result(), results.result())
    files = dict(zip(OUTPUTS, written, strict=True))
    publish(files, folder)
    return assessment, folder, files, changed


def load() -> None:
    """Import what draws and writes, while the other process reads and runs."""
    import report.drawing.dxf
    import report.figures.charts
    import report.package.html
    import report.results.xlsx  # noqa: F401
    from report.pages.pictures import load_charts
    from report.typeset.pdf import draw_ahead

    load_charts()
    draw_ahead([])
