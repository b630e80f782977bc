"""What the manual opens with: summary, scope and terms."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence

import numpy as np

from report.manual.blocks import (
    FAIL,
    PASS,
    Block,
    ManualSection,
    joined,
    percent,
    scientific,
    seconds,
)
from report.manual.building import answer
from report.manual.precision import floor
from report.manual.rungs import answers
from report.manual.studies import PAPER_MEAN_PERCENT, PAPER_WORST_PERCENT, worst_mm
from report.pages.parts import Table, TableColumn, TableRow, verdict
from solver.verification.evidence import (
    CheckRow,
    Verification,
    WorkPoint,
)


def summary(found: Verification) -> ManualSection:
    """Return the page that says whether everything passed, and the figures that count."""
    failed = [row for row in found.checks if not row.passed]
    return ManualSection(
        id="summary",
        title="Summary",
        blocks=(
            Block(
                texts=(verdict_line(found),),
                tables=(_key_figures(found), _by_section(found.checks)),
                items=[f"{FAIL}: {row.section}, {row.problem}, {row.quantity}" for row in failed],
            ),
        ),
    )


def verdict_line(found: Verification) -> str:
    """Return PASS or FAIL with the count."""
    words = verdict(found.passed and len(found.checks) > 0, (PASS, FAIL))
    return words + f" {passed(found.checks)} checks passed."


def passed(checks: Sequence[CheckRow]) -> str:
    """Return how many of how many checks passed."""
    return f"{sum(row.passed for row in checks)} of {len(checks)}"


def _key_figures(found: Verification) -> Table:
    return Table(
        caption="What was found",
        columns=(
            TableColumn(head="Question", align="left", share=2.6),
            TableColumn(head="Answer", align="left", share=2.9),
            TableColumn(head="ManualSection", align="left", share=0.7),
        ),
        rows=tuple(TableRow(cells=cells) for cells in _answers(found)),
    )


def _answers(found: Verification) -> Iterator[tuple[str, str, str]]:
    yield (
        "Largest relative error of the exact method against many-digit arithmetic",
        scientific(floor(found)),
        "3",
    )
    times = [p.seconds for p in found.work if p.method == "exact"]
    if times:
        yield "Time per run of the exact method, median", seconds(float(np.median(times))), "5"
    ratio = _times_longer(found.work)
    if not math.isnan(ratio):
        text = f"{ratio:.0f} times longer, with errors in PRD up to {percent(_paper_error(found))}"
        yield "The paper's method with 64 sub-steps on the same runs, median", text, "5"
    lost = sum(math.isnan(p.seconds) for p in found.work)
    yield "Runs of all methods that failed", f"{lost} of {len(found.work)}", "5"
    cells = sum(one.failed.size for one in found.maps)
    yield (
        "Cells of the stability maps in which a rival failed",
        f"{sum(int(one.failed.sum()) for one in found.maps)} of {cells}",
        "6",
    )
    if found.links:
        worst = max(found.links, key=lambda one: one.worst_percent)
        mean = float(np.mean([one.mean_percent for one in found.links]))
        yield (
            "Against the link of the paper's SAP 2000 model: difference in RRD",
            f"{percent(worst.worst_percent)} worst, which is {worst_mm(worst):.2g} mm; "
            f"{percent(mean)} mean; the paper had {PAPER_WORST_PERCENT} % and "
            f"{PAPER_MEAN_PERCENT} %",
            "8",
        )
    runs = sum(one.runs for one in found.curves)
    took = sum(one.seconds for one in found.curves)
    yield "The paper's parametric study", f"{runs:,} runs in {seconds(took)}", "9"
    if told := answer(found):
        yield "The roof of a real building, computed from its ground", told, "11"
    for question, told in answers(found):
        yield question, told, "12"
    extent = "quick: fewer records, scenes and settings" if found.quick else "full"
    yield "Extent of this verification", f"{extent}; {found.seconds:.0f} s in all", "2"


def _times_longer(points: Sequence[WorkPoint]) -> float:
    exact = {(p.record, p.scene): p.seconds for p in points if p.method == "exact"}
    ratios = [
        p.seconds / exact[p.record, p.scene]
        for p in points
        if p.method == "paper" and p.setting == 64 and (p.record, p.scene) in exact
    ]
    return float(np.median(ratios)) if ratios else math.nan


def _paper_error(found: Verification) -> float:
    errors = [p.prd_error_percent for p in found.work if p.method == "paper" and p.setting == 64]
    return max(errors, default=math.nan)


def _by_section(checks: Sequence[CheckRow]) -> Table:
    names = dict.fromkeys(row.section for row in checks)
    groups = [(name, [row for row in checks if row.section == name]) for name in names]
    return Table(
        caption="Checks by section",
        columns=(
            TableColumn(head="ManualSection", align="left", share=3.0),
            TableColumn(head="Checks"),
            TableColumn(head="Passed"),
            TableColumn(head="Largest error", share=1.4),
            TableColumn(head="of its tolerance", share=1.4),
            TableColumn(head="Result", align="center"),
        ),
        rows=tuple(
            TableRow(
                cells=(
                    name,
                    str(len(rows)),
                    str(sum(row.passed for row in rows)),
                    scientific(max(row.error for row in rows)),
                    _used(rows),
                    verdict(all(row.passed for row in rows), (PASS, FAIL)),
                )
            )
            for name, rows in groups
        ),
        notes=(
            "Errors are relative to the expected value, absolute where that is zero. Of its "
            "tolerance: the largest share of a tolerance that any check uses up.",
        ),
    )


def _used(rows: Sequence[CheckRow]) -> str:
    shares = [row.error / row.tolerance for row in rows if row.tolerance > 0.0]
    return f"{100.0 * max(shares):.2g} %" if shares else "—"


def scope(found: Verification) -> ManualSection:
    """Return what is verified, the terms, and the records."""
    return ManualSection(
        id="scope",
        title="Scope and terms",
        blocks=(
            Block(
                title="What is verified",
                texts=(
                    "The solver: one rigid block on a sloped roof plane that is shaken along the "
                    "slope's fall, across it and upright, held by friction alone. The records are "
                    "samples joined by straight lines. Every number of a calculation package that "
                    "is a displacement comes from this solver: in one axis with the method "
                    "“exact”, in two axes with power series (section 12).",
                    "The way from ground to roof, where the motions given are those of the ground: "
                    "checks in section 3, whole buildings in section 11.",
                    "Not verified here: code rules and their numbers (marked in each package "
                    "where they have not been compared with the adopted text), the choice of "
                    "motions and of friction, and whether a rigid block is the right model.",
                ),
            ),
            Block(
                title="Terms",
                items=(
                    "PRD: peak relative displacement, the largest horizontal displacement of the "
                    "block from its place on the roof. RRD: the residual one, at the end.",
                    "θ: slope of the roof; μ: friction coefficient; PPA: peak horizontal "
                    "acceleration of the roof plane; P: sub-steps in each sampling interval.",
                    "Error in percent: difference from the exact displacement, in percent of it, "
                    "or of 1 mm where it is less than that.",
                    "Exact: the displacement of the method “exact”, which section 3 holds "
                    "against many-digit arithmetic on the same records.",
                    "Time per run: one thread, warm, the least of some repeats, without reading "
                    "the record and checking the input. A failed run has no time.",
                ),
            ),
            Block(
                title="Records",
                texts=tuple(_records(found)),
            ),
        ),
    )


def _records(found: Verification) -> Iterator[str]:
    yield (
        f"{_count(len(found.records), 'record')} of one component: {joined(found.records)}. The "
        "project makes its own from a fixed seed: motions that follow the AC156 spectrum at the "
        "roof, and a near-fault pulse."
    )
    for one in found.rungs:
        study = one.study
        made = len(study.motions) - study.n_recorded
        words = (
            f"{_count(len(study.motions), 'motion')} of three components, for sections 12 and on: "
            f"{joined(study.motions[:made])}, made likewise"
        )
        if study.n_recorded:
            words += f"; {joined(study.motions[made:])}, recorded in earthquakes"
        yield words + "."
    if buildings := [one.title for one in found.roofs[1:]]:
        yield f"Recorded buildings, for section 11: {joined(buildings)}."


def extent(found: Verification) -> str:
    """Return how much was run, in a line."""
    motions = [name for one in found.rungs for name in one.study.motions]
    counts = [
        f"{_count(len(found.records), 'record')} of one component",
        _count(len(motions), "motion") + " of three",
        _count(len(found.roofs[1:]), "recorded building"),
    ]
    return f"{'quick' if found.quick else 'full'}: {joined(counts)}"


def _count(number: int, name: str) -> str:
    return f"{number} {name}{'s' if number != 1 else ''}"
