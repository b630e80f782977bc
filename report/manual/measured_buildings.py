"""Roof motion computed from ground motion: its difference from a recorded roof motion.

The comparison of models: effect of each fuller model, and two axes against general solvers.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from report.document.columns import plain, text, words
from report.document.sections import Section, section
from report.document.tables import Column, Table, compared_with, listed
from report.manual import stability_maps
from report.text.counts import numbered
from report.text.error_text import general, scientific, ten_digits
from report.text.letter_case import capitalized
from report.text.names import joined, slug
from report.text.units import G_MPS2, NO_BREAK, number
from solver.building.roof import FINENESS, RESTING_SHARE, SHARE
from solver.model import Floats
from solver.verification import model_study
from solver.verification.evidence import (
    HELD,
    HELD_ONE,
    LEAST_M,
    OVER_FAST,
    OVER_SLOW,
    OVER_STATIC,
    SECOND,
    WORST,
    ModelChange,
    RoofComparison,
    RoofPrediction,
    Verification,
)

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


# Changes that the sentences tell, by the name that the template has for each.
_NAMED = {
    "second": SECOND, "worst": WORST, "slow": OVER_SLOW, "fast": OVER_FAST,
    "one_axis": HELD_ONE, "two_axes": HELD, "over_static": OVER_STATIC,
}  # fmt: skip


def _said(change: ModelChange) -> Mapping[str, object]:
    """Return the values of a change for sentences; nothing if it has no ratios."""
    if not change.ratios.size:
        return {}
    return {
        "is_greater": change.median > 1.0,
        "median": number(change.median, 2),
        "middle": middle(change),
        "largest": number(change.at(100.0), 1),
        "above_percent": number(100.0 * change.share_above_one, 0),
        "other_percent": number(100.0 * (1.0 - change.share_above_one), 0),
    }


def models(verification: Verification) -> Section:
    """Return the comparison of the models."""
    # One or none: a study is a tuple so that it can be left out.
    evidence = verification.models[0]
    study, jumping = evidence.study, model_study.JUMPING
    texts: Mapping[str, Any] = {name: _said(study.named(key)) for name, key in _NAMED.items()}
    made = len(study.motions) - study.n_recorded
    motions = (
        numbered(made, "generated motion") if made else "",
        f"{study.n_recorded} recorded in earthquakes" if study.n_recorded else "",
    )
    return section(
        "manual/models",
        "Models: one axis, two axes and rows of blocks",
        study=study,
        slow_share=model_study.SLOW_SHARE,
        rate_s_per_m=model_study.RATE_S_PER_M,
        tolerance=model_study.PUSHED_TOLERANCE,
        falling_rate_s_per_m=model_study.FALLING.rate_s_per_m,
        motions=" and ".join(filter(None, motions)),
        slopes_deg=joined([*map(general, study.slopes_deg)]),
        mus=joined([*map(general, study.mus)]),
        ppas_g=joined([*map(general, study.ppas_g)]),
        row_shares=joined([*map(general, model_study.ROW_SHARES)]),
        n_blocks=len(model_study.ROW_SHARES),
        least_mm=1e3 * LEAST_M,
        # One number serves both: kinetic over static friction, and friction at low over high
        # velocity.
        static_ratio=f"{1.0 / model_study.SLOW_SHARE:.4g}",
        pushed_caption=f"Distance from the initial position after 2{NO_BREAK}s: a sliding block "
        f"stops under an opposing acceleration of {model_study.PUSHED_BACK_G:g}{NO_BREAK}g; "
        f"kinetic μ = {jumping.mu_slow:g}, static μ = {jumping.mu_static:g}",
        **texts,
        changes=listed(study.changes, _CHANGE, kind="compact"),
        pushed=listed(evidence.pushed.itertuples(), _PUSHED, kind="compact"),
    )


def middle(change: ModelChange) -> str:
    """Return the range of 10 to 90% of the ratios."""
    return f"{number(change.at(10.0), 2)} to {number(change.at(90.0), 2)}"


def building(verification: Verification) -> Section:
    """Return each building, the model building first."""
    names = [f"building-{slug(roof.title)}" for roof in verification.roofs]
    return section(
        "manual/building",
        "Roof motion computed from ground motion",
        share_percent=100.0 * SHARE,
        fineness=FINENESS,
        resting_percent=100.0 * RESTING_SHARE,
        real="; ".join(roof.title for roof in verification.roofs if roof.is_recorded),
        roofs=[_roof(roof, name) for roof, name in zip(verification.roofs, names, strict=True)],
        charts={
            name: stability_maps.comparison(roof)
            for roof, name in zip(verification.roofs, names, strict=True)
        },
    )


def _roof(roof: RoofComparison, chart: str) -> Mapping[str, object]:
    """Return what is shown of a building."""
    reference, ratios = _reference(roof).lower(), _ratios(roof)
    history = f", and {stability_maps.SHOWN_S:g}{NO_BREAK}s of the roof acceleration"
    spectra = "response spectra of ground, roof and computed roof motions"
    return {
        "title": roof.title,
        "description": roof.description,
        "ratios": ratios,
        "properties": _properties(roof),
        "chart": chart,
        "caption": f"{roof.title}: {spectra}{history if ratios else ''}.",
        "alt": f"Response of the roof, {reference} and computed",
        "bands": _bands(roof),
        "reference": reference,
        "peaks": _peaks(roof),
        "peaks_caption": (
            f"PRD on a slope of {roof.slope_deg:g}°; in parentheses, ratio to the reference (first "
            "row)"
        ),
        "scale": f"{roof.scale:.3g}",
    }


def _ratios(roof: RoofComparison) -> str:
    """Return the ratios of the PRD of a recorded roof motion."""
    predictions = stability_maps.computed(roof) if roof.is_recorded else ()
    return "; ".join(f"{prediction.name}: {span(prediction, roof)}" for prediction in predictions)


def span(prediction: RoofPrediction, roof: RoofComparison) -> str:
    """Return the least and the largest ratio of its PRD to that of the roof motion."""
    ratios = prediction.prd_m / roof.prd_m
    return f"{number(ratios.min(), 2)} to {number(ratios.max(), 2)}"


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
                # `k=k` keeps the k of this column; without it every column would show the last
                # one.
                (text(f"{low:g} to {high:g}", "s"), lambda prediction, k=k: _band(prediction, k))
                for k, (low, high) in enumerate(roof.bands_s)
            ),
        ),
    )


def _band(prediction: RoofPrediction, k: int) -> str:
    # Of a logarithm, a standard deviation of 0.1 reads as 10%: e^0.1 is 1.105.
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
