"""Accuracy against run time: charts and medians."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence

import numpy as np

from report.document.blocks import Picture
from report.document.tables import Table, TableRow
from report.entities.columns import TableColumn
from report.figures import work as figures
from report.figures.scales import power_of_ten
from report.manual.blocks import (
    Block,
    Chart,
    ManualSection,
    joined,
    percent,
    scientific,
    seconds,
    slug,
)
from report.words.letters import lettered
from solver.rivals.methods import METHODS
from solver.verification.evidence import (
    Verification,
    WorkPoint,
)

LEAST_PERCENT = 1e-6
"""Smallest error drawn in the charts of single methods; smaller ones are drawn there."""


def floor(verification: Verification) -> float:
    """Return the largest relative error of the exact method against 50-digit arithmetic."""
    errors = [row.error for row in verification.checks if row.section.endswith("digits")]
    return max([1e-16, *errors])


def work(verification: Verification) -> ManualSection:
    """Return accuracy against run time."""
    least = floor(verification)
    cases = len({(p.record, p.scene) for p in verification.work})
    lost = [p for p in verification.work if math.isnan(p.seconds) or math.isnan(p.prd_error_m)]
    missing = f"All {len(verification.work)} runs gave a result."
    if lost:
        missing = (
            f"{len(lost)} of {len(verification.work)} runs failed and are not drawn "
            f"({_lost(lost)})."
        )
    meters = least * _typical_prd_m(verification.work)
    return ManualSection(
        id="work",
        title="Accuracy against run time",
        blocks=(
            Block(
                texts=(
                    f"Every method is run on {cases} analysis cases with its settings from coarse "
                    "to fine. Lower points are more accurate; points further left are faster. The "
                    f"exact method has no setting; it is drawn at {scientific(100.0 * least)} %, "
                    "its largest error against 50-digit arithmetic (section 3).",
                ),
                charts=(
                    Chart(
                        name="work-percent",
                        picture=Picture(
                            svg=figures.overview(verification.work, "percent", 100.0 * least),
                            caption=f"Error in percent: medians over the analysis cases. {missing}",
                            alt="Error in percent against time per run, all methods",
                        ),
                    ),
                    Chart(
                        name="work-meters",
                        picture=Picture(
                            svg=figures.overview(verification.work, "m", meters),
                            caption="Error in meters: medians over the analysis cases. The exact "
                            "method is drawn at its relative error times the median PRD. "
                            f"{missing}",
                            alt="Error in meters against time per run, all methods",
                        ),
                    ),
                    *_envelopes(verification),
                ),
                tables=(_work_table(verification.work),),
            ),
        ),
    )


def _typical_prd_m(points: Sequence[WorkPoint]) -> float:
    """Return the median PRD [m], from errors given both in meters and in percent of the PRD."""
    prds = [
        100.0 * p.prd_error_m / p.prd_error_percent for p in points if p.prd_error_percent > 0.0
    ]
    return float(np.median(prds)) if prds else 1.0


def _lost(points: Sequence[WorkPoint]) -> str:
    names = dict.fromkeys(p.method for p in points)
    return joined([f"{name}: {sum(p.method == name for p in points)}" for name in names])


def _envelopes(verification: Verification) -> Iterator[Chart]:
    for measure, name in figures.PANELS:
        yield Chart(
            name=f"work-each-{slug(name)}",
            picture=Picture(
                svg=figures.by_method(verification.work, measure, LEAST_PERCENT),
                caption=f"Error in {name} by method. Dots: runs; band: least to largest error over "
                "the analysis cases, at the median time; dark line: medians; light lines: medians "
                f"of the other methods. Errors below {power_of_ten(LEAST_PERCENT)} % are drawn at "
                f"{power_of_ten(LEAST_PERCENT)} %.",
                alt=f"Error in {name} against time per run, a panel for each method",
            ),
        )


def _work_table(points: Sequence[WorkPoint]) -> Table:
    rows = []
    for name in dict.fromkeys(p.method for p in points):
        own = [p for p in points if p.method == name]
        settings = list(dict.fromkeys(p.setting for p in own if not math.isnan(p.setting)))
        shown = settings[::2] if len(settings) > 5 else settings
        groups = [[p for p in own if p.setting == value] for value in shown] or [own]
        rows += [_work_row(name, group, is_first=n == 0) for n, group in enumerate(groups)]
    return Table(
        caption="Median times, and median and largest errors, over the analysis cases",
        columns=(
            TableColumn(head="Method", align="left", share=3.6),
            TableColumn(head="Setting", align="left", share=1.4),
            TableColumn(head="Time per run", share=1.2),
            TableColumn(head="Error in PRD", unit="median", share=1.2),
            TableColumn(head="Error in PRD", unit="largest", share=1.2),
            TableColumn(head="Error in residual", unit="median", share=1.2),
            TableColumn(head="Error in residual", unit="largest", share=1.2),
            TableColumn(head="Failed", share=0.7),
        ),
        rows=tuple(rows),
        notes=(
            "Where a method has more than five settings, every second one is shown; all are in "
            "verification.csv.",
        ),
        kind="compact",
    )


def _work_row(name: str, points: Sequence[WorkPoint], *, is_first: bool) -> TableRow:
    good = [p for p in points if not math.isnan(p.seconds)]
    errors: tuple[str, ...] = ("—",) * 4
    if name == "exact":
        errors = ("reference",) * 4
    elif good:
        prd = [p.prd_error_percent for p in good]
        residual = [p.residual_error_percent for p in good]
        errors = tuple(percent(float(f(v))) for v in (prd, residual) for f in (np.median, np.max))
    return TableRow(
        cells=(
            lettered(METHODS[name].title) if is_first else "",
            _setting(name, points[0].setting),
            seconds(float(np.median([p.seconds for p in good]))) if good else "—",
            *errors,
            str(len(points) - len(good)),
        )
    )


def _setting(name: str, value: float) -> str:
    knob = METHODS[name].knob
    if knob == "substeps":
        return f"P = {value:g}"
    form = {"stiffness_per_m": "k = {} /m", "tolerance": "tol. {}"}
    return form[knob].format(power_of_ten(value)) if knob in form else "none"
