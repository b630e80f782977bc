"""What several sections of study.pdf share: which cases are shown, a chart, and lengths.

And the two sections around them: how a study was run, and its limits.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from operator import itemgetter
from typing import Any

import numpy as np

from report.document.columns import text, words
from report.document.sections import Section, section
from report.document.tables import listed
from report.pages.symbols import with_symbols
from report.study import study_charts
from report.study.capacity_runs import FREQ_HZ
from report.study.sentences import spread
from report.study.study_results import StudyResults
from report.study.study_tables import length_unit
from report.text.counts import numbered
from report.text.letter_case import capitalized
from report.text.names import joined
from report.text.units import digits_up, measured, no_less, number
from report.text.validation import VALIDATION
from solver.model import INCH_M, Floats

# Lines of a chart.
MOST_LINES = 8
# Friction coefficients with pages of their own; a grid of more is drawn over friction.
MOST_FRICTIONS = 4
MOST_CUTS = 3
# Intensity [g] below which displacements are small and drawn on a logarithmic axis as well.
LOW_G = 0.8


def some(values: Sequence[float], maximum: int) -> list[int]:
    """Return indices of at most `maximum` values, evenly spaced, the last one included."""
    # Counted from the end: the last value, often the one that governs, is always among them.
    step = max(1, math.ceil(len(values) / maximum))
    return list(range((len(values) - 1) % step, len(values), step))


def friction_name(results: StudyResults, mu: float) -> str:
    """Return μ = 0.5 (EPDM)."""
    study_input = results.plan.input
    names = [mat.id for mat in study_input.mats if study_input.friction(mat.id).center == mu]
    return f"μ = {mu:g}" + (f" ({joined(names)})" if names else "")


def axis(results: StudyResults) -> str:
    """Return the name of the measure of intensity."""
    return results.plan.input.study.intensity.heading


def by_intensity(results: StudyResults, values: Floats, m: int, **options: Any) -> str:
    """Return displacements at a friction coefficient over intensity, a line for each slope.

    They have the shape (slopes, frictions, intensities) [m]; `options` as in `study_charts.curves`.
    """
    study_input = results.plan.input
    return study_charts.curves(
        np.array(study_input.intensities),
        [
            (f"{study_input.slopes_deg[s]:g}°", values[s, m])
            for s in some(study_input.slopes_deg, MOST_LINES)
        ],
        length_unit(results),
        along=axis(results),
        # A velocity has no such limit.
        low=LOW_G if study_input.study.intensity.unit == "g" else -math.inf,
        **options,
    )


def length(results: StudyResults, value_m: float) -> str:
    """Return a length in the unit of the study, "none" for no value."""
    return "none" if math.isnan(value_m) else measured(value_m, length_unit(results))


def design_length(results: StudyResults, value_m: float) -> str:
    """Return a design length, rounded up; "none" for no value."""
    return no_less(value_m, length_unit(results)) if math.isfinite(value_m) else "none"


def basis(results: StudyResults) -> Section:
    """Return the section on how the study was run."""
    without, motions = results.curves.without_value, results.plan.motions.motions[0]
    first, manifest, study_input = motions[0], results.manifest, results.plan.input
    model, rows = manifest["model"], manifest["rows"]
    letters = study_input.study.intensity.letters
    models = (
        (words("Model", 3), itemgetter(0)),
        (text("Runs"), lambda model: f"{model[1]:,}"),
        (text("Share"), lambda model: f"{100 * model[1] / rows:.1f}%"),
    )
    mats = (
        (words("Mat", 1.5), lambda mat: mat.id),
        (text("μ, median"), lambda mat: f"{study_input.friction(mat.id).center:.3g}"),
        (
            text("Standard deviation of ln μ", share=1.4),
            lambda mat: f"{study_input.friction(mat.id).beta:.3f}" if mat.tested else "none",
        ),
        (words("Tested values", 2.4), lambda mat: mat.tested or "none"),
        (words("Report", 1.8), lambda mat: mat.report or "none"),
    )
    rows_of_motions = (
        (words("Motion", 1.4), lambda motion: motion.id),
        (text("Samples"), lambda motion: f"{motion.ax_mps2.size:,}"),
        (text("Time step", "s"), lambda motion: f"{motion.dt_s:g}"),
        (
            text(with_symbols(f"Factor for {letters} = 1"), share=1.4),
            lambda motion: f"{motion.scale:.4g}",
        ),
        (words("Source", 2.4), lambda motion: motion.source or "not stated"),
    )
    return section(
        "study/basis",
        "Basis",
        n_motions=len(motions),
        components=numbered(1 + first.has_transverse + first.has_vertical, "component"),
        letters=with_symbols(letters),
        shaken="each horizontal component" if first.has_transverse else "the record",
        polarity="as recorded and reversed" if len(first.signs) > 1 else "in one polarity",
        has_transverse=first.has_transverse,
        times=numbered(len(first.orientations), "time"),
        matters_mm=f"{1000 * model['matters_m']:g}",
        matters_in=number(model["matters_m"] / INCH_M, 2),
        matters_share=f"{100 * model['matters_share']:g}%",
        tolerance=f"{100 * model['tolerance']:g}%",
        lost=int(without.sum()),
        pairs=without.size * len(motions),
        agreement=manifest["agreement"],
        capacity_runs=results.capacity_runs if results.arrays else None,
        models=listed(manifest["models"].items(), models, kind="compact"),
        mats=listed(study_input.mats, mats, kind="compact"),
        motions=listed(motions, rows_of_motions, kind="compact"),
        warnings=listed(
            results.plan.warnings,
            ((words("Cell", 1.2), itemgetter(0)), (words("Warning", 6), lambda row: f"{row[1]}.")),
        ),
    )


def limits(results: StudyResults) -> Section:
    """Return the section on the limits of the study."""
    study, spectra = results.plan.input.study, results.spread
    return section(
        "study/limits",
        "Limits",
        motions=results.plan.design_rule.n_motions,
        has_fragilities=bool(results.arrays),
        spread=capitalized(spread(results)) if spectra.is_known else "",
        largest=digits_up(spectra.largest, 2) if spectra.is_known else "",
        frequencies=f"{FREQ_HZ.size} frequencies from {FREQ_HZ[0]:.3g} to {FREQ_HZ[-1]:.3g}",
        lacking=_lacking(results) if spectra.is_one_spectrum else "",
        has_record_beta=bool(results.arrays) and study.record_beta is not None,
        has_years=bool(results.years),
        has_probability=study.site_intensity is not None,
        has_intensities=bool(study.intensity_beta),
        validation=VALIDATION,
    )


def _lacking(results: StudyResults) -> str:
    """Return which results do not contain the record-to-record dispersion of earthquakes."""
    has_beta = results.plan.input.study.record_beta is not None
    lacking = ["the 84th percentile"]
    if results.arrays:
        lacking.append("the dispersions β" + (" of the fits" if has_beta else ""))
    if any(result.exceedances for result in results.arrays):
        lacking.append("the probabilities of exceedance")
    if results.years:
        entered = " but by the dispersion that is entered" if has_beta else ""
        lacking.append(f"the rates in years{entered}")
    return f"{joined(lacking)} {'does' if len(lacking) == 1 else 'do'}"
