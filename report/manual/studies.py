"""The studies of the paper repeated: Figs. 5 to 12."""

from __future__ import annotations

import math
from collections.abc import Sequence
from itertools import groupby

import numpy as np

from report.document.blocks import Picture
from report.document.tables import Table, TableRow
from report.entities.columns import TableColumn
from report.figures import paper
from report.manual.blocks import (
    Block,
    Chart,
    ManualSection,
    percent,
    seconds,
    slug,
)
from report.words.letters import lettered
from solver.verification.evidence import (
    Convergence,
    LinkComparison,
    Verification,
)

PAPER_WORST_PERCENT, PAPER_MEAN_PERCENT = 6.78, 1.69
"""Differences in RRD between the paper's method and SAP 2000."""

PAPER_READ_OFFS = "1000 mm at θ = 4°, μ = 0.5; μ ≥ 0.55 at θ = 2° for 500 mm"


def convergence(verification: Verification) -> ManualSection:
    """Return the paper's Fig. 5."""
    scenarios = verification.convergence[0].scenarios if verification.convergence else 0
    return ManualSection(
        id="convergence",
        title="The paper's convergence study (Fig. 5)",
        blocks=(
            Block(
                texts=(
                    f"The paper's method is run in the paper's {scenarios} scenarios (five slopes, "
                    "three friction coefficients, four PPA) with an increasing number of sub-steps "
                    "P. The paper measures errors against its own result at P = 256; errors "
                    "against the exact method are also shown. At P = 64 the paper reports "
                    f"{paper.PAPER_P64_PERCENT} % and less than 0.09 s, on a record that is not "
                    "available here. Some scenarios end within a few millimeters of the initial "
                    "position, which makes errors in percent of the residual large; the table also "
                    "gives errors in percent of the PRD.",
                ),
                charts=[
                    Chart(
                        name=f"convergence-{at // 3 + 1}",
                        picture=Picture(
                            svg=paper.convergence(verification.convergence[at : at + 3]),
                            caption="Largest error and longest run time over the scenarios "
                            "against P.",
                            alt="Largest error and longest run time against number of sub-steps",
                        ),
                    )
                    for at in range(0, len(verification.convergence), 3)
                ],
                tables=[_convergence_table(study) for study in verification.convergence],
            ),
        ),
    )


def _convergence_table(study: Convergence) -> Table:
    return Table(
        caption=f"{study.record}: largest error in the residual, in percent of the residual and of "
        "the PRD",
        columns=(
            TableColumn(head="P", share=0.6),
            TableColumn(head="Against exact", share=1.2),
            TableColumn(head=f"Against P = {study.substeps[-1]}", share=1.2),
            TableColumn(head="Against exact, of the PRD", share=1.3),
            TableColumn(head="Longest time", share=1.0),
            TableColumn(head="Worst scenario", align="left", share=2.2),
        ),
        rows=tuple(
            TableRow(
                cells=(
                    str(substeps),
                    percent(float(study.largest_error_exact_percent[index])),
                    percent(float(study.largest_error_p256_percent[index] or math.nan)),
                    percent(float(study.largest_error_of_prd_percent[index])),
                    seconds(float(study.longest_seconds[index])),
                    lettered(study.worst_cases[index]),
                )
            )
            for index, substeps in enumerate(study.substeps)
        ),
        kind="compact",
    )


def links(verification: Verification) -> ManualSection:
    """Return the paper's Figs. 6 to 9."""
    by_record = [
        (name, tuple(rows))
        for name, rows in groupby(verification.links, key=lambda comparison: comparison.record)
    ]
    return ManualSection(
        id="links",
        title="Comparison with a link model (Figs. 6 to 9)",
        blocks=(
            Block(
                texts=(
                    "The exact method is compared with an elastic link with a friction limit, "
                    "integrated explicitly, with the stiffness and sub-step of the paper's SAP "
                    "2000 model. As in the paper, differences are in the residual, in percent of "
                    "the residual of the link. The difference is an error of the link, which "
                    "deforms elastically before it slips. Where the residual is about a "
                    "millimeter, differences in percent are large and not meaningful.",
                ),
                top=(_link_table(verification.links),),
                charts=[
                    Chart(
                        name=f"links-{slug(name)}",
                        picture=Picture(
                            svg=paper.links(rows),
                            caption=f"{name}, PPA = {rows[0].ppa_g:g} g. Left: displacement "
                            "history for the friction coefficient with the largest difference in "
                            "percent; right: PRD and RRD.",
                            alt=f"Exact method and link compared on {name}",
                        ),
                    )
                    for name, rows in by_record
                ],
            ),
        ),
    )


