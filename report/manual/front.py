"""Front matter of the manual: summary, scope and terms."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence

import numpy as np

from report.document.tables import Table, TableRow
from report.entities.columns import TableColumn
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
from report.manual.features import verified
from report.manual.precision import floor
from report.manual.rungs import answers
from report.manual.studies import PAPER_MEAN_PERCENT, PAPER_WORST_PERCENT, worst_mm
from report.pages.parts import verdict
from report.words.validation import validation
from solver.verification.evidence import (
    CheckRow,
    Verification,
    WorkPoint,
)


def summary(verification: Verification) -> ManualSection:
    """Return the summary: verdict, key results and checks by section."""
    failed = [row for row in verification.checks if not row.passed]
    return ManualSection(
        id="summary",
        title="Summary",
        blocks=(
            Block(
                texts=(verdict_line(verification),),
                tables=(_key_figures(verification), _by_section(verification.checks)),
                items=[f"{FAIL}: {row.section}, {row.problem}, {row.quantity}" for row in failed],
            ),
        ),
    )


def verdict_line(verification: Verification) -> str:
    """Return PASS or FAIL with the count."""
    words = verdict(verification.passed and len(verification.checks) > 0, (PASS, FAIL))
    return words + f" {passed(verification.checks)} checks passed."


def passed(checks: Sequence[CheckRow]) -> str:
    """Return how many of how many checks passed."""
    return f"{sum(row.passed for row in checks)} of {len(checks)}"


def _key_figures(verification: Verification) -> Table:
    return Table(
        caption="Key results",
        columns=(
            TableColumn(head="Quantity", align="left", share=2.6),
            TableColumn(head="Result", align="left", share=2.9),
            TableColumn(head="Section", align="left", share=0.7),
        ),
        rows=tuple(TableRow(cells=cells) for cells in _answers(verification)),
    )


def _answers(verification: Verification) -> Iterator[tuple[str, str, str]]:
    yield (
        "Largest relative error of the exact method against 50-digit arithmetic",
        scientific(floor(verification)),
        "3",
    )
    times = [p.seconds for p in verification.work if p.method == "exact"]
    if times:
        yield "Median time per run of the exact method", seconds(float(np.median(times))), "5"
    ratio = _times_longer(verification.work)
    if not math.isnan(ratio):
        error = percent(_paper_error(verification))
        text = f"{ratio:.0f} times the run time (median), errors in PRD up to {error}"
        yield "The paper's method with 64 sub-steps, same analysis cases", text, "5"
    lost = sum(math.isnan(p.seconds) for p in verification.work)
    yield "Failed runs, all methods", f"{lost} of {len(verification.work)}", "5"
    cells = sum(sweep.failed.size for sweep in verification.maps)
    yield (
        "Failed cells of the stability maps, other methods",
        f"{sum(int(sweep.failed.sum()) for sweep in verification.maps)} of {cells}",
        "6",
    )
    if verification.links:
        worst = max(verification.links, key=lambda comparison: comparison.worst_percent)
        mean = float(np.mean([comparison.mean_percent for comparison in verification.links]))
        yield (
            "Difference in RRD from the link of the paper's SAP 2000 model",
            f"{percent(worst.worst_percent)} largest ({worst_mm(worst):.2g} mm), "
            f"{percent(mean)} mean; the paper reports {PAPER_WORST_PERCENT} % and "
            f"{PAPER_MEAN_PERCENT} %",
            "8",
        )
    runs = sum(study.runs for study in verification.curves)
    took = sum(study.seconds for study in verification.curves)
    yield "The paper's parametric study", f"{runs:,} runs in {seconds(took)}", "9"
    if result := answer(verification):
        yield "Roof motion of a recorded building, computed from its ground motion", result, "11"
    for quantity, result in answers(verification):
        yield quantity, result, "12"
    yield "Comparison with a shake table", validation(verification.tables), "13"
    yield "Features verified by checks of this run", verified(verification), "14"
    extent = "quick: fewer records, cases and settings" if verification.quick else "full"
    yield "Extent of this verification", f"{extent}; {verification.seconds:.0f} s in total", "2"


def _times_longer(points: Sequence[WorkPoint]) -> float:
    exact = {(p.record, p.scene): p.seconds for p in points if p.method == "exact"}
    ratios = [
        p.seconds / exact[p.record, p.scene]
        for p in points
        if p.method == "paper" and p.setting == 64 and (p.record, p.scene) in exact
    ]
    return float(np.median(ratios)) if ratios else math.nan


def _paper_error(verification: Verification) -> float:
    errors = [
        p.prd_error_percent for p in verification.work if p.method == "paper" and p.setting == 64
    ]
    return max(errors, default=math.nan)


def _by_section(checks: Sequence[CheckRow]) -> Table:
    names = dict.fromkeys(row.section for row in checks)
    groups = [(name, [row for row in checks if row.section == name]) for name in names]
    return Table(
        caption="Checks by section",
        columns=(
            TableColumn(head="Section", align="left", share=3.0),
            TableColumn(head="Checks"),
            TableColumn(head="Passed"),
            TableColumn(head="Largest error", share=1.4),
            TableColumn(head="Tolerance used", share=1.4),
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
            "Errors are relative to the expected value, or absolute where it is zero. Tolerance "
            "used: the largest ratio of error to tolerance of any check in the section.",
        ),
    )


def _used(rows: Sequence[CheckRow]) -> str:
    shares = [row.error / row.tolerance for row in rows if row.tolerance > 0.0]
    return f"{100.0 * max(shares):.2g} %" if shares else "—"


def scope(verification: Verification) -> ManualSection:
    """Return scope, terms and records."""
    return ManualSection(
        id="scope",
        title="Scope and terms",
        blocks=(
            Block(
                title="What is verified",
                texts=(
                    "This manual verifies the solver. The model is one rigid block on a sloped "
                    "roof plane, restrained by friction only and shaken downslope, cross-slope "
                    "and vertically. The acceleration varies linearly between samples of the "
                    "record. This solver computes every displacement in a calculation package: "
                    "in one axis by the method “exact”, in two axes by power series (section 12).",
                    "Where ground motions are given, the program computes the roof motion. "
                    "Section 3 has checks of this step, and section 11 compares whole buildings.",
                    "Of the code rules, section 3 checks formulas and a published calculation; "
                    "each package marks the values not compared with the adopted text. This "
                    "manual does not verify the selection of motions and friction coefficients, "
                    "or whether a rigid block is the appropriate model. Section 14 lists every "
                    "feature with its status, and section 15 the errors of released versions.",
                ),
            ),
            Block(
                title="Terms",
                items=(
                    "The paper: “Predicted Slip of Ballasted Solar Arrays on Angled Roofs due to "
                    "Seismic Motion”.",
                    "PRD: peak relative displacement, the largest horizontal displacement of the "
                    "block from its initial position on the roof. RRD: residual relative "
                    "displacement, at the end of the record.",
                    "θ: slope of the roof; μ: friction coefficient; PPA: peak horizontal "
                    "acceleration of the roof plane; P: number of sub-steps per sampling interval.",
                    "Analysis case: one block, given by θ and μ, under one record scaled to one "
                    "PPA.",
                    "Error in percent: difference from the exact displacement, in percent of that "
                    "displacement, or of 1 mm if that is larger.",
                    "Exact: computed by the method “exact”, which section 3 compares with "
                    "50-digit arithmetic on the same records.",
                    "Time per run: one thread, after compilation, the least of several repeats, "
                    "without reading the record and checking the input. A failed run has no time.",
                ),
            ),
            Block(
                title="Records",
                texts=tuple(_records(verification)),
            ),
        ),
    )


def _records(verification: Verification) -> Iterator[str]:
    yield (
        f"{_count(len(verification.records), 'record')} of one component: "
        f"{joined(verification.records)}. The program generates its own records from a fixed seed: "
        "motions matched to the AC156 spectrum at the roof, and a near-fault pulse."
    )
    for evidence in verification.rungs:
        study = evidence.study
        made = len(study.motions) - study.n_recorded
        words = (
            f"{_count(len(study.motions), 'motion')} of three components, for section 12 and "
            f"following: {joined(study.motions[:made])}, generated in the same way"
        )
        if study.n_recorded:
            words += f"; {joined(study.motions[made:])}, recorded in earthquakes"
        yield words + "."
    if buildings := [roof.title for roof in verification.roofs[1:]]:
        yield f"Recorded buildings, for section 11: {joined(buildings)}."


def extent(verification: Verification) -> str:
    """Return the number of records and buildings, in one line."""
    motions = [name for evidence in verification.rungs for name in evidence.study.motions]
    counts = [
        f"{_count(len(verification.records), 'record')} of one component",
        _count(len(motions), "motion") + " of three",
        _count(len(verification.roofs[1:]), "recorded building"),
    ]
    return f"{'quick' if verification.quick else 'full'}: {joined(counts)}"


def _count(number: int, name: str) -> str:
    return f"{number} {name}{'s' if number != 1 else ''}"
