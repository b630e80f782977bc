"""Roof motion computed from ground motion: its difference from a recorded roof motion."""

from __future__ import annotations

import numpy as np

from report.document.blocks import Picture
from report.document.tables import Table, TableRow
from report.entities.columns import TableColumn
from report.figures import building as figures
from report.manual.blocks import Block, Chart, ManualSection, slug
from report.words.units import G_MPS2, number
from solver.building.roof import FINENESS, RESTING_SHARE, SHARE
from solver.verification.building import BY_HEIGHT
from solver.verification.evidence import RoofComparison, RoofPrediction, Verification

TITLE = "Roof motion computed from ground motion"


def building(verification: Verification) -> ManualSection:
    """Return a block for each building, the model building first."""
    return ManualSection(
        id="building",
        title=TITLE,
        blocks=(
            Block(texts=(*_model(), _at_hand(verification))),
            *(_block(roof) for roof in verification.roofs),
        ),
    )


def _model() -> tuple[str, ...]:
    return (
        "Where ground motions are given, the roof motion is computed with an elastic building "
        "model: a uniform cantilever in shear and bending, or equal stories, with the same damping "
        "ratio in all modes. Each mode is an oscillator, integrated exactly. The number of modes "
        f"is the smallest for which the neglected modes contribute at most {100 * SHARE:g} % of "
        "the peak roof acceleration at any instant. The time step is refined to "
        f"{FINENESS} samples per period of the highest mode included. The roof motion continues "
        "after the end of the ground motion until the building is at rest, to within "
        f"{100 * RESTING_SHARE:g} % of the peak.",
        "The model neglects the mass of the arrays, torsion, yielding, soil flexibility and "
        "in-plane flexibility of the roof. The vertical motion of the ground is applied at the "
        "roof without change. Section 3 has the closed-form checks; this section compares whole "
        "buildings.",
    )


def _at_hand(verification: Verification) -> str:
    real = [roof.title for roof in verification.roofs if roof.is_recorded]
    if real:
        return (
            f"Records of a real building were given: {'; '.join(real)}. They show how well a "
            "uniform beam represents that building. The model building verifies only the "
            "software."
        )
    return (
        "No records of a real building were given to this run (option --records). The model "
        "building below verifies the software; it does not show how well a uniform beam represents "
        "a real building."
    )


def _block(roof: RoofComparison) -> Block:
    return Block(
        title=roof.title,
        texts=(roof.description, *_results(roof)),
        top=(_properties(roof),),
        charts=(
            Chart(
                name=f"building-{slug(roof.title)}",
                picture=Picture(
                    svg=figures.comparison(roof),
                    caption=_caption(roof),
                    alt=f"Response of the roof, {_reference(roof)} and computed",
                ),
            ),
        ),
        tables=(_bands(roof), _slips(roof)),
    )


def _caption(roof: RoofComparison) -> str:
    caption = f"{roof.title}: response spectra of ground, roof and computed roof motions"
    if roof.is_recorded:
        caption += f", and {figures.SHOWN_S:g} s of the roof acceleration"
    return f"{caption}."


def _results(roof: RoofComparison) -> tuple[str, ...]:
    """Return the least and the greatest ratio of PRD for each prediction, in words."""
    if not roof.is_recorded:
        return ()
    words = [
        f"{prediction.name}: {_span(prediction, roof)}" for prediction in figures.computed(roof)
    ]
    return (
        "Ratio of PRD with the computed roof motion to PRD with the recorded one, range over the "
        f"cases below: {'; '.join(words)}. Damping, including radiation into the soil, causes most "
        "of the difference and is not known in advance. At this scale factor a real building "
        "would not remain elastic. One building in one earthquake does not establish a margin for "
        "another building.",
    )


def _span(prediction: RoofPrediction, roof: RoofComparison) -> str:
    ratios = prediction.prd_m / roof.prd_m
    return f"{ratios.min():.2f} to {ratios.max():.2f}"


def _reference(roof: RoofComparison) -> str:
    return "recorded" if roof.is_recorded else "integrated directly"


