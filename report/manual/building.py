"""From ground to roof: how far a computed roof motion is from a recorded one."""

from __future__ import annotations

import numpy as np

from report.figures import building as figures
from report.manual.blocks import Block, Chart, ManualSection, slug
from report.pages.parts import Picture, Table, TableColumn, TableRow
from report.words.units import G_MPS2, number
from solver.building.roof import FINENESS, RESTING_SHARE, SHARE
from solver.verification.building import BY_HEIGHT
from solver.verification.evidence import RoofComparison, RoofPrediction, Verification

TITLE = "From ground to roof"


def building(found: Verification) -> ManualSection:
    """Return a block for each building, the made one first."""
    return ManualSection(
        id="building",
        title=TITLE,
        blocks=(
            Block(texts=(*_model(), _at_hand(found))),
            *(_block(one) for one in found.roofs),
        ),
    )


def _model() -> tuple[str, ...]:
    return (
        "Where the motions given are those of the ground, the motion of the roof is computed from "
        "them through an elastic building: a uniform cantilever in shear and bending, or equal "
        "stories, with one damping ratio for all modes. Each mode is an oscillator, followed "
        f"exactly; as few are taken as leave out no more than {100 * SHARE:g} % of the roof's peak "
        f"at any instant. The step is refined to {FINENESS} samples in a period of the fastest "
        "mode taken, and the motion goes on after the ground's until the building rests, within "
        f"{100 * RESTING_SHARE:g} % of the peak.",
        "Not in the model: the mass of the arrays, torsion, yielding, the soil below, a roof that "
        "bends in its plane, and the way of the vertical motion, which is passed on unchanged. The "
        "closed forms are among the checks of section 3; here a whole building is compared.",
    )


def _at_hand(found: Verification) -> str:
    real = [one.title for one in found.roofs if one.is_recorded]
    if real:
        return (
            f"Records of a real building were at hand: {'; '.join(real)}. They say how well a "
            "uniform beam stands for it. The made building says only that the software does what "
            "it means to."
        )
    return (
        "No records of a real building were given to this run (option --records). What follows is "
        "a made building: it says that the software does what it means to, and nothing about how "
        "well a uniform beam stands for a real building."
    )


def _block(found: RoofComparison) -> Block:
    return Block(
        title=found.title,
        texts=(found.story, *_results(found)),
        top=(_properties(found),),
        charts=(
            Chart(
                name=f"building-{slug(found.title)}",
                picture=Picture(
                    svg=figures.comparison(found),
                    caption=_caption(found),
                    alt=f"Response of the roof, {_was(found)} and computed",
                ),
            ),
        ),
        tables=(_bands(found), _slips(found)),
    )


def _caption(found: RoofComparison) -> str:
    caption = f"{found.title}: spectra of ground and roof, with those computed"
    if found.is_recorded:
        caption += f", and {figures.SHOWN_S:g} s of the roof's motion"
    return f"{caption}."


def _results(found: RoofComparison) -> tuple[str, ...]:
    """UnitFormat what came out, the least and the greatest ratio of PRD for each prediction."""
    if not found.is_recorded:
        return ()
    words = [f"{one.name}: {_span(one, found)}" for one in figures.computed(found)]
    return (
        "PRD with the computed roof motion over that with the recorded one, least to greatest of "
        f"the scenes below: {'; '.join(words)}. What a building loses in one earthquake, to the "
        "soil too, is not known beforehand: damping makes most of the difference. Scaled like "
        "this a real building would not stay elastic. One building in one earthquake is no margin "
        "for another.",
    )


def _span(one: RoofPrediction, found: RoofComparison) -> str:
    ratios = one.prd_m / found.prd_m
    return f"{ratios.min():.2f} to {ratios.max():.2f}"


def _was(found: RoofComparison) -> str:
    return "recorded" if found.is_recorded else "stepped"


