"""Roof motion computed from ground motion: its difference from a recorded roof motion."""

from __future__ import annotations

import numpy as np

from report.document.sections import Section, section
from report.document.tables import Column, Table, compared_with, listed
from report.entities.shown import plain, text, words
from report.figures import building as figures
from report.words.counts import capitalized
from report.words.formats import slug
from report.words.units import G_MPS2, number
from solver.model import Floats
from solver.verification.evidence import RoofComparison, RoofPrediction, Verification


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
    return (words(head, 3.2), lambda found: capitalized(found.name))


def _reference(roof: RoofComparison) -> str:
    return "Recorded" if roof.is_recorded else "Integrated directly"


def _properties(roof: RoofComparison) -> Table:
    """Return the properties of each prediction, and its overall agreement."""
    found = listed(
        roof.predictions,
        (
            _name("Building"),
            (plain("First period", 2, "s"), lambda found: found.period_s),
            (plain("Damping", 1, "%", 0.9), lambda found: 100.0 * found.damping),
            (plain("Stiffness ratio", 1), lambda found: found.alpha0),
            (text("Modes included", share=0.9), lambda found: found.n_modes or "—"),
            (
                text("Neglected", "%"),
                lambda found: number(100.0 * found.left_out_share, 1) if found.n_modes else "—",
            ),
            (plain("Peak", 3, "g", 0.8), lambda found: found.peak_mps2 / G_MPS2),
            (plain("Unexplained", 1, "%", 1.1), lambda found: 100.0 * found.unexplained),
        ),
    )
    peak = number(float(np.abs(roof.roof_mps2).max()) / G_MPS2, 3)
    return compared_with(found, (_reference(roof), *["—"] * 5, peak, "—"))


def _bands(roof: RoofComparison) -> Table:
    return listed(
        roof.predictions,
        (
            _name("Building"),
            *(
                (text(f"{low:g} to {high:g}", "s"), lambda found, at=at: _band(found, at))
                for at, (low, high) in enumerate(roof.bands_s)
            ),
        ),
    )


def _band(found: RoofPrediction, at: int) -> str:
    return f"{found.band_ratios[at]:.2f} ({100.0 * found.band_scatters[at]:.0f} %)"


def _peaks(roof: RoofComparison) -> Table:
    found = listed(
        roof.predictions,
        (
            _name("Roof motion"),
            *(
                (text(f"μ = {mu:g}", "mm"), lambda found, at=at: _peak(found.prd_m, roof, at))
                for at, mu in enumerate(roof.mus)
            ),
        ),
    )
    peaks = (number(1e3 * prd_m, 0) for prd_m in roof.prd_m)
    return compared_with(found, (_reference(roof), *peaks))


def _peak(prd_m: Floats, roof: RoofComparison, at: int) -> str:
    return f"{number(1e3 * prd_m[at], 0)} ({prd_m[at] / roof.prd_m[at]:.2f})"
