"""The stated error bound of two axes, tried on random pairs of runs."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from report.document.blocks import Picture
from report.document.tables import Table, TableRow
from report.entities.columns import TableColumn
from report.figures import rungs as figures
from report.figures.scales import power_of_ten
from report.manual.blocks import Block, Chart, small
from solver.verification.rung_evidence import BoundRatios


def block(groups: Sequence[BoundRatios]) -> Block:
    """Return how far the pairs of each kind come to the bound of their difference."""
    return Block(
        title="Verification of the stated error bound",
        texts=(_words(groups),),
        charts=(_chart(groups),),
        tables=(_table(groups),),
    )


def _words(groups: Sequence[BoundRatios]) -> str:
    pairs, over = sum(group.n_pairs for group in groups), sum(group.n_over for group in groups)
    unanswered = sum(group.n_unanswered for group in groups)
    verdict = (
        "Every pair is within its bound."
        if over + unanswered == 0
        else f"Pairs over their bounds: {over}; without a result: {unanswered}."
    )
    return (
        f"The error bound is tested with {pairs:,} pairs of runs on random cases. Most of the "
        "motions are unlike an earthquake: equal samples, jumps, accelerations equal to the yield "
        "acceleration to the last digit, proportional or negligible components, time steps of "
        "0.0005 to 0.5 s, and tolerances of 10⁻² to 10⁻¹⁰. The two runs of a pair have the same "
        "exact result: the second has interpolated samples added, is mirrored, is rotated on a "
        "flat roof, or has another tolerance. The difference is the largest of the differences in "
        "PRD, in the four excursions and in final position. The allowed difference is the sum of "
        "both stated bounds; where the input of the second run is rounded again, the effect of "
        "half a unit in the last place of every sample, applied as an acceleration over the whole "
        f"record, is added. {verdict}"
    )


def _chart(groups: Sequence[BoundRatios]) -> Chart:
    return Chart(
        name="rungs-bounds",
        picture=Picture(
            svg=figures.bounds(groups),
            caption="Share of the pairs whose ratio of difference to bound exceeds a value. "
            f"Ratios below {power_of_ten(figures.LEAST_RATIO)} are drawn at "
            f"{power_of_ten(figures.LEAST_RATIO)}.",
            alt="Distribution of the ratio of the difference of two runs to the sum of bounds",
        ),
    )


def _table(groups: Sequence[BoundRatios]) -> Table:
    return Table(
        caption="Difference of the two runs of a pair / sum of their bounds",
        columns=(
            TableColumn(head="Kind of pair", align="left", share=2.4),
            TableColumn(head="Pairs"),
            TableColumn(head="With slip"),
            TableColumn(head="Median"),
            TableColumn(head="99 %"),
            TableColumn(head="Largest"),
            TableColumn(head="Above 1"),
            TableColumn(head="No result"),
        ),
        rows=tuple(
            TableRow(
                cells=(
                    group.kind.replace("mu", "μ"),
                    str(group.n_pairs),
                    str(group.ratios.size),
                    *(small(float(value)) for value in np.percentile(group.ratios, (50, 99, 100))),
                    str(group.n_over),
                    str(group.n_unanswered),
                )
            )
            for group in groups
        ),
        kind="compact",
    )