def _properties(roof: RoofComparison) -> Table:
    """Properties of each prediction, and its overall agreement."""
    peak = float(np.abs(roof.roof_mps2).max()) / G_MPS2
    rows = [_property_row(prediction) for prediction in roof.predictions]
    cells = (_sentence(_reference(roof)), "—", "—", "—", "—", "—", number(peak, 3), "—")
    return Table(
        caption="Properties of the building and computed roof motion",
        columns=(
            TableColumn(head="Building", align="left", share=3.2),
            TableColumn(head="First period", unit="s", share=1.0),
            TableColumn(head="Damping", unit="%", share=0.9),
            TableColumn(head="Stiffness ratio", share=1.0),
            TableColumn(head="Modes included", share=0.9),
            TableColumn(head="Neglected", unit="%", share=1.0),
            TableColumn(head="Peak", unit="g", share=0.8),
            TableColumn(head="Unexplained", unit="%", share=1.1),
        ),
        rows=(TableRow(cells=cells, kind="total"), *rows),
        notes=(
            "Stiffness ratio: H √(GA/EI), 0 for pure bending, large for shear. Neglected: largest "
            "contribution of the modes not included, relative to the peak roof acceleration. "
            "Unexplained: sum of squares of the difference between the computed and the reference "
            "acceleration (first row), relative to that of the reference; 0 is a perfect match, "
            "and an uncorrelated motion of the same amplitude gives 200.",
        ),
    )


def _property_row(prediction: RoofPrediction) -> TableRow:
    has_building = prediction.n_modes > 0
    return TableRow(
        cells=(
            _sentence(prediction.name),
            number(prediction.period_s, 2),
            number(100.0 * prediction.damping, 1),
            number(prediction.alpha0, 1),
            str(prediction.n_modes) if has_building else "—",
            number(100.0 * prediction.left_out_share, 1) if has_building else "—",
            number(prediction.peak_mps2 / G_MPS2, 3),
            number(100.0 * prediction.unexplained, 1),
        )
    )


def _sentence(name: str) -> str:
    return name[0].upper() + name[1:]


def _bands(roof: RoofComparison) -> Table:
    return Table(
        caption="Ratio of response spectra by period band, computed / reference",
        columns=(
            TableColumn(head="Building", align="left", share=3.2),
            *(TableColumn(head=f"{low:g} to {high:g}", unit="s") for low, high in roof.bands_s),
        ),
        rows=tuple(
            TableRow(
                cells=(
                    _sentence(prediction.name),
                    *(
                        f"{ratio:.2f} ({100.0 * scatter:.0f} %)"
                        for ratio, scatter in zip(
                            prediction.band_ratios, prediction.band_scatters, strict=True
                        )
                    ),
                )
            )
            for prediction in roof.predictions
        ),
        notes=(
            "Geometric mean of the ratio in the band; in parentheses, the standard deviation of "
            f"its natural logarithm. Reference: the roof motion {_reference(roof)}.",
        ),
    )


def _slips(roof: RoofComparison) -> Table:
    peaks = (number(1e3 * m, 0) for m in roof.prd_m)
    return Table(
        caption=f"PRD on a slope of {roof.slope_deg:g}°; in parentheses, ratio to the reference "
        "(first row)",
        columns=(
            TableColumn(head="Roof motion", align="left", share=3.2),
            *(TableColumn(head=f"μ = {mu:g}", unit="mm") for mu in roof.mus),
        ),
        rows=(
            TableRow(cells=(_sentence(_reference(roof)), *peaks), kind="total"),
            *(
                TableRow(
                    cells=(
                        _sentence(prediction.name),
                        *(
                            f"{number(1e3 * m, 0)} ({m / r:.2f})"
                            for m, r in zip(prediction.prd_m, roof.prd_m, strict=True)
                        ),
                    )
                )
                for prediction in roof.predictions
            ),
        ),
        notes=(
            f"All motions are multiplied by {roof.scale:.3g}, which scales the reference roof "
            "motion to a peak of 1 g. The larger PRD of both signs of the slope is given. No "
            "vertical motion is applied.",
        ),
    )


def answer(verification: Verification) -> str:
    """Return the summary's result for a recorded building; empty if none was given."""
    for roof in verification.roofs:
        if roof.is_recorded:
            best = roof.predictions[0]
            others = [p for p in roof.predictions if p.name == BY_HEIGHT]
            return (
                f"{best.name}: PRD {_span(best, roof)} times that of the recorded roof motion, "
                f"{100.0 * best.unexplained:.0f} % of the motion unexplained"
                + "".join(f"; {other.name}: PRD {_span(other, roof)} times" for other in others)
            )
    return ""