def _link_table(links: Sequence[LinkComparison]) -> Table:
    rows = [
        TableRow(
            cells=(
                comparison.record,
                f"{comparison.slope_deg:g}°",
                str(comparison.mus.size),
                percent(comparison.worst_percent),
                f"{comparison.history_mu:g}",
                f"{worst_mm(comparison):.2g} mm",
                percent(comparison.mean_percent),
            )
        )
        for comparison in links
    ]
    paper_row = TableRow(
        cells=(
            "The paper against SAP 2000, record of the paper",
            "0°",
            "10",
            f"{PAPER_WORST_PERCENT} %",
            "—",
            "—",
            f"{PAPER_MEAN_PERCENT} %",
        ),
        kind="total",
    )
    return Table(
        caption="Difference in RRD between the exact method and the link",
        columns=(
            TableColumn(head="Record", align="left", share=3.0),
            TableColumn(head="θ", share=0.6),
            TableColumn(head="Runs", share=0.7),
            TableColumn(head="Largest", share=1.0),
            TableColumn(head="At μ", share=0.7),
            TableColumn(head="Absolute", share=0.9),
            TableColumn(head="Mean", share=1.0),
        ),
        rows=(*rows, paper_row),
    )


def worst_mm(comparison: LinkComparison) -> float:
    """Return the difference in RRD [mm] in the case where it is largest in percent."""
    at = int(np.abs(comparison.mus - comparison.history_mu).argmin())
    return 1e3 * abs(float(comparison.rrd_exact_m[at] - comparison.rrd_link_m[at]))


def curves(verification: Verification) -> ManualSection:
    """Return the paper's Figs. 10 to 12."""
    charts = []
    for study in verification.curves:
        charts += [
            Chart(
                name=f"curves-{slug(study.record)}",
                picture=Picture(
                    svg=paper.curves(study),
                    caption=f"{study.record}: PRD against PPA (Fig. 10) and against slope "
                    "(Fig. 11); the larger of both signs of the slope.",
                    alt=f"PRD against PPA and slope for {study.record}",
                ),
            ),
            Chart(
                name=f"contours-{slug(study.record)}",
                picture=Picture(
                    svg=paper.contours(study),
                    caption=f"{study.record}: contours of PRD against μ and θ at PPA = "
                    f"{paper.FIG_12_PPA_G:g} g (Fig. 12). "
                    f"{_read_off_words(verification, study.record)}",
                    alt=f"Contours of PRD against friction and slope for {study.record}",
                ),
            ),
        ]
    return ManualSection(
        id="curves",
        title="Design curves (Figs. 10 to 12)",
        blocks=(
            Block(
                texts=(
                    "The exact method is run for 29 slopes, 15 friction coefficients and 16 PPA on "
                    f"each record. The paper gives, for its record: {PAPER_READ_OFFS}. Values "
                    "differ between records; the curves illustrate the procedure and are not for "
                    "design.",
                ),
                top=(_read_off_table(verification),),
                charts=charts,
            ),
        ),
    )


def _read_off_words(verification: Verification, record: str) -> str:
    study = next(study for study in verification.curves if study.record == record)
    slope, wanted = paper.READ_OFF
    least = study.least_mu(slope, paper.FIG_12_PPA_G, wanted)
    if math.isnan(least):
        return f"No μ of the study limits the PRD to {1e3 * wanted:g} mm at θ = {slope:g}°."
    return (
        f"Arrow: a PRD of at most {1e3 * wanted:g} mm at θ = {slope:g}° requires μ of at least "
        f"{least:.3f}."
    )


def _read_off_table(verification: Verification) -> Table:
    slope, wanted = paper.READ_OFF
    rows = []
    for study in verification.curves:
        prd = float(np.interp(0.5, study.mus, study.prd(4.0, paper.FIG_12_PPA_G)))
        least = study.least_mu(slope, paper.FIG_12_PPA_G, wanted)
        rows.append(
            TableRow(
                cells=(
                    study.record,
                    f"{1e3 * prd:.0f} mm",
                    "none in study" if math.isnan(least) else f"{least:.3f}",
                    f"{study.runs:,}",
                    seconds(study.seconds),
                )
            )
        )
    paper_row = TableRow(
        cells=("The paper, record of the paper", "1000 mm", "0.55", "6,960", "—"), kind="total"
    )
    return Table(
        caption=f"Values from the curves at PPA = {paper.FIG_12_PPA_G:g} g",
        columns=(
            TableColumn(head="Record", align="left", share=2.4),
            TableColumn(head="PRD at θ = 4°, μ = 0.5", share=1.6),
            TableColumn(head=f"Least μ for {1e3 * wanted:g} mm at θ = {slope:g}°", share=2.0),
            TableColumn(head="Runs", share=0.8),
            TableColumn(head="Time", share=0.8),
        ),
        rows=(*rows, paper_row),
    )
