"""Roof motion computed from ground motion: its difference from a recorded roof motion.

The comparison of models: effect of each fuller model, and two axes against general solvers.
"""

from __future__ import annotations

import numpy as np

from report.document.columns import plain, text, words
from report.document.sections import Section, section
from report.document.tables import Column, Table, compared_with, listed
from report.manual import stability_maps
from report.text.error_text import scientific, ten_digits
from report.text.letter_case import capitalized
from report.text.names import slug
from report.text.units import G_MPS2, number
from solver.model import Floats
from solver.verification.evidence import RoofComparison, RoofPrediction, Verification

_CHANGE = (
    (words("Comparison", 4.0), lambda change: change.name),
    (text("Runs"), lambda change: change.ratios.size),
    (plain("Least"), lambda change: change.at(0.0)),
    (plain("10%"), lambda change: change.at(10.0)),
    (plain("Median"), lambda change: change.at(50.0)),
    (plain("90%"), lambda change: change.at(90.0)),
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
        SHOWN_S=stability_maps.SHOWN_S,
        computed=stability_maps.computed,
        roofs=[
            (roof, name, _properties(roof), _bands(roof), _peaks(roof))
            for roof, name in zip(verification.roofs, names, strict=True)
        ],
        charts={
            name: stability_maps.comparison(roof)
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
                (text(f"{low:g} to {high:g}", "s"), lambda prediction, k=k: _band(prediction, k))
                for k, (low, high) in enumerate(roof.bands_s)
            ),
        ),
    )


def _band(prediction: RoofPrediction, k: int) -> str:
    return f"{prediction.band_ratios[k]:.2f} ({100.0 * prediction.band_scatters[k]:.0f}%)"


def _peaks(roof: RoofComparison) -> Table:
    rows = listed(
        roof.predictions,
        (
            _name("Roof motion"),
            *(
                (text(f"μ = {mu:g}", "mm"), lambda rows, k=k: _peak(rows.prd_m, roof, k))
                for k, mu in enumerate(roof.mus)
            ),
        ),
    )
    peaks = (number(1e3 * prd_m, 0) for prd_m in roof.prd_m)
    return compared_with(rows, (_reference(roof), *peaks))


def _peak(prd_m: Floats, roof: RoofComparison, k: int) -> str:
    return f"{number(1e3 * prd_m[k], 0)} ({prd_m[k] / roof.prd_m[k]:.2f})"
