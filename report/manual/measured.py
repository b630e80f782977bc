"""Roof motion computed from ground motion: its difference from a recorded roof motion.

The comparison with shake-table tests: acceptance, tests, result; or that there are none. The
comparison of models: effect of each fuller model, and two axes against general solvers.
"""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np

from report.document.tables import Column, Table, compared_with, grouped, listed
from report.document.templates import Section, section
from report.entities.shown import plain, text, words
from report.figures import manual as figures
from report.text.counts import capitalized, grouped_by, joined
from report.text.formats import NOT_VALIDATED, explained, scientific, slug, ten_digits
from report.text.units import G_MPS2, number
from solver.model import Floats
from solver.verification import shake_table as accepted
from solver.verification.evidence import RoofComparison, RoofPrediction, Verification
from solver.verification.shake_table import ShakeTable, TableRun

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
    # One or none: a study is a tuple so that it can be left out.
    evidence = verification.models[0]
    return section(
        "manual/models",
        "Models: one axis, two axes and rows of blocks",
        evidence=evidence,
        changes=listed(evidence.study.changes, _CHANGE, kind="compact"),
        pushed=listed(evidence.pushed.itertuples(), _PUSHED, kind="compact"),
    )


def building(verification: Verification) -> Section:
    """Return each building, the model building first."""
    names = [f"building-{slug(roof.title)}" for roof in verification.roofs]
    return section(
        "manual/building",
        "Roof motion computed from ground motion",
        SHOWN_S=figures.SHOWN_S,
        computed=figures.computed,
        roofs=[
            (roof, name, _properties(roof), _bands(roof), _peaks(roof))
            for roof, name in zip(verification.roofs, names, strict=True)
        ],
        charts={
            name: figures.comparison(roof)
            for roof, name in zip(verification.roofs, names, strict=True)
        },
    )


def _name(head: str) -> Column:
    return (words(head, 3.2), lambda prediction: capitalized(prediction.name))


def _reference(roof: RoofComparison) -> str:
    return "Recorded" if roof.is_recorded else "Integrated directly"


def _properties(roof: RoofComparison) -> Table:
    """Return the properties of each prediction, and its overall agreement."""
    rows = listed(
        roof.predictions,
        (
            _name("Building"),
            (plain("First period", 2, "s"), lambda rows: rows.period_s),
            (plain("Damping", 1, "%", 0.9), lambda rows: 100.0 * rows.damping),
            (plain("Stiffness ratio", 1), lambda rows: rows.alpha0),
            # The ground applied at the roof has no building, and no modes.
            (text("Modes included", share=0.9), lambda rows: rows.n_modes or "—"),
            (
                text("Neglected", "%"),
                lambda rows: number(100.0 * rows.left_out_share, 1) if rows.n_modes else "—",
            ),
            (plain("Peak", 3, "g", 0.8), lambda rows: rows.peak_mps2 / G_MPS2),
            (plain("Unexplained", 1, "%", 1.1), lambda rows: 100.0 * rows.unexplained),
        ),
    )
    # The first row is what the others are compared with: it has a peak, and no properties.
    peak = number(float(np.abs(roof.roof_mps2).max()) / G_MPS2, 3)
    return compared_with(rows, (_reference(roof), *["—"] * 5, peak, "—"))


def _bands(roof: RoofComparison) -> Table:
    return listed(
        roof.predictions,
        (
            _name("Building"),
            *(
                (text(f"{low:g} to {high:g}", "s"), lambda prediction, at=at: _band(prediction, at))
                for at, (low, high) in enumerate(roof.bands_s)
            ),
        ),
    )


def _band(prediction: RoofPrediction, at: int) -> str:
    return f"{prediction.band_ratios[at]:.2f} ({100.0 * prediction.band_scatters[at]:.0f} %)"


def _peaks(roof: RoofComparison) -> Table:
    rows = listed(
        roof.predictions,
        (
            _name("Roof motion"),
            *(
                (text(f"μ = {mu:g}", "mm"), lambda rows, at=at: _peak(rows.prd_m, roof, at))
                for at, mu in enumerate(roof.mus)
            ),
        ),
    )
    peaks = (number(1e3 * prd_m, 0) for prd_m in roof.prd_m)
    return compared_with(rows, (_reference(roof), *peaks))


def _peak(prd_m: Floats, roof: RoofComparison, at: int) -> str:
    return f"{number(1e3 * prd_m[at], 0)} ({prd_m[at] / roof.prd_m[at]:.2f})"


_TEST = (
    (words("Test", 1.6), lambda run: run.test.name),
    (words("Axes", 0.7), lambda run: _axes(run)),
    (text("θ", "deg", 0.6), lambda run: f"{math.degrees(run.test.scene.slope_rad):.3g}"),
    (text("μ", share=0.9), lambda run: _mus(run)),
    (text("Model", share=0.7), lambda run: int(run.model)),
    (plain("PRD, stated", 1, "mm"), lambda run: 1e3 * run.test.prd_m),
    (
        text("PRD, computed", "mm", 1.1),
        # A run without a result says why in its place.
        lambda run: run.status.value if math.isnan(run.prd_m) else number(1e3 * run.prd_m, 1),
    ),
    (plain("Ratio", 3, share=0.7), lambda run: run.ratio),
    (plain("Residual, stated", 1, "mm", 1.1), lambda run: 1e3 * run.test.residual_m),
    (plain("Residual, computed", 1, "mm", 1.2), lambda run: 1e3 * run.residual_m),
)


def shake_table(verification: Verification) -> Section:
    """Return the section."""

    def source(run: TableRun) -> str:
        return f"Slip {run.test.data}: {run.test.source}"

    return section(
        "manual/shake-table",
        "Comparison with a shake table",
        # As with no tests: what the section says where there are none.
        explained=explained(()),
        tables=[
            (
                table,
                grouped(grouped_by(table.runs, source), _TEST),
                list(_rows(table)),
                result(table),
            )
            for table in verification.tables
        ],
    )


def result(table: ShakeTable) -> str:
    """Return whether the acceptance is satisfied, and what follows from it."""
    unsatisfied = [
        f"{name[0].lower()}{name[1:]}, {value} instead of {limit}"
        for name, value, limit, is_satisfied in _rows(table)
        if not is_satisfied
    ]
    words = f"not satisfied: {joined(unsatisfied)}" if unsatisfied else "satisfied"
    words = f"The acceptance is {words}."
    return words if table.validates else f"{words} {NOT_VALIDATED}"


def _rows(table: ShakeTable) -> Iterator[tuple[str, str, str, bool]]:
    """Yield what is required, what was found, what is accepted, and whether it is."""
    count, least, (low, high) = table.ratios.size, accepted.LEAST_TESTS, accepted.MEDIAN
    yield "Number of ratios", str(count), f"{least} or more", count >= least
    is_within = low <= table.median <= high
    yield "Median ratio", number(table.median, 3), f"{low:g} to {high:g}", is_within
    share, least_share, (low, high) = table.share_within, accepted.SHARE, accepted.RATIOS
    value, limit = f"{100.0 * share:.0f} %", f"{100.0 * least_share:g} % or more"
    yield f"Share of the ratios in {low:g} to {high:g}", value, limit, share >= least_share


def _axes(run: TableRun) -> str:
    scene = run.test.scene
    return "x" + ("y" if scene.ay_mps2.size else "") + ("z" if scene.az_mps2.size else "")


def _mus(run: TableRun) -> str:
    law = run.test.scene.friction
    return f"{law.mu_slow:g}" if law.is_constant else f"{law.mu_slow:g}, {law.mu_static:g}"
