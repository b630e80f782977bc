"""Accuracy against run time: charts and medians."""

from __future__ import annotations

from collections.abc import Iterator

import pandas as pd

from report.document.sections import Section, section
from report.document.tables import Column, Table, listed
from report.entities.shown import text, words
from report.figures import work as figures
from report.figures.scales import power_of_ten
from report.words.formats import percent, seconds, slug
from report.words.letters import lettered
from solver.rivals.methods import METHODS
from solver.verification.evidence import Verification

LEAST_PERCENT = 1e-6
"""Smallest error drawn in the charts of single methods; smaller ones are drawn there."""


def floor(verification: Verification) -> float:
    """Return the largest relative error of the exact method against 50-digit arithmetic."""
    errors = [row.error for row in verification.checks if row.section.endswith("digits")]
    return max([1e-16, *errors])


def work(verification: Verification) -> Section:
    """Return accuracy against run time."""
    runs, least = verification.work, floor(verification)
    lost = runs[runs[["time per run [s]", "PRD error [m]"]].isna().any(axis=1)]
    envelopes = {measure: f"work-each-{slug(measure)}" for measure in figures.MEASURES}
    return section(
        "manual/work",
        "Accuracy against run time",
        cases=len(runs[["record", "case"]].drop_duplicates()),
        lost=lost.groupby("method", sort=False).size().to_dict(),
        floor_percent=100.0 * least,
        least_percent=power_of_ten(LEAST_PERCENT),
        envelopes=envelopes,
        medians=_medians(runs),
        charts={
            "work-percent": figures.overview(runs, "%", 100.0 * least),
            "work-meters": figures.overview(runs, "m", least * _typical_prd_m(runs)),
            **{
                name: figures.by_method(runs, measure, LEAST_PERCENT)
                for measure, name in envelopes.items()
            },
        },
    )


def _typical_prd_m(runs: pd.DataFrame) -> float:
    """Return the median PRD [m], from errors given both in meters and in percent of the PRD."""
    off = runs[runs["PRD error [%]"] > 0.0]
    return (
        float((100.0 * off["PRD error [m]"] / off["PRD error [%]"]).median()) if len(off) else 1.0
    )


def _medians(runs: pd.DataFrame) -> Table:
    return listed(
        _shown(runs),
        (
            (words("Method", 3.6), lambda row: row[0]),
            (words("Setting", 1.4), lambda row: _setting(*row[1].iloc[0][["method", "setting"]])),
            (
                text("Time per run", share=1.2),
                lambda row: seconds(row[1]["time per run [s]"].median()),
            ),
            *_errors("Error in PRD", "PRD error [%]"),
            *_errors("Error in residual", "residual error [%]"),
            (text("Failed", share=0.7), lambda row: row[1]["time per run [s]"].isna().sum()),
        ),
        kind="compact",
    )


def _shown(runs: pd.DataFrame) -> Iterator[tuple[str, pd.DataFrame]]:
    """Yield the runs of each setting that is shown, the first with the name of its method."""
    for name, own in runs.groupby("method", sort=False):
        groups = [group for _, group in own.groupby("setting", sort=False, dropna=False)]
        for count, group in enumerate(groups[::2] if len(groups) > 5 else groups):
            yield "" if count else lettered(METHODS[str(name)].title), group


def _setting(method: str, value: float) -> str:
    knob = METHODS[method].knob
    if knob == "substeps":
        return f"P = {value:g}"
    form = {"stiffness_per_m": "k = {} /m", "tolerance": "tol. {}"}
    return form[knob].format(power_of_ten(value)) if knob in form else "none"


def _errors(head: str, error: str) -> tuple[Column, Column]:
    """Return the columns of the median and of the largest error."""

    def found(runs: pd.DataFrame, of: str) -> str:
        is_exact = runs["method"].iloc[0] == "exact"
        return "reference" if is_exact else percent(runs[error].agg(of))

    return (
        (text(head, "median", 1.2), lambda row: found(row[1], "median")),
        (text(head, "largest", 1.2), lambda row: found(row[1], "max")),
    )
