"""Comparison of models: effect of each fuller model, and two axes against general solvers."""

from __future__ import annotations

from report.document.tables import listed
from report.document.templates import Section, section
from report.entities.shown import plain, text, words
from report.figures.work import work
from report.text.formats import scientific, ten_digits
from solver.verification.evidence import Verification

_CHANGE = (
    (words("Comparison", 4.0), lambda change: change.name),
    (text("Runs"), lambda change: change.ratios.size),
    (plain("Least"), lambda change: change.at(0.0)),
    (plain("10 %"), lambda change: change.at(10.0)),
    (plain("Median"), lambda change: change.at(50.0)),
    (plain("90 %"), lambda change: change.at(90.0)),
    (plain("Largest"), lambda change: change.at(100.0)),
    (plain("Above 1", 0, "%"), lambda change: 100.0 * change.share_above_one),
    (text("Excluded", share=1.1), lambda change: change.n_small),
    (plain("Largest change", 0, "mm", 1.3), lambda change: 1e3 * change.maximum_m),
)

_PUSHED = (
    (text("Transverse acceleration", "m/s²", 1.5), lambda row: ten_digits(row.Index)),
    (plain("Distance", 2, "mm"), lambda row: 1e3 * row.end_m),
    (text("Error reported by the run", "mm", 1.6), lambda row: scientific(1e3 * row.error_m)),
    (plain("Distance, gradual decrease of μ", 2, "mm", 2.0), lambda row: 1e3 * row.falling_end_m),
)


def models(verification: Verification) -> Section:
    """Return the comparison of the models."""
    evidence = verification.models[0]
    return section(
        "manual/models",
        "Models: one axis, two axes and rows of blocks",
        evidence=evidence,
        changes=listed(evidence.study.changes, _CHANGE, kind="compact"),
        pushed=listed(evidence.pushed.itertuples(), _PUSHED, kind="compact"),
        charts={"rungs-work": work(evidence.work)},
    )
