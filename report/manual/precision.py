"""Accuracy against run time: charts and medians."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Callable, Iterator, Sequence

import numpy as np

from report.document.sections import Section
from report.document.tables import Column, Table, listed
from report.entities.shown import text, words
from report.figures import work as figures
from report.figures.scales import power_of_ten
from report.words.formats import percent, seconds, slug
from report.words.letters import lettered
from solver.rivals.methods import METHODS
from solver.verification.evidence import Verification, WorkPoint, by_setting

LEAST_PERCENT = 1e-6
"""Smallest error drawn in the charts of single methods; smaller ones are drawn there."""


def floor(verification: Verification) -> float:
    """Return the largest relative error of the exact method against 50-digit arithmetic."""
    errors = [row.error for row in verification.checks if row.section.endswith("digits")]
    return max([1e-16, *errors])


def work(verification: Verification) -> Section:
    """Return accuracy against run time."""
    points, least = verification.work, floor(verification)
    envelopes = {name: f"work-each-{slug(name)}" for _, name in figures.PANELS}
    return Section(
        id="work",
        title="Accuracy against run time",
        template="manual/work.html",
        content={
            "cases": len({(p.record, p.scene) for p in points}),
            "lost": Counter(
                p.method for p in points if math.isnan(p.seconds) or math.isnan(p.prd_error_m)
            ),
            "floor_percent": 100.0 * least,
            "least_percent": power_of_ten(LEAST_PERCENT),
            "envelopes": envelopes,
            "medians": _medians(points),
        },
        charts={
            "work-percent": figures.overview(points, "percent", 100.0 * least),
            "work-meters": figures.overview(points, "m", least * _typical_prd_m(points)),
            **{
                envelopes[name]: figures.by_method(points, measure, LEAST_PERCENT)
                for measure, name in figures.PANELS
            },
        },
    )


def _typical_prd_m(points: Sequence[WorkPoint]) -> float:
    """Return the median PRD [m], from errors given both in meters and in percent of the PRD."""
    prds = [
        100.0 * p.prd_error_m / p.prd_error_percent for p in points if p.prd_error_percent > 0.0
    ]
    return float(np.median(prds)) if prds else 1.0


def _medians(points: Sequence[WorkPoint]) -> Table:
    return listed(
        _shown(points),
        (
            (words("Method", 3.6), lambda row: row[0]),
            (words("Setting", 1.4), lambda row: _setting(row[1][0])),
            (text("Time per run", share=1.2), lambda row: _time(row[1])),
            *_errors("Error in PRD", "prd_error_percent"),
            *_errors("Error in residual", "residual_error_percent"),
            (text("Failed", share=0.7), lambda row: len(row[1]) - len(_good(row[1]))),
        ),
        kind="compact",
    )


def _shown(points: Sequence[WorkPoint]) -> Iterator[tuple[str, Sequence[WorkPoint]]]:
    """Yield the runs of each setting that is shown, the first with the name of its method."""
    for name, groups in by_setting(points).items():
        for count, group in enumerate(groups[::2] if len(groups) > 5 else groups):
            yield "" if count else lettered(METHODS[name].title), group


def _setting(point: WorkPoint) -> str:
    knob = METHODS[point.method].knob
    if knob == "substeps":
        return f"P = {point.setting:g}"
    form = {"stiffness_per_m": "k = {} /m", "tolerance": "tol. {}"}
    return form[knob].format(power_of_ten(point.setting)) if knob in form else "none"


def _good(points: Sequence[WorkPoint]) -> list[WorkPoint]:
    return [point for point in points if not math.isnan(point.seconds)]


def _time(points: Sequence[WorkPoint]) -> str:
    good = _good(points)
    return seconds(float(np.median([p.seconds for p in good]))) if good else "—"


def _errors(head: str, measure: str) -> tuple[Column, Column]:
    """Return the columns of the median and of the largest error."""
    return (
        (text(head, "median", 1.2), lambda row: _error(row[1], measure, np.median)),
        (text(head, "largest", 1.2), lambda row: _error(row[1], measure, np.max)),
    )


def _error(
    points: Sequence[WorkPoint], measure: str, of: Callable[[Sequence[float]], float]
) -> str:
    if points[0].method == "exact":
        return "reference"
    errors = [getattr(point, measure) for point in _good(points)]
    return percent(float(of(errors))) if errors else "—"