def _properties(found: RoofComparison) -> Table:
    """What each prediction is made with, and how it comes out as a whole."""
    peak = float(np.abs(found.roof_mps2).max()) / G_MPS2
    rows = [_property_row(one) for one in found.predictions]
    cells = (f"As {_was(found)}", "—", "—", "—", "—", "—", number(peak, 3), "—")
    return Table(
        caption="The building, and the roof motion computed for it",
        columns=(
            TableColumn(head="Building", align="left", share=3.2),
            TableColumn(head="First period", unit="s", share=1.0),
            TableColumn(head="Damping", unit="%", share=0.9),
            TableColumn(head="Stiffness ratio", share=1.0),
            TableColumn(head="Modes taken", share=0.9),
            TableColumn(head="Left out", unit="%", share=0.8),
            TableColumn(head="Peak", unit="g", share=0.8),
            TableColumn(head="Not explained", unit="%", share=1.1),
        ),
        rows=(TableRow(cells=cells, kind="total"), *rows),
        notes=(
            "Stiffness ratio: H √(GA/EI), 0 in bending, large in shear. Left out: what all further "
            "modes change at most, of the roof's peak. Not explained: sum of squares of the "
            f"computed less the {_was(found)} acceleration, of that of the latter; 0 is perfect, a "
            "motion of the right size at the wrong times has 200.",
        ),
    )


def _property_row(one: RoofPrediction) -> TableRow:
    has_building = one.n_modes > 0
    return TableRow(
        cells=(
            _name(one),
            number(one.period_s, 2),
            number(100.0 * one.damping, 1),
            number(one.alpha0, 1),
            str(one.n_modes) if has_building else "—",
            number(100.0 * one.left_out_share, 1) if has_building else "—",
            number(one.peak_mps2 / G_MPS2, 3),
            number(100.0 * one.unexplained, 1),
        )
    )


def _name(one: RoofPrediction) -> str:
    return one.name[0].upper() + one.name[1:]


def _bands(found: RoofComparison) -> Table:
    return Table(
        caption=f"Response spectrum, computed over {_was(found)}, by period",
        columns=(
            TableColumn(head="Building", align="left", share=3.2),
            *(TableColumn(head=f"{low:g} to {high:g}", unit="s") for low, high in found.bands_s),
        ),
        rows=tuple(
            TableRow(
                cells=(
                    _name(one),
                    *(
                        f"{ratio:.2f} ({100.0 * scatter:.0f} %)"
                        for ratio, scatter in zip(one.band_ratios, one.band_scatters, strict=True)
                    ),
                )
            )
            for one in found.predictions
        ),
        notes=(
            "Geometric mean of the ratio in the band; in brackets its scatter, the standard "
            "deviation of the logarithm.",
        ),
    )


def _slips(found: RoofComparison) -> Table:
    peaks = (number(1e3 * m, 0) for m in found.prd_m)
    return Table(
        caption=f"PRD on a slope of {found.slope_deg:g}°; in brackets over that of the roof as "
        f"{_was(found)}",
        columns=(
            TableColumn(head="Roof motion", align="left", share=3.2),
            *(TableColumn(head=f"μ = {mu:g}", unit="mm") for mu in found.mus),
        ),
        rows=(
            TableRow(cells=(f"As {_was(found)}", *peaks), kind="total"),
            *(
                TableRow(
                    cells=(
                        _name(one),
                        *(
                            f"{number(1e3 * m, 0)} ({m / r:.2f})"
                            for m, r in zip(one.prd_m, found.prd_m, strict=True)
                        ),
                    )
                )
                for one in found.predictions
            ),
        ),
        notes=(
            f"All motions times {found.scale:.3g}, which brings the roof as {_was(found)} to a "
            "peak of 1 g. The larger of both signs of the slope; no vertical motion.",
        ),
    )


def answer(found: Verification) -> str:
    """Return what the summary says of a real building; empty where none was at hand."""
    for one in found.roofs:
        if one.is_recorded:
            best = one.predictions[0]
            others = [p for p in one.predictions if p.name == BY_HEIGHT]
            return (
                f"{best.name}: PRD {_span(best, one)} times that of the recorded roof, "
                f"{100.0 * best.unexplained:.0f} % of the motion not explained"
                + "".join(f"; {other.name}: PRD {_span(other, one)} times" for other in others)
            )
    return ""
